// SPDX-License-Identifier: Apache-2.0
// Rotation engine: a micro-rotation a clock in place, then two bits of the residual angle a clock. No handshake.
//   i = 1 .. C:   x -= d y >> i,  y += d x >> i,  z -= d atan 2^-i,  d = sign of z, -1 or 1
//   r = C + 1, C + 3 ..:   x -= d yf >> r,  y += d xf >> r,  z -= d 2^-r,  d in -2 .. 2, xf and yf stand still
// Below 2^-C a turn lengthens by less than 2^-(2C+1), so that the second half may be linear and its digits 0 or 2.
// in_z sZ.(Z+1) turns, |z| <= 1/8. x - v is x + ~v: no carry in, and a shift is 1/2 unit low whatever its sign; R,
// added last, takes out that mean and rounds. With GAIN the first N clocks bring in in_f* (given crosswise, x and y
// from 0) times 0.858785, a digit a clock; without it the lengthening by 1.16443 stays in.
// STEPS clocks after in_start out_done is high for one clock; x and y are final from the next one on.
`default_nettype none
module cordic_turn_iter #(
    parameter W    = 16,
    parameter D    = 22,
    parameter GAIN = 1,
    parameter [7:0] R = 24
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_start,
    input  wire [D-1:0] in_x,
    input  wire [D-1:0] in_y,
    input  wire [D-1:0] in_fx,
    input  wire [D-1:0] in_fy,
    input  wire         in_minus_x,
    input  wire         in_minus_y,
    input  wire [W+3:0] in_z,
    output reg          out_busy,
    output wire         out_done,
    output reg  [D-1:0] out_x,
    output reg  [D-1:0] out_y
);
    localparam Z = W + 4;
    localparam C = (W + 1) / 2;
    localparam T = (W - C + 1) / 2 + 1;
    localparam integer N = GAIN ? 3 + (W > 10) + (W > 12) + (W > 15) : 0;
    localparam STEPS = N + C + T + 1;

    // the shift of a step as digits in base 3, {9s, 3s, 1s}; 3 in the last one stands for the constant R
    function [4:0] shift_digits(input integer step, input integer two);
        integer shift;
        begin
            if (step < N) shift = step < 3 ? 3 * step : step == 3 ? 11 : step == 4 ? 13 : 16;
            else if (step < N + C) shift = step - N + 1;
            else shift = C + 1 + 2 * (step - N - C) - two;
            shift = step >= N + C + T ? 3 : 16 * (shift / 9) + 4 * (shift % 9 / 3) + shift % 3;
            shift_digits = shift[4:0];
        end
    endfunction
    function [319:0] all_shifts(input integer count);
        integer i;
        for (i = 0; i < count; i = i + 1)
            all_shifts[5*i +: 5] = shift_digits(i % 32, i / 32);
    endfunction
    localparam [319:0] SHIFTS = all_shifts(64);

    // control: what a step needs is made ready in the clock before it
    (* fsm_encoding = "none" *) reg [4:0] next;
    (* fsm_encoding = "none" *) reg [4:0] shift;
    (* fsm_encoding = "none" *) reg [3:0] word;  // of the angle ROM: micro-rotation 0 .. C-1, then C + |digit|
    reg                 turning, tail, less, move, thaw, minus_x, minus_y;
    reg         [Z-1:0] z;
    wire        [Z-1:0] sum_z, next_z;
    wire        [2:0]   top = next_z[Z-2 -: 3] ^ {3{next_z[Z-1]}};
    wire                two = top[2];
    wire                one = !top[2] && top[1:0] != 2'd0;
    wire signed [31:0]  at = {27'd0, next};
    wire                to_tail = at >= N + C && at < N + C + T;
    assign out_done = out_busy && at == STEPS;
    always @(posedge clk) begin
        next  <= !rst && (in_start || (out_busy && !out_done)) ? next + 5'd1 : 5'd0;
        shift <= SHIFTS[5 * {26'd0, to_tail && two, next} +: 5];
        word  <= to_tail ? C[3:0] + {2'd0, two, one} : next[3:0] - N[3:0];
        turning <= at >= N && at < N + C + T;
        tail  <= to_tail;
        less  <= GAIN && at > 0 && at < 5;
        move  <= !to_tail || two || one;
        thaw  <= at + 1 >= N && at < N + C;
        out_busy <= !rst && (in_start || (out_busy && !out_done));
        if (in_start) {minus_x, minus_y} <= {in_minus_x, in_minus_y};
        else if (turning) {minus_x, minus_y} <= 2'b00;  // R is added as it is
    end

    // angle: scaled by 2 or 4 a step, so that a digit always sits in the top bits
    wire [32*Z-1:0] terms;  // to subtract, then to add: the sign is one more input of the ROM's cell
    genvar g;
    generate
        for (g = 0; g < 32; g = g + 1) begin : g_word
            localparam M = g % 16;
            localparam I = M < C ? M + 1 : 9;
            localparam LOW = M < C ? (M > 2 ? M - 2 : 0) : C > 2 ? C - 2 : 0;  // bits too fine to matter then
            localparam TWO = M == C + 2 ? 1 : 0;
            wire [Z+I-1:0] angle;
            wire           unused = &{1'b0, angle};
            cordic_angle #(.I(I), .Z(Z + I)) constant (.in_minus(1'b0), .out_sum(angle));
            if (M == C || M > C + 2) begin : g_none
                assign terms[Z*g +: Z] = {Z{1'b0}};
            end else begin : g_some
                assign terms[Z*g +: Z] = {angle[Z-1-TWO:LOW-TWO] ^ {(Z-LOW){g < 16}}, {LOW{1'b0}}};
            end
        end
    endgenerate
    assign sum_z = z + terms[Z*{z[Z-1], word} +: Z];
    assign next_z = tail ? sum_z << 2 : sum_z << 1;
    always @(posedge clk)
        if (in_start) z <= in_z;
        else if (turning) z <= next_z;

    // vector
    reg  signed [D-1:0] xf, yf;
    wire        [D-1:0] sum_x, sum_y;
    cordic_shift #(.D(D), .R(R)) shift_x (.in_v(yf), .in_shift(shift),
        .in_minus(turning ? !z[Z-1] : minus_x ^ less), .in_a(out_x), .out_sum(sum_x));
    cordic_shift #(.D(D), .R(R)) shift_y (.in_v(xf), .in_shift(shift),
        .in_minus(turning ?  z[Z-1] : minus_y ^ less), .in_a(out_y), .out_sum(sum_y));
    always @(posedge clk) begin
        if (in_start) {out_x, out_y} <= {in_x, in_y};
        else if (out_busy && move) {out_x, out_y} <= {sum_x, sum_y};
        if (in_start) {xf, yf} <= {in_fx, in_fy};
        else if (thaw) {xf, yf} <= {sum_x, sum_y};
    end
endmodule
`default_nettype wire
