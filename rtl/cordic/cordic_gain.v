// SPDX-License-Identifier: Apache-2.0
// This part multiplies a word by 1 / prod sqrt(1 + 4^-i), i = 1, 2 .. = 0.858785, as three words to be added.
//   out_coarse = v - (v >> 3), out_middle = -(v >> 6), out_fine = -(v >> 11) - (v >> 13) + (v >> 16)
// The first N digits are used. Each shift rounds down, and every minus is a one's complement. Combinational.
// Error of the constant: 9e-6 at N = 6. Model: cordic.rotate
`default_nettype none
module cordic_gain #(
    parameter D = 22,  // bits of the vector, guard bits included, 16 or more (default 22 = W + 6 at W = 16)
    parameter N = 6    // digits of the constant, 3 to 6 (default 6: what W = 16 needs)
) (
    input  wire signed [D-1:0] in_v,
    output wire signed [D-1:0] out_coarse,
    output wire signed [D-7:0] out_middle,
    output wire signed [D-7:0] out_fine
);
    wire signed [D-1:0] v3 = in_v >>> 3;
    wire signed [D-7:0] v6 = in_v[D-1:6];
    wire signed [D-7:0] v11 = v6 >>> 5;
    wire signed [D-7:0] v13 = v6 >>> 7;
    wire signed [D-7:0] v16 = v6 >>> 10;
    // each adder is as narrow as its result
    localparam P13 = D - 12, P11 = D - 10;
    wire [P13-1:0] two = (v16[P13-1:0] & {P13{N > 5}}) + (~v13[P13-1:0] & {P13{N > 4}});
    wire [P11-1:0] three = {{2{two[P13-1]}}, two} + (~v11[P11-1:0] & {P11{N > 3}});
    wire           unused = &{1'b0, v11, v13, v16};
    assign out_coarse = in_v + ~v3;
    assign out_middle = ~v6;
    assign out_fine = {{4{three[P11-1]}}, three};
endmodule
`default_nettype wire
