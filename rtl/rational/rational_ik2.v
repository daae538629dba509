// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints: both joints of a tip (x, y) for the elbow asked for.
// Formats: in_x, in_y s(W-F).F, out_j1, out_j2 turn-spread u2.S modulo 4, nearest; cfg_*: rational.config.
// Latency 16, II 16; the schedule stands in rational_solve.v.
// Error of the tip <= 0.3 + 2.25 |tip| / 2^16 + 0.62 L2 / 2^15 + dq / |tip| LSB, dq = 264 at L1 = L2 = 2^13: page.
// Status: unreachable (nearest point answered), singular (x = y = 0: out_j1 held). Eqs. 18-23. Model: rational.ik2
`default_nettype none
module rational_ik2 #(
    parameter W = 16,
    parameter F = 8,
    parameter S = 24
) (
    input  wire           clk,
    input  wire           rst,
    input  wire [W-1:0]   cfg_l1,
    input  wire [W-1:0]   cfg_l2,
    input  wire [32:0]    cfg_q,
    input  wire [25:0]    cfg_r,
    input  wire [1:0]     cfg_e,
    input  wire           in_valid,
    output wire           in_ready,
    input  wire [W-1:0]   in_x,
    input  wire [W-1:0]   in_y,
    input  wire           in_elbow,
    output wire           out_valid,
    input  wire           out_ready,
    output wire [S+1:0]   out_j1,
    output wire [S+1:0]   out_j2,
    output wire [3:0]     out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || S < 2 || S > 24) begin : g_illegal
            rational_ik2_needs_W_from_4_to_16_and_F_below_W_and_S_from_2_to_24 rule ();
        end
    endgenerate

    wire [S+1:0] unused_j3;
    wire         unused = &{1'b0, unused_j3};
    assign out_status[3:2] = 2'd0;
    rational_solve #(.JOINTS(2), .S(S)) kernel (
        .clk(clk), .rst(rst), .cfg_l1({cfg_l1, {(16-W){1'b0}}}), .cfg_l2({cfg_l2, {(16-W){1'b0}}}), .cfg_q(cfg_q),
        .cfg_r(cfg_r), .cfg_e(cfg_e), .in_valid(in_valid), .in_ready(in_ready), .in_x({in_x, {(16-W){1'b0}}}),
        .in_y({in_y, {(16-W){1'b0}}}), .in_z(16'd0), .in_elbow(in_elbow), .out_valid(out_valid),
        .out_ready(out_ready), .out_j1(out_j1), .out_j2(out_j2), .out_j3(unused_j3),
        .out_unreachable(out_status[0]), .out_singular(out_status[1]));
endmodule
`default_nettype wire
