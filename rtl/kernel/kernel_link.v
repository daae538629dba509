// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one joint from table segments of its direction: x = L1 c, then y = L1 n on the same
// multipliers. In a clock of out_read the codec reads the cosine of the word at the input, or with out_kept the sine of
// the accepted word. One clock later in_chord holds the segment of angle_chord, and angle_knot gives root = knot + step
// * offset / 2^15. The kernel knows no joint word. One multiplier completes a root while the other multiplies the
// previous one.
// Formats: root sQ1.K; out_x, out_y are rounded to nearest (ties upward) and saturated.
// Error of a coordinate: 1/2 LSB, and that of the root times the length.
// Latency 3, II 2: the first clock of a sample is the last clock of the sample before it.
// PIPE = 1: registers behind the table and the multipliers, the same words; latency 6, II 2.
// Overflow: a coordinate was saturated. Source: the definition. Model: table.fk1
`default_nettype none
module kernel_link #(
    parameter W = 16,        // bits of the length and of a coordinate, 15 to 24 (default 16)
    parameter K = 17,        // fraction bits of a root, 14 to 25 (default 17 = W + 1)
    parameter T = 9,         // address bits of the codec's table (default 9); a step has K - T + 4 bits
    parameter PIPE = 0,      // registers behind table and products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire                in_valid,
    output wire                in_ready,
    output wire                out_read,  // the codec reads; else it holds its segment
    output wire                out_kept,  // the sine of the accepted word, not the cosine of the word at the input
    input  wire [2*K-T+19+15*(K>21):0] in_chord,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire                out_overflow
);
    wire   move = !out_valid || out_ready;
    assign out_read = move;

    wire           copy, half;  // copy: of the sign
    wire [K-2:0]   rest;
    wire [W:0]     floor;
    wire [W+K+1:0] product;
    assign         {copy, floor, half, rest} = product;
    wire [W:0]     nearest = floor + {{W{1'b0}}, half};
    wire           over = nearest[W] ^ nearest[W-1];
    reg            over_x;
    assign         out_y = over ? {nearest[W], {(W-1){!nearest[W]}}} : nearest[W-1:0];
    assign         out_overflow = over_x || over;
    wire           unused = &{1'b0, copy, rest};

    generate
        if (PIPE == 0) begin : g_small
            reg             waits, second;  // first clock of a sample: completes the cosine; second clock: forms x
            reg  [K:0]      root;
            wire [K:0]      knot;
            wire [K-T+3:0]  step, rise;
            wire [14:0]     offset, below;
            wire            same;  // a copy of the sign
            wire            unused_too = &{1'b0, same, below};
            assign in_ready = !waits && move;
            assign out_kept = waits;
            angle_knot #(.K(K), .T(T)) segment (.in_chord(in_chord), .out_knot(knot), .out_step(step),
                .out_offset(offset));
            assign {same, rise, below} = $signed(step) * $signed({1'b0, offset});
            assign product = $signed(root) * $signed({1'b0, cfg_l1});
            always @(posedge clk) begin
                if (move)
                    root <= knot + {{(T-3){rise[K-T+3]}}, rise};
                if (second) begin
                    out_x  <= out_y;
                    over_x <= over;
                end
                waits     <= (in_valid && in_ready) || (waits && !move);
                second    <= waits && move;
                out_valid <= second || (out_valid && !out_ready);
                if (rst) begin
                    waits     <= 1'b0;
                    second    <= 1'b0;
                    out_valid <= 1'b0;
                end
            end
        end else begin : g_fast
            // A sample reads its cosine in clock 0, which takes it on, and its sine in clock 1. What is read in clock k
            // is in clock k + 1 in the memory's output, k + 2 a segment whose step is multiplied, k + 3 a root that is
            // summed, k + 4 multiplied by the length, k + 5 rounded.
            reg  [5:1]       at;  // at[i]: a sample is in its clock i
            wire [K:0]       root;
            assign in_ready = !at[1] && move;
            assign out_kept = at[1];
            kernel_root #(.K(K), .T(T)) roots (.clk(clk), .in_move(move), .in_chord(in_chord), .out_root(root));
            product_parts #(.A(K+1), .B(W+1), .MULTIPLY(MULTIPLY)) parts (.clk(clk), .in_move(move), .in_a(root),
                .in_b({1'b0, cfg_l1}), .out_p(product));
            always @(posedge clk) begin
                if (move) begin
                    if (at[5]) begin
                        out_x  <= out_y;
                        over_x <= over;
                    end
                    {out_valid, at} <= {at, in_valid && in_ready};
                end
                if (rst) begin
                    out_valid <= 1'b0;
                    at        <= 5'd0;
                end
            end
        end
    endgenerate
endmodule
`default_nettype wire
