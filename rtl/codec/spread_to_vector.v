// SPDX-License-Identifier: Apache-2.0
// Unit vector of a turn-spread: |c| = sqrt(1 - s), |n| = sqrt(s), with signs by the quadrant. Each root is a product of
// two factors, w * slope, and one multiplier forms both in turn.
// Formats: in_j turn-spread u2.S; out_c, out_n s2.U (1.0 is 2^U), rounded to nearest; exact on the axes.
// Error of a coordinate: 0.5 * 2^-U, and 0.31 * 2^-15 of the root: 1.12 * 2^-U at U = 16, 0.66 * 2^-U at U = 14.
// Latency 2, II 2: the cosine, then the sine of the accepted word.
// Status: none. Source: paper, eqs. 51 and 52. Model: conversion.spread_to_vector
`default_nettype none
module spread_to_vector #(
    parameter S = 24,  // fraction bits of the joint word, 2 to 24 (default 24, 0.014 degrees at a quadrant border)
    parameter U = 16   // fraction bits of cosine and sine, 8 to 16 (default 16: a vector turns by 0.0006 degrees)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [S+1:0]        in_j,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [U+1:0] out_c,
    output wire signed [U+1:0] out_n
);
    generate
        if (S < 2 || S > 24 || U < 8 || U > 16) begin : g_illegal
            spread_to_vector_needs_S_from_2_to_24_and_U_from_8_to_16 rule ();
        end
    endgenerate

    reg    second;  // second clock of a sample: the cosine is completed, the sine's factors are read
    wire   accept = in_valid && in_ready;
    assign in_ready = !second && (!out_valid || out_ready);

    // Odd quadrants hold 1 - s: cosine and sine swap the word and its complement
    reg  [S+1:0] kept;
    wire [S+1:0] word = second ? kept : in_j;
    wire [18:0]  w_read;
    reg  [18:0]  w;
    wire [19:0]  slope;
    reg          negative;
    root_product #(.S(S), .B(20)) factors (.clk(clk), .in_read(accept || second), .in_v(word[S-1:0]),
        .in_not(second == word[S]), .out_w(w_read), .out_slope(slope));

    // Rounding and sign share one increment, -(m + g) = ~m + ~g with guard bit g, made of gates, not of a carry chain
    wire [38:0]  product = w * slope;  // 1.0 is 2^37
    wire [U+1:0] floor = {1'b0, product[37 -: U+1]} ^ {(U+2){negative}};
    reg  [U+1:0] nearest;
    reg          carry;
    integer      i;
    always @* begin
        carry = product[36-U] ^ negative;
        for (i = 0; i < U + 2; i = i + 1) begin
            nearest[i] = floor[i] ^ carry;
            carry = floor[i] & carry;
        end
    end
    assign out_n = nearest;
    wire         unused = &{1'b0, product};

    always @(posedge clk) begin
        if (accept)
            kept <= in_j;
        if (accept || second) begin
            w        <= w_read;
            negative <= word[S+1] ^ (!second && word[S]);
        end
        if (second)
            out_c <= out_n;
        second    <= accept;
        out_valid <= second || (out_valid && !out_ready);
        if (rst) begin
            second    <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
