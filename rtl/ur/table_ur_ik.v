// SPDX-License-Identifier: Apache-2.0
// The core solves six joints as binary angles, one of eight branches, for arms whose axes 2, 3 and 4 are parallel.
// Formats: out_j* angle of A bits, a full turn is 2^A, rounded to nearest; in_r*, row and column of the rotation
// matrix, s2.U; in_x, in_y, in_z s(W-F).F; in_branch, cfg_* as in vector_ur_ik.
// Error: that of vector_ur_ik (bounds.ur), and 0.89 LSB of an angle. Latency and II by PIPE: 104, 133, 146.
// Status: that of vector_ur_ik; a joint that has no direction holds its angle. A joint of a matrix that is no rotation
// may have no vector; it then has the angle formed last, in the order 1, 6, 5, 3, 2, 4.
// Source: that of vector_ur_ik. Model: ur.table_ik
`default_nettype none
module table_ur_ik #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,   // bits of an angle, 10 to 24 (default 18: 0.0014 degrees)
    parameter U = 16,   // fraction bits of a unit vector and of the matrix, 8 to 18 (default 16)
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
    input  wire signed [W-1:0] cfg_margin,
    input  wire signed [W-1:0] cfg_slack,
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
        if (W < 4 || W > 16 || F < 0 || F >= W || A < 10 || A > 24 || U < 8 || U > 18 || PIPE < 0 || PIPE > 2)
        begin : g_illegal
            table_ur_ik_needs_W_from_4_to_16_and_F_below_W_and_A_from_10_to_24_and_U_from_8_to_18_and_PIPE_to_2 rule ();
        end
    endgenerate

    wire        done;
    wire        accept = in_valid && in_ready;
    wire [26:0] word;
    wire [5:0]  dest;
    /* verilator lint_off PINCONNECTEMPTY */
    ur_inverse_path #(.W(W), .U(U), .PIPE(PIPE)) path (.clk(clk), .rst(rst), .in_start(accept),
        .in_matrix({in_r33, in_r32, in_r31, in_r23, in_r22, in_r21, in_r13, in_r12, in_r11}),
        .in_tip({in_z, in_y, in_x}), .in_lengths({cfg_l3, cfg_l2, cfg_d6, cfg_d5, cfg_d4, cfg_d1}),
        .in_margin(cfg_margin), .in_slack(cfg_slack), .in_r(cfg_r), .in_e(cfg_e), .in_signs(in_branch),
        .out_idle(), .out_done(done), .out_word(word), .out_dest(dest), .out_status(out_status));
    /* verilator lint_on PINCONNECTEMPTY */
    engine_angles #(.LAST(4), .A(A), .U(U), .PIPE(PIPE > 0 ? 1 : 0)) joints (.clk(clk), .rst(rst), .in_start(accept),
        .in_done(done), .in_word(word), .in_dest(dest), .out_idle(in_ready), .out_valid(out_valid),
        .out_ready(out_ready), .out_angles({out_j6, out_j5, out_j4, out_j3, out_j2, out_j1}));
endmodule
`default_nettype wire
