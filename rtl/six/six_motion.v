// SPDX-License-Identifier: Apache-2.0
// Joints 1 to 5 and a motion, held from in_take on, and the lengths of an arm as operands of product_engine.
//   out_word = word in_select of c1, n1 to c5, n5, the six words of the motion, a1, a2, b, c2, c3, c4, 1; a clock later
// Formats: in_joints ten words s2.U, c1 in the lowest bits; in_motion six words sW, of which the first three have FINE
// fraction bits more than W; in_lengths in 1/16 LSB; out_word s2.25, where 1.0 of a length is 2^W LSB. Exact. It has no
// model, since it only moves words.
`default_nettype none
module six_motion #(
    parameter W = 16,   // bits of a coordinate and of a rate, 4 to 16 (default 16)
    parameter U = 16,   // fraction bits of a unit vector, 8 to 18 (default 16)
    parameter FINE = 0  // fraction bits beyond W of the first three words of the motion, 0 to 8 (default 0)
) (
    input  wire             clk,
    input  wire             in_take,
    input  wire [10*U+19:0] in_joints,
    input  wire [6*W-1:0]   in_motion,
    input  wire [6*W+23:0]  in_lengths,
    input  wire [4:0]       in_select,
    output wire [26:0]      out_word
);
    generate
        if (W < 4 || W > 16 || U < 8 || U > 18 || FINE < 0 || FINE > 8) begin : g_illegal
            six_motion_needs_W_from_4_to_16_and_U_from_8_to_18_and_FINE_from_0_to_8 rule ();
        end
    endgenerate

    reg  [10*U+19:0] joints;
    reg  [6*W-1:0]   motion;
    wire [23*27-1:0] words;
    assign           words[22*27 +: 27] = 27'h2000000;
    genvar           i;
    generate
        for (i = 0; i < 10; i = i + 1) begin : g_joint
            assign words[27*i +: 27] = {joints[(U+2)*i +: U+2], {(25-U){1'b0}}};
        end
        for (i = 0; i < 6; i = i + 1) begin : g_motion
            localparam S = i < 3 ? FINE : 0;
            assign words[27*(10+i) +: 27] = {{(2+S){motion[W*i+W-1]}}, motion[W*i +: W], {(25-W-S){1'b0}}};
            assign words[27*(16+i) +: 27] = {{2{in_lengths[(W+4)*i+W+3]}}, in_lengths[(W+4)*i +: W+4], {(21-W){1'b0}}};
        end
    endgenerate
    engine_ports #(.COUNT(23)) operands (.clk(clk), .in_words(words), .in_select(in_select), .out_word(out_word));
    always @(posedge clk)
        if (in_take) begin
            joints <= in_joints;
            motion <= in_motion;
        end
endmodule
`default_nettype wire
