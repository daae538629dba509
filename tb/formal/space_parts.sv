// What the contract of engine_quaternion_gd_n does not depend on: words and lines of any value, but no error in the
// lines that begin a pass. An error comes two clocks behind its line, none behind a line that is not run; a word that
// was fetched stands until the next.
module engine_gd_n_program (input clk, input [5:0] in_line, output [55:0] out_op);
    (* anyseq *) wire [55:0] op;
    reg [5:0] line;
    always @(posedge clk) line <= in_line;
    assign out_op = {op[55:1], op[0] && line >= 6'd11};
endmodule

module engine_gd_n_products #(parameter P = 4) (
    input clk, input [21:0] cfg_tol, input [55:0] in_op, input in_run, in_still, input [P-1:0] in_page, in_next,
    input in_set, input [P+3:0] in_own, input [26:0] in_word, input in_fetch, output reg [26:0] out_read,
    output [26:0] out_word, output out_error, out_over, out_close, out_off
);
    (* anyseq *) wire [26:0] read, word;
    (* anyseq *) wire error, over, close, off;
    reg ran, adds;
    always @(posedge clk) begin
        ran <= in_run && in_op[1:0] == 2'd1;
        adds <= ran;
        if (in_run || in_fetch) out_read <= read;
    end
    assign {out_word, out_error, out_over, out_close, out_off} = {word, error && adds, over, close, off};
endmodule
