// SPDX-License-Identifier: Apache-2.0
// Direction of a point as a unit vector (c, n) = (x, y) / |(x, y)|, by one multiplier.
//   q = x^2 + y^2 of x and y without their common redundant sign bits; c = x / sqrt(q), n = y / sqrt(q)
// Formats: in_x, in_y s16.0; out_c, out_n s2.U, rounded to nearest (ties upward).
// Error: the direction is exact, the length is 1 within 0.95 * 2^-16, before both are rounded. Latency, II: 8 + 7 PIPE.
// Status: singular (x = y = 0: the last vector is held, (1, 0) after a reset).
// Source: rational trigonometry paper, eq. 9, which loses the quadrant. Model: kernel_vector_solve.aim
`default_nettype none
module kernel_vector_aim #(
    parameter U = 16,        // fraction bits of cosine and sine, 4 to 16 (default 16)
    parameter PIPE = 0,      // registers behind product and table, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [15:0]  in_x,
    input  wire signed [15:0]  in_y,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [U+1:0] out_c,
    output reg  signed [U+1:0] out_n,
    output wire [3:0]          out_status
);
    // Schedule, a clock a line
    localparam [8:0]
        LEFT   = 9'b000000001,  // a coordinate without its redundant sign bits
        RIGHT  = 9'b000000010,  // the same
        SECOND = 9'b000000100,  // that coordinate is y, not x
        ADD    = 9'b000001000,  // a square; in other lines sum becomes what a result starts with
        READ   = 9'b000010000,  // q, and read the slope of its reciprocal root; left is w
        SLOPE  = 9'b000100000,  // the other factor of the root
        ROOT   = 9'b001000000,  // 1 / sqrt(q)
        COS    = 9'b010000000,  // the cosine goes out
        SIN    = 9'b100000000;  // the sine goes out
    //                 work
    localparam [9*7-1:0] AIM = {
        /* x       */ {LEFT | RIGHT},
        /* x x     */ {ADD | LEFT | RIGHT | SECOND},
        /* y y     */ {READ},
        /* slope   */ {SLOPE},
        /* root    */ {ROOT | LEFT},
        /* x root  */ {COS | LEFT | SECOND},
        /* y root  */ {SIN}};
    // PIPE = 1: a line computes partial products, the next one their sum; sum and results are made of it a line later
    localparam [14*9-1:0] AIM_1 = {
        /* x       */ {LEFT | RIGHT},
        /* x x     */ {LEFT | RIGHT | SECOND},
        /* y y     */ {LEFT | RIGHT | SECOND},
        /* x x     */ {ADD},
        /* y y     */ {ADD},
        /* q       */ {READ},
        /* slope   */ {9'd0},
        /* slope   */ {SLOPE},
        /* root    */ {9'd0},
        /* root    */ {ROOT | LEFT},
        /* x root  */ {LEFT | SECOND},
        /* y root  */ {9'd0},
        /* c       */ {COS},
        /* n       */ {SIN}};
    wire   to_left, to_right, second, add, read, to_slope, root, cosine, sine, idle;
    wire   accept = in_valid && in_ready;
    assign in_ready = idle && (!out_valid || out_ready);
    generate
        if (PIPE == 0) begin : g_aim
            schedule #(.LINES(7), .BITS(9), .TABLE(AIM)) control (.clk(clk), .rst(rst), .in_start(accept),
                .out_idle(idle), .out_op({sine, cosine, root, to_slope, read, add, second, to_right, to_left}));
        end else begin : g_aim_1
            schedule #(.LINES(14), .BITS(9), .TABLE(AIM_1)) control (.clk(clk), .rst(rst), .in_start(accept),
                .out_idle(idle), .out_op({sine, cosine, root, to_slope, read, add, second, to_right, to_left}));
        end
    endgenerate

    wire [14:0] used = (in_x[14:0] ^ in_x[15:1]) | (in_y[14:0] ^ in_y[15:1]);
    reg  [15:0] x, y;
    // Redundant sign bits by groups of four: the first group with a used bit, and the first used bit in it
    wire        some3 = used[14:11] != 0, some2 = used[10:7] != 0, some1 = used[6:3] != 0;
    wire [1:0]  group = {!some3 && !some2, !some3 && (some2 || !some1)};
    wire [3:1]  bits = group[1] ? (group[0] ? used[2:0] : used[6:4]) : (group[0] ? used[10:8] : used[14:12]);
    wire [3:0]  spare = {group, !bits[3] && !bits[2], !bits[3] && (bits[2] || !bits[1])};
    reg  [3:0]  k;     // the shift; its last step is in the selectors of left and right
    reg  [1:0]  pick;  // operand right: 0 or 1 the coordinate shifted by that much, 2 the slope, 3 the root
    reg         zero;
    wire [15:0] first = k[1] ? (second ? y << 2 : x << 2) : (second ? y : x);
    reg  [15:0] coarse;
    always @*
        case (k[3:2])
            2'd0: coarse = first;
            2'd1: coarse = first << 4;
            2'd2: coarse = first << 8;
            default: coarse = first << 12;
        endcase

    // Coordinates in left and right have 20 fraction bits, so a product has 18 above the 22 that are dropped.
    reg  signed [21:0] left, right;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [43:0] product, settled;
    /* verilator lint_on UNUSEDSIGNAL */
    wire [19:0] slope, factor;
    localparam [19:0] HALF = 1 << 16 - U;  // rounds c and n; q starts with 1, for two truncated squares
    wire [19:0] start = U < 16 && to_right ? 20'd1 : HALF;
    reg  [19:0] sum;
    wire [19:0] total = settled[41:22] + sum;
    wire [20:0] w;
    reciprocal_root inverse (.clk(clk), .in_read(read), .in_q(PIPE == 0 ? total : sum), .out_w(w), .out_slope(slope));
    generate
        if (PIPE == 0) begin : g_now
            assign product = left * right;
            assign settled = product;
            assign factor = slope;
        end else begin : g_registered
            wire signed [53:0] product_1, settled_1;
            reg         [19:0] slope_1;
            wire               unused = &{1'b0, product_1[53:44], settled_1[53:44]};
            kernel_product #(.PIPE(1), .MULTIPLY(MULTIPLY)) multiplier (.clk(clk), .in_left({{5{left[21]}}, left}),
                .in_right({{5{right[21]}}, right}), .out_product(product_1), .out_settled(settled_1));
            always @(posedge clk)
                slope_1 <= slope;
            assign product = product_1[43:0];
            assign settled = settled_1[43:0];
            assign factor = slope_1;
        end
    endgenerate
    assign out_status = {2'd0, zero, 1'b0};

    always @(posedge clk) begin
        if (accept) begin
            x    <= in_x;
            y    <= in_y;
            k    <= spare;
            zero <= spare == 4'd15 && !in_x[15] && !in_y[15];
        end
        sum <= add ? total : start;
        if (to_left || read)
            left <= read ? {1'b0, w} : k[0] ? {coarse[14], coarse[14:0], 6'd0} : {coarse[15], coarse, 5'd0};
        if (to_right || to_slope || root)
            right <= pick[1] ? (pick[0] ? product[38:17] : {2'd0, factor})
                   : pick[0] ? {coarse[14], coarse[14:0], 6'd0} : {coarse[15], coarse, 5'd0};
        if (accept || read || to_slope)
            pick <= accept ? {1'b0, spare[0]} : {1'b1, to_slope};
        if (cosine && !zero)
            out_c <= total[18:17-U];
        if (sine && !zero)
            out_n <= total[18:17-U];
        out_valid <= sine || (out_valid && !out_ready);
        if (rst) begin
            out_c    <= {2'b01, {U{1'b0}}};
            out_n    <= {(U+2){1'b0}};
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
