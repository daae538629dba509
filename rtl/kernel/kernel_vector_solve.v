// SPDX-License-Identifier: Apache-2.0
// Unit vectors of the joints of a tip by products, one root, one reciprocal: two in the plane (x, y), or three, joint 3
// turning that plane about z: (c3, n3) = (x, y) / sqrt(x^2 + y^2), and rho = c3 x + n3 y and z stand for x and y.
//   q = x^2 + y^2, c2 = (q - Q1 - Q2) / 2 L1 L2, n2 = +-sqrt(1 - c2^2), k = L1 + L2 (c2, n2), (c1, n1) = p conj(k) / q
// Out of reach c2 = +-1, n2 = 0 and (c1, n1) = +-p / |p|: the same products, 2 / sqrt(q) for 1/q, a power of two for k.
// Formats: in_* s16.0; cfg_*: vector_solve.config; out_word s4.20, the cosine of joint i + 1 in the clock of out_cos[i]
// and the sine in that of out_sin[i], with half a unit of U bits; out_flat: c2 is 1, or -1 with out_negative, its sign;
// out_none: joints 1 and 3 have no direction, for two clocks behind their sine too.
// Latency, II: 10, 19, and LAG. Error: page. Status: unreachable (nearest point), singular (x = y = 0: the joint of
// this direction is undefined; so is joint 1 of three if z = 0 too). Models: vector_solve.ik2, .ik3, table.ik2, .ik3
`default_nettype none
module kernel_vector_solve #(
    parameter JOINTS = 2,  // 2: in the plane, in_z is not used; 3: in space. 2, the smaller one
    parameter LAG = 0,     // clocks that a codec takes behind the last word: 0, it is a register; 2: angle_of_vector
    parameter U = 16       // fraction bits that words are rounded to, 8 to 17, or 18: they are not. 16
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
    output wire [2:0]         out_cos,
    output wire [2:0]         out_sin,
    output wire [23:0]        out_word,
    output wire               out_flat,
    output wire               out_negative,
    output wire               out_none,
    output wire [3:0]         out_status
);
    // Schedule. start: k1 k2 x y z minus_q s elbow clamped <- in_x in_y in_z in_elbow
    localparam [5:0]              // operands of the two multipliers
        KEEP    = 6'b000000,      // - <- -: hold
        K1      = 6'b000001,      // k1 <- left right addend clamped s: the product is k1
        K2      = 6'b000010,      // k2 <- left right: the product is k2
        TURN    = 6'b000100,      // k1 k2 <- k1 k2: (-k2, k1)
        MOVE    = 6'b001010,      // k1 k2 <- k2 left right: k2 moves to k1, the product is k2
        POWER   = 6'b010000,      // k1 k2 <- s: a power of two and 0
        RHO     = 6'b100000;      // k1 k2 x y s minus_q zero3 <- k1 k2 x y z zero: the sum and z are the new x and y
    localparam [1:0]              // left operand of the third multiplier
        SHIFTED = 2'd0,           // left <- k1 k2 x y s: the shifted sum
        FACTOR  = 2'd1,           // left <- factor: first factor of a root or a reciprocal
        PRODUCT = 2'd2,           // left <- left right: the product
        HOLD    = 2'd3;           // - <- -: hold
    localparam [2:0]              // and the right one
        CFG_R   = 3'd0,           // right <- -: cfg_r
        CFG_L2  = 3'd1,           // right <- -: cfg_l2
        SLOPE   = 3'd2,           // right <- slope: second factor
        RESULT  = 3'd3,           // right <- left right: the product
        SAME    = 3'd4;           // - <- -: hold
    localparam [1:0]              // what is added to the product of the next clock
        NONE    = 2'b00,          // addend <- -: nothing
        HALF    = 2'b01,          // addend <- -: the half that rounds a word
        LENGTH  = 2'b10;          // addend <- -: L1
    localparam [13:0]             // the rest
        OTHER   = 14'h0000,       // - <- -: nothing
        BYTES   = 14'h0001,       // s <- k1 k2 x y: bytes that q can spare
        PAIRS   = 14'h0002,       // s zero <- k1 k2 x y s: pairs of bits that q can spare
        GAP     = 14'h0004,       // beyond short <- k1 k2 x y minus_q s: sign and range of q - Q1 - Q2
        ROOT    = 14'h0008,       // factor slope <- left right elbow clamped: read n2
        READ    = 14'h0010,       // slope <- factor clamped: read 1/q'
        INVERSE = 14'h0020,       // factor <- k1 k2 x y s clamped: first factor of 1/q'
        COS2    = 14'h0040,       // c2 clamped left <- left right addend beyond short: c2
        SIN2    = 14'h0080,       // n2 <- left right addend: n2
        HALVE   = 14'h0100,       // s <- s clamped: not q is shifted but its root: out of reach, and for joint 3
        COS1    = 14'h0200,       // c1 <- left right addend zero: c1
        SIN1    = 14'h0400,       // n1 <- left right addend zero: n1
        COS3    = 14'h0800,       // c3 <- left right addend zero: c3
        SIN3    = 14'h1000,       // n3 minus_q <- left right addend zero: n3; half a unit of rho
        LAST    = 14'h2000;       // - <- -: the codec ends, the words stand in the next clock
    //                     operands  left     right   addend  rest
    localparam [9*27-1:0] YAW = {
        /* x^2 + y^2   */ {KEEP,     HOLD,    SAME,   NONE,   BYTES},
        /* and pairs   */ {KEEP,     HOLD,    SAME,   NONE,   PAIRS},
        /* q'          */ {POWER,    HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,     HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt; x   */ {TURN,     SHIFTED, RESULT, HALF,   OTHER},
        /* c3; y       */ {K2,       SHIFTED, SAME,   HALF,   COS3},
        /* n3          */ {MOVE,     HOLD,    SAME,   NONE,   SIN3},
        /* rho         */ {RHO,      HOLD,    SAME,   NONE,   OTHER}};
    localparam [9*27-1:0] SOLVE = {
        /* gap         */ {KEEP,     SHIFTED, CFG_R,  HALF,   GAP},
        /* c2          */ {KEEP,     PRODUCT, RESULT, NONE,   COS2 | BYTES},
        /* c2^2        */ {KEEP,     HOLD,    CFG_L2, LENGTH, ROOT | PAIRS},
        /* k1; q'      */ {K1,       FACTOR,  SLOPE,  HALF,   INVERSE},
        /* n2          */ {KEEP,     PRODUCT, CFG_L2, NONE,   SIN2 | READ},
        /* k2          */ {K2,       FACTOR,  SLOPE,  NONE,   HALVE},
        /* 1/q'; b     */ {TURN,     SHIFTED, RESULT, HALF,   OTHER},
        /* c1; a       */ {KEEP,     SHIFTED, SAME,   HALF,   COS1},
        /* n1          */ {KEEP,     SHIFTED, SAME,   NONE,   SIN1}};
    localparam [2*27-1:0] CODE = {
        /* chord       */ {KEEP,     HOLD,    SAME,   NONE,   OTHER},
        /* joint 1     */ {KEEP,     HOLD,    SAME,   NONE,   LAST}};
    wire [26:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    generate
        if (JOINTS == 2 && LAG == 0) begin : g_plane
            schedule #(.LINES(9), .BITS(27), .TABLE(SOLVE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 2 && LAG != 0) begin : g_plane_code
            schedule #(.LINES(11), .BITS(27), .TABLE({SOLVE, CODE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && LAG == 0) begin : g_space
            schedule #(.LINES(18), .BITS(27), .TABLE({YAW, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && LAG != 0) begin : g_space_code
            schedule #(.LINES(20), .BITS(27), .TABLE({YAW, SOLVE, CODE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate
    kernel_vector_path #(.JOINTS(JOINTS), .U(U)) path (
        .clk(clk), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
        .in_start(accept), .in_op({op[26:14], op[12:0]}), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_elbow(in_elbow),
        .out_cos(out_cos), .out_sin(out_sin), .out_word(out_word), .out_flat(out_flat), .out_negative(out_negative),
        .out_none(out_none), .out_status(out_status));

    assign in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && ((LAG == 0 ? op[10] : op[13]) || (out_valid && !out_ready));
endmodule
`default_nettype wire
