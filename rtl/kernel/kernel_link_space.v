// SPDX-License-Identifier: Apache-2.0
// kernel_link_sum in a plane that stands upright and yaws: every joint's position of a chain of any number of links.
//   (rho, z) <- (rho, z) + L (c, n), from (0, 0) on; x = rho c3, y = rho n3; in_last ends a chain
// The first word of a chain is its yaw (c3, n3), which is kept; its length is not looked at, its position the base.
// It knows no joint word: out_read, out_kept, in_chord as of kernel_link_sum; out_yaw: the word at the input is a yaw.
// Formats: root sQ1.K; sums s(W+D+1).G with D = log2 N, G = D + 3, to which products are truncated; rho s(W+4), 4 bits
// below the LSB, saturated; outputs to nearest, saturated. Error beyond that of the roots: z 1/2 + 1/16 LSB, x, y 1/2 +
// 3/32. Latency 4, II 2: a third multiplier turns rho while the others are at the next link. Bits name the clock.
// Overflow: a coordinate or rho was saturated; or the chain has had N links before, and this one does not count.
// Model: chain.table_chain
`default_nettype none
module kernel_link_space #(
    parameter W = 16,  // bits of a length and of a coordinate, 15 to 20; their fraction bits do not matter here
    parameter K = 17,  // fraction bits of a root, 14 to 22: W + 1 keeps a coordinate within an LSB
    parameter T = 10,  // a step has K - T + 4 bits: 10 where a turn has 2^10 chords
    parameter N = 32   // links that a chain may have beside its yaw, 2 to 64
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    output wire                out_read,
    output wire                out_kept,
    output wire                out_yaw,
    input  wire [2*K-T+19:0]   in_chord,
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
    localparam M = W + 1 + G, P = W + D + 1 + G;  // bits of a product, of a sum
    localparam [31:0] MOST = N + 1;
    // Half of what N products lose, with half a unit of rho, or half an LSB of z
    localparam [P-1:0] FINE = (1 << G - 4 >> 1) + (1 << D - 1), HALF = (1 << G - 1) + (1 << D - 1);
    reg  waits, second, third;  // clocks of a link: completes the cosine; the sine, rho; z, x. In out_valid's: y
    wire move = !out_valid || out_ready;
    wire accept = in_valid && in_ready;
    assign in_ready = !waits && move;
    assign out_read = move;
    assign out_kept = waits;

    wire [K:0]     knot;
    wire [K-T+3:0] step, rise;
    wire [14:0]    offset, below;
    wire           same;  // of signs
    assign {knot, step, offset} = in_chord;
    assign {same, rise, below} = $signed(step) * $signed({1'b0, offset});
    reg  [K:0]     root;

    // A link's length and flags go with it; links counts the words of the chain, to N + 1
    reg  [W-1:0]   length0, length1;
    reg  [2:0]     flags0, flags1;  // yaw, last of the chain, beyond N links
    reg  [D:0]     links;
    wire           full = links == MOST[D:0];
    assign         out_yaw = links == 0;
    wire [M-1:0]   part;
    wire [K-G-1:0] rest;
    wire           copy_too;
    assign {copy_too, part, rest} = $signed(root) * $signed({1'b0, length1});

    // rho, then z through one adder; they change places
    reg  [P-1:0]   front, back;
    wire [P-1:0]   sum = front + {{(P-M){part[M-1]}}, part};
    wire           over = sum[P-1:W+G-1] != {(P-W-G+1){sum[P-1]}};
    wire [W+3:0]   near = over ? {sum[P-1], {(W+3){!sum[P-1]}}} : sum[W+G-1:G-4];

    reg  [K:0]          c3, n3;
    reg  signed [W+3:0] rho;
    wire                copy3, half3;
    wire [W:0]          floor3;
    wire [K+2:0]        rest3;
    assign {copy3, floor3, half3, rest3} = rho * $signed(out_valid ? n3 : c3);
    wire [W:0]          near3 = floor3 + {{W{1'b0}}, half3};
    wire                over3 = near3[W] ^ near3[W-1];
    reg                 over_rho, over_before;
    assign out_y = over3 ? {near3[W], {(W-1){!near3[W]}}} : near3[W-1:0];
    assign out_overflow = over_before || over3;
    wire                unused = &{1'b0, same, copy_too, copy3, rest, rest3, below};

    always @(posedge clk) begin
        if (accept) begin
            length0 <= in_l;
            flags0  <= {out_yaw, in_last, full};
            links   <= links + {{D{1'b0}}, !full};
        end
        if (accept && (full || out_yaw))
            length0 <= {W{1'b0}};
        if (move) begin
            root      <= knot + {{(T-3){rise[K-T+3]}}, rise};
            second    <= waits;
            third     <= second;
            out_valid <= third;
            if (waits) begin
                length1 <= length0;
                flags1  <= flags0;
            end
            if (second) begin
                rho      <= near;
                over_rho <= over;
            end
            if (second && flags1[2])
                c3 <= root;
            if (third && flags1[2])
                n3 <= root;
            if (third) begin
                out_x       <= out_y;
                out_z       <= near[W+3:4];
                over_before <= over_rho || over || over3 || flags1[0];
                out_last    <= flags1[1];
            end
            if (second || third) begin
                front <= back;
                back  <= sum;
            end
        end
        waits <= accept || (waits && !move);
        if (rst || (accept && in_last))
            links <= {(D+1){1'b0}};
        if (rst || (third && move && flags1[1])) begin
            front <= FINE;
            back  <= HALF;
        end
        if (rst) begin
            waits     <= 1'b0;
            second    <= 1'b0;
            third     <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
