// SPDX-License-Identifier: Apache-2.0
// Rates of two joints in the plane, or of three of which the third yaws that plane, from the velocity of the tip.
//   v' = v (c1 - i n1), e + i f = L2 (c2 + i n2): s = -v'x / f, w1 = (v'y - e s) / L1, w2 = s - w1
//   JOINTS = 3: (v_rho + i v_t) = (x + i y)(c3 - i n3), v = v_rho + i z; w3 = v_t / rho, rho = (L1 + e) c1 - f n1
// Where |n2| is below cfg_sine, cfg_sine replaces it; cfg_radius replaces |rho|. The rates stay bounded, and only the
// velocity along the arm, or around the axis, is reduced.
// Formats: c, n s2.U; velocities s(W-F).F; rates s(W-V).V, rounded to nearest, saturated. Words inside are s(2W-V+3).G
// with G = 4 guard bits, to which products are truncated. Error: bounds.arm.rates2, bounds.arm.rates3.
// Latency and II: 7 + 2 D, with three joints 9 + 3 D, D = ceil((2 W + 7) / R).
// Status: singular (a divisor was replaced or is 0, which makes the rate 0), overflow (a rate was saturated).
// Models: arm_velocity.rates2, arm_velocity.rates3
`default_nettype none
module arm_inverse #(
    parameter JOINTS = 2,  // joints, 2 or 3 (default 2); the third turns the plane of the others about an upright axis
    parameter W = 16,      // bits of a length, a rate and a velocity, 8 to 18 (default 16)
    parameter U = 16,      // fraction bits of cosine and sine, 8 to 18 (default 16)
    parameter V = 12,      // fraction bits of a rate, W - 8 to W - 1 and at most U (default 12)
    parameter R = 4        // digits of a quotient in one clock, 1 to 5 (default 4)
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
    // The operands of the first line are y, -x and joint 1, or 3 in space: no other choice is 0
    localparam [12:0]                           // operands of the next clock
        DOT   = 13'b1_00_000_001_001_1,         // (x, y) with the same left ones, x c + y n
        CROSS = 13'b1_00_000_000_000_0,         // y c - x n
        DOT1  = 13'b0_10_010_001_001_1,         // x c1 + y n1
        LINK2 = 13'b0_00_000_010_010_1,         // L2 c2 and L2 |n2| with the least sine
        OFF   = 13'b0_00_011_010_010_1,         // L2 n2
        RHO   = 13'b0_10_100_100_011_1,         // L1 c1 + e c1
        RHO2  = 13'b0_01_010_101_100_0,         // p less f n1
        REST  = 13'b0_01_001_011_011_0,         // q - e s
        NONE  = 13'b0_00_000_000_000_0;         // no product
    localparam [11:0]                           // where the sum goes, and quotients
        TO_T  = 12'b100000_0_00_000,            // the sum goes to t
        TO_XY = 12'b010000_0_00_000,            // x is the sum, y is z
        TO_P  = 12'b001000_0_00_000,            // the sum goes to p
        TO_Q  = 12'b000100_0_00_000,            // the sum goes to q
        TO_AB = 12'b000011_0_00_000,            // each product alone
        TO_B  = 12'b000001_0_00_000,            // the second product
        DIV_S = 12'b000000_1_00_000,            // s = -v'x / f begins
        WAIT  = 12'b000000_0_00_000,            // digits
        GET_S = 12'b000000_0_00_100,            // s is made
        DIV_1 = 12'b000000_1_01_000,            // w1 begins
        GET_1 = 12'b000000_0_00_010,            // w1 is made
        DIV_3 = 12'b000000_1_10_010,            // w1; w3 begins
        GET_3 = 12'b000000_0_00_001;            // w3
    localparam [25*(2*D+6)-1:0] PLANE = {
        /* v'y       */ {DOT,   TO_Q},
        /* v'x       */ {LINK2, TO_P},
        /* e, |f|    */ {NONE,  TO_AB},
        /* v'x / f   */ {NONE,  DIV_S},
        /* digits    */ {(D-1){NONE, WAIT}},
        /* s         */ {REST,  GET_S},
        /* v'y - e s */ {NONE,  TO_Q},
        /* w1        */ {NONE,  DIV_1},
        /* digits w1 */ {(D-1){NONE, WAIT}},
        /* w1, w2    */ {NONE,  GET_1}};
    localparam [25*(3*D+8)-1:0] SPACE = {
        /* v_t       */ {DOT,   TO_T},
        /* v_rho     */ {DOT1,  TO_XY},
        /* v'x       */ {CROSS, TO_P},
        /* v'y       */ {LINK2, TO_Q},
        /* e, |f|    */ {NONE,  TO_AB},
        /* v'x / f   */ {OFF,   DIV_S},
        /* f         */ {RHO,   TO_B},
        /* rho       */ {RHO2,  TO_P},
        /* less f n1 */ {NONE,  TO_P},
        /* digits    */ {(D-4){NONE, WAIT}},
        /* s         */ {REST,  GET_S},
        /* v'y - e s */ {NONE,  TO_Q},
        /* w1        */ {NONE,  DIV_1},
        /* digits w1 */ {(D-1){NONE, WAIT}},
        /* w1, w2    */ {NONE,  DIV_3},
        /* digits w3 */ {(D-1){NONE, WAIT}},
        /* w3        */ {NONE,  GET_3}};
    wire [24:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    assign      in_ready = idle && (!out_valid || out_ready);
    generate
        if (JOINTS == 2) begin : g_two
            schedule #(.LINES(2*D + 6), .BITS(25), .TABLE(PLANE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_three
            schedule #(.LINES(3*D + 8), .BITS(25), .TABLE(SPACE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate
    reg  signed [W+1:0] s, w1, w3;
    wire signed [W+1:0] q;
    wire                zero, near;
    arm_inverse_path #(.JOINTS(JOINTS), .W(W), .U(U), .V(V), .R(R)) path (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .cfg_sine(cfg_sine), .cfg_radius(cfg_radius),
        .in_start(accept), .in_op(op[24:3]), .in_c1(in_c1), .in_n1(in_n1), .in_c2(in_c2), .in_n2(in_n2),
        .in_c3(in_c3), .in_n3(in_n3), .in_x(in_x), .in_y(in_y), .in_z(in_z), .out_q(q), .out_zero(zero),
        .out_near(near));

    // The rates are saturated
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
