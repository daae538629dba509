// The contract where samples overlap and results wait behind others: engine_rus_rules below.
// rtl: engine_rus_ik engine_rus_poses
// rtl: engine_rus_leg engine_rus_results schedule
// proof W18 mode=prove depth=2 W=18
// proof PIPE1 mode=prove depth=2 W=18 PIPE=1
// proof PIPE1M27 mode=prove depth=2 W=18 PIPE=1 MULTIPLY=27
module engine_rus_ik_props #(parameter W = 18, PIPE = 0, MULTIPLY = 18) (
    input clk, rst, in_valid, out_ready, in_load, input [26:0] cfg_k, input [25:0] cfg_c, input [11:0] cfg_near,
    input [2:0] in_leg, input [17:0] in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33,
    input [W-1:0] in_px, in_py, in_pz, input [17:0] in_cb, in_nb
);
    wire in_ready, out_valid;
    wire [17:0] out_c1, out_n1, out_c2, out_n2, out_c3, out_n3, out_c4, out_n4, out_c5, out_n5, out_c6, out_n6;
    wire [21:0] out_s1, out_s2, out_s3, out_s4, out_s5, out_s6;
    wire [5:0] out_far;
    wire [3:0] out_status;
    localparam H = PIPE == 0 ? 8 : 12, L = PIPE == 0 ? 37 : 51;
    (* hierconn *) wire [H-1:0] \dut.poses.g_table.beat.step ;
    (* hierconn *) wire [L-1:0] \dut.poses.path.g_table.control.step ;
    (* hierconn *) wire \dut.poses.busy ;
    (* hierconn *) wire [2:0] \dut.poses.leg ;
    (* hierconn *) wire [2:0] \dut.poses.tag ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag2 ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag3 ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag4 ;
    (* hierconn *) wire [2:0] \dut.poses.path.out_tag ;
    (* hierconn *) wire \dut.results.whole ;
    engine_rus_ik #(.W(W), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) dut (.*);
    engine_rus_rules #(.WO(358), .PIPE(PIPE), .LATE(0)) rules (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid), .out_ready(out_ready),
        .result({out_c1, out_n1, out_c2, out_n2, out_c3, out_n3, out_c4, out_n4, out_c5, out_n5, out_c6, out_n6,
            out_s1, out_s2, out_s3, out_s4, out_s5, out_s6, out_far, out_status}),
        .beat(\dut.poses.g_table.beat.step ), .control(\dut.poses.path.g_table.control.step ), .busy(\dut.poses.busy ),
        .at(\dut.poses.leg ), .whole(\dut.results.whole ),
        .tags({\dut.poses.path.out_tag [2], \dut.poses.path.tag4 [2], \dut.poses.path.tag3 [2],
            \dut.poses.path.tag2 [2], \dut.poses.tag [2]}), .moved(2'd0), .moves(4'd0));
endmodule

