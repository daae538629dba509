// SPDX-License-Identifier: Apache-2.0
// This part gives 1/q as two factors for users that multiply by both in turn. It is one memory block of 512 x 20 bits.
//   1/q = out_w * out_slope / 2^32: the tangent in the middle t of segment a, 1/q = (2 t - q) / t^2, with
//   q = (a + d) h, d in [0, 1), h = 2^-8; 2 t - q is wiring, the one's complement of d
// Formats: in_q is u2.17, a sum of two words truncated to 2^-17; out_w u1.16 and out_slope u4.16 come one clock later.
// A user may take ~out_w for -out_w: half of its unit is in the slope.
// Range: 1/4 <= q <= 2. Only q = 2 has bit 18 set, and its product is exactly 1/2.
// Relative error: at most 2^-19 / q^2 (tangent) + 1.25 * 2^-16 / q (out_w, with either sign) + 2^-17 q^2 (slope).
// Model: rational.reciprocal_pair
`default_nettype none
module reciprocal_pair (
    input  wire        clk,
    input  wire [18:0] in_q,
    output reg  [16:0] out_w,
    output reg  [19:0] out_slope
);
    // With b = 2a + 1 an entry is 2^34 / b^2, raised by half the loss at a segment border, 1 / 2b^2, and lowered by the
    // quarter of a unit by which w is too large on average, 1 / 512b. Entry 0 serves q = 2; q < 1/4 is never read.
    function [19:0] slope_at(input integer a);
        reg [63:0] b, word;
        begin
            b = a < 64 ? 64'd129 : {31'd0, a, 1'b1};
            word = ((2 * b * b + 1) * (512 * b - 1) << 22) / (b * b * b);
            word = ((word << 3) / (b * b) + 1) >> 1;
            slope_at = a == 0 ? 20'h08000 : word[19:0];
        end
    endfunction
    reg [19:0] slopes[0:511];
    integer    a;
    initial
        for (a = 0; a < 512; a = a + 1)
            slopes[a] = slope_at(a);

    always @(posedge clk) begin
        out_slope <= slopes[in_q[17:9]];
        out_w     <= {in_q[17:9], ~in_q[8:1]};
        if (in_q[18])
            out_w <= 17'h10000;
    end
    wire unused = &{1'b0, in_q[0]};
endmodule
`default_nettype wire
