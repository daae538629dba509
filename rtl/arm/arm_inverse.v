// SPDX-License-Identifier: Apache-2.0
// Rates of two joints in the plane, or of three, whose third yaws that plane, from the velocity of the tip.
//   v' = v (c1 - i n1), e + i f = L2 (c2 + i n2): s = -v'x / f, w1 = (v'y - e s) / L1, w2 = s - w1
//   JOINTS = 3: (v_rho + i v_t) = (x + i y)(c3 - i n3), v = v_rho + i z; w3 = v_t / rho, rho = (L1 + e) c1 - f n1
// Where |n2| is less than cfg_sine that stands for it, and cfg_radius for |rho|: rates stay bounded, and the velocity
// that is lost is that along the arm, or about the axis.
// Formats: c, n s2.U; velocities s(W-F).F; rates s(W-V).V, nearest, saturated; inside s(2W-V+3).G, truncated.
// Latency, II: 7 + 2 D, three joints 9 + 3 D, D = ceil((2 W + 7) / R). Status: singular (a divisor was replaced or 0),
// overflow (a rate saturated). Models: arm_velocity.rates2, .rates3
`default_nettype none
module arm_inverse #(
    parameter JOINTS = 2,  // 2 or 3: the third turns the plane of the first two about an upright axis
    parameter W = 16,      // bits of a length, a rate and a velocity, 8 to 18: 16
    parameter U = 16,      // fraction bits of cosine and sine, 8 to 18: 16
    parameter V = 12,      // fraction bits of a rate, W - 8 to W - 1, U at most: 12, 8 rad in a unit of time
    parameter R = 4        // digits of a quotient in a clock, 1 to 8: 4
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

    // Schedule. start: x y z c1 n1 c2 n2 c3 n3 singular <- in_c1 in_n1 in_c2 in_n2 in_c3 in_n3 in_x in_y in_z
    //            left1 left2 right1 right2 - -  t xy p q a b  start of    s 1 3
    localparam [25:0]
        ACROSS = 26'b010_010_001_001_0_1_100000_0_00_000,  // t <- x y c3 n3: velocity about the yaw axis
        ALONG  = 26'b010_010_000_000_0_0_010000_0_00_000,  // x y <- x y z c3 n3: velocity in the plane
        H      = 26'b000_000_000_000_0_0_001000_0_00_000,  // p <- x y c1 n1: v'x
        TO_G   = 26'b000_000_001_001_0_1_000100_0_00_000,  // q <- x y c1 n1: v'y
        LINKS  = 26'b001_001_010_010_0_0_000011_0_00_000,  // a b <- c2 n2: e, and |f| with the least sine
        DIV_S  = 26'b000_000_000_000_0_0_000000_1_00_000,  // digits <- p b n2: s = -v'x / f begins
        OFF    = 26'b000_011_000_010_0_0_000001_0_00_000,  // b <- n2: f as it is
        RHO    = 26'b000_100_100_100_0_0_001000_0_00_000,  // p <- a c1: L1 c1 + e c1
        RHO2   = 26'b100_000_101_101_0_1_001000_0_00_000,  // p <- p b n1: less f n1, rho
        WAIT   = 26'b000_000_000_000_0_0_000000_0_00_000,  // - <- -: digits
        GET_S  = 26'b000_000_000_000_0_0_000000_0_00_100,  // s singular <- digits: s
        REST   = 26'b011_101_011_011_1_0_000100_0_00_000,  // q <- a q s: v'y - e s
        DIV_1  = 26'b000_000_000_000_0_0_000000_1_01_000,  // digits <- q: w1 begins
        GET_1  = 26'b000_000_000_000_0_0_000000_0_00_010,  // w1 singular <- digits: w1
        DIV_3  = 26'b000_000_000_000_0_0_000000_1_10_010,  // digits w1 singular <- t p digits: w1; w3 begins
        GET_3  = 26'b000_000_000_000_0_0_000000_0_00_001;  // w3 singular <- digits: w3
    localparam [26*(2*D+6)-1:0] PLANE = {
        /* v'x       */ {H},
        /* v'y       */ {TO_G},
        /* e, |f|    */ {LINKS},
        /* v'x / f   */ {DIV_S},
        /* digits    */ {(D-1){WAIT}},
        /* s         */ {GET_S},
        /* v'y - e s */ {REST},
        /* w1        */ {DIV_1},
        /* digits w1 */ {(D-1){WAIT}},
        /* w1, w2    */ {GET_1}};
    localparam [26*(3*D+8)-1:0] SPACE = {
        /* v_t       */ {ACROSS},
        /* v_rho     */ {ALONG},
        /* v'x       */ {H},
        /* v'y       */ {TO_G},
        /* e, |f|    */ {LINKS},
        /* v'x / f   */ {DIV_S},
        /* f         */ {OFF},
        /* rho       */ {RHO},
        /* less f n1 */ {RHO2},
        /* digits    */ {(D-4){WAIT}},
        /* s         */ {GET_S},
        /* v'y - e s */ {REST},
        /* w1        */ {DIV_1},
        /* digits w1 */ {(D-1){WAIT}},
        /* w1, w2    */ {DIV_3},
        /* digits w3 */ {(D-1){WAIT}},
        /* w3        */ {GET_3}};
    wire [25:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    assign      in_ready = idle && (!out_valid || out_ready);
    generate
        if (JOINTS == 2) begin : g_two
            schedule #(.LINES(2*D + 6), .BITS(26), .TABLE(PLANE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_three
            schedule #(.LINES(3*D + 8), .BITS(26), .TABLE(SPACE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate
    reg  signed [W+1:0] s, w1, w3;
    wire signed [W+1:0] q;
    wire                zero, near;
    arm_inverse_path #(.W(W), .U(U), .V(V), .R(R)) path (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_sine(cfg_sine), .cfg_radius(cfg_radius),
        .in_start(accept), .in_op(op[25:3]), .in_c1(in_c1), .in_n1(in_n1), .in_c2(in_c2), .in_n2(in_n2),
        .in_c3(in_c3), .in_n3(in_n3), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_s(s), .out_q(q), .out_zero(zero),
        .out_near(near));

    // Every rate is saturated on its way out
    wire        [W+2:0] w2 = {s[W+1], s} - {w1[W+1], w1};
    wire                over1 = w1[W+1:W-1] != {3{w1[W+1]}}, over2 = w2[W+2:W-1] != {4{w2[W+2]}};
    wire                over3 = JOINTS == 3 && w3[W+1:W-1] != {3{w3[W+1]}};
    reg                 singular;
    assign              out_w1 = over1 ? {w1[W+1], {(W-1){!w1[W+1]}}} : w1[W-1:0];
    assign              out_w2 = over2 ? {w2[W+2], {(W-1){!w2[W+2]}}} : w2[W-1:0];
    assign              out_w3 = over3 ? {w3[W+1], {(W-1){!w3[W+1]}}} : w3[W-1:0];
    assign              out_status = {1'b0, over1 || over2 || over3, singular, 1'b0};
    wire                last = JOINTS == 2 ? op[1] : op[0];
    always @(posedge clk) begin
        if (op[2])
            s <= q;
        if (op[1])
            w1 <= q;
        if (op[0])
            w3 <= q;
        if (accept || op[2:0] != 0)
            singular <= !accept && (singular || zero || near);
        out_valid <= !rst && (last || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
