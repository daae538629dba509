// SPDX-License-Identifier: Apache-2.0
// Turn-spread word of a quadrant and a fraction that has one bit more than the word: rounds to nearest, ties upward.
//   out_j = {in_k, in_f[S:1]} + in_f[0]: a fraction that rounds up to 1 steps into the next quadrant, modulo 4
// Formats: in_f u0.(S+1), the fraction of the quadrant (s in even ones, 1 - s in odd ones); out_j u2.S.
// Error: 1/2 LSB of the word. Combinational. Model: codecs.vector_to_spread
`default_nettype none
module spread_word #(
    parameter S = 24  // fraction bits of a joint word, 1 or more (default 24)
) (
    input  wire [1:0]   in_k,
    input  wire [S:0]   in_f,
    output wire [S+1:0] out_j
);
    generate
        if (S < 1) begin : g_illegal
            spread_word_needs_S_from_1 rule ();
        end
    endgenerate

    assign out_j = {in_k, in_f[S:1]} + {{(S+1){1'b0}}, in_f[0]};
endmodule
`default_nettype wire
