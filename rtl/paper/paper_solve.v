// SPDX-License-Identifier: Apache-2.0
// This kernel of paper_ik2 and paper_ik3 solves the triangle of two links and, with YAW, finds the plane it lies in.
//   sa = qy / q3, s2 = 1 - (q3 - Q1 - Q2)^2 / (4 Q1 Q2), s' = s2 Q2 / q3, s1 = sa (-) s' or sa (+) s'
//   YAW: s3 = qy / qa, qa = qx + qy, q3 = qa + qz, sa = qz / q3
// This file is the control; paper_solve_path holds registers and arithmetic, with the I, D, N, G and L used here.
// Error of the tip in reach, r = L1 + L2: 2r 2^(-D/2) + (r + 2 L2) 2^((1-N)/2) + sqrt(2 (4^I 2^-L + 2^-G)) units, and
// r 2^(-D/2) more with YAW; paper_ik2 and paper_ik3 state what is added where G < 2F.
// Latency and II: 3M + 8, with YAW 4M + 9, M = ceil((S+3) / R).
// Status: unreachable (nearest point), singular (q3 = 0 holds joint 1, qa = 0 holds joint 3), overflow (a link of 2^I
// units or more). Source: paper eqs. 18-23, 32-40, elbow and quadrants recovered. Model: paper.solve
`default_nettype none
module paper_solve #(
    parameter W   = 16,  // bits of a coordinate and of a link, F + 5 or more (default 16: Q7.8 is the paper's word)
    parameter F   = 8,   // fraction bits of a coordinate, 1 or more (default 8)
    parameter S   = 8,   // fraction bits of a joint word, 4 to 24 (default 8, the paper's)
    parameter R   = 3,   // quotient digits a clock, 1 or more with D <= L and D <= 27 (default 3)
    parameter YAW = 0    // 1: joint 3 turns the plane; 0 (default): it does not
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W-1:0] cfg_l1,
    input  wire        [W-1:0] cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,  // 0 without YAW
    input  wire                in_elbow,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire        [S+1:0] out_j1,
    output wire        [S+1:0] out_j2,
    output wire        [S+1:0] out_j3,
    output wire        [3:0]   out_status
);
    localparam B = R < 1 ? 1 : R;    // R, where it is legal
    localparam M = (S + 2 + B) / B;  // clocks of a division

    // Schedule, a clock a line
    localparam [2:0]      // sides of the two squarers
        SIDES  = 3'b000,  // acc (an operation that uses its square names it) and L2
        HEIGHT = 3'b001,  // the second is z
        LINKS  = 3'b010,  // L1 and L2
        COSINE = 3'b100;  // 1 - v = |cos| of joint 2, and L2
    localparam [2:0]       // factors of the multiplier; the square root takes its product
        L1_L2  = 3'b000,   // L1 L2
        Q2_S2  = 3'b001,   // Q2 s2, s2 = 1 - (1 - v)^2
        DIFF_1 = 3'b010,   // sa (1-g), first product of sa (-) g; g: s' or 1 - s'
        DIFF_2 = 3'b100;   // g (1-sa), second product
    localparam [6:0]          // sums and divisions
        HOLD   = 7'b0000000,  // nothing
        DIVIDE = 7'b0000001,  // R digits of num / den, 0 when unreachable
        ADD_Z  = 7'b0000010,  // q3 = qa + qz; next num / den is sa = qz / q3
        LAW    = 7'b0000100,  // c = q3 - Q1 - Q2, den = 2 Q1; sa is kept
        BEND   = 7'b0001000,  // c < 0 and 2 Q1 - |c| < 0; den = 2 L1 L2
        SLACK  = 7'b0010000,  // 2 L1 L2 - |c|; next num / den is v = 1 - |c| / (2 L1 L2)
        BASE   = 7'b0100000,  // next num / den is s' = Q2 s2 / q3; acc = 0
        DIFFER = 7'b1000000;  // the root less acc
    localparam [2:0]    // joint word
        NONE = 3'b000,  // none
        J3   = 3'b001,  // joint 3
        J2   = 3'b010,  // joint 2, its spread the square of the cosine or the rest
        J1   = 3'b100;  // joint 1, its spread the square of acc or the rest
    localparam BITS = 16;
    //                             squares product sums    joint
    localparam [BITS*(M+1)-1:0] JOINT_3 = {
        /* digits of s3     */ {M{ SIDES,  L1_L2,  DIVIDE, NONE}},
        /* q3, joint 3      */ {   HEIGHT, L1_L2,  ADD_Z,  J3}};
    localparam [BITS*(3*M+7)-1:0] TRIANGLE = {
        /* digits of sa     */ {M{ SIDES,  L1_L2,  DIVIDE, NONE}},
        /* c                */ {   LINKS,  L1_L2,  LAW,    NONE},
        /* 2 Q1 - |c|       */ {   SIDES,  L1_L2,  BEND,   NONE},
        /* 2 L1 L2 - |c|    */ {   SIDES,  L1_L2,  SLACK,  NONE},
        /* digits of v      */ {M{ SIDES,  L1_L2,  DIVIDE, NONE}},
        /* joint 2          */ {   COSINE, Q2_S2,  BASE,   J2},
        /* digits of s'     */ {M{ SIDES,  L1_L2,  DIVIDE, NONE}},
        /* sa (-) s', first */ {   SIDES,  DIFF_1, DIFFER, NONE},
        /* sa (-) s'        */ {   SIDES,  DIFF_2, DIFFER, NONE},
        /* joint 1          */ {   SIDES,  L1_L2,  HOLD,   J1}};

    wire            accept = in_valid && in_ready;
    wire            idle;
    wire [BITS-1:0] op;
    generate
        if (YAW != 0) begin : g_space
            schedule #(.LINES(4*M + 8), .BITS(BITS), .TABLE({JOINT_3, TRIANGLE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_plane
            schedule #(.LINES(3*M + 7), .BITS(BITS), .TABLE(TRIANGLE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate

    paper_solve_path #(.W(W), .F(F), .S(S), .R(R), .YAW(YAW)) path (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_start(accept), .in_x(in_x), .in_y(in_y),
        .in_z(in_z), .in_elbow(in_elbow), .in_cosine(op[15]), .in_links(op[14]), .in_height(op[13]), .in_diff_2(op[12]),
        .in_diff_1(op[11]), .in_q2_s2(op[10]), .in_differ(op[9]), .in_base(op[8]), .in_slack(op[7]), .in_bend(op[6]),
        .in_law(op[5]), .in_add_z(op[4]), .in_divide(op[3]), .in_j1(op[2]), .in_j2(op[1]), .in_j3(op[0]),
        .out_j1(out_j1), .out_j2(out_j2), .out_j3(out_j3), .out_status(out_status));

    // The table is long: a busy register is smaller than an OR over all of its steps
    reg    busy;
    wire   last = op[2];  // joint 1
    wire   unused = idle;
    assign in_ready = !busy && (!out_valid || out_ready);
    always @(posedge clk) begin
        busy      <= !rst && (accept || (busy && !last));
        out_valid <= !rst && (last || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
