// SPDX-License-Identifier: Apache-2.0
// Turn-spread of a unit vector: the nearer axis plus or minus the square of the minor coordinate, without a division.
// Formats: in_c, in_n s2.U (1.0 is 2^U); out_j turn-spread u2.S modulo 4, rounded to nearest, ties upward.
// Error for the minor coordinate as it is given: 0.69 LSB at S = 24, 1/2 at S = 16. Rounding of a unit vector costs
// 0.73 * 2^-U rad more. The vector is not normalised: a length of 1 + e turns it by e * tan with tan <= 1.06. For
// vectors of any length use vector_to_spread_iter or rational_ik1.
// Latency 1, 2 at PIPE = 1, which has a multiplier for either coordinate; II 1.
// Status: singular (|c| < 1/2 and |n| < 11/16, no unit vector: the last word is held, 0 after a reset).
// Source: paper eq. 3, spread = square of the sine; the quadrant by signs. Model: conversion.vector_to_spread
`default_nettype none
module vector_to_spread #(
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 18 (default 16: a vector turns by 0.0006 degrees)
    parameter S = 24,  // fraction bits of the joint word, 2 to 24 (default 24, 0.014 degrees at a quadrant border)
    parameter PIPE = 0 // registers behind the product, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c,
    input  wire signed [U+1:0] in_n,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  [S+1:0]        out_j,
    output wire [3:0]          out_status
);
    generate
        if (U < 8 || U > 18 || S < 2 || S > 24 || PIPE < 0 || PIPE > 1) begin : g_illegal
            vector_to_spread_needs_U_from_8_to_18_S_from_2_to_24_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    localparam E = 27 - (U + 1);  // extra bits of the other factor, so that its one's complement is its negative
    wire                   none;
    wire [1:0]             axis;
    wire signed [U+1:0]    minor;
    wire signed [U+E+1:0]  sine;
    nearest_axis #(.U(U), .E(E)) near (
        .in_c(in_c), .in_n(in_n), .out_none(none), .out_axis(axis), .out_minor(minor), .out_sine(sine));
    wire                   below = sine[U+E];
    wire                   unused = &{1'b0, minor[U+1], sine};
    wire                   last, lacks;  // a sample for the last stage; it is no unit vector
    wire [S+1:0]           word;
    wire                   take = last && in_ready;
    reg                    singular;
    assign in_ready = !out_valid || out_ready;
    assign out_status = {2'd0, singular, 1'b0};
    always @(posedge clk) begin
        if (take)
            singular <= lacks;
        if (take && !lacks)
            out_j <= word;
        if (rst)
            out_j <= 0;
    end

    generate
        if (PIPE == 0) begin : g_now
            // sine |sine|, from minor and its sign
            wire signed [U+E:0]    factor = {minor[U:0], {E{1'b0}}} ^ {(U+E+1){below}};
            wire signed [2*U+E+1:0] square = $signed(minor[U:0]) * factor;  // s1.(2U+E)
            wire                   back, half;
            wire [S-1:0]           part;
            wire [2*U+E-S-2:0]     rest;
            assign {back, part, half, rest} = square[2*U+E:0];
            wire [S+1:0]           floor = {axis[1] ^ (back && !axis[0]), axis[0] ^ back, part};
            assign                 word = floor + {{(S+1){1'b0}}, half};
            reg                    full;
            assign                 out_valid = full;
            assign                 last = in_valid;
            assign                 lacks = none;
            always @(posedge clk)
                full <= !rst && (in_valid || (full && !out_ready));
            wire                   unused_bits = &{1'b0, square[2*U+E+1], rest};
        end
        if (PIPE == 1) begin : g_registers
            // Both coordinates are squared while the nearer axis is found. One sum then has the axis, half an LSB and
            // sine |sine| = m^2 2^E, or where that is negative -m^2 2^E - m = (~m^2) 2^E + 2^E - m.
            localparam X = 2 * U + E, R = X - S;  // bits below the axis; those that are rounded off
            localparam [X-1:0] HALF = {{(X-1){1'b0}}, 1'b1} << R - 1;
            localparam [X-1:0] BELOW = HALF + ({{(X-1){1'b0}}, 1'b1} << E);
            reg  [2*U:0]           cc, nn;
            reg  [X+1:0]           rest;  // all but the square
            reg                    y, back, none_held;
            reg  [1:0]             stages;  // the stages that hold a sample
            wire signed [U:0]      c = in_c[U:0], n = in_n[U:0];
            wire [2*U:0]           square = (y ? cc : nn) ^ {(2*U+1){back}};
            wire [X+1:0]           sum = {back || square[2*U], square, {E{1'b0}}} + rest;
            assign                 word = sum[X+1:R];
            assign                 out_valid = stages[1];
            assign                 last = stages[0];
            assign                 lacks = none_held;
            wire                   unused_bits = &{1'b0, sum[R-1:0]};
            always @(posedge clk) begin
                if (in_ready) begin
                    cc        <= c * c;
                    nn        <= n * n;
                    rest      <= {axis, below ? BELOW : HALF} - ({{(X-U+1){minor[U]}}, minor[U:0]} & {(X+2){below}});
                    y         <= axis[0];
                    back      <= below;
                    none_held <= none;
                    stages    <= {stages[0], in_valid};
                end
                if (rst)
                    stages <= 2'b00;
            end
        end
    endgenerate
endmodule
`default_nettype wire
