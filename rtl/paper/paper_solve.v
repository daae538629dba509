// SPDX-License-Identifier: Apache-2.0
// The triangle of two links solved backwards, and with YAW its plane: paper_ik2 and paper_ik3. Model: paper.solve
//   s3 = qy / qa, sa = qz / q3, s2 = 1 - (q3 - Q1 - Q2)^2 / (4 Q1 Q2), s' = s2 Q2 / q3, s1 = sa (-) s'
// One row set divides, M = ceil((S+3) / R) clocks each, sa in the first M after num; one multiplier feeds one root.
//   clock          squarers, multiplier                   adders                            rows
//   0 (accept)     x^2, y^2                               den = x^2 + y^2                   num = y^2
//   YAW: 1 .. M+1  -, then z^2                            den = qa + z^2                    s3 -> j3; num = z^2
//   M+1, +2, +3    Q1, Q2; L1 L2; -                       c = q3 - Q1 - Q2; 2 Q1 - |c| < 0?  num = 2 L1 L2 - |c|
//   M+4 .. 2M+3    -                                      -                                 v = 1 - |c| / (2 L1 L2)
//   2M+4           (1 - v)^2 -> j2, num = Q2 s2           -                                 den = q3
//   2M+5 .. 3M+4   -                                      -                                 s'
//   3M+5, +6, +7   sqrt(sa (1-g)), sqrt(g (1-sa)); square  acc = their difference           -> j1
`default_nettype none
module paper_solve #(
    parameter W   = 16,
    parameter F   = 8,
    parameter S   = 8,
    parameter R   = 3,
    parameter YAW = 0
) (
    input  wire         clk,
    input  wire         rst,
    input  wire [W-1:0] cfg_l1,
    input  wire [W-1:0] cfg_l2,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [W-1:0] in_x,
    input  wire [W-1:0] in_y,
    input  wire [W-1:0] in_z,
    input  wire         in_elbow,
    output reg          out_valid,
    input  wire         out_ready,
    output reg  [S+1:0] out_j1,
    output reg  [S+1:0] out_j2,
    output reg  [S+1:0] out_j3,
    output wire [3:0]   out_status
);
    localparam I  = W - 1 - F;                       // integer bits of a length
    localparam G  = S < 2*F ? S : 2*F;               // fraction bits of a quadrance
    localparam Q  = 2*I + 2 + G;                     // u(2I+2).G: three squares fit
    localparam M  = (S + 2 + R) / R;                 // clocks of a division
    localparam D  = R * M;                           // digits of a share
    localparam P  = D > W ? D : W;                   // bits of the multiplier's right factor
    localparam L  = 2*I + G > 27 ? 27 : 2*I + G;     // and of its left one
    localparam E  = P > 26 ? 26 : P;                 // bits of a root to be squared
    localparam Z  = (L > P ? L : P) + 1;
    localparam N  = D > 26 ? 26 : D;                 // digits of the root
    localparam H  = YAW != 0 ? M + 1 : 0;            // clocks for the yaw
    localparam T  = H + 3*M + 7;                     // the last clock

    generate
        if (F < 1 || I < 4 || S < 4 || S > 24 || R < 1 || D > L || D > 27) begin : g_illegal
            paper_solve_needs_S_from_4_to_24_F_from_1_to_W_minus_5_and_shares_no_longer_than_quadrances rule ();
        end
    endgenerate

    // Control: the clock of the table above, one-hot
    reg  [T:1] clock;
    reg        busy;
    wire accept = in_valid && in_ready;
    wire law = clock[H+M+1], bend = clock[H+M+2], slack = clock[H+M+3], elbow = clock[H+2*M+4];
    wire near = clock[T-2], far = clock[T-1], last = clock[T];
    wire yaw, yaw_divide;
    wire divide = |clock[H+M:H+1] || |clock[H+2*M+3:H+M+4] || |clock[H+3*M+4:H+2*M+5] || yaw_divide;
    generate
        if (YAW != 0) begin : g_yaw
            assign yaw = clock[M+1];
            assign yaw_divide = |clock[M:1];
        end else begin : g_flat
            assign yaw = 1'b0;
            assign yaw_divide = 1'b0;
        end
    endgenerate

    reg  [W-1:0]      z;
    reg               folded;       // in_elbow
    reg  [1:0]        kr;           // quadrant of (x, y)
    reg  [Q-1:0]      den, num, q3;
    reg  [Q:0]        c;            // signed: its sign is that of -cos of the joint
    reg  [D-1:0]      digits, alpha;
    reg  [N:0]        acc;          // signed
    reg               obtuse, unreachable, undefined, still, range;
    wire [1:0]        ka = YAW != 0 ? {2{z[W-1]}} : kr;  // quadrant of the direction to the tip

    // Squarers
    wire [Z-1:0]      shares = {digits, {(Z-D){1'b0}}};
    wire [P:0]        alphas = {alpha, {(P+1-D){1'b0}}};
    wire [E+1:0]      accs = {acc, {(E+1-N){1'b0}}};
    wire signed [E:0] side_a = accept ? {{(E+1-W){in_x[W-1]}}, in_x} : law ? {{(E+2-W){1'b0}}, cfg_l1[W-2:0]}
                             : elbow ? {1'b0, ~shares[Z-1 -: E]} : accs[E+1:1];
    wire signed [W-1:0] side_b = accept ? in_y : yaw ? z : {1'b0, cfg_l2[W-2:0]};
    wire [2*E+1:0]    square_a = side_a * side_a;
    wire [2*W-1:0]    square_b = side_b * side_b;
    wire [Q-1:0]      qa = square_a[2*F-G +: Q];
    wire [Q-1:0]      qb = square_b[2*F-G +: Q];
    wire [Q-1:0]      sum = (yaw ? den : qa) + qb;
    wire [Q:0]        bent = {1'b0, den} + (c ^ {(Q+1){!c[Q]}}) + {{Q{1'b0}}, !c[Q]};  // den - |c|

    // The tip's direction less the base angle, or plus it: again one difference, see paper_chain
    wire              borrow = !acc[N];
    wire [1:0]        turn = {folded ? obtuse && !borrow : obtuse || borrow, folded ^ obtuse ^ borrow};
    wire [1:0]        k1 = {ka[1] ^ turn[1] ^ (ka[0] & turn[0]), ka[0] ^ turn[0]};
    wire              flip = folded ^ obtuse ^ near;
    wire [L-1:0]      left = near || far ? shares[Z-1 -: L] ^ {L{flip}}
                           : elbow ? qb[2*I+G-1 -: L] : {{(L+1-W){1'b0}}, cfg_l1[W-2:0]};
    wire [P-1:0]      right = near || far ? alphas[P:1] ^ {P{ka[0] ^ far}}
                            : elbow ? ~square_a[2*E-1 -: P] : {{(P+1-W){1'b0}}, cfg_l2[W-2:0]};
    wire [L+P-1:0]    product = left * right;
    wire [L+P:0]      twice = {product, 1'b0};
    wire [N-1:0]      root;
    paper_root #(.N(N)) square_root (.in_d(product[L+P-1 -: 2*N]), .out_root(root));

    wire [Q-1:0]      next_num;
    wire [R-1:0]      next_digits;
    paper_quotient #(.Q(Q), .R(R)) quotient (
        .in_rem(num), .in_d(den), .out_rem(next_num), .out_digits(next_digits));

    // A share in its quadrant, rounded to the word: the carry steps into the next quadrant
    wire [1:0]        k = yaw ? kr : elbow ? {folded, folded ^ c[Q]} : k1;
    wire [S:0]        share = (yaw ? digits[D-1 -: S+1] : square_a[2*E-1 -: S+1])
                            ^ {(S+1){yaw ? kr[0] : elbow ? !k[0] : borrow}};
    wire [S+1:0]      word = {k, share[S:1]} + {{(S+1){1'b0}}, share[0]};

    always @(posedge clk) begin
        if (accept) begin
            z      <= in_z;
            folded <= in_elbow;
            kr     <= {in_y[W-1], in_y[W-1] ^ in_x[W-1]};
            range  <= cfg_l1[W-1] || cfg_l2[W-1];
            still  <= 1'b0;
        end
        if (accept || yaw) begin
            den <= sum;
            num <= qb;
        end
        if (yaw) still <= ~|den;
        if (law) begin
            alpha     <= digits;
            c         <= {1'b0, den} - {1'b0, sum};
            q3        <= den;
            den       <= qa << 1;
            undefined <= ~|den;
        end
        if (bend) begin
            obtuse <= c[Q] && bent[Q];
            den    <= twice[2*F-G +: Q];
        end
        if (slack) begin
            unreachable <= bent[Q];
            num         <= bent[Q-1:0] & {Q{!bent[Q]}};
        end
        if (elbow) begin
            num    <= {2'b00, product[L+P-1 -: Q-2]};
            den    <= q3;
            acc    <= {(N+1){1'b0}};
            out_j2 <= word;
        end
        if (divide) begin
            num    <= next_num;
            digits <= {digits[D-R-1:0], next_digits};
        end
        if (near || far) acc <= {1'b0, root} - acc;
        if (last && !undefined) out_j1 <= word;
        if (yaw && |den)        out_j3 <= word;
        if (rst) begin
            out_j1 <= {(S+2){1'b0}};
            out_j3 <= {(S+2){1'b0}};
        end
    end

    assign in_ready = !busy && (!out_valid || out_ready);
    assign out_status = {1'b0, range, undefined || still, unreachable};
    always @(posedge clk) begin
        clock     <= {clock[T-1:1], accept};
        busy      <= accept || (busy && !clock[T]);
        out_valid <= clock[T] || (out_valid && !out_ready);
        if (rst) begin
            clock     <= {T{1'b0}};
            busy      <= 1'b0;
            out_valid <= 1'b0;
        end
    end
    wire unused = &{1'b0, square_a, square_b, twice, shares, alphas, accs, z, in_z};
endmodule
`default_nettype wire
