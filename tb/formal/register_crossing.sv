// A sample crosses once and its result once; busy lasts as long as the core has the sample, and from a reset of the bus
// until the core has been reset. What the core reads has stood still for two of its clocks, what the bus captures for
// two of the bus. The clocks are free inputs; the core is any that keeps the contract; the first state is any.
// rtl: register_crossing
// proof any mode=prove depth=2 clocks=free
module register_crossing_props (input clk, rst, wants, core_clk, in_ready_any, done_any);
    wire busy, capture, finished, core_rst, in_valid, in_ready, out_valid, out_ready;
    wire start = wants && !busy && !rst;
    register_crossing dut (.*);
    (* hierconn *) wire \dut.go , \dut.closing , \dut.clear , \dut.cleared , \dut.taken , \dut.answer ;
    (* hierconn *) wire [1:0] \dut.core_clear , \dut.core_go , \dut.bus_clear , \dut.bus_answer ;

    // any core with room for one sample
    reg inside, result;
    assign in_ready = in_ready_any && !inside;
    assign out_valid = result;
    always @(posedge core_clk)
        if (core_rst) {inside, result} <= 0;
        else begin
            if (in_valid && in_ready) inside <= 1;
            if (inside && done_any) result <= 1;
            if (out_valid && out_ready) {inside, result} <= 0;
        end

    // every event turns a bit; they come in the order started, accepted, captured, let_go, ended
    reg live = 0, started, captured, ended, accepted, let_go;
    reg [1:0] stood_bus, stood_core;
    always @(posedge clk) begin
        live <= 1;
        {started, captured, ended} <= rst ? 3'b0 : {started ^ start, captured ^ capture, ended ^ finished};
        stood_bus <= {stood_bus[0], out_valid};
    end
    always @(posedge core_clk) begin
        {accepted, let_go} <= core_rst ? 2'b0 : {accepted ^ (in_valid && in_ready), let_go ^ (out_valid && out_ready)};
        stood_core <= {stood_core[0], busy};
    end
    (* gclk *) reg gclk;
    reg clk_was = 1, core_clk_was = 1, dirty_was, rst_was, core_rst_was;
    wire dirty = clk && !clk_was && rst_was || dirty_was && !(core_clk && !core_clk_was && core_rst_was);
    always @(posedge gclk)  // dirty: reset, and no reset of the core since
        {clk_was, core_clk_was, dirty_was, rst_was, core_rst_was} <= {clk, core_clk, dirty, rst, core_rst};
    always @* if (!live) assume (rst);

    // go and what follows it, in this order: at most one neighbour differs, so that a wave of ones or zeros passes
    wire [5:0] wave = {\dut.go , \dut.core_go [0], \dut.core_go [1], \dut.answer ,
        \dut.bus_answer [0], \dut.bus_answer [1]};
    wire [1:0] stood_core_late = {stood_core[0], &stood_core}, stood_bus_late = {stood_bus[0], &stood_bus};
    wire recovers = \dut.bus_clear [1];
    wire quiet = !(\dut.go || \dut.closing || started || captured || ended || |\dut.core_go );
    wire idle = !(\dut.taken || \dut.answer || inside || result || accepted || let_go);
    always @* if (live) begin
        assert (!dirty || busy && !in_valid);
        assert (started == ended || busy);
        assert (recovers || (started ^ accepted) + (accepted ^ captured) + (captured ^ let_go) + (let_go ^ ended) <= 1);
        if (capture) assert (out_valid && &stood_bus);
        if (in_valid) assert (&stood_core);
        // the possible states
        assert (\dut.clear == \dut.cleared );
        if (\dut.clear ) assert (&\dut.core_clear && &\dut.bus_clear );
        assert ((\dut.core_clear [0] <= core_rst) && (core_rst <= \dut.bus_clear [0]) && (\dut.bus_clear [0] <= recovers));
        assert (!dirty || (\dut.core_clear [0] && recovers));
        if (recovers) assert (quiet);
        if (recovers && !\dut.core_clear [0]) assert (idle);
        if (recovers && !\dut.bus_clear [0]) assert (!\dut.bus_answer [0]);
        if (!recovers) begin
            assert ((wave[5] ^ wave[4]) + (wave[4] ^ wave[3]) + (wave[3] ^ wave[2]) + (wave[2] ^ wave[1])
                    + (wave[1] ^ wave[0]) <= 1);
            assert (\dut.taken == inside && result <= inside);
            assert (!\dut.answer || result);
            assert (\dut.core_go [1] || \dut.taken == \dut.answer );
            assert (\dut.closing ? !\dut.go : \dut.go || wave == 0);
            assert ((started ^ accepted) == (\dut.go && !\dut.taken ));
            assert ((accepted ^ captured) == (\dut.go && \dut.taken ));
            assert ((captured ^ let_go) == (!\dut.go && \dut.taken ));
            assert ((let_go ^ ended) == (\dut.closing && !\dut.taken ));
            if (wave[5]) assert ((wave[4:3] & ~stood_core_late) == 0 && (wave[1:0] & ~stood_bus_late) == 0);
        end
    end
endmodule
