// SPDX-License-Identifier: Apache-2.0
// Codec of turn-spreads: the cosine, then the sine of a joint word, each as a product: root = out_w * out_slope / 2^34.
//   |cos| = sqrt(1 - s), |sin| = sqrt(s); odd quadrants hold 1 - s, so they swap the word and its complement
// Formats: in_j turn-spread u2.S; out_w u19 and out_negative in the clock of in_cos or in_sin, out_slope u17 one later.
// Error: 0.52 * 2^-15, that of root_product; 0 and 1 are exact. in_cos loads the word, in_sin uses the loaded word;
// they exclude each other. Latency 1, II 1.
// Source: paper, eqs. 51 and 52. Model: arith.root_product
`default_nettype none
module spread_product #(
    parameter S = 24  // fraction bits of the word, 1 to 24 (default 24, 0.014 degrees at a quadrant border)
) (
    input  wire         clk,
    input  wire         in_cos,
    input  wire         in_sin,
    input  wire [S+1:0] in_j,
    output wire         out_negative,
    output wire [18:0]  out_w,
    output wire [16:0]  out_slope
);
    reg  [S+1:0] kept;
    wire [S+1:0] word = in_sin ? kept : in_j;
    assign out_negative = word[S+1] ^ (!in_sin & word[S]);
    always @(posedge clk)
        if (in_cos)
            kept <= in_j;

    root_product #(.S(S), .B(17)) product (.clk(clk), .in_read(in_cos || in_sin), .in_v(word[S-1:0]),
        .in_not(in_sin == word[S]), .out_w(out_w), .out_slope(out_slope));
endmodule
`default_nettype wire
