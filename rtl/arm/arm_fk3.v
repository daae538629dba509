// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of a real arm on unit vectors: vector_fk3 with base height, shoulder offset a, lateral offset b,
// elbow offset e and an elbow that is measured from the base. A switch of 0 leaves its part out.
//   rho, z are x, y of vector_fk2 with L2 + i e for L2, plus a and the base height; x + i y = (rho + i b)(c3 + i n3)
// Formats: in_c1 ... in_n3 s2.U (1.0 is 2^U); cfg_l1, cfg_l2 u(W-F).F; other cfg_* and out_* s(W-F).F. Coordinates are
// rounded to nearest (ties upward) and saturated.
// Error of a coordinate: 0.80 LSB for the vectors as they are given, if none is longer than 1.
// Latency and II: 8; with PIPE = 1, the same words, 11 with ABSOLUTE and 14 without. The cycle table is in arm_chain.v.
// Status: overflow (a coordinate was saturated).
// Source: rational trigonometry paper, eqs. 24-31, in vector form, with the offsets of real arms. Model: arm.fk3
`default_nettype none
module arm_fk3 #(
    parameter W = 16,        // bits of a coordinate and of a length, 8 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,        // fraction bits of cosine and sine, 8 to 24 (default 16)
    parameter BASE = 1,      // 1 (default): with base height; 0: without
    parameter SHOULDER = 1,  // 1 (default): with shoulder offset, radial; 0: without
    parameter LATERAL = 1,   // 1 (default): the arm's plane passes beside the yaw axis; 0: through it
    parameter ELBOW = 1,     // 1 (default): with elbow offset, across the forearm; 0: without
    parameter ABSOLUTE = 1,  // 1 (default): joint 2 is measured from the base (parallelogram); 0: from link 1
    parameter PIPE = 0,      // registers around the multipliers, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire signed [W-1:0] cfg_base,
    input  wire signed [W-1:0] cfg_shoulder,
    input  wire signed [W-1:0] cfg_lateral,
    input  wire signed [W-1:0] cfg_elbow,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 8 || W > 24 || F < 0 || F >= W || U < 8 || U > 24 || BASE < 0 || BASE > 1 || SHOULDER < 0
            || SHOULDER > 1 || LATERAL < 0 || LATERAL > 1 || ELBOW < 0 || ELBOW > 1 || ABSOLUTE < 0
            || ABSOLUTE > 1 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0)
        begin : g_illegal
            arm_fk3_needs_W_and_U_from_8_to_24_and_F_below_W_and_switches_and_PIPE_of_0_or_1_and_MULTIPLY_18_or_27
                rule ();
        end
    endgenerate

    wire   overflow;
    assign out_status = {1'b0, overflow, 2'b00};
    arm_chain #(.W(W), .U(U), .ABSOLUTE(ABSOLUTE), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) chain (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_base(cfg_base & {W{BASE != 0}}),
        .cfg_shoulder(cfg_shoulder & {W{SHOULDER != 0}}), .cfg_lateral(cfg_lateral & {W{LATERAL != 0}}),
        .cfg_elbow(cfg_elbow & {W{ELBOW != 0}}), .in_valid(in_valid), .in_ready(in_ready), .in_c1(in_c1),
        .in_n1(in_n1), .in_c2(in_c2), .in_n2(in_n2), .in_c3(in_c3), .in_n3(in_n3), .out_valid(out_valid),
        .out_ready(out_ready), .out_x(out_x), .out_y(out_y), .out_z(out_z), .out_overflow(overflow));
endmodule
`default_nettype wire
