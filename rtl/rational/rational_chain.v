// SPDX-License-Identifier: Apache-2.0
// Two or three joints, one after the other, through one decoder and two multipliers: kernel of rational_fk2 and _fk3.
//   x = A c1 - B n1, y = A n1 + B c1 with A = L1 + L2 c2, B = L2 n2; JOINTS = 3: z = y, then y = x n3, x = x c3
// Formats: c, n odd words of 2^-(U+1) (so that ~word is -word and 1.0 needs no extra bit); A, B s(W+2+G) with F+G
// fraction bits; every product is cut to F+G fraction bits; outputs to nearest (ties upward), saturated.
// Cycle  work of the two multipliers                     Cycle  work (JOINTS = 3)
//   0    accept; roots of joint 2 read                     5    a = A c1 - B n1 instead of out_x; roots of joint 3 read
//   1    chords give (c2, n2)                              6    chords give (c3, n3)
//   2    A = L1 + L2 c2, B = L2 n2; roots of joint 1 read  7    out_y = a n3
//   3    chords give (c1, n1)                              8    out_x = a c3; out_valid follows
//   4    out_y (JOINTS = 3: out_z) = A n1 + B c1
//   5    out_x = A c1 - B n1; out_valid follows          Models: rational.fk2, rational.fk3
`default_nettype none
module rational_chain #(
    parameter JOINTS = 2,
    parameter W = 16,
    parameter S = 24,
    parameter U = 16
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
    output wire [W-1:0] out_x,
    output reg  [W-1:0] out_y,
    output reg  [W-1:0] out_z,
    output wire         out_overflow
);
    localparam G = 5, D = 12, N = W + 2 + G, LAST = JOINTS == 3 ? 7 : 4;

    // One-hot: step[i] is cycle i + 1
    reg  [LAST:0] step;
    wire          accept = in_valid && in_ready;
    wire          place = step[1];                 // (L2, 0) turns by joint 2 and moves by L1
    wire          again = JOINTS == 3 && step[4];  // (x, 0) goes on to joint 3
    reg           decode;                          // the multipliers work on the chords
    assign        in_ready = step == 0 && (!out_valid || out_ready);

    reg  [S+1:0] j1, j3;
    wire [U+2:0] wide_knot, thin_knot;
    wire [U-6:0] wide_step, thin_step;
    wire [D-1:0] wide_offset, thin_offset;
    wire         thin_n, neg_c, neg_n;
    spread_chords #(.S(S), .U(U), .D(D)) roots (
        .clk(clk), .in_j(place ? j1 : again ? j3 : in_j2), .out_wide_knot(wide_knot), .out_wide_step(wide_step),
        .out_wide_offset(wide_offset), .out_thin_knot(thin_knot), .out_thin_step(thin_step),
        .out_thin_offset(thin_offset), .out_thin_n(thin_n), .out_neg_c(neg_c), .out_neg_n(neg_n));

    // First multiplier: wide root, A, one product of a turn; second: thin root, B, the other product.
    reg  [N-1:0] a, b;
    reg  [U:0]   wide, thin;  // the roots with their signs, each without its last bit, which is always 1
    reg          swap;        // thin goes to the first multiplier: (c, n) of joint 2, (n, c) then (c, -n) of the others
    wire         turn = !decode && !place;
    wire [N-1:0] right1 = {{(N-U-1){1'b0}}, wide_offset, {(U+1-D){1'b0}}} & {N{decode}}
                        | {2'd0, cfg_l2, {G{1'b0}}} & {N{place}} | a & {N{turn}};
    wire [N-1:0] right2 = {{(N-U-1){1'b0}}, thin_offset, {(U+1-D){1'b0}}} & {N{decode}}
                        | {2'd0, cfg_l2, {G{1'b0}}} & {N{place}} | b & {N{turn}};
    wire [U+1:0] left1 = decode ? {7'h7f, wide_step} : {swap ? thin : wide, 1'b1};
    wire [U+1:0] left2 = decode ? {7'd0, thin_step} : {swap ? wide : thin, 1'b1};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [N+U+1:0] product1 = $signed(left1) * $signed(right1);
    wire signed [N+U+1:0] product2 = $signed(left2) * $signed(right2);
    /* verilator lint_on UNUSEDSIGNAL */
    wire [N-1:0] cut1 = product1[N+U:U+1], cut2 = product2[N+U:U+1];
    // Two adders rather than one behind a selector: the way from the table through a multiplier to `sum` is the longest
    wire [N-1:0] first = cut1 + (decode ? {{(N-U-3){1'b0}}, wide_knot} : {2'd0, cfg_l1, {G{1'b0}}});
    wire [N-1:0] sum = cut1 + cut2;

    /* verilator lint_off UNUSEDSIGNAL */
    wire [U+2:0] second = cut2[U+2:0] + thin_knot;
    /* verilator lint_on UNUSEDSIGNAL */
    wire         neg_wide = thin_n ? neg_c : neg_n, neg_thin = thin_n ? neg_n : neg_c;

    // Rounding and saturation stand behind a register, for the clock's sake: out_y and out_z move on, out_x stays
    reg  [N-1:0] exact;
    reg          over_before;
    wire [W+1:0] nearest = exact[N-1:G] + {{(W+1){1'b0}}, exact[G-1]};
    wire         over = nearest[W+1:W-1] != {3{nearest[W+1]}};
    assign       out_x = over ? {nearest[W+1], {(W-1){!nearest[W+1]}}} : nearest[W-1:0];
    assign       out_overflow = over || over_before;

    always @(posedge clk) begin
        step   <= {step[LAST-1:0], accept};
        decode <= accept || place || again;
        swap   <= decode ? thin_n != step[0] : !swap;
        if (decode || !swap)  // what the first multiplier took comes back negative to the second
            wide <= decode ? {neg_wide, first[U+2:3] ^ {U{neg_wide}}} : ~wide;
        if (decode || swap)
            thin <= decode ? {neg_thin, second[U+2:3] ^ {U{neg_thin}}} : ~thin;
        if (accept) begin
            j1          <= in_j1;
            j3          <= in_j3;
            over_before <= 1'b0;
        end
        if (place || again) begin
            a <= again ? sum : first;
            b <= again ? {N{1'b0}} : cut2;
        end
        if (step[3] || step[LAST-1] || step[LAST])
            exact <= sum;
        if (step[4])
            out_z <= out_x;
        if (step[LAST])
            out_y <= out_x;
        if (step[4] || step[LAST])
            over_before <= out_overflow;
        out_valid <= step[LAST] || (out_valid && !out_ready);
        if (rst) begin
            step      <= {(LAST+1){1'b0}};
            decode    <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
