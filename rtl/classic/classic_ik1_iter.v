// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of one joint by the iterative CORDIC: j1 = atan2(y, x).
// Formats: in_x, in_y s(W-F).F; out_j1 uA, 2^A to the turn, to nearest.
// Error: 0.88 LSB of the angle and 0.39 rad LSB / length, at most (page).
// Latency and II 18 at W = 16: the clocks of W + 1 micro-rotations.
// Status: singular (x = y = 0: the last angle is held; 0 after a reset). Model: classic.ik1
`default_nettype none
module classic_ik1_iter #(
    parameter W = 16,  // bits of a coordinate, 8 to 16; 16 is the library's word
    parameter F = 8,   // fraction bits of a coordinate, 0 to W - 1; 8: Q7.8, the paper's word
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
    output wire        [A-1:0] out_j1,
    output wire        [3:0]   out_status
);
    generate
        if (W < 8 || W > 16 || F < 0 || F >= W || A < 4 || A > W) begin : g_illegal
            classic_ik1_iter_needs_W_from_8_to_16_and_F_below_W_and_A_from_4_to_W rule ();
        end
    endgenerate
    wire         busy, done;
    wire         start = in_valid && in_ready;
    wire         origin = {in_x, in_y} == {2*W{1'b0}};
    reg          singular;
    wire [W-1:0] length;
    wire         unused = &{1'b0, length};
    cordic_aim_iter #(.W(W), .A(A), .G(3), .MAGNITUDE(0)) aim (.clk(clk), .rst(rst), .in_start(start), .in_hold(origin),
        .in_x(in_x), .in_y(in_y), .out_busy(busy), .out_done(done), .out_magnitude(length), .out_angle(out_j1));
    assign in_ready = !busy && (!out_valid || out_ready);
    assign out_status = {2'b00, singular, 1'b0};
    always @(posedge clk) begin
        out_valid <= !rst && (done || (out_valid && !out_ready));
        if (start) singular <= origin;
    end
endmodule
`default_nettype wire
