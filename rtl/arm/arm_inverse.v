// SPDX-License-Identifier: Apache-2.0
// Rates of two joints in the plane, or of three of which the third yaws that plane, from the velocity of the tip.
//   v' = v (c1 - i n1), e + i f = L2 (c2 + i n2): s = -v'x / f, w1 = (v'y - e s) / L1, w2 = s - w1
//   JOINTS = 3: (v_rho + i v_t) = (x + i y)(c3 - i n3), v = v_rho + i z; w3 = v_t / rho, rho = (L1 + e) c1 - f n1
// Where |n2| is below cfg_sine, cfg_sine replaces it; cfg_radius replaces |rho|. The rates stay bounded, and only the
// velocity along the arm, or around the axis, is reduced.
// Formats: c, n s2.U; velocities s(W-F).F; rates s(W-V).V, rounded to nearest, saturated. Words inside are s(2W-V+3).G
// with G = 4 guard bits, to which products are truncated. Error: bounds.arm.rates2, bounds.arm.rates3.
// Latency and II: 7 + 7 PIPE + 2 D, with three joints 9 + 11 PIPE + 3 D, D = ceil((2 W + 7) / R).
// Status: singular (a divisor was replaced or is 0, which makes the rate 0), overflow (a rate was saturated).
// Models: arm_velocity.rates2, arm_velocity.rates3
`default_nettype none
module arm_inverse #(
    parameter JOINTS = 2,  // joints, 2 or 3 (default 2); the third turns the plane of the others about an upright axis
    parameter W = 16,      // bits of a length, a rate and a velocity, 8 to 24 (default 16)
    parameter U = 16,      // fraction bits of cosine and sine, 8 to 24 (default 16)
    parameter V = 12,      // fraction bits of a rate, W - 8 to W - 1 and at most U (default 12)
    parameter R = 4,       // digits of a quotient in one clock, 1 to 5 (default 4)
    parameter PIPE = 0,    // 0 or 1 (default 0: fewest clocks); 1: registers around the products, behind quotients
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire [U:0]          cfg_sine,
    input  wire [W-1:0]        cfg_radius,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_w1,
    output wire signed [W-1:0] out_w2,
    output wire signed [W-1:0] out_w3,
    output wire [3:0]          out_status
);
    localparam D = (2*W + 7 + R - 1) / R;        // clocks of a quotient

    // Schedule, a clock a line
    // Each constant of operands is: hold the left ones or not; left1, left2; right1, right2. The operands of the first
    // line are y, -x and joint 1, or 3 in space: the right ones that are 0, and what a start loads
    localparam HOLD = 1'b1, LOAD = 1'b0;
    localparam [1:0] C2 = 2'd0, ONE = 2'd1, C1 = 2'd2;         // the first left operand
    localparam [2:0] SINE = 3'd0, S = 3'd1, N1 = 3'd2, N2 = 3'd3, C1_2 = 3'd4;  // the second; SINE: the least or more
    localparam [2:0] Y = 3'd0, X1 = 3'd1, L2 = 3'd2, Q = 3'd3, L1 = 3'd4, P = 3'd5;  // the first right operand
    localparam [2:0] X_2 = 3'd0, Y_2 = 3'd1, L2_2 = 3'd2, A = 3'd3, B = 3'd4;  // the second
    localparam PLUS = 1'b1, MINUS = 1'b0;                      // the second product is added or subtracted
    localparam [12:0]                              // operands of the next clock
        DOT   = {HOLD, C2, SINE, X1, Y_2, PLUS},   // (x, y) with the same left ones, x c + y n
        CROSS = {HOLD, C2, SINE, Y, X_2, MINUS},   // y c - x n
        DOT1  = {LOAD, C1, N1, X1, Y_2, PLUS},     // x c1 + y n1
        LINK2 = {LOAD, C2, SINE, L2, L2_2, PLUS},  // L2 c2 and L2 |n2| with the least sine
        OFF   = {LOAD, C2, N2, L2, L2_2, PLUS},    // L2 n2
        RHO   = {LOAD, C1, C1_2, L1, A, PLUS},     // L1 c1 + e c1
        RHO2  = {LOAD, ONE, N1, P, B, MINUS},      // p less f n1
        REST  = {LOAD, ONE, S, Q, A, MINUS},       // q - e s
        NONE  = {LOAD, C2, SINE, Y, X_2, MINUS};   // no product
    localparam [11:0]              // where the sum goes, and quotients
        WAIT  = 12'h000,           // nowhere; digits
        GET_3 = 12'h001,           // w3 is made
        GET_1 = 12'h002,           // w1 is made
        GET_S = 12'h004,           // s is made
        BY_L1 = 12'h008,           // the quotient is v'y - e s by L1, not v'x by |f|
        BY_P  = 12'h010,           // it is v_t by |rho|
        START = 12'h020,           // a quotient begins
        TO_B  = 12'h040,           // the second product goes to b
        TO_A  = 12'h080,           // the first product goes to a
        TO_Q  = 12'h100,           // the sum goes to q
        TO_P  = 12'h200,           // the sum goes to p
        TO_XY = 12'h400,           // x is the sum, y is z
        TO_T  = 12'h800;           // the sum goes to t
    localparam OP = 25;            // bits of a line
    localparam [(2*D+6)*OP-1:0] PLANE = {
        /* v'y       */ {DOT,   TO_Q},
        /* v'x       */ {LINK2, TO_P},
        /* e, |f|    */ {NONE,  TO_A | TO_B},
        /* v'x / f   */ {NONE,  START},
        /* digits    */ {(D-1){NONE, WAIT}},
        /* s         */ {REST,  GET_S},
        /* v'y - e s */ {NONE,  TO_Q},
        /* w1        */ {NONE,  START | BY_L1},
        /* digits w1 */ {(D-1){NONE, WAIT}},
        /* w1, w2    */ {NONE,  GET_1}};
    localparam [(3*D+8)*OP-1:0] SPACE = {
        /* v_t       */ {DOT,   TO_T},
        /* v_rho     */ {DOT1,  TO_XY},
        /* v'x       */ {CROSS, TO_P},
        /* v'y       */ {LINK2, TO_Q},
        /* e, |f|    */ {NONE,  TO_A | TO_B},
        /* v'x / f   */ {OFF,   START},
        /* f         */ {RHO,   TO_B},
        /* rho       */ {RHO2,  TO_P},
        /* less f n1 */ {NONE,  TO_P},
        /* digits    */ {(D-4){NONE, WAIT}},
        /* s         */ {REST,  GET_S},
        /* v'y - e s */ {NONE,  TO_Q},
        /* w1        */ {NONE,  START | BY_L1},
        /* digits w1 */ {(D-1){NONE, WAIT}},
        /* w1, w2    */ {NONE,  START | BY_P | GET_1},
        /* digits w3 */ {(D-1){NONE, WAIT}},
        /* w3        */ {NONE,  GET_3}};
    // PIPE = 1: a sum is there three lines after the line that chooses its operands, and a word is chosen one line
    // after it is written. A quotient takes one clock more. The first line is too late to choose left operands.
    localparam [(2*D+13)*OP-1:0] PLANE_1 = {
        /* v'y       */ {CROSS, WAIT},
        /* v'x       */ {DOT,   WAIT},
        /* e, |f|    */ {LINK2, WAIT},
        /* v'y       */ {NONE,  TO_Q},
        /* v'x       */ {NONE,  TO_P},
        /* e, |f|    */ {NONE,  TO_A | TO_B},
        /* v'x / f   */ {NONE,  START},
        /* digits    */ {D{NONE, WAIT}},
        /* s         */ {REST,  GET_S},
        /* v'y - e s */ {2{NONE, WAIT}},
        /* v'y - e s */ {NONE,  TO_Q},
        /* w1        */ {NONE,  START | BY_L1},
        /* digits w1 */ {D{NONE, WAIT}},
        /* w1, w2    */ {NONE,  GET_1}};
    localparam [(3*D+19)*OP-1:0] SPACE_1 = {
        /* v_t       */ {CROSS, WAIT},
        /* v_rho     */ {DOT,   WAIT},
        /* v_rho     */ {NONE,  WAIT},
        /* v_t       */ {NONE,  TO_T},
        /* v_rho     */ {NONE,  TO_XY},
        /* v'x       */ {DOT1,  WAIT},
        /* v'y       */ {CROSS, WAIT},
        /* e, |f|    */ {LINK2, WAIT},
        /* v'x; f    */ {OFF,   TO_P},
        /* v'y       */ {NONE,  TO_Q},
        /* e, |f|    */ {NONE,  TO_A | TO_B},
        /* v'x / f   */ {RHO,   START | TO_B},
        /* rho       */ {2{NONE, WAIT}},
        /* rho       */ {NONE,  TO_P},
        /* digits    */ {(D-3){NONE, WAIT}},
        /* s         */ {REST,  GET_S},
        /* v'y - e s */ {2{NONE, WAIT}},
        /* v'y - e s */ {NONE,  TO_Q},
        /* w1; rho   */ {RHO2,  START | BY_L1},
        /* less f n1 */ {2{NONE, WAIT}},
        /* less f n1 */ {NONE,  TO_P},
        /* digits w1 */ {(D-3){NONE, WAIT}},
        /* w1, w2    */ {NONE,  START | BY_P | GET_1},
        /* digits w3 */ {D{NONE, WAIT}},
        /* w3        */ {NONE,  GET_3}};
    wire [OP-1:0] op;
    wire          keep;
    wire [1:0]    left1_from;
    wire [2:0]    left2_from;
    wire [6:0]    right_from;
    wire [11:0]   to;
    assign        {keep, left1_from, left2_from, right_from, to} = op;
    wire          idle;
    wire          accept = in_valid && in_ready;
    assign        in_ready = idle && (!out_valid || out_ready);
    generate
        if (JOINTS == 2 && PIPE == 0) begin : g_two
            schedule #(.LINES(2*D + 6), .BITS(OP), .TABLE(PLANE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 0) begin : g_three
            schedule #(.LINES(3*D + 8), .BITS(OP), .TABLE(SPACE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 2 && PIPE == 1) begin : g_two_1
            schedule #(.LINES(2*D + 13), .BITS(OP), .TABLE(PLANE_1)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 1) begin : g_three_1
            schedule #(.LINES(3*D + 19), .BITS(OP), .TABLE(SPACE_1)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate

    // Operands are selected one clock before their product: the left operand is registered, and so is the select of
    // the right one, or with PIPE = 1 the right one itself. left2 may be |n2|, or cfg_sine in its place
    localparam G = 4, N = 2*W - V + 3 + G, M = W + 2 + U - V, X = W - V, L = W + 4 + G;  // L: bits of a divisor
    reg  signed [W+1:0] s, w1, w3;
    wire signed [W+1:0] quotient;
    wire                zero;
    reg  signed [M-1:0] c1, n1, c2, n2, left1, left2, next1, next2;
    reg  signed [N-1:0] x, y, z, t, p, q, a, b, right1, right2;
    wire [6:0]    right;
    wire [N-1:0]  l1 = {{(N-W-G){1'b0}}, cfg_l1, {G{1'b0}}}, l2 = {{(N-W-G){1'b0}}, cfg_l2, {G{1'b0}}};
    wire [M-1:0]  one = {{(M-U-1){1'b0}}, 1'b1, {U{1'b0}}};
    wire [U+1:0]  sine = n2[U+1] ? -n2[U+1:0] : n2[U+1:0];
    wire          flat = sine < {1'b0, cfg_sine};
    always @* begin
        case (left1_from)
            ONE: next1 = one;
            C1: next1 = c1;
            default: next1 = c2;
        endcase
        case (left2_from)
            S: next2 = {quotient, {(U-V){1'b0}}};
            N1: next2 = n1;
            N2: next2 = n2;
            C1_2: next2 = c1;
            default: next2 = {{(M-U-2){1'b0}}, flat ? {1'b0, cfg_sine} : sine};
        endcase
        case (right[6:4])
            X1: right1 = x;
            L2: right1 = l2;
            Q: right1 = q;
            L1: right1 = l1;
            P: right1 = p;
            default: right1 = y;
        endcase
        case (right[3:1])
            Y_2: right2 = y;
            L2_2: right2 = l2;
            A: right2 = a;
            B: right2 = b;
            default: right2 = x;
        endcase
        right2 = right2 ^ {N{right[0] == MINUS}};
    end
    wire [N-1:0] cut1, cut2;
    wire [N-1:0] sum = cut1 + cut2;
    generate
        /* verilator lint_off UNUSEDSIGNAL */
        if (PIPE == 0) begin : g_now
            reg         [6:0]     chosen;
            wire signed [M+N-1:0] product1 = left1 * right1, product2 = left2 * right2;
            always @(posedge clk)
                chosen <= right_from;
            assign right = chosen;
            assign cut1 = product1[N+U-1:U];
            assign cut2 = product2[N+U-1:U];
        end else begin : g_registered
            reg  signed [N-1:0]   held1, held2;
            wire signed [M+N-1:0] product1, product2;
            reg         [N-1:0]   settled1, settled2;
            assign right = right_from;
            product_parts #(.A(M), .B(N), .MULTIPLY(MULTIPLY)) parts1 (.clk(clk), .in_move(1'b1), .in_a(left1),
                .in_b(held1), .out_p(product1));
            product_parts #(.A(M), .B(N), .MULTIPLY(MULTIPLY)) parts2 (.clk(clk), .in_move(1'b1), .in_a(left2),
                .in_b(held2), .out_p(product2));
            always @(posedge clk) begin
                held1    <= right1;
                held2    <= right2;
                settled1 <= product1[N+U-1:U];
                settled2 <= product2[N+U-1:U];
            end
            assign cut1 = settled1;
            assign cut2 = settled2;
        end
        /* verilator lint_on UNUSEDSIGNAL */
    endgenerate

    // Quotients v'x / |f|, (v'y - e s) / L1 and v_t / |rho|; lengths fit L bits
    wire [L-1:0] size = p[L-1:0] ^ {L{p[N-1]}}, radius = {4'd0, cfg_radius, {G{1'b0}}};
    reg          close, was_close;  // |rho| is below the least radius; it was so for w3
    wire         start = |(to & START), by_p = |(to & BY_P), by_l1 = |(to & BY_L1);
    wire [L-1:0] divisor = by_p ? (close ? radius : size) : by_l1 ? l1[L-1:0] : b[L-1:0];
    arm_quotient #(.W(W), .V(V), .N(N), .D(L), .R(R), .PIPE(PIPE)) divider (
        .clk(clk), .rst(rst), .in_start(start), .in_n(by_p ? t : by_l1 ? q : p),
        .in_negative(by_p ? p[N-1] : !by_l1 && !n2[U+1]), .in_d(divisor), .out_q(quotient), .out_zero(zero));

    // The rates are saturated
    wire        [W+2:0] w2 = {s[W+1], s} - {w1[W+1], w1};
    wire                over1 = w1[W+1:W-1] != {3{w1[W+1]}}, over2 = w2[W+2:W-1] != {4{w2[W+2]}};
    wire                over3 = JOINTS == 3 && w3[W+1:W-1] != {3{w3[W+1]}};
    reg                 singular;
    assign              out_w1 = over1 ? {w1[W+1], {(W-1){!w1[W+1]}}} : w1[W-1:0];
    assign              out_w2 = over2 ? {w2[W+2], {(W-1){!w2[W+2]}}} : w2[W-1:0];
    assign              out_w3 = over3 ? {w3[W+1], {(W-1){!w3[W+1]}}} : w3[W-1:0];
    assign              out_status = {1'b0, over1 || over2 || over3, singular, 1'b0};
    always @(posedge clk) begin
        if (accept) begin
            c1 <= {{X{in_c1[U+1]}}, in_c1};
            n1 <= {{X{in_n1[U+1]}}, in_n1};
            c2 <= {{X{in_c2[U+1]}}, in_c2};
            n2 <= {{X{in_n2[U+1]}}, in_n2};
            z  <= {{(N-W-G){in_z[W-1]}}, in_z, {G{1'b0}}};
        end
        if (!keep) begin
            left1 <= !accept ? next1 : JOINTS == 3 ? {{X{in_c3[U+1]}}, in_c3} : {{X{in_c1[U+1]}}, in_c1};
            left2 <= !accept ? next2 : JOINTS == 3 ? {{X{in_n3[U+1]}}, in_n3} : {{X{in_n1[U+1]}}, in_n1};
        end
        if (accept || |(to & TO_XY)) begin
            x <= accept ? {{(N-W-G){in_x[W-1]}}, in_x, {G{1'b0}}} : sum;
            y <= accept ? {{(N-W-G){in_y[W-1]}}, in_y, {G{1'b0}}} : z;
        end
        if (|(to & TO_T))
            t <= sum;
        if (|(to & TO_P))
            p <= sum;
        if (|(to & TO_Q))
            q <= sum;
        if (|(to & TO_A))
            a <= cut1;
        if (|(to & TO_B))
            b <= cut2;
        close <= size < radius;
        if (start)
            was_close <= by_p && close;
        if (|(to & GET_S))
            s <= quotient;
        if (|(to & GET_1))
            w1 <= quotient;
        if (|(to & GET_3))
            w3 <= quotient;
        if (accept || |(to & (GET_S | GET_1 | GET_3)))
            singular <= !accept && (singular || zero || flat || was_close);
        out_valid <= !rst && (|(to & (JOINTS == 2 ? GET_1 : GET_3)) || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
