// SPDX-License-Identifier: Apache-2.0
// The row of one digit d of the residual angle in the linear rotation, combinational.
//   out_x = in_x - d (in_yf >> S),  out_y = in_y + d (in_xf >> S); minus is the one's complement
// V bits hold the sums: those of the vector's P would only repeat the sign. in_digit: see cordic_digit.
`default_nettype none
module cordic_row #(
    parameter S = 2,
    parameter P = 15,
    parameter V = 15
) (
    input  wire        [2:0]   in_digit,
    input  wire        [V-1:0] in_x,
    input  wire        [V-1:0] in_y,
    input  wire signed [P-1:0] in_xf,
    input  wire signed [P-1:0] in_yf,
    output wire        [V-1:0] out_x,
    output wire        [V-1:0] out_y
);
    wire         minus = in_digit[2], two = in_digit[1], some = in_digit[0];
    wire [P-1:0] xt = two ? in_xf >>> S - 1 : in_xf >>> S;
    wire [P-1:0] yt = two ? in_yf >>> S - 1 : in_yf >>> S;
    wire         unused = &{1'b0, xt, yt};
    assign out_x = in_x + ((yt[V-1:0] ^ {V{!minus}}) & {V{some}});
    assign out_y = in_y + ((xt[V-1:0] ^ {V{ minus}}) & {V{some}});
endmodule
`default_nettype wire
