// What the contract of engine_newton_3r does not depend on: steps, roots and squares of any value, which stand where no
// line of the table changes them.
module engine_newton_path #(parameter A = 20) (
    input clk, input [15:0] cfg_l1, cfg_l2, cfg_l3, cfg_r1, cfg_r2, cfg_lambda, input [16:0] cfg_mu,
    input [19:0] in_op, input [43:0] in_chord, input [15:0] in_x, in_y,
    output [A-1:0] out_step, output reg [31:0] out_square, output reg out_fine, out_near
);
    (* anyseq *) wire [A-1:0] step;
    (* anyseq *) wire [31:0] square;
    (* anyseq *) wire fine, near;
    assign out_step = step;
    always @(posedge clk) begin
        if (in_op[0]) out_fine <= fine;
        if (in_op[3]) out_near <= near;
        if (in_op[5]) out_square <= square;
    end
endmodule

module angle_chord #(parameter A = 18, K = 17, T = 9, DROP = 0) (
    input clk, in_read, in_keep, in_cos, input [A-1:0] in_j, output [2*K-T+19+(DROP>0):0] out_chord
);
    (* anyseq *) wire [2*K-T+19+(DROP>0):0] chord;
    assign out_chord = chord;
endmodule
