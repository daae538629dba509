// The contract where the latency varies (one_inside.sv), and an end: a sample inside is always at one line of the
// table or between two passes, at most cfg_limit passes count, and no two in a row do not. So a result comes after at
// most 2 cfg_limit + 2 passes. One clock of reset is enough, from any state.
// rtl: engine_quaternion_gd_vector engine_gd_judge schedule
// with: one_inside.sv gradient_parts.sv
// proof W16 mode=prove depth=2 W=16 F=8
// proof W14 mode=prove depth=2 W=14 F=6
module engine_quaternion_gd_vector_props #(parameter W = 16, F = 8) (
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
    engine_quaternion_gd_vector #(.W(W), .F(F)) dut (.*);

    wire live, inside;
    reg idled;
    initial idled = 0;

    (* hierconn *) wire [12:0] \dut.control.step ;
    (* hierconn *) wire \dut.fine ;
    (* hierconn *) wire \dut.wide ;
    (* hierconn *) wire \dut.again ;
    wire [12:0] step = \dut.control.step ;

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
