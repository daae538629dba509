// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of six joints on unit vectors: rotation matrix and tip of an arm with an ortho-parallel base and a
// spherical wrist.
// Formats: in_c*, in_n* cosine and sine of a joint, s2.U; out_r*, row and column, s2.U; out_x, out_y, out_z s(W-F).F;
// all are rounded to nearest (ties upward), coordinates saturated; cfg_* lengths s(W-F).(F+4), by six.forward_config.
// Error of a coordinate, lengths in LSB: 1/2 + 2^-U sqrt(1/2) (|a1| + |b| + 2 |c2| + 3 k + 5 |c4|) + 20 2^(W-25), and
// 2^-5 for each length that is not 0, k = sqrt(a2^2 + c3^2). Of a word of the matrix: 8.3 2^-16 at U = 16.
// Latency and II by PIPE: 45, 46, 48. Status: overflow (a coordinate was saturated).
// Source: Brandstoetter, Angerer, Hofbaur 2014. Model: six.fk6
`default_nettype none
module vector_fk6 #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,   // fraction bits of a unit vector and of the matrix, 8 to 18 (default 16)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W+3:0] cfg_a1,
    input  wire signed [W+3:0] cfg_a2,
    input  wire signed [W+3:0] cfg_b,
    input  wire signed [W+3:0] cfg_c1,
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
    input  wire signed [U+1:0] in_c6,
    input  wire signed [U+1:0] in_n6,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_r11,
    output wire signed [U+1:0] out_r12,
    output wire signed [U+1:0] out_r13,
    output wire signed [U+1:0] out_r21,
    output wire signed [U+1:0] out_r22,
    output wire signed [U+1:0] out_r23,
    output wire signed [U+1:0] out_r31,
    output wire signed [U+1:0] out_r32,
    output wire signed [U+1:0] out_r33,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || PIPE < 0 || PIPE > 2) begin : g_illegal
            vector_fk6_needs_W_from_4_to_16_and_F_below_W_and_U_from_8_to_18_and_PIPE_from_0_to_2 rule ();
        end
    endgenerate

    wire        idle, done;
    wire        accept = in_valid && in_ready;
    wire [46:0] op;
    assign      in_ready = idle && (!out_valid || out_ready);
    vector_fk6_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_done(done), .out_op(op));

    // The ports as 27-bit words of the product engine
    reg  [12*U+23:0]  joints;
    wire [7*W+27:0]   lengths = {cfg_c4, cfg_c3, cfg_c2, cfg_c1, cfg_b, cfg_a2, cfg_a1};
    wire [19*27-1:0]  words;
    wire [26:0]       port, word;
    wire [5:0]        dest;
    genvar i;
    generate
        for (i = 0; i < 12; i = i + 1) begin : g_joint
            assign words[27*i +: 27] = {joints[(U+2)*i +: U+2], {(25-U){1'b0}}};
        end
        for (i = 0; i < 7; i = i + 1) begin : g_length
            assign words[27*(12+i) +: 27] = {{2{lengths[(W+4)*i+W+3]}}, lengths[(W+4)*i +: W+4], {(21-W){1'b0}}};
        end
    endgenerate
    engine_ports #(.COUNT(19)) operands (.clk(clk), .in_words(words), .in_select(op[43:39]), .out_word(port));
    /* verilator lint_off PINCONNECTEMPTY */
    product_engine #(.PIPE(PIPE), .ROOTS(0)) engine (.clk(clk), .rst(rst), .in_start(accept), .in_run(!idle),
        .in_op(op), .in_port(port), .in_signs(3'd0), .out_word(word), .out_dest(dest), .out_status());
    /* verilator lint_on PINCONNECTEMPTY */

    // Results are nine words of the matrix, then three coordinates
    engine_results #(.COUNT(9), .U(U)) matrix (.clk(clk), .in_word(word), .in_dest(dest),
        .out_words({out_r33, out_r32, out_r31, out_r23, out_r22, out_r21, out_r13, out_r12, out_r11}));
    wire [W+3:0]   near = {word[26], word[26:24-W]} + 1'b1;
    wire           over = near[W+3:W] != {4{near[W+3]}};
    wire [W-1:0]   coordinate = over ? {near[W+3], {(W-1){!near[W+3]}}} : near[W:1];
    reg  [3*W-1:0] tip;
    reg            overflow;
    wire           unused = &{1'b0, near[0], word[23-W:0]};
    assign         {out_z, out_y, out_x} = tip;
    assign         out_status = {1'b0, overflow, 2'd0};
    generate
        for (i = 0; i < 3; i = i + 1) begin : g_axis
            localparam [31:0] DEST = i + 11;
            always @(posedge clk)
                if (dest == DEST[5:0])
                    tip[W*i +: W] <= coordinate;
        end
    endgenerate

    always @(posedge clk) begin
        if (accept)
            joints <= {in_n6, in_c6, in_n5, in_c5, in_n4, in_c4, in_n3, in_c3, in_n2, in_c2, in_n1, in_c1};
        overflow  <= !accept && (overflow || over && (dest == 6'd11 || dest == 6'd12 || dest == 6'd13));
        out_valid <= !rst && (done || out_valid && !out_ready);
    end
endmodule
`default_nettype wire
