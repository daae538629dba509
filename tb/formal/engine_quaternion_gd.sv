// The contract where the latency varies (one_inside.sv), and an end: a sample inside is always at one line of the
// table, at most cfg_limit passes count, and no two in a row do not. So a result comes after at most 2 cfg_limit + 2
// passes. One clock of reset is enough, from any state.
// rtl: engine_quaternion_gd engine_gd_judge schedule
// with: one_inside.sv gradient_parts.sv
// proof W16A24 mode=prove depth=2 W=16 F=8 A=24
// proof W14A20 mode=prove depth=2 W=14 F=6 A=20
module engine_quaternion_gd_props #(parameter W = 16, F = 8, A = 24) (
    input clk, rst, in_valid, out_ready, in_warm, cfg_shift, input [W-1:0] cfg_l1, cfg_l2, in_x, in_y,
    input [W:0] cfg_alpha, input [21:0] cfg_tol, input [9:0] cfg_limit, input [A-1:0] in_j1, in_j2
);
    wire in_ready, out_valid, out_coarse;
    wire [A-1:0] out_j1, out_j2, out_d1, out_d2;
    wire [9:0] out_iters;
    wire [2*W-1:0] out_error;
    wire [3:0] out_status;
    engine_quaternion_gd #(.W(W), .F(F), .A(A)) dut (.*);

    wire live, inside;
    reg idled;
    initial idled = 0;

    (* hierconn *) wire [11:0] \dut.control.step ;
    (* hierconn *) wire \dut.fine ;
    (* hierconn *) wire \dut.wide ;
    wire [11:0] step = \dut.control.step ;
    wire        counts = !\dut.wide ;

    wire [4*A+2*W+14:0] result = {out_d1, out_d2, out_j1, out_j2, out_iters, out_error, out_coarse, out_status};
    wire [32:0] cfg = {cfg_shift, cfg_limit, cfg_tol};
    one_inside #(.WO(4*A+2*W+15), .WC(33)) rules (.*);
    always @(posedge clk)
        idled <= live && !rst && step[11] && !counts;
    always @* if (live) begin
        assert ((step != 0) == (inside && !out_valid));
        assert ((step & step - 1) == 0);
        if (inside) assert (out_iters <= cfg_limit);
        // a pass that does not count ends in the coarse range, where every pass counts
        if (idled) assert (step[0] && !\dut.fine );
        if (!\dut.fine ) assert (counts);
        if (step[10] || step[11]) assert (!counts || out_iters < cfg_limit);
        if (out_valid && !out_status[3]) assert (\dut.fine && out_error < cfg_tol);
        if (out_valid && out_status[3]) assert (out_iters == cfg_limit);
    end
endmodule
