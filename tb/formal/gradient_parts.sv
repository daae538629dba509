// What the contract of a gradient engine does not depend on: steps and chords of any value. The square is any value
// too, but it stands where no line of the table changes it.
module engine_gd_path #(parameter W = 16, A = 24, K = 17, T = 10) (
    input clk, input [W-1:0] cfg_l1, cfg_l2, input [W:0] cfg_alpha, input in_shift, in_fine, in_still,
    input [11:0] in_op, input [2*K-T+19:0] in_chord, input [W-1:0] in_x, in_y,
    output [A-1:0] out_step, output reg [2*W-1:0] out_square
);
    (* anyseq *) wire [A-1:0] step;
    (* anyseq *) wire [2*W-1:0] square;
    assign out_step = step;
    always @(posedge clk) if (in_op[4] || in_op[3]) out_square <= square;
endmodule

module angle_chord #(parameter A = 18, K = 17, T = 9, DROP = 0) (
    input clk, in_read, in_keep, in_cos, input [A-1:0] in_j, output [2*K-T+19+(DROP>0):0] out_chord
);
    (* anyseq *) wire [2*K-T+19+(DROP>0):0] chord;
    assign out_chord = chord;
endmodule

module engine_gd_touch_path #(parameter W = 16, A = 24, K = 17, T = 10) (
    input clk, input [W-1:0] cfg_l1, cfg_l2, input [W:0] cfg_alpha, input in_shift, in_fine, in_finer, in_alone,
    input [17:0] in_op, input [2*K-T+19:0] in_chord, input [W-1:0] in_x, in_y, in_z,
    output [A-1:0] out_step, output reg [2*W-1:0] out_square
);
    (* anyseq *) wire [A-1:0] step;
    (* anyseq *) wire [2*W-1:0] square;
    assign out_step = step;
    always @(posedge clk) if (in_op[1] || in_op[0]) out_square <= square;
endmodule

// Directions and their steps stand too where the table plays no line and no sample is taken.
module engine_gd_vector_path #(parameter W = 16) (
    input clk, rst, input [W-1:0] cfg_l1, cfg_l2, input [W:0] cfg_alpha, input in_shift, in_fine, in_keep, in_load,
    in_clear, input [13:0] in_op, input [W+1:0] in_c1, in_n1, in_c12, in_n12, input [W-1:0] in_x, in_y,
    output reg [W+1:0] out_c1, out_n1, out_c12, out_n12, output reg [W+3:0] out_d1, out_d12,
    output reg [2*W-1:0] out_square
);
    (* anyseq *) wire [2*W-1:0] square;
    (* anyseq *) wire [4*W+7:0] links;
    (* anyseq *) wire [2*W+7:0] steps;
    always @(posedge clk) begin
        if (in_op[5]) out_square <= square;
        if (rst || in_op != 0 || in_load || in_clear) begin
            {out_c1, out_n1, out_c12, out_n12} <= links;
            {out_d1, out_d12} <= steps;
        end
    end
endmodule
