// SPDX-License-Identifier: Apache-2.0
// Two multipliers of engine_quaternion_gd_vector, A for cosines and x, B for sines and y: from the directions (c, n) of
// both links to the error E of the tip, its square, the steps d, the turned directions and their lengths.
//   (c - d n, n + d c), then (c - g c, n - g n) with g = (c^2 + n^2 - 1) / 2, a Newton step. Both subtract a product.
// Formats: directions s2.(W+4), kept half a unit of the operand too high, so that their upper W + 2 bits, the operands,
// are rounded; links in 1/2 LSB; E in 1/64 LSB: fine its lower W + 2 bits, saturated at 2^(W-5) LSB, coarse 1/4 LSB,
// saturated at 2^(W-1) LSB; d and g s0.(W+4), d saturated. All are truncated. Links take turns: c, n is the one in
// work, ct, nt the other, and each line that reads or turns a direction swaps them. Error of a tip:
// bounds.iterative.tip_vector. Model: iterative.fixed.gd_vector
`default_nettype none
module engine_gd_vector_path #(
    parameter W = 16,        // bits of a coordinate and of a length, 14 to 20 (default 16)
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire [W:0]          cfg_alpha,
    input  wire                in_shift,    // steps are divided by 4
    input  wire                in_fine,     // the range of E is fine
    input  wire                in_keep,     // the directions are not turned
    input  wire                in_load,     // the start is loaded
    input  wire                in_clear,    // the last step is cleared
    input  wire                in_stay,     // a direction is an operand, and the links are not swapped
    input  wire [13:0]         in_op,       // line of the table of engine_quaternion_gd_vector
    input  wire signed [W+1:0] in_c1,
    input  wire signed [W+1:0] in_n1,
    input  wire signed [W+1:0] in_c12,
    input  wire signed [W+1:0] in_n12,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire [W+1:0]        out_c1,
    output wire [W+1:0]        out_n1,
    output wire [W+1:0]        out_c12,
    output wire [W+1:0]        out_n12,
    output reg  [W+3:0]        out_d1,
    output reg  [W+3:0]        out_d12,
    output reg  [2*W-1:0]      out_square
);
    localparam O = W + 2, N = W + 9, D = W + 4;   // bits of an operand, an error and a step
    localparam S = D + 2;                         // bits of a direction
    localparam M = W + 14;                        // bits of a sum of steps
    localparam [1:0] PUSH = 2'd1, HOLD = 2'd2, SQUARE = 2'd3;  // operands as in the table
    localparam [1:0] ERROR = 2'd0, LINK = 2'd1, SELF = 2'd2, L1 = 2'd0, L2 = 2'd1, ALPHA = 2'd2;
    wire [1:0] left_op, right_op, k_op;
    wire       unused_last, stop, sum_op, add, ask, first, tip, move;
    assign {left_op, right_op, k_op, unused_last, stop, sum_op, add, ask, first, tip, move} = in_op;
    wire       gain = right_op[1];
    reg        second;  // the operands hold d of link 2
    wire       swap = left_op[1] && !in_stay;
    wire       turns = PIPE == 0 ? stop && !in_keep : in_stay && left_op[0];  // they hold d of link 1

    // Products
    reg  signed [O-1:0]   al, bl;
    reg  signed [D-1:0]   ar, br;
    wire signed [O+D-1:0] a, b;
    generate
        if (PIPE == 0) begin : g_now
            assign a = al * ar;
            assign b = bl * br;
        end else begin : g_parts
            product_parts #(.A(O), .B(D), .MULTIPLY(MULTIPLY)) part_a (.clk(clk), .in_move(1'b1), .in_a(al), .in_b(ar),
                .out_p(a));
            product_parts #(.A(O), .B(D), .MULTIPLY(MULTIPLY)) part_b (.clk(clk), .in_move(1'b1), .in_a(bl), .in_b(br),
                .out_p(b));
        end
    endgenerate

    // Directions
    localparam [S-O-1:0] HALF = 1 << S - O - 1;  // half a unit of an operand
    reg [S-1:0] c, n, ct, nt;
    assign out_c1 = c[S-1-:O];
    assign out_n1 = n[S-1-:O];
    assign out_c12 = ct[S-1-:O];
    assign out_n12 = nt[S-1-:O];

    // Error
    reg  signed [N-1:0] ex, ey;
    wire [N-1:0]        fromx = first ? {{3{in_x[W-1]}}, in_x, 6'd0} : ex;
    wire [N-1:0]        fromy = first ? {{3{in_y[W-1]}}, in_y, 6'd0} : ey;
    function [O-1:0] operand(input [N-1:0] e, input fine);
        if (fine ? e[N-1:W+1] != {8{e[N-1]}} : e[N-1:W+5] != {4{e[N-1]}})
            operand = {e[N-1], {(O-1){!e[N-1]}}};
        else
            operand = fine ? e[W+1:0] : e[W+5:4];
    endfunction

    // Links: x1 x2, y1 y2
    reg [O-1:0] x, y, x2, y2;

    // Steps: e1 + e2 for link 1, e2 for link 2 in addition
    reg  signed [M-2:0] exact;  // of a link, before the shift of its range
    reg  [M-1:0]        prior;  // sum of the earlier steps
    reg  [M-2:0]        step;
    wire [M-1:0]        sum = prior + {step[M-2], step};
    wire [M-1:0]        turn = PIPE == 0 ? sum : prior;
    wire                far = sum[M-1:D-1] != {(M-D+1){sum[M-1]}};
    wire                over;  // turn does not fit a step
    wire [D-1:0]        v = gain ? {!out_square[2*W-4], out_square[2*W-5:W-7]}
                                 : over ? {turn[M-1], {(D-1){!turn[M-1]}}} : turn[D-1:0];
    wire                fine;  // range of the steps
    generate
        if (PIPE == 0) begin : g_range
            assign {fine, over} = {in_fine, far};
        end else begin : g_range_before
            reg finer, farther;
            assign {fine, over} = {finer, farther};
            always @(posedge clk) begin
                farther <= far;
                if (stop)
                    finer <= in_fine;
            end
        end
    endgenerate
    always @* case ({fine, in_shift})
        2'd0: step = exact;
        2'd1: step = {{2{exact[M-2]}}, exact[M-2:2]};
        2'd2: step = {{4{exact[M-2]}}, exact[M-2:4]};
        default: step = {{6{exact[M-2]}}, exact[M-2:6]};
    endcase

    // Operands: a left one each for A and B, one right one for both
    reg [O-1:0] lefta, leftb;
    reg [D-1:0] k;
    always @* begin
        case (left_op)
            ERROR: {lefta, leftb} = {operand(ex, in_fine), operand(ey, in_fine)};
            LINK: {lefta, leftb} = {y, x};
            SELF: {lefta, leftb} = {c[S-1-:O], n[S-1-:O]};
            default: {lefta, leftb} = {n[S-1-:O], ~c[S-1-:O]};
        endcase
        case (k_op)
            L1: k = {4'd0, cfg_l1};
            L2: k = {4'd0, cfg_l2};
            ALPHA: k = {3'd0, cfg_alpha};
            default: k = v;
        endcase
    end

    wire unused = &{1'b0, a, b};
    always @(posedge clk) begin
        al <= lefta;
        bl <= leftb;
        if (right_op != HOLD || k_op[0])
            case (right_op)
                SQUARE: {ar, br} <= {{(D-O){lefta[O-1]}}, lefta, {(D-O){leftb[O-1]}}, leftb};
                PUSH: {ar, br} <= {{(D-O){a[W+O]}}, a[W+1+:O], {(D-O){b[W+O]}}, b[W+1+:O]};
                default: {ar, br} <= {k, k};
            endcase
        if (tip) begin
            ex <= fromx - a[W-6+:N];
            ey <= fromy - b[W-6+:N];
            {x2, y2} <= {a[W-1+:O], b[W-1+:O]};
        end
        if (tip || right_op == PUSH)
            {x, y} <= {x2, y2};
        if (ask)
            exact <= {b[2*O-1], b[2*O-1:W-8]} - {a[2*O-1], a[2*O-1:W-8]};
        if (ask && !add)
            prior <= {M{1'b0}};
        else if (add)
            prior <= sum;
        if (sum_op)
            out_square <= a[2*W+3:4] + b[2*W+3:4];
        // Turned and swapped directions
        if (swap || in_load) begin
            {ct, nt} <= in_load ? {in_c12, HALF, in_n12, HALF} : {c, n};
            {c, n} <= in_load ? {in_c1, HALF, in_n1, HALF}
                    : move && !in_keep ? {ct - a[W+:S], nt - b[W+:S]} : {ct, nt};
        end
        if (rst) begin
            {c, n} <= {2'b01, {W{1'b0}}, HALF, {O{1'b0}}, HALF};
            {ct, nt} <= {2'b01, {W{1'b0}}, HALF, {O{1'b0}}, HALF};
        end
        if (in_clear) begin
            out_d1 <= {D{1'b0}};
            out_d12 <= {D{1'b0}};
        end else begin
            if (turns)
                out_d1 <= ar;
            if (second)
                out_d12 <= ar;
        end
        second <= turns;
    end
endmodule
`default_nettype wire
