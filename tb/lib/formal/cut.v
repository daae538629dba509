// What a contract does not depend on: a product or a memory word is any value, the same as long as its inputs stay.
(* techmap_celltype = "$mul" *)
module cut_mul (A, B, Y);
    parameter A_SIGNED = 0, B_SIGNED = 0, A_WIDTH = 1, B_WIDTH = 1, Y_WIDTH = 1;
    input [A_WIDTH-1:0] A;
    input [B_WIDTH-1:0] B;
    output [Y_WIDTH-1:0] Y;
    (* anyseq *) wire [Y_WIDTH-1:0] any;
    (* gclk *) reg gclk;
    reg started = 0;
    reg [A_WIDTH+B_WIDTH-1:0] inputs;
    reg [Y_WIDTH-1:0] before;
    assign Y = any;
    always @(posedge gclk) begin
        started <= 1;
        inputs <= {A, B};
        before <= Y;
    end
    always @* if (started && inputs == {A, B}) assume (Y == before);
endmodule
