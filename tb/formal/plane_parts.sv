// What the contract of engine_quaternion_gd_plane does not depend on: joints, steps and errors of any value. Joint and
// square stand where no line of the tables changes them.
module engine_gd_joints #(parameter W = 16, A = 24, K = 17, T = 10, I = 6) (
    input clk, in_take, input [A-1:0] in_j, input [I-1:0] in_link, input [W-1:0] in_length, input in_load, in_set,
    in_read, in_step, in_next, in_place, in_base, input [A-1:0] in_move, output reg [A-1:0] out_j,
    output [W-1:0] out_length, output [2*K-T+19:0] out_chord
);
    (* anyseq *) wire [A-1:0] joint;
    (* anyseq *) wire [2*K-T+19:0] chord;
    assign {out_length, out_chord} = {{W{1'b0}}, chord};
    always @(posedge clk) if (in_read) out_j <= joint;
endmodule

module engine_gd_plane_path #(parameter W = 16, A = 24, N = 8, K = 17, T = 10, I = 6) (
    input clk, input [W:0] cfg_alpha, input [1:0] in_shift, input in_fine, in_still, in_clear, input [8:0] in_op,
    input in_first, in_read, input [I-1:0] in_link, input in_store, in_begin, input [2*K-T+19:0] in_chord,
    input [W-1:0] in_length, in_x, in_y, output out_fits, output [A-1:0] out_move, output reg [2*W-1:0] out_square
);
    (* anyseq *) wire fits;
    (* anyseq *) wire [A-1:0] move;
    (* anyseq *) wire [2*W-1:0] square;
    assign {out_fits, out_move} = {fits, move};
    always @(posedge clk) if (in_clear || in_op[4] || in_op[3]) out_square <= in_clear ? 0 : square;
endmodule
