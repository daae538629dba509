// SPDX-License-Identifier: Apache-2.0
// Datapath of kernel_solve, whose table says what happens when: in_op is one line of it, column by column.
// Ports, formats and models as in kernel_solve; in_start: in_x, in_y, in_z, in_elbow are taken at the end of the clock.
// Inside: x, y, z, q are exact; a shifted word is s17.4, left s7.20. A constant 1 below a word centres its truncation.
`default_nettype none
module kernel_solve_path #(
    parameter JOINTS = 2  // 2: in the plane, in_z is not used; 3: in space. 2, the smaller one
) (
    input  wire               clk,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire [32:0]        cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [1:0]         cfg_e,
    input  wire               in_start,
    input  wire [33:0]        in_op,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire signed [15:0] in_z,
    input  wire               in_elbow,
    output wire [JOINTS-1:0]  out_take,
    output wire [1:0]         out_axis,
    output wire               out_below,
    output wire [40:0]        out_square,
    output wire [3:0]         out_status
);
    localparam YAW = JOINTS == 3;
    wire [2:0] pass;
    wire [3:0] left_from, right_from;
    wire       to_flat, to_clamp, to_zero, to_one, to_k2, to_k1, to_xs, to_ys;
    wire       j1, j3, j2, far, bend, b, a, arm, cos, recip, sign, quad, base, count, collect;
    assign {pass, to_flat, to_clamp, to_zero, to_one, to_k2, to_k1, to_xs, to_ys, left_from, right_from,
            j1, j3, j2, far, bend, b, a, arm, cos, recip, sign, quad, base, count, collect} = in_op;

    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [26:0] left;
    wire [53:0]        product;
    wire [33:0]        sum;
    wire [20:0]        inverse_w, q_near;
    wire [2:0]         take;
    /* verilator lint_on UNUSEDSIGNAL */

    // Coordinates and the shifter; a redundant sign bit is counted where all words agree
    reg  signed [15:0] x, y, z;
    reg  [3:0]         k;
    reg  [14:0]        used;
    reg  [20:0]        reach;  // k1
    reg  [20:0]        raw;
    wire [20:0]        word;
    always @*
        case ({pass[1] || !YAW && pass[2], pass[0]})
            2'd3: raw = {x[15], x, 4'd0};
            2'd2: raw = {y[15], y, 4'd0};
            2'd1: raw = {left[22:3], 1'b1};
            default: raw = YAW && pass[2] ? {z[15], z, 4'd0} : {reach[19:0], 1'b1};
        endcase
    wire [14:0] used_now = used | (raw[19:5] ^ raw[18:4]);
    wire [3:0]  spare;
    normalise #(.B(21)) shift (
        .in_used(YAW ? used : used_now), .out_k(spare), .in_k(k), .in_x(raw), .out_x(word));

    reg         elbow, on_axis, at_base;
    reg         clamped;         // out of reach: c2 = +-1 and k2 = 0; k1 = +-1 will do, and m^2 / q' for (m / q')^2
    reg         flat;            // c2 = +-1, k2 = 0: the root of 1 - c2^2 would read 1 for c2 = -1
    reg         beyond;          // the shifter of the gap lost its upper bits
    reg         obtuse;          // the gap is negative, c2 too
    reg         a_left, b_left, x_near;  // a < 0, b < 0, the x axis is the nearer one: m is a
    reg  [31:0] q;               // x^2 + y^2 (+ z^2)
    kernel_solve_turn #(.X(YAW ? 1 : 0)) turn (
        .clk(clk), .in_word(word), .in_ys(to_ys), .in_xs(to_xs), .in_k1(to_k1), .in_k2(to_k2), .in_one(to_one),
        .in_zero(to_zero), .in_clamp(to_clamp && clamped), .in_sign(reach[20]), .in_flat(to_flat && flat),
        .in_minus(bend && (a ^ elbow)), .out_sum(sum));

    // 1/q' = inverse_w * inverse_slope; q' has 19 fraction bits
    wire [21+YAW:0] inverse_slope;
    reciprocal_product #(.TOP(YAW)) inverse (
        .clk(clk), .in_read(recip), .in_q(sum[31:11]), .out_q(q_near), .out_w(inverse_w), .out_slope(inverse_slope));

    wire signed [26:0] n;
    wire               gap_beyond, gap_negative;
    kernel_solve_gap numerator (
        .cfg_q(cfg_q), .cfg_e(cfg_e), .in_q(q), .out_n(n), .out_beyond(gap_beyond), .out_negative(gap_negative));

    // n2 = sqrt(1 - c2^2), or sqrt(q / 2^32), sqrt(q / 2^24) where q is not big: root_w * root_slope
    wire        big = q[31:24] != 0;
    wire [18:0] root_w;
    wire [19:0] root_slope;
    root_product #(.S(24), .B(20)) chord (
        .clk(clk), .in_read(j2 || j3), .in_not(!j3), .in_v(j3 ? big ? q[31:8] : q[23:0] : product[39:16]),
        .out_w(root_w), .out_slope(root_slope));

    // b becomes m where |a| > q' / 2, roughly
    wire [7:0]  a_size = left[21:14] ^ {8{left[22]}};
    wire        steep = a_size[7] || a_size[6:0] > q_near[20:14];
    wire        outside;
    kernel_solve_scale #(.YAW(YAW)) scale (
        .clk(clk), .cfg_l2(cfg_l2), .cfg_r(cfg_r), .in_left(left_from), .in_right(right_from),
        .in_keep_left(b && !steep), .in_keep_right(far && clamped), .in_c2(cos), .in_beyond(beyond),
        .in_negative(obtuse), .in_n(n), .in_w(root_w), .in_slope(root_slope), .in_w_q(inverse_w),
        .in_slope_q(inverse_slope), .in_sum(sum[32:10]), .in_big(big), .out_left(left), .out_product(product),
        .out_outside(outside));

    // c2 is the coordinate across the quarter turns, the axes of joint 2
    assign      take = {j3 && !on_axis, j2, j1 && !at_base};
    assign      out_take = take[JOINTS-1:0];
    assign      out_axis = j2 ? {elbow, 1'b1} : {x_near ? b_left : a_left, !x_near};
    assign      out_below = j2 ? obtuse == elbow : a_left ^ b_left ^ !x_near;
    assign      out_square = product[40:0];
    assign      out_status = {2'd0, on_axis, clamped};

    always @(posedge clk) begin
        if (in_start) begin
            x     <= in_x;
            y     <= in_y;
            z     <= in_z;
            elbow <= in_elbow;
            k     <= 4'd0;
            q     <= 32'd0;
            used  <= 15'd0;
        end
        if (collect)
            used <= used_now;
        if (count)
            k <= spare;
        if (to_one)
            k <= 4'd0;
        if (base)
            on_axis <= used == 0 && !x[15] && !y[15];
        if (quad)
            q <= sum[31:0] + (YAW ? q : 32'd0);
        if (sign) begin
            at_base <= on_axis && !(YAW && z != 0);
            beyond  <= gap_beyond;
            obtuse  <= gap_negative;
        end
        if (cos)
            clamped <= outside;
        if (arm)
            reach <= {2'd0, cfg_l1, 3'd0} + product[46:26];
        if (j2)
            flat <= product[40];
        if (a)
            a_left <= sum[32];
        if (b) begin
            b_left <= sum[32];
            x_near <= !steep;
        end
    end
endmodule
`default_nettype wire
