// SPDX-License-Identifier: Apache-2.0
// Binary angle of a unit vector: the nearer axis plus the arc sine of the minor coordinate, without a division.
// Formats: in_c, in_n s2.U (1.0 is 2^U); out_j angle of A bits modulo a turn, rounded to nearest.
// Error for the minor coordinate as it is given: 0.89 LSB at A = 18, 0.76 at A = 14. Rounding of a unit vector costs
// 0.73 * 2^-U rad more. The vector is not normalised: a length of 1 + e turns it by e * tan with tan <= 1.06. For
// vectors of any length use table_ik1.
// Latency 2, II 1.
// Status: singular (|c| < 1/2 and |n| < 11/16, no unit vector: the last word is held, 0 after a reset).
// Source: the definition; arc sine table with linear interpolation. Model: conversion.vector_to_angle
`default_nettype none
module vector_to_angle #(
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 18 (default 16: a vector turns by 0.0006 degrees)
    parameter A = 18   // bits of the word, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c,
    input  wire signed [U+1:0] in_n,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  [A-1:0]        out_j,
    output wire [3:0]          out_status
);
    generate
        if (U < 8 || U > 18 || A < 10 || A > 24) begin : g_illegal
            vector_to_angle_needs_U_from_8_to_18_and_A_from_10_to_24 rule ();
        end
    endgenerate

    wire               none;
    wire [1:0]         near;
    wire signed [21:0] sine;
    /* verilator lint_off PINCONNECTEMPTY */
    nearest_axis #(.U(U), .E(20-U)) coordinate (
        .in_c(in_c), .in_n(in_n), .out_none(none), .out_axis(near), .out_minor(), .out_sine(sine));
    /* verilator lint_on PINCONNECTEMPTY */

    reg  [11:0]    place;
    reg  [1:0]     axis;
    reg  [1:0]     stages;  // the stages that hold a sample
    reg            lacks, singular;  // of the sample in the first stage; of that in the second
    wire [A:0]     knot;
    wire [A-8:0]   step, rise;
    wire [11:0]    cut;
    assign         {rise, cut} = step * place;
    wire [A+1:0]   from = {axis[1] ^ (knot[A] && !axis[0]), axis[0] ^ knot[A], knot[A-1:0]};
    wire [A+1:0]   word = from + {9'd0, rise};
    wire           unused = &{1'b0, sine[21], cut, word[1:0]};

    arcsine_chords #(.A(A)) arcsine (
        .clk(clk), .in_read(in_ready), .in_segment(sine[20:12]), .out_knot(knot), .out_step(step));
    assign out_valid = stages[1];
    assign in_ready = !out_valid || out_ready;
    assign out_status = {2'd0, singular, 1'b0};
    always @(posedge clk) begin
        if (in_ready) begin
            place     <= sine[11:0];
            axis      <= near;
            lacks     <= none;
            stages    <= {stages[0], in_valid};
            singular  <= lacks;
            if (stages[0] && !lacks)
                out_j <= word[A+1:2];
        end
        if (rst) begin
            stages    <= 2'b00;
            out_j     <= {A{1'b0}};
        end
    end
endmodule
`default_nettype wire
