// SPDX-License-Identifier: Apache-2.0
// Sums of two products, one line a clock, on a register file of 16 pages, for engine_rus_fk_program.
//   word = A B +- C D [+ the sum of the line before] rounded to 2^-25, written to DEST
// A line reads in one clock, and loads operands, multiplies and adds in the next three. Its word can be read four lines
// later. PIPE = 1: registers in front of reading, within multiplying and in front of the flags; five lines later.
// Formats: words s2.25; sum s4.28, it wraps, and out_over marks a word that did; products truncated to 2^-28, and of a
// subtracted one the complement is added. in_op {A 7, B 7, C 7, D 7, DEST 7, SUB 1, KEEP 1, ACT 3}, pages by in_i and
// in_j. in_range: low bits of the constants of a SCALE line. in_set writes in_word to address in_own; in_fetch reads
// out_read there. out_act is that of the line that adds, and so are the other outputs. The register file is stored four
// times, for four reads a clock. Model: engine_rus_fk.fk
`default_nettype none
module engine_rus_fk_products #(
    parameter PIPE = 0,      // registers behind addresses, products and sums, 0 or 1 (default 0)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
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
    localparam [2:0] UNIT = 3'd2, SCALE = 3'd3, LOOSE = 3'd4;  // ACT, as in engine_rus_fk_program
    wire [34:0] places;  // A, B, C, D, DEST
    wire        sub_op, keep_op;
    wire [2:0]  act_op;
    assign      {places, sub_op, keep_op, act_op} = in_op;

    // Addresses
    wire [2:0]  next_j = in_j + 3'd1;
    wire [39:0] select;
    wire        scale = act_op == SCALE;
    genvar i;
    generate
        for (i = 0; i < 5; i = i + 1) begin : g_place
            wire [6:0] place = places[7*i +: 7];
            wire [2:0] row = place[5] ? place[4] ? next_j : in_j : in_i;
            assign select[8*i+4 +: 4] = {place[5] || place[6] && place[4], place[6] ? row : {3{place[4]}}};
            if (i == 1 || i == 3) begin : g_constant
                assign select[8*i +: 4] = {place[3:2], place[1:0] | in_range & {2{scale}}};
            end else begin : g_word
                assign select[8*i +: 4] = place[3:0];
            end
        end
    endgenerate

    // State of the lines that read, load, multiply and add
    wire [31:0] at;                   // {A, B, C, D} of the line that reads
    wire [12:0] read_op;              // {DEST, SUB, KEEP, ACT}
    reg  [12:0] load, multiply, add;  // the same
    wire [12:0] last;                 // of the line that adds next
    always @(posedge clk) begin
        load     <= read_op;
        multiply <= load;
        add      <= last;
    end
    wire [7:0] dest;
    wire       sub, keep;
    wire [2:0] add_act;
    wire [2:0] act = in_adds ? add_act : LOOSE;
    assign     {dest, sub, keep, add_act} = add;

    // Register file, operands, products
    wire [7:0]   to = in_set ? in_own : dest;
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
                    read <= file[i == 3 && in_fetch ? in_own : at[8*i +: 8]];
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
    wire signed [53:0] product1, product2;
    /* verilator lint_on UNUSEDSIGNAL */
    reg  [31:0] ab, cd, kept;  // kept: the sum of the line before, or half a unit of a word
    wire [31:0] next, term;    // of the sum: the second product, or its complement
    wire [31:0] sum = ab + term + kept;
    wire [28:0] seen;          // the sum that the flags tell of
    wire        unit;
    wire [25:0] fold = seen[25:0] ^ {26{seen[26]}};
    assign      word = sum[29:3];
    assign      out_over = seen[28:27] != {2{seen[26]}};
    assign      out_off = unit ? fold[25:5] != 21'd0 : fold[25:22] != 4'd0 || fold[21:0] >= cfg_tol;
    assign      out_size = seen[28:25] != 4'd0 ? 2'd0 : seen[24:23] != 2'd0 ? 2'd1 : seen[22:21] != 2'd0 ? 2'd2 : 2'd3;
    assign      out_negative = seen[28];
    always @(posedge clk) begin
        ab   <= product1[53:22];
        cd   <= next;
        kept <= keep ? sum : 32'd4;
    end
    generate
        if (PIPE == 0) begin : g_now
            assign product1 = $signed(operand[107:81]) * $signed(operand[80:54]);
            assign product2 = $signed(operand[53:27]) * $signed(operand[26:0]);
            assign {at, read_op, last} = {select, sub_op, keep_op, act_op, multiply};
            assign {next, term} = {product2[53:22], cd ^ {32{sub}}};
            assign {seen, unit, out_act} = {sum[31:3], |(add_act & UNIT), act};
        end else begin : g_parts
            reg [44:0] placed;
            reg [12:0] sums;
            reg [28:0] added;
            reg [2:0]  acted;
            product_parts #(.A(27), .B(27), .MULTIPLY(MULTIPLY)) part1 (.clk(clk), .in_move(1'b1),
                .in_a(operand[107:81]), .in_b(operand[80:54]), .out_p(product1));
            product_parts #(.A(27), .B(27), .MULTIPLY(MULTIPLY)) part2 (.clk(clk), .in_move(1'b1),
                .in_a(operand[53:27]), .in_b(operand[26:0]), .out_p(product2));
            wire [7:0] unused_dest;
            wire       sums_sub, unused_keep;
            wire [2:0] unused_act;
            assign {unused_dest, sums_sub, unused_keep, unused_act} = sums;
            wire       unused = &{1'b0, sub};
            assign {at, read_op, last} = {placed, sums};
            assign {next, term} = {product2[53:22] ^ {32{sums_sub}}, cd};
            assign {seen, unit, out_act} = {added, |(acted & UNIT), acted};
            always @(posedge clk) begin
                placed <= {select, sub_op, keep_op, act_op};
                sums   <= multiply;
                added  <= sum[31:3];
                acted  <= act;
            end
        end
    endgenerate
endmodule
`default_nettype wire
