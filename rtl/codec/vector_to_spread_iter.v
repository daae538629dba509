// SPDX-License-Identifier: Apache-2.0
// Turn-spread word of a direction: s = n^2 / (c^2 + n^2), with the quadrant from the signs, for a vector of any length.
//   out_j = {k, s} in even quadrants, {k, 1 - s} in odd ones: the word grows with the angle all the way round
// Formats: in_c, in_n sW in any common scale; out_j u2.S modulo 4, rounded to nearest.
// Error: 1/2 LSB of the word. Every quotient bit is exact and the last one rounds, so the word never falls as the angle
// grows. Latency and II: 1 + ceil((S+1) / R).
// Status: singular (c = n = 0: the last word is held, 0 after a reset).
// Source: paper eqs. 3 and 9; the signs give the quadrant, which the paper does not recover. Model:
// codecs.vector_to_spread
`default_nettype none
module vector_to_spread_iter #(
    parameter W = 18,  // bits of a coordinate, 2 to 31 (default 18, a unit vector of 16 fraction bits)
    parameter S = 24,  // fraction bits of the joint word, 2 to 31 (default 24)
    parameter R = 3    // quotient bits a clock, 1 to S (default 3); more are faster and larger
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
        if (W < 2 || W > 31 || S < 2 || S > 31 || R < 1 || R > S) begin : g_illegal
            vector_to_spread_iter_needs_W_from_2_to_31_S_from_2_to_31_and_R_from_1_to_S rule ();
        end
    endgenerate

    // Schedule, a clock a line
    localparam [0:0]
        DIVIDE = 1'b1;  // R quotient bits; 1 - s has the inverted bits of s
    localparam [0:0]
        NONE = 1'b0,    // nothing
        LAST = 1'b1;    // out_valid follows
    //                                division end
    localparam [2*M-1:0] TABLE = {
        /* quotient bits    */ {(M-1){DIVIDE,  NONE}},
        /* the last of them */ {      DIVIDE,  LAST}};
    wire divide, last, idle;
    wire accept = in_valid && in_ready;
    schedule #(.LINES(M), .BITS(2), .TABLE(TABLE)) control (
        .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op({divide, last}));

    wire [2*W-1:0] qc = in_c * in_c;
    wire [2*W-1:0] qn = in_n * in_n;
    wire           nothing = ~|in_c && ~|in_n;

    reg  [2*W-1:0] d, rem;
    reg  [1:0]     k;
    reg  [N-1:0]   digits;
    reg            singular;
    wire [2*W-1:0] next_rem;
    wire [B-1:0]   next;
    divide_digits #(.K(2*W), .R(B), .WD(2*W)) quotient (
        .in_rem(rem), .in_d(d), .in_bits({B{1'b0}}), .out_rem(next_rem), .out_q(next));

    always @(posedge clk) begin
        rem <= accept ? qn : next_rem;
        if (accept) begin
            d        <= qc + qn;
            singular <= nothing;
            if (!nothing) k <= {in_n[W-1], in_n[W-1] ^ in_c[W-1]};
        end
        if (divide && !singular) digits <= {digits[N-B-1:0], next ^ {B{k[0]}}};
        if (rst) begin
            k      <= 2'd0;
            digits <= {N{1'b0}};
        end
    end
    spread_word #(.S(S)) rounding (.in_k(k), .in_f(digits[N-1 -: S+1]), .out_j(out_j));
    wire   unused = &{1'b0, digits};

    assign out_status = {2'b00, singular, 1'b0};
    assign in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (last || (out_valid && !out_ready));
endmodule
`default_nettype wire
