// SPDX-License-Identifier: Apache-2.0
// This core finds every joint of a chain in space by the method of fixed frames: a link in, a position out.
//   (x, y, z) <- (x, y, z) + (+-sqrt(st sp Q), +-sqrt((1-st) sp Q), +-sqrt((1-sp) Q)), Q = L^2; in_last ends a chain
// in_j1 is the angle t from the y axis to the x axis, in_j2 the angle p from the z axis; both in the FIXED frame.
// Formats: in_j1 and in_j2 are turn-spreads u2.S, whose quadrants are the octant; in_l is u(W-F).F; outputs s(W-F).F.
// Error after k links at U = 16: z is within 9/16 + 0.83 (L1 + ... + Lk) / 2^16 LSB, lengths in LSB; x and y are within
// 11/16 + 1.65 (L1 + ... + Lk) / 2^16 LSB.
// Latency and II: 6 a link. The cycle table is in kernel_fixed_frame.v.
// Status: overflow (a coordinate was saturated, or this link follows the N-th of its chain and does not move the tip).
// Source: paper section IV-D, Fig. 12, octants corrected; the root of each spread replaces that of their product.
// Model: chain.mff
`default_nettype none
module paper_mff #(
    parameter W = 16,  // bits of a coordinate and of a length, 15 to 20 (default 16, the paper's)
    parameter F = 8,   // fraction bits of both, 0 to W - 1 (default 8, the paper's); F changes no logic
    parameter S = 24,  // fraction bits of a joint word, 10 to 30 (default 24: 0.014 degrees at a quadrant border)
    parameter U = 16,  // fraction bits of a root, 13 to 18 (default 16: 1.1 LSB at 64 units of Q7.8)
    parameter N = 32   // longest chain, 2 to 64 links with W + ceil(log2 N) at most 23 (default 32: a snake)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [S+1:0]        in_j1,
    input  wire [S+1:0]        in_j2,
    input  wire [W-1:0]        in_l,
    input  wire                in_last,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire                out_last,
    output wire [3:0]          out_status
);
    generate
        if (W < 15 || W > 20 || F < 0 || F >= W || S < 10 || S > 30 || U < 13 || U > 18 || N < 2 || N > 64
            || W + $clog2(N) > 23) begin : g_illegal
            paper_mff_needs_W_from_15_F_below_W_S_from_10_to_30_U_from_13_to_18_N_to_64_and_W_with_log2_N_to_23 rule ();
        end
    endgenerate

    reg  [S+1:0]    j1;
    wire            want, overflow;
    wire [4*U+29:0] chords;
    assign          out_status = {1'b0, overflow, 2'b00};
    always @(posedge clk)
        if (want)
            j1 <= in_j1;
    spread_chords #(.S(S), .U(U), .CLOCKS(1)) codec (.clk(clk), .in_j(want ? in_j2 : j1), .out_chords(chords));
    kernel_fixed_frame #(.W(W), .U(U), .N(N)) kernel (.clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready),
        .out_want(want), .in_chords(chords), .in_l(in_l), .in_last(in_last), .out_valid(out_valid),
        .out_ready(out_ready), .out_x(out_x), .out_y(out_y), .out_z(out_z), .out_last(out_last),
        .out_overflow(overflow));
endmodule
`default_nettype wire
