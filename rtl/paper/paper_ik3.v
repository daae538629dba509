// SPDX-License-Identifier: Apache-2.0
// This core finds three joints the paper's way: two links in a plane that joint 3 turns, both elbows, rho >= 0.
//   s3 = qy / qa, qa = qx + qy, q3 = qa + qz, sa = qz / q3, then s2, s' and s1 as in paper_ik2
// Formats: coordinates s(W-F).F, links u(W-F).F below 2^I units, I = W-1-F, joints turn-spread u2.S, nearest, modulo 4.
// in_elbow = 0 gives theta2 >= 0, 1 the mirror image. Latency and II: 9 + 4 ceil((S+3)/R); cycle table: paper_solve.v.
// Error of the tip in reach, without the rounding of the words, r = L1 + L2, D = R ceil((S+3)/R), N = min(D, 26),
// G = min(S, 2F), B = min(2I+G, 27): 3r 2^(-D/2) + (r + 2 L2) 2^((1-N)/2) + sqrt(2 (4^I 2^-B + 2^-G)) units; where
// G < 2F, with u = 2^(-G/2), (2 sqrt(6) + 2) u + 2u sqrt(8 L2 / L1) + 4u^2 / L1 more; never more than 2r.
// Status: unreachable (nearest point: joint 2 is stretched or folded), singular (q3 or qa is 0: joint 1 or 3 keeps its
// last word), overflow (a link is 2^I units or more; the joints are undefined).
// Source: paper eqs. 32-40, which lose the elbow and the quadrants. Model: paper.ik3
`default_nettype none
module paper_ik3 #(
    parameter W = 16,  // bits of a coordinate and of a link, F + 5 or more (default 16: Q7.8 is the paper's word)
    parameter F = 8,   // fraction bits of a coordinate, 1 or more (default 8)
    parameter S = 8,   // fraction bits of a joint word, 4 to 24 (default 8, the paper's)
    parameter R = 6    // quotient digits a clock, 1 or more with D <= B (default 6)
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
