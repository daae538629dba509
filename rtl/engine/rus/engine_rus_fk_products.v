// SPDX-License-Identifier: Apache-2.0
// Sums of two products, one line a clock, on a register file of 16 pages, for engine_rus_fk_program.
//   word = A B +- C D [+ the sum of the line before] rounded to 2^-25, written to DEST
// A line reads in one clock, and loads operands, multiplies and adds in the next three. Its word can be read four lines
// later.
// Formats: words s2.25; sum s4.28, it wraps, and out_over marks a word that did; products truncated to 2^-28, and of a
// subtracted one the complement is added. in_op {A 7, B 7, C 7, D 7, DEST 7, SUB 1, KEEP 1, ACT 3}, pages by in_i and
// in_j. in_range: low bits of the constants of a SCALE line. in_set writes in_word to address in_own; in_fetch reads
// out_read there. out_act is that of the line that adds, and so are the other outputs. The register file is stored four
// times, for four reads a clock. Model: engine_rus_fk.fk
`default_nettype none
module engine_rus_fk_products (
    input  wire        clk,
    input  wire [21:0] cfg_tol,
    input  wire [39:0] in_op,
    input  wire        in_run,        // a line reads
    input  wire        in_adds,       // a line adds and writes
    input  wire [2:0]  in_i,
    input  wire [2:0]  in_j,
    input  wire [1:0]  in_range,
    input  wire        in_set,
    input  wire [7:0]  in_own,
    input  wire [26:0] in_word,
    input  wire        in_fetch,
    output wire [26:0] out_read,
    output wire [2:0]  out_act,       // 4 (LOOSE) if no line adds
    output wire        out_over,      // the word does not fit
    output wire        out_off,       // a miss beyond cfg_tol (-cfg_tol passes), or a quaternion off length 1
    output wire [1:0]  out_size,      // range of a square: 0 from 1 on, 1 from 1/4, 2 from 1/16, else 3
    output wire        out_negative
);
    // Addresses
    wire [2:0]  next_j = in_j + 3'd1;
    wire [39:0] at;
    wire        scale = in_op[2:0] == 3'd3;
    genvar i;
    generate
        for (i = 0; i < 5; i = i + 1) begin : g_place
            wire [6:0] place = in_op[5+7*i +: 7];
            wire [2:0] row = place[5] ? place[4] ? next_j : in_j : in_i;
            assign at[8*i+4 +: 4] = {place[5] || place[6] && place[4], place[6] ? row : {3{place[4]}}};
            if (i == 1 || i == 3) begin : g_constant
                assign at[8*i +: 4] = {place[3:2], place[1:0] | in_range & {2{scale}}};
            end else begin : g_word
                assign at[8*i +: 4] = place[3:0];
            end
        end
    endgenerate

    // State of the lines that load, multiply and add
    reg [12:0] load, multiply, add;  // {DEST, SUB, KEEP, ACT}
    always @(posedge clk) begin
        load     <= {at[7:0], in_op[4:0]};
        multiply <= load;
        add      <= multiply;
    end
    wire subtract = add[4], keep = add[3];
    assign out_act = in_adds ? add[2:0] : 3'd4;

    // Register file, operands, products
    wire [7:0]   to = in_set ? in_own : add[12:5];
    wire [26:0]  word;
    wire [26:0]  value = in_set ? in_word : word;
    wire [107:0] operand;
    generate
        for (i = 0; i < 4; i = i + 1) begin : g_file
            (* no_rw_check *) reg [26:0] file[0:255];
            reg [26:0] read, data;
            initial begin
                file[128] = 27'h0800000;  // 1/4
                file[129] = 27'h1000000;  // 1/2
                file[130] = 27'h2000000;  // 1
                file[131] = 27'h3FFFFFF;  // nearly 2
                file[132] = 27'h0000000;
                file[133] = 27'h3000000;  // 3/2
                file[134] = 27'd44809508;          // 1 / (2 sqrt(s)) = P0 + P1 s + P2 s^2 to 2.4 %, s from 1/4 to 1
                file[135] = -27'd55119815;
                file[136] = 27'd27490843;
            end
            always @(posedge clk) begin
                if (i != 3 || in_run || in_fetch)  // a fetched word is held
                    read <= file[i == 3 && in_fetch ? in_own : at[8*i+8 +: 8]];
                data <= read;
                if (in_adds || in_set)
                    file[to] <= value;
            end
            assign operand[27*i +: 27] = data;
            if (i == 3) begin : g_read
                assign out_read = read;
            end
        end
    endgenerate

    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [53:0] product1 = $signed(operand[107:81]) * $signed(operand[80:54]);
    wire signed [53:0] product2 = $signed(operand[53:27]) * $signed(operand[26:0]);
    /* verilator lint_on UNUSEDSIGNAL */
    reg  [31:0] ab, cd, kept;  // kept: the sum of the line before, or half a unit of a word
    wire [31:0] sum = ab + (cd ^ {32{subtract}}) + kept;
    wire [25:0] fold = word[25:0] ^ {26{word[26]}};
    assign      word = sum[29:3];
    assign      out_over = sum[31:30] != {2{sum[29]}};
    assign      out_off = add[1] ? fold[25:5] != 21'd0 : fold[25:22] != 4'd0 || fold[21:0] >= cfg_tol;
    assign      out_size = sum[31:28] != 4'd0 ? 2'd0 : sum[27:26] != 2'd0 ? 2'd1 : sum[25:24] != 2'd0 ? 2'd2 : 2'd3;
    assign      out_negative = sum[31];
    always @(posedge clk) begin
        ab   <= product1[53:22];
        cd   <= product2[53:22];
        kept <= keep ? sum : 32'd4;
    end
endmodule
`default_nettype wire
