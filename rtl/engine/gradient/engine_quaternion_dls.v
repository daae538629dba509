// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints in the plane by damped least squares. The steps of link 1 and of both joints, in
// units of their lengths, are (J^T J + lambda)^-1 J^T E with the error E of the tip; cfg_lambda = 0 gives Newton's
// step.
// Formats: joints angle of A bits, joint 2 relative to link 1; in_x, in_y sQ(W-F).F; cfg_l1, cfg_l2 uQ(W-F).F; cfg_r1,
// cfg_r2, cfg_lambda, cfg_mu by newton_fixed.config; cfg_tol, out_error in 1/256 unit^2, with out_coarse in unit^2,
// unit 2^-(16-W) LSB; out_d1, out_d2 sA: moves of joints 1 and 2 in the last step. in_warm: start from the last answer,
// 0 after reset.
// Error: a converged tip is within sqrt(out_error + 2) / 16 + 0.07 + 3.0 (L1 + L2) / 2^17 units.
// Latency 16 + 7 PIPE a pass and 3, II the same. Passes: out_iters + 1.
// Status: not converged (the limit was reached); with it singular, where |sin j2| < 1/16 or a link is 0.
// Source: quaternion gradient paper, eq. 24; the step of Wampler 1986. Model: iterative.damped.solve
`default_nettype none
module engine_quaternion_dls #(
    parameter W = 16,        // bits of a coordinate and of a length, 8 to 16 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 24,        // bits of a joint word, 16 to 24 (default 24, 0.006 LSB at 2^14 LSB); a full turn is 2^A
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks); 1: a faster clock
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire         clk,
    input  wire         rst,
    input  wire [W-1:0] cfg_l1,
    input  wire [W-1:0] cfg_l2,
    input  wire [15:0]  cfg_r1,
    input  wire [15:0]  cfg_r2,
    input  wire [15:0]  cfg_lambda,
    input  wire [16:0]  cfg_mu,
    input  wire [21:0]  cfg_tol,
    input  wire [9:0]   cfg_limit,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire [A-1:0] in_j1,
    input  wire [A-1:0] in_j2,
    input  wire         in_warm,
    output wire         out_valid,
    input  wire         out_ready,
    output wire [A-1:0] out_j1,
    output wire [A-1:0] out_j2,
    output wire [9:0]   out_iters,
    output wire [31:0]  out_error,
    output wire         out_coarse,
    output reg  signed [A-1:0] out_d1,
    output reg  signed [A-1:0] out_d2,
    output wire [3:0]   out_status
);
    generate
        if (W < 8 || W > 16 || F < 0 || F >= W || A < 16 || A > 24 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18
            || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            engine_quaternion_dls_needs_W_from_8_to_16_F_below_W_A_from_16_to_24_PIPE_0_or_1_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    wire [A-1:0] unused_j3;
    engine_newton_3r #(.W(W), .F(F), .A(A), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) newton (.clk(clk), .rst(rst),
        .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_l3({W{1'b0}}), .cfg_r1(cfg_r1), .cfg_r2(cfg_r2),
        .cfg_lambda(cfg_lambda), .cfg_mu(cfg_mu), .cfg_tol(cfg_tol), .cfg_limit(cfg_limit), .in_valid(in_valid),
        .in_ready(in_ready), .in_x(in_x), .in_y(in_y), .in_phi({A{1'b0}}), .in_j1(in_j1), .in_j2(in_j2),
        .in_warm(in_warm), .out_valid(out_valid), .out_ready(out_ready), .out_j1(out_j1), .out_j2(out_j2),
        .out_j3(unused_j3), .out_iters(out_iters), .out_error(out_error), .out_coarse(out_coarse),
        .out_status(out_status));

    // The last step: the joints after it, less those after the step before or at the start
    reg         begins;
    reg         odd;       // bit 0 of the number of steps counted here
    reg [A-1:0] at1, at2;
    always @(posedge clk) begin
        begins <= in_valid && in_ready;
        if (begins || odd != out_iters[0]) begin
            {odd, at1, at2} <= {out_iters[0], out_j1, out_j2};
            out_d1 <= begins ? {A{1'b0}} : out_j1 - at1;
            out_d2 <= begins ? {A{1'b0}} : out_j2 - at2;
        end
    end

    wire unused = &{1'b0, unused_j3};
endmodule
`default_nettype wire
