// The contract where samples overlap and results wait behind others: engine_rus_rules below.
// rtl: engine_rus_ik engine_rus_poses
// rtl: engine_rus_leg engine_rus_results schedule
// proof W18 mode=prove depth=2 W=18
module engine_rus_ik_props #(parameter W = 18) (
    input clk, rst, in_valid, out_ready, in_load, input [26:0] cfg_k, input [25:0] cfg_c, input [11:0] cfg_near,
    input [2:0] in_leg, input [17:0] in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33,
    input [W-1:0] in_px, in_py, in_pz, input [17:0] in_cb, in_nb
);
    wire in_ready, out_valid;
    wire [17:0] out_c1, out_n1, out_c2, out_n2, out_c3, out_n3, out_c4, out_n4, out_c5, out_n5, out_c6, out_n6;
    wire [21:0] out_s1, out_s2, out_s3, out_s4, out_s5, out_s6;
    wire [5:0] out_far;
    wire [3:0] out_status;
    (* hierconn *) wire [7:0] \dut.poses.beat.step ;
    (* hierconn *) wire [36:0] \dut.poses.path.control.step ;
    (* hierconn *) wire \dut.poses.busy ;
    (* hierconn *) wire [2:0] \dut.poses.leg ;
    (* hierconn *) wire [2:0] \dut.poses.tag ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag2 ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag3 ;
    (* hierconn *) wire [2:0] \dut.poses.path.tag4 ;
    (* hierconn *) wire [2:0] \dut.poses.path.out_tag ;
    (* hierconn *) wire \dut.results.whole ;
    engine_rus_ik #(.W(W)) dut (.*);
    engine_rus_rules #(.WO(358), .LATE(0)) rules (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid), .out_ready(out_ready),
        .result({out_c1, out_n1, out_c2, out_n2, out_c3, out_n3, out_c4, out_n4, out_c5, out_n5, out_c6, out_n6,
            out_s1, out_s2, out_s3, out_s4, out_s5, out_s6, out_far, out_status}),
        .beat(\dut.poses.beat.step ), .control(\dut.poses.path.control.step ), .busy(\dut.poses.busy ),
        .at(\dut.poses.leg ), .whole(\dut.results.whole ),
        .tags({\dut.poses.path.out_tag [2], \dut.poses.path.tag4 [2], \dut.poses.path.tag3 [2],
            \dut.poses.path.tag2 [2], \dut.poses.tag [2]}), .moved(2'd0));
endmodule

// The contract where samples overlap and results wait behind others: engine_rus_rules below.
// rtl: engine_rus_ik_angle engine_rus_poses
// rtl: engine_rus_leg engine_rus_results schedule
// proof W18A18 mode=prove depth=2 W=18 A=18
module engine_rus_ik_angle_props #(parameter W = 18, A = 18) (
    input clk, rst, in_valid, out_ready, in_load, input [26:0] cfg_k, input [25:0] cfg_c, input [11:0] cfg_near,
    input [2:0] in_leg, input [17:0] in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33,
    input [W-1:0] in_px, in_py, in_pz, input [17:0] in_cb, in_nb
);
    wire in_ready, out_valid;
    wire [A-1:0] out_j1, out_j2, out_j3, out_j4, out_j5, out_j6;
    wire [21:0] out_s1, out_s2, out_s3, out_s4, out_s5, out_s6;
    wire [5:0] out_far;
    wire [3:0] out_status;
    (* hierconn *) wire [7:0] \dut.poses.beat.step ;
    (* hierconn *) wire [36:0] \dut.poses.path.control.step ;
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
    engine_rus_ik_angle #(.W(W), .A(A)) dut (.*);
    engine_rus_rules #(.WO(6 * A + 142), .LATE(1)) rules (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid), .out_ready(out_ready),
        .result({out_j1, out_j2, out_j3, out_j4, out_j5, out_j6, out_s1, out_s2, out_s3, out_s4, out_s5, out_s6,
            out_far, out_status}),
        .beat(\dut.poses.beat.step ), .control(\dut.poses.path.control.step ), .busy(\dut.poses.busy ),
        .at(\dut.poses.leg ), .whole(\dut.results.whole ),
        .tags({\dut.poses.path.out_tag [2], \dut.poses.path.tag4 [2], \dut.poses.path.tag3 [2],
            \dut.poses.path.tag2 [2], \dut.poses.tag [2]}),
        .moved({\dut.last_turned , \dut.turned }));
endmodule

// What the contracts of engine_rus_ik and engine_rus_ik_angle share, and what they do not depend on: words and flags of
// any value.

