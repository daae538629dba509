// SPDX-License-Identifier: Apache-2.0
// Length and direction of a vector, full circle, gain compensated: a micro-rotation a clock, or a vector a clock.
//   out_magnitude = sqrt(in_x^2 + in_y^2), out_angle = atan2(in_y, in_x) / (2 pi) * 2^A, both to nearest
// Formats: in_x, in_y sW, any fraction; out_magnitude uW, the same; out_angle uA, 2^A to the turn.
// Error at W = A = 16: magnitude at most 1 LSB; angle at most 0.84 LSB + 0.24 rad LSB / length, so 1 LSB from a
// length of 16000 LSB on, and 0.24 LSB across the vector for short ones (bounds.cordic.angle).
// Latency at W = 16: 18 in MODE 0, 17 in MODE 1. II: the latency in MODE 0; 1 in MODE 1, which moves as a whole.
// Status: singular (x = y = 0: magnitude 0, the angle means nothing). Model: cordic.vector
`default_nettype none
module cordic_vector #(
    parameter MODE = 0,  // 0: iterative, 1: pipelined (default 0)
    parameter W    = 16, // bits of a coordinate, 8 to 16 (default 16)
    parameter A    = 16  // bits of an angle, 4 to W, 2^A to the turn (default 16, as sharp as the coordinates)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire                out_valid,
    input  wire                out_ready,
    output wire        [W-1:0] out_magnitude,
    output wire        [A-1:0] out_angle,
    output wire        [3:0]   out_status
);
    wire origin = {in_x, in_y} == {2*W{1'b0}};
    generate
        if (MODE < 0 || MODE > 1 || W < 8 || W > 16 || A < 4 || A > W) begin : g_illegal
            cordic_vector_needs_MODE_0_or_1_and_W_from_8_to_16_and_A_from_4_to_W rule ();
        end
        if (MODE == 0) begin : g_iterative
            wire busy, done;
            wire start = in_valid && in_ready;
            reg  valid, singular;
            cordic_aim_iter #(.W(W), .A(A), .G(4), .MAGNITUDE(1)) aim (.clk(clk), .rst(rst), .in_start(start),
                .in_hold(1'b0), .in_x(in_x), .in_y(in_y), .out_busy(busy), .out_done(done),
                .out_magnitude(out_magnitude), .out_angle(out_angle));
            assign in_ready = !busy && (!valid || out_ready);
            assign out_valid = valid;
            assign out_status = {2'b00, singular, 1'b0};
            always @(posedge clk) begin
                valid <= !rst && (done || (valid && !out_ready));
                if (start) singular <= origin;
            end
        end else begin : g_pipelined
            localparam STAGES = (W + 1) / 2 + 9;
            reg [STAGES-1:0] valid, singular;
            wire             move = out_ready || !out_valid;
            always @(posedge clk) begin
                if (rst) valid <= {STAGES{1'b0}};
                else if (move) valid <= {valid[STAGES-2:0], in_valid};
                if (move) singular <= {singular[STAGES-2:0], origin};
            end
            assign in_ready = move;
            assign out_valid = valid[STAGES-1];
            assign out_status = {2'b00, singular[STAGES-1], 1'b0};
            cordic_aim_array #(.W(W), .A(A), .G(4), .MAGNITUDE(1), .CLOCKED(1)) aim (.clk(clk), .in_enable(move),
                .in_x(in_x), .in_y(in_y), .out_magnitude(out_magnitude), .out_angle(out_angle));
        end
    endgenerate
endmodule
`default_nettype wire
