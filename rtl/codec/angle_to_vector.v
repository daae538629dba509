// SPDX-License-Identifier: Apache-2.0
// Unit vector of a binary angle: c = cos j, n = sin j, by one sine table and one multiplier.
// Formats: in_j angle of A bits; out_c, out_n s2.U (1.0 is 2^U), rounded to nearest; exact on the axes.
// Error of a coordinate: 0.83 * 2^-U, half a unit of rounding included (bounds.codec.angle_to_vector).
// Latency 2, 4 at PIPE = 1; II 2: the cosine, then the sine of the accepted word.
// Status: none. Source: the definition; sine table with linear interpolation. Model: conversion.angle_to_vector
`default_nettype none
module angle_to_vector #(
    parameter A = 18,  // bits of the word, 12 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
    parameter U = 16,  // fraction bits of cosine and sine, 12 to 18 (default 16: a vector turns by 0.0006 degrees)
    parameter PIPE = 0 // registers behind table and product, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [A-1:0]        in_j,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  signed [U+1:0] out_c,
    output wire signed [U+1:0] out_n
);
    generate
        if (A < 12 || A > 24 || U < 12 || U > 18 || PIPE < 0 || PIPE > 1) begin : g_illegal
            angle_to_vector_needs_A_from_12_to_24_U_from_12_to_18_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    localparam K = U + 3;                                  // fraction bits of a root, three of which are rounded off
    localparam T = A < (U + 5) / 2 + 1 ? A - 1 : (U + 5) / 2;  // address bits of the table

    wire   second;  // second clock of a sample: the sine is read
    wire   read, cosine;  // the table is read; out_n is the cosine
    wire   accept = in_valid && in_ready;
    assign in_ready = !second && (!out_valid || out_ready);

    reg  [T-1:0]      upper;  // upper bits of the word
    wire [2*K-T+20:0] chord;
    always @(posedge clk)
        if (accept)
            upper <= in_j[A-1:A-T];
    angle_chord #(.A(A), .K(K), .T(T), .DROP(3)) codec (.clk(clk), .in_read(read), .in_keep(second),
        .in_cos(!second), .in_j({second ? upper : in_j[A-1:A-T], in_j[A-T-1:0]}), .out_chord(chord));

    wire [K+1:0]   knot;
    wire [K-T+3:0] step, rise;
    wire [14:0]    offset, below;
    wire           same;    // a copy of the sign
    wire [2:0]     dropped;
    assign {out_n, dropped} = knot + {{(T-2){rise[K-T+3]}}, rise};
    wire           unused = &{1'b0, same, below, dropped};
    always @(posedge clk)
        if (cosine)
            out_c <= out_n;

    generate
        if (PIPE == 0) begin : g_now
            assign {knot, step, offset} = chord;
            assign {same, rise, below} = $signed(step) * $signed({1'b0, offset});
            reg [1:0] stages;  // the cosine is completed; the sine is
            assign    {out_valid, second} = stages;
            assign    read = accept || second;
            assign    cosine = second;
            always @(posedge clk)
                stages <= rst ? 2'b00 : {second || (out_valid && !out_ready), accept};
        end
        if (PIPE == 1) begin : g_registers
            wire                  move = !out_valid || out_ready;
            reg  [2*K-T+20:0]     segment;
            reg  [K+1:0]          start;
            reg  [K-T+19:0]       product;
            reg  [3:0]            stages;  // the stages that hold a cosine, with the sine one stage behind it; the sine
            wire [K+1:0]          segment_knot;
            assign {segment_knot, step, offset} = segment;
            assign knot = start;
            assign {same, rise, below} = product;
            assign second = stages[0];
            assign out_valid = stages[3];
            assign read = move;
            assign cosine = stages[2];  // two samples are two stages apart, so nothing waits in front of it
            always @(posedge clk) begin
                if (move) begin
                    segment <= chord;
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
