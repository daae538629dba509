// SPDX-License-Identifier: Apache-2.0
// Sequencer of engine_rus_fk_program: it selects the next line, and ends a solution.
//   elbows of six legs, start; passes: matrix, rows of legs, JUDGE; for each row i NORM (with SCALE while its square
//   is not from 1/4 to 1), DOT and PAIR with the rows after it; SIDE, the move. DONE writes the pose.
// in_jump belongs to the line that is read; in_act, in_over, in_off, in_size, in_negative to the line that adds.
// in_forget: the robot was changed, so its side is unknown. out_halt: last clock of a solution; the flags are valid
// from the next one on. cfg_limit steps, and SCALINGS of a row, bound a solution. Model: engine_rus_fk.fk
`default_nettype none
module engine_rus_fk_steps #(
    parameter PIPE = 0  // of engine_rus_fk_program, 0 or 1 (default 0)
) (
    input  wire       clk,
    input  wire       rst,
    input  wire [5:0] cfg_limit,
    input  wire       in_clear,      // a sample is taken
    input  wire       in_start,
    input  wire       in_forget,
    input  wire       in_jump,
    input  wire [2:0] in_act,
    input  wire       in_over,
    input  wire       in_off,
    input  wire [1:0] in_size,
    input  wire       in_negative,
    output wire       out_reads,     // a line reads
    output reg        out_adds,      // a line adds
    output wire [7:0] out_next,      // the line for the next clock
    output reg  [2:0] out_i,
    output reg  [2:0] out_j,
    output reg  [1:0] out_range,
    output wire       out_halt,
    output reg        out_failed,
    output reg        out_overflow,
    output reg        out_singular,
    output reg  [5:0] out_iters
);
    localparam [7:0] ELBOW = 8'd0, COPY = PIPE == 0 ? 8'd6 : 8'd7, TURN = PIPE == 0 ? 8'd13 : 8'd14,
                     LEG = PIPE == 0 ? 8'd40 : 8'd41, JUDGE = PIPE == 0 ? 8'd56 : 8'd58,
                     NORM = PIPE == 0 ? 8'd60 : 8'd65, DOT = PIPE == 0 ? 8'd111 : 8'd126,
                     PAIR = PIPE == 0 ? 8'd117 : 8'd133, SCALE = PIPE == 0 ? 8'd128 : 8'd145,
                     SIDE = PIPE == 0 ? 8'd135 : 8'd153, DONE = PIPE == 0 ? 8'd182 : 8'd205,
                     END = PIPE == 0 ? 8'd192 : 8'd217;
    localparam [7:0] SIZE = PIPE == 0 ? 8'd66 : 8'd74;  // the line of NORM in which the range of the square is known
    localparam [2:0] SCALINGS = 3'd7;     // greatest number of scalings by 4: a row below 2^-15 is lost
    // ACT, as in engine_rus_fk_program
    localparam [2:0] ACT_MISS = 3'd1, ACT_UNIT = 3'd2, ACT_LOOSE = 3'd4, ACT_RANGE = 3'd5, ACT_SIDE = 3'd6;
    reg        run;
    reg  [7:0] line;
    reg        over, off, loads, multiplies;
    wire       last;  // the next clock's line adds
    reg        side, wanted, known;  // side of this pass, side of the robot, and whether that is known
    reg  [2:0] count;  // number of scalings of this row
    wire       over_elbow = line == COPY - 8'd1, over_leg = line == JUDGE - 8'd1, judge = line == NORM - 8'd1,
               size = line == SIZE, over_norm = line == DOT - 8'd1, over_pair = line == SCALE - 8'd1,
               over_scale = line == SIDE - 8'd1, over_move = line == DONE - 8'd1,
               over_done = line == END - 8'd1;
    wire       last_i = out_i == 3'd6, last_j = out_j == 3'd6;
    wire       fits = out_range == 2'd1;
    wire       crossed = out_iters != 6'd0 && side != wanted;
    wire       good = !off && !over && !crossed;
    wire       lost = size && (over || !fits && count == SCALINGS);
    wire       stop = judge && (over || !off && crossed || off && out_iters == cfg_limit);
    wire       fails = run && (lost || stop);  // the solution ends without a pose
    assign     out_halt = fails || run && over_done;

    reg  [7:0] jump;
    always @* begin
        jump = line + 8'd1;
        if (over_elbow && !last_i)
            jump = ELBOW;
        if (over_leg && !last_i)
            jump = LEG;
        if (judge && good)
            jump = DONE;
        if (size && !fits)
            jump = SCALE;
        if (over_norm && last_i)
            jump = SIDE;
        if (over_pair)
            jump = last_j ? NORM : PAIR;
        if (over_scale)
            jump = NORM;
        if (over_move)
            jump = TURN;
        if (!run || out_halt)
            jump = ELBOW;
    end
    assign out_next = jump;

    always @(posedge clk) begin
        line <= jump;
        if (in_clear)
            out_i <= 3'd1;
        else if (over_elbow || over_leg || over_pair && last_j || over_move)
            out_i <= last_i ? 3'd1 : out_i + 3'd1;
        if (over_norm || over_pair || in_jump)
            out_j <= over_norm && last_i ? 3'd1 : (over_norm ? out_i : out_j) + 3'd1;
        if (over_scale || size && fits || in_clear)
            count <= over_scale ? count + 3'd1 : 3'd0;
        if (in_act == ACT_RANGE)
            out_range <= in_size;
        over    <= !in_clear && (over || !(|(in_act & ACT_LOOSE)) && in_over);
        off     <= !in_clear && !over_move && (off || (in_act == ACT_MISS || in_act == ACT_UNIT) && in_off);
        if (over_norm || in_act == ACT_SIDE)
            side <= !over_norm && (side ^ in_negative);
        if (over_move && !known && out_iters == 6'd0)
            wanted <= side;
        if (in_forget || over_done && run && out_iters != 6'd0)
            known <= !in_forget;
        if (in_clear)
            out_iters <= 6'd0;
        else if (run && over_move)
            out_iters <= out_iters + 6'd1;
        if (in_clear || fails) begin
            out_failed   <= !in_clear;
            out_overflow <= !in_clear && over;
            out_singular <= !in_clear && (size ? !over : crossed);
        end
        // A reset or the end drops a line that would write after the word of the next sample; earlier ones write before
        loads      <= out_reads && !rst && !(out_halt && PIPE != 0);
        multiplies <= loads && !(rst && PIPE != 0);
        out_adds   <= last;
        run        <= !rst && (in_start || run && !out_halt);
    end
    generate
        if (PIPE == 0) begin : g_now
            assign {out_reads, last} = {run, multiplies};
        end else begin : g_later
            reg reads, sums;
            assign {out_reads, last} = {reads, sums};
            always @(posedge clk) begin
                reads <= run && !rst && !out_halt;
                sums  <= multiplies;
            end
        end
    endgenerate
endmodule
`default_nettype wire
