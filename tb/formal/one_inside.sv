// The contract where one sample is inside and the latency varies: nothing lost, doubled or made up, results that wait
// unchanged. The configuration may change while nothing is inside. One clock of reset, from any state. What keeps an
// induction from impossible states, and that there is an end, are the core's own properties beside it.
module one_inside #(parameter WO = 1, WC = 1) (
    input clk, rst, in_valid, in_ready, out_valid, out_ready, input [WC-1:0] cfg, input [WO-1:0] result,
    output reg live, inside
);
    reg waits;
    reg [WO-1:0] result_before;
    reg [WC-1:0] cfg_before;
    initial {live, inside, waits} = 0;
    always @* if (!live) assume (rst);
    always @(posedge clk) begin
        live <= 1;
        inside <= !rst && (in_valid && in_ready || inside && !(out_valid && out_ready));
        waits <= live && !rst && out_valid && !out_ready;
        result_before <= result;
        cfg_before <= cfg;
    end
    always @* if (live) begin
        if (inside) assume (cfg == cfg_before);
        assert (in_ready == (!inside || out_valid && out_ready));
        if (out_valid) assert (inside);
        if (waits) assert (out_valid && result == result_before);
    end
endmodule
