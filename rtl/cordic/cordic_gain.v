// SPDX-License-Identifier: Apache-2.0
// 1 / prod sqrt(1 + 4^-i), i = 1, 2 .. = 0.858785 times a word, as two words to be added, combinational.
//   v - (v >> 3)  and  -(v >> 6) - (v >> 11) - (v >> 13) + (v >> 16), the first N digits, each shift rounded down
// and every minus a one's complement. Error of the constant: 9e-6 at N = 6.
`default_nettype none
module cordic_gain #(
    parameter D = 22,
    parameter N = 6
) (
    input  wire signed [D-1:0] in_v,
    output wire        [D-1:0] out_coarse,
    output wire        [D-1:0] out_fine
);
    wire signed [D-1:0] v3 = in_v >>> 3;
    wire signed [D-7:0] v6 = in_v[D-1:6];
    wire signed [D-7:0] v11 = v6 >>> 5;
    wire signed [D-7:0] v13 = v6 >>> 7;
    wire signed [D-7:0] v16 = v6 >>> 10;
    wire        [D-7:0] fine = ~v6 + (~v11 & {(D-6){N > 3}}) + (~v13 & {(D-6){N > 4}}) + (v16 & {(D-6){N > 5}});
    assign out_coarse = in_v + ~v3;
    assign out_fine = {{6{fine[D-7]}}, fine};
endmodule
`default_nettype wire
