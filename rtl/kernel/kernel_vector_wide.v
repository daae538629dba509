// SPDX-License-Identifier: Apache-2.0
// kernel_vector_solve in the plane for words of more than 16 bits: the unit vectors of both joints of a tip (x, y).
//   q = x^2 + y^2, c2 = (q - Q1 - Q2) / 2 L1 L2, n2 = +-sqrt(1 - c2^2), k = L1 + L2 (c2, n2), (c1, n1) = p conj(k) / q
// Out of reach c2 = +-1, n2 = 0 and (c1, n1) = +-p / |p|, with 2 / sqrt(q) for 1/q and a power of two for k.
// Formats: in_* sN.0; cfg_* by kernel_vector_wide.config; out_word s4.(N+2), in clocks of out_cos[i] the cosine and of
// out_sin[i] the sine of joint i + 1, half a unit of U bits added; out_flat: c2 is 1, or -1 with out_negative;
// out_none, until two clocks after the sine: joint 1 has no direction. Error of the tip: bounds.vector.ik2.
// Latency, II: 10 + 15 PIPE. Status: unreachable by more than cfg_slack, 2^(2-N) of c2 (nearest point), singular (the
// elbow is within cfg_margin of stretched or folded, or x = y = 0).
// Source: rational trigonometry paper, eqs. 18-23. Model: kernel_vector_wide.plane
`default_nettype none
module kernel_vector_wide #(
    parameter N = 20,                // bits of a coordinate, 20 or 24 (default 20)
    parameter U = 20,                // fraction bits of a rounded word, 8 to N (default 20)
    parameter PIPE = 0,              // 0 or 1 (default 0: fewest clocks); 1: registers behind products and tables
    parameter MULTIPLY = 18,         // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter MARGINS = 0,           // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
    parameter F = N == 24 ? 29 : 25  // fraction bits of the words of the third multiplier, of one value (default 25)
) (
    input  wire                  clk,
    input  wire                  rst,
    input  wire [N-1:0]          cfg_l1,
    input  wire [N-1:0]          cfg_l2,
    input  wire signed [2*N+1:0] cfg_q,
    input  wire [F:0]            cfg_r,
    input  wire [4:0]            cfg_e,
    input  wire [N-2:0]          cfg_margin,
    input  wire [N-4:0]          cfg_slack,
    input  wire                  in_valid,
    output wire                  in_ready,
    input  wire signed [N-1:0]   in_x,
    input  wire signed [N-1:0]   in_y,
    input  wire                  in_elbow,
    output reg                   out_valid,
    input  wire                  out_ready,
    output wire [2:0]            out_cos,
    output wire [2:0]            out_sin,
    output wire [N+5:0]          out_word,
    output wire                  out_flat,
    output wire                  out_negative,
    output wire                  out_none,
    output wire [3:0]            out_status
);
    // Schedule, a clock a line
    localparam [2:0]              // operands of the first multipliers
        KEEP    = 3'd0,           // hold
        K1      = 3'd1,           // the product is k1
        K2      = 3'd2,           // the product is k2
        TURN    = 3'd4;           // (k1, k2) becomes (-k2, k1)
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
    localparam [11:0]             // the rest
        OTHER   = 12'h000,        // nothing
        BYTES   = 12'h001,        // bytes that q can spare
        PAIRS   = 12'h002,        // pairs of bits that q can spare
        GAP     = 12'h004,        // sign and range of q - Q1 - Q2
        ROOT    = 12'h008,        // read n2
        READ    = 12'h010,        // read 1/q'
        INVERSE = 12'h020,        // first factor of 1/q'
        COS2    = 12'h040,        // the product is c2
        SIN2    = 12'h080,        // the product is n2
        HALVE   = 12'h100,        // out of reach not q is shifted but its root
        COS1    = 12'h200,        // the product is c1
        SIN1    = 12'h400,        // the product is n1; the words are valid in the next clock
        FIRST   = 12'h800;        // the next sum is the gap, with PIPE = 1
    localparam OP = 22;           // bits of a line
    //                       operands  left     right   addend  rest
    localparam [9*OP-1:0] SOLVE = {
        /* gap         */ {KEEP,     SHIFTED, CFG_R,  HALF,   GAP},
        /* c2          */ {KEEP,     PRODUCT, RESULT, NONE,   COS2 | BYTES},
        /* c2^2        */ {KEEP,     HOLD,    CFG_L2, LENGTH, ROOT | PAIRS},
        /* k1; q'      */ {K1,       FACTOR,  SLOPE,  HALF,   INVERSE},
        /* n2          */ {KEEP,     PRODUCT, CFG_L2, NONE,   SIN2 | READ},
        /* k2          */ {K2,       FACTOR,  SLOPE,  NONE,   HALVE},
        /* 1/q'; b     */ {TURN,     SHIFTED, RESULT, HALF,   OTHER},
        /* c1; a       */ {KEEP,     SHIFTED, SAME,   HALF,   COS1},
        /* n1          */ {KEEP,     SHIFTED, SAME,   NONE,   SIN1}};
    // PIPE = 1: a line computes the parts of products, the next one products, the third the sum of two. Words and k1
    // are made of settled, a line later than left and right. minus_q is loaded a line before it is added, factor three
    // lines before left. Where no product needs them, left and right load what costs nothing: SHIFTED and CFG_R.
    localparam [OP-1:0] WAIT = {KEEP, SHIFTED, CFG_R, NONE, OTHER}, STAY = {KEEP, SHIFTED, SAME, NONE, OTHER};
    localparam [24*OP-1:0] SOLVE_1 = {
        /* x^2, y^2    */ WAIT,
        /* q           */ {KEEP,     SHIFTED, CFG_R,  NONE,   FIRST},
        /* q           */ WAIT,
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
        /* 1/q'; b     */ {TURN,     SHIFTED, CFG_R,  NONE,   OTHER},
        /* 1/q'; b, a  */ {KEEP,     SHIFTED, RESULT, NONE,   OTHER},
        /* b, a        */ STAY,
        /* b, a        */ STAY,
        /* c1; a       */ STAY,
        /* c1, n1      */ {KEEP,     SHIFTED, CFG_R,  HALF,   OTHER},
        /* n1          */ {KEEP,     SHIFTED, CFG_R,  HALF,   COS1},
        /* n1          */ {KEEP,     SHIFTED, CFG_R,  NONE,   SIN1}};
    wire [OP-1:0] op;
    wire [2:0]    operands, right_from;
    wire [1:0]    left_from, addend;
    wire [11:0]   rest;
    assign        {operands, left_from, right_from, addend, rest} = op;
    wire          idle;
    wire          accept = in_valid && in_ready;
    generate
        if (PIPE == 0) begin : g_solve
            schedule #(.LINES(9), .BITS(OP), .TABLE(SOLVE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_solve_1
            schedule #(.LINES(24), .BITS(OP), .TABLE(SOLVE_1)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate
    assign        in_ready = idle && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (|(rest & SIN1) || (out_valid && !out_ready));

    // The first multipliers: total = k1 x + k2 y + minus_q, each product truncated to 2^-3. k has 4 fraction bits. A
    // constant 1 follows its last bit, but 0 where k is a coordinate: it centres truncation and makes the one's
    // complement an exact negation. minus_q turns the first sum, q, into the gap.
    reg                  elbow, clamped, zero, beyond, short, odd, half;
    reg         [2*N+1:0] minus_q;
    reg         [N+5:0]  k1, k2;
    reg  signed [N-1:0]  x, y;
    reg         [4:0]    s;
    reg         [N-1:0]  l1;
    wire signed [N+6:0]   long1 = {k1, odd}, long2 = {k2, odd};
    reg  signed [F+1:0]   left, right;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [2*N+6:0] product1, product2;
    wire signed [2*F+3:0] product, settled;
    /* verilator lint_on UNUSEDSIGNAL */
    wire        [2*N+1:0] upper = product2[2*N+6:5] + minus_q;
    wire        [2*N+4:0] sum = product1[2*N+6:2] + {upper, product2[4:2]};
    wire        [2*N+4:0] total;
    generate
        if (PIPE == 0) begin : g_now
            assign product1 = long1 * x;
            assign product2 = long2 * y;
            assign total = sum;
            assign product = left * right;
            assign settled = product;
        end else begin : g_registers
            wire signed [2*N+6:0] parts1, parts2;
            reg  signed [2*N+6:0] whole1, whole2;
            reg         [2*N+4:0] total_1;
            reg  signed [2*F+3:0] settled_1;
            product_parts #(.A(N+7), .B(N), .MULTIPLY(MULTIPLY)) first (.clk(clk), .in_move(1'b1), .in_a(long1),
                .in_b(x), .out_p(parts1));
            product_parts #(.A(N+7), .B(N), .MULTIPLY(MULTIPLY)) second (.clk(clk), .in_move(1'b1), .in_a(long2),
                .in_b(y), .out_p(parts2));
            product_parts #(.A(F+2), .B(F+2), .MULTIPLY(MULTIPLY)) third (.clk(clk), .in_move(1'b1), .in_a(left),
                .in_b(right), .out_p(product));
            always @(posedge clk) begin
                whole1    <= parts1;
                whole2    <= parts2;
                total_1   <= sum;
                settled_1 <= product;
            end
            assign product1 = whole1;
            assign product2 = whole2;
            assign total = total_1;
            assign settled = settled_1;
        end
    endgenerate

    // Their shifter: word = total * 2^(2 s - 2 N + F) without its fraction. over: it does not fit. coarse, fine: bytes
    // of q that are 0, then pairs of bits after the byte shift
    localparam      TOP = 2 * N + 4, BYTE = N == 24 ? 6 : 5;  // bytes of q
    reg  [F+7:0]    moved;  // 6 bits more than the word, for the shift by pairs
    reg  [F+1:0]    word;
    reg             over;
    reg  [2:0]      coarse;
    integer         i;
    wire            sign = total[TOP];
    /* verilator lint_off UNUSEDSIGNAL */
    wire [TOP+40:0] longer = {total, 40'd0};
    /* verilator lint_on UNUSEDSIGNAL */
    always @* begin
        case (s[4:2])
            3'd0: moved = longer[TOP+40 -: F+8];
            3'd1: moved = longer[TOP+32 -: F+8];
            3'd2: moved = longer[TOP+24 -: F+8];
            3'd3: moved = longer[TOP+16 -: F+8];
            3'd4: moved = longer[TOP+8 -: F+8];
            default: moved = longer[TOP+48-8*BYTE -: F+8];
        endcase
        case (s[1:0])
            2'd0: word = moved[F+7:6];
            2'd1: word = moved[F+5:4];
            2'd2: word = moved[F+3:2];
            default: word = moved[F+1:0];
        endcase
        over = moved[F+7] != sign || s[1:0] != 0 && moved[F+6:F+5] != {2{sign}}
               || s[1] && (moved[F+4:F+3] != {2{sign}} || s[0] && moved[F+2:F+1] != {2{sign}});
        coarse = N == 24 ? 3'd5 : 3'd4;
        for (i = BYTE - 1; i > 0; i = i - 1) begin
            if (s[4:2] >= i[2:0] && total[TOP+7-8*i -: 8] != {8{sign}})
                over = 1'b1;
            if (total[TOP+6-8*i -: 8] != 0)
                coarse = i[2:0] - 3'd1;
        end
    end
    wire [3:0]      low = {moved[F+5:F+4] != 0, moved[F+3:F+2] != 0, moved[F+1:F] != 0, moved[F-1:F-2] != 0};
    wire [1:0]      fine = {!low[3] && !low[2], !low[3] && (low[2] || !low[1])};

    // The third multiplier: 1.0 is 2^F in left, 2^(F+1) in right (2^(F-1) in words from SLOPE), 2^(2F-1) in a product
    // of the two. Its addend is a register that is 0 where nothing is added.
    localparam [N+5:0]  ROUND = {{(N+5){1'b0}}, 1'b1} << N + 1 - U;
    wire        [N+5:0] result = settled[2*F+2:2*F-3-N] + ({2'd0, l1, 4'd0} | (half ? ROUND : {(N+6){1'b0}}));
    wire                outside = beyond || settled[2*F+3:2*F-1] != {5{settled[2*F+3]}};
    wire                root = |(rest & ROOT), first = PIPE == 0 ? accept : |(rest & FIRST);
    wire signed [F+1:0] factor;
    wire        [F:0]   slope;
    kernel_vector_curve #(.N(N), .PIPE(PIPE)) curve (.clk(clk), .in_root(root), .in_inverse(|(rest & INVERSE)),
        .in_read(|(rest & READ)), .in_clamped(clamped), .in_elbow(elbow), .in_none(clamped || settled[2*F+1]),
        .in_v(~settled[2*F:F]), .in_q(word[F-1:0]), .out_left(factor), .out_slope(slope));

    assign out_cos = {1'b0, |(rest & COS2), |(rest & COS1)};
    assign out_sin = {1'b0, |(rest & SIN2), |(rest & SIN1)};
    assign out_none = zero;
    assign out_word = result;
    assign out_flat = outside;
    assign out_negative = short;

    // Margin and slack: the target is out of reach where c2 less the slack is 1 or more, the elbow is near to singular
    // where k2 less the margin has another sign
    wire near, far;
    generate
        if (MARGINS == 1) begin : g_margins
            reg          side;   // n2 is negative
            reg          loaded; // k2 is new
            reg          much;   // c2 is negative, or 2 or more
            reg  [N-3:0] above;  // its fraction
            reg          close, away;
            wire [N+1:0] left_over = k2[N+5:4] + ({3'd0, cfg_margin} ^ {(N+2){!side}}) + {{(N+1){1'b0}}, !side};
            assign       near = close;
            assign       far = away;
            always @(posedge clk) begin
                if (root)
                    side <= elbow && !clamped && !settled[2*F+1];
                loaded <= |(operands & K2);
                if (loaded)
                    close <= left_over[N+1] != k2[N+5];
                if (|(rest & COS2)) begin
                    above <= settled[2*F-2 -: N-2];
                    much  <= beyond || settled[2*F+3:2*F] != 4'd0;
                end
                away <= clamped && (much || above >= {1'b0, cfg_slack});
            end
        end else begin : g_none
            wire   unused = &{1'b0, cfg_margin, cfg_slack};
            assign near = 1'b0;
            assign far = clamped;
        end
    endgenerate
    assign out_status = {2'd0, zero || near, far};
    always @(posedge clk) begin
        minus_q <= {(2*N+2){1'b0}};
        if (accept) begin
            elbow   <= in_elbow;
            x       <= in_x;
            y       <= in_y;
        end
        if (first) begin
            s       <= cfg_e;
            minus_q <= cfg_q;
        end
        if (accept || |(operands & K1))
            odd <= !accept;
        if (accept || operands != KEEP && !(|(operands & K2)))
            k1 <= accept ? {{2{in_x[N-1]}}, in_x, 4'd0} : |(operands & K1) ? result : ~k2;
        if (|(operands & K1) && clamped)
            k1 <= {result[N+5], result[N+5] || s[0], !s[0], {(N+3){1'b0}}};
        if (accept || |(operands & (K2 | TURN)))
            k2 <= accept ? {{2{in_y[N-1]}}, in_y, 4'd0} : |(operands & K2) ? product[2*F+2:2*F-3-N] : k1;
        if (|(rest & BYTES))
            s[4:2] <= coarse;
        if (|(rest & COS2))
            clamped <= outside;
        if (|(rest & PAIRS)) begin
            s[1:0] <= fine;
            zero   <= low == 0;
        end
        if (|(rest & HALVE) && clamped)
            s <= s >> 1;
        if (|(rest & GAP)) begin
            beyond <= over;
            short  <= sign;
        end

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
