// SPDX-License-Identifier: Apache-2.0
// Words that the lines of kinematics_engine find at a port: 2^N of them, one read and one write a clock.
//   out_word = the word at in_read, one clock later; in_store writes in_word at in_at
// A word that is read in the clock in which it is written is undefined in a memory block. The words are 0 at power-up.
// Latency 1. Model: none, it holds words.
`default_nettype none
module engine_words #(
    parameter N = 8  // bits of an address, 7 to 9 (default 8)
) (
    input  wire         clk,
    input  wire [N-1:0] in_read,
    input  wire [N-1:0] in_at,
    input  wire         in_store,
    input  wire [26:0]  in_word,
    output reg  [26:0]  out_word
);
    (* no_rw_check *) reg [26:0] held[0:(1<<N)-1];
    integer             i;
    initial
        for (i = 0; i < 1 << N; i = i + 1)
            held[i] = 27'd0;
    always @(posedge clk) begin
        out_word <= held[in_read];
        if (in_store)
            held[in_at] <= in_word;
    end
endmodule
`default_nettype wire
