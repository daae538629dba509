// SPDX-License-Identifier: Apache-2.0
// This core finds three joints: joint 3 is the direction of (x, y), rho its length, and rational_ik2 solves (rho, z).
// Formats: in_x to in_z are s(W-F).F; out_j1 to out_j3 are turn-spreads u2.S modulo 4, nearest. rational.config finds
// cfg_q, cfg_r and cfg_e from the lengths cfg_l1 and cfg_l2, u(W-F).F; more bits with W above 16 and 20.
// Error of the tip beyond the rounding of the words: at most 0.94 LSB at L1 = L2 = 2^13 (W = 16) for targets at least
// 256 LSB away with |sin j2| > 2^-8.
// Latency and II: 26 + 19 PIPE, 20 + 27 PIPE with W above 16.
// Status: unreachable (by more than cfg_slack, 2^-14 of cos j2, 2^-18 and 2^-22 with W above 16 and 20; the nearest
// point is answered), singular (within cfg_margin, LSB, of a stretched or folded arm or of the axis of joint 3; x =
// y = 0: out_j3 is held; z = 0 too: out_j1).
// Source: rational-trigonometry paper, eqs. 9 and 18-23 in vector form. Model: rational.ik3
`default_nettype none
module rational_ik3 #(
    parameter W = 16,        // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of a coordinate and a length, 0 to W - 1 (default 8); F changes no logic
    parameter S = 24,        // fraction bits of a turn-spread, 2 to 24, to 40 with W above 16 (default 24)
    parameter PIPE = 0,      // registers behind products and table, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18, // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter MARGINS = 0    // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire signed [(W > 20 ? 49 : W > 16 ? 41 : 33):0] cfg_q,
    input  wire [(W > 20 ? 29 : 25):0] cfg_r,
    input  wire [(W > 16 ? 4 : 3):0] cfg_e,
    input  wire [W-2:0]        cfg_margin,
    input  wire [(W > 20 ? 20 : W > 16 ? 16 : 12):0] cfg_slack,
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
        if (W < 4 || W > 24 || F < 0 || F >= W || S < 2 || S > 24 + 16 * (W > 16) || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0 || MARGINS < 0 || MARGINS > 1) begin : g_illegal
            rational_ik3_needs_W_4_to_24_F_below_W_S_2_to_24_to_40_above_W_16_PIPE_MARGINS_0_or_1_MULTIPLY_18_or_27
                rule ();
        end
    endgenerate
    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the kernel's coordinates
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}},
                        z = {in_z, {(N-W){1'b0}}};
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}};
    wire [N-2:0]        margin = {cfg_margin, {(N-W){1'b0}}};
    generate
        if (N == 16) begin : g_narrow
            wire [2:0]  take;
            wire [1:0]  axis;
            wire        below;
            wire [40:0] square;
            kernel_solve #(.JOINTS(3), .MARGINS(MARGINS), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack), .in_valid(in_valid), .in_ready(in_ready), .in_x(x),
                .in_y(y), .in_z(z), .in_elbow(in_elbow), .out_valid(out_valid), .out_ready(out_ready),
                .out_take(take), .out_axis(axis), .out_below(below), .out_square(square), .out_status(out_status));
            spread_about_axis #(.JOINTS(3), .HELD(3'b101), .S(S), .PIPE(PIPE)) codec (.clk(clk), .rst(rst),
                .in_take(take), .in_axis(axis), .in_below(below), .in_square(square),
                .out_j({out_j3, out_j2, out_j1}));
        end else begin : g_wide
            localparam   I = N + 2;
            wire [2:0]   cosine, sine;
            wire [I+3:0] word;
            wire         flat, negative, none;
            kernel_vector_wide #(.N(N), .JOINTS(3), .U(I), .LAG(1+2*PIPE), .PIPE(PIPE), .MULTIPLY(MULTIPLY),
                                 .MARGINS(MARGINS)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack), .cfg_shoulder({(N-2){1'b0}}), .cfg_lateral({N{1'b0}}),
                .cfg_bb({(2*N){1'b0}}), .in_back(1'b0),
                .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .in_z(z), .in_elbow(in_elbow),
                .out_valid(out_valid), .out_ready(out_ready), .out_cos(cosine), .out_sin(sine), .out_word(word),
                .out_flat(flat), .out_negative(negative), .out_none(none), .out_status(out_status));
            spread_of_vector #(.JOINTS(3), .S(S), .I(I), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) codec (
                .clk(clk), .rst(rst), .in_cos(cosine), .in_sin(sine), .in_word(word), .in_flat(flat),
                .in_negative(negative), .in_none(none), .out_j({out_j3, out_j2, out_j1}));
        end
    endgenerate
endmodule
`default_nettype wire
