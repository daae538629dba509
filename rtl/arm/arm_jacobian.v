// SPDX-License-Identifier: Apache-2.0
// Velocity of the tip of two joints in the plane, or of three, whose third yaws that plane, from the joints' rates.
//   e + i f = L2 (c2 + i n2), s = w1 + w2: v' = -f s + i ((L1 + e) s - L1 w2) seen from link 1; turned by joint 1
//   JOINTS = 3: x + i y = (v_rho + i rho w3)(c3 + i n3), rho = (L1 + e) c1 - f n1
// Formats: c, n s2.U (1.0 is 2^U); rates s(W-V).V; a, b, p, q s(2W-V+3).G, G bits below the LSB of a coordinate, to
// which every product is truncated; outputs to nearest (ties upward), saturated. Latency, II: lines of the table + 1.
// Overflow: a coordinate was saturated. Models: arm_velocity.velocity2, .velocity3
`default_nettype none
module arm_jacobian #(
    parameter JOINTS = 2,  // 2 or 3: the third turns the plane of the first two about an upright axis
    parameter W = 16,      // bits of a length, a rate and a velocity, 8 to 18: 16
    parameter U = 16,      // fraction bits of cosine and sine, 8 to 18: 16
    parameter V = 12       // fraction bits of a rate, W - 8 to W, U at most: 12, 8 rad in a unit of time
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
    localparam G = 4, N = 2*W - V + 3 + G;  // guard bits; bits of a velocity inside
    localparam M = W + 1 + U - V, X = W - 1 - V;  // bits of a left operand, those that it has before a cosine

    // Schedule. start: c1 n1 c2 n2 c3 n3 s w2 w3 <- in_c1 in_n1 in_c2 in_n2 in_c3 in_n3 in_w1 in_w2 in_w3
    //            left1 left2 right1 right2 - add  a b p q  z x last
    localparam [18:0]
        LINKS = 19'b001_001_00_00_0_1_1100_000,  // a b <- c2 n2: L2 (c2, n2), and L1 to a
        ALONG = 19'b010_010_01_01_1_0_0010_000,  // p <- a s w2: velocity across link 1, (L1 + e) s - L1 w2
        DOWN  = 19'b000_011_01_10_1_0_0001_000,  // q <- b s: velocity along link 1, -f s
        RHO   = 19'b011_100_01_10_1_0_1000_000,  // a <- a b c1 n1: distance from the yaw axis
        YAW   = 19'b101_000_01_00_0_0_0100_000,  // b <- a w3: velocity of the plane there
        UP    = 19'b100_101_10_11_0_0_1000_000,  // a <- p q c1 n1: the second coordinate of v' turned by joint 1
        FIRST = 19'b011_100_10_11_1_0_1000_000,  // a <- p q c1 n1: the first
        OUT_Z = 19'b011_100_10_11_1_0_0010_100,  // p z <- a p q c1 n1: a is z; p is the velocity in the plane
        TURN3 = 19'b110_110_11_10_1_0_1000_000,  // a <- p b c3 n3: (p, b) turned by joint 3, the first coordinate
        OUT_3 = 19'b111_111_11_10_0_0_1000_011,  // a x <- a p b c3 n3: a is x; the second coordinate, y
        OUT_2 = 19'b100_101_10_11_0_0_1000_011;  // a x <- a p q c1 n1: a is x; v' turned by joint 1, y
    localparam [5*19-1:0] PLANE = {
        /* L1 + e, f */ {LINKS},
        /* v' across */ {ALONG},
        /* v' along  */ {DOWN},
        /* x         */ {FIRST},
        /* y         */ {OUT_2}};
    localparam [9*19-1:0] SPACE = {
        /* L1 + e, f */ {LINKS},
        /* v' across */ {ALONG},
        /* v' along  */ {DOWN},
        /* rho       */ {RHO},
        /* rho w3    */ {YAW},
        /* z         */ {UP},
        /* v_rho     */ {OUT_Z},
        /* x         */ {TURN3},
        /* y         */ {OUT_3}};
    wire [2:0] left1_from, left2_from;
    wire [1:0] right1_from, right2_from;
    wire       minus, add, to_a, to_b, to_p, to_q, to_z, to_x, last, idle;
    wire       accept = in_valid && in_ready;
    assign     in_ready = idle && (!out_valid || out_ready);
    wire [18:0] op;
    assign     {left1_from, left2_from, right1_from, right2_from, minus, add, to_a, to_b, to_p, to_q, to_z, to_x,
                last} = op;
    generate
        if (JOINTS == 2) begin : g_two
            schedule #(.LINES(5), .BITS(19), .TABLE(PLANE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_three
            schedule #(.LINES(9), .BITS(19), .TABLE(SPACE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate

    // Left: c, n and rates, the latter aligned to U fraction bits. Right: lengths and velocities
    reg  signed [M-1:0] c1, n1, c2, n2, c3, n3, s, w2, w3, left1, left2;
    reg  signed [N-1:0] a, b, p, q, right1, right2;
    wire        [N-1:0] l1 = {{(N-W-G){1'b0}}, cfg_l1, {G{1'b0}}}, l2 = {{(N-W-G){1'b0}}, cfg_l2, {G{1'b0}}};
    wire        [W:0]   both = {in_w1[W-1], in_w1} + {in_w2[W-1], in_w2};
    always @* begin
        case (left1_from)
            3'd1: left1 = c2;
            3'd2: left1 = s;
            3'd3: left1 = c1;
            3'd4: left1 = n1;
            3'd5: left1 = w3;
            3'd6: left1 = c3;
            3'd7: left1 = n3;
            default: left1 = {M{1'b0}};
        endcase
        case (left2_from)
            3'd1: left2 = n2;
            3'd2: left2 = w2;
            3'd3: left2 = s;
            3'd4: left2 = n1;
            3'd5: left2 = c1;
            3'd6: left2 = n3;
            3'd7: left2 = c3;
            default: left2 = {M{1'b0}};
        endcase
        case (right1_from)
            2'd1: right1 = a;
            2'd2: right1 = q;
            2'd3: right1 = p;
            default: right1 = l2;
        endcase
        case (right2_from)
            2'd1: right2 = l1;
            2'd2: right2 = b;
            2'd3: right2 = p;
            default: right2 = l2;
        endcase
        right2 = right2 ^ {N{minus}};
    end
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [M+N-1:0] product1 = left1 * right1, product2 = left2 * right2;
    /* verilator lint_on UNUSEDSIGNAL */
    // Where L1 is added the second product stands alone, for b
    wire [N-1:0] cut1 = product1[N+U-1:U], cut2 = product2[N+U-1:U];
    wire [N-1:0] sum = cut1 + (add ? l1 : cut2);

    // a is rounded on its way out
    wire [N-G-1:0] nearest = a[N-1:G] + {{(N-G-1){1'b0}}, a[G-1]};
    wire           over = nearest[N-G-1:W-1] != {(N-G-W+1){nearest[N-G-1]}};
    reg            over_before;
    assign         out_y = over ? {nearest[N-G-1], {(W-1){!nearest[N-G-1]}}} : nearest[W-1:0];
    assign         out_overflow = over || over_before;
    always @(posedge clk) begin
        if (accept) begin
            c1 <= {{X{in_c1[U+1]}}, in_c1};
            n1 <= {{X{in_n1[U+1]}}, in_n1};
            c2 <= {{X{in_c2[U+1]}}, in_c2};
            n2 <= {{X{in_n2[U+1]}}, in_n2};
            c3 <= {{X{in_c3[U+1]}}, in_c3};
            n3 <= {{X{in_n3[U+1]}}, in_n3};
            s  <= {both, {(U-V){1'b0}}};
            w2 <= {in_w2[W-1], in_w2, {(U-V){1'b0}}};
            w3 <= {in_w3[W-1], in_w3, {(U-V){1'b0}}};
        end
        if (to_a)
            a <= sum;
        if (to_b)
            b <= add ? cut2 : sum;
        if (to_p)
            p <= sum;
        if (to_q)
            q <= sum;
        if (to_z)
            out_z <= out_y;
        if (to_x)
            out_x <= out_y;
        if (accept || to_z || to_x)
            over_before <= !accept && (over || over_before);
        out_valid <= !rst && (last || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
