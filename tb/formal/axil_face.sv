// AXI4-Lite, for any master that keeps its rules: each write is done once and answered once, each read is answered once
// with the word that stood when its address was taken, answers wait unchanged, and a write is the one that is offered.
// rtl: axil_face
// proof any mode=prove depth=2
module axil_face_props (input aclk, aresetn, awvalid, wvalid, bready, arvalid, rready, input [11:0] awaddr, araddr,
                        input [31:0] wdata, reg_rdata, input [3:0] wstrb);
    wire awready, wready, bvalid, arready, rvalid, write, whole;
    wire [1:0] bresp, rresp;
    wire [31:0] rdata, reg_wdata;
    wire [9:0] waddr, raddr;
    axil_face dut (.*);
    reg live = 0, owed_b, owed_r;
    reg [31:0] owed;
    always @(posedge aclk) begin
        live <= 1;
        owed_b <= aresetn && (write || (owed_b && !(bvalid && bready)));
        owed_r <= aresetn && ((arvalid && arready) || (owed_r && !(rvalid && rready)));
        if (arvalid && arready) owed <= reg_rdata;
    end
    always @* if (!live) assume (!aresetn);
    // the master's rules
    always @(posedge aclk) if (live && $past(aresetn)) begin
        if ($past(awvalid && !awready)) assume (awvalid && $stable(awaddr));
        if ($past(wvalid && !wready)) assume (wvalid && $stable({wdata, wstrb}));
        if ($past(arvalid && !arready)) assume (arvalid && $stable(araddr));
    end
    always @* if (live) begin
        assert (bvalid == owed_b && rvalid == owed_r);
        if (rvalid) assert (rdata == owed);
        assert (bresp == 0 && rresp == 0);
        assert (raddr == araddr[11:2]);
        if (write && aresetn) assert (awvalid && wvalid && (!owed_b || bready));
        if (write) assert (awready && wready && waddr == awaddr[11:2] && reg_wdata == wdata && whole == &wstrb);
        assert (awready == write && wready == write);
        if (arready) assert (!owed_r);
    end
    always @(posedge aclk) if (live && $past(live && aresetn) && aresetn) begin
        // no wait without need: a write is taken a clock after it is offered, a read at once
        if ($past(awvalid && wvalid && !write && !bvalid)) assert (write);
        if ($past(rvalid && rready)) assert (arready);
    end
endmodule
