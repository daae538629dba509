// SPDX-License-Identifier: Apache-2.0
// Unit vectors of the joints of a real arm for a tip (x, y, z): kernel_vector_solve with base height, shoulder offset
// a, lateral offset b and either side of the shoulder.
//   rho = +-sqrt(x^2 + y^2 - b^2), (c3, n3) = (x + i y)(rho - i b) / (x^2 + y^2); rho - a and z - base replace x and y
// Formats: in_* s16.0; cfg_* by arm.config; out_word s4.20, in clocks of out_cos[i] the cosine and of out_sin[i] the
// sine of joint i + 1, half a unit of U bits added; out_flat: c2 is 1, or -1 with out_negative; out_none: the joint has
// no direction; out_sine, out_by1, out_kept, out_turned turn joint 2 in arm_vectors.
// Error of the tip: bounds.arm.ik3. Latency and II: 19 + 5 LATERAL + 2 ABSOLUTE, with PIPE = 1 42 + LATERAL +
// 4 ABSOLUTE. Status: unreachable (the nearest point in the plane of the arm is answered), singular (within the margin,
// or joint 1 or 3 has no direction), overflow (z - base was saturated).
// Source: rational trigonometry paper, eqs. 32-40, in vector form, with the offsets of real arms. Model: arm.ik3
`default_nettype none
module arm_solve #(
    parameter U = 16,        // fraction bits of a rounded word, 8 to 16 (default 16)
    parameter BASE = 1,      // 1 (default): with base height; 0: without
    parameter SHOULDER = 1,  // 1 (default): with shoulder offset; 0: without
    parameter LATERAL = 1,   // 1 (default): with lateral offset; 0: without
    parameter ABSOLUTE = 1,  // 1 (default): joint 2 is measured from the base; 0: from link 1
    parameter MARGINS = 0,   // 0 or 1 (default 0); 1: cfg_margin and cfg_slack
    parameter PIPE = 0,      // 0 or 1 (default 0: fewest clocks); 1: registers behind the products
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
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
    input  wire [14:0]        cfg_margin,
    input  wire [12:0]        cfg_slack,
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
    output wire               out_sine,
    output wire               out_by1,
    output wire               out_kept,
    output wire               out_turned,
    output wire [3:0]         out_status
);
    // Schedule, a clock a line
    localparam [7:0]               // operands of the first two multipliers
        KEEP    = 8'h00,           // hold
        K1      = 8'h01,           // the product is k1
        K2      = 8'h02,           // the product is k2
        TURN    = 8'h04,           // (k1, k2) becomes (-k2, k1)
        MOVE    = 8'h08,           // k2 moves to k1
        POWER   = 8'h10,           // a power of two with the side of the shoulder as its sign, and 0
        RHO     = 8'h20,           // rho - a and z are the new x and y
        TAKE    = 8'h40,           // (rho, b), near the axis (0, power)
        FIRST   = 8'h80;           // the next sum is the gap
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
    localparam [2:0]               // what is added to the product of the next clock
        NONE    = 3'b000,          // nothing
        HALF    = 3'b001,          // the half that rounds a word
        LENGTH  = 3'b010,          // L1
        EDGE    = 3'b100;          // minus the slack in the line of COS2, otherwise the margin against the sign of n2
    localparam [19:0]              // the rest
        OTHER   = 20'h00000,       // nothing
        BYTES   = 20'h00001,       // bytes that q can spare
        PAIRS   = 20'h00002,       // pairs of bits that q can spare
        GAP     = 20'h00004,       // sign and range of q - Q1 - Q2
        ROOT    = 20'h00008,       // read n2
        READ    = 20'h00010,       // read 1/q' or 2/sqrt(q')
        INVERSE = 20'h00020,       // first factor of the same
        COS2    = 20'h00040,       // the product is c2
        SIN2    = 20'h00080,       // the product is n2
        HALVE   = 20'h00100,       // not q is shifted but its root: out of reach, and for rho
        COS1    = 20'h00200,       // the product is c1
        SIN1    = 20'h00400,       // the product is n1
        COS3    = 20'h00800,       // the product is c3
        SIN3    = 20'h01000,       // the product is n3; without b the next sum is less the shoulder offset
        TEST    = 20'h02000,       // nearer to the yaw axis than b
        NEAR    = 20'h04000,       // from here on no root of q but near the axis
        PLAIN   = 20'h08000,       // nothing is added to the next sums: they are q
        SINE    = 20'h10000,       // operands of the sine of joint 2 turned, not of its cosine
        BY1     = 20'h20000,       // joint 2 is turned by joint 1, not by the elbow's constant
        KEPT    = 20'h40000,       // the turned cosine is kept
        TURNED  = 20'h80000;       // the turned cosine and sine go to joint 2
    localparam OP = 36;            // bits of a line
    //                      operands   left     right   addend  rest
    localparam [9*OP-1:0] YAW = {
        /* x^2 + y^2   */ {KEEP,        HOLD,    SAME,   NONE,   BYTES},
        /* and pairs   */ {KEEP,        HOLD,    SAME,   NONE,   PAIRS},
        /* q'          */ {POWER,       HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,        HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,        FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt; x   */ {TURN,        SHIFTED, RESULT, HALF,   OTHER},
        /* c3; y       */ {K2,          SHIFTED, SAME,   HALF,   COS3},
        /* n3          */ {MOVE | K2,   HOLD,    SAME,   NONE,   SIN3},
        /* rho - a     */ {RHO | FIRST, HOLD,    SAME,   NONE,   OTHER}};
    localparam [14*OP-1:0] BESIDE = {
        /* q - b^2     */ {KEEP,        HOLD,    SAME,   NONE,   TEST | BYTES},
        /* and pairs   */ {KEEP,        HOLD,    SAME,   NONE,   PAIRS},
        /* shifted     */ {KEEP,        HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,        HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,        FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt      */ {KEEP,        SHIFTED, RESULT, NONE,   NEAR | PLAIN},
        /* rho; q      */ {KEEP,        HOLD,    SAME,   NONE,   BYTES},
        /* and pairs   */ {KEEP,        HOLD,    SAME,   NONE,   PAIRS},
        /* q'          */ {TAKE,        HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,        HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,        FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/q'; b     */ {TURN,        SHIFTED, RESULT, HALF,   OTHER},
        /* c3; a       */ {KEEP,        SHIFTED, SAME,   HALF,   COS3},
        /* n3; rho - a */ {RHO | FIRST, HOLD,    SAME,   NONE,   SIN3}};
    localparam [9*OP-1:0] SOLVE = {
        /* gap         */ {KEEP,        SHIFTED, CFG_R,  HALF,   GAP | PLAIN},
        /* c2          */ {KEEP,        PRODUCT, RESULT, EDGE,   COS2 | BYTES},
        /* c2^2        */ {KEEP,        HOLD,    CFG_L2, LENGTH, ROOT | PAIRS},
        /* k1; q'      */ {K1,          FACTOR,  SLOPE,  HALF,   INVERSE},
        /* n2          */ {KEEP,        PRODUCT, CFG_L2, EDGE,   SIN2 | READ},
        /* k2          */ {K2,          FACTOR,  SLOPE,  NONE,   HALVE | KEPT},
        /* 1/q'; b     */ {TURN,        SHIFTED, RESULT, HALF,   SINE | TURNED},
        /* c1; a       */ {KEEP,        SHIFTED, SAME,   HALF,   COS1},
        /* n1          */ {KEEP,        SHIFTED, SAME,   NONE,   SIN1}};
    localparam [2*OP-1:0] TOGETHER = {
        /* cos 1 + 2   */ {KEEP,        HOLD,    SAME,   NONE,   BY1 | KEPT},
        /* sin 1 + 2   */ {KEEP,        HOLD,    SAME,   NONE,   BY1 | SINE | TURNED}};
    // PIPE = 1: a sum of operands is there four lines after theirs, its addend is loaded one line after. A product is
    // there two lines after left and right, settled three. In arm_vectors the operands of a turn precede KEPT and
    // TURNED by two lines. Where no product needs them, left and right load what costs nothing: SHIFTED and CFG_R.
    localparam [OP-1:0] WAIT = {KEEP, SHIFTED, CFG_R, NONE, OTHER}, STAY = {KEEP, SHIFTED, SAME, NONE, OTHER};
    localparam [7*OP-1:0] COUNT_1 = {
        /* q or gap    */ {3{WAIT}},
        /* its bytes   */ {KEEP,        SHIFTED, CFG_R,  NONE,   TEST | BYTES},
        /* and pairs   */ {KEEP,        SHIFTED, CFG_R,  NONE,   PAIRS},
        /* shifted     */ {POWER,       SHIFTED, CFG_R,  NONE,   INVERSE},
        /* slope       */ {KEEP,        SHIFTED, CFG_R,  NONE,   READ | HALVE}};
    localparam [21*OP-1:0] YAW_1 = {COUNT_1,
        /* slope       */ {TURN,        SHIFTED, CFG_R,  NONE,   OTHER},
        /* w           */ {KEEP,        FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt      */ WAIT,
        /* 1/sqrt; x   */ {KEEP,        SHIFTED, RESULT, NONE,   OTHER},
        /* c3; y       */ STAY,
        /* c3; n3      */ {K2,          SHIFTED, CFG_R,  HALF,   OTHER},
        /* n3          */ {MOVE | K2,   SHIFTED, CFG_R,  HALF,   COS3},
        /* c3 x, n3 y  */ {KEEP,        SHIFTED, CFG_R,  NONE,   SIN3},
        /* rho - a     */ {2{WAIT}},
        /* and z       */ {RHO,         SHIFTED, CFG_R,  NONE,   OTHER},
        /* gap         */ {FIRST,       SHIFTED, CFG_R,  NONE,   OTHER}, {2{WAIT}}};
    localparam [22*OP-1:0] BESIDE_1 = {COUNT_1, WAIT,
        /* w; q        */ {KEEP,        FACTOR,  SLOPE,  NONE,   NEAR | PLAIN}, WAIT,
        /* 1/sqrt      */ {KEEP,        SHIFTED, RESULT, NONE,   OTHER},
        /* its bytes   */ {KEEP,        SHIFTED, CFG_R,  NONE,   BYTES},
        /* and pairs   */ {KEEP,        SHIFTED, CFG_R,  NONE,   PAIRS},
        /* rho; q'     */ {TAKE,        SHIFTED, CFG_R,  NONE,   INVERSE},
        /* slope       */ {KEEP,        SHIFTED, CFG_R,  NONE,   READ | HALVE},
        /* slope       */ {TURN,        SHIFTED, CFG_R,  NONE,   OTHER},
        /* w           */ {KEEP,        FACTOR,  SLOPE,  NONE,   OTHER}, WAIT,
        /* b; rho - a  */ {RHO,         SHIFTED, RESULT, NONE,   OTHER},
        /* c3; a       */ {FIRST,       SHIFTED, SAME,   NONE,   OTHER},
        /* c3; n3      */ {KEEP,        SHIFTED, CFG_R,  HALF,   PLAIN},
        /* n3          */ {KEEP,        SHIFTED, CFG_R,  HALF,   COS3}};
    localparam [20*OP-1:0] SOLVE_1 = {
        /* n3; gap     */ {KEEP,        SHIFTED, CFG_R,  NONE,   GAP | (LATERAL ? SIN3 : OTHER)},
        /* c2          */ {KEEP,        HOLD,    CFG_R,  NONE,   BYTES},
        /* c2          */ {KEEP,        PRODUCT, RESULT, HALF,   PAIRS},
        /* c2^2        */ {KEEP,        HOLD,    CFG_L2, EDGE,   COS2},
        /* k1          */ WAIT,
        /* c2^2        */ {KEEP,        SHIFTED, CFG_R,  LENGTH, ROOT},
        /* k1; q'      */ {K1,          FACTOR,  CFG_R,  NONE,   INVERSE},
        /* slope       */ {KEEP,        HOLD,    SLOPE,  NONE,   READ | HALVE},
        /* n2          */ WAIT,
        /* n2          */ {KEEP,        PRODUCT, CFG_L2, HALF,   OTHER},
        /* k2          */ {KEEP,        FACTOR,  SLOPE,  NONE,   SIN2},
        /* k2; 1/q'    */ {K2,          SHIFTED, CFG_R,  EDGE,   SINE},
        /* 1/q'; b     */ {TURN,        SHIFTED, RESULT, NONE,   KEPT},
        /* b           */ {KEEP,        SHIFTED, SAME,   NONE,   TURNED},
        /* b           */ {2{STAY}},
        /* c1; a       */ STAY,
        /* c1; n1      */ {KEEP,        SHIFTED, CFG_R,  HALF,   OTHER},
        /* n1          */ {KEEP,        SHIFTED, CFG_R,  HALF,   COS1},
        /* n1          */ {KEEP,        SHIFTED, CFG_R,  NONE,   SIN1}};
    localparam [4*OP-1:0] TOGETHER_1 = {
        /* cos 1 + 2   */ {KEEP,        SHIFTED, CFG_R,  NONE,   BY1},
        /* sin 1 + 2   */ {KEEP,        SHIFTED, CFG_R,  NONE,   BY1 | SINE},
        /* cos 1 + 2   */ {KEEP,        SHIFTED, CFG_R,  NONE,   BY1 | KEPT},
        /* sin 1 + 2   */ {KEEP,        SHIFTED, CFG_R,  NONE,   BY1 | TURNED}};
    wire [OP-1:0] op; wire [19:0] rest;
    wire [7:0]    operands; wire [1:0] left_from;
    wire [2:0]    right_from, addend;
    assign        {operands, left_from, right_from, addend, rest} = op;
    wire          idle; wire accept = in_valid && in_ready;
    localparam LINES = PIPE == 0 ? 18 + 5 * LATERAL + 2 * ABSOLUTE : 41 + LATERAL + 4 * ABSOLUTE;
    localparam [OP-1:0] NO_LINE = {OP{1'b0}};
    localparam [46*OP-1:0]  // the table is the last LINES of them
        NOW   = LATERAL == 0 ? (ABSOLUTE == 0 ? {{28{NO_LINE}}, YAW, SOLVE}
                         : {{26{NO_LINE}}, YAW, SOLVE, TOGETHER})
         : ABSOLUTE == 0 ? {{23{NO_LINE}}, BESIDE, SOLVE} : {{21{NO_LINE}}, BESIDE, SOLVE, TOGETHER},
        PIPED = LATERAL == 0 ? (ABSOLUTE == 0 ? {{5{NO_LINE}}, YAW_1, SOLVE_1}
                         : {{1{NO_LINE}}, YAW_1, SOLVE_1, TOGETHER_1})
         : ABSOLUTE == 0 ? {{4{NO_LINE}}, BESIDE_1, SOLVE_1} : {BESIDE_1, SOLVE_1, TOGETHER_1},
        TABLE = PIPE == 0 ? NOW : PIPED;
    schedule #(.LINES(LINES), .BITS(OP), .TABLE(TABLE[LINES*OP-1:0])) control (
        .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
    assign in_ready = idle && (!out_valid || out_ready);
    assign {out_turned, out_kept} = {|(rest & TURNED), |(rest & KEPT)};
    assign {out_by1, out_sine} = {|(rest & BY1), |(rest & SINE)};
    always @(posedge clk)
        out_valid <= !rst && ((ABSOLUTE == 0 ? |(rest & SIN1) : out_by1 && out_turned) || (out_valid && !out_ready));

    // z - base, saturated
    wire signed [16:0] height = {in_z[15], in_z} - (BASE ? {cfg_base[15], cfg_base} : 17'd0);
    wire               beyond_z = BASE && height[16] != height[15];
    wire        [15:0] z = beyond_z ? {height[16], {15{!height[16]}}} : height[15:0];

    // minus_q turns a sum into a gap: q - b^2 first, q - Q1 - Q2 after rho. Without b it subtracts the shoulder offset
    reg                elbow, back, clamped, zero, zero3, beyond, short, near_axis, over_z, odd_root;
    reg         [33:0] minus_q; reg [3:0] s;
    /* verilator lint_off UNUSEDSIGNAL */ wire signed [53:0] product, settled; /* verilator lint_on UNUSEDSIGNAL */
    wire        [21:0] result;
    wire [26:0]        word; wire [36:0] total;
    wire [1:0]         coarse, fine; wire over, none, axis;
    wire               rho = |(operands & RHO);
    wire        [21:0] length = (odd_root ? settled[50:29] : settled[51:30]) ^ {22{back}};
    arm_operands #(.LATERAL(LATERAL), .SHOULDER(SHOULDER), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) turn (
        .clk(clk), .in_start(accept), .in_x(in_x), .in_y(in_y), .in_z(z), .in_lateral(cfg_lateral),
        .in_shoulder(cfg_shoulder), .in_margin(cfg_margin), .in_rho(rho), .in_total(total[33:13]),
        .in_take(|(operands & TAKE)), .in_near(near_axis), .in_length(length), .in_k1(|(operands & K1)),
        .in_k2(|(operands & K2)), .in_turn(|(operands & TURN)), .in_move(|(operands & MOVE)),
        .in_power(|(operands & POWER)), .in_back(back), .in_clamp(clamped), .in_odd(s[0]), .in_sum(result),
        .in_product(product[52:31]), .in_addend(minus_q), .out_axis(axis), .out_sum(total));
    kernel_vector_shift shift (.in_sum(total), .in_q(total[34:3]), .in_s(s), .out_word(word), .out_over(over),
        .out_coarse(coarse), .out_fine(fine), .out_zero(none));

    // The third multiplier: 1.0 is 2^25 in left, 2^26 in right (2^24 in words from SLOPE) and 2^49 in a product of the
    // two. Its addend is a register that is 0 where nothing is added.
    reg  signed [26:0] left, right;
    reg                half; wire minus, close, far; wire [21:0] more;
    kernel_product #(.PIPE(PIPE), .MULTIPLY(MULTIPLY)) multiplier (.clk(clk), .in_left(left), .in_right(right),
        .out_product(product), .out_settled(settled));
    assign             result = settled[52:31] + (more | (half ? 22'd1 << 17 - U : 22'd0)) + {21'd0, minus};
    wire               outside = beyond || settled[53:49] != {5{settled[53]}};

    // v = 1 - c2^2 has 26 fraction bits. First factors of sqrt(v), 1/q', 2/sqrt(q') have 22 bits and a constant 1.
    wire        root = |(rest & ROOT), read = |(rest & READ), inverse = |(rest & INVERSE), cos2 = |(rest & COS2);
    wire [25:0] v = ~settled[50:25];
    wire        low = v[25:21] == 0;
    wire [20:0] e = low ? v[20:0] : v[25:5];
    wire [21:0] root_w = {e[20:11], ~e[11], e[10:0]};
    wire [21:0] inverse_w = {1'b0, word[24:16], ~word[15], clamped ? {word[15], ~word[14:5]} : ~word[14:4]};
    reg  [21:0] factor; reg negative; wire [19:0] slope;
    kernel_vector_slopes #(.PIPE(PIPE)) slopes (.clk(clk), .in_read(root || read),
        .in_range(read ? {1'b1, clamped} : {1'b0, low}), .in_segment(read ? factor[20:12] : e[20:12]),
        .out_slope(slope));

    assign out_cos = {|(rest & COS3), |(rest & COS2), |(rest & COS1)};
    assign out_sin = {|(rest & SIN3), |(rest & SIN2), |(rest & SIN1)};
    assign out_none = zero; assign out_word = {result, settled[30:29]};
    assign out_flat = outside; assign out_negative = short;
    kernel_vector_edges #(.MARGINS(MARGINS), .PIPE(PIPE)) edges (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_margin(cfg_margin), .cfg_slack(cfg_slack),
        .in_length(|(addend & LENGTH)), .in_edge(MARGINS && |(addend & EDGE)), .in_cos2(cos2), .in_root(root),
        .in_elbow(elbow), .in_load(rho), .in_flat(clamped || settled[51]), .in_axis(axis), .in_beyond(beyond),
        .in_clamped(clamped), .in_sum(result), .in_product(settled[53:50]), .out_addend(more), .out_minus(minus),
        .out_near(close), .out_far(far));
    assign out_status = {1'b0, over_z, zero || zero3 || close, far || LATERAL && near_axis};
    wire   sin3 = |(rest & SIN3), unused = &{1'b0, cfg_base, cfg_shoulder, cfg_lateral, cfg_bb, odd_root, rest};
    wire   first = |(operands & FIRST), plain = |(rest & PLAIN), near = |(rest & NEAR);
    always @(posedge clk) begin
        if (LATERAL == 0)
            minus_q <= !sin3 ? 34'd0 : SHOULDER ? {{6{~cfg_shoulder[13]}}, ~cfg_shoulder, 14'h3fff} : 34'd512;
        else if (accept)
            minus_q <= {{2{cfg_bb[31]}}, cfg_bb};
        else if (plain)
            minus_q <= 34'd0;
        if (first)
            minus_q <= cfg_q;
        if (accept) begin
            elbow  <= in_elbow;
            back   <= in_back;
            over_z <= beyond_z;
        end
        if (|(rest & TEST))
            near_axis <= total[36];
        if (rho)
            zero3 <= zero;
        if (first)
            s <= cfg_e;
        if (|(rest & BYTES))
            s[3:2] <= coarse;
        if (cos2 || accept || near)
            clamped <= accept || cos2 && outside || near && near_axis;
        if (|(rest & PAIRS)) begin
            s[1:0] <= fine;
            zero   <= none;
        end
        if (|(rest & HALVE) && clamped) begin
            s        <= s >> 1;
            odd_root <= s[0];
        end
        if (|(rest & GAP)) begin
            beyond <= over;
            short  <= total[36];
        end

        half <= |(addend & HALF);
        if (root || inverse) begin
            factor   <= inverse ? inverse_w : {22{elbow}} ^ root_w;
            negative <= root && elbow;
        end
        if (root && (clamped || settled[51])) begin  // the root of 1 - (-1)^2 would read 1
            factor   <= 22'd0;
            negative <= 1'b0;
        end
        if (left_from != HOLD)
            case (left_from)
                PRODUCT: left <= product[50:24];
                FACTOR: left <= {negative, factor, 4'd8};
                default: left <= word;
            endcase
        if (right_from < SAME)
            case ({1'b0, right_from[1:0]})
                CFG_R: right <= {1'b0, cfg_r};
                CFG_L2: right <= {1'b0, cfg_l2, 10'd0};
                SLOPE: right <= {1'b0, slope, 6'd0};
                default: right <= product[49:23];
            endcase
        if (cos2 && outside)
            left <= {short, 1'b1, 25'd0};
    end
endmodule
`default_nettype wire
