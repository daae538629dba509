// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of three joints, the paper's way: two links in a plane that turns with joint 3, both elbows.
//   s3 = qy / qa, qa = qx + qy, q3 = qa + qz, sa = qz / q3, then s2, s', s1 as in paper_ik2
// Formats: coordinates s(W-F).F, links u(W-F).F below 2^(W-1-F), joints turn-spread u2.S to nearest, modulo 4.
// in_elbow: 0 gives joint 2 in [0, 2] (theta2 >= 0), 1 the mirror image. The tip is always in front: rho >= 0.
// Error: README.md's law. Latency and II 9 + 4M, M = ceil((S+3) / R); cycle table in paper_solve.v.
// Status: unreachable (joint 2 stretched or folded: the nearest point), overflow (a link of 2^(W-1-F) or more),
//   singular (q3 or qa = 0: joint 1 or 3 holds its last word)
// Source: paper eqs. 32-40, which lose the elbow and the quadrants. Model: paper.ik3
`default_nettype none
module paper_ik3 #(
    parameter W = 16,  // bits of a coordinate and of a link, F + 5 or more; Q7.8 is the paper's word
    parameter F = 8,   // fraction bits of a coordinate, 1 or more
    parameter S = 8,   // fraction bits of a joint word, 4 to 24; 8 is the paper's
    parameter R = 6    // quotient digits a clock, 1 or more; 6 gives the 17 clocks of paper_ik2 at S = 8
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W-1:0] cfg_l1,
    input  wire        [W-1:0] cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    input  wire                in_elbow,
    output wire                out_valid,
    input  wire                out_ready,
    output wire        [S+1:0] out_j1,
    output wire        [S+1:0] out_j2,
    output wire        [S+1:0] out_j3,
    output wire        [3:0]   out_status
);
    paper_solve #(.W(W), .F(F), .S(S), .R(R), .YAW(1)) solver (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready),
        .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_elbow(in_elbow), .out_valid(out_valid), .out_ready(out_ready),
        .out_j1(out_j1), .out_j2(out_j2), .out_j3(out_j3), .out_status(out_status));
endmodule
`default_nettype wire
