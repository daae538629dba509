// root^2 <= d * 4^F < (root + 1)^2 and the remainder is exact, by multiplication, nothing assumed.
// rtl: isqrt_comb isqrt_digits
// proof W16 mode=prove depth=1 W=16 F=0
// proof W15F1 mode=prove depth=1 W=15 F=1
module isqrt_comb_props #(parameter W = 16, F = 0) (input clk, input [W-1:0] in_d);
    localparam N = (W + 1) / 2 + F;
    wire [N-1:0] root;
    wire [N:0] rem;
    isqrt_comb #(.W(W), .F(F)) dut (.in_d(in_d), .out_root(root), .out_rem(rem));
    wire [2*N+1:0] d = in_d << 2 * F;
    wire [2*N+1:0] square = root * root;
    always @* begin
        assert (square <= d);
        assert (d - square == rem);
        assert (rem <= {root, 1'b0});  // the same as d < (root + 1)^2
    end
endmodule

// One digit keeps 0 <= rem <= 2 root and adds exactly what the square grows by:
//   4 rem + pair = out_rem + ((2 root + q)^2 - 4 root^2), q the new digit, the bracket being q (4 root + 1).
// So radicand = root^2 + rem follows for any number of digits: by induction, and by the identity asserted last.
// rtl: isqrt_digits
// proof digits_1_to_32 mode=prove depth=1 N=32
module isqrt_digits_props #(parameter N = 16) (input clk);
    genvar k;
    for (k = 1; k <= N; k = k + 1) begin : g_row
        (* anyseq *) reg [k:0] rem;
        (* anyseq *) reg [k-1:0] root;
        (* anyseq *) reg [1:0] pair;
        wire [k+1:0] out_rem;
        wire [k:0] out_root;
        wire q = out_root[0];
        isqrt_digits #(.K(k), .R(1)) dut (.in_rem(rem), .in_root(root), .in_pairs(pair ^ 2'b01), .out_rem(out_rem),
            .out_root(out_root));
        wire [k+3:0] grows = q ? {root, 2'b01} : 0;
        always @* begin
            assume (rem <= {root, 1'b0});
            assert (out_root[k:1] == root);
            assert ({1'b0, rem, pair} == {2'b0, out_rem} + grows);
            assert (out_rem <= {out_root, 1'b0});
        end
    end
    (* anyseq *) reg [7:0] r;
    (* anyseq *) reg q;
    wire [17:0] square = r * r;
    wire [17:0] grown = {r, q} * {r, q};
    always @* assert (grown == {square, 2'b00} + (q ? {r, 2'b01} : 0));
endmodule

// d * 4^F = root^2 + rem, rem <= 2 root, in order, once for each word, after exactly ceil(N / R) clocks.
// Invariant: after `age` clocks the same holds of the leading 2 K radicand bits, and `todo` has the next pairs, the
// lower bit of each inverted.
// rtl: isqrt isqrt_comb isqrt_digits
// with: stream_token.sv
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
            if (a <= M) assert (\dut.g_iterative.todo [2*R*M-1 -: 2*R] == (d[2*(N-K)-1 -: 2*R] ^ {R{2'b01}}));
        end
    end
    if (M > 1) always @* if (live && here)
        assert (\dut.g_iterative.todo [2*R*(M-1)-1:0] == (d[2*R*(M-1)-1:0] ^ {(R*(M-1)){2'b01}}));
endmodule

// d * 4^F = root^2 + rem, rem <= 2 root, in order, once for each word, whatever the stalls.
// Invariant: the followed word, wherever it is, carries the root of the leading 2 K bits of its own radicand.
// rtl: isqrt isqrt_comb isqrt_digits
// with: stream_token.sv
// proof W16 mode=prove depth=2 W=16 F=0 R=1
// proof W15F1R2 mode=prove depth=2 W=15 F=1 R=2
// proof W24R2 mode=prove depth=2 W=24 F=0 R=2
module isqrt_pipe_props #(parameter W = 16, F = 0, R = 1) (
    input clk, rst, in_valid, out_ready, input [W-1:0] in_d
);
    localparam N = (W + 1) / 2 + F, M = (N - 1) / R, H = N - M * R;
    wire in_ready, out_valid, arrived, live;
    wire [N-1:0] out_root;
    wire [N:0] out_rem;
    wire [7:0] accepted, delivered, index;
    wire [W-1:0] token;
    isqrt #(.MODE(1), .W(W), .F(F), .R(R)) dut (.*);
    stream_token #(.WI(W), .WO(2*N+1)) stream (.in_data(in_d), .out_data({out_root, out_rem}), .*);
    (* hierconn *) wire [M:0] \dut.g_pipelined.valid ;

    wire [2*N-1:0] d = token << 2 * F;
    always @* if (live) begin
        assert (8'(accepted - delivered) == $countones(\dut.g_pipelined.valid ));
        assert (in_ready == (!out_valid || out_ready));
    end

    genvar s;
    for (s = 0; s <= M; s = s + 1) begin : \dut.g_pipelined.g_stage
        localparam K = H + s * R, L = s == 0 ? H : R;
        (* hierconn *) wire [K:0] rem;
        (* hierconn *) wire [K-1:0] root;
        (* hierconn *) wire [K-1:0] next_root;
        wire [M+1:0] ahead = {1'b0, \dut.g_pipelined.valid } >> (s + 1);
        wire mine = \dut.g_pipelined.valid [s] && 8'(delivered + $countones(ahead)) == index;
        reg [2*N-1:0] square;  // of this stage's root
        wire [2*N-1:0] before, grown;
        wire [N-1:0] known;
        if (s == 0) assign before = 0, known = 0;
        else assign before = \dut.g_pipelined.g_stage [s-1].square, known = \dut.g_pipelined.g_stage [s-1].root;
        grow_square #(.N(N), .R(L)) step (.square(before), .root(known), .digits(next_root[L-1:0]), .grown(grown));
        always @(posedge clk) if (in_ready) square <= grown;
        always @* if (live && mine) begin
            assert (square + rem == d[2*N-1 -: 2*K]);
            assert (rem <= {root, 1'b0});
        end
        if (s < M) begin : g_todo
            (* hierconn *) wire [2*(N-K)-1:0] todo;
            always @* if (live && mine) assert (todo == (d[2*(N-K)-1:0] ^ {(N-K){2'b01}}));
        end
    end
    always @* if (live && arrived) assert (\dut.g_pipelined.g_stage [M].square + out_rem == d && out_rem <= {out_root, 1'b0});
endmodule

// The square of a root as its digits arrive, without a multiplication: (2 root + q)^2 = 4 root^2 + q (4 root + 1).
module grow_square #(parameter N = 8, R = 1) (
    input [2*N-1:0] square, input [N-1:0] root, input [R-1:0] digits, output reg [2*N-1:0] grown
);
    reg [N-1:0] known;
    integer i;
    always @* begin
        grown = square;
        known = root;
        for (i = R - 1; i >= 0; i = i - 1) begin
            grown = 4 * grown + (digits[i] ? {known, 2'b01} : 0);
            known = {known, digits[i]};
        end
    end
endmodule
