// SPDX-License-Identifier: Apache-2.0
// This engine chains rotations on one CORDIC: L2 exp(j j2), plus L1, times exp(j j1); with three joints the real part
// times exp(j j3). It has no handshake.
// A rotation is that of cordic_turn_iter: C micro-rotations i = 1 .. C, then T digits of the residual angle. Quarter
// turns are signs of the start words, which also contain the gain of the plane. Five factors, six above W = 16, remove
// that of the third rotation; rho lies on the diagonal then, so the crosswise shifter serves them.
// Formats: in_s1, in_s2, out_x and out_y have 5 guard bits. With out_lifted out_y is the height.
// Error of a coordinate at W = A = 16, rounded: 2 LSB with two joints, 2.9 with three, up to L1 + L2 = 2^(W-2).
// The result is valid from the clock after out_done on, 2 (C+T) + 3 or 3 (C+T) + 13 clocks after in_start, one
// more with six factors.
// Model: classic.fk2, classic.fk3
`default_nettype none
module classic_chain_iter #(
    parameter W      = 16,  // bits of a coordinate, 8 to 24 (default 16)
    parameter A      = 16,  // bits of an angle, a turn is 2^A, 5 to W + 3, at most 24 (default 16)
    parameter JOINTS = 2    // 2 (default): in the plane, in_j3 is not used; 3: in space
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_start,
    input  wire        [A-1:0] in_j1,
    input  wire        [A-1:0] in_j2,
    input  wire        [A-1:0] in_j3,
    input  wire        [W+4:0] in_s1,
    input  wire        [W+4:0] in_s2,
    output wire                out_busy,
    output wire                out_done,
    output wire                out_lifted,
    output reg  signed [W+6:0] out_x,
    output reg  signed [W+6:0] out_y
);
    localparam D = W + 7;
    localparam C = (W + 1) / 2;
    localparam T = (W - C + 1) / 2 + 1;
    localparam FACTORS = W > 16 ? 6 : 5;
    localparam [5:0] HALF_LSB = 16;
    localparam [31:0] IN_XY = W > 16 ? 13 + 3 * (W - 16) / 4 : 13;  // mean of what the shifts round down in the plane
    localparam [31:0] YAW = W > 15 ? 6 + (W - 15) / 3 : 6;          // and in the third rotation

    // Schedule, a clock a line
    localparam [7:0]            // what is done
        SUM    = 8'b00000000,   // plus the shifted word, crosswise
        START  = 8'b00001001,   // a start word; the joint's angle
        MICRO  = 8'b00000010,   // micro-rotation
        DIGIT  = 8'b00000110,   // digit of the residual angle, none where it is 0
        SIGNS  = 8'b00001000,   // SUM with the signs of the joint's quadrant
        LESS   = 8'b00010000,   // SUM with the one's complement
        HALVE  = 8'b00100000,   // x = xf = 0, y = yf = rho / 2
        FRESH  = 8'b01000000,   // SUM to xf and yf; x = y = 0
        LAST   = 8'b01010000,   // FRESH with the one's complement
        LIFT   = 8'b10000001;   // y leaves as the height, y = 0; the joint's angle
    localparam [6:0]            // what is added: the other word, shifted in the code of cordic_term, or one of four
        STEP   = 7'b0000000,    // shifted by the step of the loop
        BY_0   = 7'b0000000,    // shifted by 0
        BY_1   = 7'b0000001,    // by 1
        BY_2   = 7'b0000010,    // by 2
        BY_5   = 7'b0000110,    // by 5
        BY_9   = 7'b0010000,    // by 9
        BY_10  = 7'b0010001,    // by 10
        BY_16  = 7'b0011001,    // by 16
        BY_23  = 7'b0100110,    // by 23
        LINK_1 = 7'b0000011,    // in_s1
        LINK_2 = 7'b0001111,    // in_s2
        HALF   = 7'b1000011,    // half an LSB, and the mean of what the shifts round down
        HALF_3 = 7'b1010011;    // the same of the third rotation
    localparam BITS = 15;
    localparam IN_PLANE = 2 * (C + T) + 3, IN_SPACE = C + T + 5 + FACTORS;
    //                             done   word
    localparam [BITS*IN_PLANE-1:0] PLANE = {
        /* L2 to its quadrant */ {START, LINK_2},
        /* turn by j2         */ {C{MICRO, STEP}},
        /* its digits         */ {T{DIGIT, STEP}},
        /* plus L1            */ {START, LINK_1},
        /* turn by j1         */ {C{MICRO, STEP}},
        /* its digits         */ {T{DIGIT, STEP}},
        /* round              */ {SUM,   HALF}};
    localparam [2*BITS-1:0] SIXTEEN = FACTORS == 6 ? {
        /* times 1 + 2^-16    */ {SUM,   BY_16},
        /* times 1 - 2^-23    */ {LAST,  BY_23}} : {
        /* not a line         */ {SUM,   BY_0},
        /* times 1 + 2^-16    */ {FRESH, BY_16}};
    localparam [BITS*IN_SPACE-1:0] SPACE = {
        /* height             */ {LIFT,  BY_0},
        /* y = rho / 2        */ {HALVE, BY_1},
        /* x = y              */ {SUM,   BY_0},
        /* times 5/4          */ {SUM,   BY_2},
        /* times 31/32        */ {LESS,  BY_5},
        /* times 1 + 2^-9     */ {SUM,   BY_9},
        /* times 1 + 2^-10    */ {SUM,   BY_10},
        /* the last factors   */ SIXTEEN[BITS*(FACTORS-4)-1:0],
        /* to its quadrant    */ {SIGNS, BY_0},
        /* turn by j3         */ {C{MICRO, STEP}},
        /* its digits         */ {T{DIGIT, STEP}},
        /* round              */ {SUM,   HALF_3}};

    wire            idle;
    wire [BITS-1:0] op, ahead;
    generate
        if (JOINTS == 3) begin : g_space
            schedule_counter #(.LINES(IN_PLANE + IN_SPACE), .BITS(BITS), .TABLE({PLANE, SPACE})) control (.clk(clk),
                .rst(rst), .in_start(in_start), .out_idle(idle), .out_last(out_done), .out_ahead(ahead), .out_op(op));
        end else begin : g_plane
            schedule_counter #(.LINES(IN_PLANE), .BITS(BITS), .TABLE(PLANE)) control (.clk(clk),
                .rst(rst), .in_start(in_start), .out_idle(idle), .out_last(out_done), .out_ahead(ahead), .out_op(op));
        end
    endgenerate
    wire       lift, fresh, halve, less, signs, digit, turning, load;
    wire       ahead_lift, ahead_fresh, ahead_halve, ahead_less, ahead_signs, ahead_digit, ahead_turns, ahead_load;
    wire [6:0] adds, ahead_adds;
    localparam [BITS-1:0] USED = W > 16 ? ~15'd0 : ~15'd32;  // up to 16 bits no shift is above 17
    assign {lift, fresh, halve, less, signs, digit, turning, load, adds} = op & USED;
    assign {ahead_lift, ahead_fresh, ahead_halve, ahead_less, ahead_signs, ahead_digit, ahead_turns, ahead_load,
        ahead_adds} = ahead & USED;
    wire first = adds == LINK_2;
    wire unused = &{1'b0, less, signs, ahead_fresh, ahead_halve, ahead_load};
    assign out_busy = !idle;
    assign out_lifted = lift;

    // angle
    reg  [A-1:0] now, then, yaw;
    reg  [3:0]   word;
    wire         minus, two, one;
    cordic_residual #(.W(W)) residual (.clk(clk), .in_load(load),
        .in_z({{2{now[A-3] ^ !first}}, now[A-4:0], {(W+3-A){1'b0}}, 2'b10}),
        .in_turn(turning), .in_digit(digit), .in_word(word), .out_minus(minus), .out_two(two), .out_one(one));
    always @(posedge clk)
        if (in_start) {now, then, yaw} <= {in_j2, in_j1, in_j3};
        else if (load) {now, then} <= {then, yaw};

    // prepared one clock ahead: shift, word and sign of the next line, from the step of its loop and the digit of z
    reg  [4:0] step;
    reg  [5:0] shift;
    reg        move, minus_x, minus_y;
    reg signed [D-1:0] plain_x, plain_y;
    wire       plain = ahead_adds[1:0] == 2'd3, third = ahead_adds[4];
    wire [W+4:0] link = ahead_adds[2] ? in_s2 : in_s1;
    // rho is not rounded yet, so x needs no half LSB in the plane
    wire [5:0] round_x = third ? YAW[5:0] + HALF_LSB : JOINTS == 3 ? IN_XY[5:0] : IN_XY[5:0] + HALF_LSB;
    wire [5:0] round_y = third ? YAW[5:0] + HALF_LSB : IN_XY[5:0] + HALF_LSB;
    wire [5:0] by_step;
    wire [1:0] quarter = in_start ? in_j1[A-1:A-2] + in_j2[A-1:A-2] + {1'b0, in_j2[A-3]} : now[A-1:A-2];
    cordic_step #(.W(W)) steps (.in_turn(ahead_turns), .in_step(step), .in_two(ahead_digit && two),
        .out_shift(by_step));
    always @(posedge clk) begin
        step    <= ahead_turns ? step + 5'd1 : 5'd0;
        shift   <= plain ? 6'd3 : ahead_adds[5:0] | by_step;
        plain_x <= ahead_adds[6] ? {{(D-6){1'b0}}, round_x} : {2'b00, link};
        plain_y <= ahead_adds[6] ? {{(D-6){1'b0}}, round_y} : {2'b00, link};
        word    <= ahead_digit ? {2'b00, two, one} : step[3:0];
        move    <= !ahead_lift && (!ahead_digit || two || one);
        minus_x <= ahead_signs ? quarter[1] ^ quarter[0] : ahead_less;
        minus_y <= ahead_signs ? quarter[1] : ahead_less;
    end

    // vector
    reg  signed [D-1:0] xf, yf;
    wire signed [D-1:0] sum_x, sum_y;
    cordic_term #(.D(D)) term_x (.in_v(yf), .in_word(plain_x), .in_shift(shift),
        .in_minus(turning ? !minus : minus_x), .in_a(out_x), .out_sum(sum_x));
    cordic_term #(.D(D)) term_y (.in_v(xf), .in_word(plain_y), .in_shift(shift),
        .in_minus(turning ?  minus : minus_y), .in_a(out_y), .out_sum(sum_y));
    always @(posedge clk) begin
        if (in_start || halve || fresh) out_x <= {D{1'b0}};
        else if (out_busy && move) out_x <= sum_x;
        if (in_start || lift || fresh) out_y <= {D{1'b0}};
        else if (out_busy && move) out_y <= sum_y;
        if (halve) xf <= {D{1'b0}};
        else if (!digit && !lift) xf <= sum_x;
        if (!digit && !lift) yf <= sum_y;
    end
endmodule
`default_nettype wire
