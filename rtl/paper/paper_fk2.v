// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of two joints in the plane, the paper's way, Table II corrected.
//   x, y = +-sqrt(q3 (1 - s)), +-sqrt(q3 s) with q3 by the cross law and s = s1 (-) s', s' = s2 Q2 / q3
// Formats: joints turn-spread u2.S, links u(W-F).F below 2^(W-1-F), coordinates s(W-F).F; spreads have S bits inside.
// Error: <= README.md's law, about reach * 2^(-S/2): the paper's form roots what it has rounded as a square.
// Latency and II 10 at S = 8, 16 at S = 24; cycle table in paper_chain.v.
// Status: overflow (tip or link beyond 2^(W-1-F): every coordinate +-(2^(W-1) - 1), signs undefined)
// Source: paper eqs. 11-17, Table II, Fig. 9. Model: paper.fk2
`default_nettype none
module paper_fk2 #(
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
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire        [3:0]   out_status
);
    wire overflow;
    wire signed [W-1:0] unused;
    paper_chain #(.W(W), .F(F), .S(S), .YAW(0)) chain (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready),
        .in_j1(in_j1), .in_j2(in_j2), .in_j3({(S+2){1'b0}}), .out_valid(out_valid), .out_ready(out_ready),
        .out_x(out_x), .out_y(out_y), .out_z(unused), .out_overflow(overflow));
    assign out_status = {1'b0, overflow, 2'b00};
endmodule
`default_nettype wire
