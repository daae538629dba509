// SPDX-License-Identifier: Apache-2.0
// This core is one stage of an AXI-Stream pipeline with a registered ready: it cuts every path at full throughput.
// in_ready falls one clock after the output stalls; the word of that clock waits in `skid`, which is filled only while
// out_valid is high. Words pass unchanged.
// Latency and II: 1. Status: none.
// Model: arith.skid_buffer
`default_nettype none
module skid_buffer #(
    parameter W = 16  // bits of a word, 1 or more (default 16)
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_valid,
    output reg          in_ready,
    input  wire [W-1:0] in_d,
    output reg          out_valid,
    input  wire         out_ready,
    output reg  [W-1:0] out_d
);
    generate
        if (W < 1) begin : g_illegal
            skid_buffer_needs_W_from_1 rule ();
        end
    endgenerate
    reg  [W-1:0] skid;
    wire move = !out_valid || out_ready;
    always @(posedge clk) begin
        if (in_ready) skid <= in_d;
        if (move) out_d <= in_ready ? in_d : skid;
    end
    always @(posedge clk)
        if (rst) begin
            in_ready  <= 1'b1;
            out_valid <= 1'b0;
        end else begin
            in_ready <= move || (in_ready && !in_valid);
            if (move) out_valid <= in_valid || !in_ready;
        end
endmodule
`default_nettype wire
