// SPDX-License-Identifier: Apache-2.0
// vector_to_angle for engine_rus_ik_angle, its product formed by a multiplier of the leg: out_place goes into one
// operand's register as the vector comes, out_step is the other one in the clock behind, when in_rise is their product.
// Formats: in_c, in_n s2.16, in_valid: they are there; in_take, a clock later: take the word; out_j angle of A bits
// modulo a turn, nearest; the legs give unit vectors alone, also where a length overflowed. Error: that of
// vector_to_angle. Latency 2.
// Source: the definition; arc sine table with linear interpolation. Model: conversion.vector_to_angle
`default_nettype none
module engine_rus_angle #(
    parameter A = 18  // bits of the word, 10 to 24: as its user's
) (
    input  wire               clk,
    input  wire               in_valid,
    input  wire signed [17:0] in_c,
    input  wire signed [17:0] in_n,
    input  wire               in_take,
    output wire [11:0]        out_place,
    output wire [16:0]        out_step,
    input  wire [28:0]        in_rise,
    output wire [A-1:0]       out_j
);
    // 2^62 arcsin(i / 256) in turns, less half the sag, i from 0 to 190 and no further: 2 arctan of its half-tangent t
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
            next = (64'd3 << 62 - D) + next >> 62 - D;  // half a word and half a unit of truncation more
            chords[i & 511] = {here, next[A-8:0] - here[A-8:0]};
        end
    end

    wire [1:0]         near;
    wire signed [21:0] sine;
    /* verilator lint_off PINCONNECTEMPTY */
    nearest_axis #(.U(16), .E(4)) coordinate (
        .in_c(in_c), .in_n(in_n), .out_none(), .out_axis(near), .out_minor(), .out_sine(sine));
    /* verilator lint_on PINCONNECTEMPTY */

    reg  [2*A-7:0] chord;
    reg  [1:0]     axis;
    wire [A:0]     knot;
    wire [A-8:0]   step;
    assign         {knot, step} = chord;
    reg  [A+1:0]   from;  // and the product: they stay until the next vector's; their sum behind them costs no clock
    reg  [A-8:0]   rise;
    wire [A+1:0]   word = from + {9'd0, rise};
    wire           unused = &{1'b0, sine[21], in_rise, word[1:0]};

    assign out_j = word[A+1:2];

    assign out_place = sine[11:0] & {12{in_valid}};
    assign out_step = {{24-A{1'b0}}, step & {A-7{in_take}}};
    always @(posedge clk) begin
        chord <= chords[sine[20:12]];
        axis  <= near;
        if (in_take) begin
            from <= {axis[1] ^ (knot[A] && !axis[0]), axis[0] ^ knot[A], knot[A-1:0]};
            rise <= in_rise[A+4:12];
        end
    end
endmodule
`default_nettype wire
