// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of two joints in the plane: x = A c1 - B n1, y = A n1 + B c1 with A = L1 + L2 c2, B = L2 n2.
// Formats: in_j1, in_j2 turn-spread u2.S; cfg_l1, cfg_l2 uQ(W-F).F; out_x, out_y sQ(W-F).F, nearest, saturated.
// Error: each coordinate 0.61 + 1.06 (L1 + 2 L2) / 2^16 LSB, lengths in LSB: 1.00 at L1 = L2 = 2^13, 0.80 measured.
// Latency 6, II 6; the schedule stands in rational_chain.v.
// Status: overflow (a coordinate was saturated).
// Source: rational trigonometry paper, eqs. 84 and 96 (what eqs. 11-17 and Table II mean): no table of quadrants.
// Model: rational.fk2
`default_nettype none
module rational_fk2 #(
    parameter W = 16,
    parameter F = 8,
    parameter S = 24,
    parameter U = 16
) (
    input  wire         clk,
    input  wire         rst,
    input  wire [W-1:0] cfg_l1,
    input  wire [W-1:0] cfg_l2,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [S+1:0] in_j1,
    input  wire [S+1:0] in_j2,
    output wire         out_valid,
    input  wire         out_ready,
    output wire [W-1:0] out_x,
    output wire [W-1:0] out_y,
    output wire [3:0]   out_status
);
    generate
        if (W < 15 || W > 20 || F < 0 || F >= W || S < 10 || S > 30 || U < 13 || U > 18) begin : g_illegal
            rational_fk2_needs_W_from_15_to_20_and_F_below_W_and_S_from_10_to_30_and_U_from_13_to_18 rule ();
        end
    endgenerate

    assign out_status[3] = 1'b0;
    assign out_status[1:0] = 2'b00;
    /* verilator lint_off PINCONNECTEMPTY */
    rational_chain #(.JOINTS(2), .W(W), .S(S), .U(U)) chain (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready),
        .in_j1(in_j1), .in_j2(in_j2), .in_j3({(S+2){1'b0}}), .out_valid(out_valid), .out_ready(out_ready),
        .out_x(out_x), .out_y(out_y), .out_z(), .out_overflow(out_status[2]));
    /* verilator lint_on PINCONNECTEMPTY */
endmodule
`default_nettype wire
