// SPDX-License-Identifier: Apache-2.0
// Wishbone B4, 32 bits, to a plain register bus of 4 KB. `quadrance registers` puts it in front of a core's registers.
// Every cycle is acknowledged a clock later. A standard master need not look at stall; a pipelined master has to.
// No answer waits for the core, and there is no err or rty.
// Reset: ack; rdata is not reset.
`default_nettype none
module wishbone_face (
    input  wire        clk,
    input  wire        rst,
    input  wire        cyc,
    input  wire        stb,
    input  wire        we,
    input  wire [11:2] adr,
    input  wire [31:0] dat_w,
    input  wire [3:0]  sel,
    output reg         ack,
    output wire        stall,
    output reg  [31:0] dat_r,
    output wire        write,      // in this clock waddr and reg_wdata are written
    output wire        whole,      // with all four bytes
    output wire [9:0]  waddr,      // of a word
    output wire [31:0] reg_wdata,
    output wire [9:0]  raddr,
    input  wire [31:0] reg_rdata
);
    wire take = cyc && stb && !ack;
    assign stall = ack;
    assign write = take && we && !rst;
    assign whole = &sel;
    assign waddr = adr;
    assign reg_wdata = dat_w;
    assign raddr = adr;
    always @(posedge clk) begin
        ack   <= take && !rst;
        dat_r <= reg_rdata;
    end
endmodule
`default_nettype wire
