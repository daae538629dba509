// SPDX-License-Identifier: Apache-2.0
// 1/q as two factors without an addend, in one memory block of 512 x 20 bits, for users who multiply by both in turn:
// the tangent in the middle t of segment a,  q = (a + d) h, d in [0, 1), h = 2^-8:  1/q = (2 t - q) / t^2, and 2 t - q
// is wiring: the one's complement of d.
// Formats: in_q u2.17, the sum of two words truncated to 2^-17; out_w u1.16, out_slope u4.16, one clock later.
//   1/q = out_w * out_slope / 2^32; a user may take ~out_w for -out_w, half of whose unit is in the slope
// Range: 1/4 <= q <= 2; q = 2 alone has bit 18 set, and the exact product 1/2.
// Error, relative: (h / 2t)^2 / 2 = 2^-15 at q = 1/4 of sag; w 1.25 * 2^-16 / q with its sign; slope q^2 * 2^-17.
// Model: rational._reciprocal_slopes
`default_nettype none
module reciprocal_pair (
    input  wire        clk,
    input  wire [18:0] in_q,
    output reg  [16:0] out_w,
    output reg  [19:0] out_slope
);
    // With b = 2a + 1: 2^34 / b^2, raised by half the loss at a border, 1 / 2b^2, and lowered by the quarter of a unit
    // that w is too large on average, 1 / 512b. Entry 0 is q = 2; those of q < 1/4 are never read.
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
