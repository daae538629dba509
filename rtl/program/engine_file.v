// SPDX-License-Identifier: Apache-2.0
// Registers of engine_datapath: 2^N words, four reads and one write a clock, in four memory blocks.
//   out_a = the word at in_a, one clock later, and so on; in_word is there from the clock after in_write on
// A word that is read in the clock in which it is written is undefined in a memory block. Latency 1. Model: none, it
// holds words.
`default_nettype none
module engine_file #(
    parameter N = 6,     // bits of an address, 6 to 9 (default 6)
    parameter CLEAR = 0  // 0 or 1 (default 0); 1: the words are 0 at power-up
) (
    input  wire         clk,
    input  wire [N-1:0] in_a,
    input  wire [N-1:0] in_b,
    input  wire [N-1:0] in_c,
    input  wire [N-1:0] in_d,
    input  wire         in_write,
    input  wire [N-1:0] in_at,
    input  wire [26:0]  in_word,
    output reg  [26:0]  out_a,
    output reg  [26:0]  out_b,
    output reg  [26:0]  out_c,
    output reg  [26:0]  out_d
);
    (* no_rw_check *) reg [26:0] file_a[0:(1<<N)-1];
    (* no_rw_check *) reg [26:0] file_b[0:(1<<N)-1];
    (* no_rw_check *) reg [26:0] file_c[0:(1<<N)-1];
    (* no_rw_check *) reg [26:0] file_d[0:(1<<N)-1];
    integer i;
    initial
        for (i = 0; i < CLEAR << N; i = i + 1) begin
            file_a[i] = 27'd0;
            file_b[i] = 27'd0;
            file_c[i] = 27'd0;
            file_d[i] = 27'd0;
        end
    always @(posedge clk) begin
        out_a <= file_a[in_a];
        out_b <= file_b[in_b];
        out_c <= file_c[in_c];
        out_d <= file_d[in_d];
        if (in_write) begin
            file_a[in_at] <= in_word;
            file_b[in_at] <= in_word;
            file_c[in_at] <= in_word;
            file_d[in_at] <= in_word;
        end
    end
endmodule
`default_nettype wire
