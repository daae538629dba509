// SPDX-License-Identifier: Apache-2.0
// Datapath of engine_rus_leg, whose table says what happens when: in_op is its lines, column by column.
// Lengths x, z, y, e, f, h have 8 fraction bits below the position word of 18 bits, G and S 4; sums 8, of squares 0
// (q 8). Out of reach the root is that of e^2 + f^2 and (cos, sin) = +-(e, f) R / R^2, the sign that of G.
// Operands come through gates: registers that are 0 but in the clock for which they open, so that an OR selects.
// in_place at OUT_N, in_step in the clock behind: then multiplier D, its dr cleared, forms out_rise, their product.
// Formats: engine_rus_ik, engine_rus_leg. Error: engine_rus_root, and what is truncated.
// Model: engine_rus.leg
`default_nettype none
module engine_rus_path (
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
    wire sine, cosine, turn, words, y_row, z_row, x_row, gain, height, link, next_d, divide, table_d, with_k, place;
    wire rec, num, divisor, to_s, copy, root, fine, find, gate, disc, keep, to_g, to_q, to_e, to_y, to_z, to_x;
    wire out_n = in_op[18];
    wire unused = &{1'b0, in_op[17]};
    assign {sine, cosine, turn, words, y_row, z_row, x_row, gain, height, link, next_d, divide, table_d, with_k, place}
        = in_op[33:19];
    assign {rec, num, divisor, to_s, copy, root, fine, find, gate, disc, keep, to_g, to_q, to_e, to_y, to_z, to_x}
        = in_op[16:0];

    // Products, and the sum behind them: A + B + C
    reg  signed [25:0] al, ar, bl, br;
    reg  signed [26:0] cl, cr, dl, dr;
    reg  signed [51:0] pa, pb;
    /* verilator lint_off UNUSEDSIGNAL */
    reg  signed [53:0] pc, pd;
    wire signed [53:0] product_d = dl * $signed(dr | {10'd0, in_step});
    reg  signed [36:0] add;
    wire signed [52:0] ab = pa + pb;
    wire signed [36:0] sum = ab[52:16] + (pc[52:16] + add);
    /* verilator lint_on UNUSEDSIGNAL */
    wire        [25:0] length = sum[25:0];
    wire               over = sum[29:25] != {5{sum[25]}};
    reg  [17:0]        foot;
    reg  signed [18:0] away;

    // Registers of a leg, and those that outlive the next one's
    reg  [25:0] x, y, e, f, e2, f2, e3, f3;
    reg  [22:0] g, g2;
    reg  [26:0] t, reciprocal;
    reg         wide, minus, minus2, beyond2, elbow, elbow2, elbow3, elbow4, over1, over2, over3, over4;
    /* verilator lint_off UNUSEDSIGNAL */
    wire [26:0] f_sum = {y[25], y} + pd[42:16];
    /* verilator lint_on UNUSEDSIGNAL */

    // Gates
    reg  [71:0] row;
    reg  [17:0] word1, word2, word3, open_cb, open_nb;
    reg  [25:0] open_x, open_z, open_e, open_f, e_a, f_a, e_b, f_b;
    reg  [21:0] open_s;
    reg  [22:0] open_g, g_a;
    reg  [26:0] open_t;
    reg  [25:0] open_c;
    reg         invert;

    wire [26:0] word;
    wire [21:0] w, s;
    wire [19:0] slope;
    wire        beyond, none;
    engine_rus_root roots (.clk(clk), .in_op({num, divisor, to_s, copy, root, fine, find, gate, disc, to_q}),
        .in_q(ab[51:8]), .in_num(ab[49:4]),
        .in_square(pc[45:0]), .in_wide(wide), .in_product(pd[48:27]), .out_word(word), .out_w(w), .out_slope(slope),
        .out_beyond(beyond), .out_none(none), .out_root(s));

    assign out_rise = product_d[28:0];
    assign out_word = pd[50:33] + {17'd0, pd[32]};
    wire [26:0] h = {sum[25], length} & {27{height}};
    always @(posedge clk) begin
        row     <= x_row || z_row || y_row ? in_row : 72'd0;
        word1   <= words ? in_words[71:54] : 18'd0;
        word2   <= words ? in_words[53:36] : 18'd0;
        word3   <= x_row || link ? in_words[35:18] : 18'd0;
        foot    <= in_words[17:0];
        away    <= $signed(row[17:0]) + $signed(foot);
        open_cb <= link ? in_cb : 18'd0;
        open_nb <= link ? in_nb : 18'd0;
        open_x  <= turn ? x : 26'd0;
        open_e  <= to_e ? length : 26'd0;
        open_f  <= to_e ? f_sum[25:0] : 26'd0;
        open_t  <= gain ? t : 27'd0;
        open_c  <= gain ? cfg_c : 26'd0;
        open_g  <= to_g ? pc[47:25] : 23'd0;
        e_a     <= cosine ? e3 : 26'd0;
        f_a     <= sine ? f3 : 26'd0;
        e_b     <= cosine && beyond2 || sine && !beyond2 ? e3 : 26'd0;
        f_b     <= cosine && !beyond2 || sine && beyond2 ? f3 : 26'd0;
        g_a     <= (cosine || sine) && !beyond2 ? g2 : 23'd0;
        open_s  <= cosine || sine ? s : 22'd0;
        invert  <= (cosine || sine) && (beyond2 ? minus2 : elbow4 ^ cosine);
        if (to_z)
            open_z <= length;
        else if (!turn)
            open_z <= 26'd0;

        al <= {row[71:54], 8'd0} | open_x | open_e | e_a | f_a;
        bl <= {row[53:36], 8'd0} | open_z | open_f | e_b | f_b;
        cl <= {{3{row[35] | open_cb[17]}}, row[35:18] | open_cb, 6'd0} | h | open_t | {{4{open_g[22]}}, open_g};
        if (!y_row && !to_x) begin  // the joint's coordinates stay for three rows
            ar <= {{8{word1[17]}}, word1} | open_e | {{3{g_a[22]}}, g_a};
            br <= {{8{word2[17]}}, word2} | open_f | ({4'd0, open_s} ^ {26{invert}});
            cr <= {{7{word3[17]}}, word3, 2'd0} | h | {1'b0, open_c} | {{4{open_g[22]}}, open_g};
        end
        dl <= (next_d ? word : 27'd0) | (table_d ? {1'b0, w, 4'd8} : 27'd0) | {{3{open_nb[17]}}, open_nb, 6'd0}
            | {15'd0, in_place};
        if (to_y || table_d || divide || out_n)
            dr <= {{7{word3[17]}}, word3, 2'd0} | (table_d ? {1'b0, slope, 6'd0} : 27'd0)
                | (divide ? reciprocal : 27'd0);
        pa <= al * ar;
        pb <= bl * br;
        pc <= cl * cr;
        pd <= product_d;
        // what two truncations lose
        add <= with_k ? {{2{cfg_k[26]}}, cfg_k, 8'd0} : place ? {{10{away[18]}}, away, 8'd1} : 37'd1;

        if (to_x)
            x <= length;
        if (to_y) begin
            y     <= length;
            elbow <= in_words[18];
        end
        if (to_e) begin
            e <= length;
            f <= f_sum[25:0];
        end
        if (to_x || to_z || to_y || to_e || height)
            over1 <= over || (to_e && f_sum[26] != f_sum[25]) || (over1 && !to_x);
        if (to_q) begin
            t      <= sum[36:10];
            elbow2 <= elbow;
            over2  <= over1;
        end
        if (to_g) begin
            g     <= pc[47:25];
            wide  <= pc[53:47] != {7{pc[47]}};
            minus <= pc[53];
        end
        if (keep) begin
            e2 <= e;
            f2 <= f;
        end
        if (disc) begin
            elbow3 <= elbow2;
            over3  <= over2;
        end
        if (copy) begin
            e3      <= e2;
            f3      <= f2;
            g2      <= g;
            minus2  <= minus;
            beyond2 <= beyond;
            elbow4  <= elbow3;
            over4   <= over3;
        end
        if (rec) begin
            reciprocal <= pd[49:23];
            out_far    <= beyond2 || none;
            out_none   <= none || in_dead;
            out_near   <= !beyond2 && s[21:10] < cfg_near;
            out_root   <= beyond2 || none || in_dead ? 22'd0 : s;
            out_over   <= over4;
        end
    end
endmodule
`default_nettype wire
