// SPDX-License-Identifier: Apache-2.0
// Sums of four products on a register file, one line a clock, for engine_gd_n_program: a coordinate of a quaternion
// product.
//   word = A B + C D + E F - G H rounded to 2^-25, written to DEST; with STEP 16 times that, limited to +-1/4
// A line reads in one clock, multiplies in the next and adds in the third. Its word can be read three lines later. With
// PIPE registers hold its addresses, its factors, the parts of its products, the products, sums of two of them and the
// sum, and its word can be read seven lines later.
// Formats: words s2.25; sum s4.28, each product truncated to 2^-28. The sum wraps; out_over marks a word that did.
//   in_op {A, B, C, D, E, F, G, H, DEST: 6 bits each; ACT: 0 none, 1 an error, 2 STEP, 3 a square}. 0 to 31 is a
//   register, 32 to 47 a word of page in_page, 48 to 63 of page in_next. With in_still STEP gives 0.
// in_set writes in_word to address in_own; in_fetch reads out_read there. Registers 4 to 7 are 1, 1/2, 3/2, 0. The file
// is stored eight times, for eight reads a clock. Model: iterative.space.gd
`default_nettype none
module engine_gd_n_products #(
    parameter P = 4,    // bits of a page number, 2 to 7 (default 4); a page has 16 words
    parameter PIPE = 0  // 0 or 1 (default 0); 1: registers around the multipliers
) (
    input  wire         clk,
    input  wire [21:0]  cfg_tol,
    input  wire [55:0]  in_op,
    input  wire         in_run,
    input  wire         in_still,
    input  wire         in_alone,   // with PIPE a square is of the next joint, and here there is none: it says nothing
    input  wire [P-1:0] in_page,
    input  wire [P-1:0] in_next,
    input  wire         in_set,
    input  wire [P+3:0] in_own,
    input  wire [26:0]  in_word,
    input  wire         in_fetch,
    output wire [26:0]  out_read,
    output wire [26:0]  out_word,   // word of the line that adds; with out_error it is a coordinate of E
    output wire         out_error,
    output wire         out_over,
    output wire         out_close,  // the magnitude of the word is below cfg_tol
    output wire         out_off     // a square is off 1 by 2^-12 or more
);
    wire [53:0] places;               // A to H, DEST
    wire        act_step, act_error;  // ACT; both: a square
    assign      {places, act_step, act_error} = in_op;

    // State of the line that multiplies and of the line that adds
    reg          write0, step0, still0, error0, square0, write, step, still, error, square;
    reg  [P+3:0] dest0, dest;
    wire [P+3:0] dest_now, dest1;
    wire         write1, step1, still1, error1, square1, half, reads;
    wire         counts = PIPE == 0 ? in_run : in_run && !in_alone;
    always @(posedge clk) begin
        write0  <= in_run;
        step0   <= act_step && !act_error;
        error0  <= act_error && !act_step && in_run;
        square0 <= act_step && act_error && counts;
        still0  <= in_still;
        dest0   <= dest_now;
        {write, step, still, square, dest} <= {write1, step1, still1, square1, dest1};
        error <= error1 && in_run;  // a line from before a reset must not reach the next answer
    end

    // Register file
    wire [P+3:0]        to = in_set ? in_own : dest;
    wire [26:0]         made;
    wire [26:0]         value = in_set ? in_word : made;
    wire [8*27-1:0]     read;
    wire [9*(P+4)-1:0]  at;
    wire [8*(P+4)-1:0]  from;
    genvar i;
    generate
        for (i = 0; i < 9; i = i + 1) begin : g_place
            wire [5:0] place = places[6*i +: 6];
            assign at[(P+4)*i +: P+4] = place[5] ? {place[4] ? in_next : in_page, place[3:0]}
                                               : {{(P-1){1'b0}}, place[4:0]};
        end
        for (i = 0; i < 8; i = i + 1) begin : g_file
            (* no_rw_check *) reg [26:0] file[0:(1<<P+4)-1];
            reg [26:0] data;
            initial begin
                file[4] = 27'h2000000;
                file[5] = 27'h1000000;
                file[6] = 27'h3000000;
                file[7] = 27'h0000000;
            end
            always @(posedge clk) begin
                if (i != 7 || reads || in_fetch)  // a fetched word is held
                    data <= file[i == 7 && in_fetch ? in_own : from[(P+4)*i +: P+4]];
                if (write || in_set)
                    file[to] <= value;
            end
            assign read[27*i +: 27] = data;
        end
    endgenerate
    assign dest_now = at[P+3:0];
    assign out_read = read[27*7 +: 27];

    // Products, then their sum; half a unit is added to E F
    wire signed [4*54-1:0] parts;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [53:0] ab_now = PIPE != 0 ? $signed(parts[54*3 +: 54])
                                          : $signed(read[27*7 +: 27]) * $signed(read[27*6 +: 27]);
    wire signed [53:0] cd_now = PIPE != 0 ? $signed(parts[54*2 +: 54])
                                          : $signed(read[27*5 +: 27]) * $signed(read[27*4 +: 27]);
    wire signed [53:0] ef_now = PIPE != 0 ? $signed(parts[54*1 +: 54])
                                          : $signed(read[27*3 +: 27]) * $signed(read[27*2 +: 27]);
    wire signed [53:0] gh_now = PIPE != 0 ? $signed(parts[54*0 +: 54])
                                          : $signed(read[27*1 +: 27]) * $signed(read[27*0 +: 27]);
    reg  [31:0]        ab, cd, ef, gh;
    wire [31:0]        total;
    wire [31:0]        sum = PIPE != 0 ? total : (ab + cd) + ((ef + {29'd0, !half, 1'b0, half}) - gh);
    always @(posedge clk)
        {ab, cd, ef, gh} <= {ab_now[53:22], cd_now[53:22], ef_now[53:22], gh_now[53:22]};
    /* verilator lint_on UNUSEDSIGNAL */
    generate
        if (PIPE == 0) begin : g_sum
            assign {write1, step1, still1, square1, dest1, error1} = {write0, step0, still0, square0, dest0, error0};
            assign half = step;
            assign {reads, from} = {in_run, at[9*(P+4)-1:P+4]};
            assign parts = 216'd0;
            assign total = 32'd0;
        end else begin : g_pipe
            reg  [8*(P+4)-1:0] asked;
            reg  [5*(P+9)-1:0] state;  // of lines whose words, factors, parts, products, sums of two are there
            reg  [31:0]        left, right, both;
            assign {write1, step1, still1, square1, dest1, error1} = state[P+8:0];
            assign half = state[2*(P+9)-2];
            assign {reads, from} = {write0, asked};
            assign total = both;
            for (i = 0; i < 4; i = i + 1) begin : g_product
                engine_gd_n_product product (.clk(clk), .in_a(read[54*i+27 +: 27]), .in_b(read[54*i +: 27]),
                    .out_ab(parts[54*i +: 54]));
            end
            always @(posedge clk) begin
                asked <= at[9*(P+4)-1:P+4];
                state <= {write0, step0, still0, square0, dest0, error0, state[5*(P+9)-1:P+9]};
                left  <= ab + cd;
                right <= (ef + {29'd0, !half, 1'b0, half}) - gh;
                both  <= left + right;
            end
        end
    endgenerate
    wire        beyond = sum[31:22] != {10{sum[31]}};
    wire [26:0] stepped = beyond ? {{4{sum[31]}}, {23{!sum[31]}}} : {{4{sum[22]}}, sum[21:0], 1'b0};
    wire [25:0] fold = out_word[25:0] ^ {26{out_word[26]}};
    assign      made = step ? stepped & {27{!still}} : sum[29:3];
    assign      out_word = PIPE == 0 ? made : sum[29:3];  // no STEP is an error or a square
    assign      out_error = error;
    assign      out_off = square && out_word[26:13] != 14'h1000 && out_word[26:13] != 14'h0FFF;
    assign      out_over = sum[31:30] != {2{sum[29]}};
    assign      out_close = fold[25:22] == 4'd0 && fold[21:0] < cfg_tol;
endmodule
`default_nettype wire
