// The contract where the latency varies (one_inside.sv), and an end: a sample inside that solves is at one place of a
// loop over its links, which are counted up to n, and its tail; at most cfg_limit passes count, and no two in a row do
// not. One clock of reset is enough, from any state.
// rtl: engine_quaternion_gd_plane engine_gd_plane_program schedule
// with: one_inside.sv
// proof W16N8 mode=prove depth=2 W=16 F=8 A=24 N=8 PIPE=0
// proof PIPE1 mode=prove depth=2 W=16 F=8 A=24 N=8 PIPE=1
// proof W14N3 mode=prove depth=2 W=14 F=6 A=20 N=3 PIPE=0
// proof PIPE1W14N3 mode=prove depth=2 W=14 F=6 A=20 N=3 PIPE=1
module engine_quaternion_gd_plane_props #(parameter W = 16, F = 8, A = 24, N = 8, PIPE = 0) (
    input clk, rst, in_valid, out_ready, input [1:0] cfg_shift, in_op, input [7:0] in_n, input [W-1:0] in_x, in_y,
    input [W:0] cfg_alpha, input [21:0] cfg_tol, input [9:0] cfg_limit, input [A-1:0] in_j
);
    wire in_ready, out_valid, out_coarse;
    wire [A-1:0] out_j;
    wire [9:0] out_iters;
    wire [2*W-1:0] out_error;
    wire [3:0] out_status;
    engine_quaternion_gd_plane #(.W(W), .F(F), .A(A), .N(N), .PIPE(PIPE)) dut (.*);

    wire live, inside;
    localparam LINKS = PIPE == 0 ? 7 : 9, TAIL = PIPE == 0 ? 8 : 12;

    (* hierconn *) wire [LINKS-1:0] \dut.program_.links.step ;
    (* hierconn *) wire [TAIL-1:0] \dut.program_.tail.step ;
    (* hierconn *) wire \dut.check ;
    (* hierconn *) wire \dut.answer ;
    (* hierconn *) wire \dut.busy ;
    (* hierconn *) wire \dut.still ;
    (* hierconn *) wire \dut.fine ;
    (* hierconn *) wire \dut.big ;
    (* hierconn *) wire [5:0] \dut.link ;
    (* hierconn *) wire [5:0] \dut.loaded ;
    (* hierconn *) wire [7:0] \dut.n ;
    wire [8:0]  links = \dut.program_.links.step ;
    wire [11:0] tail = \dut.program_.tail.step ;
    wire [5:0] link = \dut.link , loaded = \dut.loaded ;
    wire [7:0] n = \dut.n ;
    // Lines of the last link beside the tail, and of link 1 beside its two last lines; of the link before the last one
    reg  [8:0] with_tail, with_earlier;
    always @* begin
        with_tail = tail[TAIL-2] ? 9'h001 : tail[TAIL-1] ? 9'h002 : tail[LINKS-4:0] << 3;
        with_earlier = tail[LINKS-7:0] << 6;
    end
    wire begun = links == 9'h001 || links == 9'h002 || links == 9'h004 || links == 9'h009 || links == 9'h012
              || links == 9'h024 || links == 9'h049;
    wire body = tail == 0 && (begun || PIPE == 1 && (links == 9'h092 || links == 9'h124));
    wire turn = tail != 0 && (tail & tail - 1) == 0 && (links == with_tail || links == (with_tail | with_earlier));
    wire solves = body || turn;
    wire ends = tail[TAIL-1] || tail[TAIL-2];          // the pass ends: link 1 of the next one has begun
    wire first = ends || tail == 0 && links[8:3] == 0; // link 1 is played alone

    wire [A+2*W+14:0] result = {out_j, out_iters, out_error, out_coarse, out_status};
    wire [33:0] cfg = {cfg_shift, cfg_limit, cfg_tol};
    one_inside #(.WO(A+2*W+15), .WC(34)) rules (.*);
    always @* if (live) begin
        assert (\dut.busy == (inside && !out_valid));
        assert (\dut.busy == (\dut.check || \dut.answer || solves));
        assert (\dut.check + \dut.answer + solves < 2);
        if (!solves) assert (links == 0 && tail == 0);
        // links are counted from 1 to n
        assert (loaded <= N);
        if (solves) assert (n != 0 && n <= loaded);
        if (solves && (body || ends)) assert (link != 0 && link <= n && (link == 1) == first);
        if (tail[TAIL-3:2] != 0) assert (link == 0);
        // an end
        if (inside) assert (out_iters <= cfg_limit);
        if (tail[TAIL-1:PIPE == 0 ? 4 : 6] != 0 && \dut.still ) assert (\dut.fine && \dut.big );
    end
endmodule

// What the contract of engine_quaternion_gd_plane does not depend on: joints, steps and errors of any value. Joint and
// square stand where no line of the tables changes them.
module engine_gd_joints #(parameter W = 16, A = 24, K = 17, T = 10, I = 6) (
    input clk, in_take, input [A-1:0] in_j, input [I-1:0] in_link, input [W-1:0] in_length, input in_load, in_set,
    in_read, in_step, in_next, in_place, in_base, input [A-1:0] in_move, output reg [A-1:0] out_j,
    output [W-1:0] out_length, output [2*K-T+19:0] out_chord
);
    (* anyseq *) wire [A-1:0] joint;
    (* anyseq *) wire [2*K-T+19:0] chord;
    assign {out_length, out_chord} = {{W{1'b0}}, chord};
    always @(posedge clk) if (in_read) out_j <= joint;
endmodule

module engine_gd_plane_path #(parameter W = 16, A = 24, N = 8, K = 17, T = 10, I = 6, PIPE = 0) (
    input clk, input [W:0] cfg_alpha, input [1:0] in_shift, input in_fine, in_still, in_clear, input [8:0] in_op,
    input in_first, in_read, input [I-1:0] in_link, input in_store, in_begin, input [2*K-T+19:0] in_chord,
    input [W-1:0] in_length, in_x, in_y, output out_fits, output [A-1:0] out_move, output reg [2*W-1:0] out_square
);
    (* anyseq *) wire fits;
    (* anyseq *) wire [A-1:0] move;
    (* anyseq *) wire [2*W-1:0] square;
    assign {out_fits, out_move} = {fits, move};
    always @(posedge clk) if (in_clear || in_op[4] || in_op[3]) out_square <= in_clear ? 0 : square;
endmodule
