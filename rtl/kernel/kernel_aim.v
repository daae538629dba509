// SPDX-License-Identifier: Apache-2.0
// Direction of (x, y), given about its nearer axis: the square of the sine between them, without a length or an angle.
//   square = m^2 / q, q = x^2 + y^2, m the coordinate across the axis; both are shifted left until 1/4 <= q <= 2
// Formats: in_x, in_y s16, any fraction; out_axis u2.0 quarter turns, out_below: the direction lies clockwise of it;
// out_square u1.40, always below 1. The three belong together in the clock of out_take, one before out_valid rises.
// Error: direction within 0.6 * 2^-14 rad. The x axis is taken where x fills its word: the square may reach 0.8.
// Latency 4, II 4.
// Status: singular (x = y = 0: out_take does not come).
// Source: rational trigonometry paper, eq. 9. Model: rational.ik1
`default_nettype none
module kernel_aim (
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
    output wire               out_below,
    output wire [40:0]        out_square,
    output wire [3:0]         out_status
);
    // Schedule. start: y k m2 x_near x_left y_left zero <- in_x in_y
    localparam [2:0]
        SUM   = 3'b001,  // m2 x_near both_one chord <- y k m2 x_near: square y, q = x^2 + y^2, read the chord of 1/q
        CHORD = 3'b010,  // reciprocal <- chord: interpolate 1/q
        GIVE  = 3'b100;  // - <- m2 reciprocal x_near x_left y_left both_one zero: the direction goes out
    //              work
    localparam [3*3-1:0] AIM = {
        /* 1 y^2 */ {SUM},
        /* 2 1/q */ {CHORD},
        /* 3 m^2 */ {GIVE}};
    wire   sum, interpolate, give, idle;
    wire   accept = in_valid && in_ready;
    assign in_ready = idle && (!out_valid || out_ready);
    schedule #(.LINES(3), .BITS(3), .TABLE(AIM)) control (
        .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op({give, interpolate, sum}));

    // x is shifted in the accepting clock, by the count as it is found, y in the next
    wire [14:0]  used = (in_x[14:0] ^ in_x[15:1]) | (in_y[14:0] ^ in_y[15:1]);
    reg  [15:0]  y;
    wire [3:0]   spare;
    reg  [3:0]   k;
    wire [15:0]  scaled;
    normalise #(.B(16), .LATE(1)) shift (
        .in_used(used), .out_k(spare), .in_k(sum ? k : spare), .in_x(sum ? y : in_x), .out_x(scaled));

    // One multiplier squares both coordinates, then interpolates
    wire [17:0]  knot;
    wire [11:0]  step;
    wire [7:0]   offset;
    wire [15:0]  left = interpolate ? {8'd0, offset} : scaled;
    wire [15:0]  right = interpolate ? {4'd0, step} : scaled;
    wire [31:0]  product = $signed(left) * $signed(right);
    wire [27:0]  square = product[30:3];

    reg  [27:0]  m2;              // x^2, then the smaller square; 1.0 is 2^27
    wire [17:0]  q = {1'b0, m2[27:11]} + {1'b0, square[27:11]};
    reg          x_left, y_left;  // negative
    reg          x_near;          // the x axis is the nearer one: |x| >= 1/2 and y is not -1
    reg          zero;            // x = y = 0
    reg          both_one;        // x = y = -1, the one case where m^2 is 1.0: m2 holds 0, and the square is 1/2
    reciprocal_chord inverse (.clk(clk), .in_q(q[16:0]), .out_knot(knot), .out_step(step), .out_offset(offset));
    reg  [17:0]  reciprocal;      // a constant 1 behind it centres what truncation loses

    wire [45:0]  ratio = m2[26:0] * {reciprocal, 1'b1};  // below 1, of 44 fraction bits
    assign out_take = give && !zero;
    assign out_axis = {x_near ? x_left : y_left, !x_near};
    assign out_below = x_left ^ y_left ^ !x_near;
    assign out_status = {2'd0, zero, 1'b0};
    assign out_square = {1'b0, ratio[43] ^ both_one, ratio[42:4]};
    wire   unused = &{1'b0, product[31], product[2:0], ratio[45:44], ratio[3:0]};

    always @(posedge clk) begin
        y          <= in_y;
        k          <= spare;
        reciprocal <= knot + {6'h3f, ~product[19:8]};
        if (accept) begin
            x_left <= in_x[15];
            y_left <= in_y[15];
            zero   <= used == 0 && !in_x[15] && !in_y[15];
        end
        if (accept || sum)
            x_near <= sum ? x_near && !square[27] : scaled[15] ^ scaled[14];
        if (accept || (sum && x_near && !square[27]))
            m2 <= square;
        if (sum)
            both_one <= q[17];
        out_valid <= give || (out_valid && !out_ready);
        if (rst)
            out_valid <= 1'b0;
    end
endmodule
`default_nettype wire
