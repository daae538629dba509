// SPDX-License-Identifier: Apache-2.0
// Rotates a vector by a binary angle, full circle, gain compensated: a micro-rotation a clock, or a rotation a clock.
//   out_x + j out_y = (in_x + j in_y) * exp(2 pi j in_angle / 2^A), rounded to nearest, saturated
// Formats: in_angle uA, 2^A to the turn; in_x, in_y, out_x, out_y sW, any fraction.
// Error: at most 1.55 LSB each at every W and A (bounds.cordic.rotate).
// Latency: at W = 16 21 clocks in MODE 0 (6 for the gain, 8 micro-rotations, 5 digits, 1 to round) and 20 in MODE 1.
// II: the latency in MODE 0, 1 in MODE 1, whose pipeline moves as a whole.
// Status: overflow. Model: cordic.rotate
`default_nettype none
module cordic_rotate #(
    parameter MODE = 0,  // 0: iterative, 1: pipelined (default 0)
    parameter W    = 16, // bits of a coordinate, 8 to 16 (default 16)
    parameter A    = 16  // bits of an angle, 5 to W + 3, 2^A to the turn (default 16, as sharp as the coordinates)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire        [A-1:0] in_angle,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire        [3:0]   out_status
);
    generate
        if (MODE < 0 || MODE > 1 || W < 8 || W > 16 || A < 5 || A > W + 3) begin : g_illegal
            cordic_rotate_needs_MODE_0_or_1_and_W_from_8_to_16_and_A_from_5_to_W_plus_3 rule ();
        end
        if (MODE == 0) begin : g_iterative
            localparam G = 5;          // guard bits
            localparam D = W + 1 + G;  // sqrt(2) * 1.1645 < 2: one bit of growth

            // quarter turns by exchange and sign, so that at most an eighth of a turn is left
            wire         odd = in_angle[A-2] ^ in_angle[A-3];
            wire         half = in_angle[A-1] ^ (in_angle[A-2] & in_angle[A-3]);
            wire [W+3:0] z = {in_angle[A-3], in_angle[A-3:0], {(W+3-A){1'b0}}, 2'b10};
            wire [D-1:0] x, y;
            wire         busy, done;
            wire         start = in_valid && in_ready;
            wire [W-1:0] first = odd ? in_y : in_x;
            wire [W-1:0] second = odd ? in_x : in_y;

            cordic_turn_iter #(.W(W), .D(D), .GAIN(1), .R(8'd24)) turn (
                .clk(clk), .rst(rst), .in_start(start), .in_x({D{1'b0}}), .in_y({D{1'b0}}),
                .in_fx({second[W-1], second, {G{1'b0}}}), .in_fy({first[W-1], first, {G{1'b0}}}),
                .in_minus_x(half ^ odd), .in_minus_y(half), .in_z(z),
                .out_busy(busy), .out_done(done), .out_x(x), .out_y(y));

            reg valid;
            assign out_valid = valid;
            assign in_ready = !busy && (!valid || out_ready);
            always @(posedge clk)
                valid <= !rst && (done || (valid && !out_ready));

            wire unused = &{1'b0, x[G-1:0], y[G-1:0]};
            cordic_clamp #(.W(W)) clamp (.in_x(x[D-1 -: W+1]), .in_y(y[D-1 -: W+1]),
                .out_x(out_x), .out_y(out_y), .out_overflow(out_status[2]));
            assign {out_status[3], out_status[1:0]} = 3'b000;
        end else begin : g_pipelined
            localparam C = (W + 1) / 2;
            localparam T = (W - C + 1) / 2 + 1;
            localparam STAGES = 4 + C + T + (T + 1) / 2;
            reg [STAGES-1:0] valid;
            wire             move = out_ready || !out_valid;
            always @(posedge clk)
                if (rst) valid <= {STAGES{1'b0}};
                else if (move) valid <= {valid[STAGES-2:0], in_valid};
            assign in_ready = move;
            assign out_valid = valid[STAGES-1];
            cordic_rotate_array #(.W(W), .A(A), .CLOCKED(1)) array (.clk(clk), .in_enable(move),
                .in_angle(in_angle), .in_x(in_x), .in_y(in_y), .out_x(out_x), .out_y(out_y), .out_status(out_status));
        end
    endgenerate
endmodule
`default_nettype wire
