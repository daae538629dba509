// SPDX-License-Identifier: Apache-2.0
// This core finds the tip of one joint the paper's way: quadrance times spread, then the square root.
//   x = +-sqrt(Q1 (1 - s1)), y = +-sqrt(Q1 s1), Q1 = cfg_l1^2, signs by quadrant
// Formats: in_j1 is a turn-spread u2.S, cfg_l1 is u(W-F).F; out_x and out_y are s(W-F).F, nearest, ties away from zero.
// Error: a coordinate is within 1/2 LSB, because Q1 s is exact down to the bit that decides the rounding.
// Latency and II: 2. The same multipliers and the same square root serve f, then 1 - f.
// Status: overflow (a magnitude rounds to 2^(W-1) LSB or more and reads +-(2^(W-1) - 1)).
// Source: paper eqs. 51-52, Fig. 8, Table I read as turn-spread (odd quadrants exchange s and 1 - s). Model: paper.fk1
`default_nettype none
module paper_fk1 #(
    parameter W = 16,  // bits of a coordinate and of the link, 4 to 18 (default 16: Q7.8 is the paper's word)
    parameter F = 8,   // fraction bits of a coordinate, 0 to W - 1 (default 8)
    parameter S = 8    // fraction bits of the joint word, 2 to 24 (default 8, the paper's)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W-1:0] cfg_l1,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire        [S+1:0] in_j1,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output reg  signed [W-1:0] out_y,
    output wire        [3:0]   out_status
);
    generate
        if (W < 4 || W > 18 || F < 0 || F >= W || S < 2 || S > 24) begin : g_illegal
            paper_fk1_needs_W_from_4_to_18_F_below_W_and_S_from_2_to_24 rule ();
        end
    endgenerate

    // In the accepting clock the root is that of Q1 f, from the port; in the clock of `second` it is that of Q1 (1 - f)
    reg         second;
    reg [1:0]   kept_k;
    reg [S:0]   kept_s;  // 1 - f
    reg         over_x, over_y;

    wire [1:0]  k = second ? kept_k : in_j1[S +: 2];
    wire [S:0]  s = second ? kept_s : {1'b0, in_j1[S-1:0]};

    // Q1 s is formed as L1 (L1 s), so that no factor is wider than a DSP block at S = 8
    wire [W+S:0]     ls = cfg_l1 * s;
    wire [2*W+S-1:0] q  = cfg_l1 * ls;
    wire [W-1:0]     root;  // one bit more than the magnitude; that bit rounds
    paper_root #(.N(W)) square_root (.in_d(q[2*W+S-3 : S-2]), .out_root(root));
    wire             unused = &{1'b0, q};

    // f belongs to y in even quadrants and to x in odd ones
    wire         to_x = second ^ k[0];
    wire         beyond = |q[2*W+S-1 -: 2];
    wire                rounded;
    wire signed [W-1:0] word;
    paper_sign #(.W(W), .N(W)) sign (.in_root(root), .in_negative(k[1] ^ (to_x & k[0])), .in_over(beyond),
                                     .out_word(word), .out_over(rounded));
    wire         over = beyond || rounded;

    wire         accept = in_valid && in_ready;
    always @(posedge clk) begin
        if (accept) begin
            kept_k <= in_j1[S +: 2];
            kept_s <= {1'b1, {S{1'b0}}} - {1'b0, in_j1[S-1:0]};
        end
        if (accept || second) begin
            if (to_x) {over_x, out_x} <= {over, word};
            else      {over_y, out_y} <= {over, word};
        end
    end

    assign in_ready = !second && (!out_valid || out_ready);
    assign out_status = {1'b0, over_x || over_y, 2'b00};
    always @(posedge clk) begin
        second    <= accept;
        out_valid <= second || (out_valid && !out_ready);
        if (rst) begin
            second    <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
