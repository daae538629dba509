// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of six joints in unit vectors, one of eight branches, for an arm with an ortho-parallel base and a
// spherical wrist.
//   in_branch[0]: the shoulder looks back; [1]: sin(q3 + psi) < 0; [2]: sin q5 < 0
// Formats: in_r*, row and column of the rotation matrix, s2.U; in_x, in_y, in_z s(W-F).F; out_c*, out_n* cosine and
// sine of a joint, s2.U, rounded to nearest; cfg_* by six.config, cfg_margin and cfg_slack in LSB.
// Error: orientation (6 sqrt(1/2) + 1.07) 2^-U + 3.25 2^-16 rad, at singular poses 8 sqrt(2) 2^-U more; position:
// bounds.six.position, which grows near axes 1 and 2. Latency and II by PIPE: 93, 113, 127; with MARGINS 103, 115, 128.
// Status: unreachable (by more than cfg_slack; the nearest pose is answered), singular (joint 1, 2 or 4 has no
// direction and holds its last one, (1, 0) after a reset; the others are computed with it; or a singularity is nearer
// than cfg_margin), no rotation (bit 3: the matrix is off by 16 units of 2^-U).
// Source: Brandstoetter, Angerer, Hofbaur 2014, without an arc function. Model: six.ik6
`default_nettype none
module vector_ik6 #(
    parameter W = 16,      // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,       // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
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
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || PIPE < 0 || PIPE > 2 || MARGINS < 0 || MARGINS > 1)
        begin : g_illegal
            vector_ik6_needs_W_4_to_16_and_F_below_W_and_U_8_to_18_and_PIPE_0_to_2_and_MARGINS_0_or_1 rule ();
        end
    endgenerate

    wire        idle, done;
    wire        accept = in_valid && in_ready;
    wire [26:0] word;
    wire [5:0]  dest;
    assign      in_ready = idle && (!out_valid || out_ready);
    six_inverse_path #(.W(W), .U(U), .PIPE(PIPE), .MARGINS(MARGINS)) path (.clk(clk), .rst(rst), .in_start(accept),
        .in_matrix({in_r33, in_r32, in_r31, in_r23, in_r22, in_r21, in_r13, in_r12, in_r11}),
        .in_tip({in_z, in_y, in_x}), .in_lengths({cfg_k, cfg_c4, cfg_c2, cfg_c1, cfg_b, cfg_a1}), .in_cp(cfg_cp),
        .in_np(cfg_np), .in_r(cfg_r), .in_e(cfg_e), .in_edges({cfg_slack, cfg_margin}), .in_signs(in_branch),
        .out_idle(idle), .out_done(done), .out_word(word), .out_dest(dest), .out_status(out_status));
    engine_results #(.COUNT(12), .U(U)) joints (.clk(clk), .in_word(word), .in_dest(dest), .out_words({out_n6, out_c6,
        out_n5, out_c5, out_n4, out_c4, out_n3, out_c3, out_n2, out_c2, out_n1, out_c1}));
    always @(posedge clk)
        out_valid <= !rst && (done || out_valid && !out_ready);
endmodule
`default_nettype wire
