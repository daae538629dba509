// SPDX-License-Identifier: Apache-2.0
// One digit d in -2 .. 2 of the residual angle, and its row of the linear rotation, combinational.
//   out_x = in_x - d (in_yf >> S),  out_y = in_y + d (in_xf >> S),  z' = 4 (z - d radian); minus: one's complement
// The digit reads three bits and the sign: 1 from 0.39, 2 from 1.57 radians, where -2 .. 2 leaves 1/3 to either side.
// The arithmetic of cordic_turn_iter, bit for bit.
`default_nettype none
module cordic_digit #(
    parameter S = 2,
    parameter P = 15,
    parameter Z = 20,
    parameter LOW = 6
) (
    input  wire        [P-1:0] in_x,
    input  wire        [P-1:0] in_y,
    input  wire signed [P-1:0] in_xf,
    input  wire signed [P-1:0] in_yf,
    input  wire        [Z-1:0] in_z,
    output wire        [P-1:0] out_x,
    output wire        [P-1:0] out_y,
    output wire        [Z-1:0] out_z
);
    wire         minus = in_z[Z-1];
    wire [2:0]   top = in_z[Z-2 -: 3] ^ {3{minus}};
    wire         two = top[2];
    wire         some = top != 3'd0;
    wire [P-1:0] xt = two ? in_xf >>> S - 1 : in_xf >>> S;
    wire [P-1:0] yt = two ? in_yf >>> S - 1 : in_yf >>> S;
    wire [Z+8:0] radian;
    wire [Z-1:0] angle = two ? {radian[Z-2:0], 1'b0} : radian[Z-1:0];
    wire [Z-1:0] sum;
    wire         unused = &{1'b0, radian[Z+8:Z]};
    cordic_angle #(.I(9), .Z(Z + 9)) constant (.in_minus(1'b0), .out_sum(radian));
    assign out_x = in_x + ((yt ^ {P{!minus}}) & {P{some}});
    assign out_y = in_y + ((xt ^ {P{ minus}}) & {P{some}});
    assign sum = in_z + ((angle ^ {Z{!minus}}) & {Z{some}} << LOW);
    assign out_z = sum << 2;
endmodule
`default_nettype wire
