// SPDX-License-Identifier: Apache-2.0
// This part rounds a root and gives it a sign (Fig. 8b): out_word = -+in_root / 2^(N-W+1), nearest, ties away from 0.
// Formats: in_root is uN.0, N >= W-1; out_word is sW.0. With N = W-1 nothing is rounded.
// Sign and rounding share one carry: x + 1 inverts the bits up to the lowest 0, -x those above the lowest 1, and
// -(x + 1) inverts every bit.
// The word is +-(2^(W-1) - 1) when in_over is high and when the magnitude would round to 2^(W-1) (out_over).
// Combinational. Model: paper.sign
`default_nettype none
module paper_sign #(
    parameter W = 16,  // bits of the word, 2 or more (default 16)
    parameter N = 16   // digits of the root, W - 1 to 62 (default 16: one digit rounds)
) (
    input  wire        [N-1:0] in_root,
    input  wire                in_negative,
    input  wire                in_over,
    output reg  signed [W-1:0] out_word,
    output wire                out_over
);
    wire         half;  // the bit below the word's LSB
    wire [W-1:0] x = {1'b0, in_root[N-1 -: W-1] | {(W-1){in_over}}};
    generate
        if (W < 2 || N < W - 1 || N > 62) begin : g_illegal
            paper_sign_needs_W_from_2_and_N_from_W_minus_1_to_62 rule ();
        end
        if (N < W) begin : g_exact
            assign half = 1'b0;
            assign out_over = 1'b0;
        end else begin : g_round
            assign half = in_root[N-W] && !in_over && !out_over;
            assign out_over = &in_root[N-1 -: W];
        end
        if (N > W) begin : g_fine
            wire unused = &{1'b0, in_root};
        end
    endgenerate

    reg     toggle;
    integer i;
    always @* begin
        toggle = half;
        for (i = 0; i < W; i = i + 1) begin
            out_word[i] = x[i] ^ toggle;
            toggle = in_negative ? toggle | x[i] : toggle & x[i];
        end
    end
endmodule
`default_nettype wire
