// SPDX-License-Identifier: Apache-2.0
// Every joint position of a planar chain of any number of links, from table segments of their absolute directions:
//   (x, y) <- (x, y) + L (c, n), from (0, 0) on; in_last ends a chain
// In a clock of out_read the codec reads the cosine of the word at the input, or with out_kept the sine of the accepted
// word. One clock later in_chord holds the segment {knot, step, offset} of angle_chord. The kernel knows no joint word.
// Formats: root sQ1.K; sums s(W+D+1).G with D = log2 N and G = D + 3; products are truncated to G bits. Outputs are
// rounded to nearest and saturated; the sums are not saturated.
// Error of a coordinate: 1/2 + 1/16 LSB, and that of the roots times the length.
// Latency 3, II 2: the first clock of a link is the last clock of the link before it.
// Overflow: a coordinate was saturated, or the chain has more than N links; a link beyond the N-th does not count.
// Source: rational trigonometry paper, section IV-D, from joint words. Model: chain.table_chain
`default_nettype none
module kernel_link_sum #(
    parameter W = 16,  // bits of a length and of a coordinate, 15 to 20 (default 16)
    parameter K = 17,  // fraction bits of a root, 14 to 22 (default 17 = W + 1)
    parameter T = 9,   // address bits of the codec's table (default 9); a step has K - T + 4 bits
    parameter N = 32   // links of a chain, 2 to 64 (default 32)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    output wire                out_read,  // the codec reads; else it holds its segment
    output wire                out_kept,  // the sine of the accepted word, not the cosine of the word at the input
    input  wire [2*K-T+19:0]   in_chord,
    input  wire [W-1:0]        in_l,
    input  wire                in_last,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire                out_last,
    output wire                out_overflow
);
    localparam [31:0] MOST = N;
    localparam D = $clog2(N), G = D + 3;  // bits of a count below N; guard bits
    localparam M = W + 1 + G, P = W + D + 1 + G;  // bits of a product, of a sum
    localparam [P-1:0] HALF = (1 << G - 1) + (1 << D - 1);  // half an LSB, and half the truncation of N products
    reg  waits, second;  // first clock of a link: completes the cosine; second clock: forms x
    wire move = !out_valid || out_ready;
    wire accept = in_valid && in_ready, taken = out_valid && out_ready;
    assign in_ready = !waits && move;
    assign out_read = move;
    assign out_kept = waits;

    wire [K:0]     knot;
    wire [K-T+3:0] step, rise;
    wire [14:0]    offset, below;
    wire           same;  // copies of signs
    assign {knot, step, offset} = in_chord;
    assign {same, rise, below} = $signed(step) * $signed({1'b0, offset});
    reg  [K:0]     root;

    // Length and flags of a link in its first clock and in the two after it; links counts the chain's links up to N
    reg  [W-1:0]   length0, length1;
    reg            ends0, ends1, beyond0, beyond1;
    reg  [D:0]     links;
    wire           full = links == MOST[D:0];
    wire [M-1:0]   part;
    wire [K-G-1:0] rest;
    wire           copy_too;
    assign {copy_too, part, rest} = $signed(root) * $signed({1'b0, length1});
    wire           unused = &{1'b0, same, copy_too, rest, below};

    // x, then y through one adder; the two sums rotate. Their initial value HALF rounds.
    reg  [P-1:0]   front, back;
    wire [P-1:0]   sum = front + {{(P-M){part[M-1]}}, part};
    wire           over = sum[P-1:W+G-1] != {(P-W-G+1){sum[P-1]}};
    reg            over_x;
    assign out_y = over ? {sum[P-1], {(W-1){!sum[P-1]}}} : sum[W+G-1:G];
    assign out_last = ends1;
    assign out_overflow = over_x || over || beyond1;
    always @(posedge clk) begin
        if (accept) begin
            length0 <= in_l;
            ends0   <= in_last;
            beyond0 <= full;
            links   <= links + {{D{1'b0}}, !full};
        end
        if (accept && full)
            length0 <= {W{1'b0}};
        if (waits && move) begin
            length1 <= length0;
            ends1   <= ends0;
            beyond1 <= beyond0;
        end
        if (move)
            root <= knot + {{(T-3){rise[K-T+3]}}, rise};
        if (second) begin
            out_x  <= out_y;
            over_x <= over;
        end
        if (second || taken) begin
            front <= back;
            back  <= sum;
        end
        waits     <= accept || (waits && !move);
        second    <= waits && move;
        out_valid <= second || (out_valid && !out_ready);
        if (rst || (accept && in_last))
            links <= {(D+1){1'b0}};
        if (rst || (taken && ends1)) begin
            front <= HALF;
            back  <= HALF;
        end
        if (rst) begin
            waits     <= 1'b0;
            second    <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
