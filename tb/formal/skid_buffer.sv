// Every word arrives unchanged, in order, once each; in_ready is a register; a word never waits without need.
// rtl: skid_buffer
// with: stream_token.sv
// proof W16 mode=prove depth=2 W=16
module skid_buffer_props #(parameter W = 16) (input clk, rst, in_valid, out_ready, input [W-1:0] in_d);
    wire in_ready, out_valid, arrived, live;
    wire [W-1:0] out_d, token;
    wire [7:0] accepted, delivered, index;
    skid_buffer #(.W(W)) dut (.*);
    stream_token #(.WI(W), .WO(W)) stream (.in_data(in_d), .out_data(out_d), .*);
    (* hierconn *) wire [W-1:0] \dut.skid ;

    wire [7:0] held = accepted - delivered;
    wire [7:0] last = accepted - 8'd1;
    always @* if (live) begin
        assert (held <= 2);
        assert (out_valid == (held != 0));
        assert (in_ready == (held != 2));
        if (arrived) assert (out_d == token);
        if (held == 2 && last == index) assert (\dut.skid == token);
    end
    // full throughput: what came in is on the output a clock later, and with the output free ready never falls
    always @(posedge clk) if (live && $past(live)) begin
        if ($past(in_valid && in_ready && (!out_valid || out_ready))) assert (out_valid && out_d == $past(in_d));
        if ($past(in_ready && (!out_valid || out_ready))) assert (in_ready);
    end
endmodule
