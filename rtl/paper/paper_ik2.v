// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints in the plane, the paper's way, with every quadrant and both elbows.
//   sa = qy / q3, s2 = 1 - (q3 - Q1 - Q2)^2 / (4 Q1 Q2), s' = s2 Q2 / q3, s1 = sa (+) s' or sa (-) s'
// Formats: coordinates s(W-F).F, links u(W-F).F below 2^(W-1-F), joints turn-spread u2.S to nearest, modulo 4.
// in_elbow: 0 gives joint 2 in [0, 2] (theta2 >= 0), 1 the mirror image.
// Error: README.md's law. Latency and II 8 + 3M, M = ceil((S+3) / R); cycle table in paper_solve.v.
// Status: unreachable (joint 2 stretched or folded: the nearest point), overflow (a link of 2^(W-1-F) or more),
//   singular (q3 = 0: joint 1 holds its last word)
// Source: paper eqs. 18-23, which lose the elbow and the quadrants. Model: paper.ik2
`default_nettype none
module paper_ik2 #(
    parameter W = 16,  // bits of a coordinate and of a link, F + 5 or more; Q7.8 is the paper's word
    parameter F = 8,   // fraction bits of a coordinate, 1 or more
    parameter S = 8,   // fraction bits of a joint word, 4 to 24; 8 is the paper's
    parameter R = 4    // quotient digits a clock, 1 or more; 4 stays within the paper's 671 logic elements at S = 8
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W-1:0] cfg_l1,
    input  wire        [W-1:0] cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire                in_elbow,
    output wire                out_valid,
    input  wire                out_ready,
    output wire        [S+1:0] out_j1,
    output wire        [S+1:0] out_j2,
    output wire        [3:0]   out_status
);
    wire [S+1:0] unused;
    paper_solve #(.W(W), .F(F), .S(S), .R(R), .YAW(0)) solver (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready),
        .in_x(in_x), .in_y(in_y), .in_z({W{1'b0}}), .in_elbow(in_elbow), .out_valid(out_valid), .out_ready(out_ready),
        .out_j1(out_j1), .out_j2(out_j2), .out_j3(unused), .out_status(out_status));
endmodule
`default_nettype wire
