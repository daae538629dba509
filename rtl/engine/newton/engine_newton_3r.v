// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of three joints in the plane by Newton's method: tip (x, y) and orientation phi of the last link.
// The orientation is linear, j3 = phi - j1 - j2, so it holds from the first step on. With the error E of the wrist,
//   (d1, d12) = (D adj(J) + lambda J^T) E / (D^2 + mu), D = det J / l1 l2 = sin j2; cfg_lambda = 0: J^-1 E
// Formats: joints, in_phi angle of A bits; in_x, in_y s(W-F).F; cfg_l1..l3 uQ(W-F).F; cfg_r1, cfg_r2, cfg_lambda,
// cfg_mu by newton_fixed.config; cfg_tol, out_error in 1/256 unit^2, with out_coarse in unit^2, unit 2^-(16-W) LSB.
// in_warm: start from the last answer, 0 after reset, not from in_j1, in_j2.
// Error: a converged tip is within sqrt(out_error + 2) / 16 + 0.07 + 3.0 (L1 + L2 + L3) / 2^17 units.
// Latency 16 + 7 PIPE a pass and 3, II the same. Passes: out_iters + 1.
// Status: not converged (the limit was reached); with it singular, where |sin j2| < 1/16 or a link is 0.
// Source: Newton-Raphson paper, eqs. 12, 14. Model: iterative.newton_fixed.solve
`default_nettype none
module engine_newton_3r #(
    parameter W = 16,        // bits of a coordinate and of a length, 8 to 16 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 20,        // bits of a joint word, 16 to 24 (default 20, 0.1 LSB at 2^14 LSB); a full turn is 2^A
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks); 1: a faster clock
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire         clk,
    input  wire         rst,
    input  wire [W-1:0] cfg_l1,
    input  wire [W-1:0] cfg_l2,
    input  wire [W-1:0] cfg_l3,
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
    input  wire [A-1:0] in_phi,
    input  wire [A-1:0] in_j1,
    input  wire [A-1:0] in_j2,
    input  wire         in_warm,
    output reg          out_valid,
    input  wire         out_ready,
    output wire [A-1:0] out_j1,
    output wire [A-1:0] out_j2,
    output wire [A-1:0] out_j3,
    output wire [9:0]   out_iters,
    output wire [31:0]  out_error,
    output wire         out_coarse,
    output wire [3:0]   out_status
);
    generate
        if (W < 8 || W > 16 || F < 0 || F >= W || A < 16 || A > 24 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18
            || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            engine_newton_3r_needs_W_from_8_to_16_F_below_W_A_from_16_to_24_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    // Program
    wire [19:0] op;
    wire        idle, halt, second, single, cosine, stop, move;
    reg         first;  // first pass: neither a stop nor a step
    wire        accept = in_valid && in_ready;
    assign      in_ready = idle && (!out_valid || out_ready);
    engine_newton_program #(.PIPE(PIPE)) program_ (.clk(clk), .rst(rst || halt), .in_start(accept), .out_idle(idle),
        .out_second(second), .out_single(single), .out_cosine(cosine), .out_op(op), .out_stop(stop), .out_move(move));

    // Joints
    reg  [A-1:0] th1, th2, th12, phi;
    wire [A-1:0] word = second ? single ? th2 : th12 : single ? th1 : phi;
    wire [A-1:0] step;
    wire [43:0]  chord;
    wire         move1 = stop && !first && !halt, move2 = move && !first;
    assign out_j1 = th1;
    assign out_j2 = th2;
    assign out_j3 = phi - th12;
    angle_chord #(.A(A), .K(17), .T(10)) codec (.clk(clk), .in_read(1'b1), .in_keep(1'b0), .in_cos(cosine),
        .in_j(word), .out_chord(chord));
    always @(posedge clk) begin
        th12 <= th1 + th2;
        if (accept ? !in_warm : move1)
            th1 <= accept ? in_j1 : th1 - step;
        if (accept ? !in_warm : move1 || move2)
            th2 <= accept ? in_j2 : th2 + step;
        if (rst) begin
            th1 <= {A{1'b0}};
            th2 <= {A{1'b0}};
        end
    end

    // Error and steps
    localparam Z = 16 - W;
    reg  [W-1:0] x, y;
    wire         fine, near;
    engine_newton_path #(.A(A), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) path (.clk(clk), .cfg_l1({cfg_l1, {Z{1'b0}}}),
        .cfg_l2({cfg_l2, {Z{1'b0}}}), .cfg_l3({cfg_l3, {Z{1'b0}}}), .cfg_r1(cfg_r1), .cfg_r2(cfg_r2),
        .cfg_lambda(cfg_lambda), .cfg_mu(cfg_mu), .in_op(op), .in_chord(chord), .in_x({x, {Z{1'b0}}}),
        .in_y({y, {Z{1'b0}}}), .out_step(step), .out_square(out_error), .out_fine(fine), .out_near(near));

    // End of a sample
    reg  [9:0] iters;
    reg        failed;
    wire       done = fine && out_error[31:22] == 0 && out_error[21:0] < cfg_tol;
    assign     halt = stop && !first && (done || iters == cfg_limit);
    assign     out_iters = iters;
    assign     out_coarse = !fine;
    assign     out_status = {failed, 1'b0, failed && (near || cfg_l1 == 0 || cfg_l2 == 0), 1'b0};
    always @(posedge clk) begin
        if (accept) begin
            x     <= in_x;
            y     <= in_y;
            phi   <= in_phi;
            iters <= 10'd0;
            first <= 1'b1;
        end else if (move) begin
            iters <= iters + {9'd0, !first};
            first <= 1'b0;
        end
        if (halt)
            failed <= !done;
        out_valid <= !rst && (halt || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
