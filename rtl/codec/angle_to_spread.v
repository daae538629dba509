// SPDX-License-Identifier: Apache-2.0
// Turn-spread of a binary angle: the nearest axis, plus or minus the square of the sine of the angle from it.
// Formats: in_j angle of A bits; out_j turn-spread u2.S modulo 4, rounded to nearest; exact on the axes.
// Error: the angle whose spread is rounded is within 0.39 * 2^-16 rad of the word's; rounding 0.69 LSB at S = 24.
// Latency 3, II 1: a segment of the sine is read, completed, squared.
// Status: none. Source: paper eq. 3, spread = square of the sine. Model: conversion.angle_to_spread
`default_nettype none
module angle_to_spread #(
    parameter A = 18,  // bits of the angle, 12 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
    parameter S = 24   // fraction bits of the spread, 2 to 24 (default 24, 0.014 degrees at a quadrant border)
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [A-1:0] in_j,
    output wire         out_valid,
    input  wire         out_ready,
    output reg  [S+1:0] out_j
);
    generate
        if (A < 12 || A > 24 || S < 2 || S > 24) begin : g_illegal
            angle_to_spread_needs_A_from_12_to_24_and_S_from_2_to_24 rule ();
        end
    endgenerate

    localparam B = A > 11 ? A - 11 : 1;  // bits of an offset

    // 2^30 sin(2 pi i / 2048), i from 0 to 256, by its series; half a sag outside the curve
    localparam K = 18;
    function [K:0] knot(input integer i);
        reg [63:0] x, x2, s;
        begin
            x = {32'd0, i < 0 ? -i : i} * 64'd3373259426 >> 10;
            x2 = x * x >> 30;
            s = (64'd1 << 30) - x2 / 72;
            s = (64'd1 << 30) - (x2 * s >> 30) / 42;
            s = (64'd1 << 30) - (x2 * s >> 30) / 20;
            s = (64'd1 << 30) - (x2 * s >> 30) / 6;
            s = x * s >> 30;
            s = s + (s * 64'd646814 >> 40);
            s = (i < 0 ? -s : s) + (64'd1 << 30 - K) - 1 >> 30 - K;
            knot = s[K:0];
        end
    endfunction
    reg [2*K-8:0] chords[0:511];  // {knot, step}, from -45 to 45 degrees about an axis
    reg [K:0]     here, next;
    integer       i;
    initial begin
        next = knot(-256);
        for (i = -256; i < 256; i = i + 1) begin
            here = next;
            next = knot(i + 1);
            chords[i & 511] = {here, next[K-9:0] - here[K-9:0]};
        end
    end

    wire [2:0]     near = in_j[A-1:A-3] + 3'd1;  // the axis, and the inverted sign of the angle from it
    reg  [2*K-8:0] chord;
    reg  [B-1:0]   place;
    reg  [1:0]     read_axis, axis;
    reg  [2:0]     stages;  // the stages that hold a sample
    wire [K:0]     start;
    wire [K-9:0]   step, rise;
    wire [B-1:0]   cut;
    assign         {start, step} = chord;
    assign         {rise, cut} = step * place;
    reg signed [K:0] sine;
    // sine |sine|, s1.(K+26); the absolute value of a negative sine is its one's complement with 26 - K ones below
    wire signed [26:0] size = {sine, {(26-K){1'b0}}} ^ {27{sine[K]}};
    wire signed [K+27:0] square = sine * size;
    wire               back, half;
    wire [S-1:0]       part;
    wire [K+24-S:0]    rest;
    assign             {back, part, half, rest} = square[K+26:0];
    wire [S+1:0]       floor = {axis[1] ^ (back && !axis[0]), axis[0] ^ back, part};
    wire               unused = &{1'b0, near[0], square[K+27], rest, cut};

    assign out_valid = stages[2];
    assign in_ready = !out_valid || out_ready;
    always @(posedge clk) begin
        if (in_ready) begin
            chord     <= chords[in_j[A-3 -: 9]];
            place     <= in_j[B-1:0];
            read_axis <= near[2:1];
            sine      <= start + {9'd0, rise};
            axis      <= read_axis;
            stages    <= {stages[1:0], in_valid};
            out_j     <= floor + {{(S+1){1'b0}}, half};
        end
        if (rst)
            stages <= 3'b000;
    end
endmodule
`default_nettype wire
