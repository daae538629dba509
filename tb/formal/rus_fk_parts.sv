// What the contract of engine_rus_fk does not depend on: words and lines of any value; a word that was fetched stands
// until the next.
module engine_rus_fk_program (input clk, input [7:0] in_line, output [39:0] out_op);
    (* anyseq *) wire [39:0] op;
    reg [7:0] line;
    always @(posedge clk) line <= in_line;
    assign out_op = {op[39:3], op[2:0] == 3'd7 && line < 135 ? 3'd4 : op[2:0]};  // no JUMP before SIDE
endmodule

module engine_rus_fk_products (
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
