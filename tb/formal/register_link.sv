// One sample at a time: each start is offered until it is taken, once; busy lasts until its result, and no longer.
// rtl: register_link
// proof any mode=prove depth=2
module register_link_props (input clk, rst, wants, room, ready);
    wire busy, capture, finished, in_valid, out_ready;
    wire start = wants && !busy && !rst;
    reg inside, live = 0;
    wire in_ready = room && !inside;
    wire out_valid = inside && ready;
    register_link dut (.*);
    always @(posedge clk) begin
        live <= 1;
        inside <= !rst && ((in_valid && in_ready) || (inside && !(out_valid && out_ready)));
    end
    always @* if (!live) assume (rst);
    always @* if (live) begin
        assert (busy == (in_valid || inside));
        assert (!in_valid || !inside);
        assert (capture == (out_valid && out_ready) && finished == capture);
    end
    always @(posedge clk) if (live) begin
        if ($past(rst)) assert (!busy);
        else if ($past(start)) assert (in_valid);
        else if ($past(live && in_valid && !in_ready)) assert (in_valid);
        else if ($past(live)) assert (!in_valid);
    end
endmodule
