// n * 2^F = q d + r, 0 <= r < d, in order, once for each word, whatever the stalls.
// Invariant: the followed word, wherever it is, carries the quotient of the leading K bits of its own numerator.
// rtl: divide divide_digits
// with: stream_token.sv grow_product.sv
// proof 12by12 mode=prove depth=2 WN=12 WD=12 F=0 R=1
// proof 8by8R3 mode=prove depth=2 WN=8 WD=8 F=0 R=3
// proof 10by6F3R2 mode=prove depth=2 WN=10 WD=6 F=3 R=2
module divide_pipe_props #(parameter WN = 16, WD = 16, F = 0, R = 1) (
    input clk, rst, in_valid, out_ready, input [WN-1:0] in_n, input [WD-1:0] in_d
);
    localparam N = WN + F, M = (N - 1) / R, H = N - M * R;
    wire in_ready, out_valid, arrived, live, out_div_by_zero;
    wire [N-1:0] out_q;
    wire [WD-1:0] out_r;
    wire [7:0] accepted, delivered, index;
    wire [WN+WD-1:0] token;
    divide #(.MODE(1), .WN(WN), .WD(WD), .F(F), .R(R)) dut (.*);
    stream_token #(.WI(WN+WD), .WO(N+WD+1)) stream (
        .in_data({in_n, in_d}), .out_data({out_q, out_r, out_div_by_zero}), .*);
    (* hierconn *) wire [M:0] \dut.g_pipelined.valid ;
    (* hierconn *) wire [H-1:0] \dut.head_q ;

    wire [N-1:0] n = token[WN+WD-1:WD] << F;
    wire [WD-1:0] divisor = token[WD-1:0];
    always @* if (live) begin
        assert (8'(accepted - delivered) == $countones(\dut.g_pipelined.valid ));
        assert (in_ready == (!out_valid || out_ready));
    end

    genvar s;
    for (s = 0; s <= M; s = s + 1) begin : \dut.g_pipelined.g_stage
        localparam K = H + s * R, A = K < WD ? K : WD, L = s == 0 ? H : R;
        (* hierconn *) wire [A-1:0] rem;
        (* hierconn *) wire [N-1:0] both;
        (* hierconn *) wire zero;
        wire [M+1:0] ahead = {1'b0, \dut.g_pipelined.valid } >> (s + 1);
        wire mine = \dut.g_pipelined.valid [s] && 8'(delivered + $countones(ahead)) == index;
        reg [N+WD-1:0] product;  // of this stage's quotient and divisor
        wire [N+WD-1:0] before, grown;
        wire [WD-1:0] factor;
        wire [L-1:0] digits;
        if (s == 0) begin : g_head
            assign before = 0, factor = in_d, digits = \dut.head_q ;
        end else begin : g_digits
            (* hierconn *) wire [R-1:0] q;
            assign before = \dut.g_pipelined.g_stage [s-1].product, factor = \dut.g_pipelined.g_stage [s-1].g_d.d, digits = q;
        end
        grow_product #(.N(N), .WD(WD), .R(L)) step (.product(before), .d(factor), .digits(digits), .grown(grown));
        always @(posedge clk) if (in_ready) product <= grown;
        wire [K+WD-1:0] prefix = n[N-1 -: K];
        always @* if (live && mine) begin
            assert (zero == (divisor == 0));
            if (zero) assert (&both[K-1:0] && rem == prefix[A-1:0]);
            else assert (product + rem == prefix && rem < divisor);
        end
        if (s < M) begin : g_d
            (* hierconn *) wire [WD-1:0] d;
            always @* if (live && mine) assert (d == divisor && both[N-1:K] == n[N-K-1:0]);
        end
    end
    always @* if (live && arrived) begin
        assert (out_div_by_zero == (divisor == 0));
        if (divisor == 0) assert (&out_q && out_r == {{WD{1'b0}}, n} % (1 << WD));
        else assert (\dut.g_pipelined.g_stage [M].product + out_r == n && out_r < divisor);
    end
endmodule
