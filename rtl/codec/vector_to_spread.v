// SPDX-License-Identifier: Apache-2.0
// Turn-spread of a unit vector: the nearer axis plus or minus the square of the minor coordinate, without a division.
// Formats: in_c, in_n s2.U (1.0 is 2^U); out_j turn-spread u2.S modulo 4, rounded to nearest, ties upward.
// Error for the minor coordinate as it is given: 0.69 LSB at S = 24, 1/2 at S = 16. Rounding of a unit vector costs
// 0.73 * 2^-U rad more. The vector is not normalised: a length of 1 + e turns it by e * tan with tan <= 1.06. For
// vectors of any length use vector_to_spread_iter or rational_ik1.
// Latency 1, II 1.
// Status: singular (|c| < 1/2 and |n| < 11/16, no unit vector: the last word is held, 0 after a reset).
// Source: paper eq. 3, spread = square of the sine; the quadrant by signs. Model: conversion.vector_to_spread
`default_nettype none
module vector_to_spread #(
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 18 (default 16: a vector turns by 0.0006 degrees)
    parameter S = 24   // fraction bits of the joint word, 2 to 24 (default 24, 0.014 degrees at a quadrant border)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c,
    input  wire signed [U+1:0] in_n,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  [S+1:0]        out_j,
    output wire [3:0]          out_status
);
    generate
        if (U < 8 || U > 18 || S < 2 || S > 24) begin : g_illegal
            vector_to_spread_needs_U_from_8_to_18_and_S_from_2_to_24 rule ();
        end
    endgenerate

    localparam E = 27 - (U + 1);  // extra bits of the other factor, so that its one's complement is its negative
    wire                   none;
    wire [1:0]             axis;
    wire signed [U+1:0]    minor;
    wire signed [U+E+1:0]  sine;
    nearest_axis #(.U(U), .E(E)) near (
        .in_c(in_c), .in_n(in_n), .out_none(none), .out_axis(axis), .out_minor(minor), .out_sine(sine));
    // sine |sine|, from minor and its sign
    wire                   below = sine[U+E];
    wire signed [U+E:0]    factor = {minor[U:0], {E{1'b0}}} ^ {(U+E+1){below}};
    wire signed [2*U+E+1:0] square = $signed(minor[U:0]) * factor;  // s1.(2U+E)
    wire                   back, half;
    wire [S-1:0]           part;
    wire [2*U+E-S-2:0]     rest;
    assign {back, part, half, rest} = square[2*U+E:0];
    wire                   unused = &{1'b0, minor[U+1], sine, square[2*U+E+1], rest};
    wire [S+1:0]           floor = {axis[1] ^ (back && !axis[0]), axis[0] ^ back, part};
    wire                   accept = in_valid && in_ready;
    reg                    singular;
    assign in_ready = !out_valid || out_ready;
    assign out_status = {2'd0, singular, 1'b0};
    always @(posedge clk) begin
        if (accept)
            singular <= none;
        if (accept && !none)
            out_j <= floor + {{(S+1){1'b0}}, half};
        if (rst)
            out_j <= 0;
        out_valid <= !rst && (in_valid || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
