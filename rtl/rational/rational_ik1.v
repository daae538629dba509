// SPDX-License-Identifier: Apache-2.0
// This core finds the turn-spread of the direction of (x, y). It needs no length.
//   out_j1 = the nearer axis (k quarter turns) +- s, s = m^2 / q, q = x^2 + y^2, m is the coordinate across that axis
// Formats: in_x and in_y are s(W-F).F; out_j1 is a turn-spread u2.S modulo 4, nearest, ties anticlockwise.
// Error: the direction is within 0.48 * 2^-14 rad of those that round to the word: 0.48 LSB at a tip 2^14 LSB away.
// Latency and II: 5 + 5 PIPE.
// Status: singular (x = y = 0: the last word is held, 0 after a reset).
// Source: rational-trigonometry paper, eq. 9, which does not recover the quadrant. Model: rational.ik1
`default_nettype none
module rational_ik1 #(
    parameter W = 16,        // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,         // fraction bits of a coordinate, 0 to W - 1 (default 8); F changes no logic
    parameter S = 24,        // fraction bits of a turn-spread, 2 to 24 (default 24: 0.014 degrees at a quadrant border)
    parameter PIPE = 0,      // registers behind products and tables, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire                out_valid,
    input  wire                out_ready,
    output wire [S+1:0]        out_j1,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || S < 2 || S > 24 || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            rational_ik1_needs_W_4_to_16_and_F_below_W_and_S_2_to_24_and_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    wire signed [15:0] x = {in_x, {(16-W){1'b0}}}, y = {in_y, {(16-W){1'b0}}};
    wire               take;
    wire [1:0]         axis;
    wire signed [40:0] square;
    kernel_aim #(.PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .out_valid(out_valid),
        .out_ready(out_ready), .out_take(take), .out_axis(axis), .out_square(square), .out_status(out_status));
    spread_from_axis #(.S(S), .PIPE(PIPE)) codec (
        .clk(clk), .rst(rst), .in_take(take), .in_axis(axis), .in_square(square), .out_j(out_j1));
endmodule
`default_nettype wire
