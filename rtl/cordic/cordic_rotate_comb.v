// SPDX-License-Identifier: Apache-2.0
// This core rotates a vector by a binary angle, full circle, gain compensated: a parallel CORDIC, combinational.
//   out_x + j out_y = (in_x + j in_y) * exp(2 pi j in_angle / 2^A), nearest, saturated
// Formats: in_angle is uA, a turn is 2^A; in_x, in_y, out_x and out_y are sW, any fraction.
// Error: a coordinate is within 1.55 LSB at every W and A (bounds.cordic.rotate; 1.05 found at W = A = 16).
// Status: overflow (a coordinate was saturated). Model: cordic.rotate
`default_nettype none
module cordic_rotate_comb #(
    parameter W = 16,  // bits of a coordinate, 8 to 16 (default 16)
    parameter A = 16   // bits of an angle, a turn is 2^A, 5 to W + 3 (default 16)
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
