// SPDX-License-Identifier: Apache-2.0
// This part clamps two words of W + 1 bits to W bits, combinational. out_overflow is high if at least one did not fit.
`default_nettype none
module cordic_clamp #(
    parameter W = 16  // bits of a coordinate, 8 to 16 (default 16)
) (
    input  wire signed [W:0]   in_x,
    input  wire signed [W:0]   in_y,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire                out_overflow
);
    wire over_x = in_x[W] != in_x[W-1];
    wire over_y = in_y[W] != in_y[W-1];
    assign out_x = over_x ? {in_x[W], {(W-1){!in_x[W]}}} : in_x[W-1:0];
    assign out_y = over_y ? {in_y[W], {(W-1){!in_y[W]}}} : in_y[W-1:0];
    assign out_overflow = over_x || over_y;
endmodule
`default_nettype wire
