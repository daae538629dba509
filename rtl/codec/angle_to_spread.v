// SPDX-License-Identifier: Apache-2.0
// Turn-spread of a binary angle: the nearest axis, plus or minus the square of the sine of the angle from it.
// Formats: in_j angle of A bits; out_j turn-spread u2.S modulo 4, rounded to nearest; exact on the axes.
// Error: the angle whose spread is rounded is within 0.39 * 2^-16 rad of the word's; rounding 0.69 LSB at S = 24.
// Latency 3, II 1: a segment of the sine is read, completed, squared. Latency 6 at PIPE = 1.
// Status: none. Source: paper eq. 3, spread = square of the sine. Model: conversion.angle_to_spread
`default_nettype none
module angle_to_spread #(
    parameter A = 18,  // bits of the angle, 12 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
    parameter S = 24,  // fraction bits of the spread, 2 to 24 (default 24, 0.014 degrees at a quadrant border)
    parameter PIPE = 0 // registers behind table and products, 0 or 1 (default 0: fewest clocks)
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
        if (A < 12 || A > 24 || S < 2 || S > 24 || PIPE < 0 || PIPE > 1) begin : g_illegal
            angle_to_spread_needs_A_from_12_to_24_S_from_2_to_24_and_PIPE_0_or_1 rule ();
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
    reg  [1:0]     read_axis;
    localparam N = 3 + 3 * PIPE;  // stages
    reg  [N-1:0]   stages;  // the stages that hold a sample
    wire [K:0]     start_read;
    wire [K-9:0]   step_read;
    assign         {start_read, step_read} = chord;
    wire [S+1:0]   word;
    wire           unused = &{1'b0, near[0]};

    assign out_valid = stages[N-1];
    assign in_ready = !out_valid || out_ready;
    always @(posedge clk) begin
        if (in_ready) begin
            chord     <= chords[in_j[A-3 -: 9]];
            place     <= in_j[B-1:0];
            read_axis <= near[2:1];
            stages    <= {stages[N-2:0], in_valid};
            out_j     <= word;
        end
        if (rst)
            stages <= {N{1'b0}};
    end

    localparam E = 26 - K;  // extra bits of the other factor, so that its one's complement is its negative
    generate
        if (PIPE == 0) begin : g_now
            wire [K-9:0]     rise;
            wire [B-1:0]     cut;
            assign           {rise, cut} = step_read * place;
            reg [1:0]        axis;
            reg signed [K:0] sine;
            // sine |sine|, s1.(K+26); the absolute value of a negative sine is its one's complement with ones below
            wire signed [26:0] size = {sine, {E{1'b0}}} ^ {27{sine[K]}};
            wire signed [K+27:0] square = sine * size;
            wire               back, half;
            wire [S-1:0]       part;
            wire [K+24-S:0]    rest;
            assign             {back, part, half, rest} = square[K+26:0];
            wire [S+1:0]       floor = {axis[1] ^ (back && !axis[0]), axis[0] ^ back, part};
            assign             word = floor + {{(S+1){1'b0}}, half};
            wire               unused_bits = &{1'b0, square[K+27], rest, cut};
            always @(posedge clk)
                if (in_ready) begin
                    sine <= start_read + {9'd0, rise};
                    axis <= read_axis;
                end
        end
        if (PIPE == 1) begin : g_registers
            // One sum has the axis, half an LSB and sine |sine|. That is z^2 2^E of a sine z; of -(z + 1) it is
            // z + 1 - (z + 1)^2 2^E = (~z^2) 2^E + z + 1 - z 2^(E+1); no z takes the 1 to a bit that is kept.
            localparam X = 2 * K + E, R = X - S;  // bits below the axis; those that are rounded off
            localparam [X-1:0] HALF = {{(X-1){1'b0}}, 1'b1} << R - 1;
            reg  [K:0]     start, from;
            reg  [K-9:0]   step;
            reg  [B-1:0]   offset;
            reg  [K+B-9:0] product;
            reg  [1:0]     axis_step, axis_from, axis;
            reg  [K-1:0]   z;
            reg            below, back;
            reg  [2*K-1:0] square;
            reg  [X+1:0]   rest;  // all but the square
            wire [K:0]     sine = from + {9'd0, product[K+B-9:B]};
            wire [K-1:0]   z_below = z & {K{below}};
            wire [X+1:0]   sum = {{2{back}}, square ^ {(2*K){back}}, {E{1'b0}}} + rest;
            assign         word = sum[X+1:R];
            wire           unused_bits = &{1'b0, sum[R-1:0], product[B-1:0]};
            always @(posedge clk)
                if (in_ready) begin
                    {start, step, offset, axis_step} <= {start_read, step_read, place, read_axis};
                    {from, axis_from} <= {start, axis_step};
                    product           <= step * offset;
                    z                 <= sine[K-1:0] ^ {K{sine[K]}};
                    {below, axis}     <= {sine[K], axis_from};
                    square            <= z * z;
                    back              <= below;
                    rest              <= {axis, HALF[X-1:K], z_below} - {{(X+1-K-E){1'b0}}, z_below, {(E+1){1'b0}}};
                end
        end
    endgenerate
endmodule
`default_nettype wire
