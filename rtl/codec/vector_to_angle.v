// SPDX-License-Identifier: Apache-2.0
// Binary angle of a unit vector: the nearer axis plus the arc sine of the minor coordinate, without a division.
// Formats: in_c, in_n s2.U (1.0 is 2^U); out_j angle of A bits modulo a turn, rounded to nearest.
// Error for the minor coordinate as it is given: 0.89 LSB at A = 18, 0.76 at A = 14. Rounding of a unit vector costs
// 0.73 * 2^-U rad more. The vector is not normalised: a length of 1 + e turns it by e * tan with tan <= 1.06. For
// vectors of any length use table_ik1.
// Latency 2, 4 at PIPE = 1; II 1.
// Status: singular (|c| < 1/2 and |n| < 11/16, no unit vector: the last word is held, 0 after a reset).
// Source: the definition; arc sine table with linear interpolation. Model: conversion.vector_to_angle
`default_nettype none
module vector_to_angle #(
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 18 (default 16: a vector turns by 0.0006 degrees)
    parameter A = 18,  // bits of the word, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
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
    output reg  [A-1:0]        out_j,
    output wire [3:0]          out_status
);
    generate
        if (U < 8 || U > 18 || A < 10 || A > 24 || PIPE < 0 || PIPE > 1) begin : g_illegal
            vector_to_angle_needs_U_from_8_to_18_A_from_10_to_24_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    localparam N = 2 + 2 * PIPE;  // stages
    wire               none;
    wire [1:0]         near;
    wire signed [21:0] sine;
    /* verilator lint_off PINCONNECTEMPTY */
    nearest_axis #(.U(U), .E(20-U)) coordinate (
        .in_c(in_c), .in_n(in_n), .out_none(none), .out_axis(near), .out_minor(), .out_sine(sine));
    /* verilator lint_on PINCONNECTEMPTY */

    reg  [11:0]    place;
    reg  [1:0]     axis;
    reg  [N-1:0]   stages;  // the stages that hold a sample
    reg  [N-1:0]   lacks;   // of the sample in each stage
    wire [A:0]     knot_read;
    wire [A-8:0]   step_read;
    wire [A+1:0]   from_read = {axis[1] ^ (knot_read[A] && !axis[0]), axis[0] ^ knot_read[A], knot_read[A-1:0]};
    wire [A+1:0]   from;
    wire [A-8:0]   rise;
    wire [11:0]    cut;
    wire [A+1:0]   word = from + {9'd0, rise};
    wire           unused = &{1'b0, sine[21], cut, word[1:0]};

    arcsine_chords #(.A(A)) arcsine (
        .clk(clk), .in_read(in_ready), .in_segment(sine[20:12]), .out_knot(knot_read), .out_step(step_read));
    generate
        if (PIPE == 0) begin : g_now
            assign from = from_read;
            assign {rise, cut} = step_read * place;
        end
        if (PIPE == 1) begin : g_registers
            reg [A+1:0] start, from_held;
            reg [A-8:0] step;
            reg [11:0]  offset;
            reg [A+4:0] product;
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
            place     <= sine[11:0];
            axis      <= near;
            lacks     <= {lacks[N-2:0], none};
            stages    <= {stages[N-2:0], in_valid};
            if (stages[N-2] && !lacks[N-2])
                out_j <= word[A+1:2];
        end
        if (rst) begin
            stages    <= {N{1'b0}};
            out_j     <= {A{1'b0}};
        end
    end
endmodule
`default_nettype wire
