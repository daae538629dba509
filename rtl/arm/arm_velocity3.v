// SPDX-License-Identifier: Apache-2.0
// Velocity of the tip of three joints, of which the third yaws the plane of the others: Jacobian times the joints'
// rates.
//   x + i y = (v_rho + i rho w3)(c3 + i n3), where (v_rho, z) are x, y of arm_velocity2
// Formats: in_c*, in_n* s2.U (1.0 is 2^U); in_w* s(W-V).V, radians in a unit of time; cfg_l1, cfg_l2 u(W-F).F; out_*
// s(W-F).F in that unit of time, rounded to nearest (ties upward), saturated.
// Error of a coordinate for vectors that are not longer than 1, rates in radians, s = w1 + w2:
//   1/2 + (3 + sqrt(E^2 + (1 + (3 + sqrt 2) |w3|)^2)) / 16 LSB, E = 3 + sqrt((|s| + |w2| + 2)^2 + (2 |s| + 1)^2)
// Latency and II: 10 + 9 PIPE. The cycle table is in arm_jacobian.v. Status: overflow (a coordinate was saturated).
// Model: arm_velocity.velocity3
`default_nettype none
module arm_velocity3 #(
    parameter W = 16,  // bits of a length, a rate and a velocity, 8 to 24 (default 16)
    parameter F = 8,   // fraction bits of a length and a velocity, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 24 (default 16)
    parameter V = 12,  // fraction bits of a rate, W - 8 to W - 1 and at most U (default 12: rates below 8 rad);
                       // 2 W - 28 or more with PIPE = 1 and MULTIPLY = 18
    parameter PIPE = 0,      // registers around products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    input  wire signed [W-1:0] in_w1,
    input  wire signed [W-1:0] in_w2,
    input  wire signed [W-1:0] in_w3,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 8 || W > 24 || F < 0 || F >= W || U < 8 || U > 24 || V < W - 8 || V >= W || V > U
            || 2 * W - V > 28 + 32 * (PIPE < 1) + 32 * (MULTIPLY > 18) || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            arm_velocity3_needs_W_U_8_to_24_F_V_below_W_V_W_less_8_to_U_at_PIPE_1_by_18_2W_less_28_MULTIPLY_18_27
                rule ();
        end
    endgenerate

    wire   overflow;
    assign out_status = {1'b0, overflow, 2'b00};
    arm_jacobian #(.JOINTS(3), .W(W), .U(U), .V(V), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready),
        .in_c1(in_c1), .in_n1(in_n1), .in_c2(in_c2), .in_n2(in_n2), .in_c3(in_c3), .in_n3(in_n3),
        .in_w1(in_w1), .in_w2(in_w2), .in_w3(in_w3), .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x),
        .out_y(out_y), .out_z(out_z), .out_overflow(overflow));
endmodule
`default_nettype wire
