// SPDX-License-Identifier: Apache-2.0
// The core computes the pose of six joints given as binary angles, for arms whose axes 2, 3 and 4 are parallel.
// Formats: in_j* angle of A bits, a full turn is 2^A; out_r*, row and column, s2.U; out_x, out_y, out_z s(W-F).F; all
// are rounded to nearest (ties upward), coordinates saturated; cfg_* lengths s(W-F).(F+4), by ur.forward_config.
// Error: that of vector_ur_fk, and at each joint 0.83 2^-U in a coordinate of its vector.
// Latency and II by PIPE: 58, 61, 63, of which 13, 15, 15 are engine_vectors.
// Status: overflow (a coordinate was saturated).
// Source: that of vector_ur_fk. Model: ur.table_fk
`default_nettype none
module table_ur_fk #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,   // bits of an angle, 12 to 24 (default 18: 0.0014 degrees)
    parameter U = 16,   // fraction bits of a unit vector and of the matrix, 12 to 18 (default 16)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W+3:0] cfg_d1,
    input  wire signed [W+3:0] cfg_d4,
    input  wire signed [W+3:0] cfg_d5,
    input  wire signed [W+3:0] cfg_d6,
    input  wire signed [W+3:0] cfg_l2,
    input  wire signed [W+3:0] cfg_l3,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [A-1:0]        in_j1,
    input  wire [A-1:0]        in_j2,
    input  wire [A-1:0]        in_j3,
    input  wire [A-1:0]        in_j4,
    input  wire [A-1:0]        in_j5,
    input  wire [A-1:0]        in_j6,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_r11,
    output wire signed [U+1:0] out_r12,
    output wire signed [U+1:0] out_r13,
    output wire signed [U+1:0] out_r21,
    output wire signed [U+1:0] out_r22,
    output wire signed [U+1:0] out_r23,
    output wire signed [U+1:0] out_r31,
    output wire signed [U+1:0] out_r32,
    output wire signed [U+1:0] out_r33,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || A < 12 || A > 24 || U < 12 || U > 18 || PIPE < 0 || PIPE > 2)
        begin : g_illegal
            table_ur_fk_needs_W_from_4_to_16_and_F_below_W_and_A_from_12_to_24_and_U_from_12_to_18_and_PIPE_to_2
                rule ();
        end
    endgenerate

    wire signed [U+1:0] c1, n1, c2, n2, c3, n3, c4, n4, c5, n5, c6, n6;
    wire                have, ready;
    engine_vectors #(.A(A), .U(U), .PIPE(PIPE > 0 ? 1 : 0)) joints (.clk(clk), .rst(rst), .in_valid(in_valid),
        .in_ready(in_ready), .in_angles({in_j6, in_j5, in_j4, in_j3, in_j2, in_j1}), .out_valid(have),
        .out_ready(ready), .out_vectors({n6, c6, n5, c5, n4, c4, n3, c3, n2, c2, n1, c1}));
    vector_ur_fk #(.W(W), .F(F), .U(U), .PIPE(PIPE)) kernel (.clk(clk), .rst(rst), .cfg_d1(cfg_d1), .cfg_d4(cfg_d4),
        .cfg_d5(cfg_d5), .cfg_d6(cfg_d6), .cfg_l2(cfg_l2), .cfg_l3(cfg_l3), .in_valid(have), .in_ready(ready),
        .in_c1(c1), .in_n1(n1), .in_c2(c2), .in_n2(n2), .in_c3(c3), .in_n3(n3), .in_c4(c4), .in_n4(n4), .in_c5(c5),
        .in_n5(n5), .in_c6(c6), .in_n6(n6), .out_valid(out_valid), .out_ready(out_ready), .out_r11(out_r11),
        .out_r12(out_r12), .out_r13(out_r13), .out_r21(out_r21), .out_r22(out_r22), .out_r23(out_r23),
        .out_r31(out_r31), .out_r32(out_r32), .out_r33(out_r33), .out_x(out_x), .out_y(out_y), .out_z(out_z),
        .out_status(out_status));
endmodule
`default_nettype wire
