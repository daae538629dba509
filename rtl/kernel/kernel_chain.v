// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one to three joints, one after the other, on one table codec and two multipliers.
//   x = A c1 - B n1, y = A n1 + B c1 with A = L1 + L2 c2, B = L2 n2; JOINTS = 3: z = y, then y = x n3, x = x c3;
//   JOINTS = 1: A = L1, B = 0
// out_want names a joint. Two clocks later in_chords holds its two roots as table segments (port of the table codecs,
// rtl/codec/README.md); with PIPE = 1 and U above 18 three clocks later, and five their knots and signs.
// Formats: roots are odd integers of 2^-(U+1), so ~root is -root and 1.0 needs no extra bit. A and B are s(W+2+G) with
// G = 5 bits below the LSB, to which products are truncated. Outputs: nearest (ties upward), saturated, with overflow.
// Error of a coordinate: 1/2 LSB, that of the roots (bounds.rational.chain), and 2^-5 LSB for each truncated product.
// Latency and II: 7 + 6 PIPE with two joints, 10 + 8 PIPE with three, and PIPE more with U above 18; 5 + 5 PIPE with
// one. Source: rational trigonometry paper, eqs. 84 and 96. Models: rational_fk1.fk1, rational.fk2, rational.fk3
`default_nettype none
module kernel_chain #(
    parameter JOINTS = 2,    // joints, 2, 3 or with U above 18 1 (default 2); the third turns the plane of the others
    parameter W = 16,        // bits of a length and of a coordinate, 15 to 24 (default 16)
    parameter U = 16,        // fraction bits of a root, 13 to 24, at most W + 4 (default 16); above 18 of parabolas
    parameter PIPE = 0,      // 0 or 1 (default 0: fewest clocks); 1: registers before and behind the products
    parameter MULTIPLY = 18, // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter D = U > 18 ? 17 : 12  // bits of an offset, of one value (default 12)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    output wire [JOINTS:1]     out_want,  // the codec reads this word, or none: joint 2's; [2]: a sample is accepted,
                                          // as [1] with one joint
    input  wire [4*U+2*D+5:0]  in_chords,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output reg  signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_overflow
);
    localparam G = 5, N = W + 2 + G;  // guard bits; bits of A and B

    // Schedule, a clock a line
    localparam [9:0]
        WAIT   = 10'h000,  // the memories' words, or operands of a turn, y before x
        CHORD  = 10'h001,  // operands of both roots, to complete them with the two multipliers
        PLACE  = 10'h002,  // operands of (L2, 0) turned by joint 2 and moved by L1
        ROOTS  = 10'h004,  // the sums are the roots
        COS    = 10'h008,  // with ROOTS: cosine on the first multiplier, not the sine
        PLACED = 10'h010,  // the sums are A and B
        ROUND  = 10'h020,  // the sum is a turn's, to be rounded
        YAW    = 10'h040,  // z is y; (x, 0) goes on
        LAST   = 10'h080,  // y is rounded; x is in the clock after
        READ1  = 10'h100,  // reads joint 1
        READ3  = 10'h200;  // reads joint 3
    localparam OP = 10;    // bits of a line
    //                   work
    localparam [OP*3-1:0] ELBOW = {
        /* joint 2      */ {WAIT},
        /* c2, n2       */ {CHORD | ROOTS | COS | READ1},
        /* A, B         */ {PLACE | PLACED}};
    localparam [OP*3-1:0] UPRIGHT = {
        /* c1, n1       */ {CHORD | ROOTS},
        /* z            */ {ROUND | READ3},
        /* x goes on    */ {YAW}};
    localparam [OP*3-1:0] TIP = {
        /* c, n         */ {CHORD | ROOTS},
        /* y            */ {ROUND | READ3},
        /* x            */ {ROUND | READ3 | LAST}};
    // PIPE = 1: sums come two lines after their operands; a joint is read two lines before each
    localparam [OP*10-1:0] ELBOW_1 = {
        /* joint 2      */ {WAIT},
        /* joint 2      */ {CHORD},
        /* c2, n2       */ {WAIT},
        /* c2, n2       */ {ROOTS | COS | READ1},
        /* A, B         */ {PLACE},
        /* joint 1      */ {CHORD | READ1},
        /* A, B         */ {PLACED},
        /* c1, n1       */ {ROOTS},
        /* y            */ {READ3},
        /* x            */ {WAIT}};
    localparam [OP*5-1:0] UPRIGHT_1 = {
        /* z; joint 3   */ {ROUND | CHORD | READ3},
        /* x goes on    */ {YAW},
        /* c3, n3       */ {ROOTS},
        /* y            */ {WAIT},
        /* x            */ {WAIT}};
    localparam [OP*2-1:0] TIP_1 = {
        /* y            */ {ROUND},
        /* x            */ {ROUND | LAST}};
    // U above 18: a joint is read three lines before, and its knots five
    localparam [OP*11-1:0] ELBOW_LONG = {
        /* joint 2      */ {2{WAIT}},
        /* joint 2      */ {CHORD},
        /* c2, n2       */ {READ1},
        /* c2, n2       */ {ROOTS | COS},
        /* A, B         */ {PLACE | READ1},
        /* joint 1      */ {CHORD},
        /* A, B         */ {PLACED},
        /* c1, n1       */ {ROOTS | READ3},
        /* y            */ {WAIT},
        /* x            */ {READ3}};
    // JOINTS = 1
    localparam [OP*1-1:0] ALONE = {
        /* joint 1      */ {WAIT}};
    localparam [OP*7-1:0] ALONE_LONG = {
        /* joint 1      */ {2{WAIT}},
        /* joint 1      */ {CHORD},
        /* c1, n1       */ {WAIT},
        /* c1, n1       */ {ROOTS},
        /* y            */ {WAIT},
        /* x            */ {WAIT}};
    localparam LONG = U > 18;
    wire [OP-1:0] op;
    wire          idle;
    wire          decode = |(op & CHORD), place = |(op & PLACE), roots = |(op & ROOTS), placed = |(op & PLACED);
    wire          round = |(op & ROUND), yaw = |(op & YAW), last = |(op & LAST), cosine = |(op & COS);
    wire          accept = in_valid && in_ready, first = |(op & READ1);
    generate
        if (JOINTS == 1 && PIPE == 0) begin : g_one
            schedule #(.LINES(4), .BITS(OP), .TABLE({ALONE, TIP})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 1 && PIPE == 1) begin : g_one_long
            schedule #(.LINES(9), .BITS(OP), .TABLE({ALONE_LONG, TIP_1})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 2 && PIPE == 0) begin : g_two
            schedule #(.LINES(6), .BITS(OP), .TABLE({ELBOW, TIP})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 0) begin : g_three
            schedule #(.LINES(9), .BITS(OP), .TABLE({ELBOW, UPRIGHT, TIP})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 2 && PIPE == 1 && !LONG) begin : g_two_1
            schedule #(.LINES(12), .BITS(OP), .TABLE({ELBOW_1, TIP_1})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 1 && !LONG) begin : g_three_1
            schedule #(.LINES(17), .BITS(OP), .TABLE({ELBOW_1, UPRIGHT_1, TIP_1})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 2 && PIPE == 1 && LONG) begin : g_two_long
            schedule #(.LINES(13), .BITS(OP), .TABLE({ELBOW_LONG, TIP_1})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 1 && LONG) begin : g_three_long
            schedule #(.LINES(18), .BITS(OP), .TABLE({ELBOW_LONG, UPRIGHT_1, TIP_1})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3) begin : g_third
            assign out_want[JOINTS] = |(op & READ3);
        end
        if (JOINTS == 1) begin : g_first
            assign out_want[1] = accept;
            wire   unused = &{1'b0, first};
        end else begin : g_both
            assign out_want[2:1] = {accept, first};
        end
    endgenerate
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
    wire [N-1:0] along, across, other;  // A, B and the second product; with one joint L1, 0 and 0
    wire [N-1:0] right1 = {{(N-U-1){1'b0}}, major_offset, {(U+1-D){1'b0}}} & {N{decode}}
                        | {2'd0, cfg_l2, {G{1'b0}}} & {N{place}} | along & {N{turn}};
    wire [N-1:0] right2 = {{(N-U-1){1'b0}}, minor_offset, {(U+1-D){1'b0}}} & {N{decode}}
                        | {2'd0, cfg_l2, {G{1'b0}}} & {N{place}} | across & {N{turn}};
    wire [U+1:0] left1 = decode ? {7'h7f, major_step} : {swap ? minor : major, 1'b1};
    wire [U+1:0] left2 = decode ? {3'd0, minor_step} : {swap ? major : minor, 1'b1};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [N+U+1:0] product1, product2;
    /* verilator lint_on UNUSEDSIGNAL */
    generate
        if (PIPE == 0) begin : g_now
            assign product1 = $signed(left1) * $signed(right1);
            assign product2 = $signed(left2) * $signed(right2);
        end else begin : g_registered
            reg [U+1:0] l1, l2;
            reg [N-1:0] r1, r2;
            always @(posedge clk)
                {l1, l2, r1, r2} <= {left1, left2, right1, right2};
            product_parts #(.A(U+2), .B(N), .MULTIPLY(MULTIPLY)) parts1 (.clk(clk), .in_move(1'b1), .in_a(l1),
                .in_b(r1), .out_p(product1));
            product_parts #(.A(U+2), .B(N), .MULTIPLY(MULTIPLY)) parts2 (.clk(clk), .in_move(1'b1), .in_a(l2),
                .in_b(r2), .out_p(product2));
        end
    endgenerate
    wire [N-1:0] cut1 = product1[N+U:U+1], cut2 = product2[N+U:U+1];
    wire [N-1:0] addend = {{(N-U-3){1'b0}}, major_knot} & {N{roots}} | {2'd0, cfg_l1, {G{1'b0}}} & {N{placed}}
                        | other & {N{!roots && !placed}};
    wire [N-1:0] sum = cut1 + addend;
    generate
        if (JOINTS == 1) begin : g_link
            assign along = {2'd0, cfg_l1, {G{1'b0}}};
            assign across = {N{1'b0}};
            assign other = {N{1'b0}};
            wire   unused = &{1'b0, a, b};
        end else begin : g_links
            assign along = a;
            assign across = b;
            assign other = cut2;
        end
    endgenerate

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
        // The roots change places in every clock, and one is negated after its use by the first multiplier: (n, c),
        // (c, -n)
        swap <= roots ? minor_n != cosine : !swap;
        if (roots || !swap)
            major <= roots ? {neg_major, sum[U+2:3] ^ {U{neg_major}}} : ~major;
        if (roots || swap)
            minor <= roots ? {neg_minor, thin ^ {U{neg_minor}}} : ~minor;
        if (placed || yaw) begin
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
