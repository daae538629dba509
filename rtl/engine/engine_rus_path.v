// SPDX-License-Identifier: Apache-2.0
// Datapath of engine_rus_leg, whose table says what happens when: in_op is its lines, column by column.
// Lengths e, f, h, G, S have 4 fraction bits below the position word of 18 bits; x, z, y and sums 6, squares of
// lengths 16 less than those. Out of reach the root is that of e^2 + f^2 and (cos, sin) = +-(e, f) R / R^2, the sign
// that of G.
// Operands come through gates: registers that are 0 but in the clock for which they open, so that an OR selects.
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
    output wire signed [17:0] out_word,
    output reg  [21:0]        out_root,
    output reg                out_far,
    output reg                out_none,
    output reg                out_near,
    output reg                out_over
);
    wire sine, cosine, turn, words, y_row, z_row, x_row, gain, height, link, next_d, divide, table_d, with_k, place;
    wire rec, num, divisor, to_s, copy, root, fine, find, gate, disc, keep, to_g, to_q, to_e, to_y, to_z, to_x;
    wire unused = &{1'b0, in_op[18:17]};
    assign {sine, cosine, turn, words, y_row, z_row, x_row, gain, height, link, next_d, divide, table_d, with_k, place}
        = in_op[33:19];
    assign {rec, num, divisor, to_s, copy, root, fine, find, gate, disc, keep, to_g, to_q, to_e, to_y, to_z, to_x}
        = in_op[16:0];

    // Products, and the sum behind them: A + B + C
    reg  signed [23:0] al, bl;
    reg  signed [22:0] ar, br;
    reg  signed [26:0] cl, cr, dl, dr;
    reg  signed [46:0] pa, pb;
    /* verilator lint_off UNUSEDSIGNAL */
    reg  signed [53:0] pc, pd;
    reg  signed [29:0] add;
    wire signed [47:0] ab = pa + pb;
    wire signed [29:0] sum = ab[45:16] + (pc[45:16] + add);
    /* verilator lint_on UNUSEDSIGNAL */
    wire        [21:0] length = sum[23:2];
    wire               over = sum[29:23] != {7{sum[23]}};
    reg  [17:0]        foot;
    reg  signed [18:0] away;

    // Registers of a leg, and those that outlive the next one's
    reg  [23:0] x, y;
    reg  [21:0] e, f, e2, f2, e3, f3;
    reg  [22:0] g, g2;
    reg  [26:0] t, reciprocal;
    reg         wide, minus, minus2, beyond2, elbow, elbow2, elbow3, elbow4, over1, over2, over3, over4;
    /* verilator lint_off UNUSEDSIGNAL */
    wire [24:0] f_sum = {y[23], y} + pd[40:16];
    /* verilator lint_on UNUSEDSIGNAL */

    // Gates
    reg  [71:0] row;
    reg  [17:0] word1, word2, word3, open_cb, open_nb;
    reg  [23:0] open_x, open_z;
    reg  [21:0] open_e, open_f, e_a, f_a, e_b, f_b, open_s;
    reg  [22:0] open_g, g_a;
    reg  [26:0] open_t;
    reg  [25:0] open_c;
    reg         invert;

    wire [26:0] word;
    wire [21:0] w, s;
    wire [19:0] slope;
    wire        beyond, none;
    engine_rus_root roots (.clk(clk), .in_op({num, divisor, to_s, copy, root, fine, find, gate, disc, to_q}),
        .in_ab(ab[45:0]), .in_square(pc[45:0]), .in_wide(wide), .in_product(pd[48:27]), .out_word(word), .out_w(w),
        .out_slope(slope), .out_beyond(beyond), .out_none(none), .out_root(s));

    assign out_word = pd[50:33] + {17'd0, pd[32]};
    wire [26:0] h = {{5{sum[23]}}, length} & {27{height}};
    always @(posedge clk) begin
        row     <= x_row || z_row || y_row ? in_row : 72'd0;
        word1   <= words ? in_words[71:54] : 18'd0;
        word2   <= words ? in_words[53:36] : 18'd0;
        word3   <= x_row || link ? in_words[35:18] : 18'd0;
        foot    <= in_words[17:0];
        away    <= $signed(row[17:0]) + $signed(foot);
        open_cb <= link ? in_cb : 18'd0;
        open_nb <= link ? in_nb : 18'd0;
        open_x  <= turn ? x : 24'd0;
        open_e  <= to_e ? length : 22'd0;
        open_f  <= to_e ? f_sum[23:2] : 22'd0;
        open_t  <= gain ? t : 27'd0;
        open_c  <= gain ? cfg_c : 26'd0;
        open_g  <= to_g ? pc[47:25] : 23'd0;
        e_a     <= cosine ? e3 : 22'd0;
        f_a     <= sine ? f3 : 22'd0;
        e_b     <= cosine && beyond2 || sine && !beyond2 ? e3 : 22'd0;
        f_b     <= cosine && !beyond2 || sine && beyond2 ? f3 : 22'd0;
        g_a     <= (cosine || sine) && !beyond2 ? g2 : 23'd0;
        open_s  <= cosine || sine ? s : 22'd0;
        invert  <= (cosine || sine) && (beyond2 ? minus2 : elbow4 ^ cosine);
        if (to_z)
            open_z <= sum[23:0];
        else if (!turn)
            open_z <= 24'd0;

        al <= {row[71:54], 6'd0} | open_x | {{2{open_e[21] | e_a[21] | f_a[21]}}, open_e | e_a | f_a};
        bl <= {row[53:36], 6'd0} | open_z | {{2{open_f[21] | e_b[21] | f_b[21]}}, open_f | e_b | f_b};
        cl <= {{5{row[35] | open_cb[17]}}, row[35:18] | open_cb, 4'd0} | h | open_t | {{4{open_g[22]}}, open_g};
        if (!y_row && !to_x) begin  // the joint's coordinates stay for three rows
            ar <= {{5{word1[17]}}, word1} | {open_e[21], open_e} | g_a;
            br <= {{5{word2[17]}}, word2} | {open_f[21], open_f} | ({1'b0, open_s} ^ {23{invert}});
            cr <= {{7{word3[17]}}, word3, 2'd0} | h | {1'b0, open_c} | {{4{open_g[22]}}, open_g};
        end
        dl <= (next_d ? word : 27'd0) | (table_d ? {1'b0, w, 4'd8} : 27'd0) | {{5{open_nb[17]}}, open_nb, 4'd0};
        if (to_y || table_d || divide)
            dr <= {{7{word3[17]}}, word3, 2'd0} | (table_d ? {1'b0, slope, 6'd0} : 27'd0)
                | (divide ? reciprocal : 27'd0);
        pa <= al * ar;
        pb <= bl * br;
        pc <= cl * cr;
        pd <= dl * dr;
        // what two truncations lose, and half
        add <= with_k ? {{3{cfg_k[26]}}, cfg_k} : place ? {{5{away[18]}}, away, 4'd0, to_z, 1'b1} : 30'd3;

        if (to_x)
            x <= sum[23:0];
        if (to_y) begin
            y     <= sum[23:0];
            elbow <= in_words[18];
        end
        if (to_e) begin
            e <= length;
            f <= f_sum[23:2];
        end
        if (to_x || to_z || to_y || to_e || height)
            over1 <= over || (to_e && f_sum[24] != f_sum[23]) || (over1 && !to_x);
        if (to_q) begin
            t      <= sum[28:2];
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
