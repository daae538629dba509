// n * 2^F = q d + r, 0 <= r < d, by multiplication, nothing assumed; d = 0 as documented.
// rtl: divide_comb divide_digits
// proof 8by8 mode=prove depth=1 WN=8 WD=8 F=0
// proof 6by4F2 mode=prove depth=1 WN=6 WD=4 F=2
module divide_comb_props #(parameter WN = 8, WD = 8, F = 0) (input clk, input [WN-1:0] in_n, input [WD-1:0] in_d);
    wire [WN+F-1:0] q;
    wire [WD-1:0] r;
    wire zero;
    divide_comb #(.WN(WN), .WD(WD), .F(F)) dut (
        .in_n(in_n), .in_d(in_d), .out_q(q), .out_r(r), .out_div_by_zero(zero));
    wire [WN+WD+F-1:0] n = in_n << F;
    wire [WN+WD+F-1:0] product = q * in_d;
    always @* begin
        assert (zero == (in_d == 0));
        if (zero) assert (&q && r == n[WD-1:0]);
        else assert (r < in_d && product <= n && n - product == r);
    end
endmodule

// One digit keeps 0 <= rem < d and takes exactly the divisor: 2 rem + bit = out_rem + (q ? d : 0), q the new digit.
// So n = quotient d + rem follows for any number of digits: by induction, and as (2 Q + q) d = 2 Q d + q d.
// d = 0 yields q = 1 and the low WD bits of 2 rem + bit.
// rtl: divide_digits
// proof 0_to_20_by_16 mode=prove depth=1 N=20 WD=16
// proof 0_to_38_by_36 mode=prove depth=1 N=38 WD=36
// proof 0_to_4_by_1 mode=prove depth=1 N=4 WD=1
// proof 0_to_8_by_6 mode=prove depth=1 N=8 WD=6
module divide_digits_props #(parameter N = 20, WD = 16) (input clk);
    genvar k;
    for (k = 0; k <= N; k = k + 1) begin : g_row
        localparam B = k < 1 ? 1 : k < WD ? k : WD, A = k + 1 < WD ? k + 1 : WD;
        (* anyseq *) reg [B-1:0] rem;
        (* anyseq *) reg [WD-1:0] d;
        (* anyseq *) reg next;
        wire [A-1:0] out_rem;
        wire q;
        divide_digits #(.K(k), .R(1), .WD(WD)) dut (.in_rem(rem), .in_d(d), .in_bits(next), .out_rem(out_rem), .out_q(q));
        wire [WD+1:0] partial = {rem, next};
        always @* begin
            if (k == 0) assume (rem == 0);
            assume (d == 0 || rem < d);
            if (d == 0) assert (q && out_rem == partial[A-1:0]);
            else assert (partial == out_rem + (q ? d : 0) && out_rem < d);
        end
    end
endmodule

