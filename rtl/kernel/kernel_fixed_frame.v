// SPDX-License-Identifier: Apache-2.0
// Every joint position of a chain in space of any number of links, each given by its direction in the fixed frame:
//   (x, y, z) <- (x, y, z) + L (sin p sin t, sin p cos t, cos p), from (0, 0, 0) on; in_last ends a chain
// The codec reads p in a clock of out_want, else t. One clock later in_chords holds the two roots as table segments
// (port of the table codecs, rtl/codec/README.md). The kernel knows no joint word.
// Formats: roots are odd integers of 2^-(U+1); sums are s(W+D+1).G with D = log2 N and G = D + 3, and products are
// truncated to G bits. Outputs are rounded to nearest and saturated; the sums are not saturated.
// Error of a coordinate: 1/2 + 3/16 LSB, and that of the roots times the length. Latency 6, II 6.
// Overflow: a coordinate was saturated, or the chain has more than N links; a link beyond the N-th does not count.
// Source: rational trigonometry paper, section IV-D. Model: chain.mff
`default_nettype none
module kernel_fixed_frame #(
    parameter W = 16,  // bits of a length and of a coordinate, 15 to 20 (default 16); W + log2 N at most 23
    parameter U = 16,  // fraction bits of a root, 13 to 18 (default 16: 64 units of Q7.8 stay within an LSB)
    parameter N = 32   // links of a chain, 2 to 64 (default 32)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    output wire                out_want,  // the codec reads the word of p at the input, else the held word of t
    input  wire [4*U+29:0]     in_chords,
    input  wire [W-1:0]        in_l,
    input  wire                in_last,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_last,
    output wire                out_overflow
);
    localparam [31:0] MOST = N;
    localparam D = $clog2(N), G = D + 3, C = 12;  // bits of a count below N; guard bits; bits of an offset
    localparam M = W + G, P = W + D + 1 + G;  // bits of a product without its sign, of a sum
    localparam [P-1:0] HALF = (1 << G - 1) + (1 << D - 1);  // half an LSB, and what N products of each sign lose

    // Schedule, a clock a line
    localparam [4:0]
        CHORD = 5'b00001,  // complete both roots with the two multipliers
        LEAN  = 5'b00010,  // with CHORD: these are the roots of p, not those of t, whose clock ends z
        RISE  = 5'b00100,  // L sin p and L cos p
        REACH = 5'b01000,  // a sin t and a cos t
        LAST  = 5'b10000;  // the product ends x, that of y waits for the clock after
    //                 work
    localparam [5*5-1:0] LINK = {
        /* roots of p    */ {CHORD | LEAN},
        /* products of p */ {RISE},
        /* roots of t, z */ {CHORD},
        /* products of t */ {REACH},
        /* x             */ {LAST}};
    wire idle, decode, lean, rise, reach, last;
    wire accept = in_valid && in_ready, taken = out_valid && out_ready;
    schedule #(.LINES(5), .BITS(5), .TABLE(LINK)) control (.clk(clk), .rst(rst), .in_start(accept),
        .out_idle(idle), .out_op({last, reach, rise, lean, decode}));
    wire height = decode && !lean;
    assign in_ready = idle && (!out_valid || out_ready);
    assign out_want = idle;

    wire         minor_n, neg_c, neg_n;
    wire [U+2:0] major_knot, minor_knot;
    wire [2:0]   range;
    wire [U-6:0] major_step;
    wire [U-2:0] minor_step;
    wire [C-1:0] major_offset, minor_offset;
    assign {minor_n, neg_c, neg_n, range, major_step, major_knot, major_offset, minor_step, minor_knot, minor_offset}
        = in_chords;

    // First multiplier: the major root, L cos p, a sin t. Second multiplier: the minor root, L sin p, a cos t.
    reg  [U-1:0] major, minor;  // without the last bit, which is always 1
    reg          swap;          // the first multiplier has the minor root
    reg  [W-1:0] length;
    reg  [M-1:0] a;
    wire [M-1:0] long = {length, {G{1'b0}}} & {M{rise}} | a & {M{!rise && !decode}};
    wire [M:0]   right1 = {1'b0, long | {{(M-U-1){1'b0}}, major_offset, {(U+1-C){1'b0}}} & {M{decode}}};
    wire [M:0]   right2 = {1'b0, long | {{(M-U-1){1'b0}}, minor_offset, {(U+1-C){1'b0}}} & {M{decode}}};
    wire [U+1:0] left1 = decode ? {7'h7f, major_step} : {1'b0, swap ? minor : major, 1'b1};
    wire [U+1:0] left2 = decode ? {3'd0, minor_step} : {1'b0, swap ? major : minor, 1'b1};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [M+U+2:0] product1 = $signed(left1) * $signed(right1);
    wire signed [M+U+2:0] product2 = $signed(left2) * $signed(right2);
    wire [U+2:0] first = product1[U+1 +: U+3] + major_knot;
    /* verilator lint_on UNUSEDSIGNAL */

    wire [U-1:0] thin;
    spread_minor #(.U(U)) second (.in_range(range), .in_knot(minor_knot), .in_rise(product2[U+1 +: U+3]),
        .out_root(thin));

    // z, then x, then y through one adder; the three sums rotate. A negative product is a one's complement.
    reg  [P-1:0] sum0, sum1, sum2;
    reg  [M-1:0] held, y_part;
    reg          down, back, left;  // signs of cos p, of sin p cos t and of sin p sin t
    wire         negative = out_valid ? back : last ? left : down;
    wire [M-1:0] part = (out_valid ? y_part : held) ^ {M{negative}};
    wire [P-1:0] sum = sum0 + {{(P-M){negative}}, part};
    wire         over = sum[P-1:W+G-1] != {(P-W-G+1){sum[P-1]}};
    reg          over_before;
    assign       out_y = over ? {sum[P-1], {(W-1){!sum[P-1]}}} : sum[W+G-1:G];

    // Links of the chain so far, at most N
    reg  [D:0]   links;
    reg          ends, beyond;
    wire         full = links == MOST[D:0];
    assign       out_last = ends;
    assign       out_overflow = over || over_before || beyond;

    always @(posedge clk) begin
        if (accept) begin
            length <= in_l;
            ends   <= in_last;
            beyond <= full;
            links  <= links + {{D{1'b0}}, !full};
        end
        if (accept && full)
            length <= {W{1'b0}};
        if (decode) begin
            major <= first[U+2:3];
            minor <= thin;
            swap  <= minor_n ^ lean;
            down  <= neg_c;
            back  <= lean ? neg_n : neg_c ^ back;
            left  <= lean ? neg_n : neg_n ^ left;
        end
        if (rise)
            a <= product2[U+1 +: M];
        if (rise || reach)
            held <= product1[U+1 +: M];
        if (reach)
            y_part <= product2[U+1 +: M];
        if (height)
            out_z <= out_y;
        if (last)
            out_x <= out_y;
        if (height || last)
            over_before <= over || (last && over_before);
        if (height || last || taken) begin
            sum0 <= sum1;
            sum1 <= sum2;
            sum2 <= sum;
        end
        out_valid <= last || (out_valid && !out_ready);
        if (rst || (accept && in_last))
            links <= {(D+1){1'b0}};
        if (rst || (taken && ends)) begin
            sum0 <= HALF;
            sum1 <= HALF;
            sum2 <= HALF;
        end
        if (rst)
            out_valid <= 1'b0;
    end
endmodule
`default_nettype wire
