// d * 4^F = root^2 + rem, rem <= 2 root, in order, once for each word, whatever the stalls.
// Invariant: the followed word, wherever it is, carries the root of the leading 2 K bits of its own radicand.
// rtl: isqrt isqrt_comb isqrt_digits
// with: stream_token.sv grow_square.sv
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
            always @* if (live && mine) assert (todo == d[2*(N-K)-1:0]);
        end
    end
    always @* if (live && arrived) assert (\dut.g_pipelined.g_stage [M].square + out_rem == d && out_rem <= {out_root, 1'b0});
endmodule
