// SPDX-License-Identifier: Apache-2.0
// This core solves a pose of six joints, chooses the branch, and answers joint words of the machine. The program of
// vector_ik6_all solves, then six_choose prefers, in this order, a branch within the joint limits, one in reach, and
// the one nearest to the last answer.
// Formats: in_r*, row and column of the rotation matrix, s2.U; in_x, in_y, in_z s(W-F).F; out_j* s3.A turns; cfg_turned
// to cfg_w6 by keep.machine, other cfg_* by six.config.
// Error: that of vector_ik6_all (bounds.six), whose vectors have 17 bits at U = 18, and 0.89 LSB of an angle. Latency
// and II by PIPE: 288, 295, 319.
// Status: unreachable, singular (of the chosen branch), no rotation (bit 3: the matrix is off by 16 units of 2^-U).
// out_beyond: no branch is within the limits; the answer is not remembered.
// Source: Brandstoetter, Angerer, Hofbaur 2014, without an arc function. Model: keep.six_keep
`default_nettype none
module six_keep #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,   // bits of a turn in a joint word, 12 to 24 (default 18: 0.0014 degrees)
    parameter U = 16,   // fraction bits of a unit vector and of the matrix, 8 to 18 (default 16)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                 clk,
    input  wire                 rst,
    input  wire signed [W+3:0]  cfg_a1,
    input  wire signed [W+3:0]  cfg_b,
    input  wire signed [W+3:0]  cfg_c1,
    input  wire signed [W+3:0]  cfg_c2,
    input  wire signed [W+3:0]  cfg_c4,
    input  wire signed [W+3:0]  cfg_k,
    input  wire signed [26:0]   cfg_cp,
    input  wire signed [26:0]   cfg_np,
    input  wire [24:0]          cfg_r,
    input  wire [21:0]          cfg_e,
    input  wire signed [W-1:0]  cfg_margin,
    input  wire signed [W-1:0]  cfg_slack,
    input  wire [5:0]           cfg_turned,
    input  wire [4:0]           cfg_coupled,
    input  wire [A-1:0]         cfg_z1,
    input  wire [A-1:0]         cfg_z2,
    input  wire [A-1:0]         cfg_z3,
    input  wire [A-1:0]         cfg_z4,
    input  wire [A-1:0]         cfg_z5,
    input  wire [A-1:0]         cfg_z6,
    input  wire signed [14:0]   cfg_low1,
    input  wire signed [14:0]   cfg_low2,
    input  wire signed [14:0]   cfg_low3,
    input  wire signed [14:0]   cfg_low4,
    input  wire signed [14:0]   cfg_low5,
    input  wire signed [14:0]   cfg_low6,
    input  wire signed [14:0]   cfg_high1,
    input  wire signed [14:0]   cfg_high2,
    input  wire signed [14:0]   cfg_high3,
    input  wire signed [14:0]   cfg_high4,
    input  wire signed [14:0]   cfg_high5,
    input  wire signed [14:0]   cfg_high6,
    input  wire [5:0]           cfg_w1,
    input  wire [5:0]           cfg_w2,
    input  wire [5:0]           cfg_w3,
    input  wire [5:0]           cfg_w4,
    input  wire [5:0]           cfg_w5,
    input  wire [5:0]           cfg_w6,
    input  wire                 in_valid,
    output wire                 in_ready,
    input  wire signed [U+1:0]  in_r11,
    input  wire signed [U+1:0]  in_r12,
    input  wire signed [U+1:0]  in_r13,
    input  wire signed [U+1:0]  in_r21,
    input  wire signed [U+1:0]  in_r22,
    input  wire signed [U+1:0]  in_r23,
    input  wire signed [U+1:0]  in_r31,
    input  wire signed [U+1:0]  in_r32,
    input  wire signed [U+1:0]  in_r33,
    input  wire signed [W-1:0]  in_x,
    input  wire signed [W-1:0]  in_y,
    input  wire signed [W-1:0]  in_z,
    output wire                 out_valid,
    input  wire                 out_ready,
    output wire signed [A+2:0]  out_j1,
    output wire signed [A+2:0]  out_j2,
    output wire signed [A+2:0]  out_j3,
    output wire signed [A+2:0]  out_j4,
    output wire signed [A+2:0]  out_j5,
    output wire signed [A+2:0]  out_j6,
    output wire [2:0]           out_branch,
    output wire                 out_beyond,
    output wire [3:0]           out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || A < 12 || A > 24 || U < 8 || U > 18 || PIPE < 0 || PIPE > 2)
        begin : g_illegal
            six_keep_needs_W_from_4_to_16_and_F_below_W_and_A_from_12_to_24_and_U_from_8_to_18_and_PIPE_to_2 rule ();
        end
    endgenerate

    wire          idle, done;
    wire          accept = in_valid && in_ready;
    wire [46:0]   op;
    wire [263:0]  spots;  // of 44 words that the program emits, in the order of its text
    vector_ik6_all_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_done(done), .out_op(op), .out_places(spots));

    wire [3:0]  flags;
    wire [26:0] port, word;
    wire [5:0]  dest;
    six_pose #(.W(W), .U(U), .EDGES(1)) pose (.clk(clk), .in_take(accept),
        .in_matrix({in_r33, in_r32, in_r31, in_r23, in_r22, in_r21, in_r13, in_r12, in_r11}),
        .in_tip({in_z, in_y, in_x}), .in_lengths({cfg_k, cfg_c4, cfg_c2, cfg_c1, cfg_b, cfg_a1}), .in_cp(cfg_cp),
        .in_np(cfg_np), .in_r(cfg_r), .in_e(cfg_e), .in_edges({cfg_slack, cfg_margin}), .in_select(op[43:39]),
        .out_word(port));
    product_engine #(.PIPE(PIPE), .WRIST(28-U), .SLACK(29-U), .MARGINS(1)) engine (.clk(clk), .rst(rst),
        .in_start(accept), .in_run(!idle), .in_op(op), .in_port(port), .in_signs(3'b111), .out_word(word),
        .out_dest(dest), .out_status(flags));

    // Joint 5 of a branch tells whether a joint is held. Line 62 has no word: it tells whether the triangle of a
    // shoulder is out of reach. A word that the program emits with its negative takes the place of both
    localparam C = U < 18 ? U : 17;  // fraction bits of the vectors that are kept, rounded down
    reg  [3:0]  held;
    reg  [1:0]  far;
    reg         over;
    wire        reach = dest == 6'd62, last = dest == 6'd63, result = dest[5:4] == 2'd3 && !reach;
    wire        unused = &{1'b0, flags[2:0], word[24-C:0]};

    // Of a shoulder the text has joint 1, then joints 2 to 6 of either elbow, the sine of joint 6 before its cosine.
    // The wrist that is turned over has joints 4 and 6 half a turn on, and the sine of joint 5 negated
    wire [767:0] places;
    wire [63:0]  mirrored, opposite;
    wire [7:0]   branch_far, branch_held;
    genvar i, k;
    generate
        for (i = 0; i < 8; i = i + 1) begin : g_branch
            for (k = 0; k < 12; k = k + 1) begin : g_word
                localparam [31:0] AT = 22 * (i % 2) + (k < 2 ? k : 10 * (i / 2 % 2) + (k < 10 ? k : 21 - k));
                assign places[96*i + 6*k +: 6] = spots[6*AT +: 6];
            end
            assign places[96*i+72 +: 24] = 24'd0;
            assign mirrored[8*i +: 8] = i > 3 ? 8'b010000 : 8'd0;
            assign opposite[8*i +: 8] = i > 3 ? 8'b101000 : 8'd0;
            assign branch_far[i]  = far[i%2];
            assign branch_held[i] = held[2*(i%2)+(i/2)%2];
        end
    endgenerate
    six_choose #(.A(A), .U(C), .PIPE(PIPE > 0 ? 1 : 0)) choice (.clk(clk), .rst(rst), .cfg_turned(cfg_turned),
        .cfg_coupled(cfg_coupled), .cfg_zero({cfg_z6, cfg_z5, cfg_z4, cfg_z3, cfg_z2, cfg_z1}),
        .cfg_low({cfg_low6, cfg_low5, cfg_low4, cfg_low3, cfg_low2, cfg_low1}),
        .cfg_high({cfg_high6, cfg_high5, cfg_high4, cfg_high3, cfg_high2, cfg_high1}),
        .cfg_weight({cfg_w6, cfg_w5, cfg_w4, cfg_w3, cfg_w2, cfg_w1}), .in_start(accept),
        .in_write(result || over && !idle), .in_word(word[26:25-C]), .in_last(done), .in_places(places),
        .in_mirrored(mirrored), .in_opposite(opposite), .in_far(branch_far), .in_held(branch_held),
        .out_idle(in_ready), .out_valid(out_valid), .out_ready(out_ready),
        .out_words({out_j6, out_j5, out_j4, out_j3, out_j2, out_j1}), .out_branch(out_branch), .out_beyond(out_beyond),
        .out_far(out_status[0]), .out_held(out_status[1]));
    assign out_status[3:2] = {flags[3], 1'b0};

    always @(posedge clk) begin
        over <= result && dest[3] && !last;
        if (reach)
            far <= {flags[0], far[1]};
        if (last)
            held <= {flags[1], held[3:1]};
    end
endmodule
`default_nettype wire
