// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of a rotary delta, three crank vectors to the tip: the lower or upper point where three spheres of
// radius LB about the shifted elbows E, E + a, E + b meet, without a division.
//   N = a x b, V = |a|^2 b - |b|^2 a, D = 4 LB^2 N^2 - V^2, Q = V x N -+ N sqrt(D), tip = E + LB Q / |Q|
// Formats: in_c*, in_n* cos and sin of a crank, s2.U; out_x, out_y, out_z s(W-F).F, rounded to nearest (ties upward),
// saturated, from the middle of the plane of the crank axes; cfg_base, cfg_la, cfg_lb s(W-F).(F+4), cfg_c*, cfg_n*
// azimuths s2.25: engine_delta.config. Error: 1/2 LSB and bounds.engine.delta_tip. Latency and II: 66, 77 at PIPE = 1,
// 83 at PIPE = 2.
// Status: unreachable (the spheres do not meet: LB from elbow 1 towards the centre of the circle through the elbows),
// singular (the elbows meet in one point: the last tip is held, elbow 1 before there was one), overflow (saturated).
// Source: three spheres. Model: engine_delta.fk
`default_nettype none
module engine_delta_fk #(
    parameter W = 16,  // bits of a coordinate, 4 to 16 (default 16: 1024 mm at 1/64 mm)
    parameter F = 6,   // fraction bits of a coordinate, 0 to W - 1 (default 6); they change no logic
    parameter U = 16,  // fraction bits of a unit vector, 8 to 18 (default 16, 0.0009 degrees)
    parameter PIPE = 0 // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W+3:0] cfg_base,
    input  wire signed [W+3:0] cfg_la,
    input  wire signed [W+3:0] cfg_lb,
    input  wire signed [26:0]  cfg_c1,
    input  wire signed [26:0]  cfg_n1,
    input  wire signed [26:0]  cfg_c2,
    input  wire signed [26:0]  cfg_n2,
    input  wire signed [26:0]  cfg_c3,
    input  wire signed [26:0]  cfg_n3,
    input  wire                cfg_above,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || PIPE < 0 || PIPE > 2) begin : g_illegal
            engine_delta_fk_needs_W_from_4_to_16_and_F_below_W_and_U_from_8_to_18_and_PIPE_from_0_to_2 rule ();
        end
    endgenerate

    wire        idle, done;
    wire        accept = in_valid && in_ready;
    wire [2:0]  from;    // of a line: the kind of its first operand, and the top bit of that one's number
    wire [4:0]  select;  // the other bits, a port's number
    wire [38:0] rest;
    assign      in_ready = idle && (!out_valid || out_ready);
    engine_delta_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_done(done), .out_op({from, select, rest}));

    // Ports as words of the engine; a length of 1.0 is 2^(W + 2) LSB, so that no word formed of lengths overflows
    reg  [6*U+11:0]  cranks;
    wire [3*W+11:0]  lengths = {cfg_lb, cfg_la, cfg_base};
    wire [17*27-1:0] words;
    wire [26:0]      port, word;
    wire [5:0]       dest;
    wire [3:0]       status;
    genvar i;
    generate
        for (i = 0; i < 6; i = i + 1) begin : g_crank
            assign words[27*i +: 27] = {cranks[(U+2)*i +: U+2], {(25-U){1'b0}}};
        end
        for (i = 0; i < 3; i = i + 1) begin : g_length
            assign words[27*(6+i) +: 27] = {{4{lengths[(W+4)*i+W+3]}}, lengths[(W+4)*i +: W+4], {(19-W){1'b0}}};
        end
    endgenerate
    assign words[27*9 +: 27] = {words[27*8 +: 26], 1'b0};  // 2 LB
    assign words[27*10 +: 7*27] = {27'h2000000, cfg_n3, cfg_c3, cfg_n2, cfg_c2, cfg_n1, cfg_c1};
    engine_ports #(.COUNT(17)) operands (.clk(clk), .in_words(words), .in_select(select), .out_word(port));

    // The root is negative for the lower point where the normal of the plane of the elbows points upwards
    localparam [5:0] NZ = 6'd24, X = 6'd3, Y = 6'd7, Z = 6'd11;  // registers of engine_delta_program
    reg         down;
    product_engine #(.PIPE(PIPE), .WRIST(7)) engine (.clk(clk), .rst(rst), .in_start(accept), .in_run(!idle),
        .in_op({from, select, rest}), .in_port(port), .in_signs({2'd0, !down ^ cfg_above}),
        .out_word(word), .out_dest(dest), .out_status(status));

    wire [W+5:0] near = {word[26], word[26:22-W]} + 1'b1;
    wire         over = near[W+5:W] != {6{near[W+5]}};
    wire [W-1:0] coordinate = over ? {near[W+5], {(W-1){!near[W+5]}}} : near[W:1];
    reg  [W-1:0] x, y, z;
    reg  [3:1]   overflow;
    wire         unused = &{1'b0, near[0], word[21-W:0], status[3:2]};
    assign       {out_z, out_y, out_x} = {z, y, x};
    assign       out_status = {1'b0, overflow != 3'd0, status[1:0]};
    always @(posedge clk) begin
        if (accept)
            cranks <= {in_n3, in_c3, in_n2, in_c2, in_n1, in_c1};
        if (dest == NZ)
            down <= word[26];
        if (dest == X)
            {overflow[1], x} <= {over, coordinate};
        if (dest == Y)
            {overflow[2], y} <= {over, coordinate};
        if (dest == Z)
            {overflow[3], z} <= {over, coordinate};
        out_valid <= !rst && (done || out_valid && !out_ready);
    end
endmodule
`default_nettype wire
