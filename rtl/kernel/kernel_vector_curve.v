// SPDX-License-Identifier: Apache-2.0
// First factors and slopes of sqrt(v), 1/q and 2/sqrt(q) for kernel_vector_wide. As in kernel_vector_slopes a function
// is a product w * slope, w wiring of the argument in its segment; here w is moved by the square of the distance from
// the middle of the segment times a coefficient beside the slope. What is left is of the third order.
//   in_root, in_v: sqrt(v) and the sign of in_elbow; in_none: it is 0. in_inverse, in_q: 1/q, or 2/sqrt(q) with
//   in_clamped, and in the next clock in_read.
// Formats: 1.0 is 2^(V-1), 2^V below. in_v u0.V, in_q u0.(V-1) from 1/4 to 1; out_left s2.(V-1), out_slope u(V) as
// kernel_product wants it: out_left * out_slope is sqrt(v), or a quarter of 1/q or 2/sqrt(q), with 2 V - 3 fraction
// bits. Both come one clock after in_root, in_read, or three with PIPE = 1, and are held. Error: bounds.vector.root,
// .inverse. Latency 1 + 2 PIPE. Model: kernel_vector_wide.root_product, .inverse_product
`default_nettype none
module kernel_vector_curve #(
    parameter N = 20,                // bits of the kernel's coordinate, 20 or 24 (default 20)
    parameter ROOTS = 1,             // 0: 2/sqrt(q) alone, of in_inverse with in_clamped; 1 (default): all three
    parameter PIPE = 0,              // 0 or 1 (default 0); 1: three registers, behind memory, square and product
    parameter V = N == 24 ? 30 : 26  // bits of v, of one value (default 26)
) (
    input  wire                clk,
    input  wire                in_root,
    input  wire                in_inverse,
    input  wire                in_read,
    input  wire                in_clamped,
    input  wire                in_elbow,
    input  wire                in_none,
    input  wire [V-1:0]        in_v,
    input  wire [V-2:0]        in_q,
    output wire signed [V:0]   out_left,
    output wire [V-1:0]        out_slope
);
    localparam LARGE = N == 24;
    localparam SEGMENTS = LARGE ? 10 : 9, COUNT = 1 << SEGMENTS;  // segments of a range
    localparam SLOPE = LARGE ? 28 : 25, C = LARGE ? 8 : 5;        // bits of a slope and of a coefficient
    localparam DISTANCE = LARGE ? 8 : 5;                          // bits of the distance from the middle
    localparam M = LARGE ? 9 : 6, DROPPED = LARGE ? 6 : 3;        // bits of half its square, and those left out
    localparam SCALE = LARGE ? 7 : 3;                             // bits cut from the product with the coefficient
    localparam TOP = V - SEGMENTS;                                // bits of v below its segment
    localparam POWER = SEGMENTS + 2 * SLOPE - 3, EVEN = 63 - SEGMENTS % 2;

    // With b = 2 a + 1 and t = b / 2 COUNT: range i below 2, and the first quarter of the others, is 1/2 sqrt(t) for v
    // shifted by 0, 5, 8, 11; the rest of range 2 is 1/t^2, of range 3 t^-3/2. Coefficients fall as 1/t. Each root
    // starts Newton's rule from the previous one, which is greater.
    function [COUNT*(C+SLOPE)-1:0] curve(input integer range);
        integer    a, k;
        reg [63:0] b, square, root, twice, part;
        begin
            curve = 0;
            root = 64'd1 << 32;
            for (a = 0; a < COUNT; a = a + 1) begin
                b = {31'd0, a, 1'b1};
                square = 64'd1 << (range == 3 && 4 * a >= COUNT ? EVEN : POWER - (range == 0 ? 0 : range == 1 ? 5 :
                         range == 2 ? 8 : 11));
                square = square / b;
                if (4 * a == COUNT)
                    root = 64'd1 << 32;
                for (k = a == 0 || 4 * a == COUNT ? 0 : 20; k < 24; k = k + 1)
                    root = (root + square / root) >> 1;
                twice = root;
                part = (64'd1 << (C + SEGMENTS - 3)) / b;
                if (range == 2 && 4 * a >= COUNT) begin
                    twice = (64'd1 << (2 * SEGMENTS - 1 + SLOPE)) / (b * b);
                    part = (64'd1 << (C + SEGMENTS)) / b;
                end
                if (range == 3 && 4 * a >= COUNT) begin
                    twice = (root << (3 * SEGMENTS - 1 + 2 * SLOPE - EVEN) / 2) / b;
                    part = (64'd3 << (C + SEGMENTS - 3)) / b;
                end
                twice = (twice + 1) >> 1;
                part = (part + 1) >> 1;
                if (part >= 1 << C)
                    part = (1 << C) - 1;
                curve[(C+SLOPE)*a +: C+SLOPE] = {part[C-1:0], twice[SLOPE-1:0]};
            end
        end
    endfunction
    // One constant for each range: Icarus copies the whole constant for every entry
    localparam [COUNT*(C+SLOPE)-1:0] RANGE0 = curve(0), RANGE1 = curve(1), RANGE2 = curve(2), RANGE3 = curve(3);
    localparam        WORDS = ROOTS ? 4 * COUNT : COUNT;
    reg [C+SLOPE-1:0] memory[0:WORDS-1];
    integer           a;
    initial
        for (a = 0; a < COUNT; a = a + 1) begin
            if (ROOTS) begin
                memory[a]         = RANGE0[(C+SLOPE)*a +: C+SLOPE];
                memory[COUNT+a]   = RANGE1[(C+SLOPE)*a +: C+SLOPE];
                memory[2*COUNT+a] = RANGE2[(C+SLOPE)*a +: C+SLOPE];
            end
            memory[WORDS-COUNT+a] = RANGE3[(C+SLOPE)*a +: C+SLOPE];
        end

    // w, but for its last two bits: a constant 1 follows factor
    wire [1:0]   fold = in_v[V-1:V-13] == 0 ? 2'd3 : in_v[V-1:V-10] == 0 ? 2'd2 : in_v[V-1:V-5] == 0 ? 2'd1 : 2'd0;
    wire [V-1:0] e = fold == 2'd0 ? in_v : fold == 2'd1 ? {in_v[V-6:0], 5'h10} :
                     fold == 2'd2 ? {in_v[V-9:0], 8'h80} : {in_v[V-12:0], 11'h400};
    wire [V-2:0] root_w = {e[V-1:TOP-1], ~e[TOP-1], e[TOP-2:2]};
    wire [V-2:0] inverse_w = {1'b0, in_q[V-2:TOP-1], ~in_q[TOP-2],
                              in_clamped ? {in_q[TOP-2], ~in_q[TOP-3:2]} : ~in_q[TOP-3:1]};
    reg  [V-2:0] factor;
    reg          negative, root, none;
    reg  [C+SLOPE-1:0] found;
    localparam         ADDRESS = ROOTS ? SEGMENTS + 2 : SEGMENTS;
    /* verilator lint_off UNUSEDSIGNAL */
    wire [SEGMENTS+1:0] address = in_read ? {1'b1, in_clamped, factor[V-3 -: SEGMENTS]} : {fold, e[V-1:TOP]};
    /* verilator lint_on UNUSEDSIGNAL */
    always @(posedge clk) begin
        if (in_root || in_read)
            found <= memory[address[ADDRESS-1:0]];
        if (in_root || in_inverse) begin
            factor   <= in_inverse ? inverse_w : {(V-1){in_elbow}} ^ root_w;
            negative <= in_root && in_elbow;
            root     <= in_root;
            none     <= in_root && in_none;
        end
        if (in_root && in_none) begin
            factor   <= {(V-1){1'b0}};
            negative <= 1'b0;
        end
    end

    // u (u + 1) / 2 of the distance u, in logic: a block memory is read too late for the product with the coefficient
    (* rom_style = "logic" *)
    reg  [M-1:0]  squares[0:(1<<DISTANCE)-1];
    integer       u;
    /* verilator lint_off UNUSEDSIGNAL */
    integer       half;
    /* verilator lint_on UNUSEDSIGNAL */
    initial
        for (u = 0; u < 1 << DISTANCE; u = u + 1) begin
            half = u * (u + 1) / 2;
            squares[u] = half[DROPPED +: M];
        end
    wire [DISTANCE-1:0] distance = root ? factor[TOP-4 -: DISTANCE] ^ {DISTANCE{!factor[TOP-2]}} :
                        ~(in_clamped ? factor[TOP-5 -: DISTANCE] : factor[TOP-4 -: DISTANCE])
                        ^ {DISTANCE{factor[TOP-3]}};
    wire [C+SLOPE-1:0]  entry;
    wire [M-1:0]        found_square = squares[distance] & {M{!none}};
    wire [M-1:0]        square;
    localparam          P = C + M;
    reg  [C*P-1:0]      rows;  // of the product, added in pairs
    localparam          HALVES = LARGE && PIPE == 1;  // the last addition comes behind the register
    integer             i, j;
    always @* begin
        for (i = 0; i < C; i = i + 1)
            rows[P*i +: P] = {{C{1'b0}}, square & {M{entry[SLOPE+i]}}} << i;
        for (j = 1; j < (HALVES ? C / 2 : C); j = 2 * j)
            for (i = 0; i + j < C; i = i + 2 * j)
                rows[P*i +: P] = rows[P*i +: P] + rows[P*(i+j) +: P];
    end
    wire [P-1:0]  product;
    wire [P-1:0]  shifted = root ? product >> SCALE : product >> SCALE + 1;
    wire [P-1:0]  moved;
    generate
        case (HALVES ? 2 : PIPE)
        0: begin : g_now
            assign entry = found;
            assign square = found_square;
            assign product = rows[P-1:0];
            assign moved = shifted;
        end
        1: begin : g_registers
            reg [C+SLOPE-1:0] entry_1;
            reg [M-1:0]       square_1;
            reg [P-1:0]       moved_1;
            always @(posedge clk) begin
                entry_1  <= found;
                square_1 <= found_square;
                moved_1  <= shifted;
            end
            assign entry = entry_1;
            assign square = square_1;
            assign product = rows[P-1:0];
            assign moved = moved_1;
        end
        default: begin : g_halves
            reg [C+SLOPE-1:0] entry_1;
            reg [M-1:0]       square_1;
            reg [P-1:0]       low, high;
            always @(posedge clk) begin
                entry_1  <= found;
                square_1 <= found_square;
                low      <= rows[P-1:0];
                high     <= rows[C/2*P +: P];
            end
            assign entry = entry_1;
            assign square = square_1;
            assign product = low + high;
            assign moved = shifted;
        end
        endcase
    endgenerate
    wire           down = root && !negative;
    assign         out_left = {negative, factor, 1'b1} + ({{(V+1-P){1'b0}}, moved} ^ {(V+1){down}})
                              + {{V{1'b0}}, down};
    assign         out_slope = {entry[SLOPE-1:0], {(V-SLOPE){1'b0}}};
endmodule
`default_nettype wire
