// SPDX-License-Identifier: Apache-2.0
// Unit vector of a turn-spread: |c| = sqrt(1 - s), |n| = sqrt(s), with signs by the quadrant. Each root is a product of
// two factors, w * slope, and one multiplier forms both in turn.
// Formats: in_j turn-spread u2.S; out_c, out_n s2.U (1.0 is 2^U), rounded to nearest; exact on the axes.
// Error of a coordinate: 0.5 * 2^-U, and 0.31 * 2^-15 of the root: 1.12 * 2^-U at U = 16, 0.66 * 2^-U at U = 14.
// Latency 2, 5 at PIPE = 1; II 2: the cosine, then the sine of the accepted word.
// Status: none. Source: paper, eqs. 51 and 52. Model: conversion.spread_to_vector
`default_nettype none
module spread_to_vector #(
    parameter S = 24,  // fraction bits of the joint word, 2 to 24 (default 24, 0.014 degrees at a quadrant border)
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 16 (default 16: a vector turns by 0.0006 degrees)
    parameter PIPE = 0,      // registers behind table and product, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [S+1:0]        in_j,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  signed [U+1:0] out_c,
    output wire signed [U+1:0] out_n
);
    generate
        if (S < 2 || S > 24 || U < 8 || U > 16 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0) begin : g_illegal
            spread_to_vector_needs_S_from_2_to_24_U_from_8_to_16_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    wire   second;  // second clock of a sample: the sine's factors are read
    wire   read, cosine;  // the factors are read; out_n is the cosine
    wire   accept = in_valid && in_ready;
    assign in_ready = !second && (!out_valid || out_ready);

    // Odd quadrants hold 1 - s: cosine and sine swap the word and its complement
    reg  [S+1:0] kept;
    wire [S+1:0] word = second ? kept : in_j;
    wire [18:0]  w_read;
    reg  [18:0]  w;
    wire [19:0]  slope;
    reg          negative;
    root_product #(.S(S), .B(20)) factors (.clk(clk), .in_read(read), .in_v(word[S-1:0]),
        .in_not(second == word[S]), .out_w(w_read), .out_slope(slope));

    // Rounding and sign share one increment, -(m + g) = ~m + ~g with guard bit g, made of gates, not of a carry chain
    wire [38:0]  product;  // 1.0 is 2^37
    wire         minus;
    wire [U+1:0] floor = {1'b0, product[37 -: U+1]} ^ {(U+2){minus}};
    reg  [U+1:0] nearest;
    reg          carry;
    integer      i;
    always @* begin
        carry = product[36-U] ^ minus;
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
        if (read) begin
            w        <= w_read;
            negative <= word[S+1] ^ (!second && word[S]);
        end
        if (cosine)
            out_c <= out_n;
    end

    generate
        if (PIPE == 0) begin : g_now
            assign product = w * slope;
            assign minus = negative;
            reg [1:0] stages;  // the cosine is completed; the sine is
            assign    {out_valid, second} = stages;
            assign    read = accept || second;
            assign    cosine = second;
            always @(posedge clk)
                stages <= rst ? 2'b00 : {second || (out_valid && !out_ready), accept};
        end
        if (PIPE == 1) begin : g_registers
            wire        move = !out_valid || out_ready;
            reg  [18:0] left;
            reg  [19:0] right;
            wire [40:0] whole;
            reg  [38:0] sum;
            reg  [2:0]  signs;
            reg  [4:0]  stages;  // the stages that hold a cosine, with the sine one stage behind it; the sine
            product_parts #(.A(20), .B(21), .MULTIPLY(MULTIPLY)) parts (.clk(clk), .in_move(move),
                .in_a({1'b0, left}), .in_b({1'b0, right}), .out_p(whole));
            assign      product = sum;
            assign      minus = signs[2];
            assign      second = stages[0];
            assign      out_valid = stages[4];
            assign      read = move;
            assign      cosine = stages[3];  // two samples are two stages apart, so nothing waits in front of it
            wire        unused_bits = &{1'b0, whole[40:39]};
            always @(posedge clk) begin
                if (move) begin
                    left   <= w;
                    right  <= slope;
                    sum    <= whole[38:0];
                    signs  <= {signs[1:0], negative};
                    stages <= {stages[3:0], accept};
                end
                if (rst)
                    stages <= 5'b00000;
            end
        end
    endgenerate
endmodule
`default_nettype wire
