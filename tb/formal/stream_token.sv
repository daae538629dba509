// The promises of every stream, watched from outside: a result waits unchanged, results come in order, one for each
// accepted word. One arbitrary word (the `index`-th, modulo 256) is followed: `token` is what went in, and when
// `arrived`, it is the one on the output. Fewer than 256 words are ever in flight, so the match is unique.
module stream_token #(parameter WI = 1, WO = 1) (
    input clk, rst, in_valid, in_ready, input [WI-1:0] in_data, input out_valid, out_ready, input [WO-1:0] out_data,
    output reg [7:0] accepted, delivered, output [7:0] index, output reg [WI-1:0] token, output arrived, live
);
    (* anyconst *) reg [7:0] any;
    assign index = any;
    assign arrived = out_valid && delivered == index;

    reg started = 0;
    assign live = started && !rst;
    always @(posedge clk) started <= 1;
    always @* if (!started) assume (rst);

    always @(posedge clk) begin
        if (rst) {accepted, delivered} <= 0;
        else begin
            accepted <= accepted + (in_valid && in_ready);
            delivered <= delivered + (out_valid && out_ready);
        end
        if (in_valid && in_ready && accepted == index) token <= in_data;
        if (live && $past(out_valid && !out_ready && !rst)) assert (out_valid && $stable(out_data));
    end
    always @* if (live) begin
        if (out_valid) assert (accepted != delivered);  // nothing is sent twice or made up
        assert (in_ready || out_valid || accepted != delivered);  // an empty core is ready
    end
endmodule
