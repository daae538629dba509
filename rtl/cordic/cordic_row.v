// SPDX-License-Identifier: Apache-2.0
// This part adds to the vector what one digit d of the residual angle contributes, combinational.
//   out_x = in_x - d (in_yf >> S),  out_y = in_y + d (in_xf >> S); minus is the one's complement
// The sums need V bits only, because all higher bits repeat the sign. in_digit is the out_digit of cordic_digit.
// Model: cordic.turn
`default_nettype none
module cordic_row #(
    parameter S = 2,   // shift of the digit below the vector >> C, 2 or more (default 2: the first row)
    parameter P = 15,  // bits of the vector that the row uses (default 15 = D - C + 1 at W = 16)
    parameter V = 15   // bits of the sums, up to P (default 15)
) (
    input  wire        [2:0]   in_digit,
    input  wire signed [V-1:0] in_x,
    input  wire signed [V-1:0] in_y,
    input  wire signed [P-1:0] in_xf,
    input  wire signed [P-1:0] in_yf,
    output wire signed [V-1:0] out_x,
    output wire signed [V-1:0] out_y
);
    wire         minus = in_digit[2], two = in_digit[1], some = in_digit[0];
    wire [P-1:0] xt = two ? in_xf >>> S - 1 : in_xf >>> S;
    wire [P-1:0] yt = two ? in_yf >>> S - 1 : in_yf >>> S;
    wire         unused = &{1'b0, xt, yt};
    assign out_x = in_x + ((yt[V-1:0] ^ {V{!minus}}) & {V{some}});
    assign out_y = in_y + ((xt[V-1:0] ^ {V{ minus}}) & {V{some}});
endmodule
`default_nettype wire
