// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of a real arm on two multipliers: three joints and five constants.
//   (A, B) = (L2 + i e)(c2 + i n2); rho + i z = (A + L1 + i B)(c1 + i n1) + a + i base, with ABSOLUTE
//   A + i B + L1 (c1 + i n1) + a + i base; x + i y = (rho + i b)(c3 + i n3)
// Formats: c, n s2.U of any length; A, B, rho s(W+3+G) with G guard bits below the LSB of a coordinate, to which every
// product is truncated. Outputs are rounded to nearest (ties upward) and saturated.
// Error of a coordinate: 1/2 + (sqrt(13) + 6) / 32 = 0.80 LSB for vectors that are not longer than 1.
// Range: every sum stays below 2^(W+2) LSB for unit vectors and any lengths; beyond that a coordinate wraps.
// Latency and II: 8. Overflow: a coordinate was saturated.
// Source: rational trigonometry paper, eqs. 24-31, in vector form, with the offsets of real arms. Model: arm.fk3
`default_nettype none
module arm_chain #(
    parameter W = 16,       // bits of a length and of a coordinate, 8 to 24 (default 16)
    parameter U = 16,       // fraction bits of cosine and sine, 8 to 24 (default 16)
    parameter ABSOLUTE = 1  // 1 (default): joint 2 is measured from the base; 0: from link 1
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
    localparam [7:0]
        JOINT1 = 8'h01,   // turn by joint 1, not by joint 2
        JOINT3 = 8'h02,   // turn by joint 3
        COS    = 8'h04,   // the first coordinate of the turned (a, b), and what is to be added
        SIN    = 8'h08,   // the second; behind joint 1 the lateral offset is b
        A      = 8'h10,   // the sum is the new a
        B      = 8'h20,   // the sum is the new b
        Z      = 8'h40,   // the sum is z
        LAST   = 8'h80;   // the sum is x; y is in the clock after
    //                 work
    localparam [8*7-1:0] CHAIN = {
        /* A       */ {COS},
        /* B       */ {SIN | A},
        /* B waits */ {B},
        /* rho     */ {JOINT1 | COS},
        /* z       */ {JOINT1 | SIN | A},
        /* x       */ {JOINT3 | COS | Z},
        /* y       */ {JOINT3 | SIN | LAST}};
    wire   joint1, joint3, cosine, sine, to_a, to_b, to_z, last, idle;
    wire   accept = in_valid && in_ready;
    assign in_ready = idle && (!out_valid || out_ready);
    schedule #(.LINES(7), .BITS(8), .TABLE(CHAIN)) control (.clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_op({last, to_z, to_b, to_a, sine, cosine, joint3, joint1}));

    reg  signed [U+1:0] c1, n1, c2, n2, c3, n3;
    reg  signed [N-1:0] a, b;
    reg         [N-1:0] exact, base;
    wire signed [U+1:0] c = joint3 ? c3 : joint1 ? c1 : c2, n = joint3 ? n3 : joint1 ? n1 : n2;
    wire signed [U+1:0] left1 = sine ? n : c, left2 = sine ? c : n;
    wire                link = ABSOLUTE && joint1;  // joint 1 turns L1 alone, not A and B
    wire signed [N-1:0] right1 = link ? {3'd0, cfg_l1, {G{1'b0}}} : a;
    wire signed [N-1:0] right2 = link ? {N{1'b0}} : b ^ {N{!sine}};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [N+U+1:0] product1 = left1 * right1, product2 = left2 * right2;
    /* verilator lint_on UNUSEDSIGNAL */

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
        if (cosine || sine) begin
            exact <= product1[N+U-1:U] + product2[N+U-1:U];
            if (joint3)
                base <= {{(N-G){1'b0}}, HALF};
            else if (joint1)
                base <= ABSOLUTE ? (sine ? b : a) : sine ? height : shoulder;
            else
                base <= ABSOLUTE ? (sine ? height : shoulder) : sine ? {N{1'b0}} : {3'd0, cfg_l1, {G{1'b0}}};
        end
        if (accept || to_a)
            a <= accept ? {3'd0, cfg_l2, {G{1'b0}}} : near;
        if (accept || to_b || joint1 && sine)
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
