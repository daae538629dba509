// SPDX-License-Identifier: Apache-2.0
// One sample at a time from registers to a core in the same clock, and its result back.
// `start` offers the sample; `finished` is high in the clock in which the core's result stands, and is captured.
// Nothing is started while busy. Reset: all registers.
`default_nettype none
module register_link (
    input  wire clk,
    input  wire rst,
    input  wire start,
    output reg  busy,
    output wire capture,
    output wire finished,
    output reg  in_valid,
    input  wire in_ready,
    input  wire out_valid,
    output wire out_ready
);
    assign out_ready = 1'b1;
    assign capture = out_valid;
    assign finished = out_valid;
    always @(posedge clk)
        if (rst) begin
            busy     <= 1'b0;
            in_valid <= 1'b0;
        end else begin
            busy     <= start || (busy && !out_valid);
            in_valid <= start || (in_valid && !in_ready);
        end
endmodule
`default_nettype wire
