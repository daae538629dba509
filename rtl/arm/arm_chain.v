// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of a real arm on two multipliers: three joints and five constants.
//   (A, B) = (L2 + i e)(c2 + i n2); rho + i z = (A + L1 + i B)(c1 + i n1) + a + i base, with ABSOLUTE
//   A + i B + L1 (c1 + i n1) + a + i base; x + i y = (rho + i b)(c3 + i n3)
// Formats: c, n s2.U of any length; A, B, rho s(W+3+G) with G guard bits below the LSB of a coordinate, to which every
// product is truncated. Outputs are rounded to nearest (ties upward) and saturated.
// Error of a coordinate: 1/2 + (sqrt(13) + 6) / 32 = 0.80 LSB for vectors that are not longer than 1.
// Range: every sum stays below 2^(W+2) LSB for unit vectors and any lengths; beyond that a coordinate wraps.
// Latency and II: 8; with PIPE = 1, registers around the multipliers and the same words, 11 with ABSOLUTE and 14
// without. Overflow: a coordinate was saturated.
// Source: rational trigonometry paper, eqs. 24-31, in vector form, with the offsets of real arms. Model: arm.fk3
`default_nettype none
module arm_chain #(
    parameter W = 16,        // bits of a length and of a coordinate, 8 to 24 (default 16)
    parameter U = 16,        // fraction bits of cosine and sine, 8 to 24 (default 16)
    parameter ABSOLUTE = 1,  // 1 (default): joint 2 is measured from the base; 0: from link 1
    parameter PIPE = 0,      // registers around the multipliers, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire signed [W-1:0] cfg_base,
    input  wire signed [W-1:0] cfg_shoulder,
    input  wire signed [W-1:0] cfg_lateral,
    input  wire signed [W-1:0] cfg_elbow,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_overflow
);
    localparam G = 5, N = W + 3 + G;  // guard bits; bits of A, B and rho

    // Schedule, a clock a line
    localparam [11:0]
        JOINT1 = 12'h001,  // operands: turn by joint 1, not by joint 2
        JOINT3 = 12'h002,  //           turn by joint 3
        SIN    = 12'h004,  //           the second coordinate of the turned (a, b), not the first
        OFFSET = 12'h008,  // b is the lateral offset from the next clock on, as with JOINT1 | SIN
        SUM    = 12'h010,  // products: both are added, and what is to be added to their sum is taken
        SUM1   = 12'h020,  //           of joint 1, not of joint 2
        SUM3   = 12'h040,  //           of joint 3
        SECOND = 12'h080,  //           the second coordinate, not the first
        A      = 12'h100,  // the sum is the new a
        B      = 12'h200,  // the sum is the new b
        Z      = 12'h400,  // the sum is z
        LAST   = 12'h800;  // the sum is x; y is in the clock after
    localparam [12*7-1:0] TURNS = {
        /* A       */ {SUM},
        /* B       */ {SIN | SUM | SECOND | A},
        /* B waits */ {B},
        /* rho     */ {JOINT1 | SUM | SUM1},
        /* z       */ {JOINT1 | SIN | SUM | SUM1 | SECOND | A},
        /* x       */ {JOINT3 | SUM | SUM3 | Z},
        /* y       */ {JOINT3 | SIN | SUM | SUM3 | LAST}};
    // PIPE = 1: operands, two clocks later the sum of their products
    localparam [12*13-1:0] TURNS_1 = {
        /* A       */ {12'd0},
        /* B       */ {SIN},
        /* A       */ {SUM},
        /* B       */ {SUM | SECOND | A},
        /* B waits */ {B},
        /* rho     */ {JOINT1},
        /* z       */ {JOINT1 | SIN},
        /* rho     */ {SUM | SUM1},
        /* z       */ {SUM | SUM1 | SECOND | A},
        /* x       */ {JOINT3 | Z},
        /* y       */ {JOINT3 | SIN},
        /* x       */ {SUM | SUM3},
        /* y       */ {SUM | SUM3 | LAST}};
    localparam [12*10-1:0] ABSOLUTE_1 = {  // joint 1 turns link 1 alone, meanwhile
        /* A       */ {12'd0},
        /* B       */ {SIN},
        /* A, rho  */ {SUM | JOINT1},
        /* B, z    */ {SUM | SECOND | A | JOINT1 | SIN},
        /* rho     */ {SUM | SUM1 | B},
        /* z       */ {SUM | SUM1 | SECOND | A | OFFSET},
        /* x       */ {JOINT3 | Z},
        /* y       */ {JOINT3 | SIN},
        /* x       */ {SUM | SUM3},
        /* y       */ {SUM | SUM3 | LAST}};
    localparam LINES = PIPE == 0 ? 7 : ABSOLUTE == 0 ? 13 : 10;
    localparam [12*13-1:0] TABLE = PIPE == 0 ? {{12*(13-7){1'b0}}, TURNS} : ABSOLUTE == 0 ? TURNS_1
                                 : {{12*(13-10){1'b0}}, ABSOLUTE_1};
    wire   joint1, joint3, sine, offset, add, add1, add3, second, to_a, to_b, to_z, last, idle;
    wire   accept = in_valid && in_ready;
    assign in_ready = idle && (!out_valid || out_ready);
    schedule #(.LINES(LINES), .BITS(12), .TABLE(TABLE[12*LINES-1:0])) control (.clk(clk), .rst(rst), .in_start(accept),
        .out_idle(idle), .out_op({last, to_z, to_b, to_a, second, add3, add1, add, offset, sine, joint3, joint1}));

    reg  signed [U+1:0] c1, n1, c2, n2, c3, n3;
    reg  signed [N-1:0] a, b;
    reg         [N-1:0] exact, base;
    wire signed [U+1:0] c = joint3 ? c3 : joint1 ? c1 : c2, n = joint3 ? n3 : joint1 ? n1 : n2;
    wire signed [U+1:0] left1 = sine ? n : c, left2 = sine ? c : n;
    wire                link = ABSOLUTE && joint1;  // joint 1 turns L1 alone, not A and B
    wire signed [N-1:0] right1 = link ? {3'd0, cfg_l1, {G{1'b0}}} : a;
    wire signed [N-1:0] right2 = link ? {N{1'b0}} : b ^ {N{!sine}};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [N+U+1:0] product1, product2;
    /* verilator lint_on UNUSEDSIGNAL */
    generate
        if (PIPE == 0) begin : g_small
            assign product1 = left1 * right1;
            assign product2 = left2 * right2;
        end else begin : g_fast
            reg signed [U+1:0] factor1, factor2;
            reg signed [N-1:0] word1, word2;
            always @(posedge clk) begin
                {factor1, factor2} <= {left1, left2};
                {word1, word2}     <= {right1, right2};
            end
            product_parts #(.A(N), .B(U+2), .MULTIPLY(MULTIPLY)) parts1 (.clk(clk), .in_move(1'b1), .in_a(word1),
                .in_b(factor1), .out_p(product1));
            product_parts #(.A(N), .B(U+2), .MULTIPLY(MULTIPLY)) parts2 (.clk(clk), .in_move(1'b1), .in_a(word2),
                .in_b(factor2), .out_p(product2));
        end
    endgenerate

    // This is added to a sum one clock later. It includes the half that rounds where the sum is a coordinate
    localparam [G-1:0]  HALF = 1 << G - 1;
    wire        [N-1:0] shoulder = {{3{cfg_shoulder[W-1]}}, cfg_shoulder, {G{1'b0}}};
    wire        [N-1:0] height = {{3{cfg_base[W-1]}}, cfg_base, HALF};
    wire        [N-1:0] near = exact + base;
    wire        [W+2:0] nearest = near[N-1:G];
    wire         over = nearest[W+2:W-1] != {4{nearest[W+2]}};
    reg          over_before;
    assign       out_y = over ? {nearest[W+2], {(W-1){!nearest[W+2]}}} : nearest[W-1:0];
    assign       out_overflow = over || over_before;

    always @(posedge clk) begin
        if (accept) begin
            c1 <= in_c1;
            n1 <= in_n1;
            c2 <= in_c2;
            n2 <= in_n2;
            c3 <= in_c3;
            n3 <= in_n3;
        end
        if (add) begin
            exact <= product1[N+U-1:U] + product2[N+U-1:U];
            if (add3)
                base <= {{(N-G){1'b0}}, HALF};
            else if (add1)
                base <= ABSOLUTE ? (second ? b : a) : second ? height : shoulder;
            else
                base <= ABSOLUTE ? (second ? height : shoulder) : second ? {N{1'b0}} : {3'd0, cfg_l1, {G{1'b0}}};
        end
        if (accept || to_a)
            a <= accept ? {3'd0, cfg_l2, {G{1'b0}}} : near;
        if (accept || to_b || joint1 && sine || offset)
            b <= to_b ? near : {{3{accept ? cfg_elbow[W-1] : cfg_lateral[W-1]}},
                                accept ? cfg_elbow : cfg_lateral, {G{1'b0}}};
        if (to_z)
            out_z <= out_y;
        if (last)
            out_x <= out_y;
        if (to_z || last)
            over_before <= out_overflow && !(to_z && !over);
        out_valid <= last || (out_valid && !out_ready);
        if (rst)
            out_valid <= 1'b0;
    end
endmodule
`default_nettype wire
