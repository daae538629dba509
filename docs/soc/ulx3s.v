// SPDX-License-Identifier: Apache-2.0
// soc.v on the ULX3S board: 25 MHz, the serial line of the USB socket at 115200 baud, eight lamps.
// Reset: after the configuration, and while button 1 (B2, "fire 1") is pressed.
`default_nettype none
module ulx3s #(
    parameter FIRMWARE = "firmware.hex"
) (
    input  wire       clk_25mhz,
    input  wire       btn1,
    output wire       ftdi_rxd,
    output wire [7:0] led,
    output wire       wifi_gpio0
);
    /* verilator lint_off PROCASSINIT */
    reg [3:0] running = 4'd0;  // two flip-flops more than the button needs against metastability
    /* verilator lint_on PROCASSINIT */
    always @(posedge clk_25mhz)
        running <= {running[2:0], !btn1};
    assign wifi_gpio0 = 1'b1;  // the board's ESP32 stays in its own program
    /* verilator lint_off PINCONNECTEMPTY */
    soc #(.FIRMWARE(FIRMWARE)) system (.clk(clk_25mhz), .rst(!running[3]), .tx(ftdi_rxd), .led(led), .trap());
    /* verilator lint_on PINCONNECTEMPTY */
endmodule
`default_nettype wire
