// SPDX-License-Identifier: Apache-2.0
// Half-tangent of a unit vector, t = n / (1 + c) where c >= 0, else of the opposite vector: the nearer axis plus what
// the minor coordinate adds to it, by one table and without a division.
// Formats: in_c, in_n s2.U (1.0 is 2^U); out_j half-tangent u2.T modulo 4 (rtl/codec/README.md), rounded to nearest.
// Error for the minor coordinate as it is given: 0.92 LSB at T = 16, 0.76 at T = 12. Rounding of a unit vector costs
// 0.73 * 2^-U rad more. The vector is not normalised: a length of 1 + e turns it by e * tan with tan <= 1.06.
// Latency 2, 4 at PIPE = 1; II 1.
// Status: singular (|c| < 1/2 and |n| < 11/16, no unit vector: the last word is held, 0 after a reset).
// Source: the definition; arc sine table with linear interpolation. Model: conversion.vector_to_half_tangent
`default_nettype none
module vector_to_half_tangent #(
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 18 (default 16: a vector turns by 0.0006 degrees)
    parameter T = 16,  // fraction bits of the half-tangent, 8 to 20 (default 16, 0.0009 degrees at the x axis)
    parameter PIPE = 0 // registers behind table and product, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c,
    input  wire signed [U+1:0] in_n,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  [T+1:0]        out_j,
    output wire [3:0]          out_status
);
    generate
        if (U < 8 || U > 18 || T < 8 || T > 20 || PIPE < 0 || PIPE > 1) begin : g_illegal
            vector_to_half_tangent_needs_U_from_8_to_18_T_from_8_to_20_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    // 2^30 of what arcsin(i / 256) adds to the half-tangent of the x or the y axis, less half the sag of a segment;
    // i from 0 to 190, then constant
    localparam D = T + 2, KNOTS = 257;
    function [31*KNOTS-1:0] tangents(input y);
        integer    i, k;
        reg [63:0] n, square, root, cube, t;
        begin
            tangents = 0;
            root = 64'd1 << 30;  // the cosine, the root of 1 - n^2
            for (i = 1; i < KNOTS; i = i + 1) begin
                n = i > 190 ? 64'd190 : {32'd0, i};
                square = (64'd65536 - n * n) << 44;
                for (k = 0; k < 4 && i <= 190; k = k + 1)
                    root = (root + square / root) >> 1;
                cube = (root * root >> 30) * root >> 30;
                t = (n << 52) / ((64'd1 << 30) + root);
                if (!y)
                    t = t - (t >> 20) * ((64'd1 << 30) + 2 * root) / (cube * ((64'd1 << 30) + root) >> 30);
                else begin
                    t = (64'd1 << 30) - (root << 8) / (64'd256 + n);
                    cube = cube * (64'd256 + n) >> 8;
                    t = n < 64'd128 ? t + (64'd256 - 2 * n << 32) / cube : t - (2 * n - 64'd256 << 32) / cube;
                end
                tangents[31*i +: 31] = t[30:0];
            end
        end
    endfunction
    // Knot i, -256 to 256, plus half a word and half a unit of truncation
    localparam [31*KNOTS-1:0] X = tangents(1'b0), Y = tangents(1'b1);
    function [T+2:0] knot(input integer i, input y);
        reg [63:0] size;
        begin
            size = {33'd0, y ? Y[31*(i < 0 ? -i : i) +: 31] : X[31*(i < 0 ? -i : i) +: 31]};
            size = (64'd3 << 30 - D) + (i < 0 ? -size : size) >> 30 - D;
            knot = size[T+2:0];
        end
    endfunction
    reg [2*T-3:0] chords[0:1023];  // {knot, step}: about the x axis, about the y axis
    reg [T+2:0]   here, next;
    integer       i, j;
    initial
        for (j = 0; j < 2; j = j + 1) begin
            next = knot(-256, j[0]);
            for (i = -256; i < 256; i = i + 1) begin
                here = next;
                next = knot(i + 1, j[0]);
                chords[512 * j + (i & 511)] = {here, next[T-6:0] - here[T-6:0]};
            end
        end

    localparam N = 2 + 2 * PIPE;  // stages
    wire               none;
    wire [1:0]         near;
    wire signed [21:0] sine;
    /* verilator lint_off PINCONNECTEMPTY */
    nearest_axis #(.U(U), .E(20-U)) coordinate (
        .in_c(in_c), .in_n(in_n), .out_none(none), .out_axis(near), .out_minor(), .out_sine(sine));
    /* verilator lint_on PINCONNECTEMPTY */

    reg  [2*T-3:0] chord;
    reg  [11:0]    place;
    reg  [1:0]     axis;
    reg  [N-1:0]   stages;  // the stages that hold a sample
    reg  [N-1:0]   lacks;   // of the sample in each stage
    wire [T+2:0]   knot_read;
    wire [T-6:0]   step_read;
    assign         {knot_read, step_read} = chord;
    wire [T+3:0]   from_read = {axis[1] ^ (knot_read[T+2] && !axis[0]), axis[0] ^ knot_read[T+2], knot_read[T+1:0]};
    wire [T+3:0]   from;
    wire [T-6:0]   rise;
    wire [11:0]    cut;
    wire [T+3:0]   word = from + {9'd0, rise};
    wire           unused = &{1'b0, sine[21], cut, word[1:0]};

    generate
        if (PIPE == 0) begin : g_now
            assign from = from_read;
            assign {rise, cut} = step_read * place;
        end
        if (PIPE == 1) begin : g_registers
            reg [T+3:0] start, from_held;
            reg [T-6:0] step;
            reg [11:0]  offset;
            reg [T+6:0] product;
            assign from = from_held;
            assign {rise, cut} = product;
            always @(posedge clk)
                if (in_ready) begin
                    {start, step, offset} <= {from_read, step_read, place};
                    from_held <= start;
                    product   <= step * offset;
                end
        end
    endgenerate
    assign out_valid = stages[N-1];
    assign in_ready = !out_valid || out_ready;
    assign out_status = {2'd0, lacks[N-1], 1'b0};
    always @(posedge clk) begin
        if (in_ready) begin
            chord     <= chords[{near[0], sine[20:12]}];
            place     <= sine[11:0];
            axis      <= near;
            lacks     <= {lacks[N-2:0], none};
            stages    <= {stages[N-2:0], in_valid};
            if (stages[N-2] && !lacks[N-2])
                out_j <= word[T+3:2];
        end
        if (rst) begin
            stages    <= {N{1'b0}};
            out_j     <= {(T+2){1'b0}};
        end
    end
endmodule
`default_nettype wire
