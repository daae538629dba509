// SPDX-License-Identifier: Apache-2.0
// This engine is the rotation of cordic_turn_iter unrolled, with the same bits: C micro-rotations, then T digits of the
// residual angle. It has C + T + (T+1)/2 + 1 stages, registered if CLOCKED.
// The digits add at most 2^-C of the vector. Their contributions are summed apart from it, finest first, so that every
// adder is as narrow as its sum. R, below 32, is added with the first of them.
// Format: in_z is s(W+4).(W+5) turns, |z| <= 1/8. The vector grows by 1.16443. Model: cordic.turn
`default_nettype none
module cordic_turn_array #(
    parameter W       = 16,  // bits of a coordinate, 8 to 24 (default 16)
    parameter D       = 22,  // bits of the vector, guard bits included, W + 5 or more (default 22 = W + 6)
    parameter [7:0] R = 24,  // constant added last, in guard units (default 24: half an LSB and the mean of the shifts)
    parameter CLOCKED = 1    // 1 (default): a register after every stage; 0: combinational
) (
    input  wire                clk,
    input  wire                in_enable,
    input  wire signed [D-1:0] in_x,
    input  wire signed [D-1:0] in_y,
    input  wire signed [W+3:0] in_z,
    output wire signed [D-1:0] out_x,
    output wire signed [D-1:0] out_y
);
    localparam Z = W + 4;
    localparam C = (W + 1) / 2;
    localparam T = (W - C + 1) / 2 + 1;
    localparam P = D - C + 1;  // bits of the vector >> C in a row; all rows together are less than twice that

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
            wire [D-1:0]   x0, y0, x, y;
            wire [Z-1:0]   z0, z1, z;
            wire [3*T-1:0] d0, d;  // digits known so far, the first in the low bits
            wire [2:0]     d1;
            if (i == 0) begin : g_first
                wire unused = g_rotation[C].n;
                assign {x0, y0, z0} = {g_rotation[C].x, g_rotation[C].w, g_rotation[C].z};
                assign d0 = {3*T{1'b0}};
            end else begin : g_next
                assign {x0, y0, z0, d0} = {g_digit[i-1].x, g_digit[i-1].y, g_digit[i-1].z, g_digit[i-1].d};
            end
            cordic_digit #(.Z(Z), .LOW(C > 2 ? C - 2 : 0)) digit (.in_z(z0), .out_digit(d1), .out_z(z1));
            cordic_register #(.WIDTH(2*D+Z+3*T), .CLOCKED(CLOCKED && i < T - 1)) stage (.clk(clk),
                .in_enable(in_enable), .in_d({x0, y0, z1, d0 | {{(3*T-3){1'b0}}, d1} << 3*i}), .out_q({x, y, z, d}));
        end
        for (i = T - 1; i >= 0; i = i - 1) begin : g_row
            localparam V = P - 2*i > 7 ? P - 2*i : 7;
            wire [D-1:0]   x0, y0, x, y;
            wire [3*T-1:0] d0, d;
            wire [V-1:0]   px0, py0, px1, py1, px, py;
            if (i == T - 1) begin : g_finest
                assign {x0, y0, d0} = {g_digit[T-1].x, g_digit[T-1].y, g_digit[T-1].d};
                assign {px0, py0} = {2{{(V-5){1'b0}}, R[4:0]}};
            end else begin : g_next
                localparam B = V - (P - 2*i > 9 ? P - 2*i - 2 : 7);
                assign {x0, y0, d0} = {g_row[i+1].x, g_row[i+1].y, g_row[i+1].d};
                assign px0 = {{B{g_row[i+1].px[V-B-1]}}, g_row[i+1].px};
                assign py0 = {{B{g_row[i+1].py[V-B-1]}}, g_row[i+1].py};
            end
            cordic_row #(.S(2*i+2), .P(P), .V(V)) row (.in_digit(d0[3*i +: 3]), .in_x(px0), .in_y(py0),
                .in_xf(x0[D-1 -: P]), .in_yf(y0[D-1 -: P]), .out_x(px1), .out_y(py1));
            cordic_register #(.WIDTH(2*D+3*T+2*V), .CLOCKED(CLOCKED && (i < 2 || (T - 1 - i) % 2 == 0))) stage (
                .clk(clk), .in_enable(in_enable), .in_d({x0, y0, d0, px1, py1}), .out_q({x, y, d, px, py}));
        end
    endgenerate

    wire [D-1:0] px = {{(D-P){g_row[0].px[P-1]}}, g_row[0].px};
    wire [D-1:0] py = {{(D-P){g_row[0].py[P-1]}}, g_row[0].py};
    wire         unused = &{1'b0, R[7:5], g_digit[T-1].z, g_row[0].d};
    cordic_register #(.WIDTH(2*D), .CLOCKED(CLOCKED)) last (.clk(clk), .in_enable(in_enable),
        .in_d({g_row[0].x + px, g_row[0].y + py}), .out_q({out_x, out_y}));
endmodule
`default_nettype wire
