// SPDX-License-Identifier: Apache-2.0
// kernel_link_sum in a plane that is upright and yaws: every joint position of a chain of any number of links.
//   d = L c; (x, y, z) <- (x, y, z) + (d c3, d n3, L n), from (0, 0, 0) on; in_last ends a chain
// The first word of a chain is its yaw (c3, n3), which is held; its length is ignored and its position is the base.
// With out_cos the codec reads the cosine of the last accepted word, one clock later its sine. out_end: the sum of
// joint words restarts at 0 with the next word.
// Formats: root sQ1.K; sums s(W+D+1).G with D = log2 N and G = D + 4; products, d included, are truncated to G bits.
// Outputs are rounded to nearest and saturated; the sums are not.
// Error: 1/2 + 1/32 LSB in z, 1/2 + 3/32 in x and y, and that of the roots times the length. Latency 6, II 3.
// PIPE = 1: registers behind the table and three multipliers, the same words; latency 10, II 3.
// Overflow: a coordinate was saturated, or the chain has more than N links; a link beyond the N-th does not count.
// Source: rational trigonometry paper, section IV-D, from joint words. Model: chain.table_chain
`default_nettype none
module kernel_link_space #(
    parameter W = 16,        // bits of a length and of a coordinate, 15 to 24 (default 16)
    parameter K = 17,        // fraction bits of a root, 14 to 25 (default 17 = W + 1)
    parameter T = 10,        // address bits of the codec's table (default 10); a step has K - T + 4 bits
    parameter N = 32,        // links of a chain without its yaw, 2 to 64 (default 32)
    parameter PIPE = 0,      // registers behind table and products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    output wire                out_read,
    output wire                out_cos,
    output wire                out_end,
    input  wire [2*K-T+19+15*(K>21):0] in_chord,
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
    localparam D = $clog2(N), G = D + 4;          // bits of a count below N; guard bits
    localparam M = W + 1 + G, P = W + D + 1 + G;  // bits of a product, of a sum
    localparam [31:0] MOST = N + 1;
    localparam [P-1:0] HALF = (1 << G - 1) + (1 << D - 1);  // half an LSB, and half the truncation of N products
    // Clocks of a link: read cosine; read sine; ...; z; x; y
    localparam Y = PIPE == 0 ? 6 : 10, X = Y - 1, Z = X - 1;
    reg  [Y:1] at;
    wire       move = !out_valid || out_ready;
    wire       accept = in_valid && in_ready;
    assign     in_ready = !at[1] && !at[2] && move;
    assign     out_valid = at[Y];
    assign     out_read = move;
    assign     out_cos = at[1];

    // Length and flags of a link; links counts the words of the chain up to N + 1
    reg  [W-1:0] length;
    reg  [2:0]   flags;   // yaw, last of the chain, beyond N links
    reg  [1:0]   shown;
    reg  [D:0]   links;
    wire         full = links == MOST[D:0];
    wire         yaw = links == 0;
    assign       out_end = at[2] && move && (flags[2] || flags[1]);
    assign       out_last = shown[1];

    reg  [K:0]          c3, n3;

    // z, x and y share one adder and rotate through three registers.
    wire [M-1:0]        part;
    reg  [P-1:0]        front, middle, back;
    wire [P-1:0]        sum = front + {{(P-M){part[M-1]}}, part};
    wire                over = sum[P-1:W+G-1] != {(P-W-G+1){sum[P-1]}};
    reg                 over_before;
    assign out_y = over ? {sum[P-1], {(W-1){!sum[P-1]}}} : sum[W+G-1:G];
    assign out_overflow = over || over_before || shown[0];

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
            over_before <= !at[Z-1] && (over_before || over);
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
            // The first multiplier completes both roots, then forms d. A step occupies the upper bits of the operand.
            localparam LOW = W + T - K - 3;  // bits of a length beyond those of a step
            reg  [W-1:0]        scale;       // the length in the clock of d, else 0
            reg  [K:0]          cosine;
            wire [K:0]          knot;
            wire [K-T+3:0]      step;
            wire [14:0]         offset;
            angle_knot #(.K(K), .T(T)) segment (.in_chord(in_chord), .out_knot(knot), .out_step(step),
                .out_offset(offset));
            wire signed [W:0]   left = {at[4] ? {1'b0, scale[W-1:LOW]} : step, scale[LOW-1:0]};
            wire signed [K:0]   right = at[4] ? cosine : {{(K-14){1'b0}}, offset};
            /* verilator lint_off UNUSEDSIGNAL */
            wire [W+K+1:0]      product1 = left * right;
            /* verilator lint_on UNUSEDSIGNAL */
            wire [K-T+3:0]      rise = product1[LOW+15 +: K-T+4];
            wire [K:0]          root = knot + {{(T-3){rise[K-T+3]}}, rise};

            // The second multiplier forms L n, d c3, d n3.
            reg  signed [M-1:0] operand;
            reg  signed [K:0]   factor;
            /* verilator lint_off UNUSEDSIGNAL */
            wire [M+K:0]        product2 = operand * factor;
            /* verilator lint_on UNUSEDSIGNAL */
            assign              part = product2[K +: M];

            always @(posedge clk)
                if (move) begin
                    scale  <= at[3] ? length : {W{1'b0}};
                    factor <= at[3] ? root : at[4] ? c3 : n3;
                    if (at[2])
                        cosine <= root;
                    if (at[2] && flags[2])
                        c3 <= root;
                    if (at[3] && flags[2])
                        n3 <= root;
                    if (at[3]) begin
                        operand <= {1'b0, length, {G{1'b0}}};
                        shown   <= flags[1:0];
                    end
                    if (at[4])
                        operand <= product1[K-G +: M];
                end
        end else begin : g_fast
            // Clocks of a link. A link is taken every third clock, so its word goes on every third clock, too.
            localparam
                COSINE = 5,  // cosine times length; one clock later the sine
                D_C3   = 7,  // d c3; one clock later d n3; L n is in its product's register
                NEXT1 = 3, NEXT2 = 6, NEXT3 = 9;
            wire [K:0]          root;
            kernel_root #(.K(K), .T(T)) roots (.clk(clk), .in_move(move), .in_chord(in_chord), .out_root(root));
            reg  [K:0]          factor;
            reg  [W-1:0]        reach;
            reg  [2:0]          flags1;
            reg  [1:0]          flags2;
            reg  [M-1:0]        d, cut;
            assign              part = cut;
            /* verilator lint_off UNUSEDSIGNAL */
            wire [W+K+1:0]      product1;
            wire [M+K:0]        product2;
            /* verilator lint_on UNUSEDSIGNAL */
            product_parts #(.A(K+1), .B(W+1), .MULTIPLY(MULTIPLY)) along (.clk(clk), .in_move(move), .in_a(root),
                .in_b({1'b0, reach}), .out_p(product1));
            product_parts #(.A(M), .B(K+1), .MULTIPLY(MULTIPLY)) turn (.clk(clk), .in_move(move), .in_a(d),
                .in_b(factor), .out_p(product2));

            always @(posedge clk)
                if (move) begin
                    if (at[D_C3-1])
                        d <= product1[K-G +: M];
                    factor <= at[D_C3-1] ? c3 : n3;
                    cut    <= at[D_C3] ? product1[K-G +: M] : product2[K +: M];
                    if (at[COSINE] && flags1[2])
                        c3 <= root;
                    if (at[COSINE+1] && flags1[2])
                        n3 <= root;
                    if (at[NEXT1]) begin
                        reach  <= length;
                        flags1 <= flags;
                    end
                    if (at[NEXT2])
                        flags2 <= flags1[1:0];
                    if (at[NEXT3])
                        shown <= flags2;
                end
        end
    endgenerate
endmodule
`default_nettype wire
