// SPDX-License-Identifier: Apache-2.0
// Results of product_engine that are outputs: COUNT registers, written by DEST 2 and on, each rounded to U fraction
// bits.
// Formats: in_word s2.25; words of out_words s2.U, rounded to nearest (ties upward), wrapping from 2 - 2^-(U+1) on; the
// word of DEST 2 in the lowest bits. Error: 1/2 LSB. Latency 1. Model: six.fk6
`default_nettype none
module engine_results #(
    parameter COUNT = 2,  // words, 1 to 62 (default 2)
    parameter U = 16      // fraction bits of a word, 1 to 24 (default 16)
) (
    input  wire                   clk,
    input  wire [26:0]            in_word,
    input  wire [5:0]             in_dest,
    output reg  [COUNT*(U+2)-1:0] out_words
);
    generate
        if (COUNT < 1 || COUNT > 62 || U < 1 || U > 24) begin : g_illegal
            engine_results_needs_COUNT_from_1_to_62_and_U_from_1_to_24 rule ();
        end
    endgenerate

    wire [U+2:0] near = in_word[26:24-U] + 1'b1;
    wire         unused = &{1'b0, in_word[23-U:0], near[0]};
    genvar i;
    generate
        for (i = 0; i < COUNT; i = i + 1) begin : g_word
            localparam [31:0] DEST = i + 2;
            always @(posedge clk)
                if (in_dest == DEST[5:0])
                    out_words[(U+2)*i +: U+2] <= near[U+2:1];
        end
    endgenerate
endmodule
`default_nettype wire
