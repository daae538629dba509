// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of two joints in the plane, whose words are unit vectors: products only, no table.
//   x = A c1 - B n1, y = A n1 + B c1 with A = L1 + L2 c2, B = L2 n2
// Formats: in_c1 ... in_n2 s2.U (1.0 is 2^U); cfg_l1, cfg_l2 uQ(W-F).F; out_x, out_y sQ(W-F).F, nearest, saturated.
// Error: each coordinate within 0.61 LSB of the vectors as they are given, if none is longer than 1.
// Latency 4, II 4; the schedule is in vector_chain.v.
// Status: overflow (a coordinate was saturated).
// Source: rational trigonometry paper, eqs. 84 and 96 (what eqs. 11-17 and Table II mean). Model: vector.fk2
`default_nettype none
module vector_fk2 #(
    parameter W = 16,  // bits of a coordinate and of a length, 4 to 20: 16 are common in servo control
    parameter F = 8,   // fraction bits of both, 0 to W-1; changes no logic: 8 resolve 1/256 unit
    parameter U = 16   // fraction bits of cosine and sine, 4 to 24: 16 are what a coordinate of 16 bits needs
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 20 || F < 0 || F >= W || U < 4 || U > 24) begin : g_illegal
            vector_fk2_needs_W_from_4_to_20_and_F_below_W_and_U_from_4_to_24 rule ();
        end
    endgenerate

    wire   overflow;
    assign out_status = {1'b0, overflow, 2'b00};
    /* verilator lint_off PINCONNECTEMPTY */
    vector_chain #(.JOINTS(2), .W(W), .U(U)) chain (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready),
        .in_c1(in_c1), .in_n1(in_n1), .in_c2(in_c2), .in_n2(in_n2), .in_c3({(U+2){1'b0}}), .in_n3({(U+2){1'b0}}),
        .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x), .out_y(out_y), .out_z(), .out_overflow(overflow));
    /* verilator lint_on PINCONNECTEMPTY */
endmodule
`default_nettype wire
