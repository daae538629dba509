// SPDX-License-Identifier: Apache-2.0
// arm_solve for words of more than 16 bits: kernel_vector_wide for three joints, with base height, shoulder offset a,
// lateral offset b and either side of the shoulder.
//   rho = +-sqrt(x^2 + y^2 - b^2), (c3, n3) = (x + i y)(rho - i b) / (x^2 + y^2); rho - a and z - base replace x and y
// Formats: in_* sN.0; cfg_* by arm.config; out_word s4.(N+2) and what belongs to it as in kernel_vector_wide. out_sine,
// out_by1, out_kept, out_turned as in arm_solve; with PIPE = 1 operands of a turn come one by one, as in arm_vectors.
// Error of the tip: bounds.arm.ik3. Latency and II: 19 + 5 LATERAL + 2 ABSOLUTE, with PIPE = 1 44 + 3 LATERAL +
// 6 ABSOLUTE. Status: unreachable (the nearest point in the plane of the arm is answered), singular (within the margin,
// or joint 1 or 3 has no direction), overflow (z - base was saturated).
// Source: rational trigonometry paper, eqs. 32-40, in vector form, with the offsets of real arms. Model: arm.ik3
`default_nettype none
module arm_solve_wide #(
    parameter N = 20,                // bits of a coordinate, 20 or 24 (default 20)
    parameter U = 20,                // fraction bits of a rounded word, 8 to N (default 20)
    parameter BASE = 1,              // 1 (default): with base height; 0: without
    parameter SHOULDER = 1,          // 1 (default): with shoulder offset; 0: without
    parameter LATERAL = 1,           // 1 (default): with lateral offset; 0: without
    parameter ABSOLUTE = 1,          // 1 (default): joint 2 is measured from the base; 0: from link 1
    parameter MARGINS = 0,           // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
    parameter PIPE = 0,              // 0 or 1 (default 0: fewest clocks); 1: registers behind products and tables
    parameter MULTIPLY = 18,         // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter F = N == 24 ? 29 : 25  // fraction bits of the words of the third multiplier, of one value (default 25)
) (
    input  wire                  clk,
    input  wire                  rst,
    input  wire [N-1:0]          cfg_l1,
    input  wire [N-1:0]          cfg_l2,
    input  wire signed [2*N+1:0] cfg_q,
    input  wire [F:0]            cfg_r,
    input  wire [4:0]            cfg_e,
    input  wire signed [N-1:0]   cfg_base,
    input  wire signed [N-3:0]   cfg_shoulder,
    input  wire signed [N-1:0]   cfg_lateral,
    input  wire signed [2*N-1:0] cfg_bb,
    input  wire [N-2:0]          cfg_margin,
    input  wire [N-4:0]          cfg_slack,
    input  wire                  in_valid,
    output wire                  in_ready,
    input  wire signed [N-1:0]   in_x,
    input  wire signed [N-1:0]   in_y,
    input  wire signed [N-1:0]   in_z,
    input  wire                  in_elbow,
    input  wire                  in_back,
    output reg                   out_valid,
    input  wire                  out_ready,
    output wire [2:0]            out_cos,
    output wire [2:0]            out_sin,
    output wire [N+5:0]          out_word,
    output wire                  out_flat,
    output wire                  out_negative,
    output wire                  out_none,
    output wire                  out_sine,
    output wire                  out_n2,
    output wire                  out_by1,
    output wire                  out_kept,
    output wire                  out_turned,
    output wire [3:0]            out_status
);
    // Schedule, a clock a line
    localparam [6:0]              // operands of the first multipliers
        KEEP    = 7'h00,          // hold
        K1      = 7'h01,          // the product is k1
        K2      = 7'h02,          // the product is k2
        TURN    = 7'h04,          // (k1, k2) becomes (-k2, k1)
        MOVE    = 7'h08,          // k2 moves to k1
        POWER   = 7'h10,          // a power of two and 0
        RHO     = 7'h20,          // rho - a and z are the new x and y
        TAKE    = 7'h40;          // (rho, b); nearer to the axis than b: 0 and a power of two
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
    localparam [1:0]              // what is added to the product of the next clock
        NONE    = 2'b00,          // nothing
        HALF    = 2'b01,          // the half that rounds a word
        LENGTH  = 2'b10;          // L1
    localparam [21:0]             // the rest
        OTHER   = 22'h000000,     // nothing
        BYTES   = 22'h000001,     // bytes that q can spare
        PAIRS   = 22'h000002,     // pairs of bits that q can spare
        GAP     = 22'h000004,     // sign and range of q - Q1 - Q2
        ROOT    = 22'h000008,     // read n2
        READ    = 22'h000010,     // read 1/q'
        INVERSE = 22'h000020,     // first factor of 1/q'
        COS2    = 22'h000040,     // the product is c2
        SIN2    = 22'h000080,     // the product is n2
        HALVE   = 22'h000100,     // not q is shifted but its root: out of reach, and for joint 3
        COS1    = 22'h000200,     // the product is c1
        SIN1    = 22'h000400,     // the product is n1
        FIRST   = 22'h000800,     // the next sum is the gap
        COS3    = 22'h001000,     // the product is c3
        SIN3    = 22'h002000,     // the product is n3
        NEAREST = 22'h004000,     // half a unit is added to the next sum, rho
        LAST    = 22'h008000,     // of the last line: the words are valid in the next clock
        PLAIN   = 22'h010000,     // the next sums are q, not q - b^2, and less than b^2 it wants no root
        SINE    = 22'h020000,     // operands of the sine of joint 2 turned, not of its cosine
        BY1     = 22'h040000,     // joint 2 is turned by joint 1, not by the elbow's constant
        KEPT    = 22'h080000,     // the turned cosine is kept
        TURNED  = 22'h100000,     // the turned cosine and sine go to joint 2
        N2      = 22'h200000;     // operands of the product of n2, not of c2 (PIPE = 1)
    localparam OP = 36;           // bits of a line
    //                       operands  left     right   addend  rest
    localparam [9*OP-1:0] YAW = {
        /* x^2 + y^2   */ {KEEP,     HOLD,    SAME,   NONE,   BYTES},
        /* and pairs   */ {KEEP,     HOLD,    SAME,   NONE,   PAIRS},
        /* q'          */ {POWER,    HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,     HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt; x   */ {TURN,     SHIFTED, RESULT, HALF,   OTHER},
        /* c3; y       */ {K2,       SHIFTED, SAME,   HALF,   COS3},
        /* n3          */ {MOVE | K2, HOLD,   SAME,   NONE,   SIN3 | NEAREST},
        /* rho         */ {RHO,      HOLD,    SAME,   NONE,   FIRST}};
    localparam [14*OP-1:0] BESIDE = {
        /* q - b^2     */ {KEEP,     HOLD,    SAME,   NONE,   BYTES},
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
        /* n3; rho - a */ {RHO,      HOLD,    SAME,   NONE,   SIN3 | FIRST}};
    localparam [9*OP-1:0] SOLVE = {
        /* gap         */ {KEEP,     SHIFTED, CFG_R,  HALF,   GAP},
        /* c2          */ {KEEP,     PRODUCT, RESULT, NONE,   COS2 | BYTES},
        /* c2^2        */ {KEEP,     HOLD,    CFG_L2, LENGTH, ROOT | PAIRS},
        /* k1; q'      */ {K1,       FACTOR,  SLOPE,  HALF,   INVERSE},
        /* n2          */ {KEEP,     PRODUCT, CFG_L2, NONE,   SIN2 | READ},
        /* k2          */ {K2,       FACTOR,  SLOPE,  NONE,   HALVE | KEPT},
        /* 1/q'; b     */ {TURN,     SHIFTED, RESULT, HALF,   SINE | TURNED},
        /* c1; a       */ {KEEP,     SHIFTED, SAME,   HALF,   COS1},
        /* n1          */ {KEEP,     SHIFTED, SAME,   NONE,   SIN1}};
    localparam [2*OP-1:0] TOGETHER = {
        /* cos 1 + 2   */ {KEEP,     SHIFTED, CFG_R,  NONE,   BY1 | KEPT},
        /* sin 1 + 2   */ {KEEP,     SHIFTED, CFG_R,  NONE,   BY1 | SINE | TURNED}};
    // PIPE = 1: a line computes the parts of products, the next one products, the third the sum of two. Words and k1
    // are made of settled, a line later than left and right. addend1 is loaded a line before it is added, factor three
    // lines before left. Where no product needs them, left and right load what costs nothing: SHIFTED and CFG_R.
    localparam [OP-1:0] WAIT = {KEEP, SHIFTED, CFG_R, NONE, OTHER}, STAY = {KEEP, SHIFTED, SAME, NONE, OTHER};
    localparam [7*OP-1:0] COUNT_1 = {
        /* q           */ {3{WAIT}},
        /* its bytes   */ {KEEP,     SHIFTED, CFG_R,  NONE,   BYTES},
        /* and pairs   */ {KEEP,     SHIFTED, CFG_R,  NONE,   PAIRS},
        /* q'          */ {POWER,    SHIFTED, CFG_R,  NONE,   INVERSE},
        /* slope       */ {KEEP,     SHIFTED, CFG_R,  NONE,   READ | HALVE}};
    localparam [22*OP-1:0] YAW_1 = {COUNT_1,
        /* square      */ WAIT, {TURN, SHIFTED, CFG_R, NONE, OTHER},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt      */ WAIT,
        /* 1/sqrt; x   */ {KEEP,     SHIFTED, RESULT, NONE,   OTHER},
        /* c3; y       */ STAY,
        /* c3; n3      */ {K2,       SHIFTED, CFG_R,  HALF,   OTHER},
        /* n3          */ {MOVE | K2, SHIFTED, CFG_R, HALF,   COS3},
        /* c3 x, n3 y  */ {KEEP,     SHIFTED, CFG_R,  NONE,   SIN3},
        /* rho         */ {KEEP,     SHIFTED, CFG_R,  NONE,   NEAREST}, WAIT,
        /* and z       */ {RHO,      SHIFTED, CFG_R,  NONE,   OTHER}, WAIT,
        /* gap         */ {KEEP,     SHIFTED, CFG_R,  NONE,   FIRST}, WAIT};
    localparam [25*OP-1:0] BESIDE_1 = {COUNT_1,
        /* square      */ {2{WAIT}},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt      */ {KEEP,     SHIFTED, CFG_R,  NONE,   PLAIN},
        /* 1/sqrt      */ {KEEP,     SHIFTED, RESULT, NONE,   OTHER},
        /* rho; q      */ {KEEP,     SHIFTED, CFG_R,  NONE,   BYTES},
        /* and pairs   */ {KEEP,     SHIFTED, CFG_R,  NONE,   PAIRS},
        /* rho; q'     */ {TAKE,     SHIFTED, CFG_R,  NONE,   INVERSE},
        /* slope       */ {KEEP,     SHIFTED, CFG_R,  NONE,   READ | HALVE},
        /* square      */ WAIT,
        /* b; a        */ {TURN,     SHIFTED, CFG_R,  NONE,   OTHER},
        /* w           */ {KEEP,     FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/q'        */ WAIT,
        /* 1/q'; b     */ {KEEP,     SHIFTED, RESULT, NONE,   OTHER},
        /* c3; rho - a */ {RHO,      SHIFTED, SAME,   NONE,   OTHER},
        /* c3; n3      */ {KEEP,     SHIFTED, CFG_R,  HALF,   OTHER},
        /* n3; gap     */ {KEEP,     SHIFTED, CFG_R,  HALF,   COS3 | FIRST},
        /* n3          */ {KEEP,     SHIFTED, CFG_R,  NONE,   SIN3}};
    localparam [21*OP-1:0] SOLVE_1 = {
        /* gap         */ {KEEP,     SHIFTED, CFG_R,  NONE,   GAP},
        /* c2          */ {KEEP,     SHIFTED, CFG_R,  NONE,   BYTES},
        /* c2          */ {KEEP,     PRODUCT, RESULT, HALF,   PAIRS},
        /* c2^2        */ {KEEP,     HOLD,    CFG_L2, NONE,   COS2},
        /* k1          */ WAIT,
        /* c2^2        */ {KEEP,     SHIFTED, CFG_R,  LENGTH, ROOT},
        /* k1          */ {K1,       SHIFTED, CFG_R,  NONE,   OTHER},
        /* square      */ WAIT,
        /* slope; q'   */ {KEEP,     FACTOR,  SLOPE,  NONE,   INVERSE},
        /* n2          */ {KEEP,     SHIFTED, CFG_R,  NONE,   READ | HALVE},
        /* n2          */ {KEEP,     PRODUCT, CFG_L2, HALF,   OTHER},
        /* k2; square  */ {KEEP,     SHIFTED, CFG_R,  NONE,   SIN2},
        /* k2; slope   */ {K2,       FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/q'; b     */ {TURN,     SHIFTED, CFG_R,  NONE,   N2},
        /* 1/q'; b, a  */ {KEEP,     SHIFTED, RESULT, NONE,   SINE},
        /* b, a        */ {KEEP,     SHIFTED, SAME,   NONE,   SINE | N2},
        /* b, a        */ {KEEP,     SHIFTED, SAME,   NONE,   KEPT},
        /* c1          */ STAY,
        /* c1, n1      */ {KEEP,     SHIFTED, CFG_R,  HALF,   TURNED},
        /* n1          */ {KEEP,     SHIFTED, CFG_R,  HALF,   COS1},
        /* n1; c1 c2   */ {KEEP,     SHIFTED, CFG_R,  NONE,   SIN1 | BY1}};
    localparam [6*OP-1:0] TOGETHER_1 = {
        /* n1 n2       */ {KEEP,     SHIFTED, CFG_R,  NONE,   BY1 | N2},
        /* n1 c2       */ {KEEP,     SHIFTED, CFG_R,  NONE,   BY1 | SINE},
        /* c1 n2       */ {KEEP,     SHIFTED, CFG_R,  NONE,   BY1 | SINE | N2},
        /* cos 1 + 2   */ {KEEP,     SHIFTED, CFG_R,  NONE,   BY1 | KEPT},
        /* both        */ {KEEP,     SHIFTED, CFG_R,  NONE,   BY1},
        /* sin 1 + 2   */ {KEEP,     SHIFTED, CFG_R,  NONE,   BY1 | TURNED}};
    wire [OP-1:0] op; wire [21:0] rest;
    wire [6:0]    operands; wire [2:0] right_from; wire [1:0] left_from, addend;
    assign        {operands, left_from, right_from, addend, rest} = op;
    wire          idle; wire accept = in_valid && in_ready;
    localparam LINES = PIPE == 0 ? 18 + 5 * LATERAL + 2 * ABSOLUTE : 43 + 3 * LATERAL + 6 * ABSOLUTE;
    localparam [46*OP-1:0] ANSWER =
        PIPE == 0 ? (LATERAL ? {{23{WAIT}}, BESIDE, SOLVE} : {{28{WAIT}}, YAW, SOLVE})
        : LATERAL ? {BESIDE_1, SOLVE_1} : {{3{WAIT}}, YAW_1, SOLVE_1};
    localparam [52*OP-1:0] TABLE =  // the last LINES lines
        ABSOLUTE == 0 ? {{6{WAIT}}, ANSWER} : PIPE == 0 ? {{4{WAIT}}, ANSWER, TOGETHER} : {ANSWER, TOGETHER_1};
    // LAST is added to the last line, whichever that is
    schedule #(.LINES(LINES), .BITS(OP), .TABLE(TABLE[LINES*OP-1:0] | {{(LINES*OP-22){1'b0}}, LAST})) control (
        .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
    assign        in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (|(rest & LAST) || (out_valid && !out_ready));

    // z - base, saturated
    wire signed [N:0]   height = {in_z[N-1], in_z} - (BASE ? {cfg_base[N-1], cfg_base} : {(N+1){1'b0}});
    wire                beyond_z = BASE && height[N] != height[N-1];
    wire signed [N-1:0] z = beyond_z ? {height[N], {(N-1){!height[N]}}} : height[N-1:0];

    // The addend of the first multipliers is 0 but in three sums: cfg_q turns q into the gap, cfg_bb into rho^2,
    // NEAREST rounds rho or makes it rho - a
    reg                  elbow, back, beside, near_axis, odd_root, clamped, zero, zero3, beyond, short, over_z, half;
    reg         [2*N+1:0] addend1; reg [4:0] s; reg [N-1:0] l1;
    reg  signed [F+1:0]  left, right;
    wire        [N+5:0]  result; wire [N+1:0] k2;
    wire        [2*N+4:0] total; wire [F+1:0] word; wire [2:0] coarse; wire [1:0] fine; wire over, none, axis;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [2*F+3:0] product, settled;
    /* verilator lint_on UNUSEDSIGNAL */
    wire        [N+5:0]  length = (odd_root ? settled[2*F:2*F-N-5] : settled[2*F+1:2*F-N-4]) ^ {(N+6){back}};
    arm_operands_wide #(.N(N), .LATERAL(LATERAL), .SHOULDER(SHOULDER), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) turn (
        .clk(clk), .in_start(accept), .in_x(in_x), .in_y(in_y), .in_z(z), .in_rho(|(operands & RHO)),
        .in_total(total[2*N+1:N-3]), .in_k1(|(operands & K1)), .in_k2(|(operands & K2)), .in_turn(|(operands & TURN)),
        .in_move(|(operands & MOVE)), .in_power(|(operands & POWER)), .in_clamp(clamped), .in_odd(s[0]),
        .in_take(|(operands & TAKE)), .in_near(near_axis), .in_back(back), .in_length(length),
        .in_lateral(cfg_lateral), .in_shoulder(cfg_shoulder), .in_sum(result),
        .in_product(product[2*F+2:2*F-3-N]), .in_addend(addend1), .in_margin(cfg_margin), .out_axis(axis),
        .out_k2(k2), .out_sum(total));
    kernel_vector_wide_shift #(.N(N)) shift (.in_sum(total), .in_s(s), .out_word(word), .out_over(over),
        .out_coarse(coarse), .out_fine(fine), .out_zero(none));
    generate
        if (PIPE == 0) begin : g_now
            assign product = left * right;
            assign settled = product;
        end else begin : g_registers
            reg signed [2*F+3:0] settled_1;
            product_parts #(.A(F+2), .B(F+2), .MULTIPLY(MULTIPLY)) third (.clk(clk), .in_move(1'b1), .in_a(left),
                .in_b(right), .out_p(product));
            always @(posedge clk)
                settled_1 <= product;
            assign settled = settled_1;
        end
    endgenerate

    // The third multiplier: 1.0 is 2^F in left, 2^(F+1) in right (2^(F-1) in words from SLOPE), 2^(2F-1) in a product
    // of the two. Its addend is a register that is 0 where nothing is added.
    localparam [N+5:0]  ROUND = U > N ? {(N+6){1'b0}} : {{(N+5){1'b0}}, 1'b1} << N + 1 - U;
    assign              result = settled[2*F+2:2*F-3-N] + ({2'd0, l1, 4'd0} | (half ? ROUND : {(N+6){1'b0}}));
    wire                outside = beyond || settled[2*F+3:2*F-1] != {5{settled[2*F+3]}};
    wire                root = |(rest & ROOT), first = |(rest & FIRST);
    wire signed [F+1:0] factor;
    wire        [F:0]   slope;
    kernel_vector_curve #(.N(N), .PIPE(PIPE)) curve (.clk(clk), .in_root(root), .in_inverse(|(rest & INVERSE)),
        .in_read(|(rest & READ)), .in_clamped(clamped), .in_elbow(elbow), .in_none(clamped || settled[2*F+1]),
        .in_v(~settled[2*F:F]), .in_q(word[F-1:0]), .out_left(factor), .out_slope(slope));

    assign out_cos = {|(rest & COS3), |(rest & COS2), |(rest & COS1)};
    assign out_sin = {|(rest & SIN3), |(rest & SIN2), |(rest & SIN1)};
    assign out_none = zero; assign out_word = result; assign out_flat = outside; assign out_negative = short;

    wire near, far; wire plain = |(rest & PLAIN);
    arm_edges_wide #(.N(N), .MARGINS(MARGINS)) edges (.clk(clk), .cfg_margin(cfg_margin), .cfg_slack(cfg_slack),
        .in_root(root), .in_bent(elbow && !clamped && !settled[2*F+1]), .in_axis(axis),
        .in_load(|(operands & K2)), .in_k2(k2), .in_cos2(|(rest & COS2)), .in_above(settled[2*F-2 -: N-2]),
        .in_much(beyond || settled[2*F+3:2*F] != 4'd0), .in_clamped(clamped), .out_near(near), .out_far(far));
    assign out_status = {1'b0, over_z, zero || zero3 || near, far || LATERAL && near_axis};

    assign {out_turned, out_kept} = {|(rest & TURNED), |(rest & KEPT)};
    assign {out_by1, out_sine, out_n2} = {|(rest & BY1), |(rest & SINE), |(rest & N2)};
    wire   unused = &{1'b0, cfg_base, cfg_shoulder, cfg_lateral, cfg_bb, length};
    always @(posedge clk) begin
        addend1 <= {{(N+8){1'b0}}, |(rest & NEAREST), {(N-7){1'b0}}};
        if (SHOULDER && |(rest & NEAREST))
            addend1 <= {{6{!cfg_shoulder[N-3]}}, ~cfg_shoulder, {(N-2){1'b1}}};
        if (LATERAL && (accept || beside && !plain))
            addend1 <= {{2{cfg_bb[2*N-1]}}, cfg_bb};
        if (accept)
            {elbow, back, over_z} <= {in_elbow, in_back, beyond_z};
        if (accept || plain)
            beside <= accept;
        if (beside && |(rest & BYTES))
            near_axis <= total[2*N+4];
        if (first) begin
            s       <= cfg_e;
            addend1 <= cfg_q;
        end
        if (|(operands & RHO))
            zero3 <= zero;
        if (|(rest & BYTES))
            s[4:2] <= coarse;
        if (|(rest & COS2) || accept || LATERAL && plain)
            clamped <= accept || (LATERAL && plain ? near_axis : outside);
        if (|(rest & PAIRS))
            {s[1:0], zero} <= {fine, none};
        if (|(rest & HALVE) && clamped) begin
            s        <= s >> 1;
            odd_root <= s[0];
        end
        if (|(rest & GAP))
            {beyond, short} <= {over, total[2*N+4]};

        l1   <= |(addend & LENGTH) ? cfg_l1 : {N{1'b0}};
        half <= |(addend & HALF);
        if (left_from != HOLD)
            case (left_from)
                PRODUCT: left <= product[2*F:F-1];
                FACTOR: left <= factor;
                default: left <= word;
            endcase
        if (right_from < SAME)
            case ({1'b0, right_from[1:0]})
                CFG_R: right <= {1'b0, cfg_r};
                CFG_L2: right <= {1'b0, cfg_l2, {(F+1-N){1'b0}}};
                SLOPE: right <= {1'b0, slope};
                default: right <= product[2*F-1:F-2];
            endcase
        if (|(rest & COS2) && outside)
            left <= {short, 1'b1, {F{1'b0}}};
    end
endmodule
`default_nettype wire
