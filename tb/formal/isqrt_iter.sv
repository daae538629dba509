// d * 4^F = root^2 + rem, rem <= 2 root, in order, once for each word, after exactly ceil(N / R) clocks.
// Invariant: after `age` clocks the same holds of the leading 2 K radicand bits, and `todo` has the next pairs.
// rtl: isqrt isqrt_comb isqrt_digits
// with: stream_token.sv grow_square.sv
// proof W16 mode=prove depth=2 W=16 F=0 R=1
// proof W16R2 mode=prove depth=2 W=16 F=0 R=2
// proof W16R4 mode=prove depth=2 W=16 F=0 R=4
// proof W15F1R2 mode=prove depth=2 W=15 F=1 R=2
// proof W24F4 mode=prove depth=2 W=24 F=4 R=1
// proof W32 mode=prove depth=2 W=32 F=0 R=1
module isqrt_iter_props #(parameter W = 16, F = 0, R = 1) (
    input clk, rst, in_valid, out_ready, input [W-1:0] in_d
);
    localparam N = (W + 1) / 2 + F, M = (N - 1) / R, H = N - M * R;
    wire in_ready, out_valid, arrived, live;
    wire [N-1:0] out_root;
    wire [N:0] out_rem;
    wire [7:0] accepted, delivered, index;
    wire [W-1:0] token;
    isqrt #(.MODE(0), .W(W), .F(F), .R(R)) dut (.*);
    stream_token #(.WI(W), .WO(2*N+1)) stream (.in_data(in_d), .out_data({out_root, out_rem}), .*);
    (* hierconn *) wire [2*R*M-1:0] \dut.g_iterative.todo ;
    (* hierconn *) wire [M-1:0] \dut.g_iterative.step ;
    (* hierconn *) wire \dut.g_iterative.busy ;
    (* hierconn *) wire [H-1:0] \dut.head_root ;
    (* hierconn *) wire [N-1:0] \dut.g_iterative.next_root ;

    wire accept = in_valid && in_ready;
    wire [2*N-1:0] d = token << 2 * F;
    reg [7:0] age;  // clocks since the accepting edge, until the result is there
    reg [2*N-1:0] square;  // of the root so far
    wire [2*N-1:0] first, grown;
    grow_square #(.N(N), .R(H)) head (.square(0), .root(0), .digits(\dut.head_root ), .grown(first));
    grow_square #(.N(N), .R(R)) step (
        .square(square), .root(out_root), .digits(\dut.g_iterative.next_root [R-1:0]), .grown(grown));
    always @(posedge clk) begin
        age <= accept ? 1 : age + \dut.g_iterative.busy ;
        square <= accept ? first : \dut.g_iterative.busy ? grown : square;
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
        if (here) assert (out_rem <= {out_root, 1'b0});
        if (arrived) assert (square + out_rem == d);
    end

    genvar a;
    for (a = 1; a <= M + 1; a = a + 1) begin : g_age
        localparam K = H + (a - 1) * R;
        always @* if (live && here && age == a) begin
            assert (square + out_rem == d[2*N-1 -: 2*K]);
            assert (out_root >> K == 0);
            if (a <= M) assert (\dut.g_iterative.todo [2*R*M-1 -: 2*R] == d[2*(N-K)-1 -: 2*R]);
        end
    end
    if (M > 1) always @* if (live && here) assert (\dut.g_iterative.todo [2*R*(M-1)-1:0] == d[2*R*(M-1)-1:0]);
endmodule
