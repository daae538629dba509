// SPDX-License-Identifier: Apache-2.0
// This engine is one vectoring of classic_solve_iter unrolled, with the same bits, combinational. It gives the final x
// and adds the angle to z, or subtracts it if in_minus.
// Up to C a micro-rotation carries w = y or ~y, whichever is not negative, as cordic_aim_array does. Then it divides.
//   x' = x + (w >> 2i),  u = w + ~x + (w is ~y),  w' = 2 u or ~2 u
// One look-up by six signs gives the sum of their six angles.
// Formats: in_x and in_y have 4 guard bits; a turn of in_z and out_z is 2^(A+6).
// Error of the angle at W = A = 16: 1.73e-5 rad + 0.24 rad LSB / length. Model: classic.ik2, classic.ik3
`default_nettype none
module classic_aim_array #(
    parameter W = 16,  // bits of a coordinate, 8 to 24 (default 16)
    parameter A = 16,  // bits of an angle, a turn is 2^A, 4 to 24 (default 16)
    parameter U = 6    // last micro-rotation that changes x, up to (W + 1) / 2 (default 6: two joints at W = 16)
) (
    input  wire        [W+5:0] in_x,
    input  wire signed [W+7:0] in_y,
    input  wire        [A+5:0] in_z,
    input  wire                in_minus,
    output wire        [W+5:0] out_x,
    output wire        [A+5:0] out_z
);
    localparam G = 4;
    localparam C = (W + 1) / 2;
    localparam L = W + 1;
    localparam B = G + C / 2;
    localparam D = W + 2 + G;
    localparam Y = D + 2;
    localparam Z = A + 6;
    genvar i;
    generate
        for (i = 0; i <= L; i = i + 1) begin : g_step
            wire [D-1:0] x0, x1;
            wire [Y-1:0] y0, y1;
            wire [Z-1:0] z0, z1;
            wire [4:0]   signs0;
            wire         minus0, minus1;
            wire         unused_here = &{1'b0, signs0};
            if (i == 0) begin : g_first
                assign {x0, y0, z0} = {in_x, in_y ^ {Y{in_y[Y-1]}}, in_z};
                assign {signs0, minus0} = {5'd0, in_y[Y-1]};
            end else begin : g_next
                assign {x0, y0, z0} = {g_step[i-1].x1, g_step[i-1].y1, g_step[i-1].z1};
                assign {signs0, minus0} = {g_step[i-1].signs0[3:0], g_step[i-1].minus0 ^ in_minus, g_step[i-1].minus1};
            end
            if (i <= U) begin : g_grow
                wire [Y-1:0] sum = {2'b00, x0} + (y0 >> 2 * i);
                wire         unused_top = &{1'b0, sum[Y-1:D]};
                assign x1 = sum[D-1:0];
            end else begin : g_still
                assign x1 = x0;
            end
            if (i <= C) begin : g_rotation
                wire [Y-1:0] u;
                wire         unused_carry;
                assign {u, unused_carry} = {y0, 1'b1} + {2'b11, ~x0, minus0};
                assign minus1 = u[Y-1] ^ minus0;
                assign y1 = {u[Y-2:0], minus0} ^ {Y{minus0 ^ (minus1 && i < C)}};
            end else begin : g_division
                wire [Y-B-1:0] u = y0[Y-1:B] + ({2'b00, x0[D-1:B]} ^ {(Y-B){!minus0}});
                assign minus1 = u[Y-B-2];
                assign y1 = {u[Y-B-2:0], y0[B-1:0], 1'b0};
            end
            if (i % 6 == 5 || i == L) begin : g_sum
                localparam N = i % 6 + 1;
                wire [Z-1:0] sum;
                wire [5:0]   minuses = {signs0, minus0 ^ in_minus};
                wire         unused_signs = &{1'b0, minuses};
                cordic_angle #(.I(i + 1 - N), .N(N), .Z(Z)) angles (.in_minus(minuses[N-1:0]), .out_sum(sum));
                assign z1 = z0 + sum;
            end else begin : g_wait
                assign z1 = z0;
            end
        end
    endgenerate
    assign {out_x, out_z} = {g_step[L].x1, g_step[L].z1};
    wire unused = &{1'b0, g_step[L].y1, g_step[L].minus1};
endmodule
`default_nettype wire
