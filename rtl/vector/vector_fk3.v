// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of three joints whose words are unit vectors: vector_fk2 in a plane that is upright and yaws.
//   rho, z = x, y of vector_fk2; x = rho c3, y = rho n3; rho keeps its sign and its fraction bits
// Formats: in_c1 ... in_n3 s2.U (1.0 is 2^U); cfg_l1, cfg_l2 uQ(W-F).F; out_x ... out_z sQ(W-F).F, rounded to nearest
// and saturated.
// Error of a coordinate: 0.64 LSB for the vectors as they are given, if none is longer than 1 (bounds.vector.chain).
// Range: (L1 + L2 |v2|) |v1| and that times |v3| below 2^(W+1) LSB; beyond it a coordinate wraps.
// Latency and II 6; 7 at PIPE = 1. Status: overflow (a coordinate was saturated).
// Source: rational trigonometry paper, eqs. 24-31 in vector form. Model: vector.fk3
`default_nettype none
module vector_fk3 #(
    parameter W = 16,        // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,        // fraction bits of cosine and sine, 4 to 24 (default 16)
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
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
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || U < 4 || U > 24 || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            vector_fk3_needs_W_from_4_to_24_F_below_W_U_from_4_to_24_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    wire   overflow;
    assign out_status = {1'b0, overflow, 2'b00};
    kernel_vector_chain #(.JOINTS(3), .W(W), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) chain (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready),
        .in_c1(in_c1), .in_n1(in_n1), .in_c2(in_c2), .in_n2(in_n2), .in_c3(in_c3), .in_n3(in_n3),
        .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x), .out_y(out_y), .out_z(out_z),
        .out_overflow(overflow));
endmodule
`default_nettype wire
