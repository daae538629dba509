// SPDX-License-Identifier: Apache-2.0
// kernel_vector_sum in a plane that stands upright and yaws: every joint's position of a chain of any number of links.
//   (C, N) <- (C c - N n, C n + N c); d = L C; (x, y, z) <- (x, y, z) + (d c3, d n3, L N); in_last ends a chain
// The first word of a chain is its yaw (c3, n3), which is kept; its length is not looked at, its position the base.
// Formats: as kernel_vector_sum, with one guard bit more in d and in the sums. Right while the product of the lengths
// of the vectors, the yaw's too, stays below 2.
// Error beyond that of the directions: z 1/2 + 1/32 LSB, x and y 1/2 + 3/32.
// Latency 6, II 3: a third multiplier turns d while the others are at the next link. No table: bits name the clock.
// Overflow: a coordinate was saturated; or the chain has had N links before, and this one does not count.
// Model: chain.vector_chain
`default_nettype none
module kernel_vector_space #(
    parameter W = 16,  // bits of a coordinate and of a length, 4 to 20; their fraction bits do not matter here
    parameter U = 16,  // fraction bits of cosine and sine, 4 to 20: 16 are what a coordinate of 16 bits needs
    parameter N = 32   // links that a chain may have beside its yaw, 2 to 64, U + log2 N at most 22
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire [W-1:0]        in_l,
    input  wire                in_last,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_last,
    output wire                out_overflow
);
    localparam D = $clog2(N), G = D + 3;  // bits of a count below N; guard bits of directions, one more of positions
    localparam V = U + 2 + G, M = W + 3 + G, P = W + D + 3 + G;  // bits of C and N, of a product, of a sum
    localparam B = U + 2 > W + 1 ? U + 2 : W + 1, R = B + G;  // bits of a cosine, sine or length; with zeros behind
    localparam [V-1:0] ONE = {2'b01, {(U+G){1'b0}}};
    localparam [P-1:0] HALF = (1 << G) + (1 << D - 1);  // half an LSB, and half of what N products lose
    localparam [31:0] MOST = N + 1;
    reg  [6:1] at;  // the clock of a link: cosine; sine; products d, z; x; y. Sums: one later
    wire move = !out_valid || out_ready;
    wire accept = in_valid && in_ready;
    assign in_ready = !at[1] && !at[2] && move;
    assign out_valid = at[6];

    // The joint's word passes by both multipliers: (c, n), then (n, c), then the length twice
    reg  signed [V-1:0] cosine, sine;  // of the link; in the first two clocks of the one before it
    reg         [B-1:0] r1, r2;
    reg                 minus;  // r2 is the one's complement of n, 2^-(U+G) below -n for the bits behind it are ones
    reg         [W-1:0] length;
    reg         [V-1:0] next;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [V+R-1:0] product1 = cosine * $signed({r1, {G{1'b0}}}), product2 = sine * $signed({r2, {G{minus}}});
    /* verilator lint_on UNUSEDSIGNAL */
    wire [V-1:0] cut1 = product1[U+G +: V], cut2 = product2[U+G +: V];
    wire [V-1:0] turned = cut1 + cut2 + {{(V-1){1'b0}}, 1'b1};  // the 1 centres both cuts

    // The third multiplier turns d
    reg  signed [M-1:0] d;
    reg  signed [U+1:0] c3, n3;
    wire signed [U+1:0] factor = at[5] ? n3 : c3;
    /* verilator lint_off UNUSEDSIGNAL */
    wire [M+U+1:0]      product3 = d * factor;
    /* verilator lint_on UNUSEDSIGNAL */

    // z, x and y pass by one adder in turn
    reg  [P-1:0] front, middle, back;
    reg  [M-1:0] part;
    wire [P-1:0] sum = front + {{(P-M){part[M-1]}}, part};
    wire         over = sum[P-1:W+G] != {(P-W-G){sum[P-1]}};
    assign out_y = over ? {sum[P-1], {(W-1){!sum[P-1]}}} : sum[W+G:G+1];

    // Words of the chain so far, N + 1 at most; the flags of a link go with it
    reg  [D:0]   links;
    reg  [2:0]   flags;  // yaw, last of the chain, beyond N links
    reg  [1:0]   shown;
    reg          over_before;
    wire         full = links == MOST[D:0], yaw = links == 0;
    assign       out_last = shown[1];
    assign       out_overflow = over || over_before || shown[0];

    always @(posedge clk) begin
        if (accept) begin
            length <= in_l;
            flags  <= {yaw, in_last, full};
            links  <= links + {{D{1'b0}}, !full};
        end
        if (accept && (full || yaw))
            length <= {W{1'b0}};
        if (move) begin
            at    <= {at[5:1], accept};
            r1    <= at[2] ? {{(B-W){1'b0}}, length} : at[1] ? ~r2 : {{(B-U-1){in_c1[U+1]}}, in_c1[U:0]};
            r2    <= at[2] ? {{(B-W){1'b0}}, length} : at[1] ? r1 : ~{{(B-U-1){in_n1[U+1]}}, in_n1[U:0]};
            minus <= !at[2] && !at[1];
            next  <= turned;
            if (at[2] && flags[2]) begin
                c3 <= r2[U+1:0];
                n3 <= r1[U+1:0];
            end else if (at[2]) begin
                cosine <= next;
                sine   <= turned;
            end
            if (at[3]) begin
                d     <= product1[U+G-1 +: M];
                shown <= flags[1:0];
            end
            part <= at[3] ? product2[U+G-1 +: M] : product3[U +: M];
            if (at[4])
                out_z <= out_y;
            if (at[5])
                out_x <= out_y;
            over_before <= over || (at[5] && over_before);
            if (at[4] || at[5] || at[6]) begin
                front  <= middle;
                middle <= back;
                back   <= sum;
            end
        end
        if (rst || (accept && in_last))
            links <= {(D+1){1'b0}};
        if (rst || (at[3] && move && flags[1])) begin
            cosine <= ONE;
            sine   <= {V{1'b0}};
        end
        if (rst || (at[6] && move && out_last)) begin
            front  <= HALF;
            middle <= HALF;
            back   <= HALF;
        end
        if (rst)
            at <= 6'd0;
    end
endmodule
`default_nettype wire
