// SPDX-License-Identifier: Apache-2.0
// This engine rotates (in_x, in_y) onto the x axis, one micro-rotation a clock. It has no handshake.
//   i = 0 .. L:   x += d y >> 2i (up to i = U),  y = 2 (y - d x),  angle += d atan 2^-i,  d = sign of y, -1 or 1
// y is scaled by 2^i, so it needs no shifter and loses no bit. From i = C + 1 on x is constant, and the steps divide,
// without the low B bits of x. A negative x is mirrored first. Minus is the one's complement.
// With MAGNITUDE the adder of x then removes the gain by a Horner scheme of 1.214509 = 2 * 0.607254: seven times
// v = x +- (v >> 2 or 3), then it rounds. Without MAGNITUDE U is smaller, because the angle alone needs no more.
// If in_hold is high with in_start the angle is held; it is 0 after a reset.
// out_done is high for one clock, STEPS clocks after in_start; the results are valid from the next clock on.
// Error at W = A = 16: magnitude 1 LSB and angle 0.84 LSB + 0.24 rad LSB / length with MAGNITUDE and G = 4; angle
// 0.88 LSB + 0.39 rad LSB / length without, G = 3. Model: cordic.aim
`default_nettype none
module cordic_aim_iter #(
    parameter W         = 16,  // bits of a coordinate, 8 to 24, with MAGNITUDE to 16 (default 16)
    parameter A         = 16,  // bits of an angle, a turn is 2^A, 4 to 24 (default 16)
    parameter G         = 4,   // guard bits, 3 or more (default 4: a magnitude within 1 LSB; the angle alone needs 3)
    parameter MAGNITUDE = 1    // 1 (default): also the length, its gain removed; 0: the angle alone, in fewer steps
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_start,
    input  wire                in_hold,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output reg                 out_busy,
    output wire                out_done,
    output wire        [W-1:0] out_magnitude,
    output wire        [A-1:0] out_angle
);
    localparam C = (W + 1) / 2;
    localparam U = MAGNITUDE ? C : (W + 1) / 3;
    localparam L = MAGNITUDE ? C + 8 : W;
    localparam STEPS = L + 1;
    localparam B = G + C / 2;
    localparam D = W + 1 + G;  // sqrt(2) * 1.6468 * 2^(W-1)
    localparam Y = D + 2;      // |y| < 2 x
    localparam Z = A + 5;

    // control: the signals of a step are prepared in the clock before it
    (* fsm_encoding = "none" *) reg [4:0] next;
    (* fsm_encoding = "none" *) reg [4:0] step;
    (* fsm_encoding = "none" *) reg [1:0] by2;
    (* fsm_encoding = "none" *) reg [1:0] by6;
    (* fsm_encoding = "none" *) reg [1:0] own;  // 0: shifted y, 1: v >> 2, 2: v >> 3, 3: the rounding
    reg  grow, move, tail, less, mirror, hold;
    wire signed [31:0] at = {27'd0, next};
    assign out_done = out_busy && at == STEPS;
    always @(posedge clk) begin
        next     <= !rst && (in_start || (out_busy && !out_done)) ? next + 5'd1 : 5'd0;
        out_busy <= !rst && (in_start || (out_busy && !out_done));
        step     <= next;
        case (next)
            5'd0:    {by6, by2} <= 4'b0000;
            5'd1:    {by6, by2} <= 4'b0001;
            5'd2:    {by6, by2} <= 4'b0010;
            5'd3:    {by6, by2} <= 4'b0100;
            5'd4:    {by6, by2} <= 4'b0101;
            5'd5:    {by6, by2} <= 4'b0110;
            5'd6:    {by6, by2} <= 4'b1000;
            5'd7:    {by6, by2} <= 4'b1001;
            default: {by6, by2} <= 4'b1010;
        endcase
        grow <= at <= U || (MAGNITUDE && at == C + 7);  // at last x loads v for rounding; the last y is not used
        move <= at <= U || (MAGNITUDE && at <= C + 8);
        tail <= at > C;
        own  <= !MAGNITUDE || at <= C ? 2'd0 : at == C + 8 ? 2'd3
                : at == C + 2 || at == C + 3 || at == C + 7 ? 2'd1 : 2'd2;
        less <= at == C + 3 || at == C + 6;
        if (in_start) {mirror, hold} <= {in_x[W-1], in_hold};
    end

    // micro-rotation
    reg         [D-1:0] x, v, term;
    reg  signed [Y-1:0] y;
    reg         [Z-1:0] z;
    wire        [D-1:0] shifted;
    wire signed [Y-1:0] next_y;
    wire        [Z-1:0] next_z;
    wire                minus;
    cordic_aim_step #(.D(D), .Z(Z), .L(L), .B(B)) micro (.in_x(x), .in_y(y), .in_z(z), .in_step(step), .in_by2(by2),
        .in_by6(by6), .in_mirror(mirror), .in_divide(tail), .out_minus(minus), .out_shifted(shifted), .out_y(next_y),
        .out_z(next_z));

    // angle
    always @(posedge clk)
        if (rst) z <= {Z{1'b0}};
        else if (in_start && !in_hold) z <= {in_x[W-1], {(A-1){1'b0}}, 5'd24};  // half an LSB, 8 for the complements
        else if (out_busy && !hold) z <= next_z;
    assign out_angle = z[Z-1:5];

    // vector
    wire [D-1:0] round = {{(D-5){1'b0}}, 5'd21};
    wire [D-1:0] sum = x + (term ^ {D{own == 2'd0 ? minus : less}});
    always @*
        case (own)
            2'd0: term = shifted;
            2'd1: term = v >> 2;
            2'd2: term = v >> 3;
            2'd3: term = round;
        endcase
    always @(posedge clk) begin
        if (in_start) y <= {{3{in_y[W-1]}}, in_y, {(G-1){1'b0}}, 1'b1};  // removes the mean of the one's complements
        else if (out_busy) y <= next_y;
        if (in_start) x <= {1'b0, in_x ^ {W{in_x[W-1]}}, {G{in_x[W-1]}}};
        else if (grow) x <= sum;
        if (out_busy && move) v <= sum;  // for the first time in the clock after in_start
    end
    assign out_magnitude = v[D-1 -: W];
endmodule
`default_nettype wire
