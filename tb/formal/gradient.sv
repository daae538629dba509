// What the gradient engines rest on, whatever the squares are: no answer is called converged but in the fine range and
// below the tolerance; steps never exceed the limit; two passes in a row are never both for nothing; an answer waits
// unchanged; one clock of reset ends it.
// rtl: engine_gd_judge
// proof W16 mode=prove depth=2 W=16
// proof W14 mode=prove depth=2 W=14
module engine_gd_judge_props #(parameter W = 16) (
    input clk, rst, in_start, in_stop, out_ready, input [21:0] cfg_tol, input [9:0] cfg_limit, input [2*W-1:0] in_square
);
    wire out_fine, out_wide, out_halt, out_valid, out_failed;
    wire [9:0] out_iters;
    engine_gd_judge #(.W(W)) dut (.*, .in_step(in_stop));

    reg live, inside, idled, ended;
    reg [31:0] cfg_before;
    reg [10:0] left;  // steps to the limit
    initial {live, inside, idled, ended} = 0;
    always @* if (!live) assume (rst);
    always @(posedge clk) begin
        live <= 1;
        // the engine starts one sample at a time, and judges it only while it is inside
        inside <= !rst && (in_start || inside && !out_halt);
        idled <= in_stop && out_wide && !out_halt && !rst;
        ended <= out_halt && !rst;
        cfg_before <= {cfg_limit, cfg_tol};
    end
    always @* if (live) begin
        assume (!in_start || !inside && (!out_valid || out_ready));
        assume (!in_stop || inside);
        if (inside) assume ({cfg_limit, cfg_tol} == cfg_before || in_start);
        if (inside) assert (out_iters <= cfg_before[31:22]);
        if (inside) assert (!out_valid);
        if (idled) assert (!out_fine && !out_wide);
        if (out_halt) assert (in_stop && !out_wide);
        if (ended) assert (out_valid);
        if (out_halt && out_iters < cfg_limit) assert (out_fine && in_square < cfg_tol);
    end
    reg waits, failed_before;
    initial waits = 0;
    always @(posedge clk) begin
        waits <= live && !rst && out_valid && !out_ready;
        failed_before <= out_failed;
    end
    always @* if (live && waits) assert (out_valid && out_failed == failed_before);
endmodule

// The contract where the latency varies (one_inside.sv), and an end: a sample inside is always at one line of the
// table, at most cfg_limit passes count, and no two in a row do not. So a result comes after at most 2 cfg_limit + 2
// passes. One clock of reset is enough, from any state.
// rtl: engine_quaternion_gd engine_gd_judge schedule
// with: one_inside.sv
// proof W16A24 mode=prove depth=2 W=16 F=8 A=24 PIPE=0
// proof PIPE1 mode=prove depth=2 W=16 F=8 A=24 PIPE=1
// proof W14A20 mode=prove depth=2 W=14 F=6 A=20 PIPE=0
// proof PIPE1W14A20 mode=prove depth=2 W=14 F=6 A=20 PIPE=1
module engine_quaternion_gd_props #(parameter W = 16, F = 8, A = 24, PIPE = 0) (
    input clk, rst, in_valid, out_ready, in_warm, cfg_shift, input [W-1:0] cfg_l1, cfg_l2, in_x, in_y,
    input [W:0] cfg_alpha, input [21:0] cfg_tol, input [9:0] cfg_limit, input [A-1:0] in_j1, in_j2
);
    wire in_ready, out_valid, out_coarse;
    wire [A-1:0] out_j1, out_j2, out_d1, out_d2;
    wire [9:0] out_iters;
    wire [2*W-1:0] out_error;
    wire [3:0] out_status;
    engine_quaternion_gd #(.W(W), .F(F), .A(A), .PIPE(PIPE)) dut (.*);

    wire live, inside;
    reg idled;
    initial idled = 0;

    localparam LAST = PIPE == 0 ? 11 : 15;
    (* hierconn *) wire [LAST:0] \dut.control.step ;
    (* hierconn *) wire \dut.fine ;
    (* hierconn *) wire \dut.wide ;
    wire [LAST:0] step = \dut.control.step ;
    wire        counts = !\dut.wide ;

    wire [4*A+2*W+14:0] result = {out_d1, out_d2, out_j1, out_j2, out_iters, out_error, out_coarse, out_status};
    wire [32:0] cfg = {cfg_shift, cfg_limit, cfg_tol};
    one_inside #(.WO(4*A+2*W+15), .WC(33)) rules (.*);
    always @(posedge clk)
        idled <= live && !rst && step[LAST] && !counts;
    always @* if (live) begin
        assert ((step != 0) == (inside && !out_valid));
        assert ((step & step - 1) == 0);
        if (inside) assert (out_iters <= cfg_limit);
        // a pass that does not count ends in the coarse range, where every pass counts
        if (idled) assert (step[0] && !\dut.fine );
        if (!\dut.fine ) assert (counts);
        if (step[LAST-1] || step[LAST]) assert (!counts || out_iters < cfg_limit);
        if (out_valid && !out_status[3]) assert (\dut.fine && out_error < cfg_tol);
        if (out_valid && out_status[3]) assert (out_iters == cfg_limit);
    end
