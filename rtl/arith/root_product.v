// SPDX-License-Identifier: Apache-2.0
// This part gives the square root of a fraction, or of its complement, as two factors.
//   sqrt(v) = out_w * out_slope / 2^(B+17), v = in_not ? 1 - in_v : in_v = (a + d) h, d in [0, 1), t = a + 1/2;
//   the tangent in the middle of segment a, (v/h + t) * sqrt(h) / (2 sqrt(t)), needs no addend, and v/h + t is wiring
// Formats: in_v is u0.S; out_w u19 comes with in_v; out_slope uB comes one clock after in_read and is held.
// Four ranges of v, from 2^-4, 2^-9, 2^-15 and 0, have 512 segments each, so w is a 4:1 multiplexer. Slopes are stored
// denormalised, so nothing is shifted. 1 - v is ~v followed by ones. The last range has a segment for every word.
// Error: |sqrt - product| <= 0.52 * 2^-15 at B = 17, 0.31 * 2^-15 at B = 20; 0 is exact. The product may step back by
// 0.84 * 2^-15 at a segment border.
// Model: arith.root_product
`default_nettype none
module root_product #(
    parameter S = 24,  // bits of the radicand, 1 to 24 (default 24)
    parameter B = 17   // bits of a slope, 17 to 20 (default 17)
) (
    input  wire         clk,
    input  wire         in_read,
    input  wire [S-1:0] in_v,
    input  wire         in_not,
    output reg  [18:0]  out_w,
    output reg  [B-1:0] out_slope
);
    generate
        if (S < 1 || S > 24 || B < 17 || B > 20) begin : g_illegal
            root_product_needs_S_from_1_to_24_and_B_from_17_to_20 rule ();
        end
    endgenerate

    // This function returns 2^(B+8) times the slopes of one range; Newton's rule finds each root from the one before.
    // With b = 2 t the factor 1 - 1/(8 b^2) under the root lowers the tangent by half of what it gains towards the ends
    // of the segment; 1 + 1/(512 b) centres the truncation of d. In the last range (shift = 0) the product is exact.
    function [512*B-1:0] slopes(input integer shift);
        integer    a;
        reg [63:0] b, square, root;
        begin
            slopes = 0;
            root = shift > 0 ? 64'd1 << 1 + B : 64'd1 << B - 3;
            for (a = 0; a < 512; a = a + 1) begin
                b = {31'd0, a, 1'b1};
                square = ((512 * b + 1) * (8 * b * b - 1) << 20) / (b * b * b * b) << shift + 2 * (B - 17);
                if (shift == 0) begin
                    b = {32'd0, a};
                    square = a > 0 ? ((16 * b * b - 1) << 22 + 2 * (B - 17)) / (b * b * b) : 64'd1 << 28 + 2 * (B - 17);
                end
                root = (root + square / root) >> 1;
                root = (root + square / root) >> 1;
                root = (root + square / root) >> 1;
                root = (root + square / root) >> 1;
                slopes[B*a +: B] = root[B:1] + {{(B-1){1'b0}}, root[0]};
            end
        end
    endfunction
    // There is one constant a range because Icarus copies the whole constant for every entry
    localparam [512*B-1:0] RANGE0 = slopes(10), RANGE1 = slopes(6), RANGE2 = slopes(1), RANGE3 = slopes(0);
    reg [B-1:0] slope[0:2047];
    integer     a;
    initial
        for (a = 0; a < 512; a = a + 1) begin
            slope[a]        = RANGE0[B*a +: B];
            slope[512 + a]  = RANGE1[B*a +: B];
            slope[1024 + a] = RANGE2[B*a +: B];
            slope[1536 + a] = RANGE3[B*a +: B];
        end

    wire [23:0] v = {in_v, {(24-S){1'b0}}} ^ {24{in_not}};
    wire        high = |v[23:20], middle = |v[19:15], low = |v[14:9];
    wire [1:0]  range = {!high && !middle, !high && (middle || !low)};
    always @*
        case (range)
            2'd0: out_w = {v[23:14], ~v[14], v[13:6]};
            2'd1: out_w = {v[19:10], ~v[10], v[9:2]};
            2'd2: out_w = {v[14:5], ~v[5], v[4:0], {3{in_not}}};
            default: out_w = {v[8:0], in_not, 9'd0};
        endcase
    always @(posedge clk)
        if (in_read)
            out_slope <= slope[{range, out_w[18:10]}];
endmodule
`default_nettype wire
