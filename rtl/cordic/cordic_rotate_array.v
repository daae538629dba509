// SPDX-License-Identifier: Apache-2.0
// This engine is a full-circle rotation, unrolled and gain compensated.
//   out_x + j out_y = (in_x + j in_y) * exp(2 pi j in_angle / 2^A), nearest, saturated
// Exchange and signs make quarter turns, digits of the input apply the gain (0.858785), and cordic_turn_array rotates.
// If CLOCKED it has 4 + C + T + (T+1)/2 stages of registers. The bits are those of the iterative form.
// Formats: in_angle is uA, coordinates are sW, any fraction. Error: at most 1.55 LSB a coordinate.
// Status: overflow (a coordinate was saturated). Model: cordic.rotate
`default_nettype none
module cordic_rotate_array #(
    parameter W       = 16,  // bits of a coordinate, 8 to 16 (default 16)
    parameter A       = 16,  // bits of an angle, a turn is 2^A, 5 to W + 3 (default 16)
    parameter CLOCKED = 1    // 1 (default): a register after every stage; 0: combinational
) (
    input  wire                clk,
    input  wire                in_enable,
    input  wire        [A-1:0] in_angle,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire        [3:0]   out_status
);
    localparam G = 5;
    localparam D = W + 1 + G;
    localparam N = 3 + (W > 10) + (W > 12) + (W > 15);  // digits of the gain, as in cordic_turn_iter

    wire         odd = in_angle[A-2] ^ in_angle[A-3];
    wire         half = in_angle[A-1] ^ (in_angle[A-2] & in_angle[A-3]);
    wire [W+3:0] z0 = {in_angle[A-3], in_angle[A-3:0], {(W+3-A){1'b0}}, 2'b10};
    wire [W+3:0] z1, z2, z3;
    wire [W-1:0] vx, vy;
    wire         sx, sy;
    cordic_register #(.WIDTH(3*W+6), .CLOCKED(CLOCKED)) fold (.clk(clk), .in_enable(in_enable),
        .in_d({(odd ? in_y : in_x) ^ {W{half ^ odd}}, (odd ? in_x : in_y) ^ {W{half}}, half ^ odd, half, z0}),
        .out_q({vx, vy, sx, sy, z1}));

    // the digits form three words; the finest are added first, which keeps most adders narrow
    wire [D-1:0] ax, ay, ax_d, ay_d, x, y;
    wire [D-7:0] bx, by, cx, cy, bx_d, by_d, cx_d, cy_d;
    wire [D-7:0] low_x = bx + cx, low_y = by + cy;
    cordic_gain #(.D(D), .N(N)) gain_x (
        .in_v({vx[W-1], vx, {G{sx}}}), .out_coarse(ax_d), .out_middle(bx_d), .out_fine(cx_d));
    cordic_gain #(.D(D), .N(N)) gain_y (
        .in_v({vy[W-1], vy, {G{sy}}}), .out_coarse(ay_d), .out_middle(by_d), .out_fine(cy_d));
    cordic_register #(.WIDTH(6*D-24+W+4), .CLOCKED(CLOCKED)) digits (.clk(clk), .in_enable(in_enable),
        .in_d({ax_d, ay_d, bx_d, by_d, cx_d, cy_d, z1}), .out_q({ax, ay, bx, by, cx, cy, z2}));
    cordic_register #(.WIDTH(2*D+W+4), .CLOCKED(CLOCKED)) gained (.clk(clk), .in_enable(in_enable),
        .in_d({ax + {{6{low_x[D-7]}}, low_x}, ay + {{6{low_y[D-7]}}, low_y}, z2}), .out_q({x, y, z3}));

    wire [D-1:0] rx, ry;
    cordic_turn_array #(.W(W), .D(D), .R(8'd24), .CLOCKED(CLOCKED)) turn (.clk(clk), .in_enable(in_enable),
        .in_x(x), .in_y(y), .in_z(z3), .out_x(rx), .out_y(ry));
    wire unused = &{1'b0, rx[G-1:0], ry[G-1:0]};
    cordic_clamp #(.W(W)) clamp (.in_x(rx[D-1 -: W+1]), .in_y(ry[D-1 -: W+1]),
        .out_x(out_x), .out_y(out_y), .out_overflow(out_status[2]));
    assign {out_status[3], out_status[1:0]} = 3'b000;
endmodule
`default_nettype wire
