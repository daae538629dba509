// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of six joints given as binary angles: one table codec turns them into unit vectors one after the
// other, and vector_fk6 does the rest.
// Formats: in_j* angle of A bits, a full turn is 2^A; out_r*, row and column, s2.U; out_x, out_y, out_z s(W-F).F; all
// are rounded to nearest (ties upward), coordinates saturated; cfg_* lengths s(W-F).(F+4), by six.forward_config.
// Error: that of vector_fk6, and at each joint 0.83 2^-U in a coordinate of its vector.
// Latency and II by PIPE: 58, 59, 61, of which 13 are two clocks a joint and one before vector_fk6.
// Status: overflow (a coordinate was saturated).
// Source: Brandstoetter, Angerer, Hofbaur 2014. Model: six.table_fk6
`default_nettype none
module table_fk6 #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,   // bits of an angle, 12 to 24 (default 18: 0.0014 degrees)
    parameter U = 16,   // fraction bits of a unit vector and of the matrix, 12 to 18 (default 16)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W+3:0] cfg_a1,
    input  wire signed [W+3:0] cfg_a2,
    input  wire signed [W+3:0] cfg_b,
    input  wire signed [W+3:0] cfg_c1,
    input  wire signed [W+3:0] cfg_c2,
    input  wire signed [W+3:0] cfg_c3,
    input  wire signed [W+3:0] cfg_c4,
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
            table_fk6_needs_W_from_4_to_16_and_F_below_W_and_A_from_12_to_24_and_U_from_12_to_18_and_PIPE_to_2 rule ();
        end
    endgenerate

    reg  [6*A-1:0]      angles;  // the joint being converted is in the lowest bits
    reg  [6:1]          left;    // one-hot: the joint that the codec gives next, 0 between samples
    reg                 feed;    // a joint is offered to the codec
    reg  [2:0]          fed;     // joints that the codec has accepted
    wire                take, ready, have, kernel_ready;
    wire signed [U+1:0] c, n;
    wire                accept = in_valid && in_ready;
    assign              in_ready = left == 6'd0 && kernel_ready;
    assign              take = feed && ready;
    angle_to_vector #(.A(A), .U(U)) codec (.clk(clk), .rst(rst), .in_valid(feed), .in_ready(ready),
        .in_j(angles[A-1:0]), .out_valid(have), .out_ready(1'b1), .out_c(c), .out_n(n));

    reg  [10*U+19:0] first;  // vectors of joints 1 to 5, the last one in the highest bits
    always @(posedge clk) begin
        if (accept)
            angles <= {in_j6, in_j5, in_j4, in_j3, in_j2, in_j1};
        else if (take)
            angles <= angles >> A;
        if (have)
            first <= {n, c, first[10*U+19:2*U+4]};
        fed <= accept ? 3'd0 : fed + {2'd0, take};
        feed <= !rst && (accept || feed && !(take && fed == 3'd5));
        left <= rst ? 6'd0 : accept ? 6'd1 : have ? left << 1 : left;
    end
    vector_fk6 #(.W(W), .F(F), .U(U), .PIPE(PIPE)) kernel (.clk(clk), .rst(rst), .cfg_a1(cfg_a1), .cfg_a2(cfg_a2),
        .cfg_b(cfg_b), .cfg_c1(cfg_c1), .cfg_c2(cfg_c2), .cfg_c3(cfg_c3), .cfg_c4(cfg_c4), .in_valid(have && left[6]),
        .in_ready(kernel_ready), .in_c1(first[0 +: U+2]), .in_n1(first[U+2 +: U+2]),
        .in_c2(first[2*U+4 +: U+2]), .in_n2(first[3*U+6 +: U+2]), .in_c3(first[4*U+8 +: U+2]),
        .in_n3(first[5*U+10 +: U+2]), .in_c4(first[6*U+12 +: U+2]), .in_n4(first[7*U+14 +: U+2]),
        .in_c5(first[8*U+16 +: U+2]), .in_n5(first[9*U+18 +: U+2]), .in_c6(c), .in_n6(n), .out_valid(out_valid),
        .out_ready(out_ready), .out_r11(out_r11), .out_r12(out_r12), .out_r13(out_r13), .out_r21(out_r21),
        .out_r22(out_r22), .out_r23(out_r23), .out_r31(out_r31), .out_r32(out_r32), .out_r33(out_r33), .out_x(out_x),
        .out_y(out_y), .out_z(out_z), .out_status(out_status));
endmodule
`default_nettype wire
