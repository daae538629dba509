// SPDX-License-Identifier: Apache-2.0
// Velocity of the tip from the joints' rates, for two joints in the plane, or for three of which the third yaws it.
//   e + i f = L2 (c2 + i n2), s = w1 + w2: v' = -f s + i ((L1 + e) s - L1 w2) seen from link 1; joint 1 turns it
//   JOINTS = 3: x + i y = (v_rho + i rho w3)(c3 + i n3), rho = (L1 + e) c1 - f n1
// Formats: c, n s2.U (1.0 is 2^U); rates s(W-V).V; a, b, p, q s(2W-V+3).G with G = 4 guard bits below the LSB of a
// coordinate, to which every product is truncated. Outputs are rounded to nearest (ties upward) and saturated.
// Error of a coordinate: 1/2 + E / 16 LSB, E = 3 + sqrt((|s| + |w2| + 2)^2 + (2 |s| + 1)^2), rates in radians;
// JOINTS = 3: 1/2 + (3 + sqrt(E^2 + (1 + (3 + sqrt 2) |w3|)^2)) / 16.
// Latency and II: 6, with PIPE = 1 14; with three joints 10, 19. Overflow: a coordinate was saturated.
// Models: arm_velocity.velocity2, arm_velocity.velocity3
`default_nettype none
module arm_jacobian #(
    parameter JOINTS = 2,  // joints, 2 or 3 (default 2); the third turns the plane of the others about an upright axis
    parameter W = 16,      // bits of a length, a rate and a velocity, 8 to 24 (default 16)
    parameter U = 16,      // fraction bits of cosine and sine, 8 to 24 (default 16)
    parameter V = 12,      // fraction bits of a rate, W - 8 to W - 1 and at most U (default 12: rates below 8 rad)
    parameter PIPE = 0,    // 0 or 1 (default 0: fewest clocks); 1: registers around the products
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    input  wire signed [W-1:0] in_w1,
    input  wire signed [W-1:0] in_w2,
    input  wire signed [W-1:0] in_w3,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_overflow
);
    // Schedule, a clock a line
    // Each constant chooses: left1, left2; right1, right2. The operands of the first line are L2 and (c2, n2): the
    // right ones that are 0, and what a start loads
    localparam [2:0] ZERO = 3'd0;                              // left operands
    localparam [2:0] S1 = 3'd1, C1 = 3'd2, N1 = 3'd3, W3 = 3'd4, C3 = 3'd5, N3 = 3'd6;  // the first
    localparam [2:0] W2_2 = 3'd1, S_2 = 3'd2, N1_2 = 3'd3, C1_2 = 3'd4, N3_2 = 3'd5, C3_2 = 3'd6;  // the second
    localparam [1:0] L2 = 2'd0, A = 2'd1, Q = 2'd2, P = 2'd3;  // right operands, the first
    localparam [1:0] L1 = 2'd1, B = 2'd2;                      // the second, which may also be L2 or P
    localparam PLUS = 1'b0, MINUS = 1'b1;                      // the second product is added or subtracted
    localparam [10:0]                             // operands of the next clock
        ALONG = {S1, W2_2, A, L1, MINUS},         // velocity across link 1, a s - L1 w2
        DOWN  = {ZERO, S_2, A, B, MINUS},         // velocity along link 1, -b s
        RHO   = {C1, N1_2, A, B, MINUS},          // distance from the yaw axis, a c1 - b n1
        YAW   = {W3, ZERO, A, L2, PLUS},          // velocity of the plane there, a w3
        LEVEL = {C1, N1_2, Q, P, MINUS},          // v' turned by joint 1, the first coordinate, q c1 - p n1
        UP    = {N1, C1_2, Q, P, PLUS},           // the second, q n1 + p c1
        TURN3 = {C3, N3_2, P, B, MINUS},          // (p, b) turned by joint 3, the first coordinate
        LAST3 = {N3, C3_2, P, B, PLUS},           // the second sum
        NONE  = {ZERO, ZERO, L2, L2, PLUS};       // none
    localparam [7:0]              // where the sum goes
        WAIT  = 8'h00,            // nowhere
        LAST  = 8'h01,            // the results are valid in the next clock
        TO_X  = 8'h02,            // a is x
        TO_Z  = 8'h04,            // a is z
        TO_Q  = 8'h08,            // the sum goes to q
        TO_P  = 8'h10,            // the sum goes to p
        TO_B  = 8'h20,            // the sum goes to b, with EACH the second product alone
        TO_A  = 8'h40,            // the sum goes to a
        EACH  = 8'h80;            // L1 is added to the first product, not the second one
    localparam OP = 19;           // bits of a line
    localparam [5*OP-1:0] PLANE = {
        /* L1 + e, f */ {ALONG, EACH | TO_A | TO_B},
        /* v' across */ {DOWN,  TO_P},
        /* v' along  */ {LEVEL, TO_Q},
        /* x         */ {UP,    TO_A},
        /* y         */ {NONE,  TO_A | TO_X | LAST}};
    localparam [9*OP-1:0] SPACE = {
        /* L1 + e, f */ {ALONG, EACH | TO_A | TO_B},
        /* v' across */ {DOWN,  TO_P},
        /* v' along  */ {RHO,   TO_Q},
        /* rho       */ {YAW,   TO_A},
        /* rho w3    */ {UP,    TO_B},
        /* z         */ {LEVEL, TO_A},
        /* v_rho     */ {TURN3, TO_P | TO_Z},
        /* x         */ {LAST3, TO_A},
        /* y         */ {NONE,  TO_A | TO_X | LAST}};
    // PIPE = 1: a sum is there three lines after the line that chooses its operands, and a word is chosen one line
    // after it is written
    localparam [13*OP-1:0] PLANE_1 = {
        /* e, f      */ {2{NONE, WAIT}},
        /* L1 + e, f */ {NONE,  EACH | TO_A | TO_B},
        /* v' across */ {ALONG, WAIT},
        /* v' along  */ {DOWN,  WAIT},
        /* waits     */ {NONE,  WAIT},
        /* v' across */ {NONE,  TO_P},
        /* v' along  */ {NONE,  TO_Q},
        /* x         */ {LEVEL, WAIT},
        /* y         */ {UP,    WAIT},
        /* waits     */ {NONE,  WAIT},
        /* x         */ {NONE,  TO_A},
        /* y         */ {NONE,  TO_A | TO_X | LAST}};
    localparam [18*OP-1:0] SPACE_1 = {
        /* e, f      */ {2{NONE, WAIT}},
        /* L1 + e, f */ {NONE,  EACH | TO_A | TO_B},
        /* v' across */ {ALONG, WAIT},
        /* v' along  */ {DOWN,  WAIT},
        /* rho       */ {RHO,   WAIT},
        /* v' across */ {NONE,  TO_P},
        /* v' along  */ {NONE,  TO_Q},
        /* rho       */ {LEVEL, TO_A},
        /* rho w3    */ {YAW,   WAIT},
        /* z         */ {UP,    WAIT},
        /* v_rho     */ {NONE,  TO_P},
        /* rho w3    */ {NONE,  TO_B},
        /* z; x      */ {TURN3, TO_A},
        /* y         */ {LAST3, TO_Z},
        /* waits     */ {NONE,  WAIT},
        /* x         */ {NONE,  TO_A},
        /* y         */ {NONE,  TO_A | TO_X | LAST}};
    wire [OP-1:0] op;
    wire [2:0]    left1_from, left2_from;
    wire [4:0]    right_from;
    wire [7:0]    to;
    assign        {left1_from, left2_from, right_from, to} = op;
    wire          idle;
    wire          accept = in_valid && in_ready;
    assign        in_ready = idle && (!out_valid || out_ready);
    generate
        if (JOINTS == 2 && PIPE == 0) begin : g_two
            schedule #(.LINES(5), .BITS(OP), .TABLE(PLANE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 0) begin : g_three
            schedule #(.LINES(9), .BITS(OP), .TABLE(SPACE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 2 && PIPE == 1) begin : g_two_1
            schedule #(.LINES(13), .BITS(OP), .TABLE(PLANE_1)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
        if (JOINTS == 3 && PIPE == 1) begin : g_three_1
            schedule #(.LINES(18), .BITS(OP), .TABLE(SPACE_1)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate

    // Left operands are c, n and the rates, aligned to U fraction bits; right ones are lengths and velocities. Both are
    // selected one clock before their product: the left operand is registered, and so is the select of the right one,
    // or with PIPE = 1 the right one itself
    localparam G = 4, N = 2*W - V + 3 + G;  // guard bits; bits of a velocity word
    localparam M = W + 1 + U - V, X = W - 1 - V;  // bits of a left operand; integer bits it has more than a cosine
    reg  signed [M-1:0] c1, n1, c3, n3, s, w2, w3, left1, left2, next1, next2;
    reg  signed [N-1:0] a, b, p, q, right1, right2;
    wire        [4:0]   right;
    wire        [N-1:0] l1 = {{(N-W-G){1'b0}}, cfg_l1, {G{1'b0}}}, l2 = {{(N-W-G){1'b0}}, cfg_l2, {G{1'b0}}};
    wire        [W:0]   both = {in_w1[W-1], in_w1} + {in_w2[W-1], in_w2};
    always @* begin
        case (left1_from)
            S1: next1 = s;
            C1: next1 = c1;
            N1: next1 = n1;
            W3: next1 = w3;
            C3: next1 = c3;
            N3: next1 = n3;
            default: next1 = {M{1'b0}};
        endcase
        case (left2_from)
            W2_2: next2 = w2;
            S_2: next2 = s;
            N1_2: next2 = n1;
            C1_2: next2 = c1;
            N3_2: next2 = n3;
            C3_2: next2 = c3;
            default: next2 = {M{1'b0}};
        endcase
        case (right[4:3])
            A: right1 = a;
            Q: right1 = q;
            P: right1 = p;
            default: right1 = l2;
        endcase
        case (right[2:1])
            L1: right2 = l1;
            B: right2 = b;
            P: right2 = p;
            default: right2 = l2;
        endcase
        right2 = right2 ^ {N{right[0] == MINUS}};
    end
    wire [N-1:0] cut1, cut2;
    generate
        /* verilator lint_off UNUSEDSIGNAL */
        if (PIPE == 0) begin : g_now
            reg         [4:0]     chosen;
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
    wire         each = |(to & EACH), to_x = |(to & TO_X), to_z = |(to & TO_Z);
    wire [N-1:0] sum = cut1 + (each ? l1 : cut2);

    // The outputs are a, rounded and saturated
    wire [N-G-1:0] nearest = a[N-1:G] + {{(N-G-1){1'b0}}, a[G-1]};
    wire           over = nearest[N-G-1:W-1] != {(N-G-W+1){nearest[N-G-1]}};
    reg            over_before;
    assign         out_y = over ? {nearest[N-G-1], {(W-1){!nearest[N-G-1]}}} : nearest[W-1:0];
    assign         out_overflow = over || over_before;
    always @(posedge clk) begin
        if (accept) begin
            c1 <= {{X{in_c1[U+1]}}, in_c1};
            n1 <= {{X{in_n1[U+1]}}, in_n1};
            c3 <= {{X{in_c3[U+1]}}, in_c3};
            n3 <= {{X{in_n3[U+1]}}, in_n3};
            s  <= {both, {(U-V){1'b0}}};
            w2 <= {in_w2[W-1], in_w2, {(U-V){1'b0}}};
            w3 <= {in_w3[W-1], in_w3, {(U-V){1'b0}}};
        end
        left1 <= accept ? {{X{in_c2[U+1]}}, in_c2} : next1;
        left2 <= accept ? {{X{in_n2[U+1]}}, in_n2} : next2;
        if (|(to & TO_A))
            a <= sum;
        if (|(to & TO_B))
            b <= each ? cut2 : sum;
        if (|(to & TO_P))
            p <= sum;
        if (|(to & TO_Q))
            q <= sum;
        if (to_z)
            out_z <= out_y;
        if (to_x)
            out_x <= out_y;
        if (accept || to_z || to_x)
            over_before <= !accept && (over || over_before);
        out_valid <= !rst && (|(to & LAST) || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
