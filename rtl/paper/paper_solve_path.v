// SPDX-License-Identifier: Apache-2.0
// This datapath holds the registers and the arithmetic of paper_solve; its control inputs are the operations of that
// cycle table. It has one set of quotient rows, one multiplier that feeds one square root (the paper's 1DOF module),
// and two squarers.
// Formats: coordinates are s(W-F).F, links u(W-F).F below 2^I units, joints u2.S.
// Rounding: every intermediate value is truncated; a joint word is rounded to nearest.
// Status: unreachable, singular, overflow. Source: paper eqs. 18-23, 32-40. Model: paper.solve
`default_nettype none
module paper_solve_path #(
    parameter W   = 16,  // bits of a coordinate and of a link, F + 5 or more (default 16)
    parameter F   = 8,   // fraction bits of a coordinate, 1 or more (default 8)
    parameter S   = 8,   // fraction bits of a joint word, 4 to 24 (default 8, the paper's)
    parameter R   = 3,   // quotient digits a clock, 1 or more with D <= L and D <= 27 (default 3)
    parameter YAW = 0    // 1: joint 3 turns the plane; 0 (default): it does not
) (
    input  wire                clk, rst,
    input  wire        [W-1:0] cfg_l1, cfg_l2,
    input  wire                in_start,
    input  wire signed [W-1:0] in_x, in_y, in_z,
    input  wire                in_elbow,
    input  wire                in_height, in_links, in_cosine,                                      // squarers
    input  wire                in_q2_s2, in_diff_1, in_diff_2,                                      // product
    input  wire                in_divide, in_add_z, in_law, in_bend, in_slack, in_base, in_differ,  // sums
    input  wire                in_j3, in_j2, in_j1,                                                 // word
    output reg         [S+1:0] out_j1, out_j2, out_j3,
    output wire        [3:0]   out_status
);
    localparam I = W - 1 - F;                   // integer bits of a length
    localparam G = S < 2*F ? S : 2*F;           // fraction bits of a quadrance
    localparam Q = 2*I + 2 + G;                 // bits of a quadrance, u(2I+2).G: three squares fit
    localparam B = R < 1 ? 1 : R;               // R, where it is legal
    localparam D = B * ((S + 2 + B) / B);       // digits of a share (a quotient), R of them a clock
    localparam P = D > W ? D : W;               // bits of the multiplier's right factor
    localparam L = 2*I + G > 27 ? 27 : 2*I + G; // bits of the multiplier's left factor
    localparam E = P > 26 ? 26 : P;             // bits of a root to be squared
    localparam Z = (L > P ? L : P) + 1;         // bits of a share, padded for either factor
    localparam N = D > 26 ? 26 : D;             // digits of the root

    generate
        if (F < 1 || I < 4 || S < 4 || S > 24 || R < 1 || D > L || D > 27 || W > L) begin : g_illegal
            paper_solve_needs_S_from_4_to_24_F_from_1_to_W_minus_5_R_from_1_and_shares_and_W_up_to_quadrances rule ();
        end
    endgenerate

    reg  [W-1:0]      z;
    reg               elbow;
    reg  [1:0]        kr;             // quadrant of (x, y)
    reg  [Q-1:0]      den, num, q3;
    reg  [Q:0]        c;              // signed: its sign is that of -cos of joint 2
    reg  [D-1:0]      digits, alpha;  // u0.D
    reg  [N:0]        acc;            // signed
    reg               obtuse;         // the base angle is beyond a quarter turn
    reg               unreachable;
    reg               undefined;      // q3 = 0: joint 1 is held
    reg               still;          // qa = 0: joint 3 is held
    reg               range;          // a link is out of the coordinates' range
    wire [1:0]        ka = YAW != 0 ? {2{z[W-1]}} : kr;  // quadrant of the direction to the tip

    // Squarers
    wire [Z-1:0]      shares = {digits, {(Z-D){1'b0}}};
    wire [P:0]        alphas = {alpha, {(P+1-D){1'b0}}};
    wire [E+1:0]      accs = {acc, {(E+1-N){1'b0}}};
    wire signed [E:0] side_a = in_start ? {{(E+1-W){in_x[W-1]}}, in_x} : in_links ? {{(E+2-W){1'b0}}, cfg_l1[W-2:0]}
                             : in_cosine ? {1'b0, ~shares[Z-1 -: E]} : accs[E+1:1];
    wire signed [W-1:0] side_b = in_start ? in_y : in_height ? z : {1'b0, cfg_l2[W-2:0]};
    wire [2*E+1:0]    square_a = side_a * side_a;
    wire [2*W-1:0]    square_b = side_b * side_b;
    wire [Q-1:0]      qa = square_a[2*F-G +: Q];
    wire [Q-1:0]      qb = square_b[2*F-G +: Q];
    wire [Q-1:0]      sum = (in_add_z ? den : qa) + qb;
    wire [Q:0]        bent = {1'b0, den} + (c ^ {(Q+1){!c[Q]}}) + {{Q{1'b0}}, !c[Q]};  // den - |c|

    // Joint 1: the tip's direction less the base angle, (0, s') or, obtuse, (1, 1 - s'); with the elbow plus it
    wire              borrow = !acc[N];
    wire [1:0]        k1;
    paper_quadrant quadrant (.in_k(ka), .in_plus(elbow), .in_obtuse(obtuse), .in_borrow(borrow), .out_k(k1));
    wire              flip = elbow ^ obtuse ^ in_diff_1;
    wire [L-1:0]      left = in_diff_1 || in_diff_2 ? shares[Z-1 -: L] ^ {L{flip}}
                           : in_q2_s2 ? qb[2*I+G-1 -: L] : {{(L+1-W){1'b0}}, cfg_l1[W-2:0]};
    wire [P-1:0]      right = in_diff_1 || in_diff_2 ? alphas[P:1] ^ {P{ka[0] ^ in_diff_2}}
                            : in_q2_s2 ? ~square_a[2*E-1 -: P] : {{(P+1-W){1'b0}}, cfg_l2[W-2:0]};
    wire [L+P-1:0]    product = left * right;
    wire [L+P:0]      twice = {product, 1'b0};
    wire [N-1:0]      root;
    paper_root #(.N(N)) square_root (.in_d(product[L+P-1 -: 2*N]), .out_root(root));

    wire [Q-1:0]      next_num;
    wire [B-1:0]      next_digits;
    // Out of reach the digits of v and of s' are forced to 0: s2 would be one truncation above 0 there
    wire [D+B-1:0]    longer = {digits, next_digits & {B{!unreachable}}};
    paper_quotient #(.Q(Q), .R(B)) quotient (
        .in_rem(num), .in_d(den), .out_rem(next_num), .out_digits(next_digits));

    // The joint word: s in even quadrants, 1 - s in odd ones; joint 1 has 1 - s after a borrow
    wire [1:0]        k = in_j3 ? kr : in_j2 ? {elbow, elbow ^ c[Q]} : k1;
    wire [S:0]        share = (in_j3 ? digits[D-1 -: S+1] : square_a[2*E-1 -: S+1])
                            ^ {(S+1){in_j3 ? kr[0] : in_j2 ? !k[0] : borrow}};
    wire [S+1:0]      word;
    spread_word #(.S(S)) rounding (.in_k(k), .in_f(share), .out_j(word));

    always @(posedge clk) begin
        if (in_start) begin
            z           <= in_z;
            elbow       <= in_elbow;
            kr          <= {in_y[W-1], in_y[W-1] ^ in_x[W-1]};
            range       <= cfg_l1[W-1] || cfg_l2[W-1];
            still       <= 1'b0;
            unreachable <= 1'b0;
        end
        if (in_start || in_add_z) begin
            den <= sum;
            num <= qb;
        end
        if (in_add_z) still <= ~|den;
        if (in_law) begin
            alpha     <= digits;
            c         <= {1'b0, den} - {1'b0, sum};
            q3        <= den;
            den       <= qa << 1;
            undefined <= ~|den;
        end
        if (in_bend) begin
            obtuse <= c[Q] && bent[Q];
            den    <= twice[2*F-G +: Q];
        end
        if (in_slack) begin
            unreachable <= bent[Q];
            num         <= bent[Q-1:0] & {Q{!bent[Q]}};
        end
        if (in_base) begin
            num <= {2'b00, product[L+P-1 -: Q-2]};
            den <= q3;
            acc <= {(N+1){1'b0}};
        end
        if (in_divide) begin
            num    <= next_num;
            digits <= longer[D-1:0];
        end
        if (in_differ) acc <= {1'b0, root} - acc;
        if (in_j1 && !undefined) out_j1 <= word;
        if (in_j2)               out_j2 <= word;
        if (in_j3 && |den)       out_j3 <= word;
        if (rst) begin
            out_j1 <= {(S+2){1'b0}};
            out_j3 <= {(S+2){1'b0}};
        end
    end
    assign out_status = {1'b0, range, undefined || still, unreachable};
    wire unused = &{1'b0, square_a, square_b, twice, shares, alphas, accs, longer, z};
endmodule
`default_nettype wire
