// SPDX-License-Identifier: Apache-2.0
// Direction of a point (x, y) about its nearer axis: the axis, and the signed square of the sine between the two.
//   |square| = m^2 / q, q = x^2 + y^2, m the coordinate across the axis; x and y are shifted left until 1/4 <= q <= 2
// The square is (m w) (m slope) with 1/q = w * slope, so it keeps all bits of m beside an axis. No length, no angle.
// Formats: in_x, in_y s16, any fraction; out_axis u2.0 quarter turns; out_square s0.40, at most 0.8 in magnitude,
// negative where the direction lies clockwise of the axis. Both are valid in the clock of out_take, one before
// out_valid rises.
// Error: the direction is within 0.48 * 2^-14 rad. The nearer axis is that of the coordinate that is longer in bits.
// Latency and II: 5 + 5 PIPE. Status: singular (x = y = 0; then out_take does not come).
// Source: rational trigonometry paper, eq. 9. Model: rational.ik1
`default_nettype none
module kernel_aim #(
    parameter PIPE = 0,      // 0 or 1 (default 0: fewest clocks); 1: registers behind products and table
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire               clk,
    input  wire               rst,
    input  wire               in_valid,
    output wire               in_ready,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    output reg                out_valid,
    input  wire               out_ready,
    output wire               out_take,
    output wire [1:0]         out_axis,
    output wire signed [40:0] out_square,
    output wire [3:0]         out_status
);
    // Schedule, a clock a line
    localparam [2:0]
        NONE = 3'b000,  // nothing, or what every clock does
        TO_Y = 3'b001,  // square x, y is next
        TO_M = 3'b000,  // square y, read 1/q; m is next, the shorter one
        BOTH = 3'b010,  // m w and m slope
        GIVE = 3'b100;  // the direction goes out
    //                       work
    localparam [4*3-1:0] AIM = {
        /* 1 x^2         */ {TO_Y},
        /* 2 y^2; q      */ {TO_M},
        /* 3 m w, m / t^2 */ {BOTH},
        /* 4 m^2 / q     */ {GIVE}};
    // PIPE = 1: registers behind the shifter, the products, their parts and the memory
    localparam [9*3-1:0] AIM_1 = {
        /* 1 x           */ {TO_Y},
        /* 2 x^2; y      */ {TO_M},
        /* 3 y^2; m      */ {NONE},
        /* 4 q           */ {NONE},
        /* 5 w, slope    */ {BOTH},
        /* 6 m w, m / t^2 */ {NONE},
        /* 7 its sum     */ {NONE},
        /* 8 m^2 / q     */ {NONE},
        /* 9 its sum     */ {GIVE}};
    wire   give, both, to_y, idle;
    wire   accept = in_valid && in_ready;
    assign in_ready = idle && (!out_valid || out_ready);
    generate
        if (PIPE == 0) begin : g_aim
            schedule #(.LINES(4), .BITS(3), .TABLE(AIM)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op({give, both, to_y}));
        end else begin : g_aim_1
            schedule #(.LINES(9), .BITS(3), .TABLE(AIM_1)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op({give, both, to_y}));
        end
    endgenerate

    wire [14:0]  used = (in_x[14:0] ^ in_x[15:1]) | (in_y[14:0] ^ in_y[15:1]);
    wire [3:0]   spare;
    wire [15:0]  mirrored;  // x without its sign bit, most significant bit first
    genvar       g;
    generate
        for (g = 0; g < 15; g = g + 1) begin : g_mirror
            assign mirrored[g] = in_x[14-g];
        end
    endgenerate
    assign mirrored[15] = 1'b0;
    reg  [3:0]   k;
    reg  [15:0]  x, y;
    reg          x_long;  // x fills its word, so the x axis is the nearer one
    reg  [15:0]  word;    // the word to shift: x, y, then m; registered for the clock frequency
    wire [15:0]  scaled;
    normalise #(.B(16)) shift (
        .in_used(used), .out_k(spare), .in_k(k), .in_x(word), .out_x(scaled));

    // One multiplier squares both coordinates, then forms m w. -w is the one's complement of w.
    wire         below = x[15] ^ y[15] ^ !x_long;
    wire [16:0]  w;
    wire [19:0]  slope;
    wire [17:0]  right = both ? {below, w ^ {17{below}}} : {{2{scaled[15]}}, scaled};
    wire [33:0]  product;
    reg  [17:0]  square;  // of x, 1.0 is 2^17
    wire [18:0]  q = {1'b0, square} + {1'b0, product[30:13]};
    reciprocal_pair inverse (.clk(clk), .in_q(q), .out_w(w), .out_slope(slope));

    wire [36:0]  other;
    reg  [26:0]  u, v;    // 24 fraction bits
    wire [53:0]  ratio;
    generate
        if (PIPE == 0) begin : g_now
            assign product = $signed(scaled) * $signed(right);
            assign other = $signed(scaled) * $signed({1'b0, slope});
            assign ratio = $signed(u) * $signed(v);
        end else begin : g_registered
            reg [15:0] left_1;
            reg [17:0] right_1;
            reg [19:0] slope_1;
            always @(posedge clk) begin
                left_1  <= scaled;
                right_1 <= right;
                slope_1 <= slope;
            end
            product_parts #(.A(16), .B(18), .MULTIPLY(MULTIPLY)) first (.clk(clk), .in_move(1'b1), .in_a(left_1),
                .in_b(right_1), .out_p(product));
            product_parts #(.A(16), .B(21), .MULTIPLY(MULTIPLY)) second (.clk(clk), .in_move(1'b1), .in_a(left_1),
                .in_b({1'b0, slope_1}), .out_p(other));
            product_parts #(.A(27), .B(27), .MULTIPLY(MULTIPLY)) third (.clk(clk), .in_move(1'b1), .in_a(u), .in_b(v),
                .out_p(ratio));
        end
    endgenerate
    wire         zero = k == 4'd15 && !x[15] && !y[15];
    assign out_take = give && !zero;
    assign out_axis = {x_long ? x[15] : y[15], !x_long};
    assign out_square = ratio[48:8];
    assign out_status = {2'd0, zero, 1'b0};
    wire   unused = &{1'b0, product[6:0], other[36:34], other[6:0], ratio[53:49], ratio[7:0]};

    always @(posedge clk) begin
        if (accept) begin
            x      <= in_x;
            y      <= in_y;
            k      <= spare;
            x_long <= in_x[15] ^ mirrored[spare];
        end
        word      <= accept ? in_x : to_y || x_long ? y : x;
        square    <= product[30:13];
        u         <= product[33:7];
        v         <= other[33:7];
        out_valid <= give || (out_valid && !out_ready);
        if (rst)
            out_valid <= 1'b0;
    end
endmodule
`default_nettype wire
