// SPDX-License-Identifier: Apache-2.0
// Common part of vector_ik6 and table_ik6: the pose, the program of one branch and the product engine that plays it.
//   out_word, out_dest: a word and its register; the cosine of joint j has number 2j, its sine 2j + 1. The words of a
//   joint come before those of the next one, in the order 1, 3, 2, 4, 5, 6. A held joint gives none
// Formats: those of six_pose; in_signs is in_branch of vector_ik6; out_word s2.25. Error: bounds.six.
// Latency: out_done is high one clock before vector_ik6 answers, together with the last word of the program, and
// out_status is valid from then on. A user raises in_start only when out_idle is high; in a clock with rst it is
// ignored. Model: six.ik6
`default_nettype none
module six_inverse_path #(
    parameter W = 16,      // bits of a coordinate, 4 to 16 (default 16)
    parameter U = 16,      // fraction bits of the matrix, 8 to 18 (default 16)
    parameter PIPE = 0,    // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
    parameter MARGINS = 0  // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
) (
    input  wire            clk,
    input  wire            rst,
    input  wire            in_start,
    input  wire [9*U+17:0] in_matrix,
    input  wire [3*W-1:0]  in_tip,
    input  wire [6*W+23:0] in_lengths,
    input  wire [26:0]     in_cp,
    input  wire [26:0]     in_np,
    input  wire [24:0]     in_r,
    input  wire [21:0]     in_e,
    input  wire [2*W-1:0]  in_edges,
    input  wire [2:0]      in_signs,
    output wire            out_idle,
    output wire            out_done,
    output wire [26:0]     out_word,
    output wire [5:0]      out_dest,
    output wire [3:0]      out_status
);
    generate
        if (W < 4 || W > 16 || U < 8 || U > 18 || PIPE < 0 || PIPE > 2 || MARGINS < 0 || MARGINS > 1) begin : g_illegal
            six_inverse_path_needs_W_from_4_to_16_and_U_from_8_to_18_and_PIPE_0_to_2_and_MARGINS_0_or_1 rule ();
        end
    endgenerate

    wire [46:0] op;
    wire [26:0] port;
    reg  [2:0]  signs;
    generate
        if (MARGINS != 0) begin : g_near
            vector_ik6_near_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(in_start),
                .out_idle(out_idle), .out_done(out_done), .out_op(op));
        end else begin : g_exact
            vector_ik6_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle),
                .out_done(out_done), .out_op(op));
        end
    endgenerate
    six_pose #(.W(W), .U(U), .EDGES(MARGINS)) pose (.clk(clk), .in_take(in_start), .in_matrix(in_matrix),
        .in_tip(in_tip), .in_lengths(in_lengths), .in_cp(in_cp), .in_np(in_np), .in_r(in_r), .in_e(in_e),
        .in_edges(in_edges), .in_select(op[43:39]), .out_word(port));
    product_engine #(.PIPE(PIPE), .WRIST(28-U), .SLACK(29-U), .MARGINS(MARGINS)) engine (.clk(clk), .rst(rst),
        .in_start(in_start), .in_run(!out_idle), .in_op(op), .in_port(port), .in_signs(signs), .out_word(out_word),
        .out_dest(out_dest), .out_status(out_status));
    always @(posedge clk)
        if (in_start)
            signs <= in_signs;
endmodule
`default_nettype wire
