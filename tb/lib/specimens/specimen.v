// SPDX-License-Identifier: Apache-2.0
// A register stage that keeps the contract, or breaks it in the way FAULT says:
// 0 sound, 1 out_valid stuck at 0, 2 drops a sample under back-pressure, 3 adds one LSB to some words,
// 4 result changes while it waits, 5 one cycle late after a stall, 6 survives a reset, 7 sends twice, 8 valid waits for ready.
`default_nettype none
module specimen #(parameter W = 8, parameter FAULT = 0) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [W-1:0] in_data,
    output wire         out_valid,
    input  wire         out_ready,
    output wire [W-1:0] out_data
);
  reg full, late, again;
  reg [W-1:0] data;
  wire stalled = full && !out_ready;
  assign in_ready = FAULT == 2 ? 1'b1 : FAULT == 7 ? !full || (out_ready && again) : !full || out_ready;
  assign out_valid = FAULT == 1 ? 1'b0 : FAULT == 5 ? full && !late : FAULT == 8 ? full && out_ready : full;
  assign out_data = FAULT == 3 && data[3:0] == 4'd13 ? data + 1'b1 : data;
  always @(posedge clk) begin
    late <= in_valid && data[0];
    if (in_valid && in_ready) begin
      data <= in_data;
      full <= 1'b1;
      again <= 1'b0;
    end else if (out_ready) begin
      full <= FAULT == 7 && full && !again && data[1];
      again <= 1'b1;
    end else if (FAULT == 4 && stalled) data <= data + 1'b1;
    if (rst && FAULT != 6) full <= 1'b0;
  end
  initial {full, late, again} = 3'b000;
endmodule
`default_nettype wire
