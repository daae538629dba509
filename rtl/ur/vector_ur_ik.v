// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of six joints in unit vectors, one of eight branches: arms whose axes 2, 3 and 4 are parallel.
//   in_branch[0]: the shoulder looks back; [1]: sin q3 < 0; [2]: sin q5 < 0
// Formats: in_r*, row and column of the rotation matrix, s2.U; in_x, in_y, in_z s(W-F).F; out_c*, out_n* cosine and
// sine of a joint, s2.U, rounded to nearest; cfg_* by ur.config, cfg_margin and cfg_slack in LSB of a coordinate.
// Error: bounds.ur, orientation and position. Latency and II: 102.
// Status: unreachable (the nearest pose is answered; joint 3 is stretched by up to cfg_slack without it), singular
// (joint 1, 2 or 6 has no direction and holds its last one, (1, 0) after a reset, or a singularity is nearer than
// cfg_margin), no rotation (bit 3: the matrix is off by 16 units of 2^-U).
// Source: the maker's Denavit-Hartenberg table; Hawkins 2013, without an arc function. Model: ur.ik
`default_nettype none
module vector_ur_ik #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
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
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_c1,
    output wire signed [U+1:0] out_n1,
    output wire signed [U+1:0] out_c2,
    output wire signed [U+1:0] out_n2,
    output wire signed [U+1:0] out_c3,
    output wire signed [U+1:0] out_n3,
    output wire signed [U+1:0] out_c4,
    output wire signed [U+1:0] out_n4,
    output wire signed [U+1:0] out_c5,
    output wire signed [U+1:0] out_n5,
    output wire signed [U+1:0] out_c6,
    output wire signed [U+1:0] out_n6,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || PIPE < 0 || PIPE > 2) begin : g_illegal
            vector_ur_ik_needs_W_from_4_to_16_and_F_below_W_and_U_from_8_to_18_and_PIPE_from_0_to_2 rule ();
        end
    endgenerate

    wire        idle, done;
    wire        accept = in_valid && in_ready;
    wire [26:0] word;
    wire [5:0]  dest;
    ur_inverse_path #(.W(W), .U(U), .PIPE(PIPE)) path (.clk(clk), .rst(rst), .in_start(accept),
        .in_matrix({in_r33, in_r32, in_r31, in_r23, in_r22, in_r21, in_r13, in_r12, in_r11}),
        .in_tip({in_z, in_y, in_x}), .in_lengths({cfg_l3, cfg_l2, cfg_d6, cfg_d5, cfg_d4, cfg_d1}),
        .in_margin(cfg_margin), .in_slack(cfg_slack), .in_r(cfg_r), .in_e(cfg_e), .in_signs(in_branch),
        .out_idle(idle), .out_done(done), .out_word(word), .out_dest(dest), .out_status(out_status));
    assign      in_ready = idle && (!out_valid || out_ready);
    engine_results #(.COUNT(12), .U(U)) joints (.clk(clk), .in_word(word), .in_dest(dest), .out_words({out_n6, out_c6,
        out_n5, out_c5, out_n4, out_c4, out_n3, out_c3, out_n2, out_c2, out_n1, out_c1}));
    always @(posedge clk)
        out_valid <= !rst && (done || out_valid && !out_ready);
endmodule
`default_nettype wire
