// SPDX-License-Identifier: Apache-2.0
// This part is micro-rotation I of an unrolled CORDIC, combinational. Its second word w is y or ~y, whichever x adds.
//   x' = x + (w >> I),  u = w + ~(x >> I) + n,  w' = u or ~u,  z' = 2 (z -+ atan 2^-I),  n = w is ~y = z is positive
// This costs three cells a bit instead of four, because an exclusive-or before an adder is a cell of its own.
// The bits are those of cordic_turn_iter. Model: cordic.turn
`default_nettype none
module cordic_rotation #(
    parameter I    = 1,   // number of the micro-rotation, 1 to 12 (default 1)
    parameter D    = 22,  // bits of the vector, guard bits included (default 22 = W + 6 at W = 16)
    parameter Z    = 20,  // bits of the residual angle (default 20 = W + 4 at W = 16)
    parameter LAST = 0    // 1: the last one, whose w' is y' whatever the sign of z'; 0 (default): another
) (
    input  wire signed [D-1:0] in_x,
    input  wire signed [D-1:0] in_w,
    input  wire                in_n,
    input  wire signed [Z-1:0] in_z,
    output wire signed [D-1:0] out_x,
    output wire signed [D-1:0] out_w,
    output wire                out_n,
    output wire signed [Z-1:0] out_z
);
    localparam LOW = I > 3 ? I - 3 : 0;
    wire [Z+I-1:0] angle;  // scaled by 2^I: between 0.125 and 0.16
    wire [Z-1:0] sum;
    wire [D-1:0] xt = in_x >>> I;
    wire [D-1:0] wt = in_w >>> I;
    wire [D-1:0] u;
    wire         unused;
    cordic_angle #(.I(I), .Z(Z + I)) constant (.in_minus(in_n), .out_sum(angle));
    assign sum = in_z + (angle[Z-1:0] & {Z{1'b1}} << LOW);
    wire         unused_high = &{1'b0, angle[Z+I-1:Z]};
    assign out_z = sum << 1;
    assign out_n = LAST == 0 && !out_z[Z-1];
    assign out_x = in_x + wt;
    assign {u, unused} = {in_w, 1'b1} + {~xt, in_n};  // the carry in is one more bit of the chain
    assign out_w = u ^ {D{in_n ^ out_n}};
endmodule
`default_nettype wire
