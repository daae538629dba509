// SPDX-License-Identifier: Apache-2.0
// Directions of the joints of a tip: two joints in the plane (x, y), or three, where joint 3 turns that plane about z:
// (c3, n3) = (x, y) / sqrt(x^2 + y^2), and rho = c3 x + n3 y and z replace x and y. Each is given about its nearer
// axis.
//   q = x^2 + y^2, c2 = (q - Q1 - Q2) / 2 L1 L2, n2 = +-sqrt(1 - c2^2), k = L1 + L2 (c2, n2), (c1, n1) = p conj(k) / q
// Out of reach c2 = +-1, n2 = 0 and (c1, n1) = +-p / |p|, by the same products: 2 / sqrt(q) for 1/q, a power of two for
// k. Formats: in_* s16.0; cfg_*: kernel_vector_solve.config; out_axis u2.0 quarter turns; out_below: clockwise of the
// axis; out_square u1.40, square of the sine. Valid for joint i + 1 in each clock of out_take[i]; the last one holds.
// Error of the tip: bounds.rational.ik2, _ik3. Latency and II: 12 + 12 PIPE; three joints 26 + 19 PIPE. Status:
// unreachable (nearest point), singular (within the margin; x = y = 0: joint 3, of two joints joint 1, is not given;
// nor is joint 1 of three where z = 0 too). Source: rational trigonometry paper, eqs. 18-23 and 32-40. Models:
// rational.ik2, rational.ik3
`default_nettype none
module kernel_solve #(
    parameter JOINTS = 2,    // joints, 2 or 3 (default 2): in the plane, where in_z is not used, or in space
    parameter MARGINS = 0,   // 0 or 1 (default 0); 1: cfg_margin and cfg_slack
    parameter PIPE = 0,      // 0 or 1 (default 0: fewest clocks); 1: registers behind the products and the table
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire signed [33:0] cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [3:0]         cfg_e,
    input  wire [14:0]        cfg_margin,
    input  wire [12:0]        cfg_slack,
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
        KEEP    = 7'h00,          // hold
        K1      = 7'h01,          // the product is k1
        K2      = 7'h02,          // the product is k2; with HALVE the elbow gives its sign
        TURN    = 7'h04,          // (k1, k2) becomes (-k2, k1)
        MOVE    = 7'h08,          // k2 moves to k1
        POWER   = 7'h10,          // a power of two and 0
        UP      = 7'h20,          // 0 and z; the sum is rho
        RHO     = 7'h40;          // rho
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
        LENGTH  = 2'b01,          // L1
        EDGE    = 2'b10;          // minus the slack in the line of COS2, minus the margin in the other
    localparam [14:0]             // the rest
        OTHER   = 15'h0000,       // nothing
        BYTES   = 15'h0001,       // bytes that q can spare
        PAIRS   = 15'h0002,       // pairs of bits that q can spare
        GAP     = 15'h0004,       // sign and range of q - Q1 - Q2
        ROOT    = 15'h0008,       // give joint 2 by c2^2, read n2
        READ    = 15'h0010,       // read 1/q'
        INVERSE = 15'h0020,       // first factor of 1/q'
        COS2    = 15'h0040,       // the product is c2
        SIN2    = 15'h0080,       // give joint 2 by n2^2 if that is less
        HALVE   = 15'h0100,       // not q is shifted but its root: out of reach, and for joint 3
        SIDE    = 15'h0200,       // the product is b / q: which is less, a or b? What is loaded is m: b is held if b is
        BASE    = 15'h0400,       // the sum is x^2 + y^2 - Q1 - Q2
        NEAREST = 15'h0800,       // half a unit of rho
        J3      = 15'h1000,       // give joint 3
        J1      = 15'h2000,       // give joint 1
        FIRST   = 15'h4000;       // PIPE = 1: the sum of these operands starts with - Q1 - Q2
    localparam OP = 29;           // bits of a line
    //                       operands    left     right   addend  rest
    localparam [1*OP-1:0] PLANE = {
        /* gap         */ {KEEP,       SHIFTED, CFG_R,  NONE,   GAP}};
    localparam [15*OP-1:0] SPACE = {
        /* x^2 + y^2   */ {KEEP,       HOLD,    SAME,   NONE,   BASE},
        /* its bytes   */ {KEEP,       HOLD,    SAME,   NONE,   BYTES},
        /* and pairs   */ {KEEP,       HOLD,    SAME,   NONE,   PAIRS},
        /* q'          */ {POWER,      HOLD,    SAME,   NONE,   INVERSE},
        /* slope       */ {KEEP,       HOLD,    SAME,   NONE,   READ | HALVE},
        /* w           */ {KEEP,       FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt; x   */ {TURN,       SHIFTED, RESULT, NONE,   OTHER},
        /* c3; y       */ {TURN,       SHIFTED, SAME,   NONE,   SIDE},
        /* m           */ {TURN,       PRODUCT, RESULT, NONE,   OTHER},
        /* m^2         */ {TURN,       FACTOR,  SLOPE,  NONE,   J3},
        /* 1/sqrt; x   */ {TURN,       SHIFTED, RESULT, NONE,   OTHER},
        /* c3; y       */ {K2,         SHIFTED, SAME,   NONE,   OTHER},
        /* n3          */ {MOVE | K2,  HOLD,    SAME,   NONE,   NEAREST},
        /* rho         */ {UP,         HOLD,    SAME,   NONE,   OTHER},
        /* gap         */ {RHO,        SHIFTED, CFG_R,  NONE,   GAP}};
    localparam [10*OP-1:0] SOLVE = {
        /* c2          */ {KEEP,       PRODUCT, RESULT, EDGE,   COS2 | BYTES},
        /* c2^2        */ {KEEP,       HOLD,    CFG_L2, LENGTH, ROOT | PAIRS},
        /* k1; q'      */ {K1,         FACTOR,  SLOPE,  NONE,   INVERSE},
        /* n2          */ {KEEP,       PRODUCT, RESULT, NONE,   READ},
        /* n2^2        */ {KEEP,       HOLD,    CFG_L2, EDGE,   SIN2},
        /* k2          */ {K2,         FACTOR,  SLOPE,  NONE,   HALVE},
        /* 1/q'; b     */ {TURN,       SHIFTED, RESULT, NONE,   OTHER},
        /* c1; a       */ {KEEP,       SHIFTED, SAME,   NONE,   SIDE},
        /* m/q         */ {KEEP,       PRODUCT, RESULT, NONE,   OTHER},
        /* (m/q)^2     */ {KEEP,       HOLD,    SAME,   NONE,   J1}};
    // PIPE = 1: a line computes partial products, the next one their sum, the product. What is decided by a product, or
    // given, is made of settled, a line later. A sum of operands is there JOINTS lines after theirs; its addend is
    // loaded in theirs. Where no product needs them, left and right load what costs nothing: SHIFTED and CFG_R.
    localparam [OP-1:0] WAIT = {KEEP, SHIFTED, CFG_R, NONE, OTHER}, STAY = {KEEP, SHIFTED, SAME, NONE, OTHER};
    localparam [22*OP-1:0] YAW_1 = {
        /* x^2 + y^2   */ {KEEP,       SHIFTED, CFG_R,  NONE,   FIRST},
        /* x^2 + y^2   */ {2{WAIT}},
        /* x^2 + y^2   */ {KEEP,       SHIFTED, CFG_R,  NONE,   BASE},
        /* its bytes   */ {KEEP,       SHIFTED, CFG_R,  NONE,   BYTES},
        /* and pairs   */ {KEEP,       SHIFTED, CFG_R,  NONE,   PAIRS},
        /* q'          */ {POWER,      SHIFTED, CFG_R,  NONE,   INVERSE},
        /* slope       */ {KEEP,       SHIFTED, CFG_R,  NONE,   READ | HALVE},
        /* slope       */ {TURN,       SHIFTED, CFG_R,  NONE,   OTHER},
        /* w           */ {KEEP,       FACTOR,  SLOPE,  NONE,   OTHER},
        /* 1/sqrt      */ WAIT,
        /* 1/sqrt; x   */ {KEEP,       SHIFTED, RESULT, NONE,   OTHER},
        /* c3; y       */ STAY,
        /* c3; n3      */ {K2,         PRODUCT, RESULT, NONE,   OTHER},
        /* n3          */ {MOVE | K2,  PRODUCT, RESULT, NONE,   SIDE},
        /* c3 x, n3 y  */ {KEEP,       SHIFTED, CFG_R,  NONE,   NEAREST},
        /* m^2         */ WAIT,
        /* m^2         */ {KEEP,       SHIFTED, CFG_R,  NONE,   J3},
        /* rho         */ {UP,         SHIFTED, CFG_R,  NONE,   OTHER},
        /* z^2         */ {RHO,        SHIFTED, CFG_R,  NONE,   FIRST},
        /* rho^2       */ {2{WAIT}}};
    localparam [OP-1:0] SQUARE_1 =
        /* x^2, y^2    */ {KEEP,       SHIFTED, CFG_R,  NONE,   FIRST};
    localparam [14*OP-1:0] SOLVE_1 = {
        /* gap         */ {KEEP,       SHIFTED, CFG_R,  NONE,   GAP},
        /* c2          */ {KEEP,       HOLD,    CFG_R,  NONE,   BYTES},
        /* c2          */ {KEEP,       PRODUCT, RESULT, NONE,   PAIRS},
        /* c2^2        */ {KEEP,       HOLD,    CFG_L2, EDGE,   COS2},
        /* k1          */ WAIT,
        /* c2^2        */ {KEEP,       SHIFTED, CFG_R,  LENGTH, ROOT},
        /* k1; q'      */ {K1,         FACTOR,  CFG_R,  NONE,   INVERSE},
        /* slope       */ {KEEP,       HOLD,    SLOPE,  NONE,   READ},
        /* n2          */ {KEEP,       HOLD,    SAME,   NONE,   OTHER},
        /* n2          */ {KEEP,       PRODUCT, CFG_L2, NONE,   OTHER},
        /* n2 again    */ {KEEP,       HOLD,    RESULT, NONE,   OTHER},
        /* k2          */ {K2,         FACTOR,  SLOPE,  EDGE,   HALVE},
        /* n2^2        */ {TURN,       SHIFTED, CFG_R,  NONE,   OTHER},
        /* 1/q'; n2^2  */ {KEEP,       SHIFTED, RESULT, NONE,   SIN2}};
    localparam [7*OP-1:0] GIVE_1 = {
        /* b           */ STAY,
        /* a           */ STAY,
        /* c1          */ {KEEP,       PRODUCT, RESULT, NONE,   OTHER},
        /* m/q         */ {KEEP,       PRODUCT, RESULT, NONE,   SIDE},
        /* (m/q)^2     */ {2{WAIT}},
        /* (m/q)^2     */ {KEEP,       SHIFTED, CFG_R,  NONE,   J1}};
    wire [OP-1:0] op;
    wire [6:0]    operands;
    wire [1:0]    left_from;
    wire [2:0]    right_from;
    wire [1:0]    addend;
    wire [14:0]   rest;
    assign        {operands, left_from, right_from, addend, rest} = op;
    wire          idle;
    wire          accept = in_valid && in_ready;
    generate
        if (JOINTS == 2 && PIPE == 0) begin : g_plane
            schedule #(.LINES(11), .BITS(OP), .TABLE({PLANE, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 0) begin : g_space
            schedule #(.LINES(25), .BITS(OP), .TABLE({SPACE, SOLVE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 2 && PIPE == 1) begin : g_plane_1
            schedule #(.LINES(23), .BITS(OP), .TABLE({SQUARE_1, WAIT, SOLVE_1, GIVE_1})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 1) begin : g_space_1
            schedule #(.LINES(44), .BITS(OP), .TABLE({YAW_1, SOLVE_1, STAY, GIVE_1})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate
    assign in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (|(rest & J1) || (out_valid && !out_ready));

    // minus_q first turns q into the gap, later it rounds rho; it is 0 where bytes and pairs are counted
    localparam         YAW = JOINTS == 3;
    reg                elbow, clamped, zero, beyond, short;
    reg                bent;            // c2^2 >= 1/2, so joint 2 is given by n2^2
    reg                a_left, b_left;  // a < 0, b < 0
    reg                x_near;          // the x axis is the nearer one, and m is a
    reg         [33:0] minus_q;
    reg  [3:0]         s;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [53:0] product, settled;
    /* verilator lint_on UNUSEDSIGNAL */
    wire        [21:0] result;
    wire [26:0]        word;
    wire [36:0]        total;
    wire [1:0]         coarse, fine;
    wire               over, none, axis;
    wire               up = |(operands & UP), rho_to = |(operands & RHO), halve = |(rest & HALVE);
    wire               first = PIPE == 1 ? |(rest & FIRST) : YAW ? up : accept;  // the sum that begins is the gap
    wire               start = PIPE == 1 ? first && !rho_to : accept;            // of x and y
    reg         [33:0] gap_xy;                                                   // x^2 + y^2 - Q1 - Q2
    reg         [20:0] rho;
    kernel_vector_turn #(.JOINTS(JOINTS), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) turn (
        .clk(clk), .in_start(accept), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_up(up), .in_rho(rho_to),
        .in_total(rho), .in_k1(|(operands & K1)), .in_k2(|(operands & K2)), .in_turn(|(operands & TURN)),
        .in_move(|(operands & MOVE)), .in_power(|(operands & POWER)), .in_clamp(clamped), .in_odd(s[0]),
        .in_sum(result), .in_product(product[52:31] ^ {22{halve && elbow}}),
        .in_addend(minus_q), .in_margin(cfg_margin), .out_axis(axis), .out_sum(total));
    kernel_vector_shift shift (.in_sum(total), .in_q(total[34:3]), .in_s(s), .out_word(word), .out_over(over),
        .out_coarse(coarse), .out_fine(fine), .out_zero(none));

    // The third multiplier: 1.0 is 2^25 in left, 2^26 in right (2^24 in words from SLOPE), 2^49 in a product of the two
    // and 2^51 in a square. Its addend is a register that is 0 where nothing is added.
    reg  signed [26:0] left, right;
    wire               minus, near, distant;
    wire [21:0]        more;
    kernel_product #(.PIPE(PIPE), .MULTIPLY(MULTIPLY)) multiplier (.clk(clk), .in_left(left), .in_right(right),
        .out_product(product), .out_settled(settled));
    assign             result = settled[52:31] + more + {21'd0, minus};
    wire               outside = beyond || settled[53:49] != {5{settled[53]}};

    // v = 1 - c2^2 has 26 fraction bits. First factors of sqrt(v), 1/q', 2/sqrt(q') have 22 bits and a constant 1.
    wire        root = |(rest & ROOT), read = |(rest & READ), inverse = |(rest & INVERSE);
    wire [25:0] v = ~settled[50:25];
    wire        low = v[25:21] == 0, tiny = v[25:14] == 0;
    wire [20:0] e = tiny ? {2'd0, v[13:0], 5'd16} : low ? v[20:0] : v[25:5];
    wire [21:0] root_w = {e[20:11], ~e[11], e[10:0]};
    wire [21:0] inverse_w = {1'b0, word[24:16], ~word[15], clamped ? {word[15], ~word[14:5]} : ~word[14:4]};
    reg  [21:0] factor;
    wire [19:0] slope;
    kernel_vector_slopes #(.PIPE(PIPE)) slopes (.clk(clk), .in_read(root || read),
        .in_range(read ? {1'b1, clamped} : {tiny, low && !tiny}), .in_segment(read ? factor[20:12] : e[20:12]),
        .out_slope(slope));

    // m is b where |b| / q < 3/4, else a
    wire [2:0] size = settled[49:47] ^ {3{settled[53]}};
    wire       far = size[2] || size[1] && size[0];
    wire       side = |(rest & SIDE), keep_b = side && !far;

    // The axis of joint 2 is a quarter turn for c2^2, and 0 or half a turn for n2^2
    reg         zero3;
    wire        sin2 = |(rest & SIN2);
    /* verilator lint_off UNUSEDSIGNAL */
    wire [2:0]  take = {|(rest & J3) && !zero, root || sin2 && bent, |(rest & J1) && !zero};
    /* verilator lint_on UNUSEDSIGNAL */
    assign      out_take = take[JOINTS-1:0];
    assign      out_axis = root ? {elbow, 1'b1} : sin2 ? {short, 1'b0} : {x_near ? b_left : a_left, !x_near};
    assign      out_below = root ? short == elbow : sin2 ? short ^ elbow : a_left ^ b_left ^ !x_near;
    assign      out_square = settled[51:11];
    kernel_vector_edges #(.MARGINS(MARGINS), .PIPE(PIPE)) edges (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_margin(cfg_margin), .cfg_slack(cfg_slack),
        .in_length(|(addend & LENGTH)), .in_edge(|(addend & EDGE)), .in_cos2(|(rest & COS2)), .in_root(1'b1),
        .in_elbow(1'b0), .in_flat(1'b0), .in_load(YAW ? rho_to : accept), .in_axis(YAW && axis), .in_beyond(beyond),
        .in_clamped(clamped), .in_sum(result), .in_product(settled[53:50]), .out_addend(more), .out_minus(minus),
        .out_near(near), .out_far(distant));
    assign      out_status = {2'd0, (YAW ? zero3 : zero) || near, distant};
    always @(posedge clk) begin
        minus_q <= {24'd0, |(rest & NEAREST), 9'd0};
        if (start || first)
            minus_q <= start ? cfg_q : gap_xy;
        if (|(rest & BASE))
            gap_xy <= total[36:3];
        if (up)
            rho <= total[33:13];
        if (accept)
            elbow <= in_elbow;
        if (up)
            zero3 <= zero;
        if (first)
            s <= cfg_e;
        if (|(rest & BYTES))
            s[3:2] <= coarse;
        if (|(rest & COS2) || YAW && accept)
            clamped <= YAW && accept || outside;
        if (|(rest & PAIRS)) begin
            s[1:0] <= fine;
            zero   <= none;
        end
        if (halve && clamped)
            s <= s >> 1;
        if (|(rest & GAP)) begin
            beyond <= over;
            short  <= total[36];
        end

        if (root)
            bent <= clamped || settled[51] || settled[50];
        if (side) begin
            b_left <= settled[53];
            a_left <= word[26];
            x_near <= far;
        end

        if (root || inverse) begin
            factor   <= inverse ? inverse_w : root_w;
        end
        if (root && (clamped || settled[51])) begin  // for c2 = -1 the root would read 1
            factor   <= 22'd0;
        end
        if (left_from != HOLD && !keep_b)
            case (left_from)
                PRODUCT: left <= product[50:24];
                FACTOR: left <= {1'b0, factor, 4'd8};
                default: left <= word;
            endcase
        if (right_from < SAME && !(PIPE == 1 && keep_b))
            case ({1'b0, right_from[1:0]})
                CFG_R: right <= {1'b0, cfg_r};
                CFG_L2: right <= {1'b0, cfg_l2, 10'd0};
                SLOPE: right <= {1'b0, slope, 6'd0};
                default: right <= product[49:23];
            endcase
        if (|(rest & COS2) && outside)
            left <= {short, 1'b1, 25'd0};
    end
endmodule
`default_nettype wire