// The contract where samples overlap and results wait behind others: engine_rus_rules below.
// rtl: engine_rus_ik_angle engine_rus_poses
// rtl: engine_rus_leg engine_rus_results schedule
// proof W18A18 mode=prove depth=2 W=18 A=18
// proof PIPE1 mode=prove depth=2 W=18 A=18 PIPE=1
// proof PIPE1M27 mode=prove depth=2 W=18 A=18 PIPE=1 MULTIPLY=27
module engine_rus_ik_angle_props #(parameter W = 18, A = 18, PIPE = 0, MULTIPLY = 18) (
    input clk, rst, in_valid, out_ready, in_load, input [26:0] cfg_k, input [25:0] cfg_c, input [11:0] cfg_near,
    input [2:0] in_leg, input [17:0] in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33,
    input [W-1:0] in_px, in_py, in_pz, input [17:0] in_cb, in_nb
);
    wire in_ready, out_valid;
    wire [A-1:0] out_j1, out_j2, out_j3, out_j4, out_j5, out_j6;
    wire [21:0] out_s1, out_s2, out_s3, out_s4, out_s5, out_s6;
    wire [5:0] out_far;
    wire [3:0] out_status;
    localparam H = PIPE == 0 ? 8 : 12, L = PIPE == 0 ? 37 : 51;
    (* hierconn *) wire [H-1:0] \dut.poses.g_table.beat.step ;
    (* hierconn *) wire [L-1:0] \dut.poses.path.g_table.control.step ;
    (* hierconn *) wire \dut.poses.busy ;
    (* hierconn *) wire [2:0] \dut.poses.leg ;
    (* hierconn *) wire [2:0] \dut.poses.tag ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag2 ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag3 ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag4 ;
    (* hierconn *) wire [2:0] \dut.poses.path.out_tag ;
    (* hierconn *) wire \dut.results.whole ;
    (* hierconn *) wire \dut.turned ;
    (* hierconn *) wire \dut.last_turned ;
    (* hierconn *) wire [(PIPE == 0 ? 1 : 4)-1:0] \dut.g_late.moves ;
    engine_rus_ik_angle #(.W(W), .A(A), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) dut (.*);
    engine_rus_rules #(.WO(6 * A + 142), .PIPE(PIPE), .LATE(PIPE == 0 ? 1 : 5)) rules (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid), .out_ready(out_ready),
        .result({out_j1, out_j2, out_j3, out_j4, out_j5, out_j6, out_s1, out_s2, out_s3, out_s4, out_s5, out_s6,
            out_far, out_status}),
        .beat(\dut.poses.g_table.beat.step ), .control(\dut.poses.path.g_table.control.step ), .busy(\dut.poses.busy ),
        .at(\dut.poses.leg ), .whole(\dut.results.whole ),
        .tags({\dut.poses.path.out_tag [2], \dut.poses.path.tag4 [2], \dut.poses.path.tag3 [2],
            \dut.poses.path.tag2 [2], \dut.poses.tag [2]}),
        .moved({\dut.last_turned , \dut.turned }), 
        .moves(PIPE == 0 ? 4'd0 : \dut.g_late.moves ));
endmodule

// What the contracts of engine_rus_ik and engine_rus_ik_angle share, and what they do not depend on: words and flags of
// any value.

// Nothing lost, doubled or made up, a result waits unchanged, it is there 79 + 34 PIPE + LATE clocks after its pose
// was taken unless the one before it still waits. in_ready is high when a leg could begin in step with those inside and the
// outputs are free. One clock of reset, from any state.
module engine_rus_rules #(parameter WO = 1, PIPE = 0, LATE = 0) (
    input clk, rst, in_valid, in_ready, out_valid, out_ready, input [WO-1:0] result,
    input [(PIPE == 0 ? 8 : 12)-1:0] beat, input [(PIPE == 0 ? 37 : 51)-1:0] control, input busy, whole,
    input [2:0] at, input [4:0] tags, input [1:0] moved, input [3:0] moves
);
    localparam H = PIPE == 0 ? 8 : 12, L = PIPE == 0 ? 37 : 51;  // clocks between two legs, and of one
    localparam READ = PIPE == 0 ? 4 : 6, TAG2 = PIPE == 0 ? 10 : 16, TAG3 = PIPE == 0 ? 17 : 27,
        TAG4 = PIPE == 0 ? 22 : 33, TAG5 = PIPE == 0 ? 29 : 44;  // its lines that move a tag on
    localparam N = 10 * H, END = 5 * H + L;             // the sine of leg 6 is out
    localparam FREE = PIPE == 0 ? END - 1 : 5 * H + 45;  // from here on no leg keeps the beat, and it stops with the
    localparam IDLE = PIPE == 0 ? N : 9 * H;             // last line before this
    reg  [WO-1:0] before;
    reg  live, waits, free;
    reg  [N-1:0] age;   // age[i]: a pose was taken i + 1 clocks ago
    reg  [2:0]  held;  // taken and not yet delivered
    initial live = 0;
    wire take = in_valid && in_ready, give = out_valid && out_ready;
    always @(posedge clk) begin
        live   <= 1;
        waits  <= live && !rst && out_valid && !out_ready;
        free   <= !out_valid || out_ready;
        before <= result;
        age    <= rst ? 0 : {age, take};
        held   <= rst ? 3'd0 : held + take - give;
    end
    always @* if (!live) assume (rst);

    localparam [N-2:0] ONE = 1;
    localparam [N-2:0] APART = ONE << 6 * H - 1 | ONE << 7 * H - 1 | ONE << 8 * H - 1 | ONE << 9 * H - 1
        | (PIPE == 0 ? 0 : ~(ONE << IDLE - 1) + 1);
    wire [N-1:0] clash;
    wire [L-1:0] legs;
    wire [H-1:0] beats;
    wire [2:0]   count [0:END+LATE];
    assign count[0] = 3'd0;
    genvar i;
    generate
        for (i = 0; i < N; i = i + 1) begin : g_age
            // another one that is not 6, 7, 8 or 9 legs older, or so old that the beat has stopped
            if (i < N - 1) assign clash[i] = age[i] && |(age[N-1:i+1] & ~APART);
            else           assign clash[i] = 1'b0;
        end
        for (i = 0; i < L; i = i + 1) begin : g_leg
            assign legs[i] = age[i] | age[i+H] | age[i+2*H] | age[i+3*H] | age[i+4*H] | age[i+5*H];
        end
        for (i = 0; i < H; i = i + 1) begin : g_beat
            assign beats[i] = age[i] | age[i+H] | age[i+2*H] | age[i+3*H] | age[i+4*H] | age[i+5*H] | age[i+6*H]
                | age[i+7*H] | age[i+8*H] | (age[i+9*H] && PIPE == 0);
        end
        for (i = 0; i < END + LATE; i = i + 1) begin : g_count
            assign count[i+1] = count[i] + {2'd0, age[i]};
        end
    endgenerate
    wire [2:0] leg = |age[READ+H:READ+1] ? 3'd1 : |age[READ+2*H:READ+H+1] ? 3'd2 : |age[READ+3*H:READ+2*H+1] ? 3'd3
        : |age[READ+4*H:READ+3*H+1] ? 3'd4 : |age[READ+5*H:READ+4*H+1] ? 3'd5 : 3'd0;
    wire step = age[6*H-1] | age[7*H-1] | age[8*H-1] | age[9*H-1] | (age[10*H-1] && PIPE == 0);

    always @* if (live) begin
        assert (clash == 0);
        assert (beat == beats);
        assert (control == legs);
        // with PIPE the flags of leg 6 clear it, and the next read of another pose, which keeps the beat, sets it again
        assert (busy == (|age[FREE:READ+1] && !(PIPE != 0 && |age[READ+9*H:FREE+1])));
        assert (at == leg);
        assert (in_ready == ((age[IDLE-1:0] == 0 || step && leg == 0 && age[6*H-2:0] == 0) && (!out_valid || out_ready)));
        if (|age[READ+5*H:READ+1])     assert (!tags[0]);
        if (|age[READ+6*H:READ+5*H+1]) assert (tags[0]);
        if (|age[TAG2+5*H:TAG2+1])     assert (!tags[1]);
        if (|age[TAG2+6*H:TAG2+5*H+1]) assert (tags[1]);
        if (|age[TAG3+5*H:TAG3+1])     assert (!tags[2]);
        if (|age[TAG3+6*H:TAG3+5*H+1]) assert (tags[2]);
        if (|age[TAG4+5*H:TAG4+1])     assert (!tags[3]);
        if (|age[TAG4+6*H:TAG4+5*H+1]) assert (tags[3]);
        if (|age[TAG5+5*H:TAG5+1])     assert (!tags[4]);
        if (|age[TAG5+6*H:TAG5+5*H+1]) assert (tags[4]);
        if (LATE) begin
            assert (moved[0] == (age[L] | age[L+H] | age[L+2*H] | age[L+3*H] | age[L+4*H] | age[L+5*H]));
            if (moved[0]) assert (moved[1] == age[L+5*H]);
        end
        // taken and not delivered: inside, whole, at the outputs; never more than two
        assert (held == count[END+LATE] + {2'd0, whole} + {2'd0, out_valid});
        assert (held <= 2);
        if (age[END+LATE]) assert (whole);
        if (whole && !age[END+LATE]) assert (out_valid);
        if (age[END+LATE+1] && free) assert (out_valid);
        if (waits) assert (out_valid && result == before);
    end
    generate
        for (i = 1; i < LATE; i = i + 1) begin : g_late  // while the codec's product is formed
            always @* if (live) begin
                assert (moves[i-1] == (age[L+i] | age[L+H+i] | age[L+2*H+i] | age[L+3*H+i] | age[L+4*H+i]
                    | age[L+5*H+i]));
                if (moves[i-1]) assert (moved[1] == age[L+5*H+i]);
            end
        end
    endgenerate
endmodule

module engine_rus_path #(parameter PIPE = 0, MULTIPLY = 18) (
    input clk, input [26:0] cfg_k, input [25:0] cfg_c, input [11:0] cfg_near, input [33:0] in_op,
    input [71:0] in_row, in_words, input [17:0] in_cb, in_nb, input in_dead, input [11:0] in_place, input [16:0] in_step, output [28:0] out_rise,
    output [17:0] out_word,
    output [21:0] out_root, output out_far, out_none, out_near, out_over
);
    (* anyseq *) wire [72:0] any;
    assign {out_rise, out_word, out_root, out_far, out_none, out_near, out_over} = any;
endmodule

module engine_rus_angle #(parameter A = 18, PIPE = 0) (
    input clk, in_valid, input [17:0] in_c, in_n, input in_take, in_move, output [11:0] out_place, output [16:0] out_step,
    input [28:0] in_rise, output [A-1:0] out_j
);
    (* anyseq *) wire [A+28:0] any;
    assign {out_place, out_step, out_j} = any;
endmodule
