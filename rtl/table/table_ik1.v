// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of one joint: the direction of (x, y) as a binary angle; no length is needed.
//   j1 = axis + arctan(m / M), M the coordinate that is longer in bits, m the other one; with W above 16 it is the arc
//   sine of the unit vector of (x, y), as in table_ik2
// Formats: in_x, in_y s(W-F).F; out_j1 angle of A bits modulo a turn, rounded to nearest.
// Error: the direction is within 0.421 * 2^-14 rad of those that round to the word at A = 18, 0.324 * 2^-14 at A = 24;
// bounds.table.direction for W above 16. Latency and II: 4 + 4 PIPE, 12 + 11 PIPE with W above 16.
// Status: singular (x = y = 0: the last word is held, 0 after a reset).
// Source: the definition; tables of 1/M and of the arc tangent. Model: table.ik1
`default_nettype none
module table_ik1 #(
    parameter W = 16,        // bits of a coordinate, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,        // bits of a joint word, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
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
    output wire [A-1:0]        out_j1,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || A < 10 || A > 24 || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            table_ik1_needs_W_4_to_24_and_F_below_W_and_A_10_to_24_and_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the kernel's coordinates
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}};
    generate
        if (N == 16) begin : g_narrow
            wire        take, last;
            wire [1:0]  axis;
            wire [19:0] tangent;
            kernel_tangent #(.PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y),
                .out_valid(out_valid), .out_ready(out_ready), .out_take(take), .out_last(last), .out_axis(axis),
                .out_tangent(tangent), .out_status(out_status));
            angle_about_axis #(.A(A), .PIPE(PIPE)) codec (
                .clk(clk), .in_last(last), .in_take(take), .in_axis(axis), .in_tangent(tangent), .out_j(out_j1));
        end else begin : g_wide
            localparam   I = N + 2;
            wire         cosine, sine, none;
            wire [I+3:0] word;
            /* verilator lint_off PINCONNECTEMPTY */
            kernel_vector_wide_aim #(.N(N), .U(I), .LAG(3+3*PIPE), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y),
                .out_valid(out_valid), .out_ready(out_ready), .out_c(), .out_n(), .out_cos(cosine), .out_sin(sine),
                .out_word(word), .out_none(none), .out_status(out_status));
            /* verilator lint_on PINCONNECTEMPTY */
            angle_of_vector #(.JOINTS(1), .A(A), .I(I), .PIPE(PIPE)) codec (
                .clk(clk), .rst(rst), .in_cos({2'd0, cosine}), .in_sin({2'd0, sine}), .in_word(word), .in_flat(1'b0),
                .in_negative(1'b0), .in_none(none), .out_j(out_j1));
        end
    endgenerate
endmodule
`default_nettype wire
