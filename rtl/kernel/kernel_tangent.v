// SPDX-License-Identifier: Apache-2.0
// Direction of a point (x, y) as an axis and the tangent of the angle from it, anticlockwise.
//   tangent = m / M about the x axis, -m / M about the y axis, M the coordinate that is longer in bits, m the other one
// Both are shifted left until M fills its word. 1/M = w * slope is the tangent to 1/M in the middle of a segment, and w
// is wiring of M, so the quotient is two products without an addend.
// Formats: in_x, in_y s16, any fraction; out_tangent s2.18; out_axis u2.0 quarter turns. Both are valid in the clock of
// out_take; out_last precedes out_valid. Error: 0.21 * 2^-14 rad of direction. Latency and II: 4 + 4 PIPE.
// Status: singular (x = y = 0; then out_take does not come, except after a reset, with axis 0 and tangent 0).
// Source: the definition; 1/M by tangents as in reciprocal_pair. Model: table.ik1
`default_nettype none
module kernel_tangent #(
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
    output wire               out_last,
    output wire [1:0]         out_axis,
    output wire [19:0]        out_tangent,
    output wire [3:0]         out_status
);
    // 2^15 / t^2 in the middle t = b / 512 of 128 segments, M from 1/2, then of 128, M from -1; then all negated.
    // Each is raised by half the error of the tangent at a border, 1 / 2b^2, and by 1 / 64b for the unit that w lacks.
    function [17:0] slope_at(input [8:0] i);
        reg [63:0] b, raised;
        begin
            b = i[7] ? 64'd511 - {56'd0, i[6:0], 1'b0} : 64'd257 + {56'd0, i[6:0], 1'b0};
            raised = (i[7] ? 64 * b - 1 : 64 * b + 1) * (2 * b * b + 1);
            raised = ((raised << 27) / (b * b * b) / (b * b) + 1) >> 1;
            slope_at = i[8] ? -raised[17:0] : raised[17:0];
        end
    endfunction
    reg [17:0] slopes[0:511];
    integer    i;
    initial
        for (i = 0; i < 512; i = i + 1)
            slopes[i] = slope_at(i[8:0]);

    // Schedule, a clock a line
    localparam [3:0]
        NONE  = 4'b0000,  // nothing, or what every clock does
        LONG  = 4'b0001,  // shift the longer coordinate
        SHORT = 4'b0010,  // shift the other one, times w
        GIVE  = 4'b0100,  // times the slope, the tangent
        LAST  = 4'b1000;  // the codec's word is valid in the next clock
    //                       work
    localparam [3*4-1:0] AIM = {
        /* 1 M           */ {LONG},
        /* 2 m w         */ {SHORT},
        /* 3 m w slope   */ {GIVE | LAST}};
    // PIPE = 1: registers behind m, slope and both products; the codec has two more
    localparam [7*4-1:0] AIM_1 = {
        /* 1 M           */ {LONG},
        /* 2 m; slope    */ {SHORT},
        /* 3 m w         */ {NONE},
        /* 4 m w slope   */ {NONE},
        /* 5 tangent     */ {GIVE},
        /* 6 chord       */ {NONE},
        /* 7 rise        */ {LAST}};
    wire   long, short, give, last, idle;
    assign out_last = last;
    wire   accept = in_valid && in_ready;
    assign in_ready = idle && (!out_valid || out_ready);
    generate
        if (PIPE == 0) begin : g_aim
            schedule #(.LINES(3), .BITS(4), .TABLE(AIM)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op({last, give, short, long}));
        end else begin : g_aim_1
            schedule #(.LINES(7), .BITS(4), .TABLE(AIM_1)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op({last, give, short, long}));
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
    reg          x_long, zero;
    reg          fresh;   // no direction since reset: the origin gives axis 0 and tangent 0
    wire [15:0]  scaled;
    normalise #(.B(16)) shift (.in_used(used), .out_k(spare), .in_k(k), .in_x(x_long == short ? y : x), .out_x(scaled));

    reg  [15:0]  w;       // of M, less one unit
    reg  [17:0]  slope;
    reg  [19:0]  factor;  // m w
    wire         same;
    wire [10:0]  low;
    wire [19:0]  first;
    wire [1:0]   above;  // copies of the sign
    wire [15:0]  below;
    generate
        if (PIPE == 0) begin : g_now
            assign {same, first, low} = $signed(scaled) * $signed(w);
            assign {above, out_tangent, below} = $signed(factor) * $signed(slope);
        end else begin : g_registered
            reg [15:0] m;
            reg [17:0] slope_1;
            assign     {same, first, low} = $signed(m) * $signed(w);
            product_parts #(.A(20), .B(18), .MULTIPLY(MULTIPLY)) parts (.clk(clk), .in_move(1'b1), .in_a(factor),
                .in_b(slope_1), .out_p({above, out_tangent, below}));
            always @(posedge clk) begin
                m       <= scaled;
                slope_1 <= slope;
            end
        end
    endgenerate

    assign out_take = give && (!zero || fresh);
    assign out_axis = {x_long ? x[15] : y[15], !x_long && !zero};
    assign out_status = {2'd0, zero, 1'b0};
    wire   unused = &{1'b0, same, low, above, below};

    always @(posedge clk) begin
        if (accept) begin
            x      <= in_x;
            y      <= in_y;
            k      <= spare;
            x_long <= in_x[15] ^ mirrored[spare];
            zero   <= used == 0 && !in_x[15] && !in_y[15];
        end
        if (long) begin
            slope <= slopes[{!x_long, scaled[15], scaled[13:7]}];
            w     <= {scaled[15:7], ~scaled[6:0]};
        end
        factor <= first;  // the product of SHORT, for the next clock; 0 at the origin
        out_valid <= last || (out_valid && !out_ready);
        if (out_take)
            fresh <= 1'b0;
        if (rst) begin
            fresh     <= 1'b1;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
