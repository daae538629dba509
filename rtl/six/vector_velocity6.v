// SPDX-License-Identifier: Apache-2.0
// Velocity and turn of the tip from the rates of six joints: Jacobian of an arm with an ortho-parallel base and a
// spherical wrist. Both are in the base's frame; the position of joint 6 does not matter.
// Formats: in_c*, in_n* s2.U; in_w1 to in_w6 and out_wx, out_wy, out_wz s(W-V).V, radians in a unit of time; out_vx,
// out_vy, out_vz s(W-F).F in that unit; cfg_* lengths s(W-F).(F+4), by six.motion_config; results are rounded to
// nearest (ties upward) and saturated.
// Error: bounds.six.velocity, in LSB 1/2 + 6 2^(W-25) of a turn and 1/2 + 12 2^(2W-V-25) of a velocity, and what the
// lengths of the vectors make of them. Latency and II: 56. Status: overflow (a word was saturated).
// Source: Brandstoetter, Angerer, Hofbaur 2014, differentiated. Model: six.velocity6
`default_nettype none
module vector_velocity6 #(
    parameter W = 16,   // bits of a length, a velocity and a rate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a length and a velocity, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,   // fraction bits of a unit vector, 8 to 18 (default 16)
    parameter V = 12,   // fraction bits of a rate and a turn, W - 8 to W - 1 (default 12: below 8 rad)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W+3:0] cfg_a1,
    input  wire signed [W+3:0] cfg_a2,
    input  wire signed [W+3:0] cfg_b,
    input  wire signed [W+3:0] cfg_c2,
    input  wire signed [W+3:0] cfg_c3,
    input  wire signed [W+3:0] cfg_c4,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    input  wire signed [U+1:0] in_c4,
    input  wire signed [U+1:0] in_n4,
    input  wire signed [U+1:0] in_c5,
    input  wire signed [U+1:0] in_n5,
    input  wire signed [W-1:0] in_w1,
    input  wire signed [W-1:0] in_w2,
    input  wire signed [W-1:0] in_w3,
    input  wire signed [W-1:0] in_w4,
    input  wire signed [W-1:0] in_w5,
    input  wire signed [W-1:0] in_w6,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_vx,
    output wire signed [W-1:0] out_vy,
    output wire signed [W-1:0] out_vz,
    output wire signed [W-1:0] out_wx,
    output wire signed [W-1:0] out_wy,
    output wire signed [W-1:0] out_wz,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || V < 0 || V < W - 8 || V >= W || PIPE < 0
            || PIPE > 2) begin : g_illegal
            vector_velocity6_needs_W_4_to_16_F_below_W_U_8_to_18_V_W_less_8_to_W_less_1_and_PIPE_0_to_2 rule ();
        end
    endgenerate

    wire        idle, done;
    wire        accept = in_valid && in_ready;
    wire [46:0] op;
    wire [26:0] port, word;
    wire [5:0]  dest;
    assign      in_ready = idle && (!out_valid || out_ready);
    vector_velocity6_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_done(done), .out_op(op));

    six_motion #(.W(W), .U(U)) operands (.clk(clk), .in_take(accept),
        .in_joints({in_n5, in_c5, in_n4, in_c4, in_n3, in_c3, in_n2, in_c2, in_n1, in_c1}),
        .in_motion({in_w6, in_w5, in_w4, in_w3, in_w2, in_w1}),
        .in_lengths({cfg_c4, cfg_c3, cfg_c2, cfg_b, cfg_a2, cfg_a1}), .in_select(op[43:39]), .out_word(port));
    /* verilator lint_off PINCONNECTEMPTY */
    product_engine #(.PIPE(PIPE), .ROOTS(0)) engine (.clk(clk), .rst(rst), .in_start(accept), .in_run(!idle),
        .in_op(op), .in_port(port), .in_signs(3'd0), .out_word(word), .out_dest(dest), .out_status());
    /* verilator lint_on PINCONNECTEMPTY */
    wire fast, turns;  // a velocity, a turn was saturated
    engine_saturated #(.COUNT(3), .FIRST(2), .W(W), .FINE(W-V)) linear (.clk(clk), .in_start(accept), .in_word(word),
        .in_dest(dest), .out_words({out_vz, out_vy, out_vx}), .out_over(fast));
    engine_saturated #(.COUNT(3), .FIRST(5), .W(W), .FINE(0)) angular (.clk(clk), .in_start(accept), .in_word(word),
        .in_dest(dest), .out_words({out_wz, out_wy, out_wx}), .out_over(turns));
    assign out_status = {1'b0, fast || turns, 2'd0};
    always @(posedge clk)
        out_valid <= !rst && (done || out_valid && !out_ready);
endmodule
`default_nettype wire
