// SPDX-License-Identifier: Apache-2.0
// Codec of turn-spreads after kernel_vector_wide: it makes the word of a joint from its cosine, then its sine.
//   out_j = axis +- m^2; m is the cosine where that is in [-3/4, 3/4), else the sine
// in_cos and in_sin have one bit a joint: in_word is its cosine, or its sine. With in_flat the cosine of joint 2 is 1,
// or -1 with in_negative. With in_none joints 1 and 3 hold their words.
// Formats: in_word s4.I; out_j turn-spreads u2.S modulo 4, joint 1 lowest, rounded to nearest, ties towards the axis.
// Reset sets joints 1 and 3 to 0. Joint 2 is not reset: every sample writes it.
// Error: the sine is off by 2^-(I+1), half of what in_word truncates; a length of 1 + e turns by up to 1.14 e more.
// Latency 1 + 2 PIPE from the sine on; a joint may follow in as many clocks. Source: paper, eq. 3.
// Model: rational.spread_of_vector
`default_nettype none
module spread_of_vector #(
    parameter JOINTS = 2,    // joints of the kernel, 1 to 3 (default 2)
    parameter S = 36,        // fraction bits of a word, 2 to 2 I - 2 (default 36, 0.0002 degrees at a border)
    parameter I = 22,        // fraction bits of in_word, 22 or 26 (default 22)
    parameter PIPE = 0,      // registers behind the product, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                    clk,
    input  wire                    rst,
    input  wire [2:0]              in_cos,
    input  wire [2:0]              in_sin,
    input  wire [I+3:0]            in_word,
    input  wire                    in_flat,
    input  wire                    in_negative,
    input  wire                    in_none,
    output reg  [JOINTS*(S+2)-1:0] out_j
);
    reg  signed [I:0]     m;
    reg                   far, back, under;  // the cosine is outside [-3/4, 3/4); the cosine, the sine is negative
    reg  [2:0]            read;              // a bit a joint
    wire [3:0]            quarters = in_word[I+1:I-2];
    wire                  fits = quarters[3] ? quarters[2] && quarters[1:0] != 0 : !quarters[2] && quarters[1:0] != 3;
    wire [2:0]            gives;
    wire [1:0]            axis;
    wire                  plus;              // the square is added
    wire signed [2*I+1:0] square;            // -m (m + 1): m is truncated, this is the square of its middle
    generate
        if (PIPE == 0) begin : g_now
            assign gives = read;
            assign axis = far ? {back, 1'b0} : {under, 1'b1};
            assign plus = far ? back == under : back != under;
            wire signed [I:0] other = ~m;
            assign square = m * other;
        end else begin : g_registers
            reg  [5:0]            given, later;  // of both clocks: a bit a joint; axis and plus
            reg  signed [2*I+1:0] settled;
            wire signed [2*I+1:0] product;
            product_parts #(.A(I+1), .B(I+1), .MULTIPLY(MULTIPLY)) multiply (.clk(clk), .in_move(1'b1), .in_a(m),
                .in_b(~m), .out_p(product));
            assign square = settled;
            assign gives = given[2:0];
            assign {axis, plus} = later[2:0];
            always @(posedge clk) begin
                settled <= product;
                given   <= rst ? 6'd0 : {read, given[5:3]};
                later   <= {far ? {back, 1'b0} : {under, 1'b1}, far == (back == under), later[5:3]};
            end
        end
    endgenerate

    // A square of 0 is 0, its complement -1: both round to 0
    wire [2*I+1:0] term = square ^ {(2*I+2){plus}};
    wire           below = term[2*I+1];
    wire [S+1:0]   floor = {axis[1] ^ (below && !axis[0]), axis[0] ^ below, term[2*I-1 -: S]};
    wire [S+1:0]   word = floor + {{(S+1){1'b0}}, term[2*I-1-S]};
    wire           unused = &{1'b0, term[2*I], term[2*I-2-S:0], in_word[I+2], gives};
    always @(posedge clk) begin
        if (in_cos != 0 || in_sin != 0 && far)
            m <= in_word[I:0];
        if (in_cos != 0) begin
            far  <= !fits || in_cos[1] && in_flat;
            back <= in_cos[1] ? in_negative : in_word[I+3];
        end
        if (in_sin != 0)
            under <= in_word[I+3];
        read <= rst ? 3'd0 : in_sin;
    end

    genvar j;
    generate
        for (j = 0; j < JOINTS; j = j + 1) begin : g_joint
            always @(posedge clk)
                if (rst && j != 1 || gives[j] && !(in_none && j != 1))
                    out_j[(S+2)*j +: S+2] <= rst && j != 1 ? {(S+2){1'b0}} : word;
        end
    endgenerate
endmodule
`default_nettype wire
