// The contract where the latency varies (one_inside.sv), and an end: a sample inside is always at one line of the
// table, and every pass but the first counts, up to cfg_limit. So a result comes after at most cfg_limit + 1 passes.
// One clock of reset is enough, from any state.
// rtl: engine_newton_3r engine_newton_program schedule
// with: one_inside.sv
// proof W16A20 mode=prove depth=2 W=16 F=8 A=20 PIPE=0
// proof PIPE1 mode=prove depth=2 W=16 F=8 A=20 PIPE=1
// proof PIPE1M27 mode=prove depth=2 W=16 F=8 A=20 PIPE=1 MULTIPLY=27
// proof W12A24 mode=prove depth=2 W=12 F=6 A=24 PIPE=0
// proof PIPE1W12A24 mode=prove depth=2 W=12 F=6 A=24 PIPE=1
module engine_newton_3r_props #(parameter W = 16, F = 8, A = 20, PIPE = 0, MULTIPLY = 18) (
    input clk, rst, in_valid, out_ready, in_warm, input [W-1:0] cfg_l1, cfg_l2, cfg_l3, in_x, in_y,
    input [15:0] cfg_r1, cfg_r2, cfg_lambda, input [16:0] cfg_mu, input [21:0] cfg_tol, input [9:0] cfg_limit,
    input [A-1:0] in_phi, in_j1, in_j2
);
    wire in_ready, out_valid, out_coarse;
    wire [A-1:0] out_j1, out_j2, out_j3;
    wire [9:0] out_iters;
    wire [31:0] out_error;
    wire [3:0] out_status;
    engine_newton_3r #(.W(W), .F(F), .A(A), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) dut (.*);

    wire live, inside;

    localparam LAST = PIPE == 0 ? 15 : 22;
    (* hierconn *) wire [LAST:0] \dut.program_.control.step ;
    (* hierconn *) wire \dut.first ;
    (* hierconn *) wire [A-1:0] \dut.th12 ;
    wire [LAST:0] step = \dut.program_.control.step ;
    wire          first = \dut.first ;

    wire [3*A+46:0] result = {out_j1, out_j2, out_j3, out_iters, out_error, out_coarse, out_status};
    wire [2*W+31:0] cfg = {cfg_l1, cfg_l2, cfg_limit, cfg_tol};
    one_inside #(.WO(3*A+47), .WC(2*W+32)) rules (.*);
    always @* if (live) begin
        assert ((step != 0) == (inside && !out_valid));
        assert ((step & step - 1) == 0);
        if (inside) assert (out_iters <= cfg_limit);
        if (first && inside) assert (out_iters == 0);
        if (step[LAST:3] != 0 || out_valid) assert (!first);
        if (step[2] && !first) assert (out_iters < cfg_limit);
        // both joints have stood for a clock when a result comes
        if (step[LAST:4] != 0 || step[1:0] != 0 && !first || out_valid) assert (\dut.th12 == out_j1 + out_j2);
        if (out_valid && !out_status[3]) assert (!out_coarse && out_error < cfg_tol);
        if (out_valid && out_status[3]) assert (out_iters == cfg_limit);
    end
endmodule

// The contract where the latency varies (one_inside.sv), and an end: a sample inside is always at one line of the
// table, and every pass but the first counts, up to cfg_limit. The last step is in its registers before a result
// comes. One clock of reset is enough, from any state.
// rtl: engine_quaternion_dls engine_newton_3r engine_newton_program schedule
// with: one_inside.sv
// proof W16A24 mode=prove depth=2 W=16 F=8 A=24 PIPE=0
// proof PIPE1 mode=prove depth=2 W=16 F=8 A=24 PIPE=1
// proof PIPE1M27 mode=prove depth=2 W=16 F=8 A=24 PIPE=1 MULTIPLY=27
// proof W12A20 mode=prove depth=2 W=12 F=6 A=20 PIPE=0
// proof PIPE1W12A20 mode=prove depth=2 W=12 F=6 A=20 PIPE=1
module engine_quaternion_dls_props #(parameter W = 16, F = 8, A = 24, PIPE = 0, MULTIPLY = 18) (
    input clk, rst, in_valid, out_ready, in_warm, input [W-1:0] cfg_l1, cfg_l2, in_x, in_y,
    input [15:0] cfg_r1, cfg_r2, cfg_lambda, input [16:0] cfg_mu, input [21:0] cfg_tol, input [9:0] cfg_limit,
    input [A-1:0] in_j1, in_j2
);
    wire in_ready, out_valid, out_coarse;
    wire [A-1:0] out_j1, out_j2, out_d1, out_d2;
    wire [9:0] out_iters;
    wire [31:0] out_error;
    wire [3:0] out_status;
    engine_quaternion_dls #(.W(W), .F(F), .A(A), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) dut (.*);

    wire live, inside;

    localparam LAST = PIPE == 0 ? 15 : 22;
    (* hierconn *) wire [LAST:0] \dut.newton.program_.control.step ;
    (* hierconn *) wire \dut.newton.first ;
    (* hierconn *) wire \dut.begins ;
    (* hierconn *) wire \dut.odd ;
    wire [LAST:0] step = \dut.newton.program_.control.step ;
    wire          first = \dut.newton.first , begins = \dut.begins ;

    wire [4*A+46:0] result = {out_d1, out_d2, out_j1, out_j2, out_iters, out_error, out_coarse, out_status};
    wire [2*W+31:0] cfg = {cfg_l1, cfg_l2, cfg_limit, cfg_tol};
    one_inside #(.WO(4*A+47), .WC(2*W+32)) rules (.*);
    always @* if (live) begin
        assert ((step != 0) == (inside && !out_valid));
        assert ((step & step - 1) == 0);
        if (inside) assert (out_iters <= cfg_limit);
        if (first && inside) assert (out_iters == 0);
        if (step[LAST:3] != 0 || out_valid) assert (!first);
        if (step[2] && !first) assert (out_iters < cfg_limit);
        // a start is seen in the first line, a step in the fourth
        if (begins && inside) assert (step[0] && first);
        if (out_valid || step[LAST:4] != 0 || step[2:1] != 0 || step[0] && !begins) assert (\dut.odd == out_iters[0]);
        if (out_valid && !out_status[3]) assert (!out_coarse && out_error < cfg_tol);
        if (out_valid && out_status[3]) assert (out_iters == cfg_limit);
    end
endmodule

// What the contract of engine_newton_3r does not depend on: steps, roots and squares of any value, which stand where no
// line of the table changes them.
module engine_newton_path #(parameter A = 20, PIPE = 0, MULTIPLY = 18) (
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
