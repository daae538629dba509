// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints that chooses the elbow: vector_ik2 for both elbows, then arm_choose. It prefers, in
// this order, an elbow within the joint limits, one in reach, and the one nearest to the last answer.
// Formats: in_x, in_y s(W-F).F; out_c*, out_n* s2.U, rounded to nearest; cfg_mc*, cfg_mn* s2.U the middle of a joint's
// range and cfg_h* s2.U the cosine of half the range (arm_keep.limit); other cfg_* by kernel_vector_wide.config.
// out_elbow is the chosen elbow.
// Error of the tip: bounds.vector.ik2, 0.59 LSB at L1 = L2 = 2^13 from a quarter of the reach on.
// Latency and II: 32 + 26 PIPE; with W above 16 32 + 32 PIPE, with U above 16, too, 32 + 42 PIPE.
// Status: unreachable (the nearest point is answered), singular (x = y = 0: joint 1 takes its word from the last
// answer). out_beyond: no branch is within the limits; the answer is not remembered.
// Source: rational trigonometry paper, eqs. 18-23, in vector form. Model: arm_keep.keep2
`default_nettype none
module arm_keep2 #(
    parameter W = 16,  // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter F = 8,   // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 16; 20, 24 with W above 16, 20 (default 16)
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
    input  wire signed [U+1:0] cfg_mc1,
    input  wire signed [U+1:0] cfg_mn1,
    input  wire signed [U+1:0] cfg_h1,
    input  wire signed [U+1:0] cfg_mc2,
    input  wire signed [U+1:0] cfg_mn2,
    input  wire signed [U+1:0] cfg_h2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_c1,
    output wire signed [U+1:0] out_n1,
    output wire signed [U+1:0] out_c2,
    output wire signed [U+1:0] out_n2,
    output wire                out_elbow,
    output wire                out_beyond,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || U < 8 || U > 16 + 4 * (W > 16) + 4 * (W > 20) || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            arm_keep2_needs_W_4_to_24_F_below_W_U_8_to_16_20_24_and_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate
    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the kernel's coordinates
    localparam          I = N == 16 ? 20 : N + 2, T = U + 2;
    wire                take, go, done, next;
    wire [1:0]          number, best;
    wire [2:0]          cosine, sine;
    wire [I+3:0]        word;
    wire                flat, negative, none, ready;
    wire [3:0]          status;
    wire [3*T-1:0]      c, n;
    wire [2*T-1:0]      last_c, last_n;
    reg signed [W-1:0]  x, y;
    always @(posedge clk)
        if (take) begin
            x <= in_x;
            y <= in_y;
        end
    wire signed [N-1:0] aligned_x = {x, {(N-W){1'b0}}}, aligned_y = {y, {(N-W){1'b0}}};
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}};
    generate
        if (N == 16) begin : g_narrow
            kernel_vector_solve #(.JOINTS(2), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(15'd0), .cfg_slack(13'd0), .in_valid(go), .in_ready(ready), .in_x(aligned_x),
                .in_y(aligned_y), .in_z(16'd0), .in_elbow(number[0]), .out_valid(done), .out_ready(next),
                .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat), .out_negative(negative),
                .out_none(none), .out_status(status));
        end else begin : g_wide
            kernel_vector_wide #(.N(N), .JOINTS(2), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin({(N-1){1'b0}}), .cfg_slack({(N-3){1'b0}}), .in_valid(go), .in_ready(ready),
                .in_x(aligned_x), .in_y(aligned_y), .in_z({N{1'b0}}), .in_elbow(number[0]), .out_valid(done),
                .out_ready(next), .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat),
                .out_negative(negative), .out_none(none), .out_status(status));
        end
        if (PIPE >= 0) begin : g_words  // in a block, too, so that Yosys takes them after the solver
            arm_vectors #(.U(U), .I(I), .ELBOW(0), .ABSOLUTE(0), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) codec (
                .clk(clk), .rst(rst), .cfg_ce({T{1'b0}}), .cfg_ne({T{1'b0}}), .in_cos(cosine), .in_sin(sine),
                .in_word(word), .in_flat(flat), .in_negative(negative), .in_none(none), .in_sine(1'b0), .in_n2(1'b0),
                .in_by1(1'b0), .in_kept(1'b0), .in_turned(1'b0), .in_load(go), .in_last_c({{T{1'b0}}, last_c}),
                .in_last_n({{T{1'b0}}, last_n}), .out_c(c), .out_n(n));
            arm_choose #(.JOINTS(2), .BRANCHES(2), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) choice (
                .clk(clk), .rst(rst), .cfg_mc({cfg_mc2, cfg_mc1}), .cfg_mn({cfg_mn2, cfg_mn1}),
                .cfg_h({cfg_h2, cfg_h1}), .in_valid(in_valid), .in_ready(in_ready), .out_take(take), .out_go(go),
                .out_number(number), .in_done(done), .out_next(next), .in_c(c[2*T-1:0]), .in_n(n[2*T-1:0]),
                .in_status(status), .out_last_c(last_c), .out_last_n(last_n), .out_valid(out_valid),
                .out_ready(out_ready), .out_c({out_c2, out_c1}), .out_n({out_n2, out_n1}), .out_best(best),
                .out_beyond(out_beyond), .out_status(out_status));
        end
    endgenerate
    assign out_elbow = best[0];
    wire   unused = &{1'b0, number[1], best[1], ready, c[3*T-1:2*T], n[3*T-1:2*T]};
endmodule
`default_nettype wire
