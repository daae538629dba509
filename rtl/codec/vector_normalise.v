// SPDX-License-Identifier: Apache-2.0
// One Newton step that brings a vector to length 1: (c, n) g, g = (3 - c^2 - n^2) / 2, without a division or a root.
// Formats: in_c, in_n, out_c, out_n s2.U (1.0 is 2^U), rounded to nearest for vectors of nearly unit length.
//   A length of 1 + e becomes 1 - 3/2 e^2 - 1/2 e^3; the direction does not change, for lengths from 0 to sqrt(3).
// Error of a coordinate: (1/2 + |g - 1| / 2) * 2^-U for rounding, and g is within 2^-(U+3).
// Latency 2, II 1.
// Status: singular (c = n = 0, or c^2 + n^2 >= 3, which would reverse it: the vector is held, (1, 0) after a reset).
// Source: y (3 - y^2) / 2 of the reciprocal root. Model: conversion.vector_normalise
`default_nettype none
module vector_normalise #(
    parameter U = 16   // fraction bits of cosine and sine, 8 to 18 (default 16: a vector turns by 0.0006 degrees)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c,
    input  wire signed [U+1:0] in_n,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  signed [U+1:0] out_c,
    output reg  signed [U+1:0] out_n,
    output wire [3:0]          out_status
);
    generate
        if (U < 8 || U > 18) begin : g_illegal
            vector_normalise_needs_U_from_8_to_18 rule ();
        end
    endgenerate

    localparam G = U + 3;  // fraction bits of g, below which the squares are truncated
    reg  signed [U+1:0]    c, n;
    reg  [1:0]             stages;  // the stages that hold a sample
    reg                    zero, singular;  // of the sample in the first stage; of that in the second
    wire [2*U+3:0]         cc = c * c, nn = n * n;  // u4.2U
    wire [G+3:0]           q = cc[2*U+3:U-3] + nn[2*U+3:U-3];
    wire signed [G+3:0]    g = {~q[G+3:G] + 4'd3, ~q[G-1:0]};  // 3 - q, one unit low; half of it is Newton's factor
    wire signed [U+G+6:0]  along = $signed({c, 1'b1}) * g, across = $signed({n, 1'b1}) * g;  // the 1 is half an LSB
    wire                   lost = zero || g[G+3];
    wire                   unused = &{1'b0, cc, nn, along, across};

    assign out_valid = stages[1];
    assign in_ready = !out_valid || out_ready;
    assign out_status = {2'd0, singular, 1'b0};
    always @(posedge clk) begin
        if (in_ready) begin
            c         <= in_c;
            n         <= in_n;
            zero      <= ~|in_c && ~|in_n;
            stages    <= {stages[0], in_valid};
            singular  <= lost;
            if (stages[0] && !lost) begin
                out_c <= along[U+G+3:G+2];
                out_n <= across[U+G+3:G+2];
            end
        end
        if (rst) begin
            stages    <= 2'b00;
            out_c     <= {2'b01, {U{1'b0}}};
            out_n     <= {(U+2){1'b0}};
        end
    end
endmodule
`default_nettype wire
