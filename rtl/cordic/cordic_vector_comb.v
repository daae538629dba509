// SPDX-License-Identifier: Apache-2.0
// Length and direction of a vector, full circle, gain compensated: the parallel CORDIC, combinational.
//   out_magnitude = sqrt(in_x^2 + in_y^2), out_angle = atan2(in_y, in_x) / (2 pi) * 2^A, both to nearest
// Formats: in_x, in_y sW, any fraction; out_magnitude uW, the same; out_angle uA, 2^A to the turn.
// Error at W = A = 16: magnitude at most 1 LSB; angle at most 0.84 LSB + 0.24 rad LSB / length, so 1 LSB from a
// length of 9000 LSB on, and 0.13 LSB across the vector for short ones (derivation on the family's page).
// Status: singular (x = y = 0: magnitude 0, the angle means nothing). Model: cordic.vector
`default_nettype none
module cordic_vector_comb #(
    parameter W = 16,  // bits of a coordinate, 8 to 16; 16 is the library's word
    parameter A = 16   // bits of an angle, 4 to W, 2^A to the turn; 16, as sharp as the coordinates
) (
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire        [W-1:0] out_magnitude,
    output wire        [A-1:0] out_angle,
    output wire        [3:0]   out_status
);
    generate
        if (W < 8 || W > 16 || A < 4 || A > W) begin : g_illegal
            cordic_vector_comb_needs_W_from_8_to_16_and_A_from_4_to_W rule ();
        end
    endgenerate
    cordic_aim_array #(.W(W), .A(A), .G(4), .MAGNITUDE(1), .CLOCKED(0)) aim (.clk(1'b0), .in_enable(1'b0),
        .in_x(in_x), .in_y(in_y), .out_magnitude(out_magnitude), .out_angle(out_angle));
    assign out_status = {2'b00, {in_x, in_y} == {2*W{1'b0}}, 1'b0};
endmodule
`default_nettype wire
