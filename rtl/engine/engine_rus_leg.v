// SPDX-License-Identifier: Apache-2.0
// Control of one leg of engine_rus_ik: 19 clocks, of which eight pass before the next one may begin.
//   in_start: the row x of the pose and the first words of the leg are there in the next clock (out_x), then z, y
// Formats: engine_rus_ik, engine_rus_path. out_cosine, out_sine: out_word is that; out_root and the flags, in the clock
// of out_sine and the one before it: far (out of reach), none (no direction at all), near (to a singular leg), over.
// out_next: copies of the words that outlive the next leg's are made. Latency 18, 19; II 8.
// Model: engine_rus.leg
`default_nettype none
module engine_rus_leg (
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
    output wire               out_x,
    output wire               out_z,
    output wire               out_y,
    output wire               out_again,
    output wire               out_next,
    output wire               out_cosine,
    output wire               out_sine,
    output wire signed [17:0] out_word,
    output wire [21:0]        out_root,
    output wire               out_far,
    output wire               out_none,
    output wire               out_near,
    output wire               out_over
);
    // Schedule. start: row words <- in_row in_words
    localparam [5:0]             // operands of multipliers A and B, whose products are added
        IDLE_AB = 6'd0,          // - <- -: anything
        ROW     = 6'b000001,     // a b <- row: two elements of a row
        FIRST   = 6'b000011,     // a b turn <- row words: two elements of a row and the joint's coordinates
        TURN    = 6'b000110,     // a b turn <- x z words: into the plane of the leg
        SQUARE  = 6'b001000,     // a b <- e f: squares
        COSINE  = 6'b010000,     // a b <- e2 f2 g s beyond: e G - f S
        SINE    = 6'b100000;     // a b <- e2 f2 g s beyond: f G + e S
    localparam [3:0]             // operands of multiplier C
        IDLE_C  = 4'd0,         // c <- -: an element of a row and what was there
        ROW_C   = 4'b0001,      // c <- row words: the third element
        LINK    = 4'b0011,      // c <- words: the link's share of e
        ZERO    = 4'b0010,      // c <- -: nothing
        HEIGHT  = 4'b0100,      // c <- a b: the square of h, which is just there
        GAIN    = 4'b1000,      // c <- a b c add: the sum times 1 / 2 LA
        GAP     = 4'b1100;      // c <- c: the square of G, which is just there
    localparam [2:0]             // operands of multiplier D
        IDLE_D  = 3'd0,         // - <- -: anything
        LINK_D  = 3'b001,       // d <- words: the link's share of f
        TABLE   = 3'b010,       // d <- w slope: a root or a reciprocal
        DIVIDE  = 3'b110,       // d <- d n shift: the numerator times the reciprocal that is just there
        NEXT_D  = 3'b100;       // d <- n shift: the other numerator
    localparam [1:0]             // addend of the next clock's sum
        HALF    = 2'b00,        // add <- -: what rounds
        PLACE   = 2'b01,        // add <- row words: position less foot
        CONST   = 2'b10;        // add <- -: cfg_k
    localparam [14:0]            // registers behind the sum
        NONE    = 15'h0000,     // - <- -: nothing
        X       = 15'h0001,     // x <- a b c add: the sum is x
        Z       = 15'h0002,     // z <- a b c add: z
        Y       = 15'h0004,     // y <- a b c add: y
        E       = 15'h0008,     // e f over <- a b c d add y: e, and f less the link's share
        Q       = 15'h0010,     // q <- a b: e^2 + f^2
        G       = 15'h0020,     // g <- c: G
        DISC    = 15'h0040,     // disc beyond <- q c: e^2 + f^2 - G^2
        FIND    = 15'h0080,     // n shift <- disc q beyond: the radicand, its spare bytes
        FINE    = 15'h0100,     // shift <- n: spare pairs of bits
        ROOT    = 15'h0200,     // w slope n shift <- q n shift: read the root's table; then the divisor
        COPY    = 15'h0400,     // e2 f2 <- e f: for the next leg comes
        S       = 15'h0800,     // s <- d shift: the root
        DIVISOR = 15'h1000,     // w slope <- n shift s: read the reciprocal's table; flags
        NUM     = 15'h2000,     // n <- a b: a numerator
        OUT     = 15'h4000;     // - <- d: the sine
    //                      A, B     C        D        add    behind
    localparam [19*30-1:0] LEG = {
        /* row x       */ {FIRST,   ROW_C,   IDLE_D,  PLACE, NONE},
        /* row z       */ {ROW,     ROW_C,   IDLE_D,  PLACE, X},
        /* row y       */ {ROW,     ROW_C,   IDLE_D,  PLACE, Z},
        /* e           */ {TURN,    LINK,    LINK_D,  HALF,  Y},
        /* h           */ {TURN,    ZERO,    IDLE_D,  HALF,  E},
        /* squares     */ {SQUARE,  HEIGHT,  IDLE_D,  CONST, NONE},
        /* G           */ {IDLE_AB, GAIN,    IDLE_D,  HALF,  Q},
        /* G^2         */ {IDLE_AB, GAP,     IDLE_D,  HALF,  G},
        /* S^2         */ {IDLE_AB, IDLE_C,  IDLE_D,  HALF,  DISC},
        /* bytes       */ {IDLE_AB, IDLE_C,  IDLE_D,  HALF,  FIND},
        /* pairs       */ {IDLE_AB, IDLE_C,  IDLE_D,  HALF,  FINE},
        /* slope       */ {IDLE_AB, IDLE_C,  IDLE_D,  HALF,  ROOT | COPY},
        /* root; pairs */ {IDLE_AB, IDLE_C,  TABLE,   HALF,  FINE},
        /* S           */ {IDLE_AB, IDLE_C,  IDLE_D,  HALF,  S},
        /* slope       */ {COSINE,  IDLE_C,  IDLE_D,  HALF,  DIVISOR},
        /* reciprocal  */ {SINE,    IDLE_C,  TABLE,   HALF,  NUM},
        /* cosine      */ {IDLE_AB, IDLE_C,  DIVIDE,  HALF,  NUM},
        /* sine        */ {IDLE_AB, IDLE_C,  NEXT_D,  HALF,  NONE},
        /* and out     */ {IDLE_AB, IDLE_C,  IDLE_D,  HALF,  OUT}};
    wire [29:0] op;
    wire        idle;
    schedule #(.LINES(19), .BITS(30), .TABLE(LEG)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(idle), .out_op(op));
    engine_rus_path path (
        .clk(clk), .cfg_k(cfg_k), .cfg_c(cfg_c), .cfg_near(cfg_near), .in_op(op), .in_row(in_row), .in_words(in_words),
        .in_cb(in_cb), .in_nb(in_nb), .out_word(out_word), .out_root(out_root), .out_far(out_far),
        .out_none(out_none), .out_near(out_near), .out_over(out_over));
    // the rows of the pose by the line that is played
    assign out_x = op[24] && op[25];
    assign out_z = op[0];
    assign out_y = op[1];
    assign out_again = op[2];
    assign out_next = op[10];
    assign out_cosine = op[19] && !op[18];
    assign out_sine = op[14];
    wire   unused = &{1'b0, idle};
endmodule
`default_nettype wire
