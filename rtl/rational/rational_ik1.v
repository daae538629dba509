// SPDX-License-Identifier: Apache-2.0
// This core finds the turn-spread of the direction of (x, y). It needs no length.
//   out_j1 = the nearer axis (k quarter turns) +- s, s = m^2 / q, q = x^2 + y^2, m is the coordinate across that axis;
//   with W above 16 s is the square of a coordinate of the unit vector of (x, y), as in rational_ik2
// Formats: in_x and in_y are s(W-F).F; out_j1 is a turn-spread u2.S modulo 4, nearest, ties anticlockwise.
// Error: the direction is within 0.48 * 2^-14 rad of those that round to the word: 0.48 LSB at a tip 2^14 LSB away;
// bounds.rational.direction for W above 16. Latency and II: 5 + 5 PIPE, 10 + 10 PIPE with W above 16.
// Status: singular (x = y = 0: the last word is held, 0 after a reset).
// Source: rational-trigonometry paper, eq. 9, which does not recover the quadrant. Model: rational.ik1
`default_nettype none
module rational_ik1 #(
    parameter W = 16,        // bits of a coordinate, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of a coordinate, 0 to W - 1 (default 8); F changes no logic
    parameter S = 24,        // fraction bits of a turn-spread, 2 to 24, to 40 with W above 16 (default 24)
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
        if (W < 4 || W > 24 || F < 0 || F >= W || S < 2 || S > 24 + 16 * (W > 16) || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            rational_ik1_needs_W_4_to_24_F_below_W_S_2_to_24_to_40_above_W_16_PIPE_0_or_1_MULTIPLY_18_or_27
                rule ();
        end
    endgenerate

    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the kernel's coordinates
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}};
    generate
        if (N == 16) begin : g_narrow
            wire               take;
            wire [1:0]         axis;
            wire signed [40:0] square;
            kernel_aim #(.PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y),
                .out_valid(out_valid), .out_ready(out_ready), .out_take(take), .out_axis(axis), .out_square(square),
                .out_status(out_status));
            spread_from_axis #(.S(S), .PIPE(PIPE)) codec (
                .clk(clk), .rst(rst), .in_take(take), .in_axis(axis), .in_square(square), .out_j(out_j1));
        end else begin : g_wide
            localparam   I = N + 2;
            wire         cosine, sine, none;
            wire [I+3:0] word;
            /* verilator lint_off PINCONNECTEMPTY */
            kernel_vector_wide_aim #(.N(N), .U(I), .LAG(1+2*PIPE), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y),
                .out_valid(out_valid), .out_ready(out_ready), .out_c(), .out_n(), .out_cos(cosine), .out_sin(sine),
                .out_word(word), .out_none(none), .out_status(out_status));
            /* verilator lint_on PINCONNECTEMPTY */
            spread_of_vector #(.JOINTS(1), .S(S), .I(I), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) codec (
                .clk(clk), .rst(rst), .in_cos({2'd0, cosine}), .in_sin({2'd0, sine}), .in_word(word), .in_flat(1'b0),
                .in_negative(1'b0), .in_none(none), .out_j(out_j1));
        end
    endgenerate
endmodule
`default_nettype wire
