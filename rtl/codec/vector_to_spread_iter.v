// SPDX-License-Identifier: Apache-2.0
// Turn-spread word of a direction: s = n^2 / (c^2 + n^2), quadrant by the signs; any length, so no division before it.
//   out_j = {k, s} in even quadrants, {k, 1 - s} in odd ones: the word grows with the angle all the way round
// Formats: in_c in_n sW (one scale, any); out_j u2.S modulo 4, rounded to nearest.
// Error: <= 1/2 LSB of the word (every quotient bit is exact, the last one rounds), so never falling with the angle.
// Latency and II: 1 + ceil((S+1) / R). Clock 1: squares and their sum; then R quotient bits a clock.
// Status: singular (c = n = 0 has no direction: the last word is held)
// Source: paper eq. 3 and eq. 9; the quadrant by signs, which the paper does not recover
// Model: codecs.vector_to_spread
`default_nettype none
module vector_to_spread_iter #(
    parameter W = 18,
    parameter S = 24,
    parameter R = 3
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [W-1:0] in_c,
    input  wire [W-1:0] in_n,
    output reg          out_valid,
    input  wire         out_ready,
    output wire [S+1:0] out_j,
    output wire [3:0]   out_status
);
    localparam M = (S + R) / R;  // clocks of the division
    localparam N = R * M;        // quotient bits, those below the rounding bit are dropped

    generate
        if (W < 2 || W > 31 || S < 2 || S > 31 || R < 1 || R > S) begin : g_illegal
            vector_to_spread_iter_needs_W_from_2_to_31_S_from_2_to_31_and_R_from_1_to_S rule ();
        end
    endgenerate

    wire             accept = in_valid && in_ready;
    wire [2*W-1:0]   qc = $signed(in_c) * $signed(in_c);
    wire [2*W-1:0]   qn = $signed(in_n) * $signed(in_n);
    wire             nothing = ~|in_c && ~|in_n;

    reg  [2*W-1:0]   d, rem;
    reg  [1:0]       k;
    reg  [N-1:0]     digits;
    reg              singular;
    reg  [M-1:0]     step;  // one-hot, M-1 down to 0
    wire [2*W-1:0]   next_rem;
    wire [R-1:0]     next;

    divide_digits #(.K(2*W), .R(R), .WD(2*W)) divide (
        .in_rem(rem), .in_d(d), .in_bits({R{1'b0}}), .out_rem(next_rem), .out_q(next));

    always @(posedge clk) begin
        if (accept) begin
            d        <= qc + qn;
            rem      <= qn;
            singular <= nothing;
        end else
            rem <= next_rem;
        if (rst) begin
            k      <= 2'd0;
            digits <= {N{1'b0}};
        end else begin
            if (accept && !nothing) k <= {in_n[W-1], in_n[W-1] ^ in_c[W-1]};
            // 1 - s has the inverted digits of s
            if (|step && !singular) digits <= {digits[N-R-1:0], next ^ {R{k[0]}}};
        end
    end

    // the carry of the rounding steps into the next quadrant: s = 1 there is the border between the two
    assign out_j = {k, digits[N-1 -: S]} + {{(S+1){1'b0}}, digits[N-S-1]};
    wire   unused = &{1'b0, digits};
    assign out_status = {2'b00, singular, 1'b0};
    assign in_ready = ~|step && (!out_valid || out_ready);
    always @(posedge clk) begin
        step      <= {accept, {(M-1){1'b0}}} | step >> 1;
        out_valid <= step[0] || (out_valid && !out_ready);
        if (rst) begin
            step      <= {M{1'b0}};
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
