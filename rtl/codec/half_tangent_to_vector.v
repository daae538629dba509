// SPDX-License-Identifier: Apache-2.0
// Unit vector of a half-tangent word, by one table of both functions and one multiplier:
//   c = +-(1 - t^2) / (1 + t^2), n = +-2 |t| / (1 + t^2)
// The table holds the signs: c has the sign of the half turn, n has that of t too.
// Formats: in_j half-tangent u2.T (rtl/codec/README.md); out_c, out_n s2.U (1.0 is 2^U), rounded to nearest; exact on
// the axes. Error of a coordinate: 1.14 * 2^-U at U = 16, 0.67 * 2^-U at U = 13, half a unit of rounding included.
// Latency 2, 4 at PIPE = 1; II 2: the cosine, then the sine of the accepted word.
// Status: none. Source: stereographic form of the unit circle. Model: conversion.half_tangent_to_vector
`default_nettype none
module half_tangent_to_vector #(
    parameter T = 16,  // fraction bits of the half-tangent, 9 to 19 (default 16, 0.0009 degrees at the x axis)
    parameter U = 16,  // fraction bits of cosine and sine, 12 to 18 (default 16: a vector turns by 0.0006 degrees)
    parameter PIPE = 0 // registers behind table and product, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [T+1:0]        in_j,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  signed [U+1:0] out_c,
    output wire signed [U+1:0] out_n
);
    generate
        if (T < 9 || T > 19 || U < 12 || U > 18 || PIPE < 0 || PIPE > 1) begin : g_illegal
            half_tangent_to_vector_needs_T_from_9_to_19_U_from_12_to_18_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    localparam K = U + 3;  // fraction bits of a root, three of which are rounded off
    // Knot i, |t| = i / 256: half a sag, f''(t) / 2^20, outside the curve, rounded up since the root is truncated,
    // plus half a unit of the result
    function [K+1:0] knot(input integer i, input sine, input negative);
        reg [63:0] n, q, cube, f;
        begin
            n = {32'd0, i};
            q = 64'd65536 + n * n;
            cube = q * q * q >> 32;
            if (sine)
                f = (n << 39) / q + (n * (64'd196608 - n * n) << 4) / cube;
            else if (3 * n * n < 64'd65536)
                f = (64'd65536 - n * n << 30) / q + (64'd65536 - 3 * n * n << 12) / cube;
            else
                f = (64'd65536 - n * n << 30) / q - (3 * n * n - 64'd65536 << 12) / cube;
            if (!f[63] && f > 64'd1 << 30)  // half a sag beyond the axis it is negative
                f = 64'd1 << 30;
            f = (negative ? -f : f) + (64'd1 << 30 - K) - 1 >> 30 - K;
            f = f + 4;
            knot = f[K+1:0];
        end
    endfunction
    reg [2*K-4:0] chords[0:1023];  // {knot, step}: of negative and positive cosines and sines
    reg [K+1:0]   here, next;
    integer       i, j;
    initial
        for (j = 0; j < 4; j = j + 1) begin
            next = knot(0, j[0], j[1]);
            for (i = 0; i < 256; i = i + 1) begin
                here = next;
                next = knot(i + 1, j[0], j[1]);
                chords[256 * j + i] = {here, next[K-6:0] - here[K-6:0]};
            end
        end

    wire   second;  // second clock of a sample: the sine is read
    wire   read, cosine;  // the table is read; out_n is the cosine
    wire   accept = in_valid && in_ready;
    assign in_ready = !second && (!out_valid || out_ready);

    wire           below = in_j[T];                            // t is negative
    wire [19:0]    size = {in_j[T-1:0], {(20-T){1'b0}}} ^ {20{below}};  // |t|, 2^-20 less where it is negative
    reg  [7:0]     segment;
    reg            negative;  // the sine
    reg  [11:0]    place;
    reg  [2*K-4:0] chord;
    wire [K+1:0]   knot_read;
    wire [K-6:0]   step, rise;
    wire [11:0]    cut;
    wire           same;      // a copy of the sign
    wire [2:0]     dropped;
    assign {out_n, dropped} = knot_read + {{7{rise[K-6]}}, rise};
    wire           unused = &{1'b0, same, cut, dropped};

    always @(posedge clk) begin
        if (read)
            chord <= chords[second ? {negative, 1'b1, segment} : {in_j[T+1] ^ below, 1'b0, size[19:12]}];
        if (accept) begin
            segment  <= size[19:12];
            place    <= size[11:0];
            negative <= in_j[T+1];
        end
        if (cosine)
            out_c <= out_n;
    end

    generate
        if (PIPE == 0) begin : g_now
            assign {knot_read, step} = chord;
            assign {same, rise, cut} = $signed(step) * $signed({1'b0, place});
            reg [1:0] stages;  // the cosine is completed; the sine is
            assign    {out_valid, second} = stages;
            assign    read = accept || second;
            assign    cosine = second;
            always @(posedge clk)
                stages <= rst ? 2'b00 : {second || (out_valid && !out_ready), accept};
        end
        if (PIPE == 1) begin : g_registers
            wire           move = !out_valid || out_ready;
            reg  [2*K-4:0] held;
            reg  [11:0]    offset;
            reg  [K+1:0]   start;
            reg  [K+7:0]   product;
            reg  [3:0]     stages;  // the stages that hold a cosine, with the sine one stage behind it; the sine
            wire [K+1:0]   segment_knot;
            assign {segment_knot, step} = held;
            assign knot_read = start;
            assign {same, rise, cut} = product;
            assign second = stages[0];
            assign out_valid = stages[3];
            assign read = move;
            assign cosine = stages[2];  // two samples are two stages apart, so nothing waits in front of it
            always @(posedge clk) begin
                if (move) begin
                    held    <= chord;
                    offset  <= place;
                    start   <= segment_knot;
                    product <= $signed(step) * $signed({1'b0, offset});
                    stages  <= {stages[2:0], accept};
                end
                if (rst)
                    stages <= 4'b0000;
            end
        end
    endgenerate
endmodule
`default_nettype wire
