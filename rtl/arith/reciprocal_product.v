// SPDX-License-Identifier: Apache-2.0
// Reciprocal as a product without an addend, 1/q = out_w * out_slope: the tangent in the middle t of segment a,
//   q = (a + d) h, d in [0, 1), h = 2^-9, t = (a + 1/2) h:  1/q = (2 t - q) / t^2, and 2 t - q is wiring, {a, ~d}.
// Formats: in_q, out_q (its register), out_w u2.19; out_slope u4.18 (TOP: u5.18); one clock after in_read, held.
// Range: 1/4 <= q <= 2, with TOP up to 4; there a q that an error took below 1/4 gives just less than 4.
// Error, relative: 2^-17 at q = 1/4, half of what the tangent loses at a border, (h / 2t)^2; half a unit of the slope,
// 2^-17 at q = 2 and 2^-15 at q = 4; and what truncating q to in_q loses.
// Model: arith.reciprocal_product
`default_nettype none
module reciprocal_product #(
    parameter TOP = 0  // 1: q may reach 4, and the table has twice the words; 0: q reaches 2. 0, two memories less
) (
    input  wire            clk,
    input  wire            in_read,
    input  wire [20:0]     in_q,
    output reg  [20:0]     out_q,
    output wire [20:0]     out_w,
    output reg  [21+TOP:0] out_slope
);
    // With b = 2a + 1: 2^38 / b^2, raised by half the loss at a border, 1 / 2b^2, and by what truncation of q and the
    // one's complement take from w, 1 / 1024b. Without TOP entry 0 is q = 2, and those of q < 1/4 are not read.
    function [21+TOP:0] slope_at(input integer a);
        reg [63:0] b, raised;
        begin
            b = a < 128 ? 64'd2049 : {31'd0, a, 1'b1};
            raised = ((2 * b * b + 1) * (1024 * b + 1) << 16) / (b * b * b);
            raised = ((raised << 12) / (b * b) + 1) >> 1;
            if (TOP && a < 128)
                raised = (64'd1 << 29) / (a < 64 ? 64'd65 : {32'd0, a} + 1);
            slope_at = raised[21+TOP:0];
        end
    endfunction
    localparam WORDS = TOP ? 2048 : 1024;
    reg [21+TOP:0] slopes[0:WORDS-1];
    integer    a;
    initial
        for (a = 0; a < WORDS; a = a + 1)
            slopes[a] = slope_at(a);

    assign out_w = out_q ^ 21'h3ff;
    always @(posedge clk)
        if (in_read) begin
            out_q     <= in_q;
            out_slope <= slopes[in_q[19+TOP:10]];
        end
endmodule
`default_nettype wire
