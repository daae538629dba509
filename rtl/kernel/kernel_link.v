// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one joint from chords of its direction: x = L1 c, then y = L1 n on the same two multipliers.
// It knows no joint word: in the clock of out_read the codec reads the cosine of the word at the input or, with
// out_kept, the sine of that word; one clock later in_chord holds its chord {knot, step, offset}, as of angle_chord.
// Formats: root sQ1.K; out_x, out_y to nearest (ties upward), saturated.
// Error: 1/2 LSB beyond that of the root.
// Latency 3, II 2: the first clock of a sample is the last of the one before it. No table: two bits name the clock.
// Overflow: a coordinate was saturated. Model: table.fk1
`default_nettype none
module kernel_link #(
    parameter W = 16,  // bits of the length and of a coordinate, 15 to 20; their fraction bits do not matter here
    parameter K = 17,  // fraction bits of a root, 14 to 22: W + 1 keeps a coordinate within an LSB
    parameter T = 9    // a step has K - T + 4 bits: 9 where a turn has 2^9 chords
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire                in_valid,
    output wire                in_ready,
    output wire                out_read,  // the codec reads; else it holds its chord
    output wire                out_kept,  // sine of the word that was accepted, not cosine of that at the input
    input  wire [2*K-T+19:0]   in_chord,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire                out_overflow
);
    reg  waits, second;  // first clock of a sample, which completes the cosine; its second, which forms x
    wire move = !out_valid || out_ready;
    assign in_ready = !waits && move;
    assign out_read = move;
    assign out_kept = waits;

    wire [K:0]     knot;
    wire [K-T+3:0] step, rise;
    wire [14:0]    offset, below;
    wire           same, copy;  // of signs
    assign {knot, step, offset} = in_chord;
    assign {same, rise, below} = $signed(step) * $signed({1'b0, offset});
    reg  [K:0]     root;

    wire           half;
    wire [K-2:0]   rest;
    wire [W:0]     floor;
    assign {copy, floor, half, rest} = $signed(root) * $signed({1'b0, cfg_l1});
    wire [W:0]     nearest = floor + {{W{1'b0}}, half};
    wire           over = nearest[W] ^ nearest[W-1];
    wire           unused = &{1'b0, same, copy, rest, below};

    reg over_x;
    assign out_y = over ? {nearest[W], {(W-1){!nearest[W]}}} : nearest[W-1:0];
    assign out_overflow = over_x || over;
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
endmodule
`default_nettype wire
