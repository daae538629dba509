// SPDX-License-Identifier: Apache-2.0
// This core finds the tip of three joints the paper's way: two links in a plane that joint 3 turns.
//   qz = q3 s, qa = q3 - qz, qy = qa s3, qx = qa - qy; x and y also carry the sign of rho, which squaring loses
// Formats: joints are turn-spreads u2.S, links u(W-F).F below 2^I units, I = W-1-F, coordinates s(W-F).F.
// Error of the tip at the distance r: r (2^(-D/2) + sqrt(3) 2^(-N/2) + 2^(-Q/2)) + 4 * 2^(-G/2) + 2^(I-N) units and
// sqrt(3) LSB, N = max(S+1, W-1), D = 3 ceil((S+1)/3), G = min(S, 27-2I, 2(N+1-I)), Q = 2I+G.
// Latency and II: 8 + ceil((S+1)/3). The cycle table is in paper_chain.v.
// Status: overflow (a link or the tip is 2^I units or more: every coordinate reads +-(2^(W-1) - 1), sign undefined;
// or a coordinate rounds to 2^(W-1) LSB and is saturated alone).
// Source: paper eqs. 24-31, Fig. 10, Table II corrected. Model: paper.fk3
`default_nettype none
module paper_fk3 #(
    parameter W = 16,  // bits of a coordinate and of a link, F + 5 or more (default 16: Q7.8 is the paper's word)
    parameter F = 8,   // fraction bits of a coordinate, 1 or more (default 8)
    parameter S = 8    // fraction bits of a joint word, 4 to 24 with N and D at most Q (default 8, the paper's)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W-1:0] cfg_l1,
    input  wire        [W-1:0] cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire        [S+1:0] in_j1,
    input  wire        [S+1:0] in_j2,
    input  wire        [S+1:0] in_j3,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire        [3:0]   out_status
);
    wire overflow;
    paper_chain #(.W(W), .F(F), .S(S), .YAW(1)) chain (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready),
        .in_j1(in_j1), .in_j2(in_j2), .in_j3(in_j3), .out_valid(out_valid), .out_ready(out_ready),
        .out_x(out_x), .out_y(out_y), .out_z(out_z), .out_overflow(overflow));
    assign out_status = {1'b0, overflow, 2'b00};
endmodule
`default_nettype wire
