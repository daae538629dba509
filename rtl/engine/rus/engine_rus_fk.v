// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of a parallel robot with six RUS legs: six crank vectors to the platform's pose, by Newton's
// method.
//   rows (d, R c x d), d = R c + p - B, of the Jacobian of |d|^2 - LB^2, made orthonormal one by one: x = -sum y q
// in_op: 0 solve; 1 write in_word; 2, 3 read. out_word: word in_k of page in_n after the operation. Page 0: start, then
// pose: w, x, y, z, position (k = 0 to 6); link angle (7, 8). Pages 1 to 6, a leg: ball joint, foot (0 to 5), azimuth
// cos, sin (6, 7), link, crank, rod (8 to 10), crank cos, sin (11, 12). First written in order from (0, 0) on; a reset
// forgets. Formats: words s2.(W-2); cfg_tol 2^-25, of |d|^2 - LB^2. Error of a rod: ((cfg_tol + 1) / 2 LB + 4.0 + 36.2
// |c|) 2^-25 (bounds.rus_fk.rod). Latency 3; of a solution 183 + 17 PIPE, 675 + 94 PIPE a step, 14 + 4 PIPE each time a
// row is scaled; II the same. Status: unreachable (word not written: nothing is done, out_word is 0), singular (a row
// depends on those before, or a singularity lies between start and end), overflow, not converged (the start is kept).
// Source: Newton's method on the rods of engine_rus_ik. Model: engine_rus_fk.fk
`default_nettype none
module engine_rus_fk #(
    parameter W = 27,        // bits of a word, 18 to 27 (default 27, as inside; 18 are those of engine_rus_ik)
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks); 1: a faster clock
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire        clk,
    input  wire        rst,
    input  wire [21:0] cfg_tol,
    input  wire [5:0]  cfg_limit,
    input  wire        in_valid,
    output wire        in_ready,
    input  wire [1:0]  in_op,
    input  wire [2:0]  in_n,
    input  wire [3:0]  in_k,
    input  wire signed [W-1:0] in_word,
    output reg         out_valid,
    input  wire        out_ready,
    output wire signed [W-1:0] out_word,
    output wire [5:0]  out_iters,
    output wire [3:0]  out_status
);
    generate
        if (W < 18 || W > 27 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0)
        begin : g_illegal
            engine_rus_fk_needs_W_from_18_to_27_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    // Samples: the number of a word is checked one clock after the sample is accepted
    localparam [3:0] POSE = 4'd9, LEG = 4'd13;  // words of page 0 and of a leg
    reg         busy, check, answer, no_word;
    reg  [1:0]  op;
    reg  [2:0]  n;
    reg  [3:0]  k;
    reg  [26:0] word;
    reg  [6:0]  fill;   // {n, k} of the next word to write; page 7: all are written
    wire        accept = in_valid && in_ready;
    wire        solve_op = op == 2'd0, write_op = op == 2'd1, full = fill[6:4] == 3'd7;
    wire        there = {n, k} < fill && k < (n == 3'd0 ? POSE : LEG), next = {n, k} == fill && !full;
    wire        ok = (there || write_op && next) && (!solve_op || full);
    wire        begins = check && ok && solve_op, set = check && ok && write_op;
    wire        page_ends = k == (n == 3'd0 ? POSE : LEG) - 4'd1;
    assign      in_ready = !busy && (!out_valid || out_ready);

    localparam [2:0] JUMP = 3'd7;  // ACT, as in engine_rus_fk_program
    wire        reads, adds, halt, failed, overflow, singular, over, off, negative;
    wire [7:0]  line;
    wire [2:0]  i, j, act;
    wire [1:0]  range, size;
    wire [36:0] sum_op;
    wire [2:0]  act_op;
    wire [26:0] read;
    engine_rus_fk_steps #(.PIPE(PIPE)) steps (
        .clk(clk), .rst(rst), .cfg_limit(cfg_limit), .in_clear(accept), .in_start(begins),
        .in_forget(set && {n, k} == 7'h10), .in_jump(act_op == JUMP), .in_act(act), .in_over(over), .in_off(off),
        .in_size(size), .in_negative(negative), .out_reads(reads), .out_adds(adds), .out_next(line), .out_i(i),
        .out_j(j), .out_range(range), .out_halt(halt), .out_failed(failed), .out_overflow(overflow),
        .out_singular(singular), .out_iters(out_iters));
    engine_rus_fk_program #(.PIPE(PIPE)) program_ (.clk(clk), .in_line(line), .out_op({sum_op, act_op}));
    engine_rus_fk_products #(.PIPE(PIPE), .MULTIPLY(MULTIPLY)) products (
        .clk(clk), .cfg_tol(cfg_tol), .in_op({sum_op, act_op}), .in_run(reads), .in_adds(adds), .in_i(i), .in_j(j),
        .in_range(range), .in_set(set), .in_own(no_word ? 8'h84 : {1'b0, n, k}), .in_word(word), .in_fetch(answer),
        .out_read(read), .out_act(act), .out_over(over), .out_off(off), .out_size(size), .out_negative(negative));

    generate
        if (W == 27) begin : g_whole
            assign out_word = read;
        end else begin : g_near
            wire [W:0] near = read[26:26-W] + 1'b1;
            assign     out_word = near[W:1];
            wire       unused = &{1'b0, near[0], read};
        end
    endgenerate
    assign out_status = {failed, overflow, singular, no_word};
    always @(posedge clk) begin
        if (accept) begin
            op   <= in_op;
            n    <= in_n;
            k    <= in_k;
            word <= {in_word, {27-W{1'b0}}};
        end
        if (check && write_op && next)
            fill <= page_ends ? {n + 3'd1, 4'd0} : fill + 7'd1;
        if (accept || check)
            no_word <= check && !ok;
        check     <= accept && !rst;
        answer    <= ((check && !begins) || halt) && !rst;
        busy      <= (accept || (busy && !answer)) && !rst;
        out_valid <= (answer || (out_valid && !out_ready)) && !rst;
        if (rst)
            fill <= 7'd0;
    end
endmodule
`default_nettype wire
