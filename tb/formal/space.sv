// The contract where the latency varies (one_inside.sv), and an end: a sample inside that solves is at a line of the
// program, its joints are counted from the first to the last, and every pass but the one that judges the start counts.
// One clock of reset is enough, from any state.
// rtl: engine_quaternion_gd_n
// with: one_inside.sv
// proof N8 mode=prove depth=4 N=8
// proof N100 mode=prove depth=4 N=100
// proof PIPE1 mode=prove depth=4 N=8 PIPE=1
// proof PIPE1N100 mode=prove depth=4 N=100 PIPE=1
module engine_quaternion_gd_n_props #(parameter N = 8, PIPE = 0) (
    input clk, rst, in_valid, out_ready, input [1:0] in_op, input [7:0] in_n, input [2:0] in_k, input [26:0] in_word,
    input [21:0] cfg_tol, input [9:0] cfg_limit
);
    localparam P = N < 15 ? 4 : $clog2(N + 2), L = PIPE == 0 ? 6 : 7, JOINT = PIPE == 0 ? 11 : 42;
    localparam LINES = PIPE == 0 ? 41 : 77;
    wire in_ready, out_valid;
    wire [26:0] out_word, out_x, out_y, out_z;
    wire [9:0] out_iters;
    wire [3:0] out_status;
    engine_quaternion_gd_n #(.N(N), .PIPE(PIPE)) dut (.*);

    wire live, inside;
    reg fresh;  // with PIPE a sample waits for a clock before it is checked
    always @(posedge clk) fresh <= PIPE == 1 && in_valid && in_ready && !rst;

    (* hierconn *) wire \dut.check ;
    (* hierconn *) wire \dut.answer ;
    (* hierconn *) wire \dut.run ;
    (* hierconn *) wire \dut.busy ;
    (* hierconn *) wire [L-1:0] \dut.line ;
    (* hierconn *) wire [P-1:0] \dut.page ;
    (* hierconn *) wire [P-1:0] \dut.behind ;
    (* hierconn *) wire [7:0] \dut.n ;
    (* hierconn *) wire [10:0] \dut.fill ;
    wire [6:0]  line = \dut.line ;
    wire [7:0]  n = \dut.n , page = \dut.page ;
    wire [10:0] fill = \dut.fill ;

    wire [121:0] result = {out_word, out_x, out_y, out_z, out_iters, out_status};
    wire [31:0] cfg = {cfg_tol, cfg_limit};
    one_inside #(.WO(122), .WC(32)) rules (.*);
    always @* if (live) begin
        assert (\dut.busy == (inside && !out_valid));
        assert (\dut.busy == (fresh || \dut.check || \dut.answer || \dut.run ));
        assert (fresh + \dut.check + \dut.answer + \dut.run < 2);
        assert (fill <= 8 * (N + 1) && (fill < 4 || fill >= 8));
        if (\dut.run ) assert (n != 0 && n <= N && line < LINES);
        if (\dut.run && line >= JOINT) assert (page >= 2 && page <= n + 1);
        // where a pass begins the next page is that of joint 1, and with PIPE this one not that of the last
        if (PIPE == 1 && \dut.run && line < JOINT) assert (\dut.page != n[P-1:0] + 1'b1);
        if (\dut.check || \dut.run && line < JOINT) assert (\dut.behind == 2);
        if (\dut.run && line >= JOINT) assert (\dut.behind == \dut.page + 1'b1);
        if (inside) assert (out_iters <= cfg_limit);
    end
endmodule

// What the contract of engine_quaternion_gd_n does not depend on: words and lines of any value, but no error in the
// lines that begin a pass. An error comes two clocks behind its line, with PIPE seven, none behind a line that is not
// run; a word that was fetched stands until the next.
module engine_gd_n_program #(parameter PIPE = 0) (
    input clk, input [PIPE == 0 ? 5 : 6:0] in_line, output [55:0] out_op
);
    (* anyseq *) wire [55:0] op;
    reg [6:0] line;
    always @(posedge clk) line <= in_line;
    assign out_op = {op[55:1], op[0] && line >= (PIPE == 0 ? 7'd11 : 7'd42)};
endmodule

module engine_gd_n_products #(parameter P = 4, PIPE = 0) (
    input clk, input [21:0] cfg_tol, input [55:0] in_op, input in_run, in_still, in_alone,
    input [P-1:0] in_page, in_next,
    input in_set, input [P+3:0] in_own, input [26:0] in_word, input in_fetch, output reg [26:0] out_read,
    output [26:0] out_word, output out_error, out_over, out_close, out_off
);
    (* anyseq *) wire [26:0] read, word;
    (* anyseq *) wire error, over, close, off;
    reg [5:0] errors;
    reg reads, adds;
    always @(posedge clk) begin
        errors <= {errors[4:0], in_run && in_op[1:0] == 2'd1};
        adds <= errors[5 * PIPE] && (PIPE == 0 || in_run);
        reads <= in_run;
        if (PIPE == 0 && in_run || PIPE == 1 && reads || in_fetch) out_read <= read;
    end
    assign {out_word, out_error, out_over, out_close, out_off} = {word, error && adds, over, close, off};
endmodule
