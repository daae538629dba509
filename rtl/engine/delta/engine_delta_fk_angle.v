// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of a rotary delta, three binary angles to the tip: one angle_to_vector converts the three cranks
// one after the other for engine_delta_fk.
// Formats: in_j* angles of A bits, a full turn is 2^A; U fraction bits of their vectors inside; out_x, out_y, out_z
// s(W-F).F, rounded to nearest, saturated; cfg_base, cfg_la, cfg_lb s(W-F).(F+4), cfg_c*, cfg_n* azimuths s2.25:
// engine_delta.config.
// Error: 1/2 LSB and bounds.engine.delta_tip, with 0.83 2^-U in each coordinate of a crank vector. Latency and II: 73,
// 86 at PIPE = 1, 92 at PIPE = 2.
// Status: unreachable (the spheres do not meet: LB from elbow 1 towards the centre of the circle through the elbows),
// singular (the elbows meet in one point: the last tip is held, elbow 1 before there was one), overflow (saturated).
// Source: three spheres. Model: engine_delta.fk_angle
`default_nettype none
module engine_delta_fk_angle #(
    parameter W = 16,  // bits of a coordinate, 4 to 16 (default 16: 1024 mm at 1/64 mm)
    parameter F = 6,   // fraction bits of a coordinate, 0 to W - 1 (default 6); they change no logic
    parameter A = 18,  // bits of an angle, 12 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
    parameter U = 16,  // fraction bits of a unit vector inside, 12 to 18 (default 16)
    parameter PIPE = 0 // registers behind tables and products, 0 to 2 (default 0: fewest clocks)
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
    input  wire [A-1:0]        in_j1,
    input  wire [A-1:0]        in_j2,
    input  wire [A-1:0]        in_j3,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || A < 12 || A > 24 || U < 12 || U > 18 || PIPE < 0 || PIPE > 2)
        begin : g_illegal
            engine_delta_fk_angle_needs_W_from_4_to_16_F_below_W_A_from_12_to_24_U_from_12_to_18_and_PIPE_from_0_to_2
                rule ();
        end
    endgenerate

    reg  [3*A-1:0]      angles;  // the crank that is offered is in the lowest bits
    reg  [3:1]          left;    // one-hot: crank that the codec answers next, 0 between samples
    reg  [3:1]          feed;    // one-hot: crank that is offered to the codec
    wire                ready, have, kernel_ready;
    wire signed [U+1:0] c, n;
    wire                accept = in_valid && in_ready;
    assign              in_ready = left == 3'd0 && kernel_ready;
    angle_to_vector #(.A(A), .U(U), .PIPE(PIPE > 0 ? 1 : 0)) codec (.clk(clk), .rst(rst), .in_valid(feed != 3'd0),
        .in_ready(ready), .in_j(angles[A-1:0]), .out_valid(have), .out_ready(1'b1), .out_c(c), .out_n(n));

    reg  [4*U+7:0] first;  // vectors of cranks 1 and 2, the later one in the top bits
    always @(posedge clk) begin
        if (accept)
            angles <= {in_j3, in_j2, in_j1};
        else if (ready)
            angles <= angles >> A;
        if (have)
            first <= {n, c, first[4*U+7:2*U+4]};
        feed <= rst ? 3'd0 : accept ? 3'd1 : ready ? feed << 1 : feed;
        left <= rst ? 3'd0 : accept ? 3'd1 : have ? left << 1 : left;
    end
    engine_delta_fk #(.W(W), .F(F), .U(U), .PIPE(PIPE)) kernel (.clk(clk), .rst(rst), .cfg_base(cfg_base),
        .cfg_la(cfg_la), .cfg_lb(cfg_lb), .cfg_c1(cfg_c1), .cfg_n1(cfg_n1), .cfg_c2(cfg_c2), .cfg_n2(cfg_n2),
        .cfg_c3(cfg_c3), .cfg_n3(cfg_n3), .cfg_above(cfg_above), .in_valid(have && left[3]), .in_ready(kernel_ready),
        .in_c1(first[0 +: U+2]), .in_n1(first[U+2 +: U+2]), .in_c2(first[2*U+4 +: U+2]),
        .in_n2(first[3*U+6 +: U+2]), .in_c3(c), .in_n3(n), .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x),
        .out_y(out_y), .out_z(out_z), .out_status(out_status));
endmodule
`default_nettype wire
