// SPDX-License-Identifier: Apache-2.0
// Axis nearest to a unit vector, and the sine of the angle from it, anticlockwise: direction = axis + asin(sine). The x
// axis is chosen where |n| < 11/16, so no two words are compared. The sine of a unit vector is then below 0.727: beside
// the y axis |c| is at most sqrt(1 - (11/16)^2).
// Formats: in_c, in_n s2.U (1.0 is 2^U); out_axis u2.0 quarter turns; out_minor s2.U, the coordinate across the axis;
// out_sine s2.(U+E): it, or its one's complement with E ones below, which is 2^-(U+E) less than the sine.
// Status: out_none (|c| < 1/2 and |n| < 11/16, no unit vector). Combinational. Error: none, but for the one's
// complement. Model: conversion.nearest_axis
`default_nettype none
module nearest_axis #(
    parameter U = 16,  // fraction bits of the vector, 6 or more (default 16)
    parameter E = 1    // additional fraction bits of the sine, 1 or more (default 1), as the next multiplier allows
) (
    input  wire signed [U+1:0]   in_c,
    input  wire signed [U+1:0]   in_n,
    output wire                  out_none,
    output wire [1:0]            out_axis,
    output wire signed [U+1:0]   out_minor,
    output wire signed [U+E+1:0] out_sine
);
    wire [4:0] size = in_n[U:U-4] ^ {5{in_n[U+1]}};  // |n| in 1/16, rounded down
    wire near_x = !(size[4] || (size[3] && (size[2] || (size[1] && size[0]))));
    wire turned = near_x ? in_c[U+1] : !in_n[U+1];  // the coordinate increases clockwise
    assign out_none = near_x && (&in_c[U+1:U-1] || ~|in_c[U+1:U-1]);
    assign out_axis = {near_x ? in_c[U+1] : in_n[U+1], !near_x};
    assign out_minor = near_x ? in_n : in_c;
    assign out_sine = {out_minor, {E{1'b0}}} ^ {(U+E+2){turned}};
endmodule
`default_nettype wire
