// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of a parallel robot with six RUS legs (or three): pose and link angle to six crank vectors.
//   (cos, sin) = (e G -+ f S, f G +- e S) / (e^2 + f^2), G = (e^2 + f^2 + h^2 + LA^2 - LB^2) / 2 LA,
//   S = sqrt(e^2 + f^2 - G^2), (e, f, h) = R c + p - F - link (cos beta, sin beta, 0) in the frame of the leg
// Formats: rotation, vectors s2.16; p sW; platform lengths s18, 2^(W-18) LSB of p; out_s 2^(W-22) LSB, root S of the
// leg. in_load: the sample is the geometry of leg in_leg: r11 to r13 ball joint, r21, r22 azimuth cos, sin, r23 -link,
// r31 = r22, r32 = -r21, r33[0] branch, p -F; (1, 0), S = 0 answers it. A leg not loaded since reset counts as
// unreachable.
// Error of an angle: (LB/LA dC + dG) / S + dS / sqrt(e^2 + f^2) + 1/2 LSB, dC 0.0135 LSB (bounds.engine.rus_angle).
// Latency 79 + 34 PIPE, II 48 + 24 PIPE. Status: unreachable (out_far says which leg; nearest crank), singular (S below
// cfg_near), overflow (the words of a leg are meaningless).
// Source: Sanchez-Alonso et al., RIAI 13 (2016) 247-257, (15)-(17) corrected. Model: engine_rus.ik
`default_nettype none
module engine_rus_ik #(
    parameter W = 18,        // bits of a position, 14 to 18 (default 18); below 18 its rounding is the greatest error
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks); 1: a faster clock
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [26:0]  cfg_k,
    input  wire [25:0]         cfg_c,
    input  wire [11:0]         cfg_near,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire                in_load,
    input  wire [2:0]          in_leg,
    input  wire signed [17:0]  in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33,
    input  wire signed [W-1:0] in_px, in_py, in_pz,
    input  wire signed [17:0]  in_cb, in_nb,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [17:0]  out_c1, out_n1, out_c2, out_n2, out_c3, out_n3,
    output wire signed [17:0]  out_c4, out_n4, out_c5, out_n5, out_c6, out_n6,
    output wire [21:0]         out_s1, out_s2, out_s3, out_s4, out_s5, out_s6,
    output wire [5:0]          out_far,
    output wire [3:0]          out_status
);
    generate
        if (W < 14 || W > 18 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0)
        begin : g_illegal
            engine_rus_ik_needs_W_from_14_to_18_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate
    wire               free = !out_valid || out_ready;
    wire               flags, sine, last, none, far, near, over;
    wire signed [17:0] c, word;
    wire [21:0]        root;
    /* verilator lint_off PINCONNECTEMPTY */
    engine_rus_poses #(.W(W), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) poses (
        .clk(clk), .rst(rst), .cfg_k(cfg_k), .cfg_c(cfg_c), .cfg_near(cfg_near), .in_valid(in_valid),
        .in_ready(in_ready), .in_free(free), .in_load(in_load), .in_leg(in_leg), .in_r11(in_r11), .in_r12(in_r12),
        .in_r13(in_r13), .in_r21(in_r21), .in_r22(in_r22), .in_r23(in_r23), .in_r31(in_r31), .in_r32(in_r32),
        .in_r33(in_r33), .in_px(in_px), .in_py(in_py), .in_pz(in_pz), .in_cb(in_cb), .in_nb(in_nb),
        .in_place(12'd0), .in_step(17'd0), .out_rise(), .out_flags(flags), .out_sine(sine), .out_last(last), .out_c(c),
        .out_word(word), .out_root(root), .out_none(none), .out_far(far), .out_near(near), .out_over(over));
    /* verilator lint_on PINCONNECTEMPTY */
    reg  [35:0] leg6;
    always @(posedge clk)
        if (sine)
            leg6 <= {none ? 18'd0 : word, c};
    engine_rus_results #(.BITS(36)) results (
        .clk(clk), .rst(rst), .in_flags(flags), .in_root(root), .in_far(far), .in_near(near), .in_over(over),
        .in_move(sine), .in_last(last), .in_leg6(leg6), .out_valid(out_valid), .out_ready(out_ready),
        .out_words({out_n6, out_c6, out_n5, out_c5, out_n4, out_c4, out_n3, out_c3, out_n2, out_c2, out_n1, out_c1}),
        .out_s({out_s6, out_s5, out_s4, out_s3, out_s2, out_s1}), .out_far(out_far), .out_status(out_status));
endmodule
`default_nettype wire
