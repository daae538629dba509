// SPDX-License-Identifier: Apache-2.0
// This core finds two joints in the plane the paper's way, with every quadrant and both elbows.
//   sa = qy / q3, s2 = 1 - (q3 - Q1 - Q2)^2 / (4 Q1 Q2), s' = s2 Q2 / q3, s1 = sa (+) s' or sa (-) s'
// Formats: coordinates s(W-F).F, links u(W-F).F below 2^I units, I = W-1-F, joints turn-spread u2.S, nearest, modulo 4.
// in_elbow = 0 gives theta2 >= 0, 1 the mirror image. Latency and II: 8 + 3 ceil((S+3)/R); cycle table: paper_solve.v.
// Error of the tip in reach, without the rounding of the words, r = L1 + L2, D = R ceil((S+3)/R), N = min(D, 26),
// G = min(S, 2F), B = min(2I+G, 27): 2r 2^(-D/2) + (r + 2 L2) 2^((1-N)/2) + sqrt(2 (4^I 2^-B + 2^-G)) units; where
// G < 2F, with u = 2^(-G/2), 4u + 2u sqrt(6 L2 / L1) + 3u^2 / L1 more; never more than 2r.
// Status: unreachable (nearest point: joint 2 is stretched or folded), singular (q3 = 0: joint 1 keeps its last word),
// overflow (a link is 2^I units or more; the joints are undefined).
// Source: paper eqs. 18-23, which lose the elbow and the quadrants. Model: paper.ik2
`default_nettype none
module paper_ik2 #(
    parameter W = 16,  // bits of a coordinate and of a link, F + 5 or more (default 16: Q7.8 is the paper's word)
    parameter F = 8,   // fraction bits of a coordinate, 1 or more (default 8)
    parameter S = 8,   // fraction bits of a joint word, 4 to 24 (default 8, the paper's)
    parameter R = 4    // quotient digits a clock, 1 or more with D <= B (default 4)
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
