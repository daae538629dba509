// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of six joints as binary angles, one of eight branches: vector_ik6, then one table codec that takes
// its vectors one after the other. Formats: out_j* angle of A bits, a full turn is 2^A, nearest; others as there.
// Error: page. Latency, II: 102: vector_ik6, a clock a joint and one.
// Status: as vector_ik6. Of a matrix that is no rotation a joint may have no vector: it has the word of the one before.
// Source: Brandstoetter, Angerer, Hofbaur 2014. Model: six.table_ik6
`default_nettype none
module table_ik6 #(
    parameter W = 16,  // bits of a coordinate, 4 to 16: 16, a range of 128 units
    parameter F = 8,   // fraction bits of a coordinate, 0 to W - 1; changes no logic: 8, Q7.8
    parameter A = 18,  // bits of an angle, 10 to 24: 18 resolve 0.0014 degrees
    parameter U = 16   // fraction bits of a unit vector and of the matrix, 8 to 18: 16, 0.0009 degrees
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W+3:0] cfg_a1,
    input  wire signed [W+3:0] cfg_b,
    input  wire signed [W+3:0] cfg_c1,
    input  wire signed [W+3:0] cfg_c2,
    input  wire signed [W+3:0] cfg_c4,
    input  wire signed [W+3:0] cfg_k,
    input  wire signed [26:0]  cfg_cp,
    input  wire signed [26:0]  cfg_np,
    input  wire [24:0]         cfg_r,
    input  wire [21:0]         cfg_e,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_r11,
    input  wire signed [U+1:0] in_r12,
    input  wire signed [U+1:0] in_r13,
    input  wire signed [U+1:0] in_r21,
    input  wire signed [U+1:0] in_r22,
    input  wire signed [U+1:0] in_r23,
    input  wire signed [U+1:0] in_r31,
    input  wire signed [U+1:0] in_r32,
    input  wire signed [U+1:0] in_r33,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    input  wire [2:0]          in_branch,
    output wire                out_valid,
    input  wire                out_ready,
    output wire [A-1:0]        out_j1,
    output wire [A-1:0]        out_j2,
    output wire [A-1:0]        out_j3,
    output wire [A-1:0]        out_j4,
    output wire [A-1:0]        out_j5,
    output wire [A-1:0]        out_j6,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || A < 10 || A > 24 || U < 8 || U > 18) begin : g_illegal
            table_ik6_needs_W_from_4_to_16_and_F_below_W_and_A_from_10_to_24_and_U_from_8_to_18 rule ();
        end
    endgenerate

    wire            solved, have, last;
    wire            accept = in_valid && in_ready;
    wire [12*U+23:0] found;
    /* verilator lint_off PINCONNECTEMPTY */
    vector_ik6 #(.W(W), .F(F), .U(U)) kernel (.clk(clk), .rst(rst), .cfg_a1(cfg_a1), .cfg_b(cfg_b), .cfg_c1(cfg_c1),
        .cfg_c2(cfg_c2), .cfg_c4(cfg_c4), .cfg_k(cfg_k), .cfg_cp(cfg_cp), .cfg_np(cfg_np), .cfg_r(cfg_r), .cfg_e(cfg_e),
        .in_valid(accept), .in_ready(), .in_r11(in_r11), .in_r12(in_r12), .in_r13(in_r13), .in_r21(in_r21),
        .in_r22(in_r22), .in_r23(in_r23), .in_r31(in_r31), .in_r32(in_r32), .in_r33(in_r33), .in_x(in_x), .in_y(in_y),
        .in_z(in_z), .in_branch(in_branch), .out_valid(solved), .out_ready(last),
        .out_c1(found[0 +: U+2]), .out_n1(found[U+2 +: U+2]), .out_c2(found[2*U+4 +: U+2]),
        .out_n2(found[3*U+6 +: U+2]), .out_c3(found[4*U+8 +: U+2]), .out_n3(found[5*U+10 +: U+2]),
        .out_c4(found[6*U+12 +: U+2]), .out_n4(found[7*U+14 +: U+2]), .out_c5(found[8*U+16 +: U+2]),
        .out_n5(found[9*U+18 +: U+2]), .out_c6(found[10*U+20 +: U+2]), .out_n6(found[11*U+22 +: U+2]),
        .out_status(out_status));

    reg  [2:0]       joint;  // 0 to 5, the next one to the codec
    reg  [6:1]       coded;  // one-hot: the joint that the codec gives next, 0 where no sample is inside or waits
    wire             step = have && (!coded[6] || out_ready);
    wire [2*U+3:0]   vector;
    wire [A-1:0]     angle;
    genvar           b, i;
    generate
        for (i = 0; i < 8; i = i + 1) begin : g_joint
            wire [2*U+3:0] one = found[(2*U+4)*(i < 6 ? i : 5) +: 2*U+4];
        end
        for (b = 0; b < 2 * U + 4; b = b + 1) begin : g_bit
            wire [7:0] column;
            for (i = 0; i < 8; i = i + 1) begin : g_row
                assign column[i] = g_joint[i].one[b];
            end
            assign vector[b] = column[joint];
        end
    endgenerate
    vector_to_angle #(.U(U), .A(A)) codec (.clk(clk), .rst(rst), .in_valid(solved), .in_ready(), .in_c(vector[U+1:0]),
        .in_n(vector[2*U+3:U+2]), .out_valid(have), .out_ready(!coded[6] || out_ready), .out_j(angle), .out_status());
    /* verilator lint_on PINCONNECTEMPTY */
    assign last = joint == 3'd5;
    assign out_valid = have && coded[6];
    assign in_ready = coded == 0 || out_valid && out_ready;

    reg [5*A-1:0] first;  // words of joints 1 to 5, the last one on top
    assign        {out_j6, out_j5, out_j4, out_j3, out_j2, out_j1} = {angle, first};
    always @(posedge clk) begin
        if (have && !coded[6])
            first <= {angle, first[5*A-1:A]};
        joint <= accept ? 3'd0 : joint + {2'd0, solved};
        coded <= rst ? 6'd0 : accept ? 6'd1 : step ? coded << 1 : coded;
    end
endmodule
`default_nettype wire
