// SPDX-License-Identifier: Apache-2.0
// The product of two words of 27 bits, for the kernels with one multiplier for many words.
//   PIPE = 0: out_product and out_settled are combinational.
//   PIPE = 1: out_product belongs to the words of the clock before; out_settled is it a clock later, from a register
// Formats: two's complement, all bits of the product. Error: none. Models: those of the kernels
`default_nettype none
module kernel_product #(
    parameter PIPE = 0,      // registers behind the product, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire               clk,
    input  wire signed [26:0] in_left,
    input  wire signed [26:0] in_right,
    output wire signed [53:0] out_product,
    output wire signed [53:0] out_settled
);
    generate
        if (PIPE == 0) begin : g_now
            assign out_product = in_left * in_right;
            assign out_settled = out_product;
            wire   unused = &{1'b0, clk};
        end
        if (PIPE == 1) begin : g_parts
            product_parts #(.A(27), .B(27), .MULTIPLY(MULTIPLY)) parts (.clk(clk), .in_move(1'b1), .in_a(in_left),
                .in_b(in_right), .out_p(out_product));
            reg signed [53:0] settled;
            always @(posedge clk)
                settled <= out_product;
            assign out_settled = settled;
        end
    endgenerate
endmodule
`default_nettype wire
