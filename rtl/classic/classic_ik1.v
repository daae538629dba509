// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of one joint by CORDIC: j1 = atan2(y, x). MODE 0: a micro-rotation a clock, W + 1 of them;
//   MODE 1, the paper's parallel CORDIC: all of them in one long clock.
// Formats: in_x, in_y s(W-F).F; out_j1 uA, 2^A to the turn, to nearest.
// Error: at most 0.88 LSB of the angle plus 0.39 rad LSB / length.
// Latency and II: 18 at W = 16 in MODE 0, 1 in MODE 1.
// Status: singular (x = y = 0: the last angle is held; 0 after a reset).
// Paper: the parallel CORDIC of its table V. Model: classic.ik1
`default_nettype none
module classic_ik1 #(
    parameter MODE = 0,  // 0: iterative, 1: combinational between its registers (default 0)
    parameter W    = 16, // bits of a coordinate, 8 to 24 (default 16)
    parameter F    = 8,  // fraction bits of a coordinate, 0 to W - 1 (default 8: Q7.8, the paper's word)
    parameter A    = 16  // bits of an angle, 4 to 24, 2^A to the turn (default 16, as sharp as the coordinates)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire        [A-1:0] out_j1,
    output wire        [3:0]   out_status
);
    wire         busy, done;
    wire         start = in_valid && in_ready;
    wire         origin = {in_x, in_y} == {2*W{1'b0}};
    reg          singular;
    wire [W-1:0] length;
    wire         unused = &{1'b0, length};
    assign in_ready = !busy && (!out_valid || out_ready);
    assign out_status = {2'b00, singular, 1'b0};
    always @(posedge clk) begin
        out_valid <= !rst && (done || (out_valid && !out_ready));
        if (start) singular <= origin;
    end

    generate
        if (MODE < 0 || MODE > 1 || W < 8 || W > 24 || F < 0 || F >= W || A < 4 || A > 24) begin : g_illegal
            classic_ik1_needs_MODE_0_or_1_and_W_from_8_to_24_and_F_below_W_and_A_from_4_to_24 rule ();
        end
        if (MODE == 0) begin : g_iterative
            cordic_aim_iter #(.W(W), .A(A), .G(3), .MAGNITUDE(0)) aim (.clk(clk), .rst(rst), .in_start(start),
                .in_hold(origin), .in_x(in_x), .in_y(in_y), .out_busy(busy), .out_done(done),
                .out_magnitude(length), .out_angle(out_j1));
        end else begin : g_combinational
            wire [A-1:0] angle;
            reg  [A-1:0] held;
            cordic_aim_array #(.W(W), .A(A), .G(3), .MAGNITUDE(0), .CLOCKED(0)) aim (.clk(clk), .in_enable(1'b0),
                .in_x(in_x), .in_y(in_y), .out_magnitude(length), .out_angle(angle));
            assign busy = 1'b0;
            assign done = start;
            assign out_j1 = held;
            always @(posedge clk)
                if (rst) held <= {A{1'b0}};
                else if (start && !origin) held <= angle;
        end
    endgenerate
endmodule
`default_nettype wire
