// SPDX-License-Identifier: Apache-2.0
// One Newton step that brings a vector to length 1: (c, n) g, g = (3 - c^2 - n^2) / 2, without a division or a root.
// Formats: in_c, in_n, out_c, out_n s2.U (1.0 is 2^U), rounded to nearest for vectors of nearly unit length.
//   A length of 1 + e becomes 1 - 3/2 e^2 - 1/2 e^3; the direction does not change, for lengths from 0 to sqrt(3).
// Error of a coordinate: (1/2 + |g - 1| / 2) * 2^-U for rounding, and g is within 2^-(U+3).
// Latency 2, 5 at PIPE = 1; II 1.
// Status: singular (c = n = 0, or c^2 + n^2 >= 3, which would reverse it: the vector is held, (1, 0) after a reset).
// Source: y (3 - y^2) / 2 of the reciprocal root. Model: conversion.vector_normalise
`default_nettype none
module vector_normalise #(
    parameter U = 16,        // fraction bits of cosine and sine, 8 to 18 (default 16: a vector turns by 0.0006 degrees)
    parameter PIPE = 0,      // registers behind sums and products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
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
        if (U < 8 || U > 18 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0) begin : g_illegal
            vector_normalise_needs_U_from_8_to_18_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    localparam G = U + 3;  // fraction bits of g, below which the squares are truncated
    localparam N = 2 + 3 * PIPE;  // stages
    reg  signed [U+1:0]    c, n;
    reg  [N-1:0]           stages;  // the stages that hold a sample
    reg                    zero, singular;  // of the sample in the first stage; of that in the last
    wire [2*U+3:0]         cc, nn;  // u4.2U
    wire [G+3:0]           q = cc[2*U+3:U-3] + nn[2*U+3:U-3];
    wire signed [G+3:0]    g = {~q[G+3:G] + 4'd3, ~q[G-1:0]};  // 3 - q, one unit low; half of it is Newton's factor
    wire signed [U+1:0]    along, across;
    wire                   lost;  // of the sample in the last stage but one
    wire                   unused = &{1'b0, cc, nn};

    assign out_valid = stages[N-1];
    assign in_ready = !out_valid || out_ready;
    assign out_status = {2'd0, singular, 1'b0};
    generate
        if (PIPE == 0) begin : g_now
            wire signed [U+G+6:0] c_g = $signed({c, 1'b1}) * g, n_g = $signed({n, 1'b1}) * g;  // the 1 is half an LSB
            assign cc = c * c;
            assign nn = n * n;
            assign along = c_g[U+G+3:G+2];
            assign across = n_g[U+G+3:G+2];
            assign lost = zero || g[G+3];
            wire   unused_bits = &{1'b0, c_g, n_g};
        end
        if (PIPE == 1) begin : g_registers
            reg  signed [U+1:0]   c_squared, n_squared, c_factor, n_factor;  // c, n beside their squares, beside g
            reg  signed [G+2:0]   factor;  // g where it is not negative
            reg         [G+1:0]   half;    // g beside the products: the half LSB of c and n
            reg                   zero_squared, lost_factor, lost_product;
            wire signed [U+G+4:0] c_g, n_g;
            wire signed [U+G+4:0] c_sum = c_g + {{(U+3){1'b0}}, half}, n_sum = n_g + {{(U+3){1'b0}}, half};
            product_parts #(.A(U+2), .B(U+2), .MULTIPLY(MULTIPLY)) square_c (
                .clk(clk), .in_move(in_ready), .in_a(c), .in_b(c), .out_p(cc));
            product_parts #(.A(U+2), .B(U+2), .MULTIPLY(MULTIPLY)) square_n (
                .clk(clk), .in_move(in_ready), .in_a(n), .in_b(n), .out_p(nn));
            product_parts #(.A(G+3), .B(U+2), .MULTIPLY(MULTIPLY)) scale_c (
                .clk(clk), .in_move(in_ready), .in_a(factor), .in_b(c_factor), .out_p(c_g));
            product_parts #(.A(G+3), .B(U+2), .MULTIPLY(MULTIPLY)) scale_n (
                .clk(clk), .in_move(in_ready), .in_a(factor), .in_b(n_factor), .out_p(n_g));
            assign along = c_sum[U+G+2:G+1];
            assign across = n_sum[U+G+2:G+1];
            assign lost = lost_product;
            wire   unused_bits = &{1'b0, c_sum, n_sum};
            always @(posedge clk)
                if (in_ready) begin
                    {c_squared, n_squared, zero_squared} <= {c, n, zero};
                    {c_factor, n_factor} <= {c_squared, n_squared};
                    factor               <= {1'b0, g[G+1:0]};
                    lost_factor          <= zero_squared || g[G+3];
                    half                 <= {1'b0, factor[G+1:1]};
                    lost_product         <= lost_factor;
                end
        end
    endgenerate
    always @(posedge clk) begin
        if (in_ready) begin
            c         <= in_c;
            n         <= in_n;
            zero      <= ~|in_c && ~|in_n;
            stages    <= {stages[N-2:0], in_valid};
            singular  <= lost;
            if (stages[N-2] && !lost) begin
                out_c <= along;
                out_n <= across;
            end
        end
        if (rst) begin
            stages    <= {N{1'b0}};
            out_c     <= {2'b01, {U{1'b0}}};
            out_n     <= {(U+2){1'b0}};
        end
    end
endmodule
`default_nettype wire
