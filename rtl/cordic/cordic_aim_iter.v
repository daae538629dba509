// SPDX-License-Identifier: Apache-2.0
// Vectoring engine: turns (in_x, in_y) onto the x axis, one micro-rotation a clock. No handshake.
//   i = 0 .. L:   x += d y >> 2i (up to i = U),  y = 2 (y - d x),  angle += d atan 2^-i,  d = sign of y, -1 or 1
// y is scaled by 2^i: it needs no shifter and loses nothing. From i = C + 1 on x stands still, so that this is a
// division, and the low B bits of x are left out. x < 0 is mirrored first. Minus is the one's complement.
// With MAGNITUDE the adder of x, free from then on, takes out the gain: v = x +- (v >> 2 or 3) seven times, a Horner
// scheme of 1.214509 = 2 * 0.607254, then the rounding. Without it U is smaller: the angle needs no more.
// in_hold with in_start: the angle is to stay what it was, 0 after a reset.
// STEPS clocks after in_start out_done is high for one clock; the results are final from the next one on.
`default_nettype none
module cordic_aim_iter #(
    parameter W         = 16,
    parameter A         = 16,
    parameter G         = 4,
    parameter MAGNITUDE = 1
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_start,
    input  wire         in_hold,
    input  wire [W-1:0] in_x,
    input  wire [W-1:0] in_y,
    output reg          out_busy,
    output wire         out_done,
    output wire [W-1:0] out_magnitude,
    output wire [A-1:0] out_angle
);
    localparam C = (W + 1) / 2;
    localparam U = MAGNITUDE ? C : (W + 1) / 3;
    localparam L = MAGNITUDE ? C + 8 : W;
    localparam STEPS = L + 1;
    localparam B = G + C / 2;
    localparam D = W + 1 + G;  // sqrt(2) * 1.6468 * 2^(W-1)
    localparam Y = D + 2;      // |y| < 2 x
    localparam Z = A + 5;

    // control: what a step needs is made ready in the clock before it
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
        grow <= at <= U || (MAGNITUDE && at == C + 7);  // at last v, to be rounded: the last y is not looked at
        move <= at <= U || (MAGNITUDE && at <= C + 8);
        tail <= at > C;
        own  <= !MAGNITUDE || at <= C ? 2'd0 : at == C + 8 ? 2'd3
                : at == C + 2 || at == C + 3 || at == C + 7 ? 2'd1 : 2'd2;
        less <= at == C + 3 || at == C + 6;
        if (in_start) {mirror, hold} <= {in_x[W-1], in_hold};
    end

    // angle
    reg         [Y-1:0]    y;
    reg         [Z-1:0]    z;
    wire        [64*Z-1:0] values;  // plus, then minus: the sign is one more input of the ROM's cell
    wire                   minus = y[Y-1];
    genvar g;
    generate
        for (g = 0; g < 64; g = g + 1) begin : g_word
            if (g % 32 > L) begin : g_none
                assign values[Z*g +: Z] = {Z{1'b0}};
            end else begin : g_some
                cordic_angle #(.I(g % 32), .Z(Z)) constant (.in_minus(g > 31), .out_sum(values[Z*g +: Z]));
            end
        end
    endgenerate
    always @(posedge clk)
        if (rst) z <= {Z{1'b0}};
        else if (in_start && !in_hold) z <= {in_x[W-1], {(A-1){1'b0}}, 5'd24};  // half an LSB, 8 units for complements
        else if (out_busy && !hold) z <= z + values[Z*{minus ^ mirror, step} +: Z];
    assign out_angle = z[Z-1:5];

    // vector
    reg         [D-1:0] x, v;
    reg  signed [Y-1:0] y2;
    reg         [D-1:0] y6, term;
    wire        [D-1:0] round = {{(D-5){1'b0}}, 5'd21};
    wire        [D-1:0] sum_v = x + (term ^ {D{own == 2'd0 ? minus : less}});
    wire        [Y-1:0] sum_y = y + (({2'b00, x} ^ {Y{!minus}}) & {{(Y-B){1'b1}}, {B{!tail}}});
    always @* begin
        case (by2)
            2'd0: y2 = y;
            2'd1: y2 = $signed(y) >>> 2;
            2'd2: y2 = $signed(y) >>> 4;
            default: y2 = {Y{1'bx}};
        endcase
        case (by6)
            2'd0: y6 = y2[D-1:0];
            2'd1: y6 = {{4{y2[Y-1]}}, y2[Y-1:6]};
            2'd2: y6 = {{10{y2[Y-1]}}, y2[Y-1:12]};
            default: y6 = {D{1'bx}};
        endcase
        case (own)
            2'd0: term = y6;
            2'd1: term = v >> 2;
            2'd2: term = v >> 3;
            2'd3: term = round;
        endcase
    end
    always @(posedge clk) begin
        if (in_start) y <= {{3{in_y[W-1]}}, in_y, {(G-1){1'b0}}, 1'b1};  // the one's complements' mean, taken out
        else if (out_busy) y <= sum_y << 1;
        if (in_start) x <= {1'b0, in_x ^ {W{in_x[W-1]}}, {G{in_x[W-1]}}};
        else if (grow) x <= sum_v;
        if (in_start) v <= {1'b0, in_x ^ {W{in_x[W-1]}}, {G{in_x[W-1]}}};
        else if (out_busy && move) v <= sum_v;
    end
    assign out_magnitude = v[D-1 -: W];
endmodule
`default_nettype wire
