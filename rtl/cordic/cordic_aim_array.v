// SPDX-License-Identifier: Apache-2.0
// This engine is the vectoring of cordic_aim_iter unrolled, with the same bits: L + 1 stages, registered if CLOCKED.
// Up to step C the second word is w = y or ~y, whichever is not negative; after C it is y, and the steps divide.
//   x' = x + (w >> 2i),  u = w + ~x + (w is ~y),  w' = 2 u or ~2 u
// This costs three cells a bit instead of four, because an exclusive-or before an adder is a cell of its own.
// One look-up by six signs gives the sum of their six angles.
// Formats: in_x and in_y are sW, out_magnitude uW, out_angle uA. No handshake, no status.
// Error at W = A = 16: magnitude 1 LSB and angle 0.84 LSB + 0.24 rad LSB / length with MAGNITUDE and G = 4; angle
// 0.88 LSB + 0.39 rad LSB / length without, G = 3. Model: cordic.aim
`default_nettype none
module cordic_aim_array #(
    parameter W         = 16,  // bits of a coordinate, 8 to 24, with MAGNITUDE to 16 (default 16)
    parameter A         = 16,  // bits of an angle, a turn is 2^A, 4 to 24 (default 16)
    parameter G         = 4,   // guard bits, 3 or more (default 4: a magnitude within 1 LSB; the angle alone needs 3)
    parameter MAGNITUDE = 1,   // 1 (default): also the length, its gain removed; 0: the angle alone, in fewer steps
    parameter CLOCKED   = 1    // 1 (default): a register after every stage; 0: combinational
) (
    input  wire                clk,
    input  wire                in_enable,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire        [W-1:0] out_magnitude,
    output wire        [A-1:0] out_angle
);
    localparam C = (W + 1) / 2;
    localparam U = MAGNITUDE ? C : (W + 1) / 3;
    localparam L = MAGNITUDE ? C + 8 : W;
    localparam B = G + C / 2;
    localparam D = W + 1 + G;
    localparam Y = D + 2;
    localparam Z = A + 5;

    // up to step C the wire y carries w; minus is y < 0; v is x, and from C on the length
    genvar i;
    generate
        for (i = 0; i <= L; i = i + 1) begin : g_step
            wire [D-1:0] x0, x1, x, v0, v1, v;
            wire [Y-1:0] y0, y1, y;
            wire [Z-1:0] z0, z1, z;
            wire [4:0]   signs0, signs;
            wire         minus0, minus1, minus, mirror0, mirror;
            wire         unused_here = &{1'b0, signs0, v0};
            if (i == 0) begin : g_fold
                assign {minus0, mirror0} = {in_y[W-1], in_x[W-1]};
                assign x0 = {1'b0, in_x ^ {W{mirror0}}, {G{mirror0}}};
                assign y0 = {{3{minus0}}, in_y, {(G-1){1'b0}}, 1'b1} ^ {Y{minus0}};
                assign z0 = {mirror0, {(A-1){1'b0}}, 5'd24};
                assign {v0, signs0} = 0;
            end else begin : g_next
                assign {x0, v0, y0, z0} = {g_step[i-1].x, g_step[i-1].v, g_step[i-1].y, g_step[i-1].z};
                assign {signs0, minus0, mirror0} = {g_step[i-1].signs, g_step[i-1].minus, g_step[i-1].mirror};
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
            if (!MAGNITUDE) begin : g_no_length
                assign v1 = 0;
            end else if (i <= C || i > C + 8) begin : g_same
                assign v1 = i <= C ? x1 : v0;
            end else if (i == C + 8) begin : g_round
                assign v1 = v0 + 21;
            end else begin : g_horner
                localparam SHIFT = i == C + 2 || i == C + 3 || i == C + 7 ? 2 : 3;
                assign v1 = x0 + ((v0 >> SHIFT) ^ {D{i == C + 3 || i == C + 6}});
            end
            if (i % 6 == 5 || i == L) begin : g_sum
                localparam N = i % 6 + 1;
                wire [Z-1:0] sum;
                wire [5:0]   minuses = {signs0, minus0 ^ mirror0};
                wire         unused_signs = &{1'b0, minuses};
                cordic_angle #(.I(i + 1 - N), .N(N), .Z(Z)) angles (.in_minus(minuses[N-1:0]), .out_sum(sum));
                assign z1 = z0 + sum;
            end else begin : g_wait
                assign z1 = z0;
            end
            cordic_register #(.WIDTH(2*D+Y+Z+7), .CLOCKED(CLOCKED)) stage (.clk(clk), .in_enable(in_enable),
                .in_d({x1, v1, y1, z1, signs0[3:0], minus0 ^ mirror0, minus1, mirror0}),
                .out_q({x, v, y, z, signs, minus, mirror}));
        end
    endgenerate

    wire [D-1:0] v = g_step[L].v;
    wire [Z-1:0] z = g_step[L].z;
    assign out_magnitude = v[D-1 -: W];
    assign out_angle = z[Z-1 -: A];
    wire unused = &{1'b0, v[G:0], z[4:0], g_step[L].x, g_step[L].y, g_step[L].signs, g_step[L].minus, g_step[L].mirror};
endmodule
`default_nettype wire
