// The contract where the latency varies, and an end whatever the memory holds: a command inside is at one clock of its
// kind, and a run has left its lines when it comes round to its own header. One clock of reset is enough, from any
// state; then every line is swept, so that no header of before is left.
// rtl: kinematics_engine engine_words
// proof N6 mode=prove depth=3 N=6 CONTEXTS=2 PIPE=0
// proof N10PIPE1 mode=prove depth=3 N=10 CONTEXTS=4 PIPE=1
// proof N10PIPE2 mode=prove depth=3 N=10 CONTEXTS=8 PIPE=2
module kinematics_engine_props #(parameter N = 6, CONTEXTS = 2, PIPE = 0) (
    input clk, rst, in_valid, out_ready, input [2:0] in_kind, input [$clog2(CONTEXTS)-1:0] in_context,
    input [N-1:0] in_at, input [47:0] in_data
);
    wire in_ready, out_valid, out_refused;
    wire [26:0] out_word;
    wire [31:0] out_version;
    wire [15:0] out_crc;
    wire [3:0]  out_status;
    kinematics_engine #(.N(N), .CONTEXTS(CONTEXTS), .PIPE(PIPE)) dut (.*);

    (* hierconn *) wire \dut.sweep ;
    (* hierconn *) wire \dut.busy ;
    (* hierconn *) wire \dut.begun ;
    (* hierconn *) wire \dut.entered ;
    (* hierconn *) wire \dut.live ;
    (* hierconn *) wire \dut.lap ;
    (* hierconn *) wire \dut.stored ;
    (* hierconn *) wire \dut.loading ;
    (* hierconn *) wire [2+PIPE:0] \dut.tail ;
    (* hierconn *) wire [2:0] \dut.kind ;
    (* hierconn *) wire [5:0] \dut.count ;
    (* hierconn *) wire [N-1:0] \dut.at ;
    (* hierconn *) wire [$clog2(CONTEXTS)-1:0] \dut.bank ;
    (* hierconn *) wire [5:0] \dut.a ;
    (* hierconn *) wire [4+PIPE:0] \dut.engine.flight ;
    (* hierconn *) wire [$clog2(CONTEXTS)+5:0] \dut.engine.asked ;
    (* hierconn *) wire [CONTEXTS-1:0] \dut.ran ;
    (* hierconn *) wire \dut.memory.mixed ;
    (* hierconn *) wire [49:0] \dut.memory.was ;
    (* hierconn *) wire [N-1:0] \dut.memory.asked ;
    (* hierconn *) wire [49:0] \dut.memory.kept ;
    (* hierconn *) wire [49:0] \dut.memory.in_line ;
    (* hierconn *) wire \dut.memory.in_store ;
    (* hierconn *) wire [N-1:0] \dut.memory.spot ;
    wire [N-1:0] spot = \dut.memory.spot , at = \dut.at ;
    wire [49:0]  kept = \dut.memory.kept ;
    wire [2:0]   kind = \dut.kind ;
    wire [2+PIPE:0] flight = \dut.engine.flight [2+PIPE:0];
    wire [1:0]   ending = \dut.engine.flight [4+PIPE:3+PIPE];  // register 0 changes once more, twice more

    reg  live, inside, waits, swept;
    reg  [83:0]  before;
    reg  [6:0]   age;      // clocks of a command inside
    reg  [N-1:0] start;    // where a run began
    reg  [N+1:0] played;   // lines of a run
    reg  [$clog2(CONTEXTS)-1:0] owner;
    wire take = in_valid && in_ready && !rst, give = out_valid && out_ready;
    wire [83:0] result = {out_word, out_version, out_crc, out_refused, out_status, out_valid};
    wire [3+PIPE:0] tail = \dut.tail ;
    initial {live, inside, waits} = 0;
    always @* if (!live) assume (rst);
    always @(posedge clk) begin
        live   <= 1;
        inside <= !rst && (take || inside && !give);
        waits  <= live && !rst && out_valid && !out_ready;
        before <= result;
        age    <= take ? 7'd0 : age == 7'd127 ? age : age + 7'd1;
        played <= \dut.entered ? 1 : \dut.live ? played + 1 : played;
        if (take) {start, owner} <= {in_at, in_context};
    end
    always @* if (live) begin
        // the contract
        assert (in_ready == (!\dut.sweep && (!inside || give)));
        if (\dut.sweep ) assert (!inside);
        if (out_valid) assert (inside);
        if (waits) assert (result == before);
        assert (\dut.busy == (inside && !out_valid));
        // a result is of words that stand: addresses of before, nothing written, no line on its way
        if (out_valid) assert (\dut.memory.asked == at && !\dut.memory.mixed && flight == 0
                               && \dut.engine.asked == {\dut.bank , \dut.a });
        if (!(\dut.busy && kind == 2)) assert (flight == 0);
        if (\dut.busy && age != 0 && kind[2]) assert (\dut.memory.asked == at);
        if (\dut.busy && kind == 2 && tail != 0) assert (\dut.memory.asked == at || tail[0]);
        if (\dut.busy && kind == 2 && !\dut.live )
            assert (tail != 0 ? (flight & tail - 1) == 0 : flight == 0);
        // meanwhile the result of a run is no register 0, and that of the next command is late enough
        if (tail >> 1 != 0 || out_valid && kind == 2 && ending != 0) assert (\dut.ran [owner]);
        if (out_valid && kind != 2 || \dut.entered || \dut.busy && kind[2] && !\dut.begun ) assert (ending == 0);
        if (!inside || \dut.begun ) assert (!ending[0]);
        // where a command is
        if (inside) assert (\dut.bank == owner);
        assert (\dut.begun == (\dut.busy && age == 0));
        if (\dut.busy && !kind[2] && kind != 2) assert (age == 0);
        if (\dut.busy && kind[2]) assert (age <= 66 && \dut.count == age[5:0] && \dut.lap == (age == 64)
                                          && \dut.stored == (age == 65) && age <= 65);
        else assert (!\dut.lap && !\dut.stored );
        if (!(\dut.busy && kind[2])) assert (\dut.count <= 2);
        // a run: header, lines, clocks behind them
        if (\dut.entered || \dut.live || tail != 0) assert (\dut.busy && kind == 2 && !\dut.begun );
        if (\dut.busy && kind == 2) assert (\dut.begun + \dut.entered + \dut.live + $countones(\dut.tail ) == 1);
        if (\dut.begun && inside && kind == 2) assert (at == start);
        if (\dut.entered ) assert (age == 1 && \dut.memory.asked == start && at == start + 1'b1);
        if (\dut.live ) assert (\dut.memory.asked == start + played[N-1:0] && at == start + played[N-1:0] + 1'b1);
        if (\dut.live && start == spot) assert (played >= 1 && played <= (1 << N) && kept[48]);
        if (!\dut.memory.mixed ) assert (\dut.memory.was == kept);
        if (\dut.entered || \dut.live ) assert (!\dut.memory.mixed );
        // nothing but LOAD, LINE and SEAL changes a line, and only headers are sealed
        if (\dut.memory.in_store && !\dut.sweep ) assert (\dut.busy && kind[2]);
        if (\dut.memory.in_store && \dut.memory.in_line [49]) assert (kind == 5 && \dut.memory.in_line [48]);
        if (\dut.sweep ) assert (kind == 0 && !\dut.busy  && !\dut.loading );  // a load ends with a reset
        if ((!\dut.sweep || at > spot) && kept[49]) assert (kept[48]);
    end
endmodule

// What the contract does not depend on: lines of any value. But the line at one place, any one, is what was stored
// there.
module engine_lines #(parameter N = 10) (
    input clk, input [N-1:0] in_at, input in_store, input [49:0] in_line, output [49:0] out_line
);
    (* anyconst *) wire [N-1:0] spot;
    (* anyseq *) wire [49:0] any;
    reg [N-1:0] asked;
    reg [49:0]  kept, was, last;
    reg         mixed, same;
    initial same = 0;
    always @(posedge clk) begin
        asked <= in_at;
        mixed <= in_store;
        was   <= kept;
        last  <= out_line;
        same  <= in_at == asked && !in_store && !mixed;
        if (in_store && in_at == spot) kept <= in_line;
    end
    assign out_line = asked == spot && !mixed ? was : any;
    always @* if (same) assume (out_line == last);
endmodule

// Words and flags of any value, the same as long as nothing is played
module engine_datapath #(parameter PIPE = 0, ROOTS = 1, WRIST = 12, SLACK = 13, MARGINS = 0, CONTEXTS = 1, B = 1) (
    input clk, rst, in_start, in_run, in_live, input [B-1:0] in_context, input in_forget, input [46:0] in_op,
    input [26:0] in_port, input [2:0] in_signs, output [26:0] out_read, out_word, output [5:0] out_dest,
    output [3:0] out_status
);
    (* anyseq *) wire [26:0] read, word;
    (* anyseq *) wire [5:0] dest;
    (* anyseq *) wire [3:0] status;
    reg [4+PIPE:0] flight;  // lines whose word or flag is to come, and two that then write register 0
    reg [B+5:0] asked;
    reg [26:0] read_before;
    reg [3:0] status_before;
    reg same, still;
    initial {same, still} = 0;
    always @(posedge clk) begin
        flight <= rst ? 0 : {flight, in_live};
        asked <= {in_context, in_op[44:39]};
        same <= asked == {in_context, in_op[44:39]} && (asked[5:0] == 0 ? flight : flight[2+PIPE:0]) == 0 && !in_live;
        still <= !in_start && flight[2+PIPE:0] == 0 && !in_live;
        {read_before, status_before} <= {out_read, out_status};
    end
    assign {out_read, out_word, out_dest, out_status} = {read, word, dest, status};
    always @* if (same) assume (read == read_before);
    always @* if (still) assume (status == status_before);
endmodule
