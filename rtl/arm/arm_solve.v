// SPDX-License-Identifier: Apache-2.0
// Unit vectors of the joints of a real arm for a tip (x, y, z): kernel_vector_solve with base height, shoulder offset
// a, lateral offset b and either side of the shoulder.
//   rho = +-sqrt(x^2 + y^2 - b^2), (c3, n3) = (x + i y)(rho - i b) / (x^2 + y^2); rho - a and z - base replace x and y
// Formats: in_* s16.0; cfg_* by arm.config; out_word s4.20, in clocks of out_cos[i] the cosine and of out_sin[i] the
// sine of joint i + 1, half a unit of U bits added; out_flat: c2 is 1, or -1 with out_negative; out_none: the joint has
// no direction; out_to_c, out_to_n, out_by1 turn joint 2 in arm_vectors.
// Error of the tip: bounds.arm.ik3. Latency and II: 19 + 5 LATERAL + 2 ABSOLUTE. Status: unreachable (the nearest
// point in the plane of the arm is answered), singular (joint 1 or 3 has no direction), overflow (z - base was
// saturated).
// Source: rational trigonometry paper, eqs. 32-40, in vector form, with the offsets of real arms. Model: arm.ik3
`default_nettype none
module arm_solve #(
    parameter U = 16,        // fraction bits of a rounded word, 8 to 16 (default 16)
    parameter BASE = 1,      // 1 (default): with base height; 0: without
    parameter SHOULDER = 1,  // 1 (default): with shoulder offset; 0: without
    parameter LATERAL = 1,   // 1 (default): with lateral offset; 0: without
    parameter ABSOLUTE = 1   // 1 (default): joint 2 is measured from the base; 0: from link 1
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire signed [33:0] cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [3:0]         cfg_e,
    input  wire signed [15:0] cfg_base,
    input  wire signed [13:0] cfg_shoulder,
    input  wire signed [15:0] cfg_lateral,
    input  wire signed [31:0] cfg_bb,
    input  wire               in_valid,
    output wire               in_ready,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire signed [15:0] in_z,
    input  wire               in_elbow,
    input  wire               in_back,
    output reg                out_valid,
    input  wire               out_ready,
    output wire [2:0]         out_cos,
    output wire [2:0]         out_sin,
    output wire [23:0]        out_word,
    output wire               out_flat,
    output wire               out_negative,
    output wire               out_none,
    output wire               out_to_c,
    output wire               out_to_n,
    output wire               out_by1,
    output wire [3:0]         out_status
);
    // Schedule, a clock a line
    localparam [6:0]               // operands of the two multipliers
        KEEP    = 7'h00,           // hold
        K1      = 7'h01,           // the product is k1
        K2      = 7'h02,           // the product is k2
        TURN    = 7'h04,           // (k1, k2) becomes (-k2, k1)
        MOVE    = 7'h0a,           // k2 moves to k1, the product is k2
        POWER   = 7'h10,           // a power of two with the side of the shoulder as its sign, and 0
        RHO     = 7'h20,           // rho - a and z are the new x and y
        TAKE    = 7'h40;           // (rho, b), near the axis (0, power)
    localparam [1:0]               // left operand of the third multiplier
        SHIFTED = 2'd0,            // the shifted sum
        FACTOR  = 2'd1,            // first factor of a root or a reciprocal
        PRODUCT = 2'd2,            // the product
        HOLD    = 2'd3;            // hold
    localparam [2:0]               // and the right one
        CFG_R   = 3'd0,            // cfg_r
        CFG_L2  = 3'd1,            // cfg_l2
        SLOPE   = 3'd2,            // second factor
        RESULT  = 3'd3,            // the product
        SAME    = 3'd4;            // hold
    localparam [1:0]               // what is added to the product of the next clock
        NONE    = 2'b00,           // nothing
        HALF    = 2'b01,           // the half that rounds a word
        LENGTH  = 2'b10;           // L1
    localparam [17:0]              // the rest
        OTHER   = 18'h00000,       // nothing
        BYTES   = 18'h00001,       // bytes that q can spare
        PAIRS   = 18'h00002,       // pairs of bits that q can spare
        GAP     = 18'h00004,       // sign and range of q - Q1 - Q2
        ROOT    = 18'h00008,       // read n2
        READ    = 18'h00010,       // read 1/q' or 2/sqrt(q')
        INVERSE = 18'h00020,       // first factor of the same
        COS2    = 18'h00040,       // the product is c2
        SIN2    = 18'h00080,       // the product is n2
        HALVE   = 18'h00100,       // not q is shifted but its root: out of reach, and for rho
        COS1    = 18'h00200,       // the product is c1
        SIN1    = 18'h00400,       // the product is n1
        COS3    = 18'h00800,       // the product is c3
        SIN3    = 18'h01000,       // the product is n3; what is added to rho
        TEST    = 18'h02000,       // nearer to the yaw axis than b
        PLAIN   = 18'h04000,       // q without b, and no root of it but near the axis
        TO_C    = 18'h08000,       // cosine of joint 2 turned by the elbow's constant
        TO_N    = 18'h10000,       // sine, and both go to joint 2
        BY_C    = 18'h28000,       // cosine of joint 2 turned by joint 1
        BY_N    = 18'h30000;       // sine, and both go to joint 2
    //                      operands  left     right   addend  rest
    localparam [9*32-1:0] YAW = {
        /* x^2 + y^2   */ {KEEP,     HOLD,    SAME,   NONE,   BYTES},
        /* and pairs   */ {KEEP,     HOLD,    SAME,   NONE,   PAIRS},
        /* q'          */ {POWER,    HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,     HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt; x   */ {TURN,     SHIFTED, RESULT, HALF,   OTHER},
        /* c3; y       */ {K2,       SHIFTED, SAME,   HALF,   COS3},
        /* n3          */ {MOVE,     HOLD,    SAME,   NONE,   SIN3},
        /* rho - a     */ {RHO,      HOLD,    SAME,   NONE,   OTHER}};
    localparam [14*32-1:0] BESIDE = {
        /* q - b^2     */ {KEEP,     HOLD,    SAME,   NONE,   TEST | BYTES},
        /* and pairs   */ {KEEP,     HOLD,    SAME,   NONE,   PAIRS},
        /* shifted     */ {KEEP,     HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,     HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt      */ {KEEP,     SHIFTED, RESULT, NONE,   PLAIN},
        /* rho; q      */ {KEEP,     HOLD,    SAME,   NONE,   BYTES},
        /* and pairs   */ {KEEP,     HOLD,    SAME,   NONE,   PAIRS},
        /* q'          */ {TAKE,     HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,     HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/q'; b     */ {TURN,     SHIFTED, RESULT, HALF,   OTHER},
        /* c3; a       */ {KEEP,     SHIFTED, SAME,   HALF,   COS3},
        /* n3; rho - a */ {RHO,      HOLD,    SAME,   NONE,   SIN3}};
    localparam [9*32-1:0] SOLVE = {
        /* gap         */ {KEEP,     SHIFTED, CFG_R,  HALF,   GAP},
        /* c2          */ {KEEP,     PRODUCT, RESULT, NONE,   COS2 | BYTES},
        /* c2^2        */ {KEEP,     HOLD,    CFG_L2, LENGTH, ROOT | PAIRS},
        /* k1; q'      */ {K1,       FACTOR,  SLOPE,  HALF,   INVERSE},
        /* n2          */ {KEEP,     PRODUCT, CFG_L2, NONE,   SIN2 | READ},
        /* k2          */ {K2,       FACTOR,  SLOPE,  NONE,   HALVE | TO_C},
        /* 1/q'; b     */ {TURN,     SHIFTED, RESULT, HALF,   TO_N},
        /* c1; a       */ {KEEP,     SHIFTED, SAME,   HALF,   COS1},
        /* n1          */ {KEEP,     SHIFTED, SAME,   NONE,   SIN1}};
    localparam [2*32-1:0] TOGETHER = {
        /* cos 1 + 2   */ {KEEP,     HOLD,    SAME,   NONE,   BY_C},
        /* sin 1 + 2   */ {KEEP,     HOLD,    SAME,   NONE,   BY_N}};
    wire [31:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    generate
        if (LATERAL == 0 && ABSOLUTE == 0) begin : g_plain
            schedule #(.LINES(18), .BITS(32), .TABLE({YAW, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (LATERAL == 0 && ABSOLUTE != 0) begin : g_absolute
            schedule #(.LINES(20), .BITS(32), .TABLE({YAW, SOLVE, TOGETHER})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (LATERAL != 0 && ABSOLUTE == 0) begin : g_beside
            schedule #(.LINES(23), .BITS(32), .TABLE({BESIDE, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (LATERAL != 0 && ABSOLUTE != 0) begin : g_both
            schedule #(.LINES(25), .BITS(32), .TABLE({BESIDE, SOLVE, TOGETHER})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate
    arm_path #(.U(U), .BASE(BASE), .SHOULDER(SHOULDER), .LATERAL(LATERAL)) path (
        .clk(clk), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e), .cfg_base(cfg_base),
        .cfg_shoulder(cfg_shoulder), .cfg_lateral(cfg_lateral), .cfg_bb(cfg_bb), .in_start(accept),
        .in_op({op[31:18], op[14:0]}), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_elbow(in_elbow), .in_back(in_back),
        .out_cos(out_cos), .out_sin(out_sin), .out_word(out_word), .out_flat(out_flat), .out_negative(out_negative),
        .out_none(out_none), .out_status(out_status));

    assign {out_by1, out_to_n, out_to_c} = op[17:15];
    assign in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && ((ABSOLUTE == 0 ? op[10] : out_by1 && out_to_n) || (out_valid && !out_ready));
endmodule
`default_nettype wire
