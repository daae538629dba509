// Wishbone, for standard masters and pipelined ones: each request that is taken is acknowledged once, a clock later, a
// write is done once, and a read answers the word that stood when it was taken.
// rtl: wishbone_face
// proof any mode=prove depth=2
module wishbone_face_props (input clk, rst, cyc, stb, we, input [11:2] adr, input [31:0] dat_w, reg_rdata,
                            input [3:0] sel);
    wire ack, stall, write, whole;
    wire [31:0] dat_r, reg_wdata;
    wire [9:0] waddr, raddr;
    wishbone_face dut (.*);
    reg live = 0;
    always @(posedge clk) live <= 1;
    always @* if (!live) assume (rst);
    wire taken = cyc && stb && !stall && !rst;  // as a pipelined master sees it
    always @* if (live) begin
        assert (write == (taken && we));
        assert (waddr == adr && raddr == adr && reg_wdata == dat_w && whole == &sel);
    end
    always @(posedge clk) if (live && $past(live)) begin
        assert (ack == $past(taken));
        if ($past(taken)) assert (dat_r == $past(reg_rdata));
        if ($past(ack)) assert (!ack);  // a standard master's request of that clock is the one acknowledged
    end
endmodule
