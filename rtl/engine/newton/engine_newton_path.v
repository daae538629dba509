// SPDX-License-Identifier: Apache-2.0
// Three multipliers of engine_newton_3r: from table segments to sines, the error E of the wrist, its square, and the
// steps. With E seen along (u) and across (p) link 1 and both joints, d1 = (D u12 + lambda p1) / (D^2 + mu) l1 and d12
// = (lambda p12 - D u1) / (D^2 + mu) l2. The first two products are added.
// Formats: in_chord of angle_chord, sines s1.17; lengths u16; E in 1/64 unit: fine its lower 18 bits, coarse 1/4 unit,
// saturated; square in 1/256 unit^2, coarse in unit^2; D^2 + mu u1.23, normalised by 4^j to [1/4, 2). All are
// truncated. Both steps are shifted alike: left by 2 j, but only until neither exceeds a quarter turn, or right.
// Operands are in registers: a product is complete in the clock after the line that names its factors, at PIPE = 1 a
// clock later. Error of a step: bounds.iterative.newton_step. Model: iterative.newton_fixed.solve
`default_nettype none
module engine_newton_path #(
    parameter A = 20,        // bits of a joint word, 16 to 24 (default 20)
    parameter PIPE = 0,      // registers behind products and roots, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire               clk,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire [15:0]        cfg_l3,
    input  wire [15:0]        cfg_r1,
    input  wire [15:0]        cfg_r2,
    input  wire [15:0]        cfg_lambda,
    input  wire [16:0]        cfg_mu,
    input  wire [19:0]        in_op,      // out_op of engine_newton_program
    input  wire [43:0]        in_chord,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    output wire [A-1:0]       out_step,   // step of joint 1, negated; with MOVE that of both joints
    output reg  [31:0]        out_square,
    output wire               out_fine,
    output reg                out_near    // |sin j2| < 1/16
);
    wire [1:0] left_op, right_op, third_op;
    wire       link2, link1, one, neg, rate2, unused_again, move, stop, test, det_op, sine, keep, first, tip;
    assign {link2, link1, one, neg, left_op, right_op, rate2, third_op, unused_again, move, stop, test, det_op, sine,
        keep, first, tip} = in_op;

    // Products, the later ones at PIPE = 1
    reg  signed [17:0] al, ar, bl, br;
    reg  signed [25:0] cl;
    reg  signed [20:0] cr;
    reg  signed [35:0] later_a, later_b;
    wire signed [46:0] later_c;
    wire signed [35:0] a = PIPE == 0 ? al * ar : later_a, b = PIPE == 0 ? bl * br : later_b;
    wire signed [46:0] c = PIPE == 0 ? cl * cr : later_c;
    generate
        if (PIPE == 0) begin : g_now
            assign later_c = 47'd0;  // not used
        end else begin : g_parts
            product_parts #(.A(26), .B(21), .MULTIPLY(MULTIPLY)) part_c (.clk(clk), .in_move(1'b1), .in_a(cl),
                .in_b(cr), .out_p(later_c));
        end
    endgenerate
    wire [31:0] sum = a[35:4] + b[35:4];

    // Sines and cosines
    wire [17:0] knot;
    wire [10:0] rise;
    wire [14:0] offset;
    assign {knot, rise, offset} = in_chord;
    reg  [17:0] base, later_base, later_root, c1, s1, c12, s12;
    wire [17:0] root = PIPE == 0 ? base + c[15+:18] : later_root;
    wire        close = root[17:13] == {5{root[17]}};
    wire [17:0] safe = {root[17:14], root[13] ^ (sine && close && cfg_mu[16:9] == 0), root[12:0]};
    wire [17:0] cosine = one ? c1 ^ {18{neg}} : c12;
    wire [17:0] across = one ? s1 : s12 ^ {18{neg}};
    wire [15:0] length = link2 ? cfg_l2 : link1 ? cfg_l1 : cfg_l3;
    reg  [17:0] minus;  // the one's complement of sin j2

    // Error: x and y in turn
    reg  signed [24:0] e, back;
    wire [15:0]        goal = keep ? in_y : in_x;
    wire [24:0]        from = first ? {{3{goal[15]}}, goal, 6'd0} : back;
    wire [17:0]        ex, ey;
    assign out_fine = e[24:17] == {8{e[24]}} && back[24:17] == {8{back[24]}};
    assign ex = out_fine ? back[17:0] : back[24:21] == {4{back[24]}} ? back[21:4] : {back[24], {17{!back[24]}}};
    assign ey = out_fine ? e[17:0] : e[24:21] == {4{e[24]}} ? e[21:4] : {e[24], {17{!e[24]}}};
    reg  [17:0] seen0, seen1, seen2;  // E seen along and across the links: the last three

    // 1 / (D^2 + mu)
    reg  [23:0] det;
    wire [1:0]  j = det[23:21] != 0 ? 2'd0 : det[20:19] != 0 ? 2'd1 : det[18:17] != 0 ? 2'd2 : 2'd3;
    wire [17:0] q = j[1] ? j[0] ? det[17:0] : det[19:2] : j[0] ? det[21:4] : det[23:6];
    reg  [18:0] rate;
    wire [16:0] w;
    wire [19:0] slope;
    reciprocal_pair inverse (.clk(clk), .in_q({1'b0, q}), .out_w(w), .out_slope(slope));

    // The last two steps
    reg  [42:0] made, move0, move1;  // made: of the clock before at PIPE = 1
    reg  [2:0]  shift1;
    wire [11:0] used = PIPE == 0 ? move0[41:30] ^ {12{move0[42]}} | move1[41:30] ^ {12{move1[42]}}
                     : made[41:30] ^ {12{made[42]}} | move0[41:30] ^ {12{move0[42]}};
    wire [2:0]  room = used[11:9] != 0 ? 3'd0 : used[8:7] != 0 ? 3'd1 : used[6:5] != 0 ? 3'd2 : used[4:3] != 0 ? 3'd3
                     : used[2:1] != 0 ? 3'd4 : 3'd5;
    wire [2:0]  want = {1'b0, j} + {1'b0, !out_fine, 1'b0};
    wire [2:0]  shift0 = room < want ? room : want;
    wire [2:0]  shift = move || PIPE == 1 ? shift1 : shift0;
    wire [A-1:0] low = shift[0] ? move1[41-A+:A] : move1[43-A+:A], mid = shift[0] ? move1[37-A+:A] : move1[39-A+:A];
    assign      out_step = shift[2] ? shift[0] ? move1[33-A+:A] : move1[35-A+:A] : shift[1] ? mid : low;

    wire unused = &{1'b0, unused_again, a[3:0], c[46:43], c[14:0], b[3:0], used[0], move1[16:0]};
    always @(posedge clk) begin
        later_a    <= al * ar;
        later_b    <= bl * br;
        later_base <= base;
        later_root <= later_base + c[15+:18];
        base <= knot;
        al   <= left_op[1] ? left_op[0] ? minus : cosine : left_op[0] ? ex : root;
        bl   <= left_op[1] ? left_op[0] ? {2'd0, cfg_lambda} : across : left_op[0] ? ey : safe;
        ar   <= right_op[1] ? right_op[0] ? seen2 : ey : right_op[0] ? ex : {2'd0, length};
        br   <= right_op[1] ? right_op[0] ? seen0 : ex : right_op[0] ? ey : safe;
        if (!rate2)
            cl <= third_op[1] ? third_op[0] ? sum[31:6] : {8'd0, c[17+:18]}
                              : third_op[0] ? {9'd0, w} : {{15{rise[10]}}, rise};
        cr   <= third_op[1] ? third_op[0] ? {2'd0, rate} : {5'd0, rate2 ? cfg_r2 : cfg_r1}
                          : third_op[0] ? {1'b0, slope} : {6'd0, offset};
        if (keep)  // at PIPE = 1 it is an operand first
            {c1, s1, c12, s12} <= {s1, c12, s12, PIPE == 0 ? root : al};
        if (sine) begin
            minus    <= ~safe;
            out_near <= close;
        end
        if (tip) begin
            e    <= from - a[35:11];
            back <= e;
        end
        seen0 <= sum[31:14];
        seen1 <= seen0;
        seen2 <= seen1;
        if (det_op)
            det <= b[34:11] + {1'b0, cfg_mu, 6'd0};
        rate  <= c[15+:19];
        made  <= c[42:0];
        move0 <= PIPE == 0 ? c[42:0] : made;
        move1 <= move0;
        if (PIPE == 0 || !stop)
            shift1 <= shift0;
        if (test)
            out_square <= sum;
    end
endmodule
`default_nettype wire
