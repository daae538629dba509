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
