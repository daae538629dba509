// SPDX-License-Identifier: Apache-2.0
// Slopes of three functions of (a + d) h, d in [0, 1), each a product w * slope without an addend: the tangent in the
// middle t = (a + 1/2) h of segment a, w wiring of the argument. One memory, 4 ranges of 512 segments.
//   in_range 0, 1: sqrt(v), w = v/h + t/h, h = 2^-9 (v from 2^-5 to 1) or 2^-14 (v below 2^-5); 2, segments below 128:
//   the same with h = 2^-19 (v below 2^-12)
//   in_range 2: 1/q, w = 2 t - q;  3: 2/sqrt(q), w = (3 t - q) / 2, h = 2^-9, both for q from 1/4 to 1
// Formats: out_slope u20 one clock after in_read, held: w in units of 2 h times slope / 2^18 is sqrt(v); w times
// slope / 2^18 is a quarter of 1/q or of 2/sqrt(q), always below 1.
// Error, relative: half of what the tangent loses at a border, 1/16 b^2, 1/2 b^2, 3/16 b^2, b = 2 a + 1; half a unit.
// Model: vector_solve._slopes
`default_nettype none
module kernel_vector_slopes (
    input  wire        clk,
    input  wire        in_read,
    input  wire [1:0]  in_range,
    input  wire [8:0]  in_segment,
    output reg  [19:0] out_slope
);
    // With b = 2 t/h: sqrt((8 b^2 - 1) 2^41 / b^3), 2^-5 of the radicand in range 1, 2^-10 in range 2; 2^35 (2 b^2 + 1) / b^4;
    // sqrt((8 b^2 + 3) 2^61 / b^5). Roots by Newton's rule from the one before; below segment 128
    // there is no q, so range 2 begins with the roots.
    function [512*20-1:0] slopes(input integer range);
        integer    a;
        reg [63:0] b, square, root;
        begin
            slopes = 0;
            root = range == 2 ? 64'd1 << 19 : 64'd1 << 21;
            for (a = range < 3 ? 0 : 128; a < 512; a = a + 1) begin
                b = {31'd0, a, 1'b1};
                square = (range < 3 ? 8 * b * b - 1 : 8 * b * b + 3) << 40;
                square = square / (b * b * b);
                square = range == 0 ? square << 3 : range == 1 ? square >> 2 : range == 2 ? square >> 7 :
                         (square << 23) / (b * b);
                root = (root + square / root) >> 1;
                root = (root + square / root) >> 1;
                root = (root + square / root) >> 1;
                root = (root + square / root) >> 1;
                if (range == 2 && a >= 128)
                    root = ((((2 * b * b + 1) << 36) / (b * b)) << 4) / (b * b) >> 4;
                slopes[20*a +: 20] = root[20:1] + {19'd0, root[0]};
            end
        end
    endfunction
    // A constant a range, not one of all: Icarus copies the whole constant for every entry
    localparam [512*20-1:0] RANGE0 = slopes(0), RANGE1 = slopes(1), RANGE2 = slopes(2), RANGE3 = slopes(3);
    reg [19:0] slope[0:2047];
    integer    a;
    initial
        for (a = 0; a < 512; a = a + 1) begin
            slope[a]        = RANGE0[20*a +: 20];
            slope[512 + a]  = RANGE1[20*a +: 20];
            slope[1024 + a] = RANGE2[20*a +: 20];
            slope[1536 + a] = RANGE3[20*a +: 20];
        end
    always @(posedge clk)
        if (in_read)
            out_slope <= slope[{in_range, in_segment}];
endmodule
`default_nettype wire
