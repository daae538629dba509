// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of two or three joints, one after the other, on one table codec and two multipliers.
//   x = A c1 - B n1, y = A n1 + B c1 with A = L1 + L2 c2, B = L2 n2; JOINTS = 3: z = y, then y = x n3, x = x c3
// out_want names a joint. Two clocks later in_chords holds its two roots as table segments (port of the table codecs,
// rtl/codec/README.md). The kernel knows no joint word.
// Formats: roots are odd integers of 2^-(U+1), so ~root is -root and 1.0 needs no extra bit. A and B are s(W+2+G) with
// G bits below the LSB, to which every product is truncated. Outputs are rounded to nearest (ties upward) and
// saturated.
// Error of a coordinate: 1/2 LSB, that of the roots (bounds.rational.chain), and 2^-5 LSB for each truncated product.
// Latency and II: 7 with two joints, 10 with three. Overflow: a coordinate was saturated.
// Source: rational trigonometry paper, eqs. 84 and 96. Models: rational.fk2, rational.fk3
`default_nettype none
module kernel_chain #(
    parameter JOINTS = 2,  // joints, 2 or 3 (default 2); the third turns the plane of the others
    parameter W = 16,      // bits of a length and of a coordinate, 15 to 20 (default 16)
    parameter U = 16       // fraction bits of a root, 13 to 18 (default 16)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    output wire [JOINTS:1]     out_want,  // one-hot: the codec reads this word; [2]: a sample is accepted
    input  wire [4*U+29:0]     in_chords,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output reg  signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_overflow
);
    localparam G = 5, D = 12, N = W + 2 + G;  // guard bits; bits of an offset; bits of A and B

    // Schedule, a clock a line
    localparam [5:0]
        WAIT  = 6'b000000,  // the memories' words
        CHORD = 6'b000001,  // complete both roots with the two multipliers
        COS   = 6'b000010,  // with CHORD: cosine on the first multiplier, not the sine; reads joint 1
        PLACE = 6'b000100,  // (L2, 0) turned by joint 2 and moved by L1
        ROUND = 6'b001000,  // a turn's two products, to be rounded; reads joint 3
        YAW   = 6'b010000,  // z is y; (x, 0) goes on
        LAST  = 6'b100000;  // y is rounded; x is in the clock after
    //                   roots           turn
    localparam [6*3-1:0] ELBOW = {
        /* joint 2      */ {WAIT},
        /* c2, n2       */ {CHORD | COS},
        /* A, B         */ {PLACE}};
    localparam [6*3-1:0] UPRIGHT = {
        /* c1, n1       */ {CHORD},
        /* z            */ {ROUND},
        /* x goes on    */ {YAW}};
    localparam [6*3-1:0] TIP = {
        /* c, n         */ {CHORD},
        /* y            */ {ROUND},
        /* x            */ {ROUND | LAST}};
    wire idle, decode, cosine, place, round, yaw, last;
    wire accept = in_valid && in_ready;
    generate
        if (JOINTS == 2) begin : g_two
            schedule #(.LINES(6), .BITS(6), .TABLE({ELBOW, TIP})) control (.clk(clk), .rst(rst), .in_start(accept),
                .out_idle(idle), .out_op({last, yaw, round, place, cosine, decode}));
        end else begin : g_three
            schedule #(.LINES(9), .BITS(6), .TABLE({ELBOW, UPRIGHT, TIP})) control (.clk(clk), .rst(rst),
                .in_start(accept), .out_idle(idle), .out_op({last, yaw, round, place, cosine, decode}));
            assign out_want[JOINTS] = round;
        end
    endgenerate
    assign out_want[2:1] = {accept, cosine};
    assign in_ready = idle && (!out_valid || out_ready);

    // The first multiplier forms the major root, A and one product of a turn; the second one the minor root, B and the
    // other product.
    wire         minor_n, neg_c, neg_n;
    wire [U+2:0] major_knot, minor_knot;
    wire [2:0]   range;
    wire [U-6:0] major_step;
    wire [U-2:0] minor_step;
    wire [D-1:0] major_offset, minor_offset;
    assign {minor_n, neg_c, neg_n, range, major_step, major_knot, major_offset, minor_step, minor_knot, minor_offset}
        = in_chords;
    reg  [N-1:0] a, b;
    reg  [U:0]   major, minor;  // roots with their signs, without the last bit, which is always 1
    reg          swap;          // the first multiplier has the minor root
    wire         turn = !decode && !place;
    wire [N-1:0] right1 = {{(N-U-1){1'b0}}, major_offset, {(U+1-D){1'b0}}} & {N{decode}}
                        | {2'd0, cfg_l2, {G{1'b0}}} & {N{place}} | a & {N{turn}};
    wire [N-1:0] right2 = {{(N-U-1){1'b0}}, minor_offset, {(U+1-D){1'b0}}} & {N{decode}}
                        | {2'd0, cfg_l2, {G{1'b0}}} & {N{place}} | b & {N{turn}};
    wire [U+1:0] left1 = decode ? {7'h7f, major_step} : {swap ? minor : major, 1'b1};
    wire [U+1:0] left2 = decode ? {3'd0, minor_step} : {swap ? major : minor, 1'b1};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [N+U+1:0] product1 = $signed(left1) * $signed(right1);
    wire signed [N+U+1:0] product2 = $signed(left2) * $signed(right2);
    /* verilator lint_on UNUSEDSIGNAL */
    wire [N-1:0] cut1 = product1[N+U:U+1], cut2 = product2[N+U:U+1];
    wire [N-1:0] addend = {{(N-U-3){1'b0}}, major_knot} & {N{decode}} | {2'd0, cfg_l1, {G{1'b0}}} & {N{place}}
                        | cut2 & {N{turn}};
    wire [N-1:0] sum = cut1 + addend;

    /* verilator lint_off UNUSEDSIGNAL */
    wire [U-1:0] thin;
    spread_minor #(.U(U)) second (.in_range(range), .in_knot(minor_knot), .in_rise(cut2[U+2:0]), .out_root(thin));
    /* verilator lint_on UNUSEDSIGNAL */
    wire         neg_major = minor_n ? neg_c : neg_n, neg_minor = minor_n ? neg_n : neg_c;

    // Rounding and saturation follow a register, for the clock frequency. out_y and out_z hold earlier values of out_x.
    reg  [N-1:0] exact;
    reg          over_before;
    wire [W+1:0] nearest = exact[N-1:G] + {{(W+1){1'b0}}, exact[G-1]};
    wire         over = nearest[W+1:W-1] != {3{nearest[W+1]}};
    assign       out_x = over ? {nearest[W+1], {(W-1){!nearest[W+1]}}} : nearest[W-1:0];
    assign       out_overflow = over || over_before;

    always @(posedge clk) begin
        swap <= decode ? minor_n != cosine : !swap;
        if (decode || !swap)  // a root is negated after its use by the first multiplier: (n, c), (c, -n)
            major <= decode ? {neg_major, sum[U+2:3] ^ {U{neg_major}}} : ~major;
        if (decode || swap)
            minor <= decode ? {neg_minor, thin ^ {U{neg_minor}}} : ~minor;
        if (place || yaw) begin
            a <= sum;
            b <= yaw ? {N{1'b0}} : cut2;
        end
        if (round)
            exact <= sum;
        if (yaw)
            out_z <= out_x;
        if (last)
            out_y <= out_x;
        if (accept || yaw || last)
            over_before <= !accept && out_overflow;
        out_valid <= last || (out_valid && !out_ready);
        if (rst)
            out_valid <= 1'b0;
    end
endmodule
`default_nettype wire
