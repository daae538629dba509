// SPDX-License-Identifier: Apache-2.0
// Datapath of engine_rus_leg, whose table controls it: in_op is a line, column by column.
// Formats: x, z, y, e, f, h have 8 fraction bits below the position word of 18 bits, G and S 4; sums 8, of squares 0 (q
// 8). in_row, in_words, in_cb, in_nb s18 each; out_word s2.16; out_root u18.4. Out of reach the root is that of e^2 +
// f^2, and (cos, sin) = +-(e, f) R / R^2 with the sign of G. in_place with OUT_N, and in_step one clock later:
// multiplier D, whose dr is cleared, then forms out_rise, their product. PIPE = 1: registers within the products and
// behind their sums; in_place comes with in_step, and out_rise four clocks later.
// Error: truncation, and that of engine_rus_root (bounds.engine.rus_angle). Model: engine_rus.leg
`default_nettype none
module engine_rus_path #(
    parameter PIPE = 0,      // registers behind products and sums, 0 or 1 (default 0)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire               clk,
    input  wire signed [26:0] cfg_k,
    input  wire [25:0]        cfg_c,
    input  wire [11:0]        cfg_near,
    input  wire [33:0]        in_op,
    input  wire [71:0]        in_row,
    input  wire [71:0]        in_words,
    input  wire signed [17:0] in_cb,
    input  wire signed [17:0] in_nb,
    input  wire               in_dead,
    input  wire [11:0]        in_place,
    input  wire [16:0]        in_step,
    output wire [28:0]        out_rise,
    output wire signed [17:0] out_word,
    output reg  [21:0]        out_root,
    output reg                out_far,
    output reg                out_none,
    output reg                out_near,
    output reg                out_over
);
    wire [6:0] gates;
    wire [2:0] d_op;
    wire [1:0] addend;
    wire gain, height, link, out_n, out_c;
    wire rec, num, divisor, to_s, copy, root, fine, find, gate, disc, keep, to_g, to_q, to_e, to_y, to_z, to_x;
    assign {gates, gain, height, link, d_op, addend, out_n, out_c, rec, num, divisor, to_s, copy, root, fine, find,
        gate, disc, keep, to_g, to_q, to_e, to_y, to_z, to_x} = in_op;
    wire unused = &{1'b0, out_c};

    // Products, and their sum one clock later: A + B + C
    wire signed [25:0] al, ar, bl, br;
    wire signed [26:0] cl, cr, dl, dr;
    wire signed [36:0] add;
    reg  signed [51:0] pa, pb;
    reg  [25:0]        y;
    wire signed [51:0] product_a, product_b;
    /* verilator lint_off UNUSEDSIGNAL */
    reg  signed [53:0] new_pc, new_pd;
    wire signed [53:0] product_c, product_d, pc, pd;
    wire signed [52:0] ab;
    wire signed [52:0] new_ab = pa + pb;
    wire signed [36:0] sum;
    wire signed [36:0] new_sum = new_ab[52:16] + (new_pc[52:16] + add);
    wire [26:0]        f_sum;
    wire [26:0]        new_f = {y[25], y} + new_pd[42:16];
    /* verilator lint_on UNUSEDSIGNAL */
    wire signed [17:0] new_word = new_pd[50:33] + {17'd0, new_pd[32]};
    wire               over = sum[29:25] != {5{sum[25]}};
    generate
        if (PIPE == 0) begin : g_now
            assign product_a = al * ar;
            assign product_b = bl * br;
            assign product_c = cl * cr;
            assign product_d = dl * $signed(dr | {10'd0, in_step});
            assign {pc, pd, ab, sum, f_sum, out_word} = {new_pc, new_pd, new_ab, new_sum, new_f, new_word};
            assign out_rise = product_d[28:0];
        end else begin : g_parts
            reg [242:0] sums;
            product_parts #(.A(26), .B(26), .MULTIPLY(MULTIPLY)) part_a (.clk(clk), .in_move(1'b1), .in_a(al),
                .in_b(ar), .out_p(product_a));
            product_parts #(.A(26), .B(26), .MULTIPLY(MULTIPLY)) part_b (.clk(clk), .in_move(1'b1), .in_a(bl),
                .in_b(br), .out_p(product_b));
            product_parts #(.A(27), .B(27), .MULTIPLY(MULTIPLY)) part_c (.clk(clk), .in_move(1'b1), .in_a(cl),
                .in_b(cr), .out_p(product_c));
            product_parts #(.A(27), .B(27), .MULTIPLY(MULTIPLY)) part_d (.clk(clk), .in_move(1'b1), .in_a(dl),
                .in_b(dr), .out_p(product_d));
            assign {pc, pd, ab, sum, f_sum, out_word} = sums;
            assign out_rise = pd[28:0];
            always @(posedge clk)
                sums <= {new_pc, new_pd, new_ab, new_sum, new_f, new_word};
        end
    endgenerate

    wire [26:0] word;
    wire [21:0] w, s;
    wire [19:0] slope;
    wire        beyond, none;
    reg         wide, beyond2, over1, over2, over3, over4;
    engine_rus_root roots (.clk(clk), .in_op({num, divisor, to_s, copy, root, fine, find, gate, disc, to_q}),
        .in_q(ab[51:8]), .in_num(ab[49:4]),
        .in_square(pc[45:0]), .in_wide(wide), .in_product(pd[48:27]), .out_word(word), .out_w(w), .out_slope(slope),
        .out_beyond(beyond), .out_none(none), .out_root(s));
    engine_rus_operands #(.PIPE(PIPE)) operands (
        .clk(clk), .cfg_k(cfg_k), .cfg_c(cfg_c),
        .in_op({gates, gain, height, link, d_op, addend, out_n, rec, copy, disc, keep, to_g, to_q, to_e, to_y, to_z,
            to_x}), .in_row(in_row), .in_words(in_words), .in_cb(in_cb), .in_nb(in_nb), .in_place(in_place),
        .in_step(in_step), .in_sum(sum),
        .in_f(f_sum[25:0]), .in_g(pc[47:25]), .in_minus(pc[53]), .in_beyond(beyond2), .in_root(s), .in_word(word),
        .in_w(w), .in_slope(slope), .in_reciprocal(pd[49:23]), .out_al(al), .out_ar(ar), .out_bl(bl), .out_br(br),
        .out_cl(cl), .out_cr(cr), .out_dl(dl), .out_dr(dr), .out_add(add));

    always @(posedge clk) begin
        pa     <= product_a;
        pb     <= product_b;
        new_pc <= product_c;
        new_pd <= product_d;

        if (to_y)
            y <= sum[25:0];
        if (to_g)
            wide <= pc[53:47] != {7{pc[47]}};
        if (copy)
            beyond2 <= beyond;
        // Overflow accompanies its leg
        if (to_x || to_z || to_y || to_e || height)
            over1 <= over || (to_e && f_sum[26] != f_sum[25]) || (over1 && !to_x);
        if (to_q)
            over2 <= over1;
        if (disc)
            over3 <= over2;
        if (copy)
            over4 <= over3;
        if (rec) begin
            out_far  <= beyond2 || none;
            out_none <= none || in_dead;
            out_near <= !beyond2 && s[21:10] < cfg_near;
            out_root <= beyond2 || none || in_dead ? 22'd0 : s;
            out_over <= over4;
        end
    end
endmodule
`default_nettype wire
