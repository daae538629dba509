// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of three joints: two links in a plane that turns with joint 3, by the paper's corrected Table II.
//   qz = q3 s, qa = q3 - qz, qy = qa s3, qx = qa - qy; x and y also carry the sign of rho, which squaring loses
// Formats: joints turn-spread u2.S, links u(W-F).F below 2^(W-1-F), coordinates s(W-F).F; spreads have S bits inside.
// Error: <= README.md's law, about reach * 2^(-S/2): the paper's form roots what it has rounded as a square.
// Latency and II 11 at S = 8, 17 at S = 24; cycle table in paper_chain.v.
// Status: overflow (tip or link beyond 2^(W-1-F): every coordinate +-(2^(W-1) - 1), signs undefined)
// Source: paper eqs. 24-31, Fig. 10. Model: paper.fk3
`default_nettype none
module paper_fk3 #(
    parameter W = 16,  // bits of a coordinate and of a link, F + 5 or more; Q7.8 is the paper's word
    parameter F = 8,   // fraction bits of a coordinate, 1 or more
    parameter S = 8    // fraction bits of a joint word, 4 to 24; 8 is the paper's
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
