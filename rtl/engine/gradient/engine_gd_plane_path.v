// SPDX-License-Identifier: Apache-2.0
// Two multipliers of engine_quaternion_gd_plane: from table segments of all links to the error E of the tip, its
// square, and the step of every joint. With link k as the vector (xk, yk) and (ax, ay) = alpha E, joint i moves by
//   (target - links before i) x alpha E = target x alpha E - sum over k < i of (xk ay - yk ax)
// The tip is the target less E, and E x alpha E is 0, so the target replaces the tip.
// Formats: in_chord of angle_chord, sines s2.K; links and target in 1/2 LSB; E in 1/64 LSB. In the fine range E has its
// lower W + 2 bits, saturated at 2^(W-5) LSB, and its square 1/256 LSB^2; in the coarse range 1/4 LSB, saturated at
// 2^(W-1) LSB, and LSB^2. All are truncated. Operands are in registers: a product is complete in the clock after the
// line that names its factors, at PIPE = 1 a clock later. Error of a step: bounds.iterative.plane_step. Model:
// iterative.plane.gd
`default_nettype none
module engine_gd_plane_path #(
    parameter W = 16,  // bits of a coordinate and of a length, 14 to 20 (default 16)
    parameter A = 24,  // bits of a joint word, 16 to 24 (default 24)
    parameter N = 8,   // most links, 1 to 128 (default 8): E holds all of them at full length
    parameter K = 17,  // fraction bits of a sine or cosine: W + 1
    parameter T = 10,  // address bits of the sine table; a segment's step has K - T + 4 bits
    parameter I = 6,   // bits of a link's number, 6 to 8 (default 6)
    parameter PIPE = 0 // registers behind the products, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire [W:0]          cfg_alpha,
    input  wire [1:0]          in_shift,    // steps are divided by 4^in_shift
    input  wire                in_fine,     // the range of E is fine
    input  wire                in_still,    // all steps are 0
    input  wire                in_clear,    // a sample begins
    input  wire [8:0]          in_op,       // out_op of engine_gd_plane_program
    input  wire                in_first,    // E begins with the target
    input  wire                in_read,     // read link in_link + 1 of the pass before
    input  wire [I-1:0]        in_link,
    input  wire                in_store,    // the link is complete and is stored
    input  wire                in_begin,    // the next link to store is link 1
    input  wire [2*K-T+19:0]   in_chord,
    input  wire [W-1:0]        in_length,
    input  wire [W-1:0]        in_x,
    input  wire [W-1:0]        in_y,
    output wire                out_fits,    // this coordinate of E fits the fine range
    output wire [A-1:0]        out_move,
    output reg  [2*W-1:0]      out_square
);
    localparam MORE = N < 5 ? 1 : $clog2(N) - 1;              // bits of an error beyond those of two links
    localparam N_E = W + 9 + MORE, O = W + 2, S = A + 6;      // bits of an error, an operand, a lever times alpha E
    localparam CUT = 2 * W - A;                               // bits of a product below a step

    localparam [1:0] CHORD = 2'd0, LEFT = 2'd1, GAIN = 2'd2, AIM_A = 2'd3;  // as in the table
    localparam [1:0] ROOT = 2'd0, RIGHT = 2'd1, SQUARE = 2'd2, AIM_B = 2'd3;
    wire [1:0] a_op, b_op;
    wire       clear, add, tip, plus, minus;
    assign {a_op, b_op, clear, add, tip, plus, minus} = in_op;

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
    wire [K:0]     start;  // knot of the segment whose product is a
    wire [O-1:0]   root = start + a[15+:O];
    generate
        if (PIPE == 0) begin : g_now
            assign {start, a, b} = {base, now_a, now_b};
        end else begin : g_later
            reg [K+4*O:0] later;
            assign {start, a, b} = later;
            always @(posedge clk)
                later <= {base, now_a, now_b};
        end
    endgenerate

    // Links of the pass before
    reg [2*O-1:0] links[0:(1<<I)-1];
    reg [2*O-1:0] link;
    reg [I-1:0]   to;
    reg [O-1:0]   y;

    // Error: every other link loses a unit more, so that truncation has no mean error
    reg  signed [N_E-1:0] e, other;
    wire [W-1:0]          goal = in_store ? in_x : in_y;
    wire [N_E-1:0]        from = in_first ? {{(N_E-W-6){goal[W-1]}}, goal, 6'd0} : other;
    wire                  beyond = e[N_E-1:W+5] != {(N_E-W-5){e[N_E-1]}};
    assign                out_fits = e[N_E-1:W+1] == {(N_E-W-1){e[N_E-1]}};
    wire                  over = in_fine ? !out_fits : beyond;
    wire [O-1:0]          f = over ? {e[N_E-1], {(O-1){!e[N_E-1]}}} : in_fine ? e[W+1:0] : e[W+5:4];
    reg  [O-1:0]          ax, ay;

    // Step
    reg  signed [S-1:0] lever;
    reg  [A+3:0]        exact;
    wire [S-1:0]        left = {{(S-2*O+CUT){a[2*O-1]}}, a[2*O-1:CUT]}, right = {{(S-2*O+CUT){b[2*O-1]}}, b[2*O-1:CUT]};
    always @* case (in_shift)
        2'd0: exact = lever[A+3:0];
        2'd1: exact = lever[A+5:2];
        2'd2: exact = {{2{lever[A+5]}}, lever[A+5:4]};
        default: exact = {{4{lever[A+5]}}, lever[A+5:6]};
    endcase
    assign out_move = in_fine ? exact[A+3:4] : exact[A-1:0];

    wire unused = &{1'b0, a[14:0], b[3:0]};
    always @(posedge clk) begin
        base <= knot;
        case (a_op)
            CHORD: al <= {{(O-K+T-4){rise[K-T+3]}}, rise};
            LEFT: al <= link[O-1:0];
            GAIN: al <= {1'b0, cfg_alpha};
            default: al <= ~{in_y[W-1], in_y, 1'b0};
        endcase
        case (a_op)
            CHORD: ar <= {{(O-15){1'b0}}, offset};
            LEFT: ar <= ax;
            GAIN: ar <= f;
            default: ar <= a[W+1+:O];
        endcase
        case (b_op)
            ROOT: bl <= root;
            RIGHT: bl <= link[2*O-1:O];
            SQUARE: bl <= f;
            default: bl <= ~{in_x[W-1], in_x, 1'b0};
        endcase
        case (b_op)
            ROOT: br <= {2'd0, in_length};
            RIGHT: br <= ay;
            SQUARE: br <= f;
            default: br <= a[W+1+:O];
        endcase
        if (a_op == AIM_A)
            ax <= a[W+1+:O];
        if (b_op == AIM_B)
            ay <= a[W+1+:O];

        if (tip) begin
            e     <= from + ~{{MORE{b[2*O-1]}}, b[2*O-1:W-5]} + {{(N_E-1){1'b0}}, !to[0]};
            other <= e;
        end
        y <= b[W+:O];
        if (in_store)
            links[to] <= {b[W+:O], y};
        if (in_read)
            link <= links[in_link];
        to <= in_begin ? {I{1'b0}} : to + {{(I-1){1'b0}}, in_store};

        if (clear || in_clear)
            out_square <= {2*W{1'b0}};
        else if (add)
            out_square <= out_square + {1'b0, b[4+:2*W-1]};
        if (clear || in_still)
            lever <= {{(S-10){1'b0}}, in_shift == 2'd3, 1'b0, in_shift == 2'd2, 1'b0, in_shift == 2'd1, 1'b0,
                      in_shift == 2'd0, 3'd0};  // half a unit of a step in the fine range
        else if (plus || minus)
            lever <= lever + (plus ? left : ~right) + {{(S-1){1'b0}}, !plus};
    end
endmodule
`default_nettype wire
