// SPDX-License-Identifier: Apache-2.0
// This core finds three joints: joint 3 is the direction of (x, y), rho its length, and rational_ik2 solves (rho, z).
// Formats: in_x to in_z are s(W-F).F; out_j1 to out_j3 are turn-spreads u2.S modulo 4, nearest. rational.config finds
// cfg_q, cfg_r and cfg_e from the lengths cfg_l1 and cfg_l2, u(W-F).F.
// Error of the tip beyond the rounding of the words: at most 0.94 LSB at L1 = L2 = 2^13 (W = 16) for targets at least
// 256 LSB away with |sin j2| > 2^-8.
// Latency and II: 26 + 19 PIPE.
// Status: unreachable (by more than cfg_slack, 2^-14 of cos j2; the nearest point is answered), singular (within
// cfg_margin, LSB, of a stretched or folded arm or of the axis of joint 3; x = y = 0: out_j3 is held; z = 0 too:
// out_j1).
// Source: rational-trigonometry paper, eqs. 9 and 18-23 in vector form. Model: rational.ik3
`default_nettype none
module rational_ik3 #(
    parameter W = 16,        // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,         // fraction bits of a coordinate and a length, 0 to W - 1 (default 8); F changes no logic
    parameter S = 24,        // fraction bits of a turn-spread, 2 to 24 (default 24: 0.014 degrees at a quadrant border)
    parameter PIPE = 0,      // registers behind products and table, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18, // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter MARGINS = 0    // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire signed [33:0]  cfg_q,
    input  wire [25:0]         cfg_r,
    input  wire [3:0]          cfg_e,
    input  wire [W-2:0]        cfg_margin,
    input  wire [12:0]         cfg_slack,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    input  wire                in_elbow,
    output wire                out_valid,
    input  wire                out_ready,
    output wire [S+1:0]        out_j1,
    output wire [S+1:0]        out_j2,
    output wire [S+1:0]        out_j3,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || S < 2 || S > 24 || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0 || MARGINS < 0 || MARGINS > 1) begin : g_illegal
            rational_ik3_needs_W_4_to_16_and_F_below_W_and_S_2_to_24_and_PIPE_MARGINS_0_or_1_and_MULTIPLY_18_or_27
                rule ();
        end
    endgenerate
    wire signed [15:0] x = {in_x, {(16-W){1'b0}}}, y = {in_y, {(16-W){1'b0}}}, z = {in_z, {(16-W){1'b0}}};
    wire [2:0]         take;
    wire [1:0]         axis;
    wire               below;
    wire [40:0]        square;
    wire [14:0]        margin = {cfg_margin, {(16-W){1'b0}}};
    kernel_solve #(.JOINTS(3), .MARGINS(MARGINS), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
        .clk(clk), .rst(rst), .cfg_l1({cfg_l1, {(16-W){1'b0}}}), .cfg_l2({cfg_l2, {(16-W){1'b0}}}), .cfg_q(cfg_q),
        .cfg_r(cfg_r), .cfg_e(cfg_e), .cfg_margin(margin), .cfg_slack(cfg_slack), .in_valid(in_valid),
        .in_ready(in_ready), .in_x(x), .in_y(y), .in_z(z), .in_elbow(in_elbow), .out_valid(out_valid),
        .out_ready(out_ready), .out_take(take), .out_axis(axis), .out_below(below), .out_square(square),
        .out_status(out_status));
    spread_about_axis #(.JOINTS(3), .HELD(3'b101), .S(S), .PIPE(PIPE)) codec (.clk(clk), .rst(rst), .in_take(take),
        .in_axis(axis), .in_below(below), .in_square(square), .out_j({out_j3, out_j2, out_j1}));
endmodule
`default_nettype wire
