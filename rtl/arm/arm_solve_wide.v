// SPDX-License-Identifier: Apache-2.0
// arm_solve for words of more than 16 bits: kernel_vector_wide for three joints, with the base height before it and,
// behind it, the clocks in which arm_vectors turns joint 2.
// Formats: in_*, cfg_base sN.0; other cfg_* by arm.config; out_word s4.(N+2) and what belongs to it as in
// kernel_vector_wide. out_sine, out_by1, out_kept, out_turned are as in arm_solve; operands of a turn precede out_kept
// and out_turned by three clocks with PIPE = 1.
// Error of the tip: bounds.arm.ik3. Latency and II: 19 + 5 LATERAL + 2 ABSOLUTE, with PIPE = 1 44 + 3 LATERAL +
// 5 ABSOLUTE. Status: unreachable (the nearest point in the plane of the arm is answered), singular (within the margin,
// or joint 1 or 3 has no direction), overflow (z - base was saturated).
// Source: rational trigonometry paper, eqs. 32-40, in vector form, with the offsets of real arms. Model: arm.ik3
`default_nettype none
module arm_solve_wide #(
    parameter N = 20,                // bits of a coordinate, 20 or 24 (default 20)
    parameter U = 20,                // fraction bits of a rounded word, 8 to N (default 20)
    parameter BASE = 1,              // 1 (default): with base height; 0: without
    parameter SHOULDER = 1,          // 1 (default): with shoulder offset; 0: without
    parameter LATERAL = 1,           // 1 (default): with lateral offset; 0: without
    parameter ABSOLUTE = 1,          // 1 (default): joint 2 is measured from the base; 0: from link 1
    parameter MARGINS = 0,           // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
    parameter PIPE = 0,              // 0 or 1 (default 0: fewest clocks); 1: registers behind products and tables
    parameter MULTIPLY = 18,         // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter F = N == 24 ? 29 : 25  // fraction bits of the words of the third multiplier, of one value (default 25)
) (
    input  wire                  clk,
    input  wire                  rst,
    input  wire [N-1:0]          cfg_l1,
    input  wire [N-1:0]          cfg_l2,
    input  wire signed [2*N+1:0] cfg_q,
    input  wire [F:0]            cfg_r,
    input  wire [4:0]            cfg_e,
    input  wire signed [N-1:0]   cfg_base,
    input  wire signed [N-3:0]   cfg_shoulder,
    input  wire signed [N-1:0]   cfg_lateral,
    input  wire signed [2*N-1:0] cfg_bb,
    input  wire [N-2:0]          cfg_margin,
    input  wire [N-4:0]          cfg_slack,
    input  wire                  in_valid,
    output wire                  in_ready,
    input  wire signed [N-1:0]   in_x,
    input  wire signed [N-1:0]   in_y,
    input  wire signed [N-1:0]   in_z,
    input  wire                  in_elbow,
    input  wire                  in_back,
    output wire                  out_valid,
    input  wire                  out_ready,
    output wire [2:0]            out_cos,
    output wire [2:0]            out_sin,
    output wire [N+5:0]          out_word,
    output wire                  out_flat,
    output wire                  out_negative,
    output wire                  out_none,
    output wire                  out_sine,
    output wire                  out_by1,
    output wire                  out_kept,
    output wire                  out_turned,
    output wire [3:0]            out_status
);
    // z - base, saturated
    wire signed [N:0]   height = {in_z[N-1], in_z} - (BASE ? {cfg_base[N-1], cfg_base} : {(N+1){1'b0}});
    wire                beyond_z = BASE && height[N] != height[N-1];
    wire signed [N-1:0] z = beyond_z ? {height[N], {(N-1){!height[N]}}} : height[N-1:0];
    wire [3:0]          status;
    reg                 over_z;
    always @(posedge clk)
        if (in_valid && in_ready)
            over_z <= beyond_z;
    assign              out_status = {1'b0, over_z, status[1:0]};

    kernel_vector_wide #(.N(N), .JOINTS(3), .U(U), .LAG(ABSOLUTE == 0 ? 0 : PIPE == 0 ? 2 : 5), .PIPE(PIPE),
        .MULTIPLY(MULTIPLY), .MARGINS(MARGINS), .SHOULDER(SHOULDER), .LATERAL(LATERAL)) kernel (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
        .cfg_margin(cfg_margin), .cfg_slack(cfg_slack), .cfg_shoulder(cfg_shoulder), .cfg_lateral(cfg_lateral),
        .cfg_bb(cfg_bb), .in_valid(in_valid), .in_ready(in_ready), .in_x(in_x), .in_y(in_y), .in_z(z),
        .in_elbow(in_elbow), .in_back(in_back), .out_valid(out_valid), .out_ready(out_ready), .out_cos(out_cos),
        .out_sin(out_sin), .out_word(out_word), .out_flat(out_flat), .out_negative(out_negative), .out_none(out_none),
        .out_status(status));

    // Joint 2 is turned by the elbow's constant after its sine, and by joint 1 after the sine of that: the operands of
    // the cosine first, then those of the sine. Every word of a sample sets these bits anew.
    localparam CLOCKS = PIPE == 0 ? 2 : 5;
    reg [5:1]  after2, after1;  // clocks since the sine of joint 2, of joint 1
    always @(posedge clk) begin
        after2 <= {after2[4:1], out_sin[1]};
        after1 <= {after1[4:1], out_sin[0] && ABSOLUTE};
    end
    assign     out_kept = after2[CLOCKS-1] || after1[CLOCKS-1];
    assign     out_turned = after2[CLOCKS] || after1[CLOCKS];
    assign     out_sine = PIPE == 0 ? out_turned : after2[2] || after1[2];
    assign     out_by1 = |after1;
    wire       unused = &{1'b0, after1, after2, cfg_base, status[3:2]};
endmodule
`default_nettype wire
