// SPDX-License-Identifier: Apache-2.0
// Rotations in a chain, one engine: L2 exp(j j2), plus L1, times exp(j j1); its real part times exp(j j3).
// A rotation is that of cordic_turn_iter: C micro-rotations, T digits. The clocks of a rotation, numbered alike in all:
//   0: add a start word, z = the angle;  1 .. C: micro-rotation;  C+1 .. C+T: digit;  C+T+1: round (after the last)
// and between the second and the third, rho = x:
//   16: y = 0 (out_lifted: y is the height);  17: y = rho / 2, x = 0;  18: x = y;  19 .. 23: both times 1 +- 2^-n;
//   24: the signs of the quadrant
// The quarter turns of all joints are the signs of the start words. The gain of the plane is in the start words, that
// of the third rotation is taken out by the five factors: on the diagonal the crosswise shifter serves them.
// Formats: in_s1, in_s2, out_x, out_y with G = 5 guard bits. Done 2(C+T)+3 or 3(C+T)+13 clocks after in_start.
`default_nettype none
module classic_chain_iter #(
    parameter W      = 16,
    parameter A      = 16,
    parameter JOINTS = 2
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_start,
    input  wire [A-1:0] in_j1,
    input  wire [A-1:0] in_j2,
    input  wire [A-1:0] in_j3,
    input  wire [W+4:0] in_s1,
    input  wire [W+4:0] in_s2,
    output reg          out_busy,
    output wire         out_done,
    output reg          out_lifted,
    output reg  [W+6:0] out_x,
    output reg  [W+6:0] out_y
);
    localparam D = W + 7;
    localparam Z = W + 4;
    localparam C = (W + 1) / 2;
    localparam T = (W - C + 1) / 2 + 1;
    localparam YAW = 16;

    // the shift of a clock as digits in base 3, {constant, 9s, 3s, 1s}, as classic_term reads them
    function [5:0] shift_digits(input integer step, input integer two);
        integer shift;
        begin
            case (step)
                YAW + 1: shift = 1;
                YAW + 3: shift = 2;
                YAW + 4: shift = 5;
                YAW + 5: shift = 9;
                YAW + 6: shift = 10;
                YAW + 7: shift = 16;
                default: shift = step <= C ? step : step <= C + T ? C + 1 + 2 * (step - C - 1) - two : 0;
            endcase
            shift = step == C + T + 1 ? 32 : 16 * (shift / 9) + 4 * (shift % 9 / 3) + shift % 3;
            shift_digits = shift[5:0];
        end
    endfunction
    function [383:0] all_shifts(input integer count);
        integer i;
        for (i = 0; i < count; i = i + 1)
            all_shifts[6*i +: 6] = shift_digits(i % 32, i / 32);
    endfunction
    localparam [383:0] SHIFTS = all_shifts(64);

    // control: what a clock needs is made ready in the one before it
    (* fsm_encoding = "none" *) reg [4:0] next;
    (* fsm_encoding = "none" *) reg [1:0] pass;  // of the clock that next stands for
    (* fsm_encoding = "none" *) reg [5:0] shift;
    (* fsm_encoding = "none" *) reg [3:0] word;  // of the angle ROM: micro-rotation 0 .. C-1, then C + |digit|
    reg                 first, last, load, turning, tail, move, thaw, blank, fresh, minus_x, minus_y;
    reg         [A-1:0] now, then, yaw;
    reg         [Z-1:0] z;
    wire        [Z-1:0] sum_z, next_z;
    wire        [2:0]   top = next_z[Z-2 -: 3] ^ {3{next_z[Z-1]}};
    wire                two = top[2];
    wire                one = !top[2] && top[1:0] != 2'd0;
    wire signed [31:0]  at = {27'd0, next};
    wire                to_tail = at > C && at <= C + T;
    wire                run = !rst && (in_start || (out_busy && !out_done));
    wire        [1:0]   quarter = in_start ? in_j1[A-1:A-2] + in_j2[A-1:A-2] + {1'b0, in_j2[A-3]} : now[A-1:A-2];
    wire                start_word = next == 5'd0 || at == YAW + 8;
    wire                less = at == YAW + 4;
    assign out_done = out_busy && at == C + T + 2;
    always @(posedge clk) begin
        if (!run) {pass, next} <= 7'd0;
        else if (at == C + T && pass == 2'd0) {pass, next} <= {2'd1, 5'd0};
        else if (at == C + T + 1 && pass == 2'd1 && JOINTS == 3) {pass, next} <= {2'd2, YAW[4:0]};
        else if (at == YAW + 8) next <= 5'd1;
        else next <= next + 5'd1;
        shift <= SHIFTS[6 * {26'd0, to_tail && two, next} +: 6] |
                 {2'd0, {2{next == 5'd0 && pass == 2'd0}}, {2{next == 5'd0}}};
        word  <= to_tail ? C[3:0] + {2'd0, two, one} : next[3:0] - 4'd1;
        first <= pass == 2'd0;
        last  <= pass == 2'd2;
        load  <= next == 5'd0 || at == YAW;
        turning <= next != 5'd0 && at <= C + T;
        tail  <= to_tail;
        move  <= at != YAW && (!to_tail || two || one);
        thaw  <= at != YAW && at <= C + T + 1 && !to_tail || at > YAW;
        out_lifted <= JOINTS == 3 && out_busy && at == YAW;
        blank <= at == YAW + 1;
        fresh <= at == YAW + 7;
        minus_x <= start_word ? quarter[1] ^ quarter[0] : less;
        minus_y <= start_word ? quarter[1] : less;
        out_busy <= run;
        if (in_start) {now, then, yaw} <= {in_j2, in_j1, in_j3};
        else if (load) {now, then} <= {then, yaw};
    end

    // angle: scaled by 2 or 4 a clock, so that a digit always sits in the top bits
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
        if (load) z <= {{2{now[A-3] ^ !first}}, now[A-4:0], {(W+3-A){1'b0}}, 2'b10};
        else if (turning) z <= next_z;

    // vector; the constant is half an LSB and what the rotations round down: rho has no need of the half
    reg  signed [D-1:0] xf, yf;
    wire        [D-1:0] sum_x, sum_y;
    wire        [4:0]   round_x = last ? 5'd22 : JOINTS == 3 ? 5'd13 : 5'd29;
    wire        [4:0]   round_y = last ? 5'd22 : 5'd29;
    classic_term #(.D(D)) term_x (.in_v(yf), .in_s1({2'b00, in_s1}), .in_s2({2'b00, in_s2}), .in_round(round_x),
        .in_shift(shift), .in_minus(turning ? !z[Z-1] : minus_x), .in_a(out_x), .out_sum(sum_x));
    classic_term #(.D(D)) term_y (.in_v(xf), .in_s1({2'b00, in_s1}), .in_s2({2'b00, in_s2}), .in_round(round_y),
        .in_shift(shift), .in_minus(turning ?  z[Z-1] : minus_y), .in_a(out_y), .out_sum(sum_y));
    always @(posedge clk) begin
        if (in_start || blank || fresh) out_x <= {D{1'b0}};
        else if (out_busy && move) out_x <= sum_x;
        if (in_start || out_lifted || fresh) out_y <= {D{1'b0}};
        else if (out_busy && move) out_y <= sum_y;
        if (blank) xf <= {D{1'b0}};
        else if (thaw) xf <= sum_x;
        if (thaw) yf <= sum_y;
    end
endmodule
`default_nettype wire
