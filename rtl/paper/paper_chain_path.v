// SPDX-License-Identifier: Apache-2.0
// This datapath holds the registers and the arithmetic of paper_chain; its control inputs are the operations of that
// cycle table. One multiplier feeds one square root, the paper's 1DOF module (Fig. 8a). There are one squarer and a
// divider of R digits a clock.
// Formats: joints are u2.S, links u(W-F).F below 2^I units, coordinates s(W-F).F.
// Rounding: every intermediate value is truncated; a coordinate is rounded to nearest where N >= W, else truncated.
// Status: out_overflow. Source: paper eqs. 11-17, 24-31. Model: paper.chain
`default_nettype none
module paper_chain_path #(
    parameter W = 16,  // bits of a coordinate and of a link, F + 5 or more (default 16)
    parameter F = 8,   // fraction bits of a coordinate, 1 or more (default 8)
    parameter S = 8,   // fraction bits of a joint word, 4 to 24 with N and D at most Q (default 8, the paper's)
    parameter R = 3    // quotient digits a clock, 1 or more (default 3: paper_chain relies on it)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W-1:0] cfg_l1, cfg_l2,
    input  wire                in_start,
    input  wire        [S+1:0] in_j1, in_j2, in_j3,
    input  wire                in_diff_1, in_diff_2, in_sine, in_cosine, in_turn,         // product
    input  wire                in_law, in_q3, in_divide, in_differ, in_qa, in_clear,      // sums
    input  wire        [1:0]   in_next,                                                   // spread register
    input  wire                in_x, in_y, in_z,                                          // coordinate
    output reg  signed [W-1:0] out_x, out_y, out_z,
    output wire                out_overflow
);
    localparam I = W - 1 - F;                      // integer bits of a length
    localparam N = S + 1 > W - 1 ? S + 1 : W - 1;  // digits of the root: lengths uI.(N-I), spreads u0.N
    localparam E = S < 2*N + 2 - 2*I ? S : 2*N + 2 - 2*I;  // at most the fraction bits of a squared length
    localparam G = E < 27 - 2*I ? E : 27 - 2*I;    // fraction bits of a quadrance, which fits one 27-bit multiplier
    localparam Q = 2*I + G;                        // bits of a quadrance, u(2I).G
    localparam B = R < 1 ? 1 : R;                  // R, where it is legal
    localparam M = (S + B) / B;                    // clocks of the division
    localparam D = B * M;                          // digits of s'
    localparam C = N - W + 1;                      // bits of a root below the coordinate's LSB

    generate
        if (F < 1 || I < 4 || S < 4 || S > 24 || R < 1 || N > Q || D > Q) begin : g_illegal
            paper_chain_needs_S_from_4_to_24_and_quadrances_of_2_W_minus_F_minus_1_plus_S_bits_no_less_than_W rule ();
        end
    endgenerate

    reg  [S+1:0]        j1, j3;
    reg  [1:0]          k2;       // quadrant of joint 2
    reg                 obtuse;   // the base angle is beyond a quarter turn
    reg                 range;    // a link or the tip is out of the coordinates' range
    reg                 rounded;  // a coordinate was saturated by its rounding
    reg  [S:0]          spread;   // right factor, u1.S
    reg  signed [N+2:0] acc;      // s(I+1).(N-I+1) lengths, s1.(N+1) roots of spreads
    reg  [Q-1:0]        quad, h;  // Q2, then q3; Q2 s2, then the remainder, then qa
    reg  [D-1:0]        digits;   // s', u0.D

    // The spread register loads 1 - s2 from the port, then s1, 1 - s1, and with YAW s3, 1 - s3
    wire [S-1:0] fraction = in_start ? in_j2[S-1:0] : in_next[1] ? j3[S-1:0] : j1[S-1:0];
    wire         fall = in_start ? !in_j2[S] : in_next[0] ^ (in_next[1] && j3[S]);
    wire [S:0]   operand;
    paper_complement #(.S(S)) complement (.in_f(fraction), .in_fall(fall), .out_s(operand));

    wire signed [N+2:0]  side = in_start ? {2'b00, cfg_l2[W-2:0], {(C+1){1'b0}}} : acc;
    wire [2*N+5:0]       square = side * side;
    wire [Q:0]           sum = {1'b0, square[2*N+1 -: Q]} + {1'b0, h};

    // The tip's direction: joint 1 plus or minus the base angle, which is (0, s') or, obtuse, (1, 1 - s')
    wire         plus = !k2[1];
    wire [1:0]   k;
    paper_quadrant quadrant (.in_k(j1[S +: 2]), .in_plus(plus), .in_obtuse(obtuse), .in_borrow(!acc[N+2]), .out_k(k));
    wire [N-1:0] tip = square[2*N+1 -: N] ^ {N{j1[S] ^ obtuse ^ plus ^ in_cosine}};  // s or 1 - s

    wire [Q-1:0] shares;  // g or 1 - g as u0.Q
    wire         flip = plus ^ obtuse ^ in_diff_1;
    generate
        if (Q > D) begin : g_pad
            assign shares = {digits, {(Q-D){1'b0}}} ^ {Q{flip}};
        end else begin : g_full
            assign shares = digits ^ {D{flip}};
        end
    endgenerate
    wire [Q-1:0] left = in_diff_1 || in_diff_2 ? shares : in_turn ? h : quad;
    wire [N:0]   right = in_sine || in_cosine ? {1'b0, tip} : {spread, {(N-S){1'b0}}};
    wire [Q+N:0] product = left * right;
    wire [N-1:0] root;
    paper_root #(.N(N)) square_root (.in_d(product[Q+N-1 -: 2*N]), .out_root(root));

    wire [Q-1:0]   next_h;
    wire [B-1:0]   next_digits;
    wire [D+B-1:0] longer = {digits, next_digits};
    paper_quotient #(.Q(Q), .R(B)) quotient (
        .in_rem(h), .in_d(quad), .out_rem(next_h), .out_digits(next_digits));

    // Sign and rounding: z or y of the plane has the sign of sin, the others that of cos and of joint 3
    wire                negative = in_sine ? k[1] : k[1] ^ k[0] ^ j3[S+1] ^ (in_x && j3[S]);
    wire signed [W-1:0] word;
    wire                over;
    paper_sign #(.W(W), .N(N)) sign (.in_root(root), .in_negative(negative), .in_over(range),
                                     .out_word(word), .out_over(over));

    always @(posedge clk) begin
        spread <= operand;
        if (in_start) begin
            j1    <= in_j1;
            k2    <= in_j2[S +: 2];
            j3    <= in_j3;
            range <= cfg_l1[W-1] || cfg_l2[W-1];
            // root - acc is b - L1, or b + L1 and half an LSB of the root, which centres its truncation
            acc   <= {2'b00, cfg_l1[W-2:0], {(C+1){1'b0}}} ^ {(N+3){in_j2[S+1] ~^ in_j2[S]}};
        end else if (in_q3)
            acc   <= {(N+3){1'b0}};
        else if (in_law || in_differ)
            acc   <= {2'b00, root, 1'b1} + ~acc;  // root - acc: the bit below the root is the increment
        if (in_start || in_q3) quad <= sum[Q-1:0];
        if (in_q3) begin
            obtuse <= !acc[N+2] && (k2[1] ^ k2[0]);
            range  <= range || |square[2*N+3 -: 2] || sum[Q];
        end
        if (in_law || in_divide || in_qa) h <= in_divide ? next_h : quad - product[Q+N-1 -: Q];
        if (in_clear || rst) h <= {Q{1'b0}};
        if (in_divide) digits <= longer[D-1:0];
        if (in_z) out_z <= word;
        if (in_y) out_y <= word;
        if (in_x) out_x <= word;
        if (in_start) rounded <= 1'b0;
        else if (in_x || in_y || in_z) rounded <= rounded || over;
    end
    assign out_overflow = range || rounded;
    wire unused = &{1'b0, square, product, longer, j1[S+1], j3};
endmodule
`default_nettype wire
