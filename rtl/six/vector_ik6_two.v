// SPDX-License-Identifier: Apache-2.0
// This core is vector_ik6 with two poses inside: while the program ends one it begins the next.
//   in_branch[0]: the shoulder looks back; [1]: sin(q3 + psi) < 0; [2]: sin q5 < 0
// Formats, error and status are those of vector_ik6; so is every word. cfg_* by six.config.
// Latency by PIPE: 194, 204, with MARGINS 214, 220, two runs of the program; II: half of it. A pose is accepted between
// two runs: one that comes while the program ends a pose alone waits for the next run, and a pose that waits for
// out_ready stops the program before its next run.
// Model: six.ik6
`default_nettype none
module vector_ik6_two #(
    parameter W = 16,      // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,       // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,      // fraction bits of a unit vector and of the matrix, 8 to 18 (default 16)
    parameter PIPE = 2,    // registers behind the engine's products, 1 or 2 (default 2: most poses a second)
    parameter MARGINS = 0  // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W+3:0] cfg_a1,
    input  wire signed [W+3:0] cfg_b,
    input  wire signed [W+3:0] cfg_c1,
    input  wire signed [W+3:0] cfg_c2,
    input  wire signed [W+3:0] cfg_c4,
    input  wire signed [W+3:0] cfg_k,
    input  wire signed [26:0]  cfg_cp,
    input  wire signed [26:0]  cfg_np,
    input  wire [24:0]         cfg_r,
    input  wire [21:0]         cfg_e,
    input  wire signed [W-1:0] cfg_margin,
    input  wire signed [W-1:0] cfg_slack,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_r11,
    input  wire signed [U+1:0] in_r12,
    input  wire signed [U+1:0] in_r13,
    input  wire signed [U+1:0] in_r21,
    input  wire signed [U+1:0] in_r22,
    input  wire signed [U+1:0] in_r23,
    input  wire signed [U+1:0] in_r31,
    input  wire signed [U+1:0] in_r32,
    input  wire signed [U+1:0] in_r33,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    input  wire [2:0]          in_branch,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_c1,
    output wire signed [U+1:0] out_n1,
    output wire signed [U+1:0] out_c2,
    output wire signed [U+1:0] out_n2,
    output wire signed [U+1:0] out_c3,
    output wire signed [U+1:0] out_n3,
    output wire signed [U+1:0] out_c4,
    output wire signed [U+1:0] out_n4,
    output wire signed [U+1:0] out_c5,
    output wire signed [U+1:0] out_n5,
    output wire signed [U+1:0] out_c6,
    output wire signed [U+1:0] out_n6,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || PIPE < 1 || PIPE > 2 || MARGINS < 0 || MARGINS > 1)
        begin : g_illegal
            vector_ik6_two_needs_W_4_to_16_and_F_below_W_and_U_8_to_18_and_PIPE_1_or_2_and_MARGINS_0_or_1 rule ();
        end
    endgenerate

    // A run begins with a new pose, or with none to end the one before
    wire idle, done;
    reg  begun;  // the last run has solved, or this one solves, the first half of a pose
    reg  ends;   // this run solves the second half of a pose
    wire room = idle && (!out_valid || out_ready);
    wire accept = in_valid && in_ready;
    wire start = room && (in_valid || begun);
    assign in_ready = room;

    // What the first half has left for the second: its flags, and the sign of sin q5
    wire [46:0] op;
    wire [26:0] port, word;
    wire [5:0]  dest;
    wire [3:0]  status;
    reg  [2:0]  signs;
    reg         flip, wrong, far;
    wire        none = op[5] && !ends;  // HOLD: of no pose it would change the direction that is held
    generate
        if (MARGINS != 0) begin : g_program
            vector_ik6_near_two_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(start),
                .out_idle(idle), .out_done(done), .out_op(op));
        end else begin : g_program
            vector_ik6_two_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(start), .out_idle(idle),
                .out_done(done), .out_op(op));
        end
    endgenerate
    six_pose #(.W(W), .U(U), .EDGES(MARGINS)) pose (.clk(clk), .in_take(accept),
        .in_matrix({in_r33, in_r32, in_r31, in_r23, in_r22, in_r21, in_r13, in_r12, in_r11}),
        .in_tip({in_z, in_y, in_x}), .in_lengths({cfg_k, cfg_c4, cfg_c2, cfg_c1, cfg_b, cfg_a1}), .in_cp(cfg_cp),
        .in_np(cfg_np), .in_r(cfg_r), .in_e(cfg_e), .in_edges({cfg_slack, cfg_margin}),
        .in_select(op[43:39]), .out_word(port));
    product_engine #(.PIPE(PIPE), .WRIST(28-U), .SLACK(29-U), .MARGINS(MARGINS)) engine (.clk(clk), .rst(rst),
        .in_start(start), .in_run(!idle), .in_op({op[46:15], op[14:9] & {6{!none}}, op[8:6], op[5] && ends, op[4:0]}),
        .in_port(port), .in_signs({flip, signs[1:0]}), .out_word(word), .out_dest(dest), .out_status(status));
    engine_results #(.COUNT(12), .U(U)) joints (.clk(clk), .in_word(word), .in_dest(dest), .out_words({out_n6, out_c6,
        out_n5, out_c5, out_n4, out_c4, out_n3, out_c3, out_n2, out_c2, out_n1, out_c1}));
    assign out_status = {wrong, 1'b0, status[1], far};
    wire unused = &{1'b0, status[2]};

    always @(posedge clk) begin
        if (accept)
            signs <= in_branch;
        if (start)
            {flip, wrong, far, ends} <= {signs[2], status[3], status[0], begun};
        begun     <= !rst && (start ? in_valid : begun);
        out_valid <= !rst && (done && ends || out_valid && !out_ready);
    end
endmodule
`default_nettype wire
