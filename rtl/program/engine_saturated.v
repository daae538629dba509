// SPDX-License-Identifier: Apache-2.0
// Results of product_engine that are coordinates: COUNT registers, written by DEST FIRST and on, each rounded to
// nearest and saturated.
//   out_over: since in_start a word was saturated
// Formats: in_word s2.25; words of out_words sW with W + FINE fraction bits (1.0 is 2^(W+FINE) LSB), ties upward; the
// word of FIRST in the lowest bits. Error: 1/2 LSB. Latency 1. Model: meaning.results
`default_nettype none
module engine_saturated #(
    parameter COUNT = 3,  // words, 1 to 62 (default 3)
    parameter FIRST = 2,  // register of the first word, 2 to 64 - COUNT (default 2)
    parameter W = 16,     // bits of a word, 4 to 22, with FINE at most 24 (default 16)
    parameter FINE = 0    // fraction bits of a word beyond W, 0 to 8 (default 0)
) (
    input  wire               clk,
    input  wire               in_start,
    input  wire [26:0]        in_word,
    input  wire [5:0]         in_dest,
    output reg  [COUNT*W-1:0] out_words,
    output reg                out_over
);
    generate
        if (COUNT < 1 || FIRST < 2 || FIRST + COUNT > 64 || W < 4 || W > 22 || FINE < 0 || FINE > 8
            || W + FINE > 24) begin : g_illegal
            engine_saturated_needs_COUNT_from_1_FIRST_from_2_both_to_64_W_from_4_to_22_FINE_to_8_both_to_24 rule ();
        end
    endgenerate

    wire [W+FINE+3:0] near = {in_word[26], in_word[26:24-W-FINE]} + 1'b1;
    wire              over = near[W+FINE+3:W] != {(FINE+4){near[W+FINE+3]}};
    wire [W-1:0]      word = over ? {near[W+FINE+3], {(W-1){!near[W+FINE+3]}}} : near[W:1];
    localparam [31:0] START = FIRST, LAST = FIRST + COUNT - 1;
    wire              here = in_dest >= START[5:0] && in_dest <= LAST[5:0];
    wire              unused = &{1'b0, near[0], in_word};
    genvar i;
    generate
        for (i = 0; i < COUNT; i = i + 1) begin : g_word
            localparam [31:0] DEST = FIRST + i;
            always @(posedge clk)
                if (in_dest == DEST[5:0])
                    out_words[W*i +: W] <= word;
        end
    endgenerate
    always @(posedge clk)
        out_over <= !in_start && (out_over || over && here);
endmodule
`default_nettype wire
