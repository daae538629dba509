// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of six joints as binary angles, for one of eight branches: the program of vector_ik6, and one
// table codec that converts its vectors as they come.
// Formats: out_j* angle of A bits, a full turn is 2^A, rounded to nearest; in_r*, row and column of the rotation
// matrix, s2.U; in_x, in_y, in_z s(W-F).F; in_branch as in vector_ik6; cfg_* by six.config, margin and slack in LSB.
// Error: that of vector_ik6 (bounds.six), and 0.89 LSB of an angle. Latency and II by PIPE: 95, 117, 131; with MARGINS
// 105, 119, 132.
// Status: as vector_ik6; joint 1, 2 or 4 without a direction holds its angle. A joint of a matrix that is no rotation
// may have no vector; it then has the angle formed last, in the order 1, 3, 2, 4, 5, 6.
// Source: Brandstoetter, Angerer, Hofbaur 2014, without an arc function. Model: six.table_ik6
`default_nettype none
module table_ik6 #(
    parameter W = 16,      // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,       // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,      // bits of an angle, 10 to 24 (default 18: 0.0014 degrees)
    parameter U = 16,      // fraction bits of a unit vector and of the matrix, 8 to 18 (default 16)
    parameter PIPE = 0,    // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
    parameter MARGINS = 0  // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
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
    input  wire signed [W-1:0] cfg_margin,
    input  wire signed [W-1:0] cfg_slack,
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
        if (W < 4 || W > 16 || F < 0 || F >= W || A < 10 || A > 24 || U < 8 || U > 18 || PIPE < 0 || PIPE > 2
            || MARGINS < 0 || MARGINS > 1) begin : g_illegal
            table_ik6_needs_W_4_to_16_and_F_below_W_and_A_10_to_24_and_U_8_to_18_and_PIPE_0_to_2_and_MARGINS_0_or_1
                rule ();
        end
    endgenerate

    wire        done;
    wire        accept = in_valid && in_ready;
    wire [26:0] word;
    wire [5:0]  dest;
    /* verilator lint_off PINCONNECTEMPTY */
    six_inverse_path #(.W(W), .U(U), .PIPE(PIPE), .MARGINS(MARGINS)) path (.clk(clk), .rst(rst), .in_start(accept),
        .in_matrix({in_r33, in_r32, in_r31, in_r23, in_r22, in_r21, in_r13, in_r12, in_r11}),
        .in_tip({in_z, in_y, in_x}), .in_lengths({cfg_k, cfg_c4, cfg_c2, cfg_c1, cfg_b, cfg_a1}), .in_cp(cfg_cp),
        .in_np(cfg_np), .in_r(cfg_r), .in_e(cfg_e), .in_edges({cfg_slack, cfg_margin}), .in_signs(in_branch),
        .out_idle(), .out_done(done), .out_word(word), .out_dest(dest), .out_status(out_status));
    /* verilator lint_on PINCONNECTEMPTY */
    engine_angles #(.A(A), .U(U), .PIPE(PIPE > 0 ? 1 : 0)) joints (.clk(clk), .rst(rst), .in_start(accept),
        .in_done(done), .in_word(word), .in_dest(dest), .out_idle(in_ready), .out_valid(out_valid),
        .out_ready(out_ready), .out_angles({out_j6, out_j5, out_j4, out_j3, out_j2, out_j1}));
endmodule
`default_nettype wire
