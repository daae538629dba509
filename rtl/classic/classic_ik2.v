// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints by CORDIC: L1 exp(j j1) + L2 exp(j (j1 + j2)) = x + j y.
// Three vectorings and two square roots. MODE 0 takes a micro-rotation a clock (classic_solve_iter), MODE 1, the
// paper's parallel CORDIC, a vectoring a clock (classic_solve_comb).
// Formats: in_x, in_y s(W-F).F; in_elbow 0: j2 in 0 .. 1/2 turn, 1: -1/2 turn .. 0; out_j1, out_j2 uA, 2^A to the turn;
//   cfg_far, cfg_near = (L1 + L2)^2, (L1 - L2)^2, cfg_f = (L2 - L1) / (L1 + L2) * 2^(W+2), L1, L2 u(W-F).F.
// Error: tip within 2 LSB up to L1 + L2 = 2^(W-2), L1 < 4 L2, including half an LSB of rounding in each output word.
// Latency and II: 64 at W = 16 in MODE 0, 5 in MODE 1.
// Status: unreachable (the answer is the nearest point in reach), singular (x = y = 0: j1 is held; 0 after a reset).
// Paper: the parallel CORDIC of its table V. Model: classic.ik2
`default_nettype none
module classic_ik2 #(
    parameter MODE     = 0,  // 0: iterative, 1: combinational between its registers (default 0)
    parameter W        = 16, // bits of a coordinate, 8 to 24 (default 16)
    parameter F        = 8,  // fraction bits of a coordinate, 0 to W - 1 (default 8: Q7.8, the paper's word)
    parameter A        = 16, // bits of an angle, 4 to 24, 2^A to the turn (default 16, as sharp as the coordinates)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with MODE = 0
) (
    input  wire                  clk,
    input  wire                  rst,
    input  wire        [2*W+1:0] cfg_far,
    input  wire        [2*W-1:0] cfg_near,
    input  wire signed [W+3:0]   cfg_f,
    input  wire                  in_valid,
    output wire                  in_ready,
    input  wire signed [W-1:0]   in_x,
    input  wire signed [W-1:0]   in_y,
    input  wire                  in_elbow,
    output reg                   out_valid,
    input  wire                  out_ready,
    output wire        [A-1:0]   out_j1,
    output wire        [A-1:0]   out_j2,
    output wire        [3:0]     out_status
);
    wire         busy, done;
    wire         start = in_valid && in_ready;
    wire [A-1:0] j3;
    wire         unused = &{1'b0, j3};
    assign out_status[3:2] = 2'b00;
    assign in_ready = !busy && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (done || (out_valid && !out_ready));

    generate
        if (MODE < 0 || MODE > 1 || W < 8 || W > 24 || F < 0 || F >= W || A < 4 || A > 24
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            classic_ik2_needs_MODE_0_or_1_W_from_8_to_24_F_below_W_A_from_4_to_24_and_MULTIPLY_18_or_27 rule ();
        end
        if (MODE == 0) begin : g_iterative
            classic_solve_iter #(.W(W), .A(A), .JOINTS(2), .MULTIPLY(MULTIPLY)) solver (.clk(clk), .rst(rst),
                .in_start(start), .in_far(cfg_far), .in_near(cfg_near), .in_f(cfg_f), .in_x(in_x), .in_y(in_y),
                .in_z({W{1'b0}}), .in_elbow(in_elbow), .out_busy(busy), .out_done(done), .out_j1(out_j1),
                .out_j2(out_j2), .out_j3(j3), .out_singular(out_status[1]), .out_unreachable(out_status[0]));
        end else begin : g_combinational
            classic_solve_comb #(.W(W), .A(A), .JOINTS(2)) solver (.clk(clk), .rst(rst), .in_start(start),
                .in_far(cfg_far), .in_near(cfg_near), .in_f(cfg_f), .in_x(in_x), .in_y(in_y), .in_z({W{1'b0}}),
                .in_elbow(in_elbow), .out_busy(busy), .out_done(done), .out_j1(out_j1), .out_j2(out_j2), .out_j3(j3),
                .out_singular(out_status[1]), .out_unreachable(out_status[0]));
        end
    endgenerate
endmodule
`default_nettype wire
