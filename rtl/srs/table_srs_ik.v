// SPDX-License-Identifier: Apache-2.0
// The core solves seven joints as binary angles, one of eight branches, for arms with spherical shoulder and wrist.
// Formats: out_j* angle of A bits, a full turn is 2^A, rounded to nearest; in_r*, row and column of the rotation
// matrix, in_cs and in_ns, s2.U; in_x, in_y, in_z s(W-F).F; swivel, in_branch and cfg_* as in vector_srs_ik.
// Error: that of vector_srs_ik (bounds.srs), and 0.89 LSB of an angle. Latency and II by PIPE: 123, 142, 158.
// Status: that of vector_srs_ik. A joint of a matrix that is no rotation may have no vector; it then has the angle
// formed last, in the order 4, 2, 1, 3, 5, 6, 7. Source: that of vector_srs_ik. Model: srs.table_ik
`default_nettype none
module table_srs_ik #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,   // bits of an angle, 10 to 24 (default 18: 0.0014 degrees)
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
    output wire                out_valid,
    input  wire                out_ready,
    output wire [A-1:0]        out_j1,
    output wire [A-1:0]        out_j2,
    output wire [A-1:0]        out_j3,
    output wire [A-1:0]        out_j4,
    output wire [A-1:0]        out_j5,
    output wire [A-1:0]        out_j6,
    output wire [A-1:0]        out_j7,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || A < 10 || A > 24 || U < 8 || U > 18 || PIPE < 0 || PIPE > 2)
        begin : g_illegal
            table_srs_ik_needs_W_to_16_and_F_below_W_and_A_from_10_to_24_and_U_from_8_to_18_and_PIPE_to_2 rule ();
        end
    endgenerate

    wire        done;
    wire        accept = in_valid && in_ready;
    wire [26:0] word;
    wire [5:0]  dest;
    /* verilator lint_off PINCONNECTEMPTY */
    srs_inverse_path #(.W(W), .U(U), .PIPE(PIPE)) path (.clk(clk), .rst(rst), .in_start(accept),
        .in_matrix({in_r33, in_r32, in_r31, in_r23, in_r22, in_r21, in_r13, in_r12, in_r11}),
        .in_tip({in_z, in_y, in_x}), .in_lengths({cfg_l4, cfg_l2, cfg_l1, cfg_d}), .in_margin(cfg_margin),
        .in_slack(cfg_slack), .in_swivel({in_ns, in_cs}), .in_r(cfg_r), .in_e(cfg_e), .in_signs(in_branch),
        .out_idle(), .out_done(done), .out_word(word), .out_dest(dest), .out_status(out_status));
    /* verilator lint_on PINCONNECTEMPTY */
    engine_angles #(.JOINTS(7), .LAST(7), .A(A), .U(U), .PIPE(PIPE > 0 ? 1 : 0)) joints (.clk(clk), .rst(rst),
        .in_start(accept), .in_done(done), .in_word(word), .in_dest(dest), .out_idle(in_ready), .out_valid(out_valid),
        .out_ready(out_ready), .out_angles({out_j7, out_j6, out_j5, out_j4, out_j3, out_j2, out_j1}));
endmodule
`default_nettype wire
