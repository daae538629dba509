// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints in binary angles: both joints of a tip (x, y) for the requested elbow.
//   q = x^2 + y^2, cos j2 = (q - Q1 - Q2) / 2 L1 L2; j1: direction of (x, y) less that of L1 + L2 (cos j2, sin j2)
// Formats: in_x, in_y s(W-F).F; out_j1, out_j2 angles of A bits modulo a turn, rounded to nearest; cfg_q, cfg_r, cfg_e
// by table.config. Words have more bits with W above 16 and 20.
// Error of the tip at the answered words: bounds.table.ik2, at L1 = L2 = 2^13 from a quarter of the reach on 1.27 LSB
// at A = 18 and 0.94 at A = 24.
// Latency and II: 12 + 14 PIPE, 13 + 18 PIPE with W above 16.
// Status: unreachable (by more than cfg_slack, 2^-14 of cos j2, 2^-18 and 2^-22 with W above 16 and 20; the nearest
// point is answered), singular (within cfg_margin, LSB, of a stretched or folded arm; x = y = 0: j1 is held, 0 after
// a reset).
// Source: rational trigonometry paper, eqs. 18-23, in vector form, and an arc sine of their result. Model: table.ik2
`default_nettype none
module table_ik2 #(
    parameter W = 16,        // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,        // bits of a joint word, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
    parameter PIPE = 0,      // registers behind products and tables, 0 or 1 (default 0: fewest clocks)
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
    input  wire                in_elbow,
    output wire                out_valid,
    input  wire                out_ready,
    output wire [A-1:0]        out_j1,
    output wire [A-1:0]        out_j2,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || A < 10 || A > 24 || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0 || MARGINS < 0 || MARGINS > 1) begin : g_illegal
            table_ik2_needs_W_4_to_24_F_below_W_A_10_to_24_and_PIPE_MARGINS_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate
    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the kernel's coordinates
    localparam          I = N == 16 ? 20 : N + 2;
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}};
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}};
    wire [N-2:0]        margin = {cfg_margin, {(N-W){1'b0}}};
    wire [2:0]          cosine, sine;
    wire [I+3:0]        word;
    wire                flat, negative, none;
    generate
        if (N == 16) begin : g_narrow
            kernel_vector_solve #(.JOINTS(2), .LAG(2), .MARGINS(MARGINS), .U(18), .PIPE(PIPE),
                                  .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack),
                .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .in_z(16'd0), .in_elbow(in_elbow),
                .out_valid(out_valid), .out_ready(out_ready), .out_cos(cosine), .out_sin(sine), .out_word(word),
                .out_flat(flat), .out_negative(negative), .out_none(none), .out_status(out_status));
        end else begin : g_wide
            kernel_vector_wide #(.N(N), .JOINTS(2), .U(I), .LAG(3+3*PIPE), .PIPE(PIPE), .MULTIPLY(MULTIPLY),
                                 .MARGINS(MARGINS)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack), .cfg_shoulder({(N-2){1'b0}}), .cfg_lateral({N{1'b0}}),
                .cfg_bb({(2*N){1'b0}}), .in_back(1'b0),
                .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .in_z({N{1'b0}}), .in_elbow(in_elbow),
                .out_valid(out_valid), .out_ready(out_ready), .out_cos(cosine), .out_sin(sine), .out_word(word),
                .out_flat(flat), .out_negative(negative), .out_none(none), .out_status(out_status));
        end
    endgenerate
    angle_of_vector #(.JOINTS(2), .A(A), .I(I), .PIPE(PIPE)) codec (
        .clk(clk), .rst(rst), .in_cos(cosine), .in_sin(sine), .in_word(word), .in_flat(flat), .in_negative(negative),
        .in_none(none), .out_j({out_j2, out_j1}));
endmodule
`default_nettype wire
