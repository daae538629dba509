// SPDX-License-Identifier: Apache-2.0
// Operands of product_engine that come from ports: a registered multiplexer of COUNT words.
//   out_word = word in_select of in_words, one clock later; any value for in_select from COUNT on
// Formats: words s2.25, word 0 in the lowest bits. Exact. Latency 1. Model: none, it moves words.
`default_nettype none
module engine_ports #(
    parameter COUNT = 2  // words, 1 to 32 (default 2)
) (
    input  wire                clk,
    input  wire [COUNT*27-1:0] in_words,
    input  wire [4:0]          in_select,
    output reg  [26:0]         out_word
);
    generate
        if (COUNT < 1 || COUNT > 32) begin : g_illegal
            engine_ports_needs_COUNT_from_1_to_32 rule ();
        end
    endgenerate

    genvar b, i;
    generate
        for (i = 0; i < 32; i = i + 1) begin : g_word
            wire [26:0] word = in_words[27*(i < COUNT ? i : COUNT-1) +: 27];
        end
        for (b = 0; b < 27; b = b + 1) begin : g_bit
            wire [31:0] column;
            for (i = 0; i < 32; i = i + 1) begin : g_row
                assign column[i] = g_word[i].word[b];
            end
            always @(posedge clk)
                out_word[b] <= column[in_select];
        end
    endgenerate
endmodule
`default_nettype wire
