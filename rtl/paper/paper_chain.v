// SPDX-License-Identifier: Apache-2.0
// Two links in a plane, and with YAW their plane on a turning base: the core of paper_fk2 and paper_fk3.
//   q3 = Q1 + Q2 -+ 2 sqrt(Q1 Q2 (1-s2)), s' = s2 Q2 / q3, s = s1 (-) s', x y = +-sqrt(q3 (1-s)), +-sqrt(q3 s)
// One multiplier feeds one root: the paper's 1DOF module (Fig. 8), used five times (YAW: six); one squarer.
//   clock         multiplier and root                adder and squarer          (M = ceil((S+1) / R))
//   0 (accept)    -                                  quad = Q2, acc = -+L1
//   1             b = sqrt(Q2 (1-s2))                acc = b -+ L1, h = Q2 s2
//   2             -                                  quad = q3 = acc^2 + h
//   3 .. M+2      R digits of s' = h / q3 each       -
//   M+3, M+4      sqrt(s1 (1-g)), sqrt(g (1-s1))     acc = their difference
//   M+5, M+6      sqrt(q3 s), sqrt(q3 (1-s))         YAW: z, h = qa = q3 - qz; y = sqrt(qa s3); M+7: x
// Formats, error bound, model: README.md, models/quadrance/paper.py (chain)
`default_nettype none
module paper_chain #(
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
    input  wire [S+1:0] in_j1,
    input  wire [S+1:0] in_j2,
    input  wire [S+1:0] in_j3,
    output reg          out_valid,
    input  wire         out_ready,
    output reg  [W-1:0] out_x,
    output reg  [W-1:0] out_y,
    output reg  [W-1:0] out_z,
    output wire         out_overflow
);
    localparam I = W - 1 - F;                   // integer bits of a length
    localparam N = S + 1 > W - 1 ? S + 1 : W - 1;  // digits of the root: lengths uI.(N-I), spreads u0.N
    localparam G = S < 27 - 2*I ? S : 27 - 2*I;    // fraction bits of a quadrance: it fits one 27-bit multiplier
    localparam Q = 2*I + G;
    localparam M = (S + R) / R;                 // clocks of the division
    localparam D = R * M;                       // digits of s'
    localparam C = N - W + 1;                   // bits of a root below the coordinate's LSB
    localparam T = M + 6 + YAW;                 // the last clock

    generate
        if (F < 1 || I < 4 || S < 4 || S > 24 || R < 1 || N > Q || D > Q) begin : g_illegal
            paper_chain_needs_S_from_4_to_24_and_quadrances_of_2_W_minus_F_minus_1_plus_S_bits_no_less_than_W rule ();
        end
    endgenerate

    // Control: the clock of the table above, one-hot
    reg  [T:1] clock;
    reg        busy;
    wire accept = in_valid && in_ready;
    wire law = clock[1], whole = clock[2], divide = |clock[M+2:3], near = clock[M+3], far = clock[M+4];
    wire first = clock[M+5], second = clock[M+6], third = YAW != 0 && clock[T];
    wire yaw = YAW != 0 && (second || third);

    reg  [S+1:0]        j1, j3;
    reg  [1:0]          k2;
    reg                 obtuse;
    reg                 range;    // the tip is out of the coordinates' range
    reg                 rounded;  // or a coordinate was rounded to its end
    reg  [S:0]          spread;   // operand of the multiplier in the clock after
    reg  signed [N+2:0] acc;      // s(I+1).(N-I+1) lengths, s1.(N+1) roots of spreads
    reg  [Q-1:0]        quad, h;
    reg  [D-1:0]        digits;

    // 1 - s2 at the port, then s1, 1 - s1, and with YAW s3, 1 - s3
    wire [S-1:0] fraction = accept ? in_j2[S-1:0] : YAW != 0 && (first || second) ? j3[S-1:0] : j1[S-1:0];
    wire         fall = accept ? !in_j2[S] : YAW != 0 && (first || second) ? second ^ j3[S] : near;

    reg  [S:0]   operand;
    reg          any;  // 1 - f inverts above the lowest 1: as gates cheaper than a chain and a multiplexer
    integer      i;
    always @* begin
        any = 1'b0;
        for (i = 0; i < S; i = i + 1) begin
            operand[i] = fraction[i] ^ (fall & any);
            any = any | fraction[i];
        end
        operand[S] = fall & ~any;
    end

    wire signed [N+2:0]  side = accept ? {2'b00, cfg_l2[W-2:0], {(C+1){1'b0}}} : acc;
    wire [2*N+5:0]       square = side * side;
    wire [Q:0]           sum = {1'b0, square[2*N+1 -: Q]} + {1'b0, h};

    // The rest of Table II in one rule: the base angle of the triangle is b' past b quadrants, b = obtuse, with
    // sin^2 b' = s' or 1 - s'; the tip's direction is joint 1 -+ that angle. A sum is the difference from the
    // complement, one quadrant on, so (-) alone serves all cells; its sign is the borrow.
    wire         add = !k2[1];
    wire         borrow = !acc[N+2];
    wire [1:0]   turn = {add ? obtuse && !borrow : obtuse || borrow, add ^ obtuse ^ borrow};
    wire [1:0]   k = {j1[S+1] ^ turn[1] ^ (j1[S] & turn[0]), j1[S] ^ turn[0]};
    wire         flip = add ^ obtuse ^ near;  // 1 - s' for s'
    wire [N-1:0] tip = square[2*N+1 -: N] ^ {N{j1[S] ^ obtuse ^ add ^ second}};

    wire [Q-1:0] shares;  // g and 1 - g as u0.Q
    generate
        if (Q > D) begin : g_pad
            assign shares = {digits, {(Q-D){1'b0}}} ^ {Q{flip}};
        end else begin : g_full
            assign shares = digits ^ {D{flip}};
        end
    endgenerate
    wire [Q-1:0] left = near || far ? shares : yaw ? h : quad;
    wire [N:0]   right = first || (YAW == 0 && second) ? {1'b0, tip} : {spread, {(N-S){1'b0}}};
    wire [Q+N:0] product = left * right;
    wire [N-1:0] root;
    paper_root #(.N(N)) square_root (.in_d(product[Q+N-1 -: 2*N]), .out_root(root));

    wire [Q-1:0] next_h;
    wire [R-1:0] next_digits;
    paper_quotient #(.Q(Q), .R(R)) quotient (
        .in_rem(h), .in_d(quad), .out_rem(next_h), .out_digits(next_digits));

    // Sign and rounding
    wire         negative = first ? k[1] : k[1] ^ k[0] ^ (YAW != 0 && (j3[S+1] ^ (third && j3[S])));
    wire [W-1:0] word;
    wire         over;
    paper_sign #(.W(W), .N(N)) sign (.in_root(root), .in_negative(negative), .in_over(range),
                                     .out_word(word), .out_over(over));

    always @(posedge clk) begin
        spread <= operand;
        if (accept) begin
            j1    <= in_j1;
            k2    <= in_j2[S +: 2];
            j3    <= in_j3;
            range <= cfg_l1[W-1] || cfg_l2[W-1];
            // root - acc is b - L1, or b + L1 and half an LSB of the root, which centres its truncation
            acc   <= {2'b00, cfg_l1[W-2:0], {(C+1){1'b0}}} ^ {(N+3){in_j2[S+1] ~^ in_j2[S]}};
        end else if (whole)
            acc   <= {(N+3){1'b0}};
        else if (law || near || far)
            acc   <= {2'b00, root, 1'b1} + ~acc;  // root - acc: the bit below the root is the increment
        if (accept || whole) quad <= sum[Q-1:0];
        if (whole) begin
            obtuse <= !acc[N+2] && (k2[1] ^ k2[0]);
            range  <= range || |square[2*N+3 -: 2] || sum[Q];
        end
        if (law || divide || (YAW != 0 && first)) h <= divide ? next_h : quad - product[Q+N-1 -: Q];
        if (clock[T] || rst) h <= {Q{1'b0}};  // the squarer's sum is Q2 alone in the accepting clock
        if (divide) digits <= {digits[D-R-1:0], next_digits};
        if (first)  out_z <= word;
        if (YAW != 0 ? second : first) out_y <= word;
        if (YAW != 0 ? third : second) out_x <= word;
        if (accept) rounded <= 1'b0;
        else if (first || second || third) rounded <= rounded || over;
    end

    assign in_ready = !busy && (!out_valid || out_ready);
    assign out_overflow = range || rounded;
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
    wire unused = &{1'b0, square, product, j1[S+1], in_j3, j3, third, yaw};
endmodule
`default_nettype wire
