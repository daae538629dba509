// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of three joints in the plane: all joints of a tip (x, y) whose last link points along phi, for the
// requested elbow.
//   the wrist (x, y) - L3 (cos phi, sin phi), then table_ik2, then j3 = phi - j1 - j2
// Formats: in_x, in_y s(W-F).F; in_phi, out_j* angles of A bits modulo a turn, j1 and j2 rounded to nearest; the three
// words add up to in_phi exactly. cfg_l3 u(W-F).F; cfg_q, cfg_r, cfg_e by table.config.
// Error of the tip: that of table_ik2, and sqrt(2) (1/2 + 1.62 L3 / 2^16) for the wrist in 16-bit words
// (bounds.table.ik3r). Latency and II: 16 + 17 PIPE, 17 + 22 PIPE with W above 16.
// Status: unreachable (by more than cfg_slack, 2^-14 of cos j2, 2^-18 and 2^-22 with W above 16 and 20; the wrist is at
// its nearest point), singular (within cfg_margin, LSB, of a stretched or folded arm; the wrist is the shoulder: j1 is
// held), overflow (the wrist was saturated).
// Source: Newton-Raphson paper, eq. 14, in closed form. Model: table.ik3r
`default_nettype none
module table_ik3r #(
    parameter W = 16,        // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,        // bits of a joint word, 10 to 24, from 12 with W above 20 (default 18); 2^A to the turn
    parameter PIPE = 0,      // registers behind products and tables, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18, // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter MARGINS = 0    // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire [W-1:0]        cfg_l3,
    input  wire signed [(W > 20 ? 49 : W > 16 ? 41 : 33):0] cfg_q,
    input  wire [(W > 20 ? 29 : 25):0] cfg_r,
    input  wire [(W > 16 ? 4 : 3):0] cfg_e,
    input  wire [W-2:0]        cfg_margin,
    input  wire [(W > 20 ? 20 : W > 16 ? 16 : 12):0] cfg_slack,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire [A-1:0]        in_phi,
    input  wire                in_elbow,
    output wire                out_valid,
    input  wire                out_ready,
    output wire [A-1:0]        out_j1,
    output wire [A-1:0]        out_j2,
    output wire [A-1:0]        out_j3,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || A < 10 + 2 * (W > 20) || A > 24 || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0 || MARGINS < 0 || MARGINS > 1) begin : g_illegal
            table_ik3r_needs_W_4_to_24_F_below_W_A_10_to_24_from_12_above_W_20_PIPE_MARGINS_0_or_1_MULTIPLY_18_or_27
                rule ();
        end
    endgenerate
    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the kernel's coordinates
    localparam          I = N == 16 ? 20 : N + 2;
    wire signed [N-1:0] tip_x = {in_x, {(N-W){1'b0}}}, tip_y = {in_y, {(N-W){1'b0}}};
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}}, l3 = {cfg_l3, {(N-W){1'b0}}};
    wire [N-2:0]        margin = {cfg_margin, {(N-W){1'b0}}};
    wire signed [N-1:0] x, y;
    wire                idle, ready, start, overflow;
    wire                accept = in_valid && in_ready;
    reg                 elbow;
    assign              in_ready = idle && ready;
    always @(posedge clk)
        if (accept)
            elbow <= in_elbow;
    kernel_wrist #(.N(N), .A(A), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) wrist (
        .clk(clk), .rst(rst), .cfg_l3(l3), .in_start(accept), .in_x(tip_x), .in_y(tip_y), .in_phi(in_phi),
        .in_j1(out_j1), .in_j2(out_j2), .out_idle(idle), .out_start(start), .out_x(x), .out_y(y), .out_j3(out_j3),
        .out_overflow(overflow));
    wire [2:0]          cosine, sine;
    wire [I+3:0]        word;
    wire                flat, negative, none;
    wire [3:0]          status;
    assign              out_status = {status[3], overflow || status[2], status[1:0]};
    generate
        if (N == 16) begin : g_narrow
            kernel_vector_solve #(.JOINTS(2), .LAG(2), .MARGINS(MARGINS), .U(18), .PIPE(PIPE),
                                  .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack),
                .in_valid(start), .in_ready(ready), .in_x(x), .in_y(y), .in_z(16'd0), .in_elbow(elbow),
                .out_valid(out_valid), .out_ready(out_ready), .out_cos(cosine), .out_sin(sine), .out_word(word),
                .out_flat(flat), .out_negative(negative), .out_none(none), .out_status(status));
        end else begin : g_wide
            kernel_vector_wide #(.N(N), .JOINTS(2), .U(I), .LAG(3+3*PIPE), .PIPE(PIPE), .MULTIPLY(MULTIPLY),
                                 .MARGINS(MARGINS)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack), .cfg_shoulder({(N-2){1'b0}}), .cfg_lateral({N{1'b0}}),
                .cfg_bb({(2*N){1'b0}}), .in_back(1'b0),
                .in_valid(start), .in_ready(ready), .in_x(x), .in_y(y), .in_z({N{1'b0}}), .in_elbow(elbow),
                .out_valid(out_valid), .out_ready(out_ready), .out_cos(cosine), .out_sin(sine), .out_word(word),
                .out_flat(flat), .out_negative(negative), .out_none(none), .out_status(status));
        end
    endgenerate
    angle_of_vector #(.JOINTS(2), .A(A), .I(I), .PIPE(PIPE)) codec (
        .clk(clk), .rst(rst), .in_cos(cosine), .in_sin(sine), .in_word(word), .in_flat(flat), .in_negative(negative),
        .in_none(none), .out_j({out_j2, out_j1}));
endmodule
`default_nettype wire
