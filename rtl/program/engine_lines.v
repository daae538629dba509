// SPDX-License-Identifier: Apache-2.0
// Program memory of kinematics_engine: 2^N lines of {sealed, header, 48 bits}, one address.
//   out_line = the line at in_at, one clock later; in_store writes in_line there
// A line that is read in the clock in which it is written is undefined in a memory block.
// Latency 1. Model: none, it holds lines.
`default_nettype none
module engine_lines #(
    parameter N = 10  // bits of an address, 6 to 12 (default 10)
) (
    input  wire         clk,
    input  wire [N-1:0] in_at,
    input  wire         in_store,
    input  wire [49:0]  in_line,
    output reg  [49:0]  out_line
);
    (* no_rw_check *) reg [49:0] lines[0:(1<<N)-1];
    always @(posedge clk) begin
        out_line <= lines[in_at];
        if (in_store)
            lines[in_at] <= in_line;
    end
endmodule
`default_nettype wire
