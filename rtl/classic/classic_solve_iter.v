// SPDX-License-Identifier: Apache-2.0
// Two or three joints back from the tip, by vectoring on one engine, one micro-rotation a clock. No handshake.
// JOINTS = 3: j3 = atan2(y, x), which leaves K rho in x;  then, (K rho, K z) for (x, y), r^2 = x^2 + y^2 (+ z^2):
//   phi = atan2(y, x),  h = atan2(a, b),  d = atan2(f a, b),  a^2 = far - r^2,  b^2 = r^2 - near
//   j2 = 2 h,  j1 = phi - h - d (elbow 1: -2 h, phi + h + d);  far, near = (L1 +- L2)^2,  f = (L2 - L1) / (L1 + L2)
// h is half the elbow (a, b: legs of a right triangle over 2 sqrt(L1 L2)), d by the law of tangents. The roots come
// beside the first passes. A micro-rotation is that of cordic_aim_iter without MAGNITUDE; L + 1 = W + 2 of them a pass.
// The clocks are those of the passes, 2 more, and those in which phi waits for the roots. Singular: j1 or j3 stays.
`default_nettype none
module classic_solve_iter #(
    parameter W      = 16,
    parameter A      = 16,
    parameter JOINTS = 2
) (
    input  wire           clk,
    input  wire           rst,
    input  wire           in_start,
    input  wire [2*W+1:0] in_far,
    input  wire [2*W-1:0] in_near,
    input  wire [W+3:0]   in_f,
    input  wire [W-1:0]   in_x,
    input  wire [W-1:0]   in_y,
    input  wire [W-1:0]   in_z,
    input  wire           in_elbow,
    output wire           out_busy,
    output reg            out_done,
    output reg  [A-1:0]   out_j1,
    output reg  [A-1:0]   out_j2,
    output reg  [A-1:0]   out_j3,
    output wire           out_singular,
    output wire           out_unreachable
);
    localparam G = 4;
    localparam C = (W + 1) / 2;
    localparam U = JOINTS == 3 ? C : (W + 1) / 3 + 1;  // x grows up to here; for rho as far as it has bits
    localparam L = W + 1;
    localparam B = G + C / 2;
    localparam D = W + 2 + G;  // 2 sqrt(L1 L2) * 1.6468 < 2^(W+2), sqrt(3) * 1.6468^2 * 2^(W-1) too
    localparam Y = D + 2;
    localparam Z = A + 6;
    localparam H = (L + 1) / 2;  // units that a pass of complements and shifts rounds down on the average
    localparam [31:0] GROWTH = 32'h69648523;  // 1.646760 * 2^30
    localparam [1:0] YAW = 2'd0, PHI = 2'd1, HALF = 2'd2, REST = 2'd3;

    // control: what a clock needs is made ready in the one before it
    (* fsm_encoding = "none" *) reg [4:0] next;
    (* fsm_encoding = "none" *) reg [4:0] step;
    (* fsm_encoding = "none" *) reg [1:0] by2;
    (* fsm_encoding = "none" *) reg [1:0] by6;
    (* fsm_encoding = "none" *) reg [1:0] pass;
    reg  busy, grow, tail, mirror, elbow, axis, origin, rooted, ask, second, far, near;
    wire squared, root_ready, rooting, root_done;
    wire signed [31:0] at = {27'd0, next};
    wire last = busy && next == 5'd0;
    wire wait_for_roots = last && pass == PHI && !(rooted || root_done);
    wire turn_over = last && !wait_for_roots;  // the next pass is loaded in the clock of the last step
    assign out_busy = busy || out_done;
    always @(posedge clk) begin
        busy     <= !rst && (in_start || (busy && !(last && pass == REST)));
        out_done <= !rst && last && pass == REST;
        if (!wait_for_roots) begin
            next <= rst || !(in_start || busy) || at == L || (last && pass == REST) ? 5'd0 : next + 5'd1;
            step <= next;
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
            grow <= at <= U;
            tail <= at > C;
        end
        if (in_start) begin
            pass   <= JOINTS == 3 ? YAW : PHI;
            mirror <= in_x[W-1];
            elbow  <= in_elbow;
            axis   <= {in_x, in_y} == {2*W{1'b0}};
            origin <= {in_x, in_y, in_z} == {3*W{1'b0}};
        end else if (turn_over) begin
            pass   <= pass + 2'd1;
            mirror <= pass != YAW && !elbow;  // of h and d the angle is subtracted
        end
    end

    // squares and roots: of far - r^2 first, then of r^2 - near, each 0 where it would be negative
    reg  [2*W-1:0]      q;
    wire [2*W+2:0]      to_far = {1'b0, in_far} - {3'd0, q};
    wire [2*W:0]        from_near = {1'b0, q} - {1'b0, in_near};
    wire [2*W+1:0]      radicand = second ? {2'b00, from_near[2*W-1:0] & {2*W{!from_near[2*W]}}}
                                          : to_far[2*W+1:0] & {(2*W+2){!to_far[2*W+2]}};
    wire [W+G:0]        root;
    wire [W+G+1:0]      unused_rem;
    reg  [W+G:0]        a;
    wire signed [W-1:0] x0 = in_x, y0 = in_y;
    wire                accept = ask && root_ready;
    isqrt_iter #(.W(2 * W + 2), .F(G), .R(2)) roots (.clk(clk), .rst(rst), .in_valid(ask), .in_ready(root_ready),
        .in_d(radicand), .out_valid(rooting), .out_ready(1'b1), .out_root(root), .out_rem(unused_rem));
    assign root_done = rooting && !ask;
    always @(posedge clk) begin
        ask    <= !rst && (squared || (ask && !(accept && second)));
        second <= !in_start && (second || accept);
        rooted <= !in_start && (rooted || root_done);
        if (accept && !second) far <= to_far[2*W+2];
        if (accept && second) {near, a} <= {from_near[2*W], root};
    end
    assign out_unreachable = far || near;
    assign out_singular = axis;

    // products
    reg  signed [D+1:0] product;
    reg  signed [W+G+1:0]   short;
    reg  signed [W+3:0]     factor;
    wire signed [2*W+G+5:0] whole = short * factor;
    wire                    unused_low = &{1'b0, whole[W+1:0]};
    generate
        if (JOINTS == 2) begin : g_plane
            wire unused = &{1'b0, in_z};
            assign squared = in_start;
            always @* {short, factor} = {1'b0, a, in_f};
            always @(posedge clk) if (in_start) q <= x0 * x0 + y0 * y0;
        end else begin : g_yaw
            reg  signed [W-1:0] height;
            wire [2*W-1:0]      square = height * height;
            reg                 add;
            assign squared = add;
            always @(posedge clk) begin
                short  <= pass == YAW ? {{2{height[W-1]}}, height, {G{1'b0}}} : {1'b0, a};
                factor <= pass == YAW ? GROWTH[31 -: W+4] : in_f;
                add <= in_start;
                if (in_start) height <= in_z;
                if (in_start) q <= x0 * x0 + y0 * y0;
                else if (add) q <= q + square;
            end
        end
    endgenerate
    always @(posedge clk) product <= whole[2*W+G+5 -: D+2];

    // angle
    localparam [31:0] ALONE = 32 + H, LEADING = 48 + 2 * H, TRAILING = H + 16;  // half an LSB in all, and the means
    reg  [Z-1:0]    z, phi;
    wire [Z-1:0]    joint1 = phi + z;
    wire            unused_fraction = &{1'b0, joint1[5:0]};
    reg  [Y-1:0]    y;
    wire            minus = y[Y-1];
    wire [64*Z-1:0] values;  // plus, then minus: the sign is one more input of the ROM's cell
    wire [Z-1:0]    sum_z;
    genvar          g;
    generate
        for (g = 0; g < 64; g = g + 1) begin : g_word
            if (g % 32 > L) begin : g_none
                assign values[Z*g +: Z] = {Z{1'b0}};
            end else begin : g_some
                cordic_angle #(.I(g % 32), .Z(Z)) constant (.in_minus(g > 31), .out_sum(values[Z*g +: Z]));
            end
        end
    endgenerate
    assign sum_z = z + values[Z*{minus ^ mirror, step} +: Z];
    always @(posedge clk) begin
        if (in_start) z <= {in_x[W-1], {(A-2){1'b0}}, JOINTS == 3 ? ALONE[6:0] : LEADING[6:0]};
        else if (turn_over && pass == YAW) z <= {{(A-1){1'b0}}, LEADING[6:0]};
        else if (turn_over && pass == PHI) z <= {{(A+1){1'b1}}, TRAILING[4:0]};
        else if (busy && !wait_for_roots) z <= sum_z;
        if (turn_over && pass == PHI) phi <= sum_z;
        if (rst) {out_j1, out_j2, out_j3} <= {3*A{1'b0}};
        else begin
            if (turn_over && pass == YAW && !axis) out_j3 <= sum_z[Z-1:6];
            if (turn_over && pass == HALF) out_j2 <= ~sum_z[Z-2:5];
            if (out_done && !origin) out_j1 <= joint1[Z-1:6];
        end
    end

    // vector
    reg         [D-1:0] x;
    reg  signed [Y-1:0] y2;
    reg         [D-1:0] y6;
    wire        [D-1:0] sum_x = x + (y6 ^ {D{minus}});
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
    end
    always @(posedge clk) begin
        if (in_start) x <= {2'b00, in_x ^ {W{in_x[W-1]}}, {G{in_x[W-1]}}};
        else if (turn_over && pass != YAW) x <= {1'b0, root};  // it stays, as no third radicand is asked for
        else if (grow) x <= sum_x;
        if (in_start) y <= {{4{in_y[W-1]}}, in_y, {(G-1){1'b0}}, 1'b1};  // the one's complements' mean, taken out
        else if (turn_over) y <= pass == PHI ? {3'b000, a} : product;
        else if (busy && !wait_for_roots) y <= sum_y << 1;
    end
endmodule
`default_nettype wire
