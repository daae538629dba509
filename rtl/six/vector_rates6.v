// SPDX-License-Identifier: Apache-2.0
// Rates of six joints from the velocity and the turn of the tip: inverse Jacobian of an arm with an ortho-parallel base
// and a spherical wrist. Both are in the base's frame; the position of joint 6 does not matter.
//   out_d1, out_d3, out_d5: the wrist's centre from axis 1, from the line of the upper arm, sin q5; det J is their
//   product and that of cfg_c2
// Formats: in_c*, in_n* s2.U; in_wx, in_wy, in_wz and out_w1 to out_w6 s(W-V).V, radians in a unit of time; in_vx,
// in_vy, in_vz s(W-F).F in that unit; out_d1, out_d3 s(W-F).F; out_d5 s2.U; cfg_* by six.rates_config: lengths
// s(W-F).(F+4), cfg_radius, cfg_elbow u(W-F).F, cfg_sine u1.U; results are rounded to nearest (ties upward), saturated.
// Error: bounds.six.rates. Latency and II: 87. Status: singular (|d1| is not above cfg_radius, |d3| not above cfg_elbow
// or |d5| not above cfg_sine; a rate that is divided by 0 is 0), overflow (a word was saturated).
// Source: Brandstoetter, Angerer, Hofbaur 2014, differentiated and inverted. Model: six.rates6
`default_nettype none
module vector_rates6 #(
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
    input  wire [W-1:0]        cfg_radius,
    input  wire [W-1:0]        cfg_elbow,
    input  wire [U:0]          cfg_sine,
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
    input  wire signed [W-1:0] in_vx,
    input  wire signed [W-1:0] in_vy,
    input  wire signed [W-1:0] in_vz,
    input  wire signed [W-1:0] in_wx,
    input  wire signed [W-1:0] in_wy,
    input  wire signed [W-1:0] in_wz,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_w1,
    output wire signed [W-1:0] out_w2,
    output wire signed [W-1:0] out_w3,
    output wire signed [W-1:0] out_w4,
    output wire signed [W-1:0] out_w5,
    output wire signed [W-1:0] out_w6,
    output wire signed [W-1:0] out_d1,
    output wire signed [W-1:0] out_d3,
    output wire signed [U+1:0] out_d5,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || V < 0 || V < W - 8 || V >= W || PIPE < 0
            || PIPE > 2) begin : g_illegal
            vector_rates6_needs_W_4_to_16_F_below_W_U_8_to_18_V_W_less_8_to_W_less_1_and_PIPE_0_to_2 rule ();
        end
    endgenerate

    wire        idle, done;
    wire        accept = in_valid && in_ready;
    wire [46:0] op;
    wire [26:0] port, word;
    wire [5:0]  dest;
    assign      in_ready = idle && (!out_valid || out_ready);
    vector_rates6_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_done(done), .out_op(op));

    six_motion #(.W(W), .U(U), .FINE(W-V)) operands (.clk(clk), .in_take(accept),
        .in_joints({in_n5, in_c5, in_n4, in_c4, in_n3, in_c3, in_n2, in_c2, in_n1, in_c1}),
        .in_motion({in_wz, in_wy, in_wx, in_vz, in_vy, in_vx}),
        .in_lengths({cfg_c4, cfg_c3, cfg_c2, cfg_b, cfg_a2, cfg_a1}), .in_select(op[43:39]), .out_word(port));
    wire [3:0] flags;
    product_engine #(.PIPE(PIPE), .QUOTIENTS(1)) engine (.clk(clk), .rst(rst), .in_start(accept), .in_run(!idle),
        .in_op(op), .in_port(port), .in_signs(3'd0), .out_word(word), .out_dest(dest), .out_status(flags));

    localparam [5:0] D5 = 6'd2, D1 = 6'd9, D3 = 6'd10;
    wire over;  // a word was saturated
    engine_results #(.COUNT(1), .U(U)) wrist (.clk(clk), .in_word(word), .in_dest(dest), .out_words(out_d5));
    engine_saturated #(.COUNT(8), .FIRST(3), .W(W), .FINE(0)) rates (.clk(clk), .in_start(accept), .in_word(word),
        .in_dest(dest), .out_words({out_d3, out_d1, out_w6, out_w5, out_w4, out_w3, out_w2, out_w1}),
        .out_over(over));

    // A factor of the determinant and its threshold, both as words
    reg          singular, limited;
    wire [W-1:0] least = dest == D1 ? cfg_radius : cfg_elbow;
    wire [26:0]  limit = dest == D5 ? {1'b0, cfg_sine, {(25-U){1'b0}}} : {2'd0, least, {(25-W){1'b0}}};
    wire         near  = (word ^ {27{word[26]}}) <= limit;
    assign       out_status = {1'b0, over || limited, singular, 1'b0};
    wire         unused = &{1'b0, flags[3:1]};
    always @(posedge clk) begin
        singular  <= !accept && (singular || near && (dest == D1 || dest == D3 || dest == D5));
        limited   <= !accept && (limited || flags[0] && !idle);  // the engine has limited a quotient
        out_valid <= !rst && (done || out_valid && !out_ready);
    end
endmodule
`default_nettype wire
