// The contract of every core that takes a sample every II clocks at most and moves all its samples together:
//   in_ready, out_valid exactly LATENCY clocks after the accepting one, results that wait unchanged, nothing lost,
//   doubled or made up. Reset and in_valid are free at all times but the first clock, and so is all data.
// `age[i]` is 1 when a sample was accepted i + 1 clocks ago (counting the clocks in which it moved).
// ci/formal.py writes a module `top` that instantiates a core and this, with the core's own state beside `age`.
module contract #(parameter LATENCY = 1, II = 1, WO = 1, WC = 1) (
    input clk, rst, in_valid, in_ready, out_valid, out_ready, input [WC-1:0] cfg, input [WO-1:0] out_data,
    output reg [LATENCY-1:0] age, output reg live
);
    initial live = 0;
    always @(posedge clk) live <= 1;
    always @* if (!live) assume (rst);  // one clock of reset, from any state

    wire last = age[LATENCY-1];
    wire move = !last || out_ready;
    wire early;  // a sample was accepted less than II clocks ago
    generate
        if (II > 1) assign early = |age[II-2:0];
        else        assign early = 1'b0;
    endgenerate
    always @(posedge clk)
        if (rst) age <= 0;
        else if (move) age <= {age, in_valid && in_ready};

    // two samples less than II clocks apart; without an adder, for wide sums are cut (cut.v)
    wire [LATENCY+II-1:0] older = age;
    wire [LATENCY-1:0] clash;
    genvar g;
    generate
        for (g = 0; g < LATENCY; g = g + 1) begin : g_clash
            if (II > 1) assign clash[g] = age[g] && |older[g+1 +: II-1];
            else        assign clash[g] = 1'b0;
        end
    endgenerate

    always @* if (live) begin
        assert (in_ready == (move && !early));
        assert (out_valid == last);
        assert (clash == 0);
    end

    // configuration may change while nothing is inside
    reg [WC-1:0] cfg_before;
    reg [WO-1:0] data_before;
    reg waits;
    initial waits = 0;
    always @(posedge clk) begin
        cfg_before <= cfg;
        data_before <= out_data;
        waits <= live && !rst && out_valid && !out_ready;
    end
    always @* if (live) begin
        if (|age) assume (cfg == cfg_before);
        if (waits) assert (out_valid && out_data == data_before);
    end
endmodule
