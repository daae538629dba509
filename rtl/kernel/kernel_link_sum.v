// SPDX-License-Identifier: Apache-2.0
// Every joint position of a planar chain of any number of links, from table segments of their absolute directions:
//   (x, y) <- (x, y) + L (c, n), from (0, 0) on; in_last ends a chain
// In a clock of out_read the codec reads the cosine of the word at the input, or with out_kept the sine of the accepted
// word. One clock later in_chord holds the segment of angle_chord (angle_knot).
// Formats: root sQ1.K; sums s(W+D+1).G with D = log2 N and G = D + 3; products are truncated to G bits. Outputs are
// rounded to nearest and saturated; the sums are not. Error: 1/2 + 1/16 LSB, and that of the roots times the length.
// Latency 3, II 2: the first clock of a link is the last clock of the link before it. PIPE = 1: registers behind the
// table and the multipliers, the same words; latency 6, II 2.
// Overflow: a coordinate was saturated, or the chain has more than N links; a link beyond the N-th does not count.
// Source: rational trigonometry paper, section IV-D, from joint words. Model: chain.table_chain
`default_nettype none
module kernel_link_sum #(
    parameter W = 16,        // bits of a length and of a coordinate, 15 to 24 (default 16)
    parameter K = 17,        // fraction bits of a root, 14 to 25 (default 17 = W + 1)
    parameter T = 9,         // address bits of the codec's table (default 9); a step has K - T + 4 bits
    parameter N = 32,        // links of a chain, 2 to 64 (default 32)
    parameter PIPE = 0,      // registers behind table and products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    output wire                out_read,  // the codec reads; else it holds its segment
    output wire                out_kept,  // the sine of the accepted word, not the cosine of the word at the input
    input  wire [2*K-T+19+15*(K>21):0] in_chord,
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
    wire move = !out_valid || out_ready;
    wire accept = in_valid && in_ready, taken = out_valid && out_ready;
    assign out_read = move;

    // x, then y through one adder; the two sums rotate. Their initial value HALF rounds.
    wire         abscissa, ends, beyond;  // the sum is x; flags of the link
    wire [M-1:0] part;
    reg  [P-1:0] front, back;
    wire [P-1:0] sum = front + {{(P-M){part[M-1]}}, part};
    wire         over = sum[P-1:W+G-1] != {(P-W-G+1){sum[P-1]}};
    reg          over_x;
    assign out_y = over ? {sum[P-1], {(W-1){!sum[P-1]}}} : sum[W+G-1:G];
    assign out_last = ends;
    assign out_overflow = over_x || over || beyond;

    // The word of the last accepted link, of the length 0 beyond N; links counts the chain's links up to N
    reg  [W-1:0] length0;
    reg          ends0, beyond0;
    reg  [D:0]   links;
    wire         full = links == MOST[D:0];
    always @(posedge clk) begin
        if (accept) begin
            length0 <= in_l;
            ends0   <= in_last;
            beyond0 <= full;
            links   <= links + {{D{1'b0}}, !full};
        end
        if (accept && full)
            length0 <= {W{1'b0}};
        if (abscissa) begin
            out_x  <= out_y;
            over_x <= over;
        end
        if (abscissa || taken) begin
            front <= back;
            back  <= sum;
        end
        if (rst || (accept && in_last))
            links <= {(D+1){1'b0}};
        if (rst || (taken && ends)) begin
            front <= HALF;
            back  <= HALF;
        end
    end

    generate
        if (PIPE == 0) begin : g_small
            reg  waits, second;  // first clock of a link: completes the cosine; second clock: forms x
            assign in_ready = !waits && move;
            assign out_kept = waits;
            assign abscissa = second;

            wire [K:0]     knot;
            wire [K-T+3:0] step, rise;
            wire [14:0]    offset, below;
            wire           same;  // copies of signs
            angle_knot #(.K(K), .T(T)) segment (.in_chord(in_chord), .out_knot(knot), .out_step(step),
                .out_offset(offset));
            assign {same, rise, below} = $signed(step) * $signed({1'b0, offset});
            reg  [K:0]     root;

            reg  [W-1:0]   length1;  // word of the link from its second clock on
            reg            ends1, beyond1;
            assign         {ends, beyond} = {ends1, beyond1};
            wire [K-G-1:0] rest;
            wire           copy_too;
            assign {copy_too, part, rest} = $signed(root) * $signed({1'b0, length1});
            wire           unused = &{1'b0, same, copy_too, rest, below};
            always @(posedge clk) begin
                if (waits && move) begin
                    length1 <= length0;
                    ends1   <= ends0;
                    beyond1 <= beyond0;
                end
                if (move)
                    root <= knot + {{(T-3){rise[K-T+3]}}, rise};
                waits     <= accept || (waits && !move);
                second    <= waits && move;
                out_valid <= second || (out_valid && !out_ready);
                if (rst) begin
                    waits     <= 1'b0;
                    second    <= 1'b0;
                    out_valid <= 1'b0;
                end
            end
        end else begin : g_fast
            // Clocks of a link, for its cosine; its sine is one clock later in each
            localparam READ = 1,  // in the memory's output
                ROOT = 4,         // a root, multiplied by the length
                SUM = 5;          // the product is added
            reg  [SUM:1] at;      // at[i]: a link is in its clock i
            assign in_ready = !at[READ] && move;
            assign out_kept = at[READ];
            assign abscissa = at[SUM] && move;

            wire [K:0]        root;
            kernel_root #(.K(K), .T(T)) roots (.clk(clk), .in_move(move), .in_chord(in_chord), .out_root(root));

            // The link's word goes with its roots: a link is taken every second clock
            reg  [W-1:0]      length1, length2;
            reg  [1:0]        flags1, flags2, shown;  // ends, beyond
            assign            {ends, beyond} = shown;
            wire [W+K+1:0]    whole;
            product_parts #(.A(K+1), .B(W+1), .MULTIPLY(MULTIPLY)) parts (.clk(clk), .in_move(move), .in_a(root),
                .in_b({1'b0, length2}), .out_p(whole));
            assign            part = whole[K-G +: M];
            wire              unused = &{1'b0, whole};
            always @(posedge clk) begin
                if (move) begin
                    if (at[READ]) begin
                        length1 <= length0;
                        flags1  <= {ends0, beyond0};
                    end
                    if (at[ROOT-1]) begin
                        length2 <= length1;
                        flags2  <= flags1;
                    end
                    if (at[SUM])
                        shown <= flags2;
                    {out_valid, at} <= {at, accept};
                end
                if (rst) begin
                    out_valid <= 1'b0;
                    at        <= {SUM{1'b0}};
                end
            end
        end
    endgenerate
endmodule
`default_nettype wire
