// SPDX-License-Identifier: Apache-2.0
// kernel_vector_sum in a plane that is upright and yaws: every joint position of a chain of any number of links.
//   (C, N) <- (C c - N n, C n + N c); d = L C; (x, y, z) <- (x, y, z) + (d c3, d n3, L N); in_last ends a chain
// The first word of a chain is its yaw (c3, n3), which is held; its length is ignored and its position is the base.
// Formats: in_c1, in_n1 s2.U; in_l uW; C, N s2.(U+G) with D = log2 N, G = D + 3; d and the sums have one guard bit
// more; outputs sW, rounded to nearest and saturated; the sums are not.
// Error: 1/2 + 1/32 LSB in z, 1/2 + 3/32 in x and y, and that of the directions (bounds.chain.vector_chain_space).
// Range: the product of the lengths of the vectors, the yaw's included, is below 2; beyond it the chain wraps.
// Latency 6, II 3: a third multiplier turns d while the others work on the next link. PIPE = 1: a fourth multiplier
// for the lengths and registers behind all of them, the same words; latency 9, II 3.
// Overflow: a coordinate was saturated, or the chain has more than N links; a link beyond the N-th does not count.
// Source: rational trigonometry paper, section IV-D, from joint words. Model: chain.vector_chain
`default_nettype none
module kernel_vector_space #(
    parameter W = 16,        // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter U = 16,        // fraction bits of cosine and sine, 4 to 24 (default 16, for a coordinate of 16 bits)
    parameter N = 32,        // links of a chain without its yaw, 2 to 64 (default 32)
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
    output wire                out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_last,
    output wire                out_overflow
);
    localparam D = $clog2(N), G = D + 3;  // bits of a count below N; guard bits of directions, positions have one more
    localparam M = W + 3 + G, P = W + D + 3 + G;  // bits of a product, of a sum
    localparam [P-1:0] HALF = (1 << G) + (1 << D - 1);  // half an LSB, and half the truncation of N products
    localparam [31:0] MOST = N + 1;
    // Clocks of a link: cosine; sine; ...; z; x; y
    localparam Y = PIPE == 0 ? 6 : 9, X = Y - 1, Z = X - 1;
    reg  [Y:1] at;
    wire move = !out_valid || out_ready;
    wire accept = in_valid && in_ready;
    assign in_ready = !at[1] && !at[2] && move;
    assign out_valid = at[Y];

    reg  signed [M-1:0] d;
    reg  signed [U+1:0] c3, n3;

    // z, x and y share one adder and rotate through three registers.
    reg  [P-1:0] front, middle, back;
    reg  [M-1:0] part;
    wire [P-1:0] sum = front + {{(P-M){part[M-1]}}, part};
    wire         over = sum[P-1:W+G] != {(P-W-G){sum[P-1]}};
    assign out_y = over ? {sum[P-1], {(W-1){!sum[P-1]}}} : sum[W+G:G+1];

    // Words of the chain so far, at most N + 1; flags of the link
    reg  [W-1:0] length;
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
            at <= {at[Y-1:1], accept};
            if (at[Z])
                out_z <= out_y;
            if (at[X])
                out_x <= out_y;
            over_before <= over || (at[X] && over_before);
            if (at[Z] || at[X] || at[Y]) begin
                front  <= middle;
                middle <= back;
                back   <= sum;
            end
        end
        if (rst || (accept && in_last))
            links <= {(D+1){1'b0}};
        if (rst || (at[Y] && move && out_last)) begin
            front  <= HALF;
            middle <= HALF;
            back   <= HALF;
        end
        if (rst)
            at <= {Y{1'b0}};
    end

    generate
        if (PIPE == 0) begin : g_small
            // r1, r2 hold (c, n), then (n, c), then the length twice, as operands of both multipliers.
            localparam V = U + 2 + G;  // bits of C and N
            localparam [V-1:0] ONE = {2'b01, {(U+G){1'b0}}};
            localparam B = U + 2 > W + 1 ? U + 2 : W + 1, R = B + G;  // bits of them; with the zeros below
            reg         [B-1:0] r1, r2;
            reg                 minus;  // r2 is the one's complement of n with ones below it: 2^-(U+G) less than -n
            reg  signed [V-1:0] cosine, sine;  // of the link; of the previous link until both are there
            reg         [V-1:0] next;
            /* verilator lint_off UNUSEDSIGNAL */
            wire signed [V+R-1:0] product1 = cosine * $signed({r1, {G{1'b0}}});
            wire signed [V+R-1:0] product2 = sine * $signed({r2, {G{minus}}});
            /* verilator lint_on UNUSEDSIGNAL */
            wire [V-1:0] cut1 = product1[U+G +: V], cut2 = product2[U+G +: V];
            wire [V-1:0] turned = cut1 + cut2 + {{(V-1){1'b0}}, 1'b1};  // the 1 centres both truncations

            // The third multiplier turns d
            wire signed [U+1:0] factor = at[5] ? n3 : c3;
            /* verilator lint_off UNUSEDSIGNAL */
            wire [M+U+1:0]      product3 = d * factor;
            /* verilator lint_on UNUSEDSIGNAL */

            always @(posedge clk) begin
                if (move) begin
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
                end
                if (rst || (at[3] && move && flags[1])) begin
                    cosine <= ONE;
                    sine   <= {V{1'b0}};
                end
            end
        end else begin : g_fast
            // Clocks of a link
            localparam
                TURNED = 3,  // (C, N) is known; the yaw is held
                D_C3   = 6;  // d c3; one clock later d n3; L N is in its product's register
            wire signed [U+1:0] yaw_c1, yaw_n1;
            wire        [M-1:0] along;
            reg         [1:0]   flags1;  // last of the chain, beyond N links: the link whose length is multiplied
            kernel_vector_link #(.W(W), .U(U), .G(G), .MULTIPLY(MULTIPLY)) link (.clk(clk), .rst(rst), .in_move(move),
                .in_at(at[TURNED:1]), .in_c1(in_c1), .in_n1(in_n1), .in_l(length), .in_yaw(flags[2]),
                .in_last(flags[1]), .out_c1(yaw_c1), .out_n1(yaw_n1), .out_along(along));

            // d is one bit longer than two multipliers take where W = 24 and N > 32
            localparam E = M < 2 * MULTIPLY ? 0 : 1;
            /* verilator lint_off UNUSEDSIGNAL */
            wire signed [M+U+1:0]   product4;
            /* verilator lint_on UNUSEDSIGNAL */
            reg  signed [U+1:0]     factor3;
            wire signed [M-E+U+1:0] most;
            product_parts #(.A(M-E), .B(U+2), .MULTIPLY(MULTIPLY)) turn3 (.clk(clk), .in_move(move),
                .in_a(d[M-1:E]), .in_b(factor3), .out_p(most));
            if (E == 0) begin : g_whole
                assign product4 = most;
            end else begin : g_bit
                reg [U+1:0] least;
                assign      product4 = {most, 1'b0} + {{M{least[U+1]}}, least};
                always @(posedge clk)
                    if (move)
                        least <= factor3 & {(U+2){d[0]}};
            end

            always @(posedge clk)
                if (move) begin
                    if (at[D_C3-1])
                        d <= along;
                    factor3 <= at[D_C3-1] ? c3 : n3;
                    part    <= at[D_C3] ? along : product4[U +: M];
                    if (at[TURNED])
                        flags1 <= flags[1:0];
                    if (at[TURNED] && flags[2]) begin
                        c3 <= yaw_c1;
                        n3 <= yaw_n1;
                    end
                    if (at[D_C3])
                        shown <= flags1;
                end
        end
    endgenerate
endmodule
`default_nettype wire
