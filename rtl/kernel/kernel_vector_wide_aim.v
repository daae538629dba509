// SPDX-License-Identifier: Apache-2.0
// kernel_vector_aim for words of more than 16 bits: (c, n) = (x, y) / |(x, y)|, by one multiplier.
//   q = x^2 + y^2 of x and y without their common redundant sign bits; c = x / sqrt(q), n = y / sqrt(q). Where q is 1
//   or more, a quarter of it is looked up, and x and y are halved
// Formats: in_x, in_y sN.0; out_c, out_n s2.U, rounded to nearest (ties upward). A codec takes out_word s4.(N+2), with
// U above N: it is the cosine in the clock of out_cos, the sine in that of out_sin. With out_none, at x = y = 0, the
// codec holds its word.
// Error: the direction is exact, the length that of bounds.vector.length, before both are rounded. Latency, II: 9 + 8
// PIPE + LAG. Status: singular (x = y = 0: the last vector is held, (1, 0) after a reset).
// Source: rational trigonometry paper, eq. 9, which loses the quadrant. Model: kernel_vector_wide.aim
`default_nettype none
module kernel_vector_wide_aim #(
    parameter N = 20,                // bits of a coordinate, 20 or 24 (default 20)
    parameter U = 20,                // fraction bits of cosine and sine, 4 to N (default 20); N + 2: not rounded
    parameter LAG = 0,               // clocks of the codec after the last word, 0 to 6 (default 0)
    parameter PIPE = 0,              // 0 or 1 (default 0: fewest clocks); 1: registers behind products and tables
    parameter MULTIPLY = 18,         // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter F = N == 24 ? 29 : 25  // fraction bits of q and of an operand, of one value (default 25)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [N-1:0] in_x,
    input  wire signed [N-1:0] in_y,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [U+1:0] out_c,
    output reg  signed [U+1:0] out_n,
    output wire                out_cos,
    output wire                out_sin,
    output wire [N+5:0]        out_word,
    output wire                out_none,
    output wire [3:0]          out_status
);
    // Schedule, a clock a line
    localparam [11:0]
        REST    = 12'h000,  // nothing
        LEFT    = 12'h001,  // a coordinate without its redundant sign bits
        RIGHT   = 12'h002,  // the same
        SECOND  = 12'h004,  // that coordinate is y, not x
        ADD     = 12'h008,  // a square; in other lines sum becomes the half that rounds a result
        UNIT    = 12'h010,  // sum becomes what q starts with
        INVERSE = 12'h020,  // q, and the first factor of its reciprocal root
        READ    = 12'h040,  // read the slope
        FACTOR  = 12'h080,  // both factors
        ROOT    = 12'h100,  // 2 / sqrt(q)
        COS     = 12'h200,  // the cosine goes out
        SIN     = 12'h400,  // the sine goes out
        LAST    = 12'h800;  // of the last line: the words are valid in the next clock
    localparam [8*12-1:0] AIM = {
        /* x       */ {LEFT | RIGHT | UNIT},
        /* x x     */ {ADD | LEFT | RIGHT | SECOND},
        /* y y     */ {INVERSE},
        /* slope   */ {READ},
        /* factors */ {FACTOR},
        /* root    */ {ROOT | LEFT},
        /* x root  */ {COS | LEFT | SECOND},
        /* y root  */ {SIN}};
    // PIPE = 1: a line computes partial products, the next one the product, the third adds it
    localparam [16*12-1:0] AIM_1 = {
        /* x       */ {LEFT | RIGHT},
        /* x x     */ {LEFT | RIGHT | SECOND},
        /* y y     */ {UNIT},
        /* x x     */ {ADD},
        /* y y     */ {ADD},
        /* q       */ {INVERSE},
        /* slope   */ {READ},
        /* square  */ {2{REST}},
        /* factors */ {FACTOR},
        /* root    */ {REST},
        /* root    */ {ROOT | LEFT},
        /* x root  */ {LEFT | SECOND},
        /* y root  */ {REST},
        /* c       */ {COS},
        /* n       */ {SIN}};
    wire [11:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    assign      in_ready = idle && (!out_valid || out_ready);
    generate  // LAG lines wait for the codec; LAST is added to the last line, whichever that is
        if (PIPE == 0) begin : g_aim
            localparam [(8+LAG)*12-1:0] LINES = {AIM, {LAG{REST}}} | {{((7+LAG)*12){1'b0}}, LAST};
            schedule #(.LINES(8+LAG), .BITS(12), .TABLE(LINES)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_aim_1
            localparam [(16+LAG)*12-1:0] LINES = {AIM_1, {LAG{REST}}} | {{((15+LAG)*12){1'b0}}, LAST};
            schedule #(.LINES(16+LAG), .BITS(12), .TABLE(LINES)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate

    // Redundant sign bits by groups of four: the first group with a used bit, and the first used bit in it
    localparam  GROUPS = N / 4;
    wire [N-1:0] used = {(in_x[N-2:0] ^ in_x[N-1:1]) | (in_y[N-2:0] ^ in_y[N-1:1]), 1'b1};
    reg  [2:0]   group;
    reg  [3:1]   bits;
    integer      i;
    always @* begin
        group = GROUPS[2:0] - 3'd1;
        bits = used[3:1];
        for (i = 1; i < GROUPS; i = i + 1)
            if (used[4*i +: 4] != 0) begin
                group = GROUPS[2:0] - 3'd1 - i[2:0];
                bits = used[4*i+1 +: 3];
            end
    end
    wire [4:0]          spare = {group, !bits[3] && !bits[2], !bits[3] && (bits[2] || !bits[1])};
    reg  signed [N-1:0] x, y;
    reg  [4:1]          k;
    reg  [1:0]          last;  // the last step of the shift: 2 by one bit to the left, 1 by none, 0 to the right
    reg                 zero;
    wire signed [N-1:0] first = |(op & SECOND) ? y : x;
    wire signed [N-1:0] pairs = k[1] ? first << 2 : first;
    wire signed [N-1:0] coarse = pairs << {k[4:2], 2'b00};
    wire signed [F+1:0] aligned = {{2{coarse[N-1]}}, coarse, {(F-N){1'b0}}};
    wire signed [F+1:0] operand = last[1] ? aligned << 1 : last[0] ? aligned : aligned >>> 1;

    // In an operand 1.0 is 2^(F-1), in q and the argument of the root 2^F, in a product of two 2^(2F-2), of one and the
    // root 2^(2F-1). q starts with 1, for two truncated squares.
    reg  signed [F+1:0]   left, right;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [2*F+3:0] product, settled;
    /* verilator lint_on UNUSEDSIGNAL */
    localparam [F+2:0]    HALF = U > N ? {(F+3){1'b0}} : {{(F+2){1'b0}}, 1'b1} << F - U;
    reg         [F+2:0]   sum;
    wire        [F+2:0]   total = settled[2*F:F-2] + sum;
    wire        [F+1:0]   q = PIPE == 0 ? total[F+1:0] : sum[F+1:0];
    wire                  over = q[F+1:F] != 2'd0;
    wire signed [F+1:0]   factor;
    wire        [F:0]     slope;
    kernel_vector_curve #(.N(N), .ROOTS(0), .PIPE(PIPE)) curve (.clk(clk), .in_root(1'b0),
        .in_inverse(|(op & INVERSE)), .in_read(|(op & READ)), .in_clamped(1'b1), .in_elbow(1'b0), .in_none(1'b0),
        .in_v({(F+1){1'b0}}), .in_q(over ? q[F+1:2] : q[F-1:0]), .out_left(factor), .out_slope(slope));
    generate
        if (PIPE == 0) begin : g_now
            assign product = left * right;
            assign settled = product;
        end else begin : g_registers
            reg signed [2*F+3:0] settled_1;
            product_parts #(.A(F+2), .B(F+2), .MULTIPLY(MULTIPLY)) multiplier (.clk(clk), .in_move(1'b1), .in_a(left),
                .in_b(right), .out_p(product));
            always @(posedge clk)
                settled_1 <= product;
            assign settled = settled_1;
        end
    endgenerate
    assign out_status = {2'd0, zero, 1'b0};
    assign {out_cos, out_sin} = {|(op & COS), |(op & SIN)};
    assign out_word = {{2{total[F+2]}}, total[F+2:F-1-N]};
    assign out_none = zero;

    always @(posedge clk) begin
        if (accept) begin
            x    <= in_x;
            y    <= in_y;
            k    <= spare[4:1];
            zero <= spare == N - 1 && !in_x[N-1] && !in_y[N-1];
        end
        if (accept || |(op & INVERSE))
            last <= accept ? {spare[0], !spare[0]} : last[1] ? {!over, over} : {1'b0, !over};
        sum <= |(op & ADD) ? total : |(op & UNIT) ? {{(F+2){1'b0}}, 1'b1} : HALF;
        if (|(op & (LEFT | FACTOR)))
            left <= |(op & FACTOR) ? factor : operand;
        if (|(op & (RIGHT | FACTOR | ROOT)))
            right <= |(op & RIGHT) ? operand : |(op & FACTOR) ? {1'b0, slope} : product[2*F-1:F-2];
        if (|(op & COS) && !zero)
            out_c <= total[F+2:F+1-U];
        if (|(op & SIN) && !zero)
            out_n <= total[F+2:F+1-U];
        out_valid <= |(op & LAST) || (out_valid && !out_ready);
        if (rst) begin
            out_c     <= {2'b01, {U{1'b0}}};
            out_n     <= {(U+2){1'b0}};
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
