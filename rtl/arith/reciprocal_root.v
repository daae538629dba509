// SPDX-License-Identifier: Apache-2.0
// This part gives 1/sqrt(q) as two factors: the tangent in the middle t of segment a.
//   1/sqrt(q) = out_w * out_slope / 2^36: (3 t - q) / (2 t^(3/2)), q = (a + d) h, d in [0, 1), t = (a + 1/2) h,
//   h = 2^-9; 3 t - q is wiring, one's complement included
// Formats: in_q is u2.18; out_w is u3.18, in the same clock; out_slope is u2.18, one clock after in_read, and is held.
// Range: 1/4 <= q <= 2. The word of q = 2 is in segment 0, which no other q of the range needs.
// Relative error: at most 0.8 * 2^-16. At q = 1/4 the tangent loses 0.19 * 2^-16; at q = 2 half a unit of the slope is
// 0.71 * 2^-16.
// Model: arith.reciprocal_root
`default_nettype none
module reciprocal_root (
    input  wire        clk,
    input  wire        in_read,
    input  wire [19:0] in_q,
    output wire [20:0] out_w,
    output reg  [19:0] out_slope
);
    // With b = 2a + 1 an entry is 2^32 / b^(3/2), raised by half of what the tangent loses at the ends of its segment,
    // 3 / 16 b^2, and by what the one's complement takes from w, 1 / 512 b
    function [19:0] slope_at(input integer a);
        reg [63:0] b, square, root;
        integer    i;
        begin
            b = a == 0 ? 64'd2049 : {31'd0, a, 1'b1};
            square = ((256 * b * b + b + 96) << 33) / (b * b * b);
            square = (square << 25) / (b * b);
            root = b < 512 ? 64'd1 << 20 : b < 1024 ? 64'd1 << 19 : 64'd1 << 17;
            for (i = 0; i < 6; i = i + 1)
                root = (root + square / root) >> 1;
            root = (root + 1) >> 1;
            slope_at = a == 0 || a >= 128 ? root[19:0] : 20'd0;
        end
    endfunction
    reg [19:0] slopes[0:1023];
    integer    a;
    initial
        for (a = 0; a < 1024; a = a + 1)
            slopes[a] = slope_at(a);

    assign out_w = {in_q[19:9], ~in_q[8], in_q[8], ~in_q[7:0]};
    always @(posedge clk)
        if (in_read)
            out_slope <= slopes[in_q[18:9]];
endmodule
`default_nettype wire
