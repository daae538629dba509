// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of a real arm that chooses the elbow and the side of the shoulder: arm_ik3 for all four branches,
// then arm_choose. It prefers, in this order, a branch within the joint limits, one in reach, and the one nearest to
// the last answer. Formats: those of arm_ik3; cfg_mc*, cfg_mn* s2.U the middle of a joint's range and cfg_h* s2.U the
// cosine of half the range (arm_keep.limit). out_elbow and out_back are the chosen branch.
// Error of the tip: bounds.arm.ik3. Latency and II: 106 + 20 LATERAL + 8 ABSOLUTE, with PIPE = 1 202 + 4 LATERAL +
// 16 ABSOLUTE, with W above 16, too, 210 + 12 LATERAL + 24 ABSOLUTE, and 28 more with U above 16.
// Status: unreachable (the nearest point in the plane of the arm is answered), singular (a joint without a direction
// takes its word from the last answer), overflow (z - base was saturated). out_beyond: no branch is within the limits;
// the answer is not remembered.
// Source: rational trigonometry paper, eqs. 32-40, in vector form, with the offsets of real arms. Model: arm_keep.keep3
`default_nettype none
module arm_keep3 #(
    parameter W = 16,        // bits of a coordinate and of a length, 8 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,        // fraction bits of cosine and sine, 8 to 16; 20, 24 with W above 16, 20 (default 16)
    parameter BASE = 1,      // 1 (default): with base height; 0: without
    parameter SHOULDER = 1,  // 1 (default): with shoulder offset, radial; 0: without
    parameter LATERAL = 1,   // 1 (default): the arm's plane passes beside the yaw axis; 0: through it
    parameter ELBOW = 1,     // 1 (default): with elbow offset, which turns joint 2 by a constant; 0: without
    parameter ABSOLUTE = 1,  // 1 (default): joint 2 is measured from the base (parallelogram); 0: from link 1
    parameter PIPE = 0,      // registers behind products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
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
    input  wire signed [U+1:0] cfg_mc1,
    input  wire signed [U+1:0] cfg_mn1,
    input  wire signed [U+1:0] cfg_h1,
    input  wire signed [U+1:0] cfg_mc2,
    input  wire signed [U+1:0] cfg_mn2,
    input  wire signed [U+1:0] cfg_h2,
    input  wire signed [U+1:0] cfg_mc3,
    input  wire signed [U+1:0] cfg_mn3,
    input  wire signed [U+1:0] cfg_h3,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_c1,
    output wire signed [U+1:0] out_n1,
    output wire signed [U+1:0] out_c2,
    output wire signed [U+1:0] out_n2,
    output wire signed [U+1:0] out_c3,
    output wire signed [U+1:0] out_n3,
    output wire                out_elbow,
    output wire                out_back,
    output wire                out_beyond,
    output wire [3:0]          out_status
);
    generate
        if (W < 8 || W > 24 || F < 0 || F >= W || U < 8 || U > 16 + 4 * (W > 16) + 4 * (W > 20) || BASE < 0
            || BASE > 1 || SHOULDER < 0 || SHOULDER > 1 || LATERAL < 0 || LATERAL > 1 || ELBOW < 0 || ELBOW > 1
            || ABSOLUTE < 0 || ABSOLUTE > 1 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0) begin : g_illegal
            arm_keep3_needs_W_8_to_24_and_F_below_W_U_8_to_16_20_24_switches_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate
    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the solver's coordinates
    localparam          I = N == 16 ? 20 : N + 2;            // fraction bits of its words
    localparam          T = 3 * (U + 2);
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}};
    wire signed [N-1:0] base = {cfg_base, {(N-W){1'b0}}}, lateral = {cfg_lateral, {(N-W){1'b0}}};
    wire signed [N-3:0] shoulder = {cfg_shoulder, {(N-W){1'b0}}};
    wire                take, go, done, next, ready, flat, negative, none, sin2, n2, by1, kept, turned;
    wire [1:0]          number;
    wire [2:0]          cosine, sine;
    wire [I+3:0]        word;
    wire [3:0]          status;
    wire [T-1:0]        c, n, last_c, last_n;
    reg signed [N-1:0]  x, y, z;
    always @(posedge clk)
        if (take) begin
            x <= {in_x, {(N-W){1'b0}}};
            y <= {in_y, {(N-W){1'b0}}};
            z <= {in_z, {(N-W){1'b0}}};
        end
    generate
        if (N == 16) begin : g_narrow
            arm_solve #(.U(U), .BASE(BASE), .SHOULDER(SHOULDER), .LATERAL(LATERAL), .ABSOLUTE(ABSOLUTE),
                .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_base(base), .cfg_shoulder(shoulder), .cfg_lateral(lateral), .cfg_bb(cfg_bb),
                .cfg_margin({(N-1){1'b0}}), .cfg_slack({(N-3){1'b0}}), .in_valid(go), .in_ready(ready),
                .in_x(x), .in_y(y), .in_z(z), .in_elbow(number[0]), .in_back(number[1]), .out_valid(done),
                .out_ready(next), .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat),
                .out_negative(negative), .out_none(none), .out_sine(sin2), .out_by1(by1), .out_kept(kept),
                .out_turned(turned), .out_status(status));
            assign n2 = 1'b0;
        end else begin : g_wide
            arm_solve_wide #(.N(N), .U(U), .BASE(BASE), .SHOULDER(SHOULDER), .LATERAL(LATERAL), .ABSOLUTE(ABSOLUTE),
                .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_base(base), .cfg_shoulder(shoulder), .cfg_lateral(lateral), .cfg_bb(cfg_bb),
                .cfg_margin({(N-1){1'b0}}), .cfg_slack({(N-3){1'b0}}), .in_valid(go), .in_ready(ready),
                .in_x(x), .in_y(y), .in_z(z), .in_elbow(number[0]), .in_back(number[1]), .out_valid(done),
                .out_ready(next), .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat),
                .out_negative(negative), .out_none(none), .out_sine(sin2), .out_n2(n2), .out_by1(by1),
                .out_kept(kept), .out_turned(turned), .out_status(status));
        end
        if (PIPE >= 0) begin : g_words  // in a block, too, so that Yosys takes them after the solver
            arm_vectors #(.U(U), .I(I), .ELBOW(ELBOW), .ABSOLUTE(ABSOLUTE), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) codec (
                .clk(clk), .rst(rst), .cfg_ce(cfg_ce), .cfg_ne(cfg_ne), .in_cos(cosine), .in_sin(sine), .in_word(word),
                .in_flat(flat), .in_negative(negative), .in_none(none), .in_sine(sin2), .in_n2(n2), .in_by1(by1),
                .in_kept(kept), .in_turned(turned), .in_load(go), .in_last_c(last_c), .in_last_n(last_n), .out_c(c),
                .out_n(n));
            arm_choose #(.JOINTS(3), .BRANCHES(4), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) choice (
                .clk(clk), .rst(rst), .cfg_mc({cfg_mc3, cfg_mc2, cfg_mc1}), .cfg_mn({cfg_mn3, cfg_mn2, cfg_mn1}),
                .cfg_h({cfg_h3, cfg_h2, cfg_h1}), .in_valid(in_valid), .in_ready(in_ready), .out_take(take),
                .out_go(go), .out_number(number), .in_done(done), .out_next(next), .in_c(c), .in_n(n),
                .in_status(status), .out_last_c(last_c), .out_last_n(last_n), .out_valid(out_valid),
                .out_ready(out_ready), .out_c({out_c3, out_c2, out_c1}), .out_n({out_n3, out_n2, out_n1}),
                .out_best({out_back, out_elbow}), .out_beyond(out_beyond), .out_status(out_status));
        end
    endgenerate
    wire unused = &{1'b0, ready};
endmodule
`default_nettype wire
