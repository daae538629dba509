// The contract where samples overlap and results wait behind others: engine_rus_rules in engine_rus_parts.sv.
// rtl: engine_rus_ik engine_rus_poses
// rtl: engine_rus_leg engine_rus_results schedule
// with: engine_rus_parts.sv
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
