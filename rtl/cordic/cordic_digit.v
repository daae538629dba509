// SPDX-License-Identifier: Apache-2.0
// This part finds one digit d in -2 .. 2 of the residual angle, combinational: z' = 4 (z - d radian).
// Minus is the one's complement. Three bits and the sign give the digit: |d| = 1 from 0.39, 2 from 1.57 radians, which
// leaves 1/3 to either side with the digit set -2 .. 2.
// out_digit = {z is negative, |d| = 2, d is not 0}. The bits are those of cordic_turn_iter. Model: cordic.turn
`default_nettype none
module cordic_digit #(
    parameter Z   = 20,  // bits of the residual angle, 8 or more (default 20 = W + 4 at W = 16)
    parameter LOW = 6    // low bits of the constant that are left out, below Z (default 6 = C - 2 at W = 16)
) (
    input  wire signed [Z-1:0] in_z,
    output wire        [2:0]   out_digit,
    output wire signed [Z-1:0] out_z
);
    wire         minus = in_z[Z-1];
    wire [2:0]   top = in_z[Z-2 -: 3] ^ {3{minus}};
    wire         two = top[2];
    wire         some = top != 3'd0;
    wire [Z+8:0] radian;
    wire [Z-1:0] angle = two ? {radian[Z-2:0], 1'b0} : radian[Z-1:0];
    wire [Z-1:0] sum;
    wire         unused = &{1'b0, radian[Z+8:Z]};
    cordic_angle #(.I(9), .Z(Z + 9)) constant (.in_minus(1'b0), .out_sum(radian));
    assign sum = in_z + ((angle ^ {Z{!minus}}) & {Z{some}} << LOW);
    assign out_z = sum << 2;
    assign out_digit = {minus, two, some};
endmodule
`default_nettype wire
