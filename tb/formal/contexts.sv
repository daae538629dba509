// Contexts cannot meet. Two copies of the core get the same commands at the same clocks, but the words, signs and
// forgetting of the commands to all contexts but one, `mine`, are any. The answers to the commands of that context are
// the same, and so is when every answer comes and what it says of programs. A reset may come at any clock.
// Both copies power up alike. Memories and products are cut; what they give is the same for both copies where all that
// it follows from is: that is asserted of every write.
// rtl: kinematics_engine engine_datapath engine_roots
// proof PIPE0 mode=prove depth=2 N=6 CONTEXTS=2 PIPE=0
// proof PIPE1 mode=prove depth=2 N=6 CONTEXTS=4 PIPE=1
// proof PIPE2 mode=prove depth=2 N=6 CONTEXTS=8 PIPE=2
module contexts_props #(parameter N = 6, CONTEXTS = 2, PIPE = 0) (
    input clk, rst, in_valid, out_ready, input [2:0] in_kind, input [$clog2(CONTEXTS)-1:0] in_context,
    input [N-1:0] in_at, input [47:0] l_data, r_data
);
    localparam B = $clog2(CONTEXTS), CLEAN = 4 + PIPE;  // clocks without a line, until none is left
    localparam [46:0] NOTHING = 47'h2044_0000_0000;
    (* anyconst *) wire [B-1:0] mine;
    wire        l_ready, r_ready, l_valid, r_valid, l_refused, r_refused;
    wire [26:0] l_word, r_word;
    wire [31:0] l_version, r_version;
    wire [15:0] l_crc, r_crc;
    wire [3:0]  l_status, r_status;
    kinematics_engine #(.N(N), .CONTEXTS(CONTEXTS), .PIPE(PIPE)) l (.in_data(l_data), .in_ready(l_ready),
        .out_valid(l_valid), .out_word(l_word), .out_version(l_version), .out_crc(l_crc), .out_refused(l_refused),
        .out_status(l_status), .*);
    kinematics_engine #(.N(N), .CONTEXTS(CONTEXTS), .PIPE(PIPE)) r (.in_data(r_data), .in_ready(r_ready),
        .out_valid(r_valid), .out_word(r_word), .out_version(r_version), .out_crc(r_crc), .out_refused(r_refused),
        .out_status(r_status), .*);
    always @* assume (l_data == r_data || in_context != mine && (in_kind == 0 || in_kind == 2));

    (* hierconn *) wire \l.sweep , \r.sweep , \l.busy , \r.busy , \l.begun , \r.begun , \l.entered , \r.entered ,
        \l.live , \r.live , \l.loading , \r.loading , \l.lap , \r.lap , \l.stored , \r.stored , \l.match , \r.match ,
        \l.bad , \r.bad ;
    (* hierconn *) wire [2+PIPE:0] \l.tail , \r.tail ;
    (* hierconn *) wire [2:0] \l.kind , \r.kind ;
    (* hierconn *) wire [5:0] \l.count , \r.count ;
    (* hierconn *) wire [15:0] \l.crc , \r.crc ;
    (* hierconn *) wire [11:0] \l.one , \r.one ;
    (* hierconn *) wire [N-1:0] \l.at , \r.at ;
    (* hierconn *) wire [B-1:0] \l.bank , \r.bank ;
    (* hierconn *) wire [CONTEXTS-1:0] \l.ran , \r.ran ;
    (* hierconn *) wire [47:0] \l.data , \r.data ;
    (* hierconn *) wire [49:0] \l.memory.out_line , \r.memory.out_line , \l.memory.in_line , \r.memory.in_line ;
    (* hierconn *) wire \l.memory.in_store , \r.memory.in_store , \l.words.in_store , \r.words.in_store ;
    (* hierconn *) wire [26:0] \l.words.out_word , \r.words.out_word , \l.words.in_word , \r.words.in_word ;
    (* hierconn *) wire [B+5:0] \l.words.asked , \r.words.asked , \l.words.in_at , \r.words.in_at ,
        \l.engine.file.in_at , \r.engine.file.in_at ;
    (* hierconn *) wire [107:0] \l.engine.file.any , \r.engine.file.any ;
    (* hierconn *) wire [4*B+23:0] \l.engine.file.asked , \r.engine.file.asked ;
    (* hierconn *) wire \l.engine.file.in_write , \r.engine.file.in_write ;
    (* hierconn *) wire [26:0] \l.engine.file.in_word , \r.engine.file.in_word , \l.engine.a , \r.engine.a ,
        \l.engine.b , \r.engine.b , \l.engine.c , \r.engine.c , \l.engine.d , \r.engine.d , \l.engine.out_word ,
        \r.engine.out_word ;
    (* hierconn *) wire [46:0] \l.engine.chosen , \r.engine.chosen ;
    (* hierconn *) wire [19*PIPE+18:0] \l.engine.ops , \r.engine.ops ;
    (* hierconn *) wire [PIPE:0] \l.engine.skips , \r.engine.skips ;
    (* hierconn *) wire [31:0] \l.engine.kept , \r.engine.kept ;
    (* hierconn *) wire [3:0] \l.engine.newer , \r.engine.newer ;
    (* hierconn *) wire [107:0] \l.engine.products.now , \r.engine.products.now , \l.engine.products.late ,
        \r.engine.products.late ;
    (* hierconn *) wire \l.engine.g_roots.long , \r.engine.g_roots.long , \l.engine.g_roots.below ,
        \r.engine.g_roots.below , \l.engine.g_roots.sign , \r.engine.g_roots.sign , \l.engine.g_roots.unknown ,
        \r.engine.g_roots.unknown , \l.engine.g_roots.check , \r.engine.g_roots.check , \l.engine.g_roots.beyond ,
        \r.engine.g_roots.beyond , \l.engine.g_roots.off , \r.engine.g_roots.off , \l.engine.g_roots.one ,
        \r.engine.g_roots.one ;
    (* hierconn *) wire [3:1] \l.engine.g_roots.held , \r.engine.g_roots.held ;
    (* hierconn *) wire [25:0] \l.engine.g_roots.roots.seen , \r.engine.g_roots.roots.seen ;
    (* hierconn *) wire [20:0] \l.engine.g_roots.roots.out_w , \r.engine.g_roots.roots.out_w ;
    (* hierconn *) wire [19:0] \l.engine.g_roots.roots.out_slope , \r.engine.g_roots.roots.out_slope ,
        \l.engine.g_roots.roots.reciprocal.any , \r.engine.g_roots.roots.reciprocal.any ,
        \l.engine.g_roots.roots.in_q , \r.engine.g_roots.roots.in_q ;

    // control is the same at every clock; flags and words of the engine are where this context is served
    wire control = {l_valid, \l.sweep , \l.busy , \l.begun , \l.entered , \l.live , \l.loading , \l.lap , \l.stored ,
            \l.match , \l.bad , \l.tail , \l.kind , \l.count , \l.crc , \l.one , \l.at , \l.bank , \l.ran }
        == {r_valid, \r.sweep , \r.busy , \r.begun , \r.entered , \r.live , \r.loading , \r.lap , \r.stored , \r.match ,
            \r.bad , \r.tail , \r.kind , \r.count , \r.crc , \r.one , \r.at , \r.bank , \r.ran };
    wire flags = {\l.engine.g_roots.long , \l.engine.g_roots.below , \l.engine.g_roots.sign ,
            \l.engine.g_roots.unknown , \l.engine.g_roots.check , \l.engine.g_roots.beyond , \l.engine.g_roots.off ,
            \l.engine.g_roots.one , \l.engine.g_roots.held , \l.engine.g_roots.roots.seen }
        == {\r.engine.g_roots.long , \r.engine.g_roots.below , \r.engine.g_roots.sign , \r.engine.g_roots.unknown ,
            \r.engine.g_roots.check , \r.engine.g_roots.beyond , \r.engine.g_roots.off , \r.engine.g_roots.one ,
            \r.engine.g_roots.held , \r.engine.g_roots.roots.seen };
    wire stages = {\l.engine.b , \l.engine.c , \l.engine.d , \l.engine.kept , \l.engine.out_word , \l.engine.skips ,
            \l.engine.newer , \l.engine.products.late }
        == {\r.engine.b , \r.engine.c , \r.engine.d , \r.engine.kept , \r.engine.out_word , \r.engine.skips ,
            \r.engine.newer , \r.engine.products.late };
    wire factors = {\l.engine.g_roots.roots.out_w , \l.engine.g_roots.roots.out_slope }
        == {\r.engine.g_roots.roots.out_w , \r.engine.g_roots.roots.out_slope };
    (* hierconn *) wire [31:0] \l.engine.sum , \r.engine.sum ;
    (* hierconn *) wire \l.engine.outside , \r.engine.outside , \l.engine.minus1 , \r.engine.minus1 ;
    (* hierconn *) wire \l.engine.g_roots.ask , \r.engine.g_roots.ask ;
    (* hierconn *) wire [19:0] \l.engine.g_roots.q , \r.engine.g_roots.q ;
    wire asks = \l.engine.g_roots.ask ;
    wire asked = {asks, \l.engine.g_roots.q } == {\r.engine.g_roots.ask , \r.engine.g_roots.q };
    wire aligned = {\l.engine.sum , \l.engine.outside , \l.engine.minus1 }
        == {\r.engine.sum , \r.engine.outside , \r.engine.minus1 };
    wire empty = \l.engine.sum  == \l.engine.kept  && \r.engine.sum  == \r.engine.kept ;
    wire writes = {\l.engine.file.in_write , \l.engine.file.in_at , \l.engine.file.in_word }
        == {\r.engine.file.in_write , \r.engine.file.in_at , \r.engine.file.in_word };

    reg        started;  // a reset has come
    reg        aged, old;   // a command has come a clock before this one, or earlier; two clocks
    reg        nought, nought_before;  // register 0 of this context is 0
    reg        hit;      // the sweep has written it
    reg        ran;      // a run of this context has ended since the last reset
    (* hierconn *) wire \l.engine.in_forget ;
    (* hierconn *) wire [46:0] \l.engine.in_op ;
    wire [B-1:0] wait0 = mine + 1'b1 - CLEAN[B-1:0];
    reg        same, same_before;  // register 0 of this context; between programs lines that do nothing write 0 there
    reg [3:0]  quiet;    // clocks since the last line or reset
    reg [6:0]  age;      // clocks since the last command has come
    wire take = in_valid && l_ready && !rst, me = \l.bank  == mine;
    wire served = aged && me;
    initial {started, aged, old, same, same_before, nought, nought_before} = 7'b0001100;
    always @(posedge clk) begin
        started     <= 1;
        aged        <= !rst && (\l.begun || aged && !take);
        old         <= !rst && aged && !take;
        same_before <= same;
        age         <= take ? 7'd0 : age == 7'd127 ? age : age + 7'd1;
        quiet       <= rst || \l.live ? 4'd0 : quiet == 4'd15 ? quiet : quiet + 4'd1;
        if ((\l.engine.file.in_write && \l.engine.file.in_at == {mine, 6'd0})
            || (\r.engine.file.in_write && \r.engine.file.in_at == {mine, 6'd0}))
            {same, nought} <= {writes, writes && \l.engine.file.in_write && \l.engine.file.in_word == 0};
        nought_before <= nought;
        ran           <= !rst && (ran || me && \l.tail [0]);
        hit           <= !rst && (hit || \l.sweep && \l.bank == mine && quiet >= CLEAN);
    end

    // they power up alike
    always @* if (!started) assume (rst && control && writes && \l.data == \r.data );
    // memories that hold the same give the same: program lines, words of ports, registers
    always @* begin
        assume (\l.memory.out_line == \r.memory.out_line );
        if (\l.words.asked == \r.words.asked && \l.words.asked [B+5:6] == mine)
            assume (\l.words.out_word == \r.words.out_word );
        if ({\l.engine.a , \l.engine.b } == {\r.engine.a , \r.engine.b })
            assume (\l.engine.products.now [107:54] == \r.engine.products.now [107:54]);
        if ({\l.engine.c , \l.engine.d } == {\r.engine.c , \r.engine.d })
            assume (\l.engine.products.now [53:0] == \r.engine.products.now [53:0]);
        if (\l.engine.g_roots.roots.in_q == \r.engine.g_roots.roots.in_q )
            assume (\l.engine.g_roots.roots.reciprocal.any == \r.engine.g_roots.roots.reciprocal.any );
    end
    genvar i;
    generate
        for (i = 0; i < 4; i = i + 1) begin : g_read
            wire [B+5:0] at = \l.engine.file.asked [i*(B+6) +: B+6];
            always @* if (at == \r.engine.file.asked [i*(B+6) +: B+6] && at[B+5:6] == mine
                          && (at[5:0] != 0 || same_before))
                assume (\l.engine.file.any [27*i +: 27] == \r.engine.file.any [27*i +: 27]);
        end
        for (i = 0; i <= PIPE; i = i + 1) begin : g_idle  // lines that do nothing go through
            always @* if (started && quiet >= 2 + PIPE - i)
                assert ({\l.engine.ops [19*i +: 19], \l.engine.skips [i], \r.engine.skips [i]} == 0);
        end
    endgenerate

    always @* if (started) begin
        // what the user sees
        assert ({l_ready, l_valid} == {r_ready, r_valid});
        if (l_valid) assert ({l_version, l_crc, l_refused} == {r_version, r_crc, r_refused});
        if (l_valid && me) assert ({l_word, l_status} == {r_word, r_status});
        // what is written to memories
        assert (\l.memory.in_store == \r.memory.in_store );
        if (\l.memory.in_store ) assert (\l.memory.in_line == \r.memory.in_line );
        assert ({\l.words.in_store , \l.words.in_at } == {\r.words.in_store , \r.words.in_at });
        if (\l.words.in_store && me) assert (\l.words.in_word == \r.words.in_word );
        assert ({\l.engine.file.in_at [B+5:6], \r.engine.file.in_at [B+5:6]} == {\l.bank , \r.bank });
        if (me && {\l.engine.file.in_at [5:0], \r.engine.file.in_at [5:0]} != 0) assert (writes);
        assert ({\l.words.asked [5:0], \l.engine.file.asked [B+5:0]}
                == {\r.words.asked [5:0], \r.engine.file.asked [B+5:0]} || !aged);
        // why: control
        assert (control && {\l.engine.chosen , \l.engine.ops } == {\r.engine.chosen , \r.engine.ops });
        if (me || \l.kind != 0 && \l.kind != 2) assert (\l.data == \r.data );
        if (\l.loading ) assert (\l.kind [2]);
        if (\l.sweep ) assert (!\l.busy && !l_valid && (\l.at == 0 || \l.bank == \l.at [B-1:0] - 1'b1) && \l.kind == 0 && \l.data == 0 && !aged
                                && \l.engine.ops == 0 && quiet == (\l.at > 15 ? 15 : \l.at ));
        if (\l.begun || \l.entered || \l.live || \l.tail != 0) assert (\l.busy && !\l.sweep );
        if (\l.entered || \l.live || \l.tail != 0) assert (\l.kind == 2);
        if (\l.busy && \l.kind == 2) assert (\l.begun + \l.entered + \l.live + $countones(\l.tail ) == 1);
        if (\l.busy && \l.kind [2]) assert (age <= 65 && {\l.lap , \l.stored } == {age == 64, age == 65}
                                             && \l.count == age[5:0]);
        else assert (!\l.lap && !\l.stored && \l.count <= 2);
        if (\l.busy && !\l.kind [2] && \l.kind != 2) assert (\l.begun );
        if (l_valid) assert (aged && !\l.busy );
        if (\l.busy ) assert (aged == !\l.begun );
        if (aged) assert (!\l.begun );
        if (old) assert (aged);
        if (\l.live || \l.tail != 0) assert (old);
        if (\l.entered ) assert (!old);
        // a command finds no line of the one before
        if (\l.busy && !\l.live && \l.tail == 0) assert (quiet >= CLEAN);
        if (!\l.busy && !\l.sweep ) assert (quiet >= CLEAN - 1);
        if (\l.tail != 0) assert (\l.tail >> quiet == 1);
        if (quiet >= 1) assert (\l.engine.chosen == NOTHING);
        if (quiet >= 2) assert ({\l.engine.b , \l.engine.c , \l.engine.d } == 0
                                && {\r.engine.b , \r.engine.c , \r.engine.d } == 0);
        if (quiet >= 3) assert ({\l.engine.newer , \r.engine.newer } == 0 || PIPE == 2);
        if (quiet >= 2 + (PIPE != 0)) assert ({\l.engine.products.late , \r.engine.products.late } == 0);
        if (quiet >= CLEAN - 2) assert (empty);
        if (quiet >= CLEAN - 1) assert ({\l.engine.kept , \r.engine.kept } == {32'd4, 32'd4}
                                        && {\l.engine.g_roots.check , \r.engine.g_roots.check } == 0);
        if (quiet >= CLEAN) assert ({\l.engine.out_word , \r.engine.out_word } == 0
                                    && {\l.engine.g_roots.beyond , \r.engine.g_roots.beyond } == 0);
        // directions are held, and registers read, where a run of this context has been, whatever others have run
        assert (\l.ran [mine] == ran);
        if (me) assert (\l.engine.in_forget == (\l.data [3] || !ran));
        if (me && !\l.live && !ran) assert (\l.engine.in_op [44:39] == 0);
        // register 0: nobody reads the words that its lines, or a reset, have left there
        assert (hit == (!\l.sweep || \l.at > CLEAN + wait0));
        assert (nought || !hit || me && (\l.live || quiet < CLEAN));
        assert (nought_before || quiet <= CLEAN || \l.sweep );
        if (\l.tail >> 1 != 0) assert (\l.ran [\l.bank ]);
        if (l_valid) assert (quiet > CLEAN || \l.kind == 2 && \l.ran [\l.bank ] && \l.engine.file.asked [5:0] != 0);
        if (l_valid && me && \l.engine.file.asked [5:0] == 0) assert (nought_before);
        assert (same || !hit);
        // where this context is served, flags and words are the same
        if (served) assert (flags && stages && aligned && asked);
        if (served && !old) assert (asks || PIPE != 0);
        if (served && (old || PIPE != 0)) assert (factors);
        if (served && old) assert (\l.engine.a == \r.engine.a );
    end
endmodule

// Lines of any value
module engine_lines #(parameter N = 10) (
    input clk, input [N-1:0] in_at, input in_store, input [49:0] in_line, output [49:0] out_line
);
    (* anyseq *) wire [49:0] any;
    assign out_line = any;
endmodule

// Words of any value
module engine_words #(parameter N = 8) (
    input clk, input [N-1:0] in_read, in_at, input in_store, input [26:0] in_word, output [26:0] out_word
);
    (* anyseq *) wire [26:0] any;
    reg [N-1:0] asked;
    always @(posedge clk) asked <= in_read;
    assign out_word = any;
endmodule

// Registers of any value
module engine_file #(parameter N = 6, CLEAR = 0) (
    input clk, input [N-1:0] in_a, in_b, in_c, in_d, input in_write, input [N-1:0] in_at, input [26:0] in_word,
    output [26:0] out_a, out_b, out_c, out_d
);
    (* anyseq *) wire [107:0] any;
    reg [4*N-1:0] asked;
    always @(posedge clk) asked <= {in_d, in_c, in_b, in_a};
    assign {out_d, out_c, out_b, out_a} = any;
endmodule

// Products of any value, but 0 where a factor is; PIPE 2 can invert the second one
module engine_products #(parameter PIPE = 0) (
    input clk, input signed [26:0] in_a, in_b, in_c, in_d, input in_invert, output signed [53:0] out_ab, out_cd
);
    (* anyseq *) wire [107:0] now;
    reg [107:0] later;
    wire [107:0] late = PIPE == 0 ? now : later;
    always @(posedge clk) later <= now;
    always @* begin
        if (in_b == 0) assume (now[107:54] == 0);
        if (in_d == 0) assume (now[53:0] == 0);
    end
    assign {out_ab, out_cd} = late ^ {54'd0, {54{PIPE == 2 && in_invert}}};
endmodule

// Factors of any value; the second one is held
module reciprocal_root (input clk, in_read, input [19:0] in_q, output [20:0] out_w, output reg [19:0] out_slope);
    (* anyseq *) wire [19:0] any;
    assign out_w = {in_q[19:9], ~in_q[8], in_q[8], ~in_q[7:0]};
    always @(posedge clk) if (in_read) out_slope <= any;
endmodule
