// SPDX-License-Identifier: Apache-2.0
// Rates of three joints, of which the third yaws the plane of the others, from the velocity of the tip: inverse
// Jacobian.
//   (v_rho + i v_t) = (x + i y)(c3 - i n3); w1 and w2 are those of arm_rates2 for (v_rho, z); w3 = v_t / rho
// Formats: in_c*, in_n* s2.U (1.0 is 2^U); in_x, in_y, in_z s(W-F).F in a unit of time; cfg_l1, cfg_l2, cfg_radius
// u(W-F).F; cfg_sine u1.U; out_w* s(W-V).V, radians in that unit of time, rounded to nearest, saturated.
// Error of the velocity that the rates give, in LSB: that of arm_rates2, and |rho| 2^-(V+1) + (3 sqrt(2) + 2 + 6 |w3|)
// / 16 + 2 |v| 2^-U. Latency and II: 9 + 11 PIPE + 3 D, D = ceil((2 W + 7) / R). The cycle table is in arm_inverse.v.
// Status: singular (|n2| is below cfg_sine or |rho| below cfg_radius, which then replaces it; or a divisor is 0, and
// the rate 0), overflow (a rate was saturated). Model: arm_velocity.rates3
`default_nettype none
module arm_rates3 #(
    parameter W = 16,  // bits of a length, a rate and a velocity, 8 to 24 (default 16)
    parameter F = 8,   // fraction bits of a length and a velocity, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 24 (default 16)
    parameter V = 12,  // fraction bits of a rate, W - 8 to W - 1 and at most U (default 12: rates below 8 rad);
                       // 2 W - 28 or more with PIPE = 1 and MULTIPLY = 18
    parameter R = 4,   // digits of a quotient in one clock, 1 to 5 (default 4)
    parameter PIPE = 0,      // registers around products, 0 or 1 (default 0: fewest clocks); 2 digits keep up with 1
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire [U:0]          cfg_sine,
    input  wire [W-1:0]        cfg_radius,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_w1,
    output wire signed [W-1:0] out_w2,
    output wire signed [W-1:0] out_w3,
    output wire [3:0]          out_status
);
    generate
        if (W < 8 || W > 24 || F < 0 || F >= W || U < 8 || U > 24 || V < W - 8 || V >= W || V > U || R < 1
            || R > 5 || 2 * W - V > 28 + 32 * (PIPE < 1) + 32 * (MULTIPLY > 18) || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            arm_rates3_needs_W_U_8_to_24_F_V_below_W_V_W_less_8_to_U_at_PIPE_1_by_18_2W_less_28_R_to_5_MULTIPLY_18_27
                rule ();
        end
    endgenerate

    arm_inverse #(.JOINTS(3), .W(W), .U(U), .V(V), .R(R), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_sine(cfg_sine), .cfg_radius(cfg_radius),
        .in_valid(in_valid), .in_ready(in_ready), .in_c1(in_c1), .in_n1(in_n1), .in_c2(in_c2), .in_n2(in_n2),
        .in_c3(in_c3), .in_n3(in_n3), .in_x(in_x), .in_y(in_y), .in_z(in_z),
        .out_valid(out_valid), .out_ready(out_ready), .out_w1(out_w1), .out_w2(out_w2), .out_w3(out_w3),
        .out_status(out_status));
endmodule
`default_nettype wire
