// SPDX-License-Identifier: Apache-2.0
// Sums of two products a clock on a register file of 64 words, for programs that engine_program plays.
//   word = A B [+- C D] [+ the sum before] to nearest 2^-25, written to DEST; products of one term shifted for roots
// A line reads in one clock and computes in the next; its word can be read from the second line behind on, by the next
// line as LAST. Formats: words s2.25; sum s4.28, each product truncated to 2^-28; it wraps.
//   in_op {A 8, B 7, C 6, D 6, SUM 2, KEEP 1, ALIGN 2, DEST 6, ACT 9}: rtl/engine/README.md
//   in_port: the word of a PORT operand, one clock after its line; in_signs: BACK, DOWN, FLIP take SLOPE's complement;
//   in_run: not idle, or nothing is done but writing to registers
//   out_word, out_dest: the word of the line before, and its register, 0 for none. out_status: unreachable, singular,
//   bit 3 a failed CHECK, of all lines since in_start
// The register file is stored four times, for four reads a clock. Model: six._dot, six._unit, six._root
`default_nettype none
module product_engine #(
    parameter ROOTS = 1,   // 0: sums alone: no ACT, no ALIGN, no tables; 1
    parameter WRIST = 12,  // ACT WRIST: lowest bit of a vector that gives it a direction, 0 to 25: 12, 8 units of 2^-16
    parameter SLACK = 13   // ACT CHECK: lowest bit that is an error, 0 to 25: 13, 16 units of 2^-16
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    input  wire        in_run,
    input  wire [46:0] in_op,
    input  wire [26:0] in_port,
    input  wire [2:0]  in_signs,
    output reg  [26:0] out_word,
    output wire [5:0]  out_dest,
    output wire [3:0]  out_status
);
    reg  [46:0] op;  // of the clock in which it computes
    reg  [5:0]  written;
    assign      out_dest = written & {6{in_run}};
    wire [8:0]  act = op[8:0] & {9{ROOTS != 0 && in_run}};
    wire [5:0]  dest = op[14:9];
    wire        low = op[15] && ROOTS != 0, mid = op[16] && ROOTS != 0, keep = op[17], minus = op[18], two = op[19];

    // Register file; an operation never reads a register that is being written
    (* no_rw_check *) reg [26:0] file_a[0:63];
    (* no_rw_check *) reg [26:0] file_b[0:63];
    (* no_rw_check *) reg [26:0] file_c[0:63];
    (* no_rw_check *) reg [26:0] file_d[0:63];
    reg  [26:0] read_a, read_b, read_c, read_d;
    wire [26:0] word;
    wire        skip;  // a held word is not written
    always @(posedge clk) begin
        read_a <= file_a[in_op[44:39]];
        read_b <= file_b[in_op[37:32]];
        read_c <= file_c[in_op[31:26]];
        read_d <= file_d[in_op[25:20]];
        if (!skip) begin
            file_a[dest] <= word;
            file_b[dest] <= word;
            file_c[dest] <= word;
            file_d[dest] <= word;
        end
    end

    // Operands: A is a register, PORT, LAST or the table's W; B a register, the table's SLOPE or its complement, a
    // power of two, 0 or +-1
    wire [20:0] w;
    wire [19:0] slope;
    wire [25:0] power, four;
    wire [13:0] twice;
    wire        turned = op[36:35] == 2'd1 && in_signs[0] || op[36:35] == 2'd2 && in_signs[1]
                      || op[36:35] == 2'd3 && in_signs[2];
    reg  [26:0] a, b;
    always @* begin
        case (op[46:45])
            2'd0: a = read_a;
            2'd1: a = in_port;
            2'd2: a = out_word;
            default: a = {6'd0, w};
        endcase
        b = read_b;
        if (op[38])
            b = op[37] ? {op[34], 26'h2000000} : 27'd0;
        if (op[38] && !op[37] && !op[34] && ROOTS != 0)
            case (op[33:32])
                2'd0: b = {7'd0, slope} ^ {27{turned}};
                2'd1: b = {1'b0, power};
                2'd2: b = {1'b0, four};
                default: b = {13'd0, twice};
            endcase
    end

    reg  [31:0]        kept;  // the sum before, or half a unit of a word
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [53:0] product1 = $signed(a) * $signed(b), product2 = $signed(read_c) * $signed(read_d);
    /* verilator lint_on UNUSEDSIGNAL */
    wire [31:0]        sum = product1[53:22] + ((product2[53:22] & {32{two}}) ^ {32{minus}}) + kept;
    wire [26:0]        value = low ? product1[26:0] : mid ? product1[38:12] : sum[29:3];

    // Words that are none of these: 0 for a negative radicand, +-1 for a cosine out of reach, (1, 0) for a direction
    // that was never defined
    wire       far, none, over, below;
    wire [3:1] fresh;  // no direction yet: joints 1, 2 and 4, by bits of DEST
    wire       never = op[12] ? fresh[3] : op[11] ? fresh[2] : fresh[1];
    wire       lost = act[5] && none;
    wire [1:0] top = over ? {product1[53] && !far, 1'b1} : {1'b0, lost && !op[9]};
    assign     over = act[7] && (far || product1[53:25] != {29{product1[53]}});
    assign     below = act[3] && sum[31];
    assign     word = over || below || lost ? {top, 25'd0} : value;
    assign     skip = lost && !never;

    wire [25:0] fold = word[25:0] ^ {26{word[26]}};
    generate
        if (ROOTS != 0) begin : g_roots
            wire       empty;
            reg        long, unknown, unreachable, singular, off;
            reg  [3:1] first;
            engine_roots #(.WRIST(WRIST)) roots (.clk(clk), .in_first(act[0]), .in_more(act[1]), .in_wrist(act[2]),
                .in_fold(fold), .in_read(act[4]), .in_q(low ? product1[26:7] : sum[31:12]), .out_w(w),
                .out_slope(slope), .out_power(power), .out_four(four), .out_twice(twice), .out_empty(empty));
            assign {far, none, fresh} = {long, unknown, first};
            assign out_status = {off, 1'b0, singular, unreachable};
            always @(posedge clk) begin
                if (act[4])
                    unknown <= empty;
                if (act[6])
                    long <= !sum[31] && sum[30:29] != 2'd0;
                unreachable <= !in_start && (unreachable || below || over);
                singular    <= !in_start && (singular || lost);
                off         <= !in_start && (off || act[8] && |fold[25:SLACK]);
                if (act[5] && !none && op[9])
                    first <= first & {!op[12], !op[11] || op[12], op[11] || op[12]};
                if (rst)
                    first <= 3'b111;
            end
        end else begin : g_sums
            assign {w, slope, power, four, twice} = 107'd0;
            assign {far, none, fresh} = 5'd0;
            assign out_status = 4'd0;
        end
    endgenerate

    always @(posedge clk) begin
        op       <= rst ? 47'd0 : in_op;
        kept     <= keep ? sum : 32'd4;
        out_word <= word;
        written  <= skip ? 6'd0 : dest;
    end
    wire unused = &{1'b0, in_start, in_signs, act, fold, low, mid, op};
endmodule
`default_nettype wire
