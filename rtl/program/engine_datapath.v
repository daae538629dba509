// SPDX-License-Identifier: Apache-2.0
// Sums of two products, one line a clock, on a register file of 64 words for each of CONTEXTS users. product_engine is
// this module with one user; its ports and formats are described there.
//   word = A B [+- C D] [+ the sum before] rounded to 2^-25, written to DEST; a single product may be shifted
// A line reads in one clock, selects its operands in the next, multiplies in PIPE more and computes in the next.
// With several contexts: a line without in_live does nothing; in_start clears what a line could find of an earlier
// program, but for the registers of in_context; with in_forget no direction is held; in_run is 1. in_context and
// in_forget stay until the last line has computed. Register 0 is 0 between programs. out_read: the register of A, one
// clock after its line. The file is stored four times, for four reads a clock. Models: product_engine.dot, .unit, .root
`default_nettype none
module engine_datapath #(
    parameter PIPE = 0,      // 0 to 2 (default 0); 1: registers behind products, 2: behind products of 18 x 18 bits too
    parameter ROOTS = 1,     // 0 or 1 (default 1); 0: sums only, without ACT, ALIGN and root tables
    parameter WRIST = 12,    // lowest bit that counts with act WRIST, 0 to 25 (default 12, 8 units of 2^-16)
    parameter SLACK = 13,    // lowest bit that is an error with act CHECK, 0 to 25 (default 13, 16 units of 2^-16)
    parameter MARGINS = 0,   // 0 or 1 (default 0); 1: NEAR (CHECK | WRIST), OVER (CHECK | FAR), C of HOLD (CONTEXTS 1)
    parameter QUOTIENTS = 0, // 0 or 1 (default 0); 1: in_start clears the outcome of FAR
    parameter CONTEXTS = 1,  // register files: 1, 2, 4 or 8 (default 1)
    parameter B = 1          // bits of in_context: 3 with eight, 2 with four, 1 with fewer (default 1)
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_start,
    input  wire         in_run,
    input  wire         in_live,
    input  wire [B-1:0] in_context,
    input  wire         in_forget,
    input  wire [46:0]  in_op,
    input  wire [26:0]  in_port,
    input  wire [2:0]   in_signs,
    output wire [26:0]  out_read,
    output reg  [26:0]  out_word,
    output wire [5:0]   out_dest,
    output wire [3:0]   out_status
);
    generate
        if (PIPE < 0 || PIPE > 2 || CONTEXTS < 1 || CONTEXTS > 8 || CONTEXTS != 1 && CONTEXTS != 1 << B)
        begin : g_illegal
            engine_datapath_needs_PIPE_from_0_to_2_and_CONTEXTS_of_1_2_4_or_8_and_its_B rule ();
        end
    endgenerate

    localparam SHARED = CONTEXTS > 1 ? 1 : 0;
    localparam OWN = SHARED == 0 ? MARGINS : 0;
    localparam N = 6 + SHARED * B;           // bits of a register's address
    localparam [46:0] NOTHING = SHARED != 0 ? 47'h2044_0000_0000 : 47'd0;  // word = PORT * 0

    reg  [46:0]         chosen;  // the line whose operands are selected
    reg  [19*PIPE+18:0] ops;     // fields of the lines whose operands were selected, 19 bits each, the oldest lowest
    wire [19*PIPE+37:0] queue = {chosen[18:0], ops};
    wire [18:0]         op = ops[18:0];  // fields of the line that computes
    reg  [5:0]          written;
    assign      out_dest = written & {6{in_run}};
    wire [8:0]  act = op[8:0] & {9{ROOTS != 0 && in_run}};
    wire        clear = in_start && SHARED != 0;
    wire [5:0]  dest = op[14:9];
    wire        low = op[15] && ROOTS != 0, mid = op[16] && ROOTS != 0, keep = op[17], subtract = op[18];

    wire [N-1:0] read1, read2, read3, read4, write;
    generate
        if (SHARED != 0) begin : g_contexts
            assign {read1, read2} = {in_context, in_op[44:39], in_context, in_op[37:32]};
            assign {read3, read4} = {in_context, in_op[31:26], in_context, in_op[25:20]};
            assign write          = {in_context, dest};
        end else begin : g_context
            assign {read1, read2, read3, read4, write} = {in_op[44:39], in_op[37:20], dest};
        end
    endgenerate
    wire [26:0]     read_a, read_b, read_c, read_d;
    wire [26:0]     word;
    reg  [PIPE:0]   skips;  // as ops
    wire            skip = skips[0];  // the register keeps its word
    wire [PIPE+1:0] skip_queue;
    engine_file #(.N(N), .CLEAR(SHARED)) file (.clk(clk), .in_a(read1), .in_b(read2), .in_c(read3), .in_d(read4),
        .in_write(!skip), .in_at(write), .in_word(word), .out_a(read_a),
        .out_b(read_b), .out_c(read_c), .out_d(read_d));

    // Operands: A is a register, PORT, LAST or the table's W; B a register, the table's SLOPE or its complement, a
    // power of two, 0 or +-1
    wire [20:0] w;
    wire [19:0] slope;
    wire [25:0] power, four;
    wire [13:0] twice;
    wire        whole;  // the root's argument is 1.0: its double wraps to -2.0, so the slope's sign turns as well
    wire        turned = (chosen[36:35] == 2'd1 && in_signs[0] || chosen[36:35] == 2'd2 && in_signs[1]
                      || chosen[36:35] == 2'd3 && in_signs[2]) ^ whole;
    wire       far, minus, none;  // outcome of FAR and of ROOT, known two lines later
    wire [3:1] fresh;             // joints 1, 2 and 4 (by bits of DEST) never had a direction
    wire       never = chosen[12] ? fresh[3] : chosen[11] ? fresh[2] : fresh[1];
    wire       bound = chosen[7] && far && ROOTS != 0, lost = chosen[5] && none && ROOTS != 0;
    wire       own = chosen[31:26] != 6'd0;  // OWN: HOLD writes the word of C, its register, once more
    assign     skip_queue = {OWN != 0 ? lost && !never && !own : lost && !never, skips};
    wire [3:0]  newer;  // PIPE 2: the register of A, B, C, D was written while it was read, out_word is its word
    wire        file1 = chosen[46:45] == 2'd0, file2 = !chosen[38];
    reg  [26:0] other1, other2;  // operands that come from no register
    always @* begin
        case (chosen[46:45])
            2'd1: other1 = in_port;
            2'd2: other1 = word;
            default: other1 = {6'd0, w};
        endcase
        other2 = chosen[37] ? {chosen[34], 26'h2000000} : 27'd0;
        if (!chosen[37] && !chosen[34] && ROOTS != 0)
            case (chosen[33:32])
                2'd0: other2 = {7'd0, slope} ^ {27{turned}};
                2'd1: other2 = {1'b0, power};
                2'd2: other2 = {1'b0, four};
                default: other2 = {13'd0, twice};
            endcase
    end

    // The output of a memory is late: where clocks are short it passes one gate
    wire        again = OWN != 0 && lost && own && !never;  // a held word times 1
    wire        pair = chosen[19] || again;                 // else a single product
    reg  [26:0] a, b, c, d;
    always @(posedge clk) begin
        if (PIPE < 2) begin
            a <= file1 ? read_a : other1;
            b <= file2 ? read_b : other2;
        end else begin
            a <= read_a & {27{file1 && !newer[3]}} | (file1 ? out_word & {27{newer[3]}} : other1);
            b <= read_b & {27{file2 && !newer[2]}} | (file2 ? out_word & {27{newer[2]}} : other2);
        end
        c <= pair ? newer[1] ? out_word : read_c : 27'd0;
        d <= pair ? newer[0] ? out_word : read_d : 27'd0;
        if (bound || lost && never) begin  // +-1 times 1 out of reach; (1, 0) for a direction that was never defined
            a <= {bound && minus, bound || !chosen[9], 25'd0};
            b <= 27'h2000000;
        end
        if (OWN != 0)
            if (again) begin
                a <= 27'd0;
                d <= 27'h2000000;
            end
        skips <= skip_queue[PIPE+1:1];
    end

    generate
        if (PIPE == 2) begin : g_through
            reg [3:0] through;
            assign newer = through;
            always @(posedge clk)
                through <= {in_op[44:39] == dest, in_op[37:32] == dest, in_op[31:26] == dest, in_op[25:20] == dest}
                           & {4{!skip}};
        end else begin : g_stored
            assign newer = 4'd0;
        end
    endgenerate

    reg  [31:0]        kept;  // the sum of the line before, or half a unit of a word
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [53:0] product1, product2;
    /* verilator lint_on UNUSEDSIGNAL */
    wire [31:0]        sum;
    wire               outside, minus1;  // a LOW product is beyond +-1, below 0
    wire [19:0]        argument;        // of a root
    engine_products #(.PIPE(PIPE)) products (.clk(clk), .in_a(a), .in_b(b), .in_c(c), .in_d(d), .in_invert(queue[37]),
        .out_ab(product1), .out_cd(product2));
    generate
        if (PIPE < 2) begin : g_three
            wire [31:0] term = product2[53:22] ^ {32{subtract}};
            wire [31:0] odd  = product1[53:22] ^ term ^ kept;  // sums and carries are fewer cells in Yosys
            wire [30:0] two  = product1[52:22] & term[30:0] | (product1[52:22] | term[30:0]) & kept[30:0];
            assign sum      = odd + {two, 1'b0};
            assign word     = low ? product1[26:0] : mid ? product1[38:12] : sum[29:3];
            assign outside  = product1[53:25] != {29{product1[53]}};
            assign minus1   = product1[53];
            assign argument = low ? product1[26:7] : sum[31:12];
        end else begin : g_two  // the products are aligned and added before the register, one clock before the sum
            reg  [31:0] both;
            reg         wide, negative;
            wire        low1 = queue[34] && ROOTS != 0, mid1 = queue[35] && ROOTS != 0;
            wire [31:0] added = product1[53:22] + product2[53:22];
            assign sum      = both + kept;
            assign word     = sum[29:3];
            assign outside  = wide;
            assign minus1   = negative;
            assign argument = low ? sum[29:10] : sum[31:12];
            always @(posedge clk) begin
                both     <= low1 ? {2'd0, product1[26:0], 3'd0} : mid1 ? {2'd0, product1[38:12], 3'd0} : added;
                wide     <= product1[53:25] != {29{product1[53]}};
                negative <= product1[53];
            end
        end
    endgenerate

    wire [25:0] fold = word[25:0] ^ {26{word[26]}};
    generate
        if (ROOTS != 0) begin : g_roots
            wire       empty;
            wire       wide = low && outside;  // the word is beyond +-1
            wire       ask;                    // a root is looked up
            wire [19:0] q;
            reg        long, below, sign, unknown, check, beyond, off, one;
            reg  [3:1] held;
            wire [3:1] first;
            wire       nears = act[8] && act[2], overs = act[8] && act[6];  // with MARGINS
            wire       close;  // NEAR found a direction close to one that is undefined
            engine_roots #(.WRIST(WRIST)) roots (.clk(clk), .in_first(act[0]), .in_more(act[1]), .in_wrist(act[2]),
                .in_none(act[3] && sum[31]), .in_fold(fold), .in_read(ask), .in_q(q), .in_clear(clear),
                .out_w(w), .out_slope(slope), .out_power(power), .out_four(four), .out_twice(twice),
                .out_empty(empty));
            assign {far, minus, none, fresh} = {long, sign, unknown, first};
            assign whole = one;
            assign out_status = {off, 1'b0, OWN != 0 ? held != 3'd0 || close : held != 3'd0, below || long};
            always @(posedge clk) begin
                if (SHARED != 0)  // any one is told
                    below <= below || (act[3] ? sum[31] : act[6] && !low && !overs && long);
                else if (act[3])
                    below <= sum[31];
                if (act[4])
                    {unknown, one} <= {empty, low && power[0]};
                if (SHARED != 0)
                    held <= {2'd0, held[1] || (act[5] ? none : MARGINS != 0 && nears && sum[31])};
                else if (act[5])
                    held <= op[12] ? {none, held[2:1]} : op[11] ? {held[3], none, held[1]} : {held[3:2], none};
                if (act[6]) begin
                    long <= low ? long || wide : !sum[31] && sum[30:29] != 2'd0;
                    sign <= low && minus1 && !long;
                end
                if (QUOTIENTS != 0)
                    if (in_start)
                        long <= 1'b0;
                if (MARGINS != 0)
                    if (overs) begin  // a clamp at -1 is told by itself, one at 1 by this sum
                        long <= long && sign || sum[31];
                        sign <= sign;
                    end
                check  <= MARGINS != 0 ? act[8] && !nears && !overs : act[8];
                beyond <= sum[31:29] != {3{sum[31]}};  // the word has wrapped, maybe to 0
                off    <= !in_start && (off || in_run && check
                                        && (beyond || (out_word[25:SLACK] ^ {26-SLACK{out_word[26]}}) != 0));
                if (rst || clear)
                    {held, below, long} <= 5'd0;  // flags of acts that a program has not are 0
                if (clear)
                    {unknown, one, sign} <= 3'd0;
            end
            if (SHARED != 0) begin : g_forgets
                assign first = {3{in_forget}};
            end else begin : g_knows
                reg [3:1] undefined;
                assign first = undefined;
                always @(posedge clk)
                    if (rst)
                        undefined <= 3'b111;
                    else if (act[5] && !none && op[9])
                        undefined <= undefined & {!op[12], !op[11] || op[12], op[11] || op[12]};
            end
            if (OWN != 0) begin : g_margins
                reg [3:1] closes;
                assign close = closes != 3'd0;
                always @(posedge clk)
                    if (rst || clear)
                        closes <= 3'd0;
                    else if (nears)
                        closes <= op[12] ? {sum[31], closes[2:1]} : op[11] ? {closes[3], sum[31], closes[1]}
                                  : {closes[3:2], sum[31]};
            end else begin : g_exact
                assign close = 1'b0;
            end
            if (PIPE == 0) begin : g_asked
                reg        read;
                reg [19:0] held_q;
                assign {ask, q} = {read, held_q};
                always @(posedge clk) begin
                    held_q <= argument;
                    read   <= act[4] || clear;
                end
            end else begin : g_asks  // the memory registers its address
                assign {ask, q} = {act[4] || clear, argument};
            end
        end else begin : g_sums
            assign {w, slope, power, four, twice} = 107'd0;
            assign {far, minus, none, fresh} = 6'd0;
            assign whole = 1'b0;
            assign out_status = 4'd0;
        end
    endgenerate

    always @(posedge clk) begin
        chosen   <= rst || SHARED != 0 && !in_live ? NOTHING : in_op;
        ops      <= rst ? {(19*PIPE+19){1'b0}} : queue[19*PIPE+37:19];
        kept     <= keep ? sum : 32'd4;
        out_word <= word;
        written  <= skip ? 6'd0 : dest;
    end
    assign out_read = read_a;
    wire unused = &{1'b0, in_start, in_live, in_context, in_forget, clear, in_signs, act, fold, low, mid, subtract,
        outside, minus1, argument, chosen, queue, skip_queue, own};
endmodule
`default_nettype wire
