// SPDX-License-Identifier: Apache-2.0
// The module turns the vectors of eight branches into joint words of the machine and chooses one branch. It prefers, in
// this order, a branch within the limits of all joints, one in reach, and the one with the least sum over the joints of
// weight times step from the last answer; among equals the first. An answer beyond the limits is not remembered.
//   word = +-(angle [+ angle of the joint before]) + zero, in the turn that is nearest to the last answer, or in the
//   next one where only that is within the limits
// Formats: in_word s2.U, rounded down, in the order of arrival; its value is half a unit more. in_places: its numbers
// of n6, c6 to n1, c1 of branches 7 to 0; in_mirrored, in_opposite: joints 6 to 1 of branches 7 to 0 whose sine is
// negated, or whose vector. in_last comes with the last word or later. Words s3.A turns, joint 1 lowest; limits s3.12,
// inclusive; weights u6.
// Reset sets the last answer to zeros. out_valid is high 58 + 4 PIPE clocks after in_last. Model: keep.choose
`default_nettype none
module six_choose #(
    parameter A = 18,  // bits of a turn, 12 to 24 (default 18)
    parameter U = 16,  // fraction bits of a vector, 8 to 17 (default 16)
    parameter PIPE = 0 // registers in the codec, behind the memory and before the product, 0 or 1 (default 0)
) (
    input  wire            clk,
    input  wire            rst,
    input  wire [5:0]      cfg_turned,
    input  wire [4:0]      cfg_coupled,
    input  wire [6*A-1:0]  cfg_zero,
    input  wire [89:0]     cfg_low,
    input  wire [89:0]     cfg_high,
    input  wire [35:0]     cfg_weight,
    input  wire            in_start,
    input  wire            in_write,
    input  wire [U+1:0]    in_word,
    input  wire            in_last,
    input  wire [767:0]    in_places,
    input  wire [63:0]     in_mirrored,
    input  wire [63:0]     in_opposite,
    input  wire [7:0]      in_far,
    input  wire [7:0]      in_held,
    output wire            out_idle,
    output reg             out_valid,
    input  wire            out_ready,
    output reg  [6*A+17:0] out_words,
    output reg  [2:0]      out_branch,
    output wire            out_beyond,
    output reg             out_far,
    output reg             out_held
);
    generate
        if (A < 12 || A > 24 || U < 8 || U > 17 || PIPE < 0 || PIPE > 1) begin : g_illegal
            six_choose_needs_A_from_12_to_24_and_U_from_8_to_17_and_PIPE_0_or_1 rule ();
        end
    endgenerate
    localparam E = A + 3, S = A + 10;  // bits of a word; of a sum of costs, each below 1.5 * 63 turns

    // A joint a clock. Stage 0 selects its vector; j and b are joint and branch as they move through the stages. With
    // PIPE = 1 the codec takes two stages more, and one more lies in front of S5 and of S7
    localparam S3 = 3 + 2 * PIPE, S4 = S3 + 1, S5 = S4 + 1 + PIPE, S6 = S5 + 1, S7 = S6 + 1 + PIPE, S8 = S7 + 1;
    localparam S9 = S8 + 1;
    localparam B = 3 * S9 + 3;  // bits of j and b
    reg          busy;
    reg  [S9:0]  run;   // a joint is in that stage
    reg  [B-1:0] j, b;  // stage 0 lowest
    wire         turn_over = j[2:0] == 3'd5;
    wire         decide = run[S9] && j[3*S9 +: 3] == 3'd5;
    wire         ended = decide && b[3*S9 +: 3] == 3'd7;
    assign       out_idle = !busy && (!out_valid || out_ready);
    always @(posedge clk) begin
        run <= rst ? {(S9+1){1'b0}} : {run[S9-1:0], in_last || run[0] && !(turn_over && b[2:0] == 3'd7)};
        j   <= rst ? {B{1'b0}} : {j[B-4:0], turn_over || !run[0] ? 3'd0 : j[2:0] + 3'd1};  // 0 where no joint is
        b   <= rst ? {B{1'b0}} : {b[B-4:0], run[0] ? b[2:0] + {2'd0, turn_over} : 3'd0};
        busy      <= !rst && (in_start || busy && !ended);
        out_valid <= !rst && (ended || out_valid && !out_ready);
    end

    // Stages 0 to S3: the vectors in two memories of the same words, and their angles
    reg  [U+1:0] cosines[0:63], sines[0:63];
    reg  [5:0]   at;
    reg  [U+1:0] c, n;
    wire         mirrored = in_mirrored[{b[5:3], j[5:3]}], opposite = in_opposite[{b[3*S3 +: 3], j[3*S3 +: 3]}];
    wire [5:0]   place_c, place_n;
    wire [A-1:0] angle;
    assign       {place_n, place_c} = in_places[12*{b[2:0], j[2:0]} +: 12];
    always @(posedge clk) begin
        at <= in_start ? 6'd0 : at + {5'd0, in_write};
        if (in_write) begin
            cosines[at] <= in_word;
            sines[at]   <= in_word;
        end
        c <= cosines[place_c];
        n <= sines[place_n];
    end
    /* verilator lint_off PINCONNECTEMPTY */
    vector_to_angle #(.U(U+1), .A(A), .PIPE(PIPE)) codec (.clk(clk), .rst(rst), .in_valid(run[1]), .in_ready(),
        .in_c({c, 1'b1}), .in_n({n ^ {(U+2){mirrored}}, 1'b1}), .out_valid(), .out_ready(1'b1), .out_j(angle),
        .out_status());
    /* verilator lint_on PINCONNECTEMPTY */

    // Stages S3 and S4: the machine's word modulo a turn, and the last answer, a row of the memory of all answers: that
    // of the branch that was chosen, or row 16, zeros that nothing overwrites
    wire [5:0]   coupled = {1'b0, cfg_coupled};  // the next joint with this one
    reg  [E-1:0] answers[0:255];
    reg  [4:0]   row;
    reg          prior_opposite;
    reg  [A-1:0] prior, sum, word;
    reg  [E-1:0] from;
    wire [A-1:0] angles = angle + prior;
    wire         turned = cfg_turned[j[3*S4 +: 3]];
    wire [A:0]   word_of = {sum ^ {A{turned}}, turned} + {cfg_zero[A*j[3*S4 +: 3] +: A], turned};
    integer      i;
    initial
        for (i = 0; i < 256; i = i + 1)
            answers[i] = {E{1'b0}};
    always @(posedge clk) begin
        {prior_opposite, prior} <= {opposite, angle};
        if (!run[S3] || !coupled[j[3*S3 +: 3]])
            {prior_opposite, prior} <= {(A+1){1'b0}};
        sum  <= {angles[A-1] ^ opposite ^ prior_opposite, angles[A-2:0]};
        word <= word_of[A:1];
        from <= answers[{row, j[3*S4 +: 3]}];
    end

    // Stage S5: the turn that is nearest to the last answer
    wire [A-1:0] word_5;
    wire [E-1:0] from_5;
    generate
        if (PIPE == 0) begin : g_memory
            assign {word_5, from_5} = {word, from};
        end else begin : g_register
            reg [A+E-1:0] held;
            assign        {word_5, from_5} = held;
            always @(posedge clk)
                held <= {word, from};
        end
    endgenerate
    wire [A:0]   rise = {1'b0, word_5} - {1'b0, from_5[A-1:0]};
    wire [2:0]   turn = from_5[E-1:A] + {{2{rise[A] == rise[A-1] ? 1'b0 : !rise[A]}}, rise[A] != rise[A-1]};
    reg  [E-1:0] near;
    reg  [A-1:0] step;
    always @(posedge clk) begin
        near <= {turn, word_5};
        step <= rise[A-1:0];
    end

    // Stage S6: limits, in 2^-12 turn. Above the lower one counts what near is rounded down, below the upper one up
    wire [14:0]  floor = near[E-1:A-12];
    wire [E-1:0] rest = near << 15;
    wire [14:0]  low = cfg_low[15*j[3*S6 +: 3] +: 15], high = cfg_high[15*j[3*S6 +: 3] +: 15];
    /* verilator lint_off UNUSEDSIGNAL */
    wire [15:0]  above = {floor[14], floor} - {low[14], low};
    wire [16:0]  below = {high[14], high, 1'b1} + {~{floor[14], floor}, rest == {E{1'b0}}};
    /* verilator lint_on UNUSEDSIGNAL */
    wire         up = above[15] && !below[16] && below[15:13] != 3'd0;
    wire         down = below[16] && !above[15] && above[14:12] != 3'd0;
    reg  [E-1:0] answer;
    reg  [A+1:0] move;
    reg          fit;
    reg  [5:0]   weight;
    always @(posedge clk) begin
        answer <= {near[E-1:A] + {{2{down}}, up || down}, near[A-1:0]};
        move   <= {{2{step[A-1]}} + {down, up || down}, step};
        fit    <= up || down || !above[15] && !below[16];
        weight <= cfg_weight[6*j[3*S6 +: 3] +: 6];
    end

    // Stages S7 and S8: weight times size of the step, and their sum; the words of a branch
    wire                back = move[A+1];
    wire [5:0]          above_one = {|weight[4:0], |weight[3:0], |weight[2:0], |weight[1:0], weight[0], 1'b0};
    wire signed [6:0]   factor = {back && weight != 6'd0, weight ^ {6{back}} & above_one};  // +-weight
    wire [E-1:0]        answer_7;
    wire signed [A+1:0] move_7;
    wire signed [6:0]   factor_7;
    wire                fit_7;
    generate
        if (PIPE == 0) begin : g_factor
            assign {answer_7, move_7, factor_7, fit_7} = {answer, move, factor, fit};
        end else begin : g_product
            reg [E+A+9:0] held;
            assign        {answer_7, move_7, factor_7, fit_7} = held;
            always @(posedge clk)
                held <= {answer, move, factor, fit};
        end
    endgenerate
    wire [A+8:0]        product = move_7 * factor_7;
    wire                unused = &{1'b0, product[A+8:A+7], word_of[0]};
    reg  [A+6:0]        cost;
    reg  [S-1:0]        costs, total;
    reg                 fits, all_fit, total_fit;
    reg  [7*E-1:0]      words;
    wire [S-1:0]        sums = costs + {3'd0, cost};
    always @(posedge clk) begin
        if (run[S7])
            answers[{1'b0, !row[3], b[3*S7 +: 3], j[3*S7 +: 3]}] <= answer_7;
        words <= {answer_7, words[7*E-1:E]};
        cost  <= product[A+6:0];
        fits  <= fit_7;
        {total_fit, total} <= {all_fit && fits, sums};
        {all_fit, costs}   <= {all_fit && fits, sums};
        if (!run[S8] || j[3*S8 +: 3] == 3'd5)
            {all_fit, costs} <= {1'b1, {S{1'b0}}};
    end

    // Stage S9: the branch of the least key
    reg  [S+1:0] best;
    wire [S+1:0] key = {!total_fit, in_far[b[3*S9 +: 3]], total};
    reg          chosen;
    assign       out_beyond = best[S+1];
    always @(posedge clk) begin
        if (decide && (b[3*S9 +: 3] == 3'd0 || key < best)) begin
            best       <= key;
            out_words  <= words[6*E-1:0];
            out_branch <= b[3*S9 +: 3];
            out_far    <= in_far[b[3*S9 +: 3]];
            out_held   <= in_held[b[3*S9 +: 3]];
        end
        chosen <= !rst && ended;
        if (rst)
            row <= 5'd16;
        else if (chosen && !out_beyond)
            row <= {1'b0, !row[3], out_branch};
    end
endmodule
`default_nettype wire
