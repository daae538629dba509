// SPDX-License-Identifier: Apache-2.0
// The product of two words of 27 bits, for the kernels with one multiplier for many words.
//   PIPE = 0: out_product and out_settled are combinational.
//   PIPE = 1: out_product belongs to the words of the clock before; out_settled is it a clock later, from a register
// With MULTIPLY = 18 the registers hold four partial products of 17 and 10 bits a side, else the product itself.
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
        if (PIPE == 1 && MULTIPLY == 27) begin : g_whole
            reg signed [53:0] product;
            always @(posedge clk)
                product <= in_left * in_right;
            assign out_product = product;
        end
        if (PIPE == 1 && MULTIPLY == 18) begin : g_parts
            wire signed [17:0] low1 = {1'b0, in_left[16:0]}, low2 = {1'b0, in_right[16:0]};
            wire signed [9:0]  high1 = in_left[26:17], high2 = in_right[26:17];
            reg  signed [19:0] high;
            reg  signed [27:0] cross1, cross2;
            reg         [33:0] low;
            wire signed [35:0] lows = low1 * low2;
            wire               unused = &{1'b0, lows[35:34]};
            always @(posedge clk) begin
                high   <= high1 * high2;
                cross1 <= high1 * low2;
                cross2 <= low1 * high2;
                low    <= lows[33:0];
            end
            // One sum of three words, which Yosys makes with one carry chain
            wire        [36:0] upper = {high, low[33:17]} + {{9{cross1[27]}}, cross1} + {{9{cross2[27]}}, cross2};
            assign out_product = {upper, low[16:0]};
        end
        if (PIPE == 1) begin : g_settled
            reg signed [53:0] settled;
            always @(posedge clk)
                settled <= out_product;
            assign out_settled = settled;
        end
    endgenerate
endmodule
`default_nettype wire
