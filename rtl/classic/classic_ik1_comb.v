// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of one joint by the parallel CORDIC: j1 = atan2(y, x), in one long clock.
// Formats: in_x, in_y s(W-F).F; out_j1 uA, 2^A to the turn, to nearest. Bit for bit classic_ik1_iter.
// Error: 0.88 LSB of the angle and 0.39 rad LSB / length, at most (page). Latency and II 1.
// Status: singular (x = y = 0: the last angle is held; 0 after a reset).
// Paper: the parallel CORDIC of its table V. Model: classic.ik1
`default_nettype none
module classic_ik1_comb #(
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
    output reg         [A-1:0] out_j1,
    output wire        [3:0]   out_status
);
    generate
        if (W < 8 || W > 16 || F < 0 || F >= W || A < 4 || A > W) begin : g_illegal
            classic_ik1_comb_needs_W_from_8_to_16_and_F_below_W_and_A_from_4_to_W rule ();
        end
    endgenerate
    wire         take = in_valid && in_ready;
    wire         origin = {in_x, in_y} == {2*W{1'b0}};
    reg          singular;
    wire [A-1:0] angle;
    wire [W-1:0] length;
    wire         unused = &{1'b0, length};
    cordic_aim_array #(.W(W), .A(A), .G(3), .MAGNITUDE(0), .CLOCKED(0)) aim (.clk(clk), .in_enable(1'b0),
        .in_x(in_x), .in_y(in_y), .out_magnitude(length), .out_angle(angle));
    assign in_ready = !out_valid || out_ready;
    assign out_status = {2'b00, singular, 1'b0};
    always @(posedge clk) begin
        out_valid <= !rst && (in_valid || !in_ready);
        if (take) singular <= origin;
        if (rst) out_j1 <= {A{1'b0}};
        else if (take && !origin) out_j1 <= angle;
    end
endmodule
`default_nettype wire
