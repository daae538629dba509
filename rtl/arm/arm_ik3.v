// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of a real arm on unit vectors: base height, shoulder offset a, lateral offset b, elbow offset and
// an elbow measured from the base, for either elbow and either side of the shoulder. A switch of 0 leaves its part out.
//   rho = +-sqrt(x^2 + y^2 - b^2), (c3, n3) = (x + i y)(rho - i b) / (x^2 + y^2), vector_ik2 on (rho - a, z - base)
// Formats: in_*, cfg_base, cfg_lateral s(W-F).F; cfg_shoulder s(W-F-2).F; out_c*, out_n* s2.U, rounded to nearest;
// other cfg_* by arm.config. Error of the tip: bounds.arm.ik3. Latency and II: 19 + 5 LATERAL + 2 ABSOLUTE; with
// PIPE = 1 42 + LATERAL + 4 ABSOLUTE, with W above 16 44 + 3 LATERAL + 6 ABSOLUTE.
// Status: unreachable (by more than cfg_slack, 2^-14 of cos j2, 2^-18 and 2^-22 with W above 16 and 20, or nearer to
// the yaw axis than b; the nearest point in the plane of the arm is answered), singular (within cfg_margin, LSB, of a
// stretched or folded elbow, or rho is; joint 1 or 3 has no direction and holds its last word, (1, 0) after a reset),
// overflow (z - base was saturated).
// Source: rational trigonometry paper, eqs. 32-40, in vector form, with the offsets of real arms. Model: arm.ik3
`default_nettype none
module arm_ik3 #(
    parameter W = 16,        // bits of a coordinate and of a length, 8 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,        // fraction bits of cosine and sine, 8 to 16; 20, 24 with W above 16, 20 (default 16)
    parameter BASE = 1,      // 1 (default): with base height; 0: without
    parameter SHOULDER = 1,  // 1 (default): with shoulder offset, radial; 0: without
    parameter LATERAL = 1,   // 1 (default): the arm's plane passes beside the yaw axis; 0: through it
    parameter ELBOW = 1,     // 1 (default): with elbow offset, which turns joint 2 by a constant; 0: without
    parameter ABSOLUTE = 1,  // 1 (default): joint 2 is measured from the base (parallelogram); 0: from link 1
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
    input  wire signed [W-1:0] cfg_base,
    input  wire signed [W-3:0] cfg_shoulder,
    input  wire signed [W-1:0] cfg_lateral,
    input  wire signed [(W > 20 ? 47 : W > 16 ? 39 : 31):0] cfg_bb,
    input  wire signed [U+1:0] cfg_ce,
    input  wire signed [U+1:0] cfg_ne,
    input  wire [W-2:0]        cfg_margin,
    input  wire [(W > 20 ? 20 : W > 16 ? 16 : 12):0] cfg_slack,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    input  wire                in_elbow,
    input  wire                in_back,
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
        if (W < 8 || W > 24 || F < 0 || F >= W || U < 8 || U > 16 + 4 * (W > 16) + 4 * (W > 20) || BASE < 0
            || BASE > 1 || SHOULDER < 0 || SHOULDER > 1 || LATERAL < 0 || LATERAL > 1 || ELBOW < 0 || ELBOW > 1
            || ABSOLUTE < 0 || ABSOLUTE > 1 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0 || MARGINS < 0 || MARGINS > 1) begin : g_illegal
            arm_ik3_needs_W_8_to_24_F_below_W_U_8_to_16_20_24_switches_PIPE_MARGINS_0_or_1_MULTIPLY_18_or_27 rule ();
        end
    endgenerate
    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the solver's coordinates
    localparam          I = N == 16 ? 20 : N + 2;            // fraction bits of its words
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}}, z = {in_z, {(N-W){1'b0}}};
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}};
    wire signed [N-1:0] base = {cfg_base, {(N-W){1'b0}}}, lateral = {cfg_lateral, {(N-W){1'b0}}};
    wire signed [N-3:0] shoulder = {cfg_shoulder, {(N-W){1'b0}}};
    wire [N-2:0]        margin = {cfg_margin, {(N-W){1'b0}}};
    wire [2:0]          cosine, sine;
    wire [I+3:0]        word;
    wire                flat, negative, none, sin2, n2, by1, kept, turned;
    generate
        if (N == 16) begin : g_narrow
            arm_solve #(.U(U), .BASE(BASE), .SHOULDER(SHOULDER), .LATERAL(LATERAL), .ABSOLUTE(ABSOLUTE),
                .MARGINS(MARGINS), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_base(base), .cfg_shoulder(shoulder), .cfg_lateral(lateral), .cfg_bb(cfg_bb), .cfg_margin(margin),
                .cfg_slack(cfg_slack), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .in_z(z),
                .in_elbow(in_elbow), .in_back(in_back), .out_valid(out_valid), .out_ready(out_ready),
                .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat), .out_negative(negative),
                .out_none(none), .out_sine(sin2), .out_by1(by1), .out_kept(kept), .out_turned(turned),
                .out_status(out_status));
            assign n2 = 1'b0;
        end else begin : g_wide
            arm_solve_wide #(.N(N), .U(U), .BASE(BASE), .SHOULDER(SHOULDER), .LATERAL(LATERAL), .ABSOLUTE(ABSOLUTE),
                .MARGINS(MARGINS), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_base(base), .cfg_shoulder(shoulder), .cfg_lateral(lateral), .cfg_bb(cfg_bb), .cfg_margin(margin),
                .cfg_slack(cfg_slack), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .in_z(z),
                .in_elbow(in_elbow), .in_back(in_back), .out_valid(out_valid), .out_ready(out_ready),
                .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat), .out_negative(negative),
                .out_none(none), .out_sine(sin2), .out_n2(n2), .out_by1(by1), .out_kept(kept),
                .out_turned(turned), .out_status(out_status));
        end
        if (PIPE >= 0) begin : g_words  // in a block, too, so that Yosys takes them after the solver
            arm_vectors #(.U(U), .I(I), .ELBOW(ELBOW), .ABSOLUTE(ABSOLUTE), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) codec (
                .clk(clk), .rst(rst), .cfg_ce(cfg_ce), .cfg_ne(cfg_ne), .in_cos(cosine), .in_sin(sine), .in_word(word),
                .in_flat(flat), .in_negative(negative), .in_none(none), .in_sine(sin2), .in_n2(n2), .in_by1(by1),
                .in_kept(kept), .in_turned(turned), .in_load(1'b0), .in_last_c({(3*(U+2)){1'b0}}),
                .in_last_n({(3*(U+2)){1'b0}}), .out_c({out_c3, out_c2, out_c1}), .out_n({out_n3, out_n2, out_n1}));
        end
    endgenerate
endmodule
`default_nettype wire
