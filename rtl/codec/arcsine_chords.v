// SPDX-License-Identifier: Apache-2.0
// Arc sine table for the binary angle of a unit vector: a table segment of the arc sine of the minor coordinate m.
//   arcsin m = out_knot + floor(out_step * d / 2^12), d the 12 bits of m below in_segment, in units of 2^-(A+2) turn
// The instantiating module completes it and drops two bits of the sum, which rounds: knots include half a word, two
// units, and half a unit for the truncation.
// Formats: in_segment s1.8, |m| < 190/256; out_knot s(A+1), out_step u(A-7), held while in_read is low.
// Error: half the sag, at most 2^-18.8 rad for m of nearest_axis; knot and step half a unit each.
// Latency 1, II 1. Source: arc sine table with linear interpolation. Model: conversion.arcsine_knots
`default_nettype none
module arcsine_chords #(
    parameter A = 18  // bits of the word, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
) (
    input  wire         clk,
    input  wire         in_read,  // else the segment is held
    input  wire [8:0]   in_segment,
    output wire [A:0]   out_knot,
    output wire [A-8:0] out_step
);
    // 2^62 arcsin(i / 256) in turns, less half the sag, i from 0 to 190, then constant: 2 arctan t, t = tan of its half
    localparam D = A + 2, KNOTS = 257;
    function [64*KNOTS-1:0] arcs(input integer unused);
        integer    i, k;
        reg [63:0] n, square, root, t, t2, arc;
        begin
            root = 64'd1 << 30;
            for (i = 0; i < KNOTS; i = i + 1) begin
                n = i > 190 ? 64'd190 : {32'd0, i};
                square = (64'd65536 - n * n) << 44;
                for (k = 0; k < 4 && i <= 190; k = k + 1)
                    root = (root + square / root) >> 1;
                t = (n << 52) / ((64'd1 << 30) + root);
                t2 = t * t >> 30;
                arc = 0;
                for (k = 27; k > 0; k = k - 2)
                    arc = (64'd1 << 30) / {32'd0, k} - (t2 * arc >> 30);
                arc = (t * arc >> 29) - (n << 32) / ((root * root >> 30) * root >> 30);
                arcs[64*i +: 64] = arc * 64'd683565276;
            end
        end
    endfunction
    localparam [64*KNOTS-1:0] ARCS = arcs(0);
    reg [2*A-7:0] chords[0:511];  // {knot, step}
    reg [A:0]     here;
    reg [63:0]    next;
    integer       i;
    initial begin
        next = (64'd3 << 62 - D) - ARCS[64*256 +: 64] >> 62 - D;
        for (i = -256; i < 256; i = i + 1) begin
            here = next[A:0];
            next = i < -1 ? -ARCS[64*(-i-1) +: 64] : ARCS[64*(i < 0 ? 0 : i+1) +: 64];
            next = (64'd3 << 62 - D) + next >> 62 - D;  // adds half a word and half a unit of truncation
            chords[i & 511] = {here, next[A-8:0] - here[A-8:0]};
        end
    end

    reg  [2*A-7:0] chord;
    assign         {out_knot, out_step} = chord;
    always @(posedge clk)
        if (in_read)
            chord <= chords[in_segment];
endmodule
`default_nettype wire
