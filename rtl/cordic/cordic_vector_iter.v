// SPDX-License-Identifier: Apache-2.0
// Length and direction of a vector, full circle, gain compensated: one micro-rotation a clock.
//   out_magnitude = sqrt(in_x^2 + in_y^2), out_angle = atan2(in_y, in_x) / (2 pi) * 2^A, both to nearest
// Formats: in_x, in_y sW, any fraction; out_magnitude uW, the same; out_angle uA, 2^A to the turn.
// Error at W = A = 16: magnitude at most 1 LSB; angle at most 0.84 LSB + 0.24 rad LSB / length, so 1 LSB from a
// length of 9000 LSB on, and 0.13 LSB across the vector for short ones (derivation on the family's page).
// Latency and II 18 at W = 16. Status: singular (x = y = 0: magnitude 0, the angle means nothing).
// Model: cordic.vector
`default_nettype none
module cordic_vector_iter #(
    parameter W = 16,  // bits of a coordinate, 8 to 16; 16 is the library's word
    parameter A = 16   // bits of an angle, 4 to W, 2^A to the turn; 16, as sharp as the coordinates
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire        [W-1:0] out_magnitude,
    output wire        [A-1:0] out_angle,
    output wire        [3:0]   out_status
);
    generate
        if (W < 8 || W > 16 || A < 4 || A > W) begin : g_illegal
            cordic_vector_iter_needs_W_from_8_to_16_and_A_from_4_to_W rule ();
        end
    endgenerate
    wire busy, done;
    wire start = in_valid && in_ready;
    reg  singular;
    cordic_aim_iter #(.W(W), .A(A), .G(4), .MAGNITUDE(1)) aim (.clk(clk), .rst(rst), .in_start(start), .in_hold(1'b0),
        .in_x(in_x), .in_y(in_y), .out_busy(busy), .out_done(done),
        .out_magnitude(out_magnitude), .out_angle(out_angle));
    assign in_ready = !busy && (!out_valid || out_ready);
    assign out_status = {2'b00, singular, 1'b0};
    always @(posedge clk) begin
        out_valid <= !rst && (done || (out_valid && !out_ready));
        if (start) singular <= in_x == {W{1'b0}} && in_y == {W{1'b0}};
    end
endmodule
`default_nettype wire
