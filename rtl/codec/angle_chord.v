// SPDX-License-Identifier: Apache-2.0
// Table codec of binary angles: from a joint word to the chord of its sine or cosine in one clock.
//   root = knot + floor(step * offset / 2^15), in units of 2^-K, completed by the user's multiplier and adder
// One table of the whole turn, 2^T chords: no fold and no sign. The cosine is the sine a quarter turn on.
// Formats: in_j angle of A bits; out_chord {knot s(K+1), step s(K-T+4), offset u15}, held while in_read is low.
// Error of a root: knots lie half the sag, (2 pi / 2^T)^2 / 16, outside the curve, so a chord errs by that, next to +-1
// by 1.5 of it; knots and truncation by a unit. Exactly 0 and -1 at the borders of quadrants, and a unit less than 1.
// Latency 1, II 1. Model: codecs.angle_chord
`default_nettype none
module angle_chord #(
    parameter A = 18,  // bits of the word, T+1 to 24: a full turn is 2^A; 18 resolve 0.0014 degrees
    parameter K = 17,  // fraction bits of a root, 14 to 22: 17 and the sign are a word of a multiplier block
    parameter T = 9    // address bits of the table, 9 to 12: 9 for coordinates of 16 bits
) (
    input  wire              clk,
    input  wire              in_read,  // else out_chord stays
    input  wire              in_keep,  // the same word again: only its upper T bits are looked at
    input  wire              in_cos,   // cosine, not sine
    input  wire [A-1:0]      in_j,
    output wire [2*K-T+19:0] out_chord
);
    localparam B = A - T;  // bits of the word below the address
    localparam HALF = 1 << T - 1, QUARTER = 1 << T - 2;

    // 2^30 sin(2 pi i / 2^T), by its series, i from 0 to a quarter turn
    function [63:0] sine(input integer i);
        reg [63:0] x, x2, s;
        begin
            x = {32'd0, i} * 64'd3373259426 >> T - 1;
            x2 = x * x >> 30;
            s = (64'd1 << 30) - x2 / 110;
            s = (64'd1 << 30) - (x2 * s >> 30) / 72;
            s = (64'd1 << 30) - (x2 * s >> 30) / 42;
            s = (64'd1 << 30) - (x2 * s >> 30) / 20;
            s = (64'd1 << 30) - (x2 * s >> 30) / 6;
            sine = x * s >> 30;
        end
    endfunction
    // Knot i, 0 to a turn, in 2^-K: half a sag outside the curve, rounded upward since the root is truncated; 1 is held
    function [K:0] knot(input integer i);
        integer    up;  // steps from the nearest end of the half turn
        reg [63:0] s;
        begin
            up = i & HALF - 1;
            s = sine(up > QUARTER ? HALF - up : up);
            s = s + (s * 64'd646814 >> 18 + 2 * T);
            if (s > 64'd1 << 30)
                s = 64'd1 << 30;
            if ((i & HALF) != 0)
                s = -s;
            s = s + (64'd1 << 30 - K) - 1 >> 30 - K;
            knot = s[K+1:K] == 2'b01 ? {1'b0, {K{1'b1}}} : s[K:0];
        end
    endfunction
    reg [2*K-T+4:0] chords[0:2*HALF-1];  // {knot, step}
    integer         i;
    reg [K:0]       here, next;
    initial begin
        next = 0;
        for (i = 0; i < 2 * HALF; i = i + 1) begin
            here = next;
            next = knot(i + 1);
            chords[i] = {here, next[K-T+3:0] - here[K-T+3:0]};
        end
    end

    wire [1:0]       quarter = {in_j[A-1] ^ (in_cos && in_j[A-2]), in_j[A-2] ^ in_cos};
    reg  [2*K-T+4:0] chord;
    reg  [B-1:0]     offset;
    assign           out_chord = {chord, offset, {(15-B){1'b0}}};
    always @(posedge clk)
        if (in_read) begin
            chord  <= chords[{quarter, in_j[A-3:B]}];
            offset <= in_keep ? offset : in_j[B-1:0];
        end
endmodule
`default_nettype wire
