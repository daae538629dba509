// SPDX-License-Identifier: Apache-2.0
// First half of the turn-spread decoder: in one clock from a joint word to the chords of |cos| and |sin|.
// With f the fraction of the word and v = min(f, 1 - f), sqrt(1 - v) is `wide` and sqrt(v) is `thin`; the user's
// multiplier completes root = knot + (step * offset >> D) in units of 2^-(U+3), D bits of offset.
// 1 - f is taken as the one's complement followed by ones, which costs no adder. `thin` has 512 segments for each
// range of v (tops 2^-1, 2^-5, 2^-10, 2^-15, 2^-21), stored denormalised: no shift behind the multiplier. In the
// last range that S needs every word is a knot, so that even sqrt(2^-S) is exact to the unit.
// Knots lie half the sag above the curve: a chord errs by at most half its sag, 0.2 units of 2^-U.
// out_thin_n: the sine is `thin`; out_neg_c, out_neg_n: signs of cosine and sine.
// Model: rational.roots
`default_nettype none
module spread_chords #(
    parameter S = 24,
    parameter U = 16,
    parameter D = 12
) (
    input  wire         clk,
    input  wire [S+1:0] in_j,
    output reg  [U+2:0] out_wide_knot,
    output reg  [U-6:0] out_wide_step,  // negative
    output reg  [D-1:0] out_wide_offset,
    output reg  [U+2:0] out_thin_knot,
    output reg  [U-6:0] out_thin_step,
    output reg  [D-1:0] out_thin_offset,
    output reg          out_thin_n,
    output reg          out_neg_c,
    output reg          out_neg_n
);
    localparam RANGES = S > 24 ? 5 : 4;

    // Knots of one function, sqrt(a d) with d = 2^-h, a = 0 to 512, in units of 2^-(U+3), each lifted to
    // sqrt(v + d^2 / (32 v)); no lift where the offsets are 0. Rounded up, as the chord is cut. One call a table,
    // by Newton's rule from the knot before: elaboration time is what this is careful with.
    localparam K = U + 3;
    function [513*K-1:0] knots(input integer h);
        integer    a, i;
        reg [63:0] b, square, root;
        begin
            knots = 0;
            root = 64'd1 << U + 3 - (h - 8) / 2;
            for (a = 1; a <= 512; a = a + 1) begin
                b = {32'd0, a};
                square = a < 8 ? b << 2*K - h : ((32 * b * b + 1) << 2*K - h) / (32 * b);
                for (i = a < 16 ? 0 : 6; i < 8; i = i + 1)
                    root = (root + square / root) >> 1;
                b = root + (root * root <= square ? 64'd1 : 64'd0);  // Newton ends at the floor or one above
                knots[K*a +: K] = b[K] ? {K{1'b1}} : b[K-1:0];
            end
        end
    endfunction
    // A constant a range, not one of all: Icarus copies the whole constant for every entry
    localparam [513*K-1:0] WIDE = knots(9), THIN0 = knots(10), THIN1 = knots(14), THIN2 = knots(19), THIN3 = knots(24);
    localparam [513*K-1:0] THIN4 = RANGES > 4 ? knots(30) : {(513*K){1'b0}};
    reg [2*U-3:0] thin [0:512*RANGES-1];  // {step, knot}
    reg [2*U-3:0] wide [0:255];
    integer       i;
    initial begin
        for (i = 0; i < 512; i = i + 1) begin
            thin[i]        = {THIN0[K*(i+1) +: U-5] - THIN0[K*i +: U-5], THIN0[K*i +: K]};
            thin[512 + i]  = {THIN1[K*(i+1) +: U-5] - THIN1[K*i +: U-5], THIN1[K*i +: K]};
            thin[1024 + i] = {THIN2[K*(i+1) +: U-5] - THIN2[K*i +: U-5], THIN2[K*i +: K]};
            thin[1536 + i] = {THIN3[K*(i+1) +: U-5] - THIN3[K*i +: U-5], THIN3[K*i +: K]};
            if (RANGES > 4)
                thin[512 * (RANGES - 1) + i] = {THIN4[K*(i+1) +: U-5] - THIN4[K*i +: U-5], THIN4[K*i +: K]};
        end
        for (i = 0; i < 256; i = i + 1)
            wide[i] = {WIDE[K*(511-i) +: U-5] - WIDE[K*(512-i) +: U-5], WIDE[K*(512-i) +: K]};
    end

    localparam T = 34;  // 2 v left-aligned in a word that holds every S
    wire         fold = in_j[S-1];
    wire [T-1:0] v = {in_j[S-2:0] ^ {(S-1){fold}}, {(T-S+1){fold}}};
    wire         past4 = v[T-1:T-4] == 0, past9 = v[T-1:T-9] == 0;
    wire         past14 = v[T-1:T-14] == 0, past20 = RANGES == 5 && v[T-1:T-20] == 0;
    wire [2:0]   range = {past20, past9 && !past20, past9 ? past14 && !past20 : past4};
    reg  [8+D:0] segment;
    always @*
        case (range)
            3'd0: segment = v[T-1:T-9-D];
            3'd1: segment = v[T-5:T-13-D];
            3'd2: segment = v[T-10:T-18-D];
            3'd3: segment = {v[T-15:0], {(D-11){fold}}};
            default: segment = {v[T-21:0], {(D-5){fold}}};
        endcase
    always @(posedge clk) begin
        {out_thin_step, out_thin_knot} <= thin[{range[(RANGES+3)/4:0], segment[8+D:D]}];
        {out_wide_step, out_wide_knot} <= wide[v[T-1:T-8]];
        out_thin_offset <= segment[D-1:0];
        out_wide_offset <= v[T-9:T-8-D];
        out_thin_n      <= fold == in_j[S];
        out_neg_c       <= in_j[S+1] ^ in_j[S];
        out_neg_n       <= in_j[S+1];
    end
endmodule
`default_nettype wire
