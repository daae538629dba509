// SPDX-License-Identifier: Apache-2.0
// AXI4-Lite, 32 bits, to a plain register bus of 4 KB. `quadrance registers` puts it in front of a core's registers.
// A write and a read each take two clocks. No answer waits for the core, and every answer is OKAY.
// Address and data of a write are taken together. Every output but arready, write and the address of a read is a
// register. rdata is what reg_rdata was when the address was taken.
// Reset: awready, bvalid and rvalid; rdata is not reset.
`default_nettype none
module axil_face (
    input  wire        aclk,
    input  wire        aresetn,
    input  wire        awvalid,
    output wire        awready,
    input  wire [11:0] awaddr,
    input  wire        wvalid,
    output wire        wready,
    input  wire [31:0] wdata,
    input  wire [3:0]  wstrb,
    output reg         bvalid,
    input  wire        bready,
    output wire [1:0]  bresp,
    input  wire        arvalid,
    output wire        arready,
    input  wire [11:0] araddr,
    output reg         rvalid,
    input  wire        rready,
    output reg  [31:0] rdata,
    output wire [1:0]  rresp,
    output wire        write,      // in this clock waddr and reg_wdata are written
    output wire        whole,      // with all four bytes
    output wire [9:0]  waddr,      // of a word
    output wire [31:0] reg_wdata,
    output wire [9:0]  raddr,
    input  wire [31:0] reg_rdata
);
    reg take;  // both valids were high a clock ago, and so they are now: they hold until taken
    assign awready = take;
    assign wready = take;
    assign write = take;
    assign whole = &wstrb;
    assign waddr = awaddr[11:2];
    assign reg_wdata = wdata;
    assign arready = !rvalid;
    assign raddr = araddr[11:2];
    assign bresp = 2'b00;
    assign rresp = 2'b00;
    always @(posedge aclk)
        if (arready) rdata <= reg_rdata;
    always @(posedge aclk)
        if (!aresetn) begin
            take   <= 1'b0;
            bvalid <= 1'b0;
            rvalid <= 1'b0;
        end else begin
            take   <= awvalid && wvalid && !take && (!bvalid || bready);
            bvalid <= take || (bvalid && !bready);
            rvalid <= rvalid ? !rready : arvalid;
        end
    wire unused = &{1'b0, awaddr[1:0], araddr[1:0]};
endmodule
`default_nettype wire
