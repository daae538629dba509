// SPDX-License-Identifier: Apache-2.0
// One sample at a time from registers to a core in a clock of its own, and its result back. The clocks are unrelated.
// `go` and `answer` are a handshake of four phases: go rises with a sample, answer with its result, which the registers
// capture; go falls, the core lets the result go, answer falls, and the registers are free again. Each passes two
// flip-flops. Data pass none: a sample and cfg stand still while busy, a result waits for out_ready.
// A reset of the bus resets the core: core_rst rises at once and falls with core_clk; busy is high until it has fallen.
// core_clk has to run. Reset: go and closing.
`default_nettype none
module register_crossing (
    input  wire clk,
    input  wire rst,
    input  wire start,
    output wire busy,
    output wire capture,    // the result has not changed for two clocks
    output wire finished,
    input  wire core_clk,
    output wire core_rst,
    output wire in_valid,
    input  wire in_ready,
    input  wire out_valid,
    output wire out_ready
);
    reg go, closing;
    reg clear, cleared;  // rst a clock ago; clear reaches the core's flip-flops without a clock, so it has no glitch
    reg taken, answer;
    (* ASYNC_REG = "TRUE" *) reg [1:0] core_clear, core_go;  // bit 0 first
    (* ASYNC_REG = "TRUE" *) reg [1:0] bus_clear, bus_answer;
    // the clock of the bus
    assign busy = go || closing || bus_clear[1] || bus_answer[1];
    assign capture = go && bus_answer[1];
    assign finished = closing && !bus_answer[1];
    always @(posedge clk) begin
        clear   <= rst;
        cleared <= rst;
        if (rst) begin
            go      <= 1'b0;
            closing <= 1'b0;
        end else begin
            go      <= start || (go && !capture);
            closing <= capture || (closing && !finished);
        end
        bus_answer <= {bus_answer[0], answer};
        if (rst || cleared) bus_clear <= 2'b11;  // core_rst has two clocks to rise
        else bus_clear <= {bus_clear[0], core_rst};
    end
    // the clock of the core
    assign core_rst = core_clear[1];
    assign in_valid = core_go[1] && !taken;
    assign out_ready = taken && !core_go[1];
    always @(posedge core_clk or posedge clear)
        if (clear) begin
            core_clear <= 2'b11;
            core_go    <= 2'b00;
        end else begin
            core_clear <= {core_clear[0], 1'b0};
            core_go    <= {core_go[0], go};
        end
    always @(posedge core_clk)
        if (core_rst) begin
            taken  <= 1'b0;
            answer <= 1'b0;
        end else begin
            taken  <= (in_valid && in_ready) || (taken && !(out_valid && out_ready));
            answer <= taken && out_valid && core_go[1];
        end
endmodule
`default_nettype wire
