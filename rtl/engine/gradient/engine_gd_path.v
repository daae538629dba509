// SPDX-License-Identifier: Apache-2.0
// Two multipliers of engine_quaternion_gd: from table segments of both links to the error E of the tip, its square, and
// the steps of the joints. J is not formed. With link i as the vector (xi, yi) and (ax, ay) = alpha E, link i asks for
// ei = xi ay - yi ax; joint 2 moves by e2, joint 1 by e1 + e2.
// Formats: in_chord of angle_chord, sines s2.K; links in 1/2 LSB; E in 1/64 LSB. In the fine range E has its lower W +
// 2 bits, saturated at 2^(W-5) LSB, and its square 1/256 LSB^2; in the coarse range 1/4 LSB, saturated at 2^(W-1) LSB,
// and LSB^2. All are truncated. Operands are in registers: a product is complete in the clock after the line that names
// its factors, at PIPE = 1 a clock later. Error of a tip: bounds.iterative.tip. Model: iterative.fixed.gd
`default_nettype none
module engine_gd_path #(
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
    input  wire                in_still,    // the step is 0
    input  wire [11:0]         in_op,       // a line of engine_quaternion_gd without the bits that read
    input  wire [2*K-T+19:0]   in_chord,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output reg  [A-1:0]        out_step,    // from the products of two clocks before, of three at PIPE = 1
    output reg  [2*W-1:0]      out_square
);
    localparam N = W + 9, O = W + 2;  // bits of an error and of an operand
    localparam CUT = 2 * W - A;       // bits of a product below a step

    localparam [1:0] CHORD = 2'd0, LINK1 = 2'd1, LINK2 = 2'd2, L1 = 2'd0, L2 = 2'd1, E = 2'd2;  // as in the table
    wire [1:0] left_op, right_op;
    wire       first, second, tip, clear, square;
    wire [2:0] unused_op;
    assign {left_op, right_op, unused_op, square, clear, tip, second, first} = in_op;

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

    // The last four of x1 y1 x2 y2
    reg [O-1:0] x1, y1, x2, y2;

    // Error
    reg  signed [N-1:0] e, back;
    wire [N-1:0]        from = first ? {{3{in_x[W-1]}}, in_x, 6'd0} : second ? {{3{in_y[W-1]}}, in_y, 6'd0} : back;
    wire                over = in_fine ? e[N-1:W+1] != {8{e[N-1]}} : e[N-1:W+5] != {4{e[N-1]}};
    wire [O-1:0]        f = over ? {e[N-1], {(O-1){!e[N-1]}}} : in_fine ? e[W+1:0] : e[W+5:4];
    reg  [O-1:0]        ax;

    // Step
    reg  signed [A+4:0] exact;
    always @* case ({in_fine, in_shift})
        2'd0: out_step = exact[A-1:0];
        2'd1: out_step = exact[A+1:2];
        2'd2: out_step = exact[A+3:4];
        default: out_step = {exact[A+4], exact[A+4:6]};
    endcase

    wire unused = &{1'b0, unused_op, a[14:0], b[3:0]};
    always @(posedge clk) begin
        base <= knot;
        ax   <= a[W+1+:O];
        case (left_op)
            CHORD: al <= {{(O-K+T-4){rise[K-T+3]}}, rise};
            LINK1: al <= y1;
            LINK2: al <= y2;
            default: al <= {1'b0, cfg_alpha};
        endcase
        case (left_op)
            CHORD: bl <= root;
            LINK1: bl <= x1;
            LINK2: bl <= x2;
            default: bl <= f;
        endcase
        if (left_op != LINK2) begin
            ar <= left_op == CHORD ? {{(O-15){1'b0}}, offset} : left_op == LINK1 ? ax : f;
            case (right_op)
                L1: br <= {2'd0, cfg_l1};
                L2: br <= {2'd0, cfg_l2};
                E: br <= f;
                default: br <= a[W+1+:O];
            endcase
        end
        if (first || second || tip)
            {x1, y1, x2, y2} <= {y1, x2, y2, b[W+:O]};
        e      <= from - b[W-5+:N];
        back <= e;
        if (clear)
            out_square <= {2*W{1'b0}};
        else if (square)
            out_square <= out_square + {1'b0, b[4+:2*W-1]};
        exact <= in_still ? {(A+5){1'b0}} : {b[2*O-1], b[2*O-1:CUT]} - {a[2*O-1], a[2*O-1:CUT]};
    end
endmodule
`default_nettype wire