// Nothing lost, doubled or made up, a result waits unchanged, it is there 79 + LATE clocks after its pose was taken
// unless the one before it still waits. in_ready is high when a leg could begin in step with those inside and the
// outputs are free. One clock of reset, from any state.
module engine_rus_rules #(parameter WO = 1, LATE = 0) (
    input clk, rst, in_valid, in_ready, out_valid, out_ready, input [WO-1:0] result,
    input [7:0] beat, input [36:0] control, input busy, whole, input [2:0] at, input [4:0] tags, input [1:0] moved
);
    reg  [WO-1:0] before;
    reg  live, waits, free;
    reg  [79:0] age;   // age[i]: a pose was taken i + 1 clocks ago
    reg  [2:0]  held;  // taken and not yet delivered
    initial live = 0;
    wire take = in_valid && in_ready, give = out_valid && out_ready;
    always @(posedge clk) begin
        live   <= 1;
        waits  <= live && !rst && out_valid && !out_ready;
        free   <= !out_valid || out_ready;
        before <= result;
        age    <= rst ? 80'd0 : {age, take};
        held   <= rst ? 3'd0 : held + take - give;
    end
    always @* if (!live) assume (rst);

    wire [79:0] clash;
    wire [36:0] legs;
    wire [7:0]  beats;
    wire [2:0]  count [0:78];
    assign count[0] = 3'd0;
    genvar i;
    generate
        for (i = 0; i < 80; i = i + 1) begin : g_age
            // another one that is not 48, 56, 64 or 72 clocks older
            if (i < 79) assign clash[i] = age[i] && |(age[79:i+1] & ~(79'h808080800000000000));
            else        assign clash[i] = 1'b0;
        end
        for (i = 0; i < 37; i = i + 1) begin : g_leg
            assign legs[i] = age[i] | age[i+8] | age[i+16] | age[i+24] | age[i+32] | age[i+40];
        end
        for (i = 0; i < 8; i = i + 1) begin : g_beat
            assign beats[i] = age[i] | age[i+8] | age[i+16] | age[i+24] | age[i+32] | age[i+40] | age[i+48]
                | age[i+56] | age[i+64] | age[i+72];
        end
        for (i = 0; i < 78; i = i + 1) begin : g_count
            assign count[i+1] = count[i] + {2'd0, age[i]};
        end
    endgenerate
    wire [2:0] leg = |age[12:5] ? 3'd1 : |age[20:13] ? 3'd2 : |age[28:21] ? 3'd3 : |age[36:29] ? 3'd4
        : |age[44:37] ? 3'd5 : 3'd0;
    wire step = age[47] | age[55] | age[63] | age[71] | age[79];

    always @* if (live) begin
        assert (clash == 0);
        assert (beat == beats);
        assert (control == legs);
        assert (busy == |age[76:5]);
        assert (at == leg);
        assert (in_ready == ((age == 0 || step && leg == 0 && age[46:0] == 0) && (!out_valid || out_ready)));
        if (|age[44:5])  assert (!tags[0]);
        if (|age[52:45]) assert (tags[0]);
        if (|age[50:11]) assert (!tags[1]);
        if (|age[58:51]) assert (tags[1]);
        if (|age[57:18]) assert (!tags[2]);
        if (|age[65:58]) assert (tags[2]);
        if (|age[62:23]) assert (!tags[3]);
        if (|age[70:63]) assert (tags[3]);
        if (|age[69:30]) assert (!tags[4]);
        if (|age[77:70]) assert (tags[4]);
        if (LATE) begin
            assert (moved[0] == (age[37] | age[45] | age[53] | age[61] | age[69] | age[77]));
            if (moved[0]) assert (moved[1] == age[77]);
        end
        // taken and not delivered: inside, whole, at the outputs; never more than two
        assert (held == count[77+LATE] + {2'd0, whole} + {2'd0, out_valid});
        assert (held <= 2);
        if (age[77+LATE]) assert (whole);
        if (whole && !age[77+LATE]) assert (out_valid);
        if (age[78+LATE] && free) assert (out_valid);
        if (waits) assert (out_valid && result == before);
    end
endmodule

module engine_rus_path (
    input clk, input [26:0] cfg_k, input [25:0] cfg_c, input [11:0] cfg_near, input [33:0] in_op,
    input [71:0] in_row, in_words, input [17:0] in_cb, in_nb, input in_dead, input [11:0] in_place, input [16:0] in_step, output [28:0] out_rise,
    output [17:0] out_word,
    output [21:0] out_root, output out_far, out_none, out_near, out_over
);
    (* anyseq *) wire [72:0] any;
    assign {out_rise, out_word, out_root, out_far, out_none, out_near, out_over} = any;
endmodule

module engine_rus_angle #(parameter A = 18) (
    input clk, in_valid, input [17:0] in_c, in_n, input in_take, output [11:0] out_place, output [16:0] out_step,
    input [28:0] in_rise, output [A-1:0] out_j
);
    (* anyseq *) wire [A+28:0] any;
    assign {out_place, out_step, out_j} = any;
endmodule
