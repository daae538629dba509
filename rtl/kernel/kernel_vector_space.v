// SPDX-License-Identifier: Apache-2.0
// kernel_vector_sum in a plane that stands upright and yaws: every joint's position of a chain of any number of links.
//   (C, N) <- (C c - N n, C n + N c); (rho, z) <- (rho, z) + L (C, N); x = rho c3, y = rho n3; in_last ends a chain
// The first word of a chain is its yaw (c3, n3), which is kept; its length is not looked at, its position the base.
// Formats: as kernel_vector_sum; rho s(W+4), 4 bits below the LSB, saturated. Right while the product of the lengths of
// the vectors stays below 2.
// Error beyond that of the directions: z 1/2 + 1/16 LSB, x and y 1/2 + 3/32.
// Latency 5, II 3: a third multiplier turns rho while the others are at the next link. No table: bits name the clock.
// Overflow: a coordinate or rho was saturated; or the chain has had N links before, and this one does not count.
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
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output reg                 out_last,
    output wire                out_overflow
);
    localparam D = $clog2(N), G = D + 3;  // bits of a count below N; guard bits
    localparam V = U + 2 + G, M = W + 2 + G, P = W + D + 2 + G;  // bits of C and N, of a product, of a sum
    localparam B = U + 2 > W + 1 ? U + 2 : W + 1, R = B + G;  // bits of a cosine, sine or length; with zeros behind
    localparam [V-1:0] ONE = {2'b01, {(U+G){1'b0}}};
    localparam [31:0] MOST = N + 1;
    // Half of what N products lose, with half a unit of rho, or half an LSB of z
    localparam [P-1:0] FINE = (1 << G - 4 >> 1) + (1 << D - 1), HALF = (1 << G - 1) + (1 << D - 1);
    reg  waits, turn, last, third;  // clocks of a link: cosine; sine; rho; z, x. In that of out_valid: y
    wire move = !out_valid || out_ready;
    wire accept = in_valid && in_ready;
    assign in_ready = !waits && !turn && move;

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

    // rho, then z through one adder; they change places
    reg  [P-1:0] front, back;
    reg  [M-1:0] z_part;
    wire [M-1:0] part = last ? product1[U+G +: M] : z_part;
    wire [P-1:0] sum = front + {{(P-M){part[M-1]}}, part};
    wire         over = sum[P-1:W+G-1] != {(P-W-G+1){sum[P-1]}};
    wire [W+3:0] near = over ? {sum[P-1], {(W+3){!sum[P-1]}}} : sum[W+G-1:G-4];

    reg  signed [U+1:0] c3, n3;
    reg  signed [W+3:0] rho;
    wire                half3;
    wire [W+1:0]        floor3;
    wire [U+2:0]        rest3;
    wire signed [U+1:0] factor3 = out_valid ? n3 : c3;
    assign {floor3, half3, rest3} = rho * factor3;
    wire [W+1:0]        near3 = floor3 + {{(W+1){1'b0}}, half3};
    wire                over3 = near3[W+1:W-1] != {3{near3[W+1]}};
    assign out_y = over3 ? {near3[W+1], {(W-1){!near3[W+1]}}} : near3[W-1:0];

    // Words of the chain so far, N + 1 at most; the flags of a link go with it
    reg  [D:0]   links;
    reg  [2:0]   flags;  // yaw, last of the chain, beyond N links
    reg  [1:0]   flags1;
    reg          over_rho, over_before;
    wire         full = links == MOST[D:0], yaw = links == 0;
    assign       out_overflow = over_before || over3;
    wire         unused = &{1'b0, rest3};

    always @(posedge clk) begin
        if (accept) begin
            length <= in_l;
            flags  <= {yaw, in_last, full};
            links  <= links + {{D{1'b0}}, !full};
        end
        if (accept && (full || yaw))
            length <= {W{1'b0}};
        if (move) begin
            r1    <= turn ? {{(B-W){1'b0}}, length} : waits ? ~r2 : {{(B-U-1){in_c1[U+1]}}, in_c1[U:0]};
            r2    <= turn ? {{(B-W){1'b0}}, length} : waits ? r1 : ~{{(B-U-1){in_n1[U+1]}}, in_n1[U:0]};
            minus <= !turn && !waits;
            next  <= turned;
            if (turn && flags[2]) begin
                c3 <= r2[U+1:0];
                n3 <= r1[U+1:0];
            end else if (turn) begin
                cosine <= next;
                sine   <= turned;
            end
            if (last) begin
                z_part   <= product2[U+G +: M];
                rho      <= near;
                over_rho <= over;
                flags1   <= flags[1:0];
            end
            if (third) begin
                out_x       <= out_y;
                out_z       <= near[W+3:4];
                over_before <= over_rho || over || over3 || flags1[0];
                out_last    <= flags1[1];
            end
            if (last || third) begin
                front <= back;
                back  <= sum;
            end
            turn      <= waits;
            last      <= turn;
            third     <= last;
            out_valid <= third;
        end
        waits <= accept || (waits && !move);
        if (rst || (accept && in_last))
            links <= {(D+1){1'b0}};
        if (rst || (last && move && flags[1])) begin
            cosine <= ONE;
            sine   <= {V{1'b0}};
        end
        if (rst || (third && move && flags1[1])) begin
            front <= FINE;
            back  <= HALF;
        end
        if (rst) begin
            waits     <= 1'b0;
            turn      <= 1'b0;
            last      <= 1'b0;
            third     <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
