// SPDX-License-Identifier: Apache-2.0
// A cosine or sine from a segment of angle_chord in three registers, for kernel_link, kernel_link_sum and
// kernel_link_space at PIPE = 1: the segment, then step * offset, then their sum.
//   out_root = knot + step * offset / 2^15, as angle_knot gives them of the segment of three clocks before
// Formats: out_root sQ1.K; the product is truncated to 2^-K. Error: that of the table, and the truncation.
// Latency 3, II 1; all registers are held while in_move is low. Model: codecs.angle_chord
`default_nettype none
module kernel_root #(
    parameter K = 17,  // fraction bits of a root, 14 to 25 (default 17)
    parameter T = 9    // address bits of the codec's table, 9 to 12 (default 9); a step has K - T + 4 bits
) (
    input  wire              clk,
    input  wire              in_move,
    input  wire [2*K-T+19+15*(K>21):0] in_chord,
    output reg  [K:0]        out_root
);
    reg  [2*K-T+19+15*(K>21):0] chord;
    wire [K:0]        knot;
    wire [K-T+3:0]    step;
    wire [14:0]       offset;
    angle_knot #(.K(K), .T(T)) segment (.in_chord(chord), .out_knot(knot), .out_step(step), .out_offset(offset));
    reg  [K-T+20:0]   slope;
    wire [K-T+3:0]    rise = slope[K-T+18:15];
    reg  [K:0]        base;
    wire              unused = &{1'b0, slope};
    always @(posedge clk)
        if (in_move) begin
            chord    <= in_chord;
            slope    <= $signed(step) * $signed({1'b0, offset});
            base     <= knot;
            out_root <= base + {{(T-3){rise[K-T+3]}}, rise};
        end
endmodule
`default_nettype wire
