// SPDX-License-Identifier: Apache-2.0
// Rotates a vector by a binary angle, full circle, gain compensated: the parallel CORDIC, combinational.
//   out_x + j out_y = (in_x + j in_y) * exp(2 pi j in_angle / 2^A), rounded to nearest, saturated
// Formats: in_angle uA, 2^A to the turn; in_x, in_y, out_x, out_y sW, any fraction.
// Error: at most 1.55 LSB each at every W and A (derivation on the family's page; 1.1 found at W = 16).
// Status: overflow. Model: cordic.rotate
`default_nettype none
module cordic_rotate_comb #(
    parameter W = 16,  // bits of a coordinate, 8 to 16; 16 is the library's word
    parameter A = 16   // bits of an angle, 5 to W + 3, 2^A to the turn; 16, as sharp as the coordinates
) (
    input  wire        [A-1:0] in_angle,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire        [3:0]   out_status
);
    generate
        if (W < 8 || W > 16 || A < 5 || A > W + 3) begin : g_illegal
            cordic_rotate_comb_needs_W_from_8_to_16_and_A_from_5_to_W_plus_3 rule ();
        end
    endgenerate
    cordic_rotate_array #(.W(W), .A(A), .CLOCKED(0)) array (.clk(1'b0), .in_enable(1'b0),
        .in_angle(in_angle), .in_x(in_x), .in_y(in_y), .out_x(out_x), .out_y(out_y), .out_status(out_status));
endmodule
`default_nettype wire
