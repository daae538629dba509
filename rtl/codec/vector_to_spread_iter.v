// SPDX-License-Identifier: Apache-2.0
// Turn-spread word of a direction: s = n^2 / (c^2 + n^2), with the quadrant from the signs, for a vector of any length.
//   out_j = {k, s} in even quadrants, {k, 1 - s} in odd ones: the word grows with the angle all the way round
// Formats: in_c, in_n sW in any common scale; out_j u2.S modulo 4, rounded to nearest.
// Error: 1/2 LSB of the word. Every quotient bit is exact and the last one rounds, so the word never falls as the angle
// grows. Latency and II: 1 + ceil((S+1) / R); one more at PIPE = 1.
// Status: singular (c = n = 0: the last word is held, 0 after a reset).
// Source: paper eqs. 3 and 9; the signs give the quadrant, which the paper does not recover. Model:
// codecs.vector_to_spread
`default_nettype none
module vector_to_spread_iter #(
    parameter W = 18,        // bits of a coordinate, 2 to 31 (default 18, a unit vector of 16 fraction bits)
    parameter S = 24,        // fraction bits of the joint word, 2 to 31 (default 24)
    parameter R = 3,         // quotient bits a clock, 1 to S (default 3); with PIPE = 1 more than 2 cost clock rate
    parameter PIPE = 0,      // registers behind the squares, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_c,
    input  wire signed [W-1:0] in_n,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire        [S+1:0] out_j,
    output wire        [3:0]   out_status
);
    localparam B = R < 1 ? 1 : R;  // R where it is legal
    localparam M = (S + B) / B;    // clocks of the division
    localparam N = B * M;          // quotient bits; those below the rounding bit are dropped

    generate
        if (W < 2 || W > 31 || S < 2 || S > 31 || R < 1 || R > S || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            vector_to_spread_iter_needs_W_and_S_from_2_to_31_R_from_1_to_S_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    // Schedule, a clock a line
    localparam
        LOAD   = 0,  // divisor and remainder from the squares; at PIPE = 0 in the clock that accepts the vector
        DIVIDE = 1,  // R quotient bits
        LAST   = 2,  // out_valid follows
        BITS   = 3;
    localparam [BITS-1:0] BIT = 1;
    localparam [BITS*(M+1)-1:0] TABLE = {
        /* divisor          */ {BIT << LOAD},
        /* quotient bits    */ {(M-1){BIT << DIVIDE}},
        /* the last of them */ {BIT << DIVIDE | BIT << LAST}};
    wire [BITS-1:0] op;
    wire            idle, load;
    wire            accept = in_valid && in_ready;

    reg  [2*W-1:0] d, rem;
    reg  [1:0]     k;
    reg  [N-1:0]   digits;
    reg            singular;
    wire [2*W-1:0] qc, qn, next_rem;
    wire [B-1:0]   next;
    generate
        if (PIPE == 0) begin : g_small
            assign load = accept;
            assign qc = in_c * in_c;
            assign qn = in_n * in_n;
            schedule #(.LINES(M), .BITS(BITS), .TABLE(TABLE[BITS*M-1:0])) control (.clk(clk), .rst(rst),
                .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_fast
            assign load = op[LOAD];
            product_parts #(.A(W), .B(W), .MULTIPLY(MULTIPLY)) square1 (.clk(clk), .in_move(1'b1), .in_a(in_c),
                .in_b(in_c), .out_p(qc));
            product_parts #(.A(W), .B(W), .MULTIPLY(MULTIPLY)) square2 (.clk(clk), .in_move(1'b1), .in_a(in_n),
                .in_b(in_n), .out_p(qn));
            schedule #(.LINES(M+1), .BITS(BITS), .TABLE(TABLE)) control (.clk(clk), .rst(rst), .in_start(accept),
                .out_idle(idle), .out_op(op));
        end
        if (PIPE == 1 && R == 2) begin : g_both
            // The second digit is tried for both values of the first, so no selector stands between the two sums.
            wire [2*W:0] first = {rem, 1'b0} - {1'b0, d};
            wire [2*W:0] after0 = {rem[2*W-2:0], 2'b00} - {1'b0, d}, after1 = {first[2*W-1:0], 1'b0} - {1'b0, d};
            assign       next = {!first[2*W], first[2*W] ? !after0[2*W] : !after1[2*W]};
            assign       next_rem = first[2*W] ? (after0[2*W] ? {rem[2*W-3:0], 2'b00} : after0[2*W-1:0])
                                               : (after1[2*W] ? {first[2*W-2:0], 1'b0} : after1[2*W-1:0]);
        end else begin : g_digits
            divide_digits #(.K(2*W), .R(B), .WD(2*W)) quotient (.in_rem(rem), .in_d(d), .in_bits({B{1'b0}}),
                .out_rem(next_rem), .out_q(next));
        end
    endgenerate

    wire nothing = ~|in_c && ~|in_n;
    always @(posedge clk) begin
        rem <= load ? qn : next_rem;
        if (load)
            d <= qc + qn;
        if (accept) begin
            singular <= nothing;
            if (!nothing) k <= {in_n[W-1], in_n[W-1] ^ in_c[W-1]};
        end
        if (op[DIVIDE] && !singular) digits <= {digits[N-B-1:0], next ^ {B{k[0]}}};  // 1 - s has the inverted bits of s
        if (rst) begin
            k      <= 2'd0;
            digits <= {N{1'b0}};
        end
    end
    spread_word #(.S(S)) rounding (.in_k(k), .in_f(digits[N-1 -: S+1]), .out_j(out_j));
    wire   unused = &{1'b0, digits, op[LOAD]};

    assign out_status = {2'b00, singular, 1'b0};
    assign in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (op[LAST] || (out_valid && !out_ready));
endmodule
`default_nettype wire
