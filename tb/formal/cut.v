// What a contract does not depend on: a product, a wide sum or a memory word is any value, the same as long as its
// inputs stay. Counters are sums too, but short.
(* techmap_celltype = "$mul $add $sub" *)
module cut_arith (A, B, Y);
    parameter _TECHMAP_CELLTYPE_ = "";
    parameter A_SIGNED = 0, B_SIGNED = 0, A_WIDTH = 1, B_WIDTH = 1, Y_WIDTH = 1;
    input [A_WIDTH-1:0] A;
    input [B_WIDTH-1:0] B;
    output [Y_WIDTH-1:0] Y;
    wire _TECHMAP_FAIL_ = _TECHMAP_CELLTYPE_ != "$mul" && Y_WIDTH < 12;
    (* anyseq *) wire [Y_WIDTH-1:0] any;
    (* gclk *) reg gclk;
    reg started = 0;
    reg [A_WIDTH+B_WIDTH-1:0] inputs;
    reg [Y_WIDTH-1:0] earlier;
    assign Y = any;
    always @(posedge gclk) begin
        started <= 1;
        inputs <= {A, B};
        earlier <= Y;
    end
    always @* if (started && inputs == {A, B}) assume (Y == earlier);
endmodule

(* techmap_celltype = "$mem_v2" *)
module cut_mem (RD_CLK, RD_EN, RD_ARST, RD_SRST, RD_ADDR, RD_DATA, WR_CLK, WR_EN, WR_ADDR, WR_DATA);
    parameter MEMID = "", SIZE = 1, OFFSET = 0, ABITS = 1, WIDTH = 1, INIT = 0, RD_PORTS = 1, WR_PORTS = 0;
    parameter RD_CLK_ENABLE = 0, RD_CLK_POLARITY = 0, RD_TRANSPARENCY_MASK = 0, RD_COLLISION_X_MASK = 0;
    parameter RD_WIDE_CONTINUATION = 0, RD_CE_OVER_SRST = 0, RD_ARST_VALUE = 0, RD_SRST_VALUE = 0, RD_INIT_VALUE = 0;
    parameter WR_CLK_ENABLE = 0, WR_CLK_POLARITY = 0, WR_PRIORITY_MASK = 0, WR_WIDE_CONTINUATION = 0;
    input [RD_PORTS-1:0] RD_CLK, RD_EN, RD_ARST, RD_SRST;
    input [RD_PORTS*ABITS-1:0] RD_ADDR;
    output [RD_PORTS*WIDTH-1:0] RD_DATA;
    input [WR_PORTS-1:0] WR_CLK;
    input [WR_PORTS*WIDTH-1:0] WR_EN, WR_DATA;
    input [WR_PORTS*ABITS-1:0] WR_ADDR;
    wire _TECHMAP_FAIL_ = WR_PORTS != 0 || RD_CLK_ENABLE != 0;
    (* anyseq *) wire [RD_PORTS*WIDTH-1:0] any;
    (* gclk *) reg gclk;
    reg started = 0;
    reg [RD_PORTS*ABITS-1:0] inputs;
    reg [RD_PORTS*WIDTH-1:0] earlier;
    assign RD_DATA = any;
    always @(posedge gclk) begin
        started <= 1;
        inputs <= RD_ADDR;
        earlier <= RD_DATA;
    end
    always @* if (started && inputs == RD_ADDR) assume (RD_DATA == earlier);
endmodule
