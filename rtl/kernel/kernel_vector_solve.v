// SPDX-License-Identifier: Apache-2.0
// Unit vectors of both joints of a tip (x, y): inverse kinematics in the plane by products, one root, one reciprocal.
//   q = x^2 + y^2, c2 = (q - Q1 - Q2) / 2 L1 L2, n2 = +-sqrt(1 - c2^2), k = L1 + L2 (c2, n2), (c1, n1) = p conj(k) / q
// Out of reach c2 = +-1, n2 = 0 and (c1, n1) = +-p / |p|: the same products, 2 / sqrt(q) for 1/q, a power of two for k.
// Formats: in_x, in_y s16.0; cfg_*: vector_solve.config; out_* s2.U, nearest (ties upward).
// Latency, II: 10. Error: page of vector_ik2. Status: unreachable (nearest point), singular (x = y = 0: out_c1, out_n1
// hold their last value; (1, 0) after reset). Model: vector_solve.ik2
`default_nettype none
module kernel_vector_solve #(
    parameter U = 16  // fraction bits of a unit vector's coordinates, 8 to 16: 16, what the products carry
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
    input  wire               in_elbow,
    output reg                out_valid,
    input  wire               out_ready,
    output wire [U+1:0]       out_c1,
    output wire [U+1:0]       out_n1,
    output wire [U+1:0]       out_c2,
    output wire [U+1:0]       out_n2,
    output wire [3:0]         out_status
);
    // Schedule. start: k1 k2 x y minus_q s elbow <- in_x in_y in_elbow
    localparam [2:0]           // operands of the two multipliers
        KEEP    = 3'b000,      // - <- -: hold
        K1      = 3'b001,      // k1 <- left right addend clamped s: the product is k1
        K2      = 3'b010,      // k2 <- left right: the product is k2
        TURN    = 3'b100;      // k1 k2 <- k1 k2: (-k2, k1)
    localparam [1:0]           // left operand of the third multiplier
        SHIFTED = 2'd0,        // left <- k1 k2 x y s: the shifted sum
        FACTOR  = 2'd1,        // left <- factor: first factor of a root or a reciprocal
        PRODUCT = 2'd2,        // left <- left right: the product
        HOLD    = 2'd3;        // - <- -: hold
    localparam [2:0]           // and the right one
        CFG_R   = 3'd0,        // right <- -: cfg_r
        CFG_L2  = 3'd1,        // right <- -: cfg_l2
        SLOPE   = 3'd2,        // right <- slope: second factor
        RESULT  = 3'd3,        // right <- left right: the product
        SAME    = 3'd4;        // - <- -: hold
    localparam [1:0]           // what is added to the product of the next clock
        NONE    = 2'b00,       // addend <- -: nothing
        HALF    = 2'b01,       // addend <- -: the half that rounds a word
        LENGTH  = 2'b10;       // addend <- -: L1
    localparam [7:0]           // the rest
        OTHER   = 8'h00,       // - <- -: nothing
        GAP     = 8'h01,       // beyond short <- k1 k2 x y minus_q s: sign and range of q - Q1 - Q2
        COS2    = 8'h02,       // clamped left c2 s <- left right addend beyond short k1 k2 x y: c2; bytes q can spare
        ROOT    = 8'h04,       // factor slope s zero <- left right elbow clamped k1 k2 x y s: read n2; pairs of bits
        INVERSE = 8'h08,       // factor <- k1 k2 x y s clamped: first factor of 1/q'
        SIN2    = 8'h10,       // n2 slope <- left right addend factor clamped: n2; read 1/q'
        HALVE   = 8'h20,       // s <- s clamped: out of reach |p| is shifted, not q
        COS1    = 8'h40,       // c1 <- left right addend zero: c1
        SIN1    = 8'h80;       // n1 <- left right addend zero: n1
    //                     operands  left     right   addend  rest
    localparam [9*18-1:0] SOLVE = {
        /* gap         */ {KEEP,     SHIFTED, CFG_R,  HALF,   GAP},
        /* c2          */ {KEEP,     PRODUCT, RESULT, NONE,   COS2},
        /* c2^2        */ {KEEP,     HOLD,    CFG_L2, LENGTH, ROOT},
        /* k1; q'      */ {K1,       FACTOR,  SLOPE,  HALF,   INVERSE},
        /* n2          */ {KEEP,     PRODUCT, CFG_L2, NONE,   SIN2},
        /* k2          */ {K2,       FACTOR,  SLOPE,  NONE,   HALVE},
        /* 1/q'; b     */ {TURN,     SHIFTED, RESULT, HALF,   OTHER},
        /* c1; a       */ {KEEP,     SHIFTED, SAME,   HALF,   COS1},
        /* n1          */ {KEEP,     SHIFTED, SAME,   NONE,   SIN1}};
    wire [17:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    schedule #(.LINES(9), .BITS(18), .TABLE(SOLVE)) control (
        .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
    kernel_vector_path #(.U(U)) path (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
        .in_start(accept), .in_op(op), .in_x(in_x), .in_y(in_y), .in_elbow(in_elbow), .out_c1(out_c1),
        .out_n1(out_n1), .out_c2(out_c2), .out_n2(out_n2), .out_status(out_status));

    assign in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (op[7] || (out_valid && !out_ready));
endmodule
`default_nettype wire
