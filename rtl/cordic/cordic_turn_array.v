// SPDX-License-Identifier: Apache-2.0
// Rotation unrolled: C micro-rotations, then T digits of the residual angle. What cordic_turn_iter does step by step,
// bit for bit, in C + T + 1 stages: registers where CLOCKED, none otherwise. The rows of the digits are 2^-C of the
// vector at most: they are summed by themselves, in narrow adders, the rounding constant R with them.
`default_nettype none
module cordic_turn_array #(
    parameter W       = 16,
    parameter D       = 22,
    parameter [7:0] R = 24,
    parameter CLOCKED = 1
) (
    input  wire         clk,
    input  wire         in_enable,
    input  wire [D-1:0] in_x,
    input  wire [D-1:0] in_y,
    input  wire [W+3:0] in_z,
    output wire [D-1:0] out_x,
    output wire [D-1:0] out_y
);
    localparam Z = W + 4;
    localparam C = (W + 1) / 2;
    localparam T = (W - C + 1) / 2 + 1;
    localparam P = D - C + 1;  // of a row, the vector >> C; all of them are less than twice that

    genvar i;
    generate
        for (i = 1; i <= C; i = i + 1) begin : g_rotation
            wire [D-1:0] x0, w0, x, w, x1, w1;
            wire [Z-1:0] z0, z, z1;
            wire         n0, n, n1;
            if (i == 1) begin : g_first
                assign {x0, w0, z0, n0} = {in_x, in_y ^ {D{!in_z[Z-1]}}, in_z, !in_z[Z-1]};
            end else begin : g_next
                assign {x0, w0, z0, n0} = {g_rotation[i-1].x, g_rotation[i-1].w, g_rotation[i-1].z, g_rotation[i-1].n};
            end
            cordic_rotation #(.I(i), .D(D), .Z(Z), .LAST(i == C)) rotation (
                .in_x(x0), .in_w(w0), .in_n(n0), .in_z(z0), .out_x(x1), .out_w(w1), .out_n(n1), .out_z(z1));
            cordic_register #(.WIDTH(2*D+Z+1), .CLOCKED(CLOCKED)) stage (.clk(clk), .in_enable(in_enable),
                .in_d({x1, w1, z1, n1}), .out_q({x, w, z, n}));
        end
        for (i = 0; i < T; i = i + 1) begin : g_digit
            wire [D-1:0] x0, y0, x, y;
            wire [P-1:0] px0, py0, px1, py1, px, py;
            wire [Z-1:0] z0, z1, z;
            if (i == 0) begin : g_first
                wire unused = g_rotation[C].n;
                assign {x0, y0, z0} = {g_rotation[C].x, g_rotation[C].w, g_rotation[C].z};
                assign {px0, py0} = {2{{(P-8){1'b0}}, R}};
            end else begin : g_next
                assign {x0, y0, z0} = {g_digit[i-1].x, g_digit[i-1].y, g_digit[i-1].z};
                assign {px0, py0} = {g_digit[i-1].px, g_digit[i-1].py};
            end
            cordic_digit #(.S(2*i+2), .P(P), .Z(Z), .LOW(C > 2 ? C - 2 : 0)) digit (
                .in_x(px0), .in_y(py0), .in_xf(x0[D-1 -: P]), .in_yf(y0[D-1 -: P]), .in_z(z0),
                .out_x(px1), .out_y(py1), .out_z(z1));
            cordic_register #(.WIDTH(2*D+2*P+Z), .CLOCKED(CLOCKED)) stage (.clk(clk), .in_enable(in_enable),
                .in_d({x0, y0, px1, py1, z1}), .out_q({x, y, px, py, z}));
        end
    endgenerate

    wire [D-1:0] px = {{(D-P){g_digit[T-1].px[P-1]}}, g_digit[T-1].px};
    wire [D-1:0] py = {{(D-P){g_digit[T-1].py[P-1]}}, g_digit[T-1].py};
    wire         unused = &{1'b0, g_digit[T-1].z};
    cordic_register #(.WIDTH(2*D), .CLOCKED(CLOCKED)) last (.clk(clk), .in_enable(in_enable),
        .in_d({g_digit[T-1].x + px, g_digit[T-1].y + py}), .out_q({out_x, out_y}));
endmodule
`default_nettype wire
