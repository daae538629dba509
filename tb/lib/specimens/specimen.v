// SPDX-License-Identifier: Apache-2.0
// A register stage that keeps the contract, or breaks it in the way FAULT says:
// 0 sound, 1 out_valid stuck at 0, 2 drops a sample under back-pressure, 3 adds one LSB to some words,
// 4 result changes while it waits, 5 one cycle late after some words, 6 survives a reset, 7 sends twice,
// 8 valid waits for ready, 9 takes a word in a reset, 10 needs two clocks of reset, 11 not ready for a clock after some
// words, 12 and 13 drop a result that waits for more than 64 and 1000 clocks.
`default_nettype none
module specimen #(
    parameter W = 8,     // bits of the word
    parameter FAULT = 0  // see above
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [W-1:0] in_data,
    output wire         out_valid,
    input  wire         out_ready,
    output wire [W-1:0] out_data
);
    reg         full, late, again, rest, earlier;
    reg [9:0]   waited;
    reg [W-1:0] data;
    wire        stalled = full && !out_ready;
    wire        room = FAULT == 2 || !full || out_ready && (FAULT != 7 || again);
    assign in_ready = room && !(FAULT == 11 && rest);
    assign out_valid = FAULT == 1 ? 1'b0 : FAULT == 5 ? full && !late : FAULT == 8 ? full && out_ready : full;
    assign out_data = FAULT == 3 && data[3:0] == 4'd13 ? data + 1'b1 : data;
    always @(posedge clk) begin
        late   <= in_valid && data[0];
        earlier <= rst;
        waited <= stalled ? waited + 1'b1 : 10'd0;
        rest   <= 1'b0;
        if (in_valid && in_ready) begin
            data  <= in_data;
            full  <= 1'b1;
            again <= 1'b0;
            rest  <= in_data[2:0] == 3'd5;
        end else if (out_ready || FAULT == 12 && waited > 10'd64 || FAULT == 13 && waited > 10'd1000) begin
            full  <= FAULT == 7 && full && !again && data[1];
            again <= 1'b1;
        end else if (FAULT == 4 && stalled) data <= data + 1'b1;
        if (rst && FAULT != 6 && !(FAULT == 9 && in_valid) && (FAULT != 10 || earlier)) begin
            full <= 1'b0;
            rest <= 1'b0;
        end
    end
endmodule
`default_nettype wire
