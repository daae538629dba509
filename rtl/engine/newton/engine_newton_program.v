// SPDX-License-Identifier: Apache-2.0
// Program of engine_newton_3r: from the clock after in_start on a pass of 16 lines, 23 at PIPE = 1, one a clock, then
// the next pass, until rst. The first column of a line names the angle whose chord is read. The others are out_op, the
// operations of engine_newton_path; the joints obey its bits STOP and MOVE. Model: iterative.newton_fixed.solve
`default_nettype none
module engine_newton_program #(
    parameter PIPE = 0  // registers behind the products, 0 or 1 (default 0: fewest clocks)
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    output wire        out_idle,
    output wire        out_second,  // the angle: joint 2 or the sum of both, else joint 1 or phi
    output wire        out_single,  // a joint, else a sum
    output wire        out_cosine,  // its cosine, else its sine
    output wire [19:0] out_op,
    output wire        out_stop,
    output wire        out_move
);
    // Schedule, a clock a line
    localparam [2:0]            // the table of sines: second, single, cosine
        COSP   = 3'b001,        // read the cosine of phi
        SINP   = 3'b000,        // read the sine of phi
        COS1   = 3'b011,        // read the cosine of joint 1
        SIN1   = 3'b010,        // read the sine of joint 1
        COS12  = 3'b101,        // read the cosine of both joints
        SIN12  = 3'b100,        // read the sine of both joints
        SIN2   = 3'b110;        // read the sine of joint 2
    localparam [1:0]            // its length
        L3     = 2'd0,          // length of link 3
        L1     = 2'd1,          // length of link 1
        L2     = 2'd2;          // length of link 2
    localparam [5:0]            // operands of two multipliers whose products are added: one, neg, left, right
        LINK   = 6'b000000,     // a root by a length, and by itself
        SQUARE = 6'b000101,     // the square of E
        ALONG2 = 6'b001001,     // E seen along both joints
        ALONG1 = 6'b101001,     // E seen along joint 1
        CROSS1 = 6'b111010,     // E seen across it, negative
        CROSS2 = 6'b011010,     // E seen across both joints
        MOVES  = 6'b001111;     // the last four by -D and by lambda
    localparam [2:0]            // operands of the third multiplier: rate2, third
        CHORD  = 3'd0,          // a chord, to be a root in the next clock
        INVERT = 3'd1,          // both factors of 1 / (D^2 + mu)
        RATE1  = 3'd2,          // their product by 1/l1
        RATE2  = 3'd6,          // and by 1/l2
        JOINT  = 3'd3;          // a step by one of these, made a clock before
    localparam                  // bits of the rest
        TIP    = 0,             // the error, less a product
        FIRST  = 1,             // with TIP: a coordinate, less a product
        KEEP   = 2,             // a root of link 1 or 2
        SINE   = 3,             // D, kept off 0
        DET    = 4,             // D^2 + mu
        TEST   = 5,             // the square of E
        STOP   = 6,             // stop here if converged or at the limit, else joint 1
        MOVE   = 7,             // joint 2, which then has both steps
        AGAIN  = 8,             // the next pass begins
        REST   = 9;
    localparam [REST-1:0] BIT = 1, NONE = 0;
    localparam OP = 23;         // bits of a line
    //               table   length operands third   rest
    localparam [16*OP-1:0] PASS = {
        /* square    */ {COSP,  L3, LINK,   CHORD,  BIT << TEST},
        /* joint 1   */ {SINP,  L3, LINK,   CHORD,  BIT << STOP},
        /* joint 2   */ {COS1,  L3, LINK,   CHORD,  BIT << MOVE},
        /* wx        */ {SIN1,  L3, LINK,   CHORD,  BIT << FIRST | BIT << TIP},
        /* wy        */ {COS12, L1, LINK,   CHORD,  BIT << FIRST | BIT << TIP | BIT << KEEP},
        /* L1 c1     */ {SIN12, L1, LINK,   CHORD,  BIT << TIP | BIT << KEEP},
        /* L1 s1     */ {SIN2,  L2, LINK,   CHORD,  BIT << TIP | BIT << KEEP},
        /* L2 c12    */ {SINP,  L2, LINK,   CHORD,  BIT << TIP | BIT << KEEP},
        /* L2 s12; E */ {SINP,  L3, LINK,   CHORD,  BIT << TIP | BIT << SINE},
        /* D^2       */ {SINP,  L3, ALONG2, CHORD,  BIT << DET},
        /* along 12  */ {SINP,  L3, ALONG1, CHORD,  NONE},
        /* along 1   */ {SINP,  L3, CROSS1, INVERT, NONE},
        /* inverse   */ {SINP,  L3, CROSS2, RATE1,  NONE},
        /* rate 1    */ {SINP,  L3, MOVES,  RATE2,  NONE},
        /* rate 2    */ {SINP,  L3, MOVES,  JOINT,  NONE},
        /* steps     */ {SINP,  L3, SQUARE, JOINT,  BIT << AGAIN}};
    // PIPE = 1: a root is there four lines after its address, a product of two or of three two lines after its factors,
    // one that stands alone three, and both steps are shifted in a line of their own
    localparam [23*OP-1:0] PASS_1 = {
        /* square    */ {COSP,  L3, LINK,   CHORD,  BIT << TEST},
        /* joint 1   */ {SINP,  L3, LINK,   CHORD,  BIT << STOP},
        /* joint 2   */ {COS1,  L3, LINK,   CHORD,  BIT << MOVE},
        /* -         */ {SIN1,  L3, LINK,   CHORD,  NONE},
        /* cos phi   */ {COS12, L3, LINK,   CHORD,  NONE},
        /* sin phi   */ {SIN12, L3, LINK,   CHORD,  NONE},
        /* wx        */ {SIN2,  L1, LINK,   CHORD,  BIT << FIRST | BIT << TIP},
        /* wy        */ {SINP,  L1, LINK,   CHORD,  BIT << FIRST | BIT << TIP | BIT << KEEP},
        /* L1 c1     */ {SINP,  L2, LINK,   CHORD,  BIT << TIP | BIT << KEEP},
        /* L1 s1     */ {SINP,  L2, LINK,   CHORD,  BIT << TIP | BIT << KEEP},
        /* L2 c12, D */ {SINP,  L3, LINK,   CHORD,  BIT << TIP | BIT << KEEP | BIT << SINE},
        /* L2 s12; E */ {SINP,  L3, LINK,   CHORD,  BIT << TIP},
        /* D^2       */ {SINP,  L3, ALONG2, CHORD,  BIT << DET},
        /* -         */ {SINP,  L3, ALONG1, CHORD,  NONE},
        /* along 12  */ {SINP,  L3, CROSS1, INVERT, NONE},
        /* along 1   */ {SINP,  L3, CROSS2, CHORD,  NONE},
        /* inverse   */ {SINP,  L3, LINK,   RATE1,  NONE},
        /* across    */ {SINP,  L3, MOVES,  RATE2,  NONE},
        /* rate 1    */ {SINP,  L3, MOVES,  CHORD,  NONE},
        /* rate 2    */ {SINP,  L3, LINK,   JOINT,  NONE},
        /* -         */ {SINP,  L3, LINK,   JOINT,  NONE},
        /* step 1    */ {SINP,  L3, SQUARE, CHORD,  NONE},
        /* step 2    */ {SINP,  L3, LINK,   CHORD,  BIT << AGAIN}};
    localparam LINES = PIPE == 0 ? 16 : 23;
    localparam [23*OP-1:0] TABLE = PIPE == 0 ? {{7*OP{1'b0}}, PASS} : PASS_1;
    wire [OP-1:0]   op;
    wire [1:0]      length;
    wire [5:0]      operands;
    wire [2:0]      third;
    wire [REST-1:0] rest;
    assign {out_second, out_single, out_cosine, length, operands, third, rest} = op;
    assign out_op = {length, operands, third, rest};
    assign out_stop = rest[STOP];
    assign out_move = rest[MOVE];
    schedule #(.LINES(LINES), .BITS(OP), .TABLE(TABLE[OP*LINES-1:0])) control (.clk(clk), .rst(rst),
        .in_start(in_start || rest[AGAIN]), .out_idle(out_idle), .out_op(op));
endmodule
`default_nettype wire
