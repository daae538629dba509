// SPDX-License-Identifier: Apache-2.0
// This engine computes the vectorings of classic_solve_iter: it holds their vector and angle and loads each start.
// A micro-rotation is that of cordic_aim_step; in_grow changes x too. With in_to_* it is the last one, and the next
// vectoring is loaded.
// After in_to_half and in_to_rest (h and d) the angle is subtracted, with elbow 1 added. h continues as h + d.
// Formats: in_a, in_b and in_product have 4, 4 and 5 guard bits; a turn of out_z and of out_next, its next value, is
// 2^(A+6).
// Error of the angle at W = A = 16: 1.73e-5 rad + 0.24 rad LSB / length. Model: classic.ik2, classic.ik3
`default_nettype none
module classic_aim_iter #(
    parameter W      = 16,  // bits of a coordinate, 8 to 24 (default 16)
    parameter A      = 16,  // bits of an angle, a turn is 2^A, 4 to 24 (default 16)
    parameter JOINTS = 2    // 2 (default): in the plane; 3: in space, the yaw comes first
) (
    input  wire                clk,
    input  wire                in_start,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire                in_elbow,
    input  wire        [W+4:0] in_a,
    input  wire        [W+4:0] in_b,
    input  wire signed [W+7:0] in_product,
    input  wire                in_turn,
    input  wire                in_grow,
    input  wire                in_divide,
    input  wire                in_to_phi,
    input  wire                in_to_half,
    input  wire                in_to_rest,
    output wire        [A+5:0] out_z,
    output wire        [A+5:0] out_next
);
    localparam G = 4;
    localparam D = W + 2 + G;  // 2 sqrt(L1 L2) * 1.6468 < 2^(W+2), sqrt(3) * 1.6468^2 * 2^(W-1) too
    localparam Y = D + 2;
    localparam Z = A + 6;
    localparam L = W + 1;
    localparam U = JOINTS == 3 ? (W + 1) / 2 : (W + 1) / 3 + 1;

    reg         [D-1:0] x;
    reg  signed [Y-1:0] y;
    reg         [Z-1:0] z;
    reg                 mirror, elbow;  // mirror is high while the angle is subtracted
    reg         [4:0]   step;           // step is i; 3 by6 + by2 counts with it up to U, where x is constant
    reg         [1:0]   by2, by6;
    wire        [D-1:0] shifted;
    wire signed [Y-1:0] next_y;
    wire                minus;
    wire                over = in_to_phi || in_to_half || in_to_rest;
    cordic_aim_step #(.D(D), .Z(Z), .U(U), .L(L), .B(G + (W + 1) / 4)) micro (.in_x(x), .in_y(y), .in_z(z),
        .in_step(step), .in_by2(by2), .in_by6(by6), .in_mirror(mirror), .in_divide(in_divide), .out_minus(minus),
        .out_shifted(shifted), .out_y(next_y), .out_z(out_next));
    assign out_z = z;
    wire        [3:0]   later = U < 9 ? 4'b1010 : step == 5'd7 ? 4'b1010 : step == 5'd8 ? 4'b1100
                                : step == 5'd9 ? 4'b1101 : step == 5'd10 ? 4'b1110 : 4'b1111;
    always @(posedge clk)
        if (in_start || over) {step, by6, by2} <= 9'd0;
        else if (in_turn) begin
            step <= step + 5'd1;
            case (step)
                5'd0:    {by6, by2} <= 4'b0001;
                5'd1:    {by6, by2} <= 4'b0010;
                5'd2:    {by6, by2} <= 4'b0100;
                5'd3:    {by6, by2} <= 4'b0101;
                5'd4:    {by6, by2} <= 4'b0110;
                5'd5:    {by6, by2} <= 4'b1000;
                5'd6:    {by6, by2} <= 4'b1001;
                default: {by6, by2} <= U > 8 ? later : 4'b1010;
            endcase
        end

    // the angle starts with half an LSB and the mean of what the complements and shifts of a vectoring round down
    localparam H = (L + 1) / 2;
    localparam [31:0] ALONE = 32 + H, LEADING = 48 + 2 * H, TRAILING = H + 16;
    always @(posedge clk) begin
        if (in_start) {mirror, elbow} <= {in_x[W-1], in_elbow};
        else if (over) mirror <= !in_to_phi && !elbow;
        if (in_start) x <= {2'b00, in_x ^ {W{in_x[W-1]}}, {G{in_x[W-1]}}};
        else if (in_to_half || in_to_rest) x <= {1'b0, in_b};
        else if (in_grow) x <= x + (shifted ^ {D{minus}});
        if (in_start) y <= {{4{in_y[W-1]}}, in_y, {(G-1){1'b0}}, 1'b1};  // removes the mean of the complements
        else if (over) y <= in_to_half ? {3'b000, in_a} : in_product;
        else if (in_turn) y <= next_y;
        if (in_start) z <= {in_x[W-1], {(A-2){1'b0}}, JOINTS == 3 ? ALONE[6:0] : LEADING[6:0]};
        else if (in_to_phi) z <= {{(A-1){1'b0}}, LEADING[6:0]};
        else if (in_to_half) z <= {{(A+1){1'b1}}, TRAILING[4:0]};
        else if (in_turn) z <= out_next;
    end
endmodule
`default_nettype wire
