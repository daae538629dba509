// SPDX-License-Identifier: Apache-2.0
// vector_srs_ik and table_srs_ik share this module: the pose, the program of one branch and the product engine.
//   out_word, out_dest: a word and its register; the cosine of joint j has number 2j, its sine 2j + 1. The words of a
//   joint come before those of the next one, in the order 4, 2, 1, 3, 5, 6, 7. Joint 5 gives none where it is held
// Formats: those of six_pose; in_swivel sine and cosine, s2.U; in_signs is in_branch of vector_srs_ik; in_margin
// and in_slack LSB of a coordinate; out_word s2.25. Error: bounds.srs.
// Latency: out_done is high in the 120th clock after in_start (PIPE 1: 137th, 2: 153rd), together with the last word,
// and out_status is valid from then on, as in vector_srs_ik. A user raises in_start only when out_idle is high; in a
// clock with rst it is ignored. Model: srs.ik
`default_nettype none
module srs_inverse_path #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter U = 16,   // fraction bits of the matrix, 8 to 18 (default 16)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_start,
    input  wire [9*U+17:0]     in_matrix,
    input  wire [3*W-1:0]      in_tip,
    input  wire [4*W+15:0]     in_lengths,
    input  wire signed [W-1:0] in_margin,
    input  wire signed [W-1:0] in_slack,
    input  wire [2*U+3:0]      in_swivel,
    input  wire [24:0]         in_r,
    input  wire [21:0]         in_e,
    input  wire [2:0]          in_signs,
    output wire                out_idle,
    output wire                out_done,
    output wire [26:0]         out_word,
    output wire [5:0]          out_dest,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || U < 8 || U > 18 || PIPE < 0 || PIPE > 2) begin : g_illegal
            srs_inverse_path_needs_W_from_4_to_16_and_U_from_8_to_18_and_PIPE_from_0_to_2 rule ();
        end
    endgenerate

    wire [46:0]  op;
    wire [26:0]  port;
    reg  [2:0]   signs;
    reg  [U+1:0] cosine, sine;  // of the swivel
    vector_srs_ik_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle),
        .out_done(out_done), .out_op(op));
    six_pose #(.W(W), .U(U)) pose (.clk(clk), .in_take(in_start), .in_matrix(in_matrix), .in_tip(in_tip),
        .in_lengths({in_slack, 4'd0, in_margin, 4'd0, in_lengths}), .in_cp({cosine, {(25-U){1'b0}}}),
        .in_np({sine, {(25-U){1'b0}}}), .in_r(in_r), .in_e(in_e), .in_edges({2*W{1'b0}}),
        .in_select(op[43:39]), .out_word(port));
    product_engine #(.PIPE(PIPE), .WRIST(28-U), .SLACK(29-U), .MARGINS(1)) engine (.clk(clk), .rst(rst),
        .in_start(in_start), .in_run(!out_idle), .in_op(op), .in_port(port), .in_signs(signs), .out_word(out_word),
        .out_dest(out_dest), .out_status(out_status));
    always @(posedge clk)
        if (in_start)
            {sine, cosine, signs} <= {in_swivel, in_signs};
endmodule
`default_nettype wire
