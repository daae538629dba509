// SPDX-License-Identifier: Apache-2.0
// Directions of the joints of a tip: of two in the plane (x, y), of three where joint 3 turns that plane about z.
//   q = x^2 + y^2 (+ z^2), c2 = (q - Q1 - Q2) / 2 L1 L2, k1 = L1 + L2 c2, k2 = +-L2 n2; joint 1 has the direction of
//   (b, a) / q, a = k1 y - k2 x, b = k1 x + k2 y; with three joints rho = |(x, y)| and z stand for x and y
// Formats: in_* s16.0; cfg_*: rational.config; out_axis u2.0 quarter turns, out_below: the direction lies clockwise of
// it; out_square u1.40, the square of the sine between them; of joint i + 1 in the clock of out_take[i].
// Latency, II: 16; three joints 26. Error: page. Status: unreachable (nearest point), singular (x = y = 0: joint 3, of
// two joints joint 1, is not taken; nor joint 1 of three where z = 0 too).
// Source: rational trigonometry paper, eqs. 9, 18-23, in vector form. Models: rational.ik2, rational.ik3
`default_nettype none
module kernel_solve #(
    parameter JOINTS = 2  // 2: in the plane, in_z is not used; 3: in space. 2, the smaller one
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire [32:0]        cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [1:0]         cfg_e,
    input  wire               in_valid,
    output wire               in_ready,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire signed [15:0] in_z,
    input  wire               in_elbow,
    output reg                out_valid,
    input  wire               out_ready,
    output wire [JOINTS-1:0]  out_take,
    output wire [1:0]         out_axis,
    output wire               out_below,
    output wire [40:0]        out_square,
    output wire [3:0]         out_status
);
    // Schedule. start: x y z elbow k used q <- in_x in_y in_z in_elbow
    localparam [2:0]         // the word that the shifter passes
        IDLE    = 3'b000,    // - <- -: none is taken
        REACH   = 3'b000,    // - <- reach k: k1
        LEFT    = 3'b001,    // - <- left k: k2, or rho
        Y       = 3'b010,    // - <- y k: y
        X       = 3'b011,    // - <- x k: x
        V       = 3'b100;    // - <- y z k: the vertical coordinate, z of three joints, y of two
    localparam [7:0]         // operands of the two multipliers
        KEEP    = 8'h00,     // - <- -: hold
        YS      = 8'h01,     // ys <- -: the shifted word
        XS      = 8'h02,     // xs <- ys: what ys has
        K1      = 8'h04,     // k1 <- -: the shifted word
        K2      = 8'h08,     // k2 <- -: the shifted word
        ONE     = 8'h10,     // k1 k2 k <- -: 1, 0 and no shift
        ZERO    = 8'h20,     // k1 <- -: 0
        CLAMP   = 8'h40,     // k1 <- clamped reach: K1, but +-1 out of reach
        FLAT    = 8'h80;     // k2 <- flat: K2, but 0 where the arm is straight
    localparam [3:0]         // left operand of the third multiplier
        ANY     = 4'd0,      // - <- -: it is not used
        PRODUCT = 4'd0,      // left <- left right: the product
        GAP     = 4'd1,      // left <- q: q - Q1 - Q2
        ROOT    = 4'd2,      // left <- left right q: first factor of the root
        SUM     = 4'd3,      // left <- xs ys k1 k2: a or b
        INVERSE = 4'd4,      // left <- inverse: first factor of 1/q'
        HOLD    = 4'd8;      // - <- -: hold
    localparam [3:0]         // and the right one
        CFG_R   = 4'd0,      // right <- -: cfg_r
        CFG_L2  = 4'd1,      // right <- -: cfg_l2
        SAME    = 4'd2,      // right <- left: left
        ROOT_S  = 4'd3,      // right <- root: second factor of the root
        INV_S   = 4'd4,      // right <- inverse: second factor of 1/q'
        RESULT  = 4'd5,      // right <- left right: the product
        RANGE   = 4'd6;      // right <- q: 2^8 or 1, as the root of q asks for
    localparam [14:0]        // the rest
        NONE    = 15'h0000,  // - <- -: nothing
        USED    = 15'h0001,  // used <- used: bits of the word in the shifter that differ from their neighbours
        COUNT   = 15'h0002,  // k <- used: the redundant sign bits
        ORIGIN  = 15'h0004,  // on_axis <- used x y: x = y = 0
        QUAD    = 15'h0008,  // q <- q xs ys k1 k2: add the sum of squares
        SIGN    = 15'h0010,  // beyond obtuse at_base <- q z on_axis: sign and range of q - Q1 - Q2
        RECIP   = 15'h0020,  // inverse <- xs ys k1 k2: read 1/q'
        COS     = 15'h0040,  // clamped left <- left right beyond obtuse: the product is c2
        ARM     = 15'h0080,  // reach <- left right: k1 = L1 + L2 c2
        A       = 15'h0100,  // a_left <- xs ys k1 k2: the sum is a
        B       = 15'h0200,  // b_left x_near <- xs ys k1 k2 left inverse: the sum is b, held back if a is less
        BEND    = 15'h0400,  // - <- elbow: give k2 its sign
        FAR     = 15'h0800,  // - <- clamped: out of reach right holds m
        J2      = 15'h1000,  // root flat <- left right elbow obtuse: give joint 2, read n2
        J3      = 15'h2000,  // root <- left right q a_left b_left x_near on_axis: give joint 3, read the root of q
        J1      = 15'h4000;  // - <- left right a_left b_left x_near at_base: give joint 1
    //                      shifter operands         left     right   rest
    localparam [4*34-1:0] PLANE = {
        /* 1 y           */ {Y,     YS | K1,         ANY,     ANY,    USED},
        /* 2 x           */ {X,     YS | XS | K2,    ANY,     ANY,    USED | COUNT},
        /* 3 q; y'       */ {Y,     YS | K1,         ANY,     ANY,    QUAD | ORIGIN},
        /* 4 gap; x'     */ {X,     YS | XS | K2,    GAP,     CFG_R,  SIGN}};
    localparam [14*34-1:0] SPACE = {
        /* 1 y           */ {Y,     YS | K1,         ANY,     ANY,    USED},
        /* 2 x           */ {X,     YS | XS | K2,    ANY,     ANY,    USED},
        /* 3 x^2 + y^2   */ {IDLE,  KEEP,            ANY,     ANY,    QUAD | ORIGIN | COUNT},
        /* 4 y'          */ {Y,     YS | K1,         ANY,     ANY,    NONE},
        /* 5 x'          */ {X,     YS | XS | K2,    ANY,     ANY,    NONE},
        /* 6 q'          */ {IDLE,  ONE,             ANY,     ANY,    RECIP},
        /* 7 1/q'        */ {IDLE,  KEEP,            INVERSE, INV_S,  NONE},
        /* 8 a = y'      */ {IDLE,  XS,              SUM,     RESULT, A},
        /* 9 b = x'      */ {IDLE,  KEEP,            SUM,     HOLD,   B},
        /* 10 m/q'       */ {IDLE,  KEEP,            PRODUCT, SAME,   NONE},
        /* 11 m^2/q'; z  */ {V,     YS | K2 | ZERO,  ROOT,    RANGE,  USED | J3},
        /* 12 q          */ {IDLE,  KEEP,            PRODUCT, ROOT_S, QUAD | COUNT},
        /* 13 rho; z'    */ {V,     YS | K1,         PRODUCT, ANY,    NONE},
        /* 14 gap; rho'  */ {LEFT,  YS | XS | K2,    GAP,     CFG_R,  SIGN}};
    localparam [11*34-1:0] SOLVE = {
        /* q', c2        */ {IDLE,  KEEP,            PRODUCT, CFG_L2, RECIP | COS},
        /* L2 c2         */ {IDLE,  KEEP,            HOLD,    SAME,   ARM},
        /* c2^2; k1'     */ {REACH, K1 | CLAMP,      ROOT,    CFG_L2, J2},
        /* L2 w          */ {IDLE,  KEEP,            PRODUCT, ROOT_S, NONE},
        /* k2 = L2 n2    */ {IDLE,  KEEP,            PRODUCT, ANY,    NONE},
        /* k2'           */ {LEFT,  K2 | FLAT,       INVERSE, INV_S,  NONE},
        /* a; 1/q'       */ {V,     YS | XS,         SUM,     RESULT, A | BEND},
        /* b             */ {IDLE,  KEEP,            SUM,     HOLD,   B | BEND},
        /* m/q'          */ {IDLE,  KEEP,            PRODUCT, SAME,   NONE},
        /* m/q' or m     */ {IDLE,  KEEP,            HOLD,    SAME,   FAR},
        /* (m/q')^2      */ {IDLE,  KEEP,            ANY,     ANY,    J1}};
    wire [33:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    generate
        if (JOINTS == 2) begin : g_plane
            schedule #(.LINES(15), .BITS(34), .TABLE({PLANE, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_space
            schedule #(.LINES(25), .BITS(34), .TABLE({SPACE, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate
    kernel_solve_path #(.JOINTS(JOINTS)) path (
        .clk(clk), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e), .in_start(accept),
        .in_op(op), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_elbow(in_elbow), .out_take(out_take),
        .out_axis(out_axis), .out_below(out_below), .out_square(out_square), .out_status(out_status));

    assign in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (op[14] || (out_valid && !out_ready));
endmodule
`default_nettype wire
