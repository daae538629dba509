// SPDX-License-Identifier: Apache-2.0
// This engine rotates by one micro-rotation a clock, then by one digit (two bits) of the residual angle a clock.
//   i = 1 .. C:   x -= d y >> i,  y += d x >> i,  z -= d atan 2^-i,  d = sign of z, -1 or 1
//   r = C + 1, C + 3 ..:   x -= d yf >> r,  y += d xf >> r,  z -= d 2^-r,  d in -2 .. 2, xf and yf are frozen
// A rotation below 2^-C lengthens by less than 2^-(2C+1), so the second half is linear and its digits may be 0 or 2.
// in_z is s(W+4).(W+5) turns, |z| <= 1/8. x - v is x + ~v without a carry in, so a shift is half a unit low on average,
// whatever its sign. R, added last, removes that mean and rounds.
// With GAIN the first N clocks add in_f* times 0.858785, one digit a clock (in_f* is crosswise, x and y start at 0).
// Without GAIN the vector grows by 1.16443.
// out_done is high for one clock, STEPS clocks after in_start; the result is valid from the next clock on. There is no
// handshake. Model: cordic.turn
`default_nettype none
module cordic_turn_iter #(
    parameter W       = 16,  // bits of a coordinate, 8 to 24; with GAIN to 16 (default 16)
    parameter D       = 22,  // bits of the vector, guard bits included, W + 5 or more (default 22 = W + 6)
    parameter GAIN    = 1,   // 1 (default): removes the gain first; 0: leaves it, for a start vector that contains it
    parameter [7:0] R = 24   // constant added last, in guard units (default 24: half an LSB and the mean of the shifts)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_start,
    input  wire signed [D-1:0] in_x,
    input  wire signed [D-1:0] in_y,
    input  wire signed [D-1:0] in_fx,
    input  wire signed [D-1:0] in_fy,
    input  wire                in_minus_x,
    input  wire                in_minus_y,
    input  wire signed [W+3:0] in_z,
    output reg                 out_busy,
    output wire                out_done,
    output reg  signed [D-1:0] out_x,
    output reg  signed [D-1:0] out_y
);
    localparam C = (W + 1) / 2;
    localparam T = (W - C + 1) / 2 + 1;
    localparam integer N = GAIN ? 3 + (W > 10) + (W > 12) + (W > 15) : 0;
    localparam STEPS = N + C + T + 1;

    // the shift of a step as digits in base 3, {9s, 3s, 1s}; a 3 in the last digit selects the constant R
    function [5:0] shift_digits(input integer step, input integer two);
        integer shift;
        begin
            if (step < N) shift = step < 3 ? 3 * step : step == 3 ? 11 : step == 4 ? 13 : 16;
            else if (step < N + C) shift = step - N + 1;
            else shift = C + 1 + 2 * (step - N - C) - two;
            shift = step >= N + C + T ? 3 : 16 * (shift / 9) + 4 * (shift % 9 / 3) + shift % 3;
            shift_digits = shift[5:0];
        end
    endfunction
    function [383:0] all_shifts(input integer count);
        integer i;
        for (i = 0; i < count; i = i + 1)
            all_shifts[6*i +: 6] = shift_digits(i % 32, i / 32);
    endfunction
    localparam [383:0] SHIFTS = all_shifts(64);

    // control: the signals of a step are prepared in the clock before it
    (* fsm_encoding = "none" *) reg [4:0] next;
    (* fsm_encoding = "none" *) reg [5:0] shift;
    (* fsm_encoding = "none" *) reg [3:0] word;  // in_word of cordic_residual
    reg                 turning, tail, less, move, thaw, minus_x, minus_y;
    wire                minus, two, one;
    cordic_residual #(.W(W)) residual (.clk(clk), .in_load(in_start), .in_z(in_z), .in_turn(turning),
        .in_digit(tail), .in_word(word), .out_minus(minus), .out_two(two), .out_one(one));
    wire signed [31:0]  at = {27'd0, next};
    wire                to_tail = at >= N + C && at < N + C + T;
    assign out_done = out_busy && at == STEPS;
    always @(posedge clk) begin
        next  <= !rst && (in_start || (out_busy && !out_done)) ? next + 5'd1 : 5'd0;
        shift <= SHIFTS[6 * {26'd0, to_tail && two, next} +: 6] & {W > 16, 5'd31};  // up to 16 bits none is above 17
        word  <= to_tail ? {2'b00, two, one} : next[3:0] - N[3:0];
        turning <= at >= N && at < N + C + T;
        tail  <= to_tail;
        less  <= GAIN && at > 0 && at < 5;
        move  <= !to_tail || two || one;
        thaw  <= at + 1 >= N && at < N + C;
        out_busy <= !rst && (in_start || (out_busy && !out_done));
        if (in_start) {minus_x, minus_y} <= {in_minus_x, in_minus_y};
        else if (turning) {minus_x, minus_y} <= 2'b00;  // R is added without a complement
    end

    // vector
    reg  signed [D-1:0] xf, yf;
    wire signed [D-1:0] sum_x, sum_y;
    cordic_shift #(.D(D), .R(R)) shift_x (.in_v(yf), .in_shift(shift),
        .in_minus(turning ? !minus : minus_x ^ less), .in_a(out_x), .out_sum(sum_x));
    cordic_shift #(.D(D), .R(R)) shift_y (.in_v(xf), .in_shift(shift),
        .in_minus(turning ?  minus : minus_y ^ less), .in_a(out_y), .out_sum(sum_y));
    always @(posedge clk) begin
        if (in_start) {out_x, out_y} <= {in_x, in_y};
        else if (out_busy && move) {out_x, out_y} <= {sum_x, sum_y};
        if (in_start) {xf, yf} <= {in_fx, in_fy};
        else if (thaw) {xf, yf} <= {sum_x, sum_y};
    end
endmodule
`default_nettype wire
