// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of three joints on unit vectors: joint 3 is the direction of (x, y), joints 1 and 2 are those of
// vector_ik2 for (rho, z).
//   (c3, n3) = (x, y) / sqrt(x^2 + y^2), rho = c3 x + n3 y
// Formats: in_* s(W-F).F; out_c*, out_n* cosine and sine of a joint, s2.U, rounded to nearest; cfg_q, cfg_r, cfg_e by
// vector.config. Words have more bits with W above 16 and 20.
// Error of the tip, rounding included: bounds.vector.ik3, 1.04 LSB at L1 = L2 = 2^13 from a quarter of the reach on.
// Latency and II: 19 + 23 PIPE, 19 + 25 PIPE with W above 16.
// Status: unreachable (by more than cfg_slack, 2^-14 of cos j2, 2^-18 and 2^-22 with W above 16 and 20; the nearest
// point is answered), singular (within cfg_margin, LSB, of a stretched or folded arm or of the axis of joint 3;
// x = y = 0: c3, n3 are held; z = 0 too: c1, n1).
// Source: rational trigonometry paper, eqs. 32-40, in vector form. Model: vector.ik3
`default_nettype none
module vector_ik3 #(
    parameter W = 16,        // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,        // fraction bits of cosine and sine, 8 to 16; 20, 24 with W above 16, 20 (default 16)
    parameter PIPE = 0,      // registers behind products, 0 or 1 (default 0: fewest clocks)
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
    output wire signed [U+1:0] out_c1,
    output wire signed [U+1:0] out_n1,
    output wire signed [U+1:0] out_c2,
    output wire signed [U+1:0] out_n2,
    output wire signed [U+1:0] out_c3,
    output wire signed [U+1:0] out_n3,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || U < 8 || U > 16 + 4 * (W > 16) + 4 * (W > 20) || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0 || MARGINS < 0 || MARGINS > 1) begin : g_illegal
            vector_ik3_needs_W_4_to_24_F_below_W_U_8_to_16_20_24_and_PIPE_MARGINS_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate
    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the kernel's coordinates
    localparam          I = N == 16 ? 20 : N + 2;
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}}, z = {in_z, {(N-W){1'b0}}};
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}};
    wire [N-2:0]        margin = {cfg_margin, {(N-W){1'b0}}};
    wire [2:0]          cosine, sine;
    wire [I+3:0]        word;
    wire                flat, negative, none;
    generate
        if (N == 16) begin : g_narrow
            kernel_vector_solve #(.JOINTS(3), .MARGINS(MARGINS), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack), .in_valid(in_valid), .in_ready(in_ready),
                .in_x(x), .in_y(y), .in_z(z), .in_elbow(in_elbow), .out_valid(out_valid), .out_ready(out_ready),
                .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat), .out_negative(negative),
                .out_none(none), .out_status(out_status));
        end else begin : g_wide
            kernel_vector_wide #(.N(N), .JOINTS(3), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY), .MARGINS(MARGINS)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack), .cfg_shoulder({(N-2){1'b0}}), .cfg_lateral({N{1'b0}}),
                .cfg_bb({(2*N){1'b0}}), .in_back(1'b0),
                .in_valid(in_valid), .in_ready(in_ready),
                .in_x(x), .in_y(y), .in_z(z), .in_elbow(in_elbow), .out_valid(out_valid), .out_ready(out_ready),
                .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat), .out_negative(negative),
                .out_none(none), .out_status(out_status));
        end
    endgenerate
    unit_vectors #(.JOINTS(3), .U(U), .I(I)) codec (
        .clk(clk), .rst(rst), .in_cos(cosine), .in_sin(sine), .in_word(word), .in_flat(flat), .in_negative(negative),
        .in_none(none), .out_c({out_c3, out_c2, out_c1}), .out_n({out_n3, out_n2, out_n1}));
endmodule
`default_nettype wire
