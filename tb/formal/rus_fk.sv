// The contract where the latency varies (one_inside.sv), and an end: a sample inside that solves is at a line of the
// program, its legs, rows and scalings are counted, and so are its steps, up to cfg_limit. No line writes behind the
// word of a sample that comes after it. One clock of reset is enough, from any state.
// rtl: engine_rus_fk engine_rus_fk_steps
// with: one_inside.sv
// proof W27 mode=prove depth=2 W=27
// proof PIPE1 mode=prove depth=2 W=27 PIPE=1
// proof PIPE1M27 mode=prove depth=2 W=27 PIPE=1 MULTIPLY=27
// proof W18 mode=prove depth=2 W=18
// proof PIPE1W18 mode=prove depth=2 W=18 PIPE=1
module engine_rus_fk_props #(parameter W = 27, PIPE = 0, MULTIPLY = 18) (
    input clk, rst, in_valid, out_ready, input [1:0] in_op, input [2:0] in_n, input [3:0] in_k, input [W-1:0] in_word,
    input [21:0] cfg_tol, input [5:0] cfg_limit
);
    wire in_ready, out_valid;
    wire [W-1:0] out_word;
    wire [5:0] out_iters;
    wire [3:0] out_status;
    engine_rus_fk #(.W(W), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) dut (.*);

    wire live, inside;

    (* hierconn *) wire \dut.check ;
    (* hierconn *) wire \dut.answer ;
    (* hierconn *) wire \dut.steps.run ;
    (* hierconn *) wire \dut.busy ;
    (* hierconn *) wire [6:0] \dut.fill ;
    (* hierconn *) wire [7:0] \dut.steps.line ;
    (* hierconn *) wire [2:0] \dut.i ;
    (* hierconn *) wire [2:0] \dut.j ;
    (* hierconn *) wire \dut.steps.loads ;
    (* hierconn *) wire \dut.steps.multiplies ;
    (* hierconn *) wire \dut.reads ;
    (* hierconn *) wire \dut.steps.last ;
    wire moves = \dut.reads || \dut.steps.loads || \dut.steps.multiplies || \dut.steps.last ;  // a line that will add
    localparam [7:0] NORM = PIPE == 0 ? 60 : 65, DOT = PIPE == 0 ? 111 : 126, SCALE = PIPE == 0 ? 128 : 145,
        SIDE = PIPE == 0 ? 135 : 153, DONE = PIPE == 0 ? 182 : 205, END = PIPE == 0 ? 192 : 217;
    wire [7:0] line = \dut.steps.line ;
    wire [6:0] fill = \dut.fill ;
    wire [2:0] i = \dut.i , j = \dut.j ;
    wire       run = \dut.steps.run ;

    wire [W+9:0] result = {out_word, out_iters, out_status};
    wire [27:0] cfg = {cfg_tol, cfg_limit};
    one_inside #(.WO(W+10), .WC(28)) rules (.*);
    always @* if (live) begin
        assert (\dut.busy == (inside && !out_valid));
        assert (\dut.busy == (\dut.check || \dut.answer || run));
        assert (\dut.check + \dut.answer + run < 2);
        assert (fill[3:0] < (fill[6:4] == 0 ? 9 : fill[6:4] == 7 ? 1 : 13));
        if (inside) assert (out_iters <= cfg_limit);
        if (\dut.check ) assert (!moves);
        if (PIPE != 0 && (\dut.answer || !\dut.busy )) assert (!\dut.reads && !\dut.steps.loads );
        if (PIPE != 0 && !\dut.busy ) assert (!\dut.steps.multiplies );
        if (\dut.check ) assert (out_iters == 0 && out_status == 0);
        if (run) begin
            assert (fill == 7'h70 && line < END && i != 0 && i != 7);
            if (line >= NORM && line < DONE) assert (out_iters < cfg_limit);
            if (line >= DOT && line < SCALE) assert (i != 6 && j > i && j != 7);
            if (line >= SIDE && line < DONE) assert (i == 6);
        end
        if (run) assert (out_status == 0);
    end
endmodule

// What the contract of engine_rus_fk does not depend on: words and lines of any value; a word that was fetched stands
// until the next.
module engine_rus_fk_program #(parameter PIPE = 0) (input clk, input [7:0] in_line, output [39:0] out_op);
    (* anyseq *) wire [39:0] op;
    reg [7:0] line;
    always @(posedge clk) line <= in_line;
    assign out_op = {op[39:3], op[2:0] == 3'd7 && line < (PIPE == 0 ? 135 : 153) ? 3'd4 : op[2:0]};  // no JUMP before SIDE
endmodule

module engine_rus_fk_products #(parameter PIPE = 0, MULTIPLY = 18) (
    input clk, input [21:0] cfg_tol, input [39:0] in_op, input in_run, in_adds, input [2:0] in_i, in_j, input [1:0] in_range,
    input in_set, input [7:0] in_own, input [26:0] in_word, input in_fetch, output reg [26:0] out_read,
    output [2:0] out_act, output out_over, out_off, output [1:0] out_size, output out_negative
);
    (* anyseq *) wire [26:0] read;
    (* anyseq *) wire [7:0] some;
    always @(posedge clk)
        if (in_run || in_fetch) out_read <= read;
    assign {out_act, out_over, out_off, out_size, out_negative} = some;
endmodule
