// SPDX-License-Identifier: Apache-2.0
// Codec of binary angles after kernel_tangent: an axis and the tangent from it make a joint word.
//   out_j = axis + arctan(tangent) = axis + knot + floor(step * offset / 2^11), 512 segments of tangents from -2 to 2
// Formats: in_axis u2.0 quarter turns, in_tangent s2.18; out_j angle of A bits modulo a turn, rounded to nearest; knots
// and steps in units of 2^-(A+2) turn. in_take reads; the word is valid Latency clocks later, until the next in_take.
// With PIPE = 1 in_last comes in the clock before.
// Error: half the sag 0.65 * 2^-18 rad, the offset 2^-18 rad, knot and truncation 2^-(A+2) turn.
// Latency 1 + 2 PIPE, II 1. Source: arc tangent table with linear interpolation. Model: table.ik1
`default_nettype none
module angle_about_axis #(
    parameter A = 18,   // bits of the word, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
    parameter PIPE = 0  // registers behind table and product, 0 or 1 (default 0: fewest clocks)
) (
    input  wire         clk,
    input  wire         in_last,
    input  wire         in_take,
    input  wire [1:0]   in_axis,
    input  wire [19:0]  in_tangent,
    output wire [A-1:0] out_j
);
    localparam D = A + 2;

    // 2^44 (arctan(i / 128) + half the sag, 16 i / (2^14 + i^2)^2), i from 0 to 256. The arc tangent is the sum of the
    // differences arctan z, z = 128 / (2^14 + i (i + 1)). It is then scaled to 2^-D turn, plus half a word and half a
    // unit of truncation.
    localparam KNOTS = 257;
    function [64*KNOTS-1:0] arcs(input integer unused);
        integer    i;
        reg [63:0] n, z, z2, arc;
        begin
            arc = 0;
            for (i = 0; i < KNOTS; i = i + 1) begin
                n = {32'd0, i};
                z = (n << 48) / ((16384 + n * n) * (16384 + n * n));
                arcs[64*i +: 64] = (arc + z >> 14) * 64'd683565276;
                z = (64'd128 << 44) / (16384 + n * (n + 1));
                z2 = (z >> 14) * (z >> 14) >> 30;
                arc = arc + z - (z * z2 >> 30) / 3 + ((z * z2 >> 30) * z2 >> 30) / 5;
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
            next = (64'd3 << 62 - D) + next >> 62 - D;
            chords[i & 511] = {here, next[A-8:0] - here[A-8:0]};
        end
    end

    reg  [1:0]   axis;
    reg  [2*A-7:0] chord;
    reg  [10:0]  place;
    wire [A:0]   knot;
    wire [A-8:0] step, rise;
    wire [10:0]  cut;
    generate
        if (PIPE == 0) begin : g_now
            assign {knot, step} = chord;
            assign {rise, cut} = step * place;
            wire   unused_last = &{1'b0, in_last};
        end else begin : g_registered
            reg [2*A-7:0] held;
            reg [A+3:0]   product;
            assign {knot, step} = held;
            assign {rise, cut} = product;
            always @(posedge clk) begin
                held <= chord;
                if (in_last)
                    product <= step * place;
            end
        end
    endgenerate
    wire [A+1:0] from = {axis[1] ^ (knot[A] && !axis[0]), axis[0] ^ knot[A], knot[A-1:0]};
    wire [1:0]   below;
    assign       {out_j, below} = from + {9'd0, rise};
    wire         unused = &{1'b0, below, cut};
    always @(posedge clk)
        if (in_take) begin
            chord <= chords[in_tangent[19:11]];
            place <= in_tangent[10:0];
            axis  <= in_axis;
        end
endmodule
`default_nettype wire
