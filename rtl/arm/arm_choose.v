// SPDX-License-Identifier: Apache-2.0
// Runs an inverse kernel once for every branch of a target and keeps the best answer. It prefers, in this order, a
// branch within the limits of all joints, one in reach, and the one nearest to the last answer; among equals the first.
//   within: c mc + n mn > h for every joint, (mc, mn) being the middle of its range and h the cosine of half of it
//   nearest: the greatest sum over the joints of c c' + n n', the cosines of the steps from the last answer (c', n')
// An answer beyond the limits is not remembered. Reset sets the last answer to all joints at 0. out_go starts branch
// out_number, the first one a clock after out_take. in_done says that it has ended; in_c, in_n and in_status hold until
// out_next.
// Formats: c, n, mc, mn, h s2.U, joint 1 in the lowest bits. Products are truncated: a cosine is low by 2 LSB at most.
// Latency and II: 2 + BRANCHES (latency of the kernel + 2 JOINTS + 1 + PIPE); with PIPE = 1 and U above 16 one
// multiplier takes both products of a cosine in turn: 2 + BRANCHES (latency of the kernel + 4 JOINTS + 3).
// Status: that of the chosen branch; out_beyond: no branch is within the limits. Models: arm_keep.keep2, arm_keep.keep3
`default_nettype none
module arm_choose #(
    parameter JOINTS = 3,   // joints, 2 or 3 (default 3)
    parameter BRANCHES = 4, // branches, 2: elbow, or 4: elbow and side of the shoulder (default 4)
    parameter U = 16,       // fraction bits of cosine and sine, 8 to 24 (default 16)
    parameter PIPE = 0,     // 0 or 1 (default 0: fewest clocks); 1: registers behind the products, two with U above 16
    parameter MULTIPLY = 18 // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                    clk,
    input  wire                    rst,
    input  wire [JOINTS*(U+2)-1:0] cfg_mc,
    input  wire [JOINTS*(U+2)-1:0] cfg_mn,
    input  wire [JOINTS*(U+2)-1:0] cfg_h,
    input  wire                    in_valid,
    output wire                    in_ready,
    output wire                    out_take,
    output wire                    out_go,
    output wire [1:0]              out_number,
    input  wire                    in_done,
    output wire                    out_next,
    input  wire [JOINTS*(U+2)-1:0] in_c,
    input  wire [JOINTS*(U+2)-1:0] in_n,
    input  wire [3:0]              in_status,
    output wire [JOINTS*(U+2)-1:0] out_last_c,
    output wire [JOINTS*(U+2)-1:0] out_last_n,
    output reg                     out_valid,
    input  wire                    out_ready,
    output reg  [JOINTS*(U+2)-1:0] out_c,
    output reg  [JOINTS*(U+2)-1:0] out_n,
    output reg  [1:0]              out_best,
    output wire                    out_beyond,
    output reg  [3:0]              out_status
);
    localparam N = U + 2, S = U + 6;  // bits of a word and of a sum of cosines
    localparam LONG = PIPE == 1 && U > 16;

    // Schedule, a clock a line
    // Between branches the operands are those of the first line, joint 1 and the middle of its limits
    localparam [2:0]        // operands of the next clock
        MIDDLE1 = 3'b00_0,  // joint 1 and the middle of its limits
        MIDDLE2 = 3'b01_0,  // joint 2
        MIDDLE3 = 3'b10_0,  // joint 3
        LAST1   = 3'b00_1,  // joint 1 and what the last answer has for it
        LAST2   = 3'b01_1,  // joint 2
        LAST3   = 3'b10_1;  // joint 3
    localparam [2:0]        // what the cosine is
        NONE   = 3'b0_0_0,  // not used
        LIMIT  = 3'b1_0_0,  // of a joint with the middle of its limits
        STEP   = 3'b0_1_0,  // of the step of a joint
        BETTER = 3'b0_0_1;  // nothing; the branch is the answer if the best so far
    localparam [5*6-1:0] TWO = {
        /* limit 1 */ {LAST1,   LIMIT},
        /* step 1  */ {MIDDLE2, STEP},
        /* limit 2 */ {LAST2,   LIMIT},
        /* step 2  */ {MIDDLE1, STEP},
        /* decide  */ {MIDDLE1, BETTER}};
    localparam [7*6-1:0] THREE = {
        /* limit 1 */ {LAST1,   LIMIT},
        /* step 1  */ {MIDDLE2, STEP},
        /* limit 2 */ {LAST2,   LIMIT},
        /* step 2  */ {MIDDLE3, STEP},
        /* limit 3 */ {LAST3,   LIMIT},
        /* step 3  */ {MIDDLE1, STEP},
        /* decide  */ {MIDDLE1, BETTER}};
    // PIPE = 1: the cosine is there a clock later
    localparam [6*6-1:0] TWO_1 = {
        /* product */ {LAST1,   NONE},
        /* limit 1 */ {MIDDLE2, LIMIT},
        /* step 1  */ {LAST2,   STEP},
        /* limit 2 */ {MIDDLE1, LIMIT},
        /* step 2  */ {MIDDLE1, STEP},
        /* decide  */ {MIDDLE1, BETTER}};
    localparam [8*6-1:0] THREE_1 = {
        /* product */ {LAST1,   NONE},
        /* limit 1 */ {MIDDLE2, LIMIT},
        /* step 1  */ {LAST2,   STEP},
        /* limit 2 */ {MIDDLE3, LIMIT},
        /* step 2  */ {LAST3,   STEP},
        /* limit 3 */ {MIDDLE1, LIMIT},
        /* step 3  */ {MIDDLE1, STEP},
        /* decide  */ {MIDDLE1, BETTER}};
    // U above 16: one product a clock. It is known three clocks after its operands; that of the sines comes second
    localparam [3:0]        // operands of the next clock
        C_MIDDLE1 = {MIDDLE1, 1'b0}, N_MIDDLE1 = {MIDDLE1, 1'b1}, C_LAST1 = {LAST1, 1'b0}, N_LAST1 = {LAST1, 1'b1},
        C_MIDDLE2 = {MIDDLE2, 1'b0}, N_MIDDLE2 = {MIDDLE2, 1'b1}, C_LAST2 = {LAST2, 1'b0}, N_LAST2 = {LAST2, 1'b1},
        C_MIDDLE3 = {MIDDLE3, 1'b0}, N_MIDDLE3 = {MIDDLE3, 1'b1}, C_LAST3 = {LAST3, 1'b0}, N_LAST3 = {LAST3, 1'b1};
    localparam [3:0]        // what the product is
        NOTHING = {NONE, 1'b0},    // the first one of a step, added to the score; or not used
        BELOW   = {NONE, 1'b1},    // the first one of a limit, which is taken off
        LIMITED = {LIMIT, 1'b0},   // the second one of a limit: the sum is negative beyond it
        STEPPED = {STEP, 1'b0},    // the second one of a step
        DECIDE  = {BETTER, 1'b0};  // not used; the branch is the answer if the best so far
    localparam [11*8-1:0] TWO_2 = {
        /* operands */ {N_MIDDLE1, NOTHING},
        /* parts    */ {C_LAST1,   NOTHING},
        /* limit 1  */ {N_LAST1,   BELOW},
        /*          */ {C_MIDDLE2, LIMITED},
        /* step 1   */ {N_MIDDLE2, NOTHING},
        /*          */ {C_LAST2,   STEPPED},
        /* limit 2  */ {N_LAST2,   BELOW},
        /*          */ {C_MIDDLE1, LIMITED},
        /* step 2   */ {C_MIDDLE1, NOTHING},
        /*          */ {C_MIDDLE1, STEPPED},
        /* decide   */ {C_MIDDLE1, DECIDE}};
    localparam [15*8-1:0] THREE_2 = {
        /* operands */ {N_MIDDLE1, NOTHING},
        /* parts    */ {C_LAST1,   NOTHING},
        /* limit 1  */ {N_LAST1,   BELOW},
        /*          */ {C_MIDDLE2, LIMITED},
        /* step 1   */ {N_MIDDLE2, NOTHING},
        /*          */ {C_LAST2,   STEPPED},
        /* limit 2  */ {N_LAST2,   BELOW},
        /*          */ {C_MIDDLE3, LIMITED},
        /* step 2   */ {N_MIDDLE3, NOTHING},
        /*          */ {C_LAST3,   STEPPED},
        /* limit 3  */ {N_LAST3,   BELOW},
        /*          */ {C_MIDDLE1, LIMITED},
        /* step 3   */ {C_MIDDLE1, NOTHING},
        /*          */ {C_MIDDLE1, STEPPED},
        /* decide   */ {C_MIDDLE1, DECIDE}};
    wire [1:0] joint;
    wire       to_last, sines, limit, step, better, below, idle;
    reg        busy, begun;     // a target is being solved; its first branch starts
    reg  [1:0] number;
    wire       last_one = number == (BRANCHES == 4 ? 2'd3 : 2'd1);
    wire       start = in_done && idle;
    localparam             LINES = LONG ? 4 * JOINTS + 3 : 2 * JOINTS + 1 + PIPE;
    localparam [5:0]       NO_LINE = 6'd0;
    localparam [8*6-1:0]   TABLE =  // the last LINES lines
        JOINTS == 2 ? (PIPE == 1 ? {{2{NO_LINE}}, TWO_1} : {{3{NO_LINE}}, TWO})
        : PIPE == 1 ? THREE_1 : {NO_LINE, THREE};
    localparam [15*8-1:0]  TABLE_2 = JOINTS == 2 ? {32'd0, TWO_2} : THREE_2;
    generate
        if (!LONG) begin : g_control  // in a block, so that Yosys takes it before the products
            schedule #(.LINES(LINES), .BITS(6), .TABLE(TABLE[LINES*6-1:0])) control (.clk(clk), .rst(rst),
                .in_start(start), .out_idle(idle), .out_op({joint, to_last, limit, step, better}));
            assign {sines, below} = 2'b00;
        end else begin : g_in_turn
            schedule #(.LINES(LINES), .BITS(8), .TABLE(TABLE_2[LINES*8-1:0])) control (.clk(clk), .rst(rst),
                .in_start(start), .out_idle(idle), .out_op({joint, to_last, sines, limit, step, better, below}));
        end
    endgenerate
    assign in_ready = !busy && (!out_valid || out_ready);
    assign out_take = in_valid && in_ready;
    assign out_next = better;
    assign out_go = begun || better && !last_one;
    assign out_number = number + {1'b0, better};

    // One cosine a clock, from registers: between a joint and the middle of its range or the last answer
    reg  [JOINTS*N-1:0] last_c, last_n;
    assign              out_last_c = last_c;
    assign              out_last_n = last_n;
    reg  signed [N-1:0] c, n, to_c, to_n, bound;
    reg  [S-1:0]        score, best_score;
    wire [S-1:0]        cosine, added;  // added: the score, or what takes off the limit and 1
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [2*N-1:0] product1, product2;
    /* verilator lint_on UNUSEDSIGNAL */
    generate
        if (LONG) begin : g_long
            wire signed [2*N-1:0] whole;
            reg  signed [2*N-1:0] settled;
            reg  [S-1:0]          first;
            product_parts #(.A(N), .B(N), .MULTIPLY(MULTIPLY)) multiplier (.clk(clk), .in_move(1'b1), .in_a(c),
                .in_b(to_c), .out_p(whole));
            always @(posedge clk) begin
                settled <= whole;
                first   <= cosine + (below ? ~{{(S-N){bound[N-1]}}, bound} : score);
            end
            assign product1 = settled;
            assign product2 = {(2*N){1'b0}};
            assign added = first;
            wire   unused = &{1'b0, n, to_n};
        end else begin : g_short
            wire         unused = below;
            wire [N-1:0] h;
            if (PIPE == 0) begin : g_now
                assign product1 = c * to_c;
                assign product2 = n * to_n;
                assign h = bound;
            end else begin : g_registered
                reg [N-1:0] bound_1;  // each limit stands for two clocks
                reg signed [2*N-1:0] whole1, whole2;
                always @(posedge clk) begin
                    bound_1 <= bound;
                    whole1 <= c * to_c;
                    whole2 <= n * to_n;
                end
                assign h = bound_1;
                assign product1 = whole1;
                assign product2 = whole2;
            end
            assign added = limit ? ~{{(S-N){h[N-1]}}, h} : score;
        end
    endgenerate
    assign       cosine = {{2{product1[2*N-1]}}, product1[2*N-1:U]} + {{2{product2[2*N-1]}}, product2[2*N-1:U]};
    wire [S-1:0] sum = cosine + added;
    reg          allowed, best_allowed, best_reach;
    wire         reach = !in_status[0];
    // The greater key is the better answer. Inverting the sign bit makes the sum comparable as an unsigned number
    wire [S+1:0] key = {allowed, reach, !score[S-1], score[S-2:0]};
    wire [S+1:0] best = {best_allowed, best_reach, !best_score[S-1], best_score[S-2:0]};
    wire         take = better && (number == 0 || key > best);
    assign       out_beyond = !best_allowed;
    function [N-1:0] of_joint;  // the word of the joint whose turn it is
        input [JOINTS*N-1:0] words;
        of_joint = joint[1] ? words[JOINTS*N-1 -: N] : joint[0] ? words[2*N-1:N] : words[N-1:0];
    endfunction
    always @(posedge clk) begin
        c     <= sines ? of_joint(in_n) : of_joint(in_c);
        n     <= of_joint(in_n);
        to_c  <= sines ? (to_last ? of_joint(last_n) : of_joint(cfg_mn))
               : to_last ? of_joint(last_c) : of_joint(cfg_mc);
        to_n  <= to_last ? of_joint(last_n) : of_joint(cfg_mn);
        bound <= of_joint(cfg_h);
        if (start || limit)
            allowed <= start || allowed && !sum[S-1];
        if (start || step)
            score <= start ? {S{1'b0}} : sum;
        if (take) begin
            out_c       <= in_c;
            out_n       <= in_n;
            out_best    <= number;
            out_status  <= in_status;
            best_allowed <= allowed;
            best_reach  <= reach;
            best_score  <= score;
        end
        if (out_take || better)
            number <= out_take ? 2'd0 : out_number;
        begun     <= !rst && out_take;
        busy      <= !rst && (out_take || busy && !(better && last_one));
        out_valid <= !rst && (better && last_one || out_valid && !out_ready);
        if (out_valid && best_allowed) begin
            last_c <= out_c;
            last_n <= out_n;
        end
        if (rst) begin
            last_c <= {JOINTS{2'b01, {U{1'b0}}}};
            last_n <= {(JOINTS*N){1'b0}};
        end
    end
endmodule
`default_nettype wire
