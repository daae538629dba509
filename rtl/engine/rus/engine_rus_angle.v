// SPDX-License-Identifier: Apache-2.0
// The codec of vector_to_angle for engine_rus_ik_angle. A multiplier of the leg forms its product: out_place goes into
// the register of one operand in the clock of the vector, out_step is the other operand one clock later, and in_rise is
// then their product. PIPE = 1: both go into registers together, a clock after the vector.
// Formats: in_c, in_n s2.16 in the clock of in_valid; in_take, one clock later; in_move, in the same clock or with PIPE
// = 1 four later, accepts the word; out_j angle of A bits modulo a turn, rounded to nearest. The legs give unit vectors
// only, also after an overflow. Error: 0.89 LSB at A = 18 (bounds.codec.vector_to_angle). Latency 2 + 4 PIPE.
// Source: the definition; arc sine table with linear interpolation. Model: conversion.vector_to_angle
`default_nettype none
module engine_rus_angle #(
    parameter A = 18,   // bits of the word, 10 to 24 (default 18)
    parameter PIPE = 0  // of engine_rus_path, 0 or 1 (default 0)
) (
    input  wire               clk,
    input  wire               in_valid,
    input  wire signed [17:0] in_c,
    input  wire signed [17:0] in_n,
    input  wire               in_take,
    input  wire               in_move,
    output wire [11:0]        out_place,
    output wire [16:0]        out_step,
    input  wire [28:0]        in_rise,
    output wire [A-1:0]       out_j
);
    wire [1:0]         near;
    wire signed [21:0] sine;
    /* verilator lint_off PINCONNECTEMPTY */
    nearest_axis #(.U(16), .E(4)) coordinate (
        .in_c(in_c), .in_n(in_n), .out_none(), .out_axis(near), .out_minor(), .out_sine(sine));
    /* verilator lint_on PINCONNECTEMPTY */

    reg  [1:0]     axis;
    wire [A:0]     knot;
    wire [A-8:0]   step;
    arcsine_chords #(.A(A)) arcsine (
        .clk(clk), .in_read(1'b1), .in_segment(sine[20:12]), .out_knot(knot), .out_step(step));
    reg  [A+1:0]   from;  // base and product are held until those of the next vector; their sum costs no clock
    reg  [A-8:0]   rise;
    wire [A+1:0]   word = from + {9'd0, rise};
    wire           unused = &{1'b0, sine[21], in_rise, word[1:0]};

    assign out_j = word[A+1:2];

    assign out_step = {{24-A{1'b0}}, step & {A-7{in_take}}};
    wire [A+1:0]   start;
    wire [A+1:0]   base = {axis[1] ^ (knot[A] && !axis[0]), axis[0] ^ knot[A], knot[A-1:0]};
    generate
        if (PIPE == 0) begin : g_now
            assign {out_place, start} = {sine[11:0] & {12{in_valid}}, base};
        end else begin : g_later
            reg [11:0]  place;
            reg [A+1:0] early;
            assign {out_place, start} = {place, early};
            always @(posedge clk) begin
                place <= sine[11:0] & {12{in_valid}};
                if (in_take)
                    early <= base;
            end
        end
    endgenerate
    always @(posedge clk) begin
        axis <= near;
        if (in_move) begin
            from <= start;
            rise <= in_rise[A+4:12];
        end
    end
endmodule
`default_nettype wire