// n * 2^F = q d + r, 0 <= r < d, in order, once for each word, after exactly ceil((WN + F) / R) clocks.
// Invariant: after `age` clocks the same holds of the leading K numerator bits, and `todo` has the next bits.
// rtl: divide divide_digits
// with: stream_token.sv
// proof 16by16 mode=prove depth=2 WN=16 WD=16 F=0 R=1
// proof 16by16R2 mode=prove depth=2 WN=16 WD=16 F=0 R=2
// proof 8by8R4 mode=prove depth=2 WN=8 WD=8 F=0 R=4
// proof 6by10F3R2 mode=prove depth=2 WN=6 WD=10 F=3 R=2
// proof 24by16F8 mode=prove depth=2 WN=24 WD=16 F=8 R=1
module divide_iter_props #(parameter WN = 16, WD = 16, F = 0, R = 1) (
    input clk, rst, in_valid, out_ready, input [WN-1:0] in_n, input [WD-1:0] in_d
);
    localparam N = WN + F, M = (N - 1) / R, H = N - M * R;
    wire in_ready, out_valid, arrived, live, out_div_by_zero;
    wire [N-1:0] out_q;
    wire [WD-1:0] out_r;
    wire [7:0] accepted, delivered, index;
    wire [WN+WD-1:0] token;
    divide #(.MODE(0), .WN(WN), .WD(WD), .F(F), .R(R)) dut (.*);
    stream_token #(.WI(WN+WD), .WO(N+WD+1)) stream (
        .in_data({in_n, in_d}), .out_data({out_q, out_r, out_div_by_zero}), .*);
    (* hierconn *) wire [R*M-1:0] \dut.g_iterative.todo ;
    (* hierconn *) wire [M-1:0] \dut.g_iterative.step ;
    (* hierconn *) wire \dut.g_iterative.busy ;
    (* hierconn *) wire [WD-1:0] \dut.g_iterative.d ;
    (* hierconn *) wire [H-1:0] \dut.head_q ;
    (* hierconn *) wire [R-1:0] \dut.g_iterative.next_q ;

    wire accept = in_valid && in_ready;
    wire [N-1:0] n = token[WN+WD-1:WD] << F;
    wire [WD-1:0] d = token[WD-1:0];
    reg [7:0] age;  // clocks since the accepting edge, until the result is there
    reg [N+WD-1:0] product;  // quotient so far times d
    wire [N+WD-1:0] first, grown;
    grow_product #(.N(N), .WD(WD), .R(H)) head (.product(0), .d(in_d), .digits(\dut.head_q ), .grown(first));
    grow_product #(.N(N), .WD(WD), .R(R)) step (.product(product), .d(\dut.g_iterative.d ), .digits(\dut.g_iterative.next_q ), .grown(grown));
    always @(posedge clk) begin
        age <= accept ? 1 : age + \dut.g_iterative.busy ;
        product <= accept ? first : \dut.g_iterative.busy ? grown : product;
    end

    wire flight = accepted != delivered;
    wire here = flight && delivered == index;
    always @* if (live) begin
        assert (8'(accepted - delivered) <= 1);
        assert (\dut.g_iterative.busy == (flight && !out_valid));
        assert (in_ready == (!flight || (out_valid && out_ready)));
        assert (\dut.g_iterative.step == (\dut.g_iterative.busy ? 1 << (M - age) : 0));
        if (\dut.g_iterative.busy ) assert (age >= 1 && age <= M);
        if (out_valid) assert (age == M + 1);  // the latency
        if (here) assert (\dut.g_iterative.d == d && out_div_by_zero == (d == 0));
        if (here && d != 0) assert (out_r < d);
        if (arrived && d != 0) assert (product + out_r == n);
        if (arrived && d == 0) assert (&out_q && out_r == {{WD{1'b0}}, n} % (1 << WD));
    end

    genvar a;
    for (a = 1; a <= M + 1; a = a + 1) begin : g_age
        localparam K = H + (a - 1) * R;
        wire [K+WD-1:0] prefix = n[N-1 -: K];
        always @* if (live && here && age == a) begin
            if (d == 0) assert (&out_q[K-1:0] && out_r == prefix[WD-1:0]);
            else assert (product + out_r == prefix);
            assert (out_q >> K == 0);
            if (K < WD) assert (out_r >> K == 0);
            if (a <= M) assert (\dut.g_iterative.todo [R*M-1 -: R] == n[N-K-1 -: R]);
        end
    end
    if (M > 1) always @* if (live && here) assert (\dut.g_iterative.todo [R*(M-1)-1:0] == n[R*(M-1)-1:0]);
endmodule

// n * 2^F = q d + r, 0 <= r < d, in order, once for each word, whatever the stalls.
// Invariant: the followed word, wherever it is, carries the quotient of the leading K bits of its own numerator.
// rtl: divide divide_digits
// with: stream_token.sv
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

// The product of a quotient and d as the quotient's digits arrive: (2 quotient + q) d = 2 (quotient d) + q d.
module grow_product #(parameter N = 8, WD = 8, R = 1) (
    input [N+WD-1:0] product, input [WD-1:0] d, input [R-1:0] digits, output reg [N+WD-1:0] grown
);
    integer i;
    always @* begin
        grown = product;
        for (i = R - 1; i >= 0; i = i - 1) grown = 2 * grown + (digits[i] ? d : 0);
    end
endmodule
