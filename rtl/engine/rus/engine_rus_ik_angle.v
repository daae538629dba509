// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of a parallel robot with six RUS legs (or three): pose and link angle to the binary angles of six
// cranks. It is engine_rus_ik with the codec of vector_to_angle, whose product is a free one of the legs.
// Formats: rotation s2.16; p sW; platform lengths s18, 2^(W-18) LSB of p; out_s 2^(W-22) LSB, root S of the leg; out_j
// angles of A bits modulo a turn, rounded to nearest, 0 where a leg has no answer. in_load: the sample is the geometry
// of leg in_leg, in the words that engine_rus_ik lists.
// Error of an angle: (LB/LA dC + dG) / S + dS / sqrt(e^2 + f^2), dC 0.0135 LSB (bounds.engine.rus_angle), and 0.89 LSB
// of the angle at A = 18 (bounds.codec.vector_to_angle). Latency 80 + 38 PIPE, II 48 + 24 PIPE.
// Status: unreachable (out_far says which leg; nearest crank), singular (S below cfg_near), overflow (the word of a leg
// is meaningless).
// Source: Sanchez-Alonso et al., RIAI 13 (2016) 247-257, (15)-(17) corrected. Model: engine_rus.ik_angle
`default_nettype none
module engine_rus_ik_angle #(
    parameter W = 18,        // bits of a position, 14 to 18 (default 18); below 18 its rounding is the greatest error
    parameter A = 18,        // bits of an angle, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
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
    output wire [A-1:0]        out_j1, out_j2, out_j3, out_j4, out_j5, out_j6,
    output wire [21:0]         out_s1, out_s2, out_s3, out_s4, out_s5, out_s6,
    output wire [5:0]          out_far,
    output wire [3:0]          out_status
);
    generate
        if (W < 14 || W > 18 || A < 10 || A > 24 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0) begin : g_illegal
            engine_rus_ik_angle_needs_W_from_14_to_18_A_from_10_to_24_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate
    wire               free = !out_valid || out_ready;
    wire               flags, sine, last, none, far, near, over;
    wire signed [17:0] c, word;
    wire [21:0]        root;
    wire [11:0]        place;
    wire [16:0]        step;
    wire [28:0]        rise;
    engine_rus_poses #(.W(W), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) poses (
        .clk(clk), .rst(rst), .cfg_k(cfg_k), .cfg_c(cfg_c), .cfg_near(cfg_near), .in_valid(in_valid),
        .in_ready(in_ready), .in_free(free), .in_load(in_load), .in_leg(in_leg), .in_r11(in_r11), .in_r12(in_r12),
        .in_r13(in_r13), .in_r21(in_r21), .in_r22(in_r22), .in_r23(in_r23), .in_r31(in_r31), .in_r32(in_r32),
        .in_r33(in_r33), .in_px(in_px), .in_py(in_py), .in_pz(in_pz), .in_cb(in_cb), .in_nb(in_nb),
        .in_place(place), .in_step(step), .out_rise(rise), .out_flags(flags), .out_sine(sine), .out_last(last),
        .out_c(c), .out_word(word), .out_root(root), .out_none(none), .out_far(far), .out_near(near), .out_over(over));
    // The output register of the codec is the register of leg 6
    wire [A-1:0] angle;
    reg          turned, last_turned;
    wire         move;
    always @(posedge clk) begin
        turned      <= sine && !rst;
        last_turned <= last;
    end
    generate
        if (PIPE == 0) begin : g_late
            wire moves = turned;
            assign move = moves;
        end else begin : g_late
            reg [3:0] moves;  // while the codec's product is formed; last_turned stands as long
            assign move = moves[3];
            always @(posedge clk)
                moves <= rst ? 4'd0 : {moves[2:0], turned};
        end
    endgenerate
    engine_rus_angle #(.A(A), .PIPE(PIPE)) codec (
        .clk(clk), .in_valid(sine), .in_c(c), .in_n(none ? 18'd0 : word), .in_take(turned), .in_move(move),
        .out_place(place), .out_step(step), .in_rise(rise), .out_j(angle));
    engine_rus_results #(.BITS(A)) results (
        .clk(clk), .rst(rst), .in_flags(flags), .in_root(root), .in_far(far), .in_near(near), .in_over(over),
        .in_move(move), .in_last(last_turned), .in_leg6(angle), .out_valid(out_valid), .out_ready(out_ready),
        .out_words({out_j6, out_j5, out_j4, out_j3, out_j2, out_j1}),
        .out_s({out_s6, out_s5, out_s4, out_s3, out_s2, out_s1}), .out_far(out_far), .out_status(out_status));
endmodule
`default_nettype wire
