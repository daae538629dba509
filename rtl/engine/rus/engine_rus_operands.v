// SPDX-License-Identifier: Apache-2.0
// Operands of the four multipliers of engine_rus_path, and the addend of their sum, from the words of a leg and from
// earlier products: al ar + bl br + cl cr + add, and dl dr. Operands come through gates: registers that are 0 except in
// the clock for which they open, so that an OR selects. in_op: of a line of engine_rus_leg the columns A to D and add,
// OUT_N, and the bits that write a register here. x, e, f, G, t and the reciprocal are kept until their gate opens; e,
// f and G move on before those of the next leg come.
// Formats: in_row, in_words, in_cb, in_nb s18 each; in_sum s29.8 of the position word, in_f s18.8, in_g s19.4. Exact.
// Latency: 1 to a gate, 1 more to an operand. Model: engine_rus.leg
`default_nettype none
module engine_rus_operands #(
    parameter PIPE = 0  // of engine_rus_path, 0 or 1 (default 0)
) (
    input  wire               clk,
    input  wire signed [26:0] cfg_k,
    input  wire [25:0]        cfg_c,
    input  wire [25:0]        in_op,
    input  wire [71:0]        in_row,
    input  wire [71:0]        in_words,
    input  wire signed [17:0] in_cb,
    input  wire signed [17:0] in_nb,
    input  wire [11:0]        in_place,
    input  wire [16:0]        in_step,
    input  wire [36:0]        in_sum,
    input  wire [25:0]        in_f,
    input  wire [22:0]        in_g,
    input  wire               in_minus,
    input  wire               in_beyond,
    input  wire [21:0]        in_root,
    input  wire [26:0]        in_word,
    input  wire [21:0]        in_w,
    input  wire [19:0]        in_slope,
    input  wire [26:0]        in_reciprocal,
    output reg  signed [25:0] out_al,
    output reg  signed [25:0] out_ar,
    output reg  signed [25:0] out_bl,
    output reg  signed [25:0] out_br,
    output reg  signed [26:0] out_cl,
    output reg  signed [26:0] out_cr,
    output reg  signed [26:0] out_dl,
    output reg  signed [26:0] out_dr,
    output reg  signed [36:0] out_add
);
    wire sine, cosine, turn, words, y_row, z_row, x_row, gain, height, link, next_d, divide, table_d, with_k, place;
    wire out_n, rec, copy, disc, keep, to_g, to_q, to_e, to_y, to_z, to_x;
    assign {sine, cosine, turn, words, y_row, z_row, x_row, gain, height, link, next_d, divide, table_d, with_k, place,
            out_n, rec, copy, disc, keep, to_g, to_q, to_e, to_y, to_z, to_x} = in_op;
    wire [25:0] length = in_sum[25:0];

    // Registers of a leg, and copies that outlast those of the next leg
    reg  [25:0] x, e, f, e2, f2, e3, f3;
    reg  [22:0] g, g2;
    reg  [26:0] t, reciprocal;
    reg         minus, minus2, elbow, elbow2, elbow3, elbow4;
    always @(posedge clk) begin
        if (to_x)
            x <= length;
        if (to_y)
            elbow <= in_words[18];
        if (to_e) begin
            e <= length;
            f <= in_f;
        end
        if (to_q) begin
            t      <= in_sum[36:10];
            elbow2 <= elbow;
        end
        if (to_g) begin
            g     <= in_g;
            minus <= in_minus;
        end
        if (keep) begin
            e2 <= e;
            f2 <= f;
        end
        if (disc)
            elbow3 <= elbow2;
        if (copy) begin
            e3     <= e2;
            f3     <= f2;
            g2     <= g;
            minus2 <= minus;
            elbow4 <= elbow3;
        end
        if (rec)
            reciprocal <= in_reciprocal;
    end

    // Gates
    reg  [71:0]        row;
    reg  [17:0]        word1, word2, word3, open_cb, open_nb, foot;
    reg  signed [18:0] away;
    reg  [25:0]        open_x, open_z, open_e, open_f, open_c, e_a, f_a, e_b, f_b;
    reg  [21:0]        open_s;
    reg  [22:0]        open_g, g_a;
    reg  [26:0]        open_t;
    reg                invert;
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
        open_f  <= to_e ? in_f : 26'd0;
        open_t  <= gain ? t : 27'd0;
        open_c  <= gain ? cfg_c : 26'd0;
        open_g  <= to_g ? in_g : 23'd0;
        e_a     <= cosine ? e3 : 26'd0;
        f_a     <= sine ? f3 : 26'd0;
        e_b     <= cosine && in_beyond || sine && !in_beyond ? e3 : 26'd0;
        f_b     <= cosine && !in_beyond || sine && in_beyond ? f3 : 26'd0;
        g_a     <= (cosine || sine) && !in_beyond ? g2 : 23'd0;
        open_s  <= cosine || sine ? in_root : 22'd0;
        invert  <= (cosine || sine) && (in_beyond ? minus2 : elbow4 ^ cosine);
        if (to_z)
            open_z <= length;
        else if (!turn)
            open_z <= 26'd0;
    end

    // With PIPE rows are added later than they leave their gates, and the step of an angle is a word like others
    wire        hold, ends, alone;  // the third row comes; dr is cleared for the step, or takes it alone
    wire [18:0] rest;               // place less foot
    wire [16:0] step;
    generate
        if (PIPE == 0) begin : g_now
            assign {hold, ends, alone, rest, step} = {to_x, out_n, 1'b0, away, 17'd0};
            wire unused = &{1'b0, in_step};
        end else begin : g_later
            reg        second, ended;
            reg [18:0] away2;
            assign {hold, ends, alone, rest, step} = {second, ended, ended, away2, in_step};
            always @(posedge clk) begin
                second <= y_row;
                ended  <= out_n;
                away2  <= away;
            end
        end
    endgenerate

    wire [26:0] h = {length[25], length} & {27{height}};
    always @(posedge clk) begin
        out_al <= {row[71:54], 8'd0} | open_x | open_e | e_a | f_a;
        out_bl <= {row[53:36], 8'd0} | open_z | open_f | e_b | f_b;
        out_cl <= {{3{row[35] | open_cb[17]}}, row[35:18] | open_cb, 6'd0} | h | open_t | {{4{open_g[22]}}, open_g};
        if (!y_row && !hold) begin  // the coordinates of the joint are held for three rows
            out_ar <= {{8{word1[17]}}, word1} | open_e | {{3{g_a[22]}}, g_a};
            out_br <= {{8{word2[17]}}, word2} | open_f | ({4'd0, open_s} ^ {26{invert}});
            out_cr <= {{7{word3[17]}}, word3, 2'd0} | h | {1'b0, open_c} | {{4{open_g[22]}}, open_g};
        end
        out_dl <= (next_d ? in_word : 27'd0) | (table_d ? {1'b0, in_w, 4'd8} : 27'd0)
            | {{3{open_nb[17]}}, open_nb, 6'd0} | {15'd0, in_place};
        if (to_y || table_d || divide || ends)
            out_dr <= ({{7{word3[17]}}, word3, 2'd0} & {27{!alone}}) | (table_d ? {1'b0, in_slope, 6'd0} : 27'd0)
                | (divide ? reciprocal : 27'd0) | {10'd0, step};
        // The 1 restores what two truncations lose
        out_add <= with_k ? {{2{cfg_k[26]}}, cfg_k, 8'd0} : place ? {{10{rest[18]}}, rest, 8'd1} : 37'd1;
    end
endmodule
`default_nettype wire
