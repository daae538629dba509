// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of seven joints in unit vectors, one of eight branches: spherical shoulder and wrist, an elbow.
//   in_branch[0]: sin q2 < 0; [1]: sin q4 < 0; [2]: sin q6 < 0. (in_cs, in_ns) turns the elbow about the line from the
//   shoulder to the wrist's centre; at (1, 0) the elbow with sin q4 < 0 is straight above that line
// Formats: in_r*, row and column of the rotation matrix, in_cs and in_ns, s2.U; in_x, in_y, in_z s(W-F).F; out_c*,
// out_n* cosine and sine of a joint, s2.U, rounded to nearest; cfg_* by srs.config, cfg_margin and cfg_slack in LSB of
// a coordinate. Error: bounds.srs, orientation and position. Latency and II: 121.
// Status: unreachable (the nearest pose is answered; cfg_slack as in vector_ur_ik), singular (the wrist's centre or the
// upper arm is on axis 1, or joint 5 has no direction: the last one is held, (1, 0) after a reset; or a singularity is
// nearer than cfg_margin), no rotation (bit 3: the matrix or the swivel is off by 16 units of 2^-U). Model: srs.ik
`default_nettype none
module vector_srs_ik #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,   // fraction bits of a unit vector and of the matrix, 8 to 18 (default 16)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W+3:0] cfg_d,
    input  wire signed [W+3:0] cfg_l1,
    input  wire signed [W+3:0] cfg_l2,
    input  wire signed [W+3:0] cfg_l4,
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
    input  wire signed [U+1:0] in_cs,
    input  wire signed [U+1:0] in_ns,
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
    output wire signed [U+1:0] out_c7,
    output wire signed [U+1:0] out_n7,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || PIPE < 0 || PIPE > 2) begin : g_illegal
            vector_srs_ik_needs_W_from_4_to_16_and_F_below_W_and_U_from_8_to_18_and_PIPE_from_0_to_2 rule ();
        end
    endgenerate

    wire        idle, done;
    wire        accept = in_valid && in_ready;
    wire [26:0] word;
    wire [5:0]  dest;
    srs_inverse_path #(.W(W), .U(U), .PIPE(PIPE)) path (.clk(clk), .rst(rst), .in_start(accept),
        .in_matrix({in_r33, in_r32, in_r31, in_r23, in_r22, in_r21, in_r13, in_r12, in_r11}),
        .in_tip({in_z, in_y, in_x}), .in_lengths({cfg_l4, cfg_l2, cfg_l1, cfg_d}), .in_margin(cfg_margin),
        .in_slack(cfg_slack), .in_swivel({in_ns, in_cs}), .in_r(cfg_r), .in_e(cfg_e), .in_signs(in_branch),
        .out_idle(idle), .out_done(done), .out_word(word), .out_dest(dest), .out_status(out_status));
    assign      in_ready = idle && (!out_valid || out_ready);
    engine_results #(.COUNT(14), .U(U)) joints (.clk(clk), .in_word(word), .in_dest(dest), .out_words({out_n7, out_c7,
        out_n6, out_c6, out_n5, out_c5, out_n4, out_c4, out_n3, out_c3, out_n2, out_c2, out_n1, out_c1}));
    always @(posedge clk)
        out_valid <= !rst && (done || out_valid && !out_ready);
endmodule
`default_nettype wire
