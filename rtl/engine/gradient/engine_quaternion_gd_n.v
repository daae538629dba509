// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of any number of revolute joints in space by quaternion gradient descent, without sine or cosine.
// A joint is the unit vector (c, s) of half its angle. It turns to (c - d s, s + d c), d = alpha E . J / 2, at most
// 1/4, and is normalised by one Newton step. in_op: 0 solve with joints 1 to in_n; 1 write in_word; 2, 3 read.
// out_word: word in_k of joint in_n after the operation. Joint 0: target x, y, z, step (k = 0 to 3); others: axis (0 to
// 2), twice the link (3 to 5), c, s (6, 7). Words are first written in order from (0, 0) on; a reset forgets them.
// Formats: words s2.25; cfg_tol in 2^-25, for each coordinate of E; the step is alpha / 512 in 1/unit^2.
// Error: a converged tip is within bounds.iterative.space_end. Latency 3 + PIPE; of a solution 14 + (30 in_n + 11) a
// pass, with PIPE 12 + (35 in_n + 42), out_iters + 1 passes; II the same. Status: unreachable (joint in_n is not
// written: nothing is done, out_word is 0), overflow (a link ends beyond 2 units in some coordinate), not converged
// (the limit was reached).
// Source: quaternion gradient paper, eqs. 9, 18, 31. Model: iterative.space.gd
`default_nettype none
module engine_quaternion_gd_n #(
    parameter N = 8,    // most joints, 1 to 126 (default 8); up to 14 cost nothing
    parameter PIPE = 0  // 0 or 1 (default 0: fewest clocks); 1: registers around multipliers, a faster clock
) (
    input  wire        clk,
    input  wire        rst,
    input  wire [21:0] cfg_tol,
    input  wire [9:0]  cfg_limit,
    input  wire        in_valid,
    output wire        in_ready,
    input  wire [1:0]  in_op,
    input  wire [7:0]  in_n,
    input  wire [2:0]  in_k,
    input  wire signed [26:0] in_word,
    output reg         out_valid,
    input  wire        out_ready,
    output wire signed [26:0] out_word,
    output wire signed [26:0] out_x,
    output wire signed [26:0] out_y,
    output wire signed [26:0] out_z,
    output wire [9:0]  out_iters,
    output wire [3:0]  out_status
);
    generate
        if (N < 1 || N > 126 || PIPE < 0 || PIPE > 1) begin : g_illegal
            engine_quaternion_gd_n_needs_N_from_1_to_126_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    // Samples: the number of a word is checked one clock after the sample is accepted, with PIPE two
    localparam P = N < 15 ? 4 : $clog2(N + 2);  // bits of a page number: registers are in 0 and 1, joint i in i + 1
    reg         busy, check, answer, run, no_word;
    reg  [1:0]  op;
    reg  [7:0]  n;
    reg  [2:0]  k;
    reg  [26:0] word;
    reg  [10:0] fill;  // {n, k} of the next word to write
    wire        accept = in_valid && in_ready;
    wire        solve_op = op == 2'd0, write_op = op == 2'd1;
    wire        there_now = {n, k | {3{solve_op}}} < fill, next_now = {n, k} == fill && n <= N[7:0];
    wire        there, next, checks;
    wire        ok = (n != 8'd0 || (!k[2] && !solve_op)) && (there || (write_op && next));
    wire        begins = check && ok && solve_op;
    wire        halt;
    assign      in_ready = !busy && (!out_valid || out_ready);

    // Program: line 0 begins a pass, line JOINT a joint; the next line is read while this one is played
    localparam L = PIPE == 0 ? 6 : 7;  // bits of a line's number
    localparam [6:0] LATE = 7'd7, BEGIN = PIPE == 0 ? 7'd11 : 7'd42, FINAL = PIPE == 0 ? 7'd40 : 7'd76;
    localparam [L-1:0] JUDGE = LATE[L-1:0], JOINT = BEGIN[L-1:0], END = FINAL[L-1:0];
    reg  [L-1:0] line;
    reg  [P-1:0] page, behind;  // page of the joint and of the next one: joint 1 where a pass begins
    wire         over_pass = line == JOINT - 1'b1, over_joint = line == END, last = page == n[P-1:0] + 1'b1;
    wire [L-1:0] then = !run || (over_joint && last) ? {L{1'b0}} : over_joint ? JOINT : line + 1'b1;
    wire [55:0]  control;
    wire [P-1:0] opens;
    generate
        if (PIPE == 0) begin : g_now
            assign {there, next, checks, opens} = {there_now, next_now, accept, behind};
        end else begin : g_later
            reg    found, follows, fresh;
            assign {there, next, checks} = {found, follows, fresh};
            assign opens = behind & {P{run}};  // a pass begins with another page than that of the last joint
            always @(posedge clk)
                {found, follows, fresh} <= {there_now, next_now, accept && !rst};
        end
    endgenerate
    engine_gd_n_program #(.PIPE(PIPE)) program_ (.clk(clk), .in_line(then), .out_op(control));

    // Registers: the word of the sample is read before its answer; without one, register 7, which is 0
    wire [P+3:0] own = no_word ? {{P{1'b0}}, 4'd7} : n == 8'd0 ? {{P{1'b0}}, 1'b0, k} : {n[P-1:0] + 1'b1, 1'b0, k};
    wire         error, over, close, off;
    wire [26:0]  result;
    reg          still;
    engine_gd_n_products #(.P(P), .PIPE(PIPE)) products (.clk(clk), .cfg_tol(cfg_tol), .in_op(control), .in_run(run),
        .in_still(still), .in_alone(last), .in_page(page), .in_next(behind), .in_set(check && ok && write_op),
        .in_own(own), .in_word(word), .in_fetch(answer), .out_read(out_word), .out_word(result), .out_error(error),
        .out_over(over), .out_close(close), .out_off(off));

    // End of a solution
    reg  [80:0] e;
    reg  [9:0]  iters;
    reg  [2:0]  near;  // the last three coordinates are within the tolerance: those of E when the pass is over
    reg         beyond, failed, flag;
    reg         uneven;  // some c^2 + s^2 was off 1 by 2^-12 or more: E does not count
    wire        judge = PIPE == 0 ? over_pass : line == JUDGE;  // the pass before is known, no error of this one yet
    wire        decide = run && judge && !still;
    wire        done = near == 3'd7 && !beyond && !uneven;
    assign      halt = decide && (done || iters == cfg_limit);
    assign      {out_x, out_y, out_z} = e;
    assign      out_iters = iters;
    assign      out_status = {failed, flag, 1'b0, no_word};
    always @(posedge clk) begin
        if (accept) begin
            op   <= in_op;
            n    <= in_n;
            k    <= in_k;
            word <= in_word;
        end
        if (check && write_op && next)
            fill <= n == 8'd0 && k == 3'd3 ? 11'd8 : fill + 11'd1;
        if (accept || check)
            no_word <= check && !ok;
        line <= then;
        if (!run || over_joint || over_pass) begin
            page   <= opens;
            behind <= then == {L{1'b0}} ? {{(P-2){1'b0}}, 2'd2} : behind + 1'b1;
        end
        still <= accept || (still && !(over_joint && last));  // no joint moves in the first pass
        if (error) begin
            e    <= {e[53:0], result};
            near <= {near[1:0], close};
        end
        beyond  <= (beyond || (error && over)) && !(judge || accept);
        uneven  <= (uneven || off) && !(judge || accept);
        if (accept) begin
            e     <= 81'd0;
            iters <= 10'd0;
            flag  <= 1'b0;
        end else if (decide) begin
            iters <= iters + {9'd0, !halt};
            flag  <= beyond;
        end
        if (accept || halt)
            failed <= !accept && !done;
        check     <= checks && !rst;
        run       <= (begins || (run && !halt)) && !rst;
        answer    <= ((check && !begins) || halt) && !rst;
        busy      <= (accept || (busy && !answer)) && !rst;
        out_valid <= (answer || (out_valid && !out_ready)) && !rst;
        if (rst)
            fill <= 11'd0;
    end
endmodule
`default_nettype wire
