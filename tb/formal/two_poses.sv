// The contract of a core with two poses inside, whose runs take a pose between them: in_ready, out_valid exactly LATENCY
// clocks after the accepting one, results that wait unchanged, nothing lost, doubled or made up. As contract.sv, but
// that in_ready is low too while a run ends a pose alone. One clock of reset is enough, from any state.
// rtl: vector_ik6_two engine_program six_pose engine_ports product_engine engine_datapath
// rtl: engine_results
// proof PIPE1 mode=prove depth=2 PIPE=1 II=97
// proof PIPE2 mode=prove depth=2 PIPE=2 II=102
// proof PIPE1EDGES mode=prove depth=2 PIPE=1 II=107 MARGINS=1
// proof PIPE2EDGES mode=prove depth=2 PIPE=2 II=110 MARGINS=1
module vector_ik6_two_props #(parameter PIPE = 2, II = 102, MARGINS = 0) (
    input clk, rst, in_valid, out_ready, input [179:0] cfg, input [161:0] in_matrix, input [47:0] in_tip,
    input [2:0] in_branch
);
    wire in_ready, out_valid;
    wire [215:0] joints;
    wire [3:0] out_status;
    vector_ik6_two #(.PIPE(PIPE), .MARGINS(MARGINS)) dut (
        .clk(clk), .rst(rst), .cfg_a1(cfg[19:0]), .cfg_b(cfg[39:20]), .cfg_c1(cfg[59:40]), .cfg_c2(cfg[79:60]),
        .cfg_c4(cfg[99:80]), .cfg_k(cfg[119:100]), .cfg_cp(cfg[146:120]), .cfg_np(cfg[173:147]), .cfg_r({20{cfg[174]}}),
        .cfg_e({20{cfg[175]}}), .cfg_margin({16{cfg[176]}}), .cfg_slack({16{cfg[177]}}),
        .in_valid(in_valid), .in_ready(in_ready), .in_r11(in_matrix[17:0]),
        .in_r12(in_matrix[35:18]), .in_r13(in_matrix[53:36]), .in_r21(in_matrix[71:54]), .in_r22(in_matrix[89:72]),
        .in_r23(in_matrix[107:90]), .in_r31(in_matrix[125:108]), .in_r32(in_matrix[143:126]),
        .in_r33(in_matrix[161:144]), .in_x(in_tip[15:0]), .in_y(in_tip[31:16]), .in_z(in_tip[47:32]),
        .in_branch(in_branch), .out_valid(out_valid), .out_ready(out_ready), .out_c1(joints[17:0]),
        .out_n1(joints[35:18]), .out_c2(joints[53:36]), .out_n2(joints[71:54]), .out_c3(joints[89:72]),
        .out_n3(joints[107:90]), .out_c4(joints[125:108]), .out_n4(joints[143:126]), .out_c5(joints[161:144]),
        .out_n5(joints[179:162]), .out_c6(joints[197:180]), .out_n6(joints[215:198]), .out_status(out_status));

    (* hierconn *) wire \dut.begun ;
    (* hierconn *) wire \dut.ends ;
    (* hierconn *) wire \dut.idle ;
    (* hierconn *) wire [6:0] \dut.g_program.control.control.control.line ;

    reg  [2*II-1:0] age;  // bit i: a pose was accepted i + 1 clocks ago, counting those in which it moved
    reg  live, waits;
    reg  [219:0] before;
    wire last = age[2*II-1];
    wire move = !last || out_ready;
    wire [219:0] result = {joints, out_status};
    initial {live, waits} = 0;
    always @* if (!live) assume (rst);
    always @(posedge clk) begin
        live   <= 1;
        waits  <= live && !rst && out_valid && !out_ready;
        before <= result;
        if (rst) age <= 0;
        else if (move) age <= {age, in_valid && in_ready};
    end
    wire busy = |age[II-2:0] || |age[2*II-2:II];  // a run is on
    always @* if (live) begin
        assert (in_ready == (move && !busy));
        assert (out_valid == last);
        if (waits) assert (out_valid && result == before);
        assert (\dut.idle == !busy);
        assert (\dut.begun == |age[II-1:0]);
        if (busy) assert (\dut.ends == |age[2*II-2:II]);
    end
    genvar g;
    generate
        for (g = 0; g < II; g = g + 1) begin : g_age  // the pose before is a run older, and there is none between
            always @* if (live && (age[g] || age[II+g])) begin
                if (g < II-1) assert (\dut.g_program.control.control.control.line == g);
                assert ((age & ~((1 << g) | (1 << II << g))) == 0);
            end
        end
    endgenerate
endmodule

// What the contract does not depend on: lines, products, registers and powers of any value
module vector_ik6_two_program #(parameter PIPE = 2) (
    input clk, rst, in_start, output out_idle, out_done, output [46:0] out_op
);
    any_program #(.LINES(PIPE == 1 ? 92 : 95), .PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(in_start),
        .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
endmodule

module vector_ik6_near_two_program #(parameter PIPE = 2) (
    input clk, rst, in_start, output out_idle, out_done, output [46:0] out_op
);
    any_program #(.LINES(PIPE == 1 ? 102 : 103), .PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(in_start),
        .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
endmodule

module any_program #(parameter LINES = 95, PIPE = 2) (
    input clk, rst, in_start, output out_idle, out_done, output [46:0] out_op
);
    (* anyseq *) wire [46:0] any;
    wire none;
    assign out_op = any;
    engine_program #(.LINES(LINES), .DRAIN(PIPE == 1 ? 4 : 6), .BITS(1), .REGISTER(0), .TABLE({LINES{1'b0}})) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(none));
endmodule

module engine_products #(parameter PIPE = 0) (
    input clk, input [26:0] in_a, in_b, in_c, in_d, input in_invert, output [53:0] out_ab, out_cd
);
    (* anyseq *) wire [107:0] any;
    assign {out_ab, out_cd} = any;
endmodule

module engine_file #(parameter N = 6, CLEAR = 0) (
    input clk, input [N-1:0] in_a, in_b, in_c, in_d, input in_write, input [N-1:0] in_at, input [26:0] in_word,
    output [26:0] out_a, out_b, out_c, out_d
);
    (* anyseq *) wire [107:0] any;
    assign {out_a, out_b, out_c, out_d} = any;
endmodule

module engine_roots #(parameter WRIST = 12) (
    input clk, in_first, in_more, in_wrist, in_none, input [25:0] in_fold, input in_read, in_clear,
    input [19:0] in_q, output [20:0] out_w, output [19:0] out_slope, output [25:0] out_power, out_four,
    output [13:0] out_twice, output out_empty
);
    (* anyseq *) wire [107:0] any;
    assign {out_w, out_slope, out_power, out_four, out_twice, out_empty} = any;
endmodule
