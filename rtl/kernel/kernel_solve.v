// SPDX-License-Identifier: Apache-2.0
// Directions of the joints of a tip: two joints in the plane (x, y), or three, where joint 3 turns that plane about z:
// (c3, n3) = (x, y) / sqrt(x^2 + y^2), and rho = c3 x + n3 y and z replace x and y. Each is given about its nearer
// axis.
//   q = x^2 + y^2, c2 = (q - Q1 - Q2) / 2 L1 L2, n2 = +-sqrt(1 - c2^2), k = L1 + L2 (c2, n2), (c1, n1) = p conj(k) / q
// Out of reach c2 = +-1, n2 = 0 and (c1, n1) = +-p / |p|, by the same products: 2 / sqrt(q) for 1/q, a power of two for
// k. Formats: in_* s16.0; cfg_*: kernel_vector_solve.config; out_axis u2.0 quarter turns; out_below: clockwise of the
// axis; out_square u1.40, square of the sine. Valid for joint i + 1 in each clock of out_take[i]; the last one holds.
// Error of the tip: bounds.rational.ik2, rational_ik3, 0.37 and 0.80 LSB at L1 = L2 = 2^13 from a quarter to 0.99 of
// the reach, 6 and 6.5 at full reach. Latency and II: 12, 26. Status: unreachable (nearest point), singular
// (x = y = 0: joint 3, of two joints joint 1, is not given; nor is joint 1 of three where z = 0 too). Source: rational
// trigonometry paper, eqs. 18-23 and 32-40, in vector form. Models: rational.ik2, rational.ik3
`default_nettype none
module kernel_solve #(
    parameter JOINTS = 2  // joints, 2 or 3 (default 2): in the plane, where in_z is not used, or in space
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire signed [33:0] cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [3:0]         cfg_e,
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
    // Schedule, a clock a line
    localparam [6:0]              // operands of the two multipliers
        KEEP    = 7'b0000000,     // hold
        K1      = 7'b0000001,     // the product is k1
        K2      = 7'b0000010,     // the product is k2; with HALVE the elbow gives its sign
        TURN    = 7'b0000100,     // (k1, k2) becomes (-k2, k1)
        MOVE    = 7'b0001010,     // k2 moves to k1, the product is k2
        POWER   = 7'b0010000,     // a power of two and 0
        UP      = 7'b0100000,     // 0 and z; the sum is rho
        RHO     = 7'b1000000;     // rho
    localparam [1:0]              // left operand of the third multiplier
        SHIFTED = 2'd0,           // the shifted sum
        FACTOR  = 2'd1,           // first factor of a root or a reciprocal
        PRODUCT = 2'd2,           // the product
        HOLD    = 2'd3;           // hold
    localparam [2:0]              // and the right one
        CFG_R   = 3'd0,           // cfg_r
        CFG_L2  = 3'd1,           // cfg_l2
        SLOPE   = 3'd2,           // second factor
        RESULT  = 3'd3,           // the product
        SAME    = 3'd4;           // hold
    localparam                    // what is added to the product of the next clock
        NONE    = 1'b0,           // nothing
        LENGTH  = 1'b1;           // L1
    localparam [13:0]             // the rest
        OTHER   = 14'h0000,       // nothing
        BYTES   = 14'h0001,       // bytes that q can spare
        PAIRS   = 14'h0002,       // pairs of bits that q can spare
        GAP     = 14'h0004,       // sign and range of q - Q1 - Q2
        ROOT    = 14'h0008,       // give joint 2 by c2^2, read n2
        READ    = 14'h0010,       // read 1/q'
        INVERSE = 14'h0020,       // first factor of 1/q'
        COS2    = 14'h0040,       // the product is c2
        SIN2    = 14'h0080,       // give joint 2 by n2^2 if that is less
        HALVE   = 14'h0100,       // not q is shifted but its root: out of reach, and for joint 3
        SIDE    = 14'h0200,       // which is less; b is held if b is
        BASE    = 14'h0400,       // the sum is x^2 + y^2 - Q1 - Q2
        NEAREST = 14'h0800,       // half a unit of rho
        J3      = 14'h1000,       // give joint 3
        J1      = 14'h2000;       // give joint 1
    //                     operands  left     right   addend  rest
    localparam [1*27-1:0] PLANE = {
        /* gap         */ {KEEP,     SHIFTED, CFG_R,  NONE,   GAP}};
    localparam [15*27-1:0] SPACE = {
        /* x^2 + y^2   */ {KEEP,     HOLD,    SAME,   NONE,   BASE},
        /* its bytes   */ {KEEP,     HOLD,    SAME,   NONE,   BYTES},
        /* and pairs   */ {KEEP,     HOLD,    SAME,   NONE,   PAIRS},
        /* q'          */ {POWER,    HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,     HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt; x   */ {TURN,     SHIFTED, RESULT, NONE,   OTHER},
        /* c3; y       */ {TURN,     SHIFTED, SAME,   NONE,   SIDE},
        /* m           */ {TURN,     PRODUCT, RESULT, NONE,   OTHER},
        /* m^2         */ {TURN,     FACTOR,  SLOPE,  NONE,   J3},
        /* 1/sqrt; x   */ {TURN,     SHIFTED, RESULT, NONE,   OTHER},
        /* c3; y       */ {K2,       SHIFTED, SAME,   NONE,   OTHER},
        /* n3          */ {MOVE,     HOLD,    SAME,   NONE,   NEAREST},
        /* rho         */ {UP,       HOLD,    SAME,   NONE,   OTHER},
        /* gap         */ {RHO,      SHIFTED, CFG_R,  NONE,   GAP}};
    localparam [10*27-1:0] SOLVE = {
        /* c2          */ {KEEP,     PRODUCT, RESULT, NONE,   COS2 | BYTES},
        /* c2^2        */ {KEEP,     HOLD,    CFG_L2, LENGTH, ROOT | PAIRS},
        /* k1; q'      */ {K1,       FACTOR,  SLOPE,  NONE,   INVERSE},
        /* n2          */ {KEEP,     PRODUCT, RESULT, NONE,   READ},
        /* n2^2        */ {KEEP,     HOLD,    CFG_L2, NONE,   SIN2},
        /* k2          */ {K2,       FACTOR,  SLOPE,  NONE,   HALVE},
        /* 1/q'; b     */ {TURN,     SHIFTED, RESULT, NONE,   OTHER},
        /* c1; a       */ {KEEP,     SHIFTED, SAME,   NONE,   SIDE},
        /* m/q         */ {KEEP,     PRODUCT, RESULT, NONE,   OTHER},
        /* (m/q)^2     */ {KEEP,     HOLD,    SAME,   NONE,   J1}};
    wire [26:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    generate
        if (JOINTS == 2) begin : g_plane
            schedule #(.LINES(11), .BITS(27), .TABLE({PLANE, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_space
            schedule #(.LINES(25), .BITS(27), .TABLE({SPACE, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate
    kernel_solve_path #(.JOINTS(JOINTS)) path (
        .clk(clk), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e), .in_start(accept),
        .in_op(op), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_elbow(in_elbow), .out_take(out_take),
        .out_axis(out_axis), .out_below(out_below), .out_square(out_square), .out_status(out_status));

    assign in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (op[13] || (out_valid && !out_ready));
endmodule
`default_nettype wire
