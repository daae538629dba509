// n * 2^F = q d + r, 0 <= r < d, in order, once for each word, after exactly ceil((WN + F) / R) clocks.
// Invariant: after `age` clocks the same holds of the leading K numerator bits, and `todo` has the next bits.
// rtl: divide divide_digits
// with: stream_token.sv grow_product.sv
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
