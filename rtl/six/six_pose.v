// SPDX-License-Identifier: Apache-2.0
// A pose, held from in_take on, and the constants of an arm as operands of product_engine.
//   out_word = word in_select of r11 to r33, x, y, z, a1, b, c1, c2, c4, k, cp, np, r, e, 1; one clock later
// With EDGES margin and slack stand before 1.
// Formats: in_matrix nine words s2.U, r11 in the lowest bits; in_tip x, y, z; in_lengths a1, b, c1, c2, c4, k, in 1/16
// LSB; in_cp to in_e by six.config; in_edges margin and slack, in LSB; out_word s2.25, 1.0 of a length being 2^W LSB.
// Exact. It has no model, since it only moves words.
`default_nettype none
module six_pose #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter U = 16,   // fraction bits of the matrix, 8 to 18 (default 16)
    parameter EDGES = 0 // 0 or 1 (default 0); 1: with in_edges
) (
    input  wire              clk,
    input  wire              in_take,
    input  wire [9*U+17:0]   in_matrix,
    input  wire [3*W-1:0]    in_tip,
    input  wire [6*W+23:0]   in_lengths,
    input  wire [26:0]       in_cp,
    input  wire [26:0]       in_np,
    input  wire [24:0]       in_r,
    input  wire [21:0]       in_e,
    input  wire [2*W-1:0]    in_edges,
    input  wire [4:0]        in_select,
    output wire [26:0]       out_word
);
    generate
        if (W < 4 || W > 16 || U < 8 || U > 18 || EDGES < 0 || EDGES > 1) begin : g_illegal
            six_pose_needs_W_from_4_to_16_and_U_from_8_to_18_and_EDGES_0_or_1 rule ();
        end
    endgenerate

    reg  [9*U+17:0]     matrix;
    reg  [3*W-1:0]      tip;
    localparam COUNT = 23 + 2 * EDGES;
    wire [COUNT*27-1:0] words;
    assign              words[18*27 +: 4*27] = {5'd0, in_e, 2'd0, in_r, in_np, in_cp};
    assign              words[(COUNT-1)*27 +: 27] = 27'h2000000;
    genvar              i;
    generate
        for (i = 0; i < 9; i = i + 1) begin : g_matrix
            assign words[27*i +: 27] = {matrix[(U+2)*i +: U+2], {(25-U){1'b0}}};
        end
        for (i = 0; i < 3; i = i + 1) begin : g_tip
            assign words[27*(9+i) +: 27] = {{2{tip[W*i+W-1]}}, tip[W*i +: W], {(25-W){1'b0}}};
        end
        for (i = 0; i < 6; i = i + 1) begin : g_length
            assign words[27*(12+i) +: 27] = {{2{in_lengths[(W+4)*i+W+3]}}, in_lengths[(W+4)*i +: W+4], {(21-W){1'b0}}};
        end
        for (i = 0; i < 2 * EDGES; i = i + 1) begin : g_edges
            assign words[27*(22+i) +: 27] = {{2{in_edges[W*i+W-1]}}, in_edges[W*i +: W], {(25-W){1'b0}}};
        end
        if (EDGES == 0) begin : g_exact
            wire unused = &{1'b0, in_edges};
        end
    endgenerate
    engine_ports #(.COUNT(COUNT)) operands (.clk(clk), .in_words(words), .in_select(in_select), .out_word(out_word));
    always @(posedge clk)
        if (in_take) begin
            matrix <= in_matrix;
            tip    <= in_tip;
        end
endmodule
`default_nettype wire
