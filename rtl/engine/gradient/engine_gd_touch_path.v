// SPDX-License-Identifier: Apache-2.0
// Two multipliers of engine_quaternion_gd_touch: from table segments of three joints to the error E of the tip, its
// square, and the steps. With rho = L1 c2 + L2 s3, E has v = c1 z - s1 x - rho along the plane of the links, u = c1 x +
// s1 z across it, and w = y - L1 s2 + L2 c3 upward. With a = alpha E the joints move by e1 = -rho au, e2 = L1 c2 aw -
// L1 s2 av and e3 = L2 s3 aw + L2 c3 av. Neither the tip nor J is formed. The sines come as -c1, s1, c2, s3, s2, -c3,
// so every product is subtracted; u is kept negated.
// Formats: in_chord of angle_chord, sines s2.K; links in 1/2 LSB; E in 1/64 LSB. In the fine range E has its lower W +
// 2 bits, saturated at 2^(W-5) LSB, and its square 1/256 LSB^2; in the coarse range 1/4 LSB, saturated at 2^(W-1) LSB,
// and LSB^2. All are truncated. Error of a tip: bounds.iterative.tip_touch. Model: iterative.fixed.gd_touch
`default_nettype none
module engine_gd_touch_path #(
    parameter W = 16,  // bits of a coordinate and of a length, 14 to 20 (default 16)
    parameter A = 24,  // bits of a joint word, 16 to 24 (default 24)
    parameter K = 17,  // fraction bits of a sine or cosine: W + 1
    parameter T = 10,  // address bits of the sine table; a segment's step has K - T + 4 bits
    parameter PIPE = 0 // registers behind the products, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire [W:0]          cfg_alpha,
    input  wire                in_shift,    // steps are divided by 4
    input  wire                in_fine,     // the range of E is fine
    input  wire                in_finer,    // the range of the step is fine
    input  wire                in_alone,    // the step has no product of the first multiplier
    input  wire [17:0]         in_op,       // a line of engine_quaternion_gd_touch without its joints
    input  wire [2*K-T+19:0]   in_chord,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    output reg  [A-1:0]        out_step,    // from the products of the clock before, of two at PIPE = 1
    output reg  [2*W-1:0]      out_square
);
    localparam N = W + 9, O = W + 2;  // bits of an error and of an operand
    localparam CUT = 2 * W - A;       // bits of a product below a step

    // As in the table, of operands the upper two bits
    localparam [1:0] CHORD = 2'd0, ACROSS = 2'd1, ALPHA = 2'd2, ROOT = 2'd0, SQUARE = 2'd1, ARM = 2'd2;
    localparam [1:0] UP = 2'd2, STAY = 2'd3;
    wire [1:0] left_op, right_op;
    wire       prior, keep, goal, far, across, seen_u, seen_w, up, less, link, pair, side, square, clear;
    assign {left_op, prior, right_op, keep, goal, far, across, seen_u, seen_w, up, less, link, pair, side, square,
        clear} = in_op;

    // Products
    reg  signed [O-1:0]   al, ar, bl, br;
    wire signed [2*O-1:0] now_a = al * ar, now_b = bl * br;
    wire signed [2*O-1:0] a, b;

    // Table segment to sine or cosine
    wire [K:0]     knot;
    wire [K-T+3:0] rise;
    wire [14:0]    offset;
    assign {knot, rise, offset} = in_chord;
    reg  [K:0]     base;
    wire [K:0]     start;         // knot of the segment whose product is a
    wire [O-1:0]   root = start + a[15+:O];
    reg  [O-1:0]   root1, root2;  // -c1 s1

    // Links: L1 c2, L2 s3, L1 s2, -L2 c3
    reg  [O-1:0]   c2, s3, s2, c3;
    wire [O-1:0]   rho = c2 + s3;

    // Error: e is v, then w; u is negated
    reg  signed [N-1:0] e, v, u, part;
    wire [N-1:0]        from = up ? {{3{in_y[W-1]}}, in_y, 6'd0} : less ? e : {N{1'b0}};
    wire [N-1:0]        seen = seen_u ? u : seen_w || PIPE == 1 ? e : v;  // PIPE = 1: v is still in e
    wire                over = in_fine ? seen[N-1:W+1] != {8{seen[N-1]}} : seen[N-1:W+5] != {4{seen[N-1]}};
    wire [O-1:0]        f = over ? {seen[N-1], {(O-1){!seen[N-1]}}} : in_fine ? seen[W+1:0] : seen[W+5:4];
    reg  [O-1:0]        av;

    // Coordinate or length that is multiplied
    wire [W-1:0] target = across ? in_x : in_z;
    wire [W:0]   word = goal ? {target[W-1], target} : {1'b0, far ? cfg_l2 : cfg_l1};

    // Step
    wire signed [A+4:0] exact;
    wire        [A+3:0] asked = in_alone ? {(A+4){1'b0}} : a[2*O-1:CUT];  // less than what b asks for
    generate
        if (PIPE == 0) begin : g_now
            reg signed [A+3:0] ea, eb;
            assign {start, a, b} = {base, now_a, now_b};
            assign exact = {eb[A+3], eb} - {ea[A+3], ea};
            always @(posedge clk)
                {ea, eb} <= {asked, b[2*O-1:CUT]};
        end else begin : g_later
            reg [A+4:0]   difference;
            reg [K+4*O:0] later;
            assign {start, a, b} = later;
            assign exact = difference;
            always @(posedge clk) begin
                difference <= {b[2*O-1], b[2*O-1:CUT]} - {asked[A+3], asked};
                later      <= {base, now_a, now_b};
            end
        end
    endgenerate
    always @* case ({in_finer, in_shift})
        2'd0: out_step = exact[A-1:0];
        2'd1: out_step = exact[A+1:2];
        2'd2: out_step = exact[A+3:4];
        default: out_step = {exact[A+4], exact[A+4:6]};
    endcase

    wire unused = &{1'b0, a, b};
    always @(posedge clk) begin
        base <= knot;
        case (left_op)
            CHORD: al <= {{(O-K+T-4){rise[K-T+3]}}, rise};
            ACROSS: al <= {{2{target[W-1]}}, target};
            ALPHA: al <= {1'b0, cfg_alpha};
            default: al <= s2;
        endcase
        case (left_op)
            CHORD: ar <= {{(O-15){1'b0}}, offset};
            ACROSS: ar <= root1;
            ALPHA: ar <= prior ? bl : f;
            default: ar <= av;
        endcase
        case (right_op)
            ROOT: bl <= root;
            SQUARE: bl <= f;
            ARM: bl <= rho;
            default: bl <= c2;
        endcase
        if (!keep)
            br <= right_op == ROOT ? {word[W], word} : right_op == SQUARE ? f : a[W+1+:O];
        if (pair)
            {root1, root2} <= {root2, root};
        if (link)
            {c2, s3, s2, c3} <= {s3, s2, c3, b[W+:O]};
        if ({up, less} != STAY)
            e <= from - b[W-5+:N];
        if ({up, less} == UP)
            v <= e;
        part <= a[W-5+:N];
        if (side)
            u <= part - a[W-5+:N];
        if (seen_u)
            av <= a[W+1+:O];
        if (clear)
            out_square <= {2*W{1'b0}};
        else if (square)
            out_square <= out_square + {1'b0, b[4+:2*W-1]};
    end
endmodule
`default_nettype wire
