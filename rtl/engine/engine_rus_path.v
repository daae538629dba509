// SPDX-License-Identifier: Apache-2.0
// Datapath of engine_rus_leg, whose table says what happens when: in_op is its lines, column by column.
// Lengths x, z, y, e, f, h, G, S have 4 fraction bits below the position word of 18 bits; sums have 6, squares of
// lengths 16 less. Out of reach the root is that of e^2 + f^2 and (cos, sin) = +-(e, f) R / R^2, the sign that of G.
// Formats: engine_rus_ik, engine_rus_leg. Error: a root and a reciprocal within 2^-18, and what is truncated.
// Model: engine_rus.leg
`default_nettype none
module engine_rus_path (
    input  wire               clk,
    input  wire signed [26:0] cfg_k,
    input  wire [25:0]        cfg_c,
    input  wire [11:0]        cfg_near,
    input  wire [29:0]        in_op,
    input  wire [71:0]        in_row,
    input  wire [71:0]        in_words,
    input  wire signed [17:0] in_cb,
    input  wire signed [17:0] in_nb,
    output wire signed [17:0] out_word,
    output wire [21:0]        out_root,
    output reg                out_far,
    output reg                out_none,
    output reg                out_near,
    output reg                out_over
);
    wire sine, cosine, square, plane, turn, rows, gap_c, gain, link_c, row_c, next_d, table_d, link_d, with_k, place;
    wire num, divisor, to_s, copy, root, fine, find, disc, to_g, to_q, to_e, to_y, to_z, to_x;
    wire divide = next_d && table_d;
    wire height = gap_c && !gain, gap = gap_c && gain, gain1 = gain && !gap_c;
    wire first = rows && turn, link = link_c && row_c, zero = link_c && !row_c;
    wire unused = &{1'b0, in_op[14]};
    assign {sine, cosine, square, plane, turn, rows, gain, gap_c, link_c, row_c, next_d, table_d, link_d, with_k, place}
        = in_op[29:15];
    assign {num, divisor, to_s, copy, root, fine, find, disc, to_g, to_q, to_e, to_y, to_z, to_x} = in_op[13:0];

    // Products: A + B, C, D
    reg  signed [21:0] al, bl;
    reg  signed [22:0] ar, br;
    reg  signed [26:0] cl, cr, dl, dr;
    reg  signed [29:0] add;
    wire signed [44:0] pa = al * ar, pb = bl * br;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [53:0] pc = cl * cr, pd = dl * dr;
    wire signed [45:0] ab = pa + pb;
    wire signed [29:0] sum = ab[45:16] + (pc[45:16] + add);
    /* verilator lint_on UNUSEDSIGNAL */
    wire        [21:0] length = sum[23:2];
    wire               over = sum[29:23] != {7{sum[23]}};
    wire signed [18:0] away = $signed(in_row[17:0]) + $signed(in_words[17:0]);

    // Registers of a leg, and those that outlive the next one's
    reg  [21:0] x, z, y, e, f, e2, f2;
    reg  [22:0] g, s;
    reg  [43:0] q;
    reg  [45:0] square_of_s;
    reg         beyond, wide, minus, minus2, elbow, elbow2, over1, over2;
    wire [22:0] f_sum = {y[21], y} + pd[40:18];
    wire [22:0] inverted = s ^ {23{beyond ? minus : elbow2 ^ cosine}};

    // Normalise: 2^(2 shift - 19)
    reg  [45:0] n;
    reg  [3:0]  shift, shift2;
    reg  [32:0] coarse;
    reg  [26:0] word;
    always @* begin
        case (shift[3:2])
            2'd0: coarse = n[45:13];
            2'd1: coarse = n[37:5];
            default: coarse = {n[29:0], 3'd0};
        endcase
        case (shift[1:0])
            2'd0: word = coarse[32:6];
            2'd1: word = coarse[30:4];
            2'd2: word = coarse[28:2];
            default: word = coarse[26:0];
        endcase
    end
    wire q2 = q[43:36] != 0, q1 = q[35:28] != 0, d2 = square_of_s[43:36] != 0, d1 = square_of_s[35:28] != 0;
    wire [1:0] bytes_q = {!q2 && !q1, !q2 && q1}, bytes_d = {!d2 && !d1, !d2 && d1};
    wire p3 = coarse[30:29] != 0, p2 = coarse[28:27] != 0, p1 = coarse[26:25] != 0;

    // Roots and reciprocals, as in kernel_vector_path
    reg  [21:0] w;
    wire [19:0] slope;
    kernel_vector_slopes slopes (.clk(clk), .in_read(root || divisor), .in_range({divisor, 1'b0}),
        .in_segment(word[24:16]), .out_slope(slope));
    wire [21:0] fall_bytes = shift2[3] ? pd[48:27] >> 8 : shift2[2] ? pd[48:27] >> 4 : pd[48:27];
    wire [21:0] fall = fall_bytes >> shift2[1:0];

    assign out_word = pd[50:33] + {17'd0, pd[32]};
    assign out_root = s[21:0];
    always @(posedge clk) begin
        al <= rows ? {in_row[71:54], 4'd0} : plane ? x : square ? e : cosine ? e2 : f2;
        bl <= rows ? {in_row[53:36], 4'd0} : plane ? z : square ? f : cosine ^ beyond ? f2 : e2;
        if (turn || square || cosine)
            ar <= turn ? {{3{in_words[71]}}, in_words[71:54], 2'd0} : square ? {e[21], e} : g;
        if (cosine && beyond)
            ar <= 23'd0;
        if (turn || square || cosine || sine)
            br <= turn ? {{3{in_words[53]}}, in_words[53:36], 2'd0} : square ? {f[21], f} : inverted;
        cl <= gap ? {{4{pc[47]}}, pc[47:25]} : height ? {{5{length[21]}}, length} : gain1 ? sum[28:2]
            : {{5{link ? in_cb[17] : in_row[35]}}, link ? in_cb : in_row[35:18], 4'd0};
        if (first || link || gap_c || gain)
            cr <= gap ? {{4{pc[47]}}, pc[47:25]} : height ? {{5{length[21]}}, length} : gain1 ? {1'b0, cfg_c}
                : {{7{in_words[35]}}, in_words[35:18], 2'd0};
        if (zero)
            cr <= 27'd0;
        dl <= next_d ? word : table_d ? {1'b0, w, 4'd8} : {{5{in_nb[17]}}, in_nb, 4'd0};
        if (link_d || table_d)
            dr <= divide ? pd[49:23] : table_d ? {1'b0, slope, 6'd0} : {{7{in_words[35]}}, in_words[35:18], 2'd0};
        // half, and what two truncations lose
        add <= with_k ? {{3{cfg_k[26]}}, cfg_k} : place ? {{5{away[18]}}, away, 6'd3} : 30'd3;

        if (to_x)
            x <= length;
        if (to_z)
            z <= length;
        if (to_y)
            y <= length;
        if (to_e) begin
            e     <= length;
            f     <= f_sum[21:0];
            elbow <= in_words[18];
        end
        if (to_x || to_z || to_y || to_e || height)
            over1 <= over || (to_e && f_sum[22] != f_sum[21]) || (over1 && !to_x);
        if (to_q)
            q <= ab[43:0];
        if (to_g) begin
            g     <= pc[47:25];
            wide  <= pc[53:47] != {7{pc[47]}};
            minus2 <= pc[53];
        end
        if (disc) begin
            square_of_s <= {2'b0, q} - pc[45:0];
            over2       <= over1;
        end
        if (find) begin
            beyond <= square_of_s[45] || wide;
            minus  <= minus2;
            n      <= square_of_s[45] || wide ? {2'b0, q} : square_of_s;
        end
        if (root)
            n <= {2'b0, q};
        if (num)
            n <= ab;
        if (find || root)
            shift[3:2] <= root || square_of_s[45] || wide ? bytes_q : bytes_d;
        if (fine)
            shift[1:0] <= {!p3 && !p2, !p3 && (p2 || !p1)};
        if (root || divisor)
            w <= divisor ? {1'b0, word[24:16], ~word[15], ~word[14:4]} : {word[24:15], ~word[15], word[14:4]};
        if (copy) begin
            e2       <= e;
            f2       <= f;
            elbow2   <= elbow;
            out_over <= over2;
            shift2   <= shift;
        end
        if (to_s)
            s <= {1'b0, fall};
        if (divisor) begin
            out_far  <= beyond || word[24:23] == 0;
            out_none <= word[24:23] == 0;
            out_near <= !beyond && s[21:10] < cfg_near;
        end
    end
endmodule
`default_nettype wire
