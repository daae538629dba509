// SPDX-License-Identifier: Apache-2.0
// Every joint position of a planar chain of any number of links, streamed from the base: a link in, a position out.
//   (C, N) <- (C c - N n, C n + N c), from (1, 0) on; (x, y) <- (x, y) + L (C, N), from (0, 0) on; in_last ends a chain
// Formats: in_c1, in_n1 s2.U; in_l uW; out_x, out_y sW, rounded to nearest and saturated; the sums are not. C, N are
// s2.(U+G), x, y s(W+D+2).G with D = log2 N and G = D + 3.
// Range: the product of the lengths of the vectors is below 2; beyond it the chain wraps, and the next chain is right.
// Error of a coordinate after k links: 1/2 + 1/16 + sum over links i of sqrt(5) i L_i / 2^(U+G) LSB.
// Latency 4, II 3: the first clock of a link is the last clock of the link before it. PIPE = 1: a third multiplier for
// the lengths and registers behind all of them, the same words; latency 7, II 3.
// Overflow: a coordinate was saturated, or the chain has more than N links; a link beyond the N-th does not count.
// Source: rational trigonometry paper, section IV-D, from joint words. Model: chain.vector_chain
`default_nettype none
module kernel_vector_sum #(
    parameter W = 16,        // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter U = 16,        // fraction bits of cosine and sine, 4 to 24 (default 16, for a coordinate of 16 bits)
    parameter N = 32,        // links of a chain, 2 to 64 (default 32, a snake robot's)
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
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
    localparam M = W + 2 + G, P = W + D + 2 + G;  // bits of a product, of a sum
    localparam [P-1:0] HALF = (1 << G - 1) + (1 << D - 1);  // half an LSB, and half the truncation of N products

    wire move = !out_valid || out_ready;
    wire accept = in_valid && in_ready, taken = out_valid && out_ready;

    // x, then y through one adder; the two sums rotate. Their initial value HALF rounds.
    wire         abscissa;  // the sum is x
    wire [M-1:0] part;
    reg  [P-1:0] front, back;
    wire [P-1:0] sum = front + {{(P-M){part[M-1]}}, part};
    wire         over = sum[P-1:W+G-1] != {(P-W-G+1){sum[P-1]}};
    assign       out_y = over ? {sum[P-1], {(W-1){!sum[P-1]}}} : sum[W+G-1:G];

    // Links of the chain so far, at most N; ends and beyond belong to the last accepted link, then to the result
    reg  [W-1:0] length;
    reg  [D:0]   links;
    reg          ends, beyond, over_before;
    reg  [1:0]   shown;
    wire         full = links == MOST[D:0];
    assign       out_last = shown[1];
    assign       out_overflow = over || over_before || shown[0];

    always @(posedge clk) begin
        if (accept) begin
            length <= in_l;
            ends   <= in_last;
            beyond <= full;
            links  <= links + {{D{1'b0}}, !full};
        end
        if (accept && full)
            length <= {W{1'b0}};
        if (abscissa) begin
            out_x       <= out_y;
            over_before <= over;
        end
        if (abscissa || taken) begin
            front <= back;
            back  <= sum;
        end
        if (rst || (accept && in_last))
            links <= {(D+1){1'b0}};
        if (rst || (taken && out_last)) begin
            front <= HALF;
            back  <= HALF;
        end
    end

    generate
        if (PIPE == 0) begin : g_small
            // Schedule, a clock a line
            localparam [1:0]
                TURN = 2'b01,  // the sine; the cosine of the clock before goes on
                LAST = 2'b10;  // products with the length; the next link is taken in this clock
            //                 work
            localparam [2*2-1:0] LINK = {
                /* C n + N c */ {TURN},
                /* L C, L N  */ {LAST}};
            wire idle, turn, last;
            reg  waits;  // first clock of a link, that of C c - N n
            schedule #(.LINES(2), .BITS(2), .TABLE(LINK)) control (.clk(clk), .rst(rst), .in_start(waits && move),
                .out_idle(idle), .out_op({last, turn}));
            assign in_ready = !waits && (idle || last) && move;
            assign abscissa = last;

            // r1, r2 hold (c, n), then (n, c), then the length twice, as operands of both multipliers.
            localparam V = U + 2 + G;  // bits of C and N
            localparam [V-1:0] ONE = {2'b01, {(U+G){1'b0}}};
            localparam B = U + 2 > W + 1 ? U + 2 : W + 1, R = B + G;  // bits of them; with the zeros below
            reg  signed [V-1:0] cosine, sine;  // of the link; of the previous link in the first two clocks
            reg         [B-1:0] r1, r2;
            reg                 minus;  // r2 is the one's complement of n with ones below it: 2^-(U+G) less than -n
            reg         [V-1:0] next;
            reg         [M-1:0] y_part;
            /* verilator lint_off UNUSEDSIGNAL */
            wire signed [V+R-1:0] product1 = cosine * $signed({r1, {G{1'b0}}});
            wire signed [V+R-1:0] product2 = sine * $signed({r2, {G{minus}}});
            /* verilator lint_on UNUSEDSIGNAL */
            wire [V-1:0] cut1 = product1[U+G +: V], cut2 = product2[U+G +: V];
            wire [V-1:0] turned = cut1 + cut2 + {{(V-1){1'b0}}, 1'b1};  // the 1 centres both truncations
            assign       part = last ? product1[U+G +: M] : y_part;

            always @(posedge clk) begin
                if (!waits || move) begin
                    r1    <= turn ? {{(B-W){1'b0}}, length} : waits ? ~r2 : {{(B-U-1){in_c1[U+1]}}, in_c1[U:0]};
                    r2    <= turn ? {{(B-W){1'b0}}, length} : waits ? r1 : ~{{(B-U-1){in_n1[U+1]}}, in_n1[U:0]};
                    minus <= !turn && !waits;
                end
                next <= turned;
                if (turn) begin
                    cosine <= next;
                    sine   <= turned;
                end
                if (last) begin
                    y_part <= product2[U+G +: M];
                    shown  <= {ends, beyond};
                end
                waits     <= accept || (waits && !move);
                out_valid <= last || (out_valid && !out_ready);
                if (rst || (last && ends)) begin
                    cosine <= ONE;
                    sine   <= {V{1'b0}};
                end
                if (rst) begin
                    waits     <= 1'b0;
                    out_valid <= 1'b0;
                end
            end
        end else begin : g_fast
            // Clocks of a link; one more for its y
            localparam
                TURNED = 3,  // its direction; two clocks later L C, then L N
                SUM    = 6;  // x
            reg  [SUM:1] at;  // at[i]: a link is in its clock i
            assign in_ready = !at[1] && !at[2] && move;
            assign abscissa = at[SUM] && move;

            wire signed [U+1:0] yaw_c1, yaw_n1;  // there is none
            wire        [M:0]   along;
            wire                unused = &{1'b0, yaw_c1, yaw_n1, along[0]};
            kernel_vector_link #(.W(W), .U(U), .G(G), .MULTIPLY(MULTIPLY)) link (.clk(clk), .rst(rst), .in_move(move),
                .in_at(at[TURNED:1]), .in_c1(in_c1), .in_n1(in_n1), .in_l(length), .in_yaw(1'b0), .in_last(ends),
                .out_c1(yaw_c1), .out_n1(yaw_n1), .out_along(along));
            reg  [M-1:0]        cut;
            reg  [1:0]          flags;  // ends, beyond of the link whose length is multiplied
            assign              part = cut;

            always @(posedge clk) begin
                if (move) begin
                    {out_valid, at} <= {at, accept};
                    cut             <= along[M:1];
                    if (at[TURNED])
                        flags <= {ends, beyond};
                    if (at[SUM])
                        shown <= flags;
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