endmodule

// The contract where the latency varies (one_inside.sv), and an end: a sample inside is always at one line of the
// table or between two passes, at most cfg_limit passes count, and no two in a row do not. So a result comes after at
// most 2 cfg_limit + 2 passes. One clock of reset is enough, from any state.
// rtl: engine_quaternion_gd_touch engine_gd_judge schedule
// with: one_inside.sv
// proof W16A24 mode=prove depth=2 W=16 F=8 A=24 PIPE=0
// proof PIPE1 mode=prove depth=2 W=16 F=8 A=24 PIPE=1
// proof W14A20 mode=prove depth=2 W=14 F=6 A=20 PIPE=0
// proof PIPE1W14A20 mode=prove depth=2 W=14 F=6 A=20 PIPE=1
module engine_quaternion_gd_touch_props #(parameter W = 16, F = 8, A = 24, PIPE = 0) (
    input clk, rst, in_valid, out_ready, in_warm, cfg_shift, input [W-1:0] cfg_l1, cfg_l2, in_x, in_y, in_z,
    input [A-1:0] in_j1, in_j2, in_j3,
    input [W:0] cfg_alpha, input [21:0] cfg_tol, input [9:0] cfg_limit
);
    wire in_ready, out_valid, out_coarse;
    wire [A-1:0] out_j1, out_j2, out_j3, out_d1, out_d2, out_d3;
    wire [9:0] out_iters;
    wire [2*W-1:0] out_error;
    wire [3:0] out_status;
    engine_quaternion_gd_touch #(.W(W), .F(F), .A(A), .PIPE(PIPE)) dut (.*);

    wire live, inside;
    reg idled;
    initial idled = 0;

    localparam LAST = PIPE == 0 ? 13 : 16;
    (* hierconn *) wire [LAST:0] \dut.control.step ;
    (* hierconn *) wire \dut.fine ;
    (* hierconn *) wire \dut.wide ;
    (* hierconn *) wire \dut.again ;
    (* hierconn *) wire [1:0] \dut.late ;
    wire [LAST:0] step = \dut.control.step ;

    wire [6*A+2*W+14:0] result = {out_j1, out_j2, out_j3, out_d1, out_d2, out_d3, out_iters, out_error, out_coarse, out_status};
    wire [32:0] cfg = {cfg_shift, cfg_limit, cfg_tol};
    one_inside #(.WO(6*A+2*W+15), .WC(33)) rules (.*);
    always @(posedge clk)
        idled <= live && !rst && step[LAST-1] && \dut.wide ;
    always @* if (live) begin
        assert ((step != 0 || \dut.again ) == (inside && !out_valid));
        assert (!(step != 0 && \dut.again ) && (step & step - 1) == 0);
        if (inside) assert (out_iters <= cfg_limit);
        // a pass that does not count ends in the coarse range, where every pass counts
        if (idled) assert (\dut.again && !\dut.fine );
        if (!\dut.fine ) assert (!\dut.wide );
        if (out_valid && !out_status[3]) assert (\dut.fine && out_error < cfg_tol);
        if (out_valid && out_status[3]) assert (out_iters == cfg_limit);
        // late steps are made in the first two lines
        if (\dut.late [0]) assert (step[0]);
        if (\dut.late [1]) assert (step[1]);
    end
