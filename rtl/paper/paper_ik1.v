// SPDX-License-Identifier: Apache-2.0
// This core finds one joint the paper's way: the spread is a quotient of quadrances.
//   s1 = qy / (qx + qy), qx = x^2, qy = y^2; out_j1 = {k, s1} in even quadrants, {k, 1 - s1} in odd ones
// Formats: in_x and in_y are s(W-F).F; out_j1 is a turn-spread u2.S modulo 4, rounded to nearest.
// Error: the joint word is within 1/2 LSB (all S+1 bits of the quotient are exact; the last one rounds).
// Latency and II: 1 + ceil((S+1)/3). The cycle table is in vector_to_spread_iter.v.
// Status: singular (x = y = 0: the last joint word is held, 0 after a reset).
// Source: paper eq. 9; the signs of x and y give the quadrant, which the paper does not recover. Model: paper.ik1
`default_nettype none
module paper_ik1 #(
    parameter W = 16,  // bits of a coordinate, 4 to 18 (default 16: Q7.8 is the paper's word)
    parameter F = 8,   // fraction bits of a coordinate, 0 to W - 1 (default 8); F changes no logic
    parameter S = 8    // fraction bits of the joint word, 3 to 24 (default 8, the paper's)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire                out_valid,
    input  wire                out_ready,
    output wire        [S+1:0] out_j1,
    output wire        [3:0]   out_status
);
    generate
        if (W < 4 || W > 18 || F < 0 || F >= W || S < 3 || S > 24) begin : g_illegal
            paper_ik1_needs_W_from_4_to_18_F_below_W_and_S_from_3_to_24 rule ();
        end
    endgenerate

    vector_to_spread_iter #(.W(W), .S(S), .R(3)) direction (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_c(in_x), .in_n(in_y),
        .out_valid(out_valid), .out_ready(out_ready), .out_j(out_j1), .out_status(out_status));
endmodule
`default_nettype wire
