// SPDX-License-Identifier: Apache-2.0
// This part adds a shifted word or another one, or the one's complement of either. Combinational.
//   out_sum = in_a + (t ^ minus),  t = in_v >> n, n = 9 in_shift[5:4] + 3 in_shift[3:2] + in_shift[1:0], arithmetic
//   in_shift = 3: t = in_word
// Shifts are in base 3, because a multiplexer of three words is one five-input cell: 27 shifts and the sign cost three
// cells a bit. The free fourth input of one multiplexer serves the other word, so the vector registers need no load
// multiplexer. Written in pairs and in this order, because Yosys maps it to the fewest cells of an ECP5.
`default_nettype none
module cordic_term #(
    parameter D = 23  // bits of the vector, guard bits included, 8 or more (default 23 = W + 7 at W = 16)
) (
    input  wire signed [D-1:0] in_v,
    input  wire signed [D-1:0] in_word,
    input  wire        [5:0]   in_shift,
    input  wire                in_minus,
    input  wire signed [D-1:0] in_a,
    output wire signed [D-1:0] out_sum
);
    wire signed [D-1:0] by3 = in_shift[3] ? in_v >>> 6 : in_shift[2] ? in_v >>> 3 : in_v;
    wire signed [D-1:0] by1 = in_shift[1] ? in_shift[0] ? in_word : by3 >>> 2 : in_shift[0] ? by3 >>> 1 : by3;
    wire signed [D-1:0] by9 = in_shift[5] ? by1 >>> 18 : in_shift[4] ? by1 >>> 9 : by1;
    assign out_sum = in_a + (by9 ^ {D{in_minus}});
endmodule
`default_nettype wire