endmodule

// The contract where the latency varies (one_inside.sv), and an end: a sample inside is always at one line of the
// table or between two passes, at most cfg_limit passes count, and no two in a row do not. So a result comes after at
// most 2 cfg_limit + 2 passes. One clock of reset is enough, from any state.
// rtl: engine_quaternion_gd_vector engine_gd_judge schedule
// with: one_inside.sv
// proof W16 mode=prove depth=2 W=16 F=8 PIPE=0
// proof PIPE1 mode=prove depth=2 W=16 F=8 PIPE=1
// proof PIPE1M27 mode=prove depth=2 W=16 F=8 PIPE=1 MULTIPLY=27
// proof W14 mode=prove depth=2 W=14 F=6 PIPE=0
// proof PIPE1W14 mode=prove depth=2 W=14 F=6 PIPE=1
module engine_quaternion_gd_vector_props #(parameter W = 16, F = 8, PIPE = 0, MULTIPLY = 18) (
    input clk, rst, in_valid, out_ready, in_warm, cfg_shift, input [W-1:0] cfg_l1, cfg_l2, in_x, in_y,
    input [W+1:0] in_c1, in_n1, in_c12, in_n12,
    input [W:0] cfg_alpha, input [21:0] cfg_tol, input [9:0] cfg_limit
);
    wire in_ready, out_valid, out_coarse;
    wire [W+1:0] out_c1, out_n1, out_c12, out_n12;
    wire [W+3:0] out_d1, out_d12;
    wire [9:0] out_iters;
    wire [2*W-1:0] out_error;
    wire [3:0] out_status;
    engine_quaternion_gd_vector #(.W(W), .F(F), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) dut (.*);

    wire live, inside;
    reg idled;
    initial idled = 0;

    localparam LAST = PIPE == 0 ? 12 : 19;
    (* hierconn *) wire [LAST:0] \dut.control.step ;
    (* hierconn *) wire \dut.fine ;
    (* hierconn *) wire \dut.wide ;
    (* hierconn *) wire \dut.again ;
    wire [LAST:0] step = \dut.control.step ;

    wire [8*W+30:0] result = {out_c1, out_n1, out_c12, out_n12, out_d1, out_d12, out_iters, out_error, out_coarse, out_status};
    wire [32:0] cfg = {cfg_shift, cfg_limit, cfg_tol};
    one_inside #(.WO(8*W+31), .WC(33)) rules (.*);
    always @(posedge clk)
        idled <= live && !rst && step[8] && \dut.wide ;
    always @* if (live) begin
        assert ((step != 0 || \dut.again ) == (inside && !out_valid));
        assert (!(step != 0 && \dut.again ) && (step & step - 1) == 0);
        if (inside) assert (out_iters <= cfg_limit);
        // a pass that does not count ends in the coarse range, where every pass counts
        if (idled) assert (\dut.again && !\dut.fine );
        if (!\dut.fine ) assert (!\dut.wide );
        if (out_valid && !out_status[3]) assert (\dut.fine && out_error < cfg_tol);
        if (out_valid && out_status[3]) assert (out_iters == cfg_limit);
    end
endmodule

// What the contract of a gradient engine does not depend on: steps and chords of any value. The square is any value
// too, but it stands where no line of the table changes it.
module engine_gd_path #(parameter W = 16, A = 24, K = 17, T = 10, PIPE = 0) (
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

module engine_gd_touch_path #(parameter W = 16, A = 24, K = 17, T = 10, PIPE = 0) (
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
module engine_gd_vector_path #(parameter W = 16, PIPE = 0, MULTIPLY = 18) (
    input clk, rst, input [W-1:0] cfg_l1, cfg_l2, input [W:0] cfg_alpha, input in_shift, in_fine, in_keep, in_load,
    in_clear, in_stay, input [13:0] in_op, input [W+1:0] in_c1, in_n1, in_c12, in_n12, input [W-1:0] in_x, in_y,
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
