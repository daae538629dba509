// The contract where the latency varies (one_inside.sv), and an end: a sample inside is always at one line of the
// table or between two passes, at most cfg_limit passes count, and no two in a row do not. So a result comes after at
// most 2 cfg_limit + 2 passes. One clock of reset is enough, from any state.
// rtl: engine_quaternion_gd_touch engine_gd_judge schedule
// with: one_inside.sv gradient_parts.sv
// proof W16A24 mode=prove depth=2 W=16 F=8 A=24
// proof W14A20 mode=prove depth=2 W=14 F=6 A=20
module engine_quaternion_gd_touch_props #(parameter W = 16, F = 8, A = 24) (
    input clk, rst, in_valid, out_ready, in_warm, cfg_shift, input [W-1:0] cfg_l1, cfg_l2, in_x, in_y, in_z,
    input [A-1:0] in_j1, in_j2, in_j3,
    input [W:0] cfg_alpha, input [21:0] cfg_tol, input [9:0] cfg_limit
);
    wire in_ready, out_valid, out_coarse;
    wire [A-1:0] out_j1, out_j2, out_j3, out_d1, out_d2, out_d3;
    wire [9:0] out_iters;
    wire [2*W-1:0] out_error;
    wire [3:0] out_status;
    engine_quaternion_gd_touch #(.W(W), .F(F), .A(A)) dut (.*);

    wire live, inside;
    reg idled;
    initial idled = 0;

    (* hierconn *) wire [13:0] \dut.control.step ;
    (* hierconn *) wire \dut.fine ;
    (* hierconn *) wire \dut.wide ;
    (* hierconn *) wire \dut.again ;
    (* hierconn *) wire [1:0] \dut.late ;
    wire [13:0] step = \dut.control.step ;

    wire [6*A+2*W+14:0] result = {out_j1, out_j2, out_j3, out_d1, out_d2, out_d3, out_iters, out_error, out_coarse, out_status};
    wire [32:0] cfg = {cfg_shift, cfg_limit, cfg_tol};
    one_inside #(.WO(6*A+2*W+15), .WC(33)) rules (.*);
    always @(posedge clk)
        idled <= live && !rst && step[12] && \dut.wide ;
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
