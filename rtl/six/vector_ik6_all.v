// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of six joints in unit vectors, all eight branches of a pose, for an arm with an ortho-parallel
// base and a spherical wrist. Branches 0 to 3 are those of vector_ik6; in branch b + 4 the wrist is turned over, with
// the vectors of joints 4 and 6 and sin q5 negated. The bits of b are those of in_branch of vector_ik6.
// Formats: in_r*, row and column of the rotation matrix, s2.U; in_x, in_y, in_z s(W-F).F; out_cjb, out_njb cosine and
// sine of joint j of branch b, s2.U, rounded to nearest; cfg_* by six.config, cfg_margin and cfg_slack in LSB.
// Error: orientation (6 sqrt(1/2) + 1.07) 2^-U + 3.25 2^-16 rad, at singular poses 8 sqrt(2) 2^-U more; position:
// bounds.six.position, which grows near axes 1 and 2. Latency and II by PIPE: 231, 234, 258.
// Status: unreachable, singular (of the branches whose bits are set in out_far, out_held; a joint without a direction
// holds the last one solved, in the order of branches 0, 2, 1, 3; or a singularity is nearer than the margin), no
// rotation (bit 3: by 16 units of 2^-U).
// Source: Brandstoetter, Angerer, Hofbaur 2014, without an arc function. Model: six.ik6_all
`default_nettype none
module vector_ik6_all #(
    parameter W = 16,   // bits of a coordinate, 4 to 16 (default 16)
    parameter F = 8,    // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,   // fraction bits of a unit vector and of the matrix, 8 to 18 (default 16)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
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
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_c10, out_n10, out_c20, out_n20, out_c30, out_n30,
    output wire signed [U+1:0] out_c40, out_n40, out_c50, out_n50, out_c60, out_n60,
    output wire signed [U+1:0] out_c11, out_n11, out_c21, out_n21, out_c31, out_n31,
    output wire signed [U+1:0] out_c41, out_n41, out_c51, out_n51, out_c61, out_n61,
    output wire signed [U+1:0] out_c12, out_n12, out_c22, out_n22, out_c32, out_n32,
    output wire signed [U+1:0] out_c42, out_n42, out_c52, out_n52, out_c62, out_n62,
    output wire signed [U+1:0] out_c13, out_n13, out_c23, out_n23, out_c33, out_n33,
    output wire signed [U+1:0] out_c43, out_n43, out_c53, out_n53, out_c63, out_n63,
    output wire signed [U+1:0] out_c14, out_n14, out_c24, out_n24, out_c34, out_n34,
    output wire signed [U+1:0] out_c44, out_n44, out_c54, out_n54, out_c64, out_n64,
    output wire signed [U+1:0] out_c15, out_n15, out_c25, out_n25, out_c35, out_n35,
    output wire signed [U+1:0] out_c45, out_n45, out_c55, out_n55, out_c65, out_n65,
    output wire signed [U+1:0] out_c16, out_n16, out_c26, out_n26, out_c36, out_n36,
    output wire signed [U+1:0] out_c46, out_n46, out_c56, out_n56, out_c66, out_n66,
    output wire signed [U+1:0] out_c17, out_n17, out_c27, out_n27, out_c37, out_n37,
    output wire signed [U+1:0] out_c47, out_n47, out_c57, out_n57, out_c67, out_n67,
    output wire [7:0]          out_far,
    output wire [7:0]          out_held,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || U < 8 || U > 18 || PIPE < 0 || PIPE > 2) begin : g_illegal
            vector_ik6_all_needs_W_from_4_to_16_and_F_below_W_and_U_from_8_to_18_and_PIPE_from_0_to_2 rule ();
        end
    endgenerate

    wire        idle, done;
    wire        accept = in_valid && in_ready;
    wire [46:0] op;
    wire [263:0] places;  // of 44 words that the program emits, in the order of its text
    assign      in_ready = idle && (!out_valid || out_ready);
    vector_ik6_all_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_done(done), .out_op(op), .out_places(places));

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

    // Results are shifted in from the top in the order of the program, with joint 5 of a branch whether one is held.
    // Line 62 has no word: it tells whether the triangle of a shoulder is out of reach. The negative of a word, for the
    // wrist that is turned over, follows it: -(n + 1/2) is rounded to -n, where n + 1/2 became n + 1
    reg  [64*(U+2)-1:0] found;
    reg  [3:0]          held;
    reg  [1:0]          far;
    reg                 over, half;
    wire                reach = dest == 6'd62, last = dest == 6'd63, result = dest[5:4] == 2'd3 && !reach;
    wire [U+2:0]        near = (over ? {~found[64*(U+2)-1 -: U+2], 1'b1} : word[26:24-U])
                               + {{(U+1){1'b0}}, over && half, 1'b1};
    wire                unused = &{1'b0, flags[2], near[0]};

    // Of a shoulder the text has joint 1, then joints 2 to 6 of either elbow, the sine of joint 6 before its cosine.
    // The wrist that is turned over has the negative, where there is one
    genvar i, j;
    generate
        for (i = 0; i < 8; i = i + 1) begin : g_branch
            wire [12*(U+2)-1:0] answer;
            for (j = 0; j < 12; j = j + 1) begin : g_word
                localparam [31:0] AT = 22 * (i % 2) + (j < 2 ? j : 10 * (i / 2 % 2) + (j < 10 ? j : 21 - j));
                wire [5:0] place = places[6*AT +: 6] + (i > 3 && j > 5 && j != 8 ? 6'd1 : 6'd0);
                assign answer[(U+2)*j +: U+2] = found[(U+2)*place +: U+2];
            end
            assign out_far[i]  = far[i%2];
            assign out_held[i] = held[2*(i%2)+(i/2)%2];
        end
    endgenerate
    assign {out_n60, out_c60, out_n50, out_c50, out_n40, out_c40, out_n30, out_c30, out_n20, out_c20, out_n10, out_c10}
        = g_branch[0].answer;
    assign {out_n61, out_c61, out_n51, out_c51, out_n41, out_c41, out_n31, out_c31, out_n21, out_c21, out_n11, out_c11}
        = g_branch[1].answer;
    assign {out_n62, out_c62, out_n52, out_c52, out_n42, out_c42, out_n32, out_c32, out_n22, out_c22, out_n12, out_c12}
        = g_branch[2].answer;
    assign {out_n63, out_c63, out_n53, out_c53, out_n43, out_c43, out_n33, out_c33, out_n23, out_c23, out_n13, out_c13}
        = g_branch[3].answer;
    assign {out_n64, out_c64, out_n54, out_c54, out_n44, out_c44, out_n34, out_c34, out_n24, out_c24, out_n14, out_c14}
        = g_branch[4].answer;
    assign {out_n65, out_c65, out_n55, out_c55, out_n45, out_c45, out_n35, out_c35, out_n25, out_c25, out_n15, out_c15}
        = g_branch[5].answer;
    assign {out_n66, out_c66, out_n56, out_c56, out_n46, out_c46, out_n36, out_c36, out_n26, out_c26, out_n16, out_c16}
        = g_branch[6].answer;
    assign {out_n67, out_c67, out_n57, out_c57, out_n47, out_c47, out_n37, out_c37, out_n27, out_c27, out_n17, out_c17}
        = g_branch[7].answer;
    assign out_status = {flags[3], 1'b0, held != 4'd0, far != 2'd0};

    always @(posedge clk) begin
        over <= result && dest[3] && !last;
        half <= word[24-U:0] == {1'b1, {(24-U){1'b0}}};
        if (result || over && !idle)
            found <= {near[U+2:1], found[64*(U+2)-1:U+2]};
        if (reach)
            far <= {flags[0], far[1]};
        if (last)
            held <= {flags[1], held[3:1]};
        out_valid <= !rst && (done || out_valid && !out_ready);
    end
endmodule
`default_nettype wire
