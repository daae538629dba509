// SPDX-License-Identifier: Apache-2.0
// Control of the legs of engine_rus_ik: a leg takes 37 clocks, and the next begins eight or more after it. In the
// clock after in_start out_x asks for row x of the pose and the first words of the leg; then out_z and out_y follow.
// out_turn: the words that turn the joint are read next; out_last: all words have been read. out_flags marks the clock
// in which out_root and the flags are valid: out_far (out of reach), out_none (no direction, or no answer wanted),
// out_near (close to singular), out_over (overflow). out_word is the cosine with out_cosine, the sine with out_sine.
// in_tag {leg 6, dead (no answer), unreached} accompanies the leg to out_tag. in_place and in_step are the operands of
// the free product out_rise.
// Formats: in_row {r1, r2, r3, p} and in_words s18 each; out_word s2.16; out_root u18.4. Error:
// bounds.engine.rus_angle.
// Latency 37, II 8; with PIPE = 1 51 and 12. Model: engine_rus.leg
`default_nettype none
module engine_rus_leg #(
    parameter PIPE = 0,      // registers behind products and sums, 0 or 1 (default 0)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire               clk,
    input  wire               rst,
    input  wire signed [26:0] cfg_k,
    input  wire [25:0]        cfg_c,
    input  wire [11:0]        cfg_near,
    input  wire               in_start,
    input  wire [71:0]        in_row,
    input  wire [71:0]        in_words,
    input  wire signed [17:0] in_cb,
    input  wire signed [17:0] in_nb,
    input  wire [2:0]         in_tag,
    input  wire [11:0]        in_place,
    input  wire [16:0]        in_step,
    output wire [28:0]        out_rise,
    output wire               out_x,
    output wire               out_z,
    output wire               out_y,
    output wire               out_turn,
    output wire               out_last,
    output wire               out_flags,
    output wire               out_cosine,
    output wire               out_sine,
    output wire signed [17:0] out_word,
    output wire [21:0]        out_root,
    output wire               out_far,
    output wire               out_none,
    output wire               out_near,
    output wire               out_over,
    output reg  [2:0]         out_tag
);
    // Schedule, a clock a line
    localparam                   // gates of multipliers A and B: what they load in the next clock
        X_ROW   = 0,             // row x
        Z_ROW   = 1,             // row z
        Y_ROW   = 2,             // row y
        WORDS   = 3,             // the first two words of the leg
        PLANE   = 4,             // x and z, to turn them
        COS     = 5,             // factors of e G - f S
        SIN     = 6,             // factors of f G + e S
        GATES   = 7;
    localparam [GATES-1:0]
        GATE    = 1,
        SHUT    = 0,             // nothing of a leg
        ROW_X   = GATE << WORDS | GATE << X_ROW,  // with the joint's coordinates
        ROW_Z   = GATE << Z_ROW,
        ROW_Y   = GATE << Y_ROW,
        TURN    = GATE << PLANE | GATE << WORDS,  // into the plane of the leg
        COSINE  = GATE << COS,
        SINE    = GATE << SIN;
    localparam [2:0]             // multiplier C: gain, height, link
        IDLE_C = 3'd0,           // what the rows leave
        LINK   = 3'b001,         // the link's shares of e (C) and f (D), in the next clock
        HEIGHT = 3'b010,         // the square of h, which is just there
        GAIN   = 3'b100;         // the sum times 1 / 2 LA, in the next clock
    localparam [2:0]             // multiplier D: next_d, divide, table_d
        IDLE_D = 3'd0,           // anything
        TABLE  = 3'b001,         // a root or a reciprocal
        DIVIDE = 3'b110,         // the cosine's numerator times the reciprocal
        NEXT_D = 3'b100;         // the sine's
    localparam [1:0]             // addend of the next clock's sum: with_k, place
        HALF   = 2'b00,          // what rounds
        PLACE  = 2'b01,          // position less foot
        CONST  = 2'b10;          // cfg_k
    localparam                   // registers behind products and sum
        X       = 0,             // the sum is x
        Z       = 1,             // z
        Y       = 2,             // y
        E       = 3,             // e, and f less the link's share
        Q       = 4,             // e^2 + f^2, and with h^2 and k
        G       = 5,             // G, and its square begins
        KEEP    = 6,             // for the next leg comes
        DISC    = 7,             // e^2 + f^2 - G^2
        OPEN    = 8,             // the radicand
        FIND    = 9,             // its spare bytes
        FINE    = 10,            // its spare pairs of bits
        ROOT    = 11,            // read the root's table
        COPY    = 12,            // the next leg comes; divisor
        S       = 13,            // the root
        DIVISOR = 14,            // read the reciprocal's table
        NUM     = 15,            // a numerator
        RATE    = 16,            // the reciprocal; flags
        OUT_C   = 17,            // the cosine
        OUT_N   = 18,            // the sine; the next product is its codec's
        BEHIND  = 19;
    localparam [BEHIND-1:0] BIT = 1, NONE = 0;
    localparam OP = 34;          // bits of a line
    //                      A, B     C        D        add    behind
    localparam [37*OP-1:0] LEG = {
        /* row x            */ {ROW_X,  IDLE_C, IDLE_D, HALF,  NONE},
        /* row z            */ {ROW_Z,  IDLE_C, IDLE_D, HALF,  NONE},
        /* row y            */ {ROW_Y,  IDLE_C, IDLE_D, PLACE, NONE},
        /* x                */ {SHUT,   IDLE_C, IDLE_D, PLACE, BIT << X},
        /* z; to e          */ {TURN,   LINK,   IDLE_D, PLACE, BIT << Z},
        /* y; to h          */ {TURN,   IDLE_C, IDLE_D, HALF,  BIT << Y},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* e, f             */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << E},
        /* squares, of h    */ {SHUT,   HEIGHT, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, CONST, NONE},
        /* their sum        */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << Q},
        /* to G             */ {SHUT,   GAIN,   IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* G                */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << G},
        /* keep e, f        */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << KEEP},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* S^2              */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << DISC},
        /* radicand         */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << OPEN},
        /* bytes            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << FIND},
        /* pairs            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << FINE},
        /* slope            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << ROOT},
        /* root; divisor    */ {SHUT,   IDLE_C, TABLE,  HALF,  BIT << COPY},
        /* bytes            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << FIND},
        /* S; pairs         */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << S | BIT << FINE},
        /* slope            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << DIVISOR},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* reciprocal; cos  */ {COSINE, IDLE_C, TABLE,  HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* its word, flags  */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << RATE},
        /* sin              */ {SINE,   IDLE_C, IDLE_D, HALF,  BIT << NUM},
        /* cosine           */ {SHUT,   IDLE_C, DIVIDE, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* and out          */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << NUM | BIT << OUT_C},
        /* sine             */ {SHUT,   IDLE_C, NEXT_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* and out          */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << OUT_N}};
    // The same with PIPE = 1: a product comes two clocks later
    localparam [51*OP-1:0] LEG_1 = {
        /* row x            */ {ROW_X,  IDLE_C, IDLE_D, HALF,  NONE},
        /* row z            */ {ROW_Z,  IDLE_C, IDLE_D, HALF,  NONE},
        /* row y            */ {ROW_Y,  IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, PLACE, NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, PLACE, NONE},
        /* x                */ {SHUT,   IDLE_C, IDLE_D, PLACE, BIT << X},
        /* z; to e          */ {TURN,   LINK,   IDLE_D, HALF,  BIT << Z},
        /* y; to h          */ {TURN,   IDLE_C, IDLE_D, HALF,  BIT << Y},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* e, f             */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << E},
        /* squares, of h    */ {SHUT,   HEIGHT, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, CONST, NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* their sum        */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << Q},
        /* to G             */ {SHUT,   GAIN,   IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* G                */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << G},
        /* keep e, f        */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << KEEP},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* S^2              */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << DISC},
        /* radicand         */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << OPEN},
        /* bytes            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << FIND},
        /* pairs            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << FINE},
        /* slope            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << ROOT},
        /* root             */ {SHUT,   IDLE_C, TABLE,  HALF,  NONE},
        /* divisor          */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << COPY},
        /* bytes            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << FIND},
        /* pairs            */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << FINE},
        /* S; slope         */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << S | BIT << DIVISOR},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* cos              */ {COSINE, IDLE_C, IDLE_D, HALF,  NONE},
        /* sin; reciprocal  */ {SINE,   IDLE_C, TABLE,  HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* cos; word, flags */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << NUM | BIT << RATE},
        /* cosine; sin      */ {SHUT,   IDLE_C, DIVIDE, HALF,  BIT << NUM},
        /* sine             */ {SHUT,   IDLE_C, NEXT_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* -                */ {SHUT,   IDLE_C, IDLE_D, HALF,  NONE},
        /* and out          */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << OUT_C},
        /* and out          */ {SHUT,   IDLE_C, IDLE_D, HALF,  BIT << OUT_N}};
    wire [OP-1:0]     op;
    wire [GATES-1:0]  gates;
    wire [2:0]        c_op;
    wire              next_d, divide, table_d;
    wire [1:0]        addend;
    wire [BEHIND-1:0] behind;
    assign            {gates, c_op, next_d, divide, table_d, addend, behind} = op;
    wire              idle;
    generate
        if (PIPE == 0) begin : g_table
            schedule #(.LINES(37), .BITS(OP), .TABLE(LEG)) control (
                .clk(clk), .rst(rst), .in_start(in_start), .out_idle(idle), .out_op(op));
        end else begin : g_table
            schedule #(.LINES(51), .BITS(OP), .TABLE(LEG_1)) control (
                .clk(clk), .rst(rst), .in_start(in_start), .out_idle(idle), .out_op(op));
        end
    endgenerate
    reg  [2:0]  tag2, tag3, tag4;
    engine_rus_path #(.PIPE(PIPE), .MULTIPLY(MULTIPLY)) path (
        .clk(clk), .cfg_k(cfg_k), .cfg_c(cfg_c), .cfg_near(cfg_near),
        .in_op({gates, c_op, next_d, divide, table_d, addend, behind}), .in_row(in_row), .in_words(in_words),
        .in_cb(in_cb), .in_nb(in_nb), .in_dead(tag4[1]), .in_place(in_place), .in_step(in_step), .out_rise(out_rise),
        .out_word(out_word), .out_root(out_root), .out_far(out_far), .out_none(out_none), .out_near(out_near),
        .out_over(out_over));
    // The line that is played selects the words of the leg that are read
    assign out_x = gates[X_ROW];
    assign out_z = gates[Z_ROW];
    assign out_y = gates[Y_ROW];
    assign out_turn = behind[X];
    assign out_last = behind[Z];
    assign out_flags = divide;
    assign out_cosine = behind[OUT_C];
    assign out_sine = behind[OUT_N];
    // The tag accompanies its leg through four registers, followed by that of the next leg
    always @(posedge clk) begin
        if (behind[Q])
            tag2 <= in_tag;
        if (behind[DISC])
            tag3 <= tag2;
        if (behind[COPY])
            tag4 <= tag3;
        if (behind[RATE])
            out_tag <= tag4;
    end
    wire   unused = &{1'b0, idle};
endmodule
`default_nettype wire
