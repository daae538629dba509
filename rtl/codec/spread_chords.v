// SPDX-License-Identifier: Apache-2.0
// Table codec of turn-spreads: from a joint word to table segments of |cos| and |sin|.
//   f is the fraction of the word, v = min(f, 1 - f); major = sqrt(1 - v), minor = sqrt(v), each knot + step * offset
// Formats: in_j turn-spread u2.S; out_chords is the port of the table codecs (rtl/codec/README.md). 1 - f is the one's
// complement of f with ones below. The minor root has ranges of v with tops 2^-1, 2^-5, 2^-9, 2^-15, 2^-21, powers of 4
// apart: one table of 512 segments serves all, and spread_minor shifts the root. In the last range every word is a
// knot.
// Error of a completed root: 0.83 * 2^-U at U = 16, of which half the sag is 0.18 (bounds.codec.spread_chord).
// Latency CLOCKS, II 1. Source: paper, eqs. 51 and 52; tables with linear interpolation. Model: codecs.spread_chords
`default_nettype none
module spread_chords #(
    parameter S = 24,  // fraction bits of the word, 10 to 30 (default 24, 0.014 degrees at a quadrant border)
    parameter U = 16,  // fraction bits of a root, 13 to 18 (default 16)
    parameter CLOCKS = 2  // 1, or 2 with a register after the memories (default 2)
) (
    input  wire            clk,
    input  wire [S+1:0]    in_j,
    output wire [4*U+29:0] out_chords
);
    localparam D = 12;  // bits of an offset
    localparam FIFTH = S > 24;  // the last range is needed

    // Knots of one function, sqrt(a d) with d = 2^-h, a = 0 to 512, in units of 2^-(U+3), each lifted to
    // sqrt(v + d^2 / (32 v)), except where the offsets are 0. They are rounded up, since the root is truncated. One
    // call for each table, by Newton's rule from the previous knot, keeps elaboration short.
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
    localparam [513*K-1:0] MAJOR = knots(9), MINOR = knots(10);
    reg [2*U+1:0] minor [0:511];  // {step, knot}
    reg [2*U-3:0] major [0:255];
    integer       i;
    initial begin
        for (i = 0; i < 512; i = i + 1)
            minor[i] = {MINOR[K*(i+1) +: U-1] - MINOR[K*i +: U-1], MINOR[K*i +: K]};
        for (i = 0; i < 256; i = i + 1)
            major[i] = {MAJOR[K*(511-i) +: U-5] - MAJOR[K*(512-i) +: U-5], MAJOR[K*(512-i) +: K]};
    end

    localparam T = 34;  // 2 v left-aligned in a word that holds every S
    wire         fold = in_j[S-1];
    wire [T-1:0] v = {in_j[S-2:0] ^ {(S-1){fold}}, {(T-S+1){fold}}};
    wire         past4 = v[T-1:T-4] == 0, past8 = v[T-1:T-8] == 0;
    wire         past14 = v[T-1:T-14] == 0, past20 = FIFTH && v[T-1:T-20] == 0;
    wire [2:0]   range = {past20, past8 && !past20, past8 ? past14 && !past20 : past4};
    reg  [8+D:0] segment;
    always @*
        case (range)
            3'd0: segment = v[T-1:T-9-D];
            3'd1: segment = v[T-5:T-13-D];
            3'd2: segment = v[T-9:T-17-D];
            3'd3: segment = {v[T-15:0], {(D-11){fold}}};
            default: segment = {v[T-21:0], {(D-5){fold}}};
        endcase
    reg  [4*U+29:0] read;
    always @(posedge clk)
        read <= {fold == in_j[S], in_j[S+1] ^ in_j[S], in_j[S+1], range, major[v[T-1:T-8]], v[T-9:T-8-D],
                 minor[segment[8+D:D]], segment[D-1:0]};
    generate
        if (CLOCKS == 2) begin : g_register
            reg [4*U+29:0] chords;
            assign         out_chords = chords;
            always @(posedge clk) chords <= read;
        end else begin : g_memory
            assign out_chords = read;
        end
    endgenerate
endmodule
`default_nettype wire
