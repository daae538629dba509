// SPDX-License-Identifier: Apache-2.0
// Wrist of a planar arm of three joints, which a kernel of two joints then solves, and the third joint.
//   (x, y) = tip - l3 (cos phi, sin phi); j3 = phi - j1 - j2
// Formats: in_x, in_y sN.0; cfg_l3 uN.0; in_phi, in_j1, in_j2, out_j3 angles of A bits, in_phi loaded with in_start;
// out_x, out_y sN.0, rounded to nearest and saturated, valid in the clock of out_start.
// Error of a coordinate: 1/2 unit, and bounds.table.sine times l3 for the root, 1.62 * 2^-16 at N = 16. Latency 4 + 3
// PIPE, 4 + 4 PIPE with N above 16.
// Overflow: out_x or out_y was saturated.
// Source: Newton-Raphson paper, eq. 14, in closed form. Model: table.wrist
`default_nettype none
module kernel_wrist #(
    parameter N = 16,        // bits of a coordinate and of the link, 16, 20 or 24 (default 16)
    parameter A = 18,        // bits of a joint word, 10 to 24, from 12 on at N = 24 (default 18); a full turn is 2^A
    parameter PIPE = 0,      // registers behind table and products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1 and N above 16
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [N-1:0]       cfg_l3,
    input  wire               in_start,
    input  wire signed [N-1:0]in_x,
    input  wire signed [N-1:0]in_y,
    input  wire [A-1:0]       in_phi,
    input  wire [A-1:0]       in_j1,
    input  wire [A-1:0]       in_j2,
    output wire               out_idle,
    output wire               out_start,
    output reg  signed [N-1:0]out_x,
    output wire signed [N-1:0]out_y,
    output wire [A-1:0]       out_j3,
    output reg                out_overflow
);
    localparam K = N + 1;                        // fraction bits of a root
    localparam C = N > 20 ? N / 2 - 1 : N / 2 + 1, T = A > C ? C : A - 1;  // address bits of the sine table
    localparam LONG = N > 16;                    // one register more behind the product

    // Schedule, a clock a line
    localparam [2:0]
        COSINE = 3'b001,  // read the cosine
        SINE   = 3'b000,  // read the sine; the cosine is a root
        X      = 3'b010,  // x of the wrist; the sine is a root
        Y      = 3'b100;  // y of the wrist, which the kernel takes in this clock
    localparam [4*3-1:0] WRIST = {
        /* cosine */ {COSINE},
        /* sine   */ {SINE},
        /* x      */ {X},
        /* y      */ {Y}};
    localparam [(7+LONG)*3-1:0] WRIST_1 = {
        /* cosine */ {COSINE},
        /* sine   */ {(4+LONG){SINE}},
        /* x      */ {X},
        /* y      */ {Y}};
    wire cosine, first;
    generate
        if (PIPE == 0) begin : g_wrist
            schedule #(.LINES(4), .BITS(3), .TABLE(WRIST)) control (.clk(clk), .rst(rst), .in_start(in_start),
                .out_idle(out_idle), .out_op({out_start, first, cosine}));
        end else begin : g_wrist_1
            schedule #(.LINES(7+LONG), .BITS(3), .TABLE(WRIST_1)) control (.clk(clk), .rst(rst), .in_start(in_start),
                .out_idle(out_idle), .out_op({out_start, first, cosine}));
        end
    endgenerate

    reg  [A-1:0]              phi;
    wire [2*K-T+19+15*(K>21):0] segment;
    wire [K:0]                knot, from;
    wire signed [K-T+3:0]     rise;
    wire signed [15:0]        offset;
    assign                    offset[15] = 1'b0;
    angle_chord #(.A(A), .K(K), .T(T)) codec (.clk(clk), .in_read(1'b1), .in_keep(1'b0), .in_cos(cosine),
        .in_j(phi), .out_chord(segment));
    angle_knot #(.K(K), .T(T)) parts (.in_chord(segment), .out_knot(knot), .out_step(rise), .out_offset(offset[14:0]));
    reg  signed [K:0]         root;
    reg  signed [N-1:0]       goal, y;
    wire signed [K-T+19:0]    chord;
    wire signed [K+N+1:0]     link;
    generate
        if (PIPE == 0) begin : g_now
            assign from = knot;
            assign chord = rise * offset;
            assign link = root * $signed({1'b0, cfg_l3});
        end else begin : g_registered
            reg        [K:0]      knot_1, knot_2;
            reg signed [K-T+3:0]  rise_1;
            reg signed [15:0]     offset_1;
            reg signed [K-T+19:0] chord_1;
            assign                from = knot_2;
            assign                chord = chord_1;
            always @(posedge clk) begin
                knot_1   <= knot;
                rise_1   <= rise;
                offset_1 <= offset;
                knot_2   <= knot_1;
                chord_1  <= rise_1 * offset_1;
            end
            if (!LONG) begin : g_one
                reg signed [K+N+1:0] link_1;
                assign               link = link_1;
                always @(posedge clk)
                    link_1 <= root * $signed({1'b0, cfg_l3});
            end else begin : g_parts
                wire signed [K+N+1:0] product;
                reg  signed [K+N+1:0] link_2;
                assign                link = link_2;
                product_parts #(.A(K+1), .B(N+1), .MULTIPLY(MULTIPLY)) multiply (.clk(clk), .in_move(1'b1),
                    .in_a(root), .in_b({1'b0, cfg_l3}), .out_p(product));
                always @(posedge clk)
                    link_2 <= product;
            end
        end
    endgenerate
    wire [N+2:0] twice = {{2{goal[N-1]}}, goal, 1'b0} - link[K+N+1:N];  // its half is rounded to nearest
    wire         over = twice[N+2:N] != {3{twice[N+2]}};
    assign       out_y = over ? {twice[N+2], {(N-1){!twice[N+2]}}} : twice[N:1];
    assign       out_j3 = phi - in_j1 - in_j2;
    wire         unused = &{1'b0, chord[K-T+19], chord[14:0], link[N-1:0], twice[0]};
    always @(posedge clk) begin
        root <= from + {{(T-3){chord[K-T+18]}}, chord[K-T+18:15]};
        if (in_start) begin
            phi <= in_phi;
            y   <= in_y;
        end
        if (in_start || first)
            goal <= in_start ? in_x : y;
        if (first)
            out_x <= out_y;
        if (first || out_start)
            out_overflow <= over || out_start && out_overflow;
    end
endmodule
`default_nettype wire
