// SPDX-License-Identifier: Apache-2.0
// This kernel of paper_fk2 and paper_fk3 computes two links in a plane and, with YAW, their plane on a turning base.
//   q3 = Q1 + Q2 -+ 2 sqrt(Q1 Q2 (1-s2)), s' = s2 Q2 / q3, s = s1 (-) s', x = +-sqrt(q3 (1-s)), y = +-sqrt(q3 s)
//   YAW: z = +-sqrt(q3 s), qa = q3 - qz, y = +-sqrt(qa s3), x = +-sqrt(qa (1-s3))
// This file is the control; paper_chain_path holds registers and arithmetic, with the I, N, G, Q and D used here.
// Error of the tip at the distance r of n joints: r (2^(-D/2) + sqrt(3) 2^(-N/2) + 2^(-Q/2)) + (n+1) 2^(-G/2) + 2^(I-N)
// units and sqrt(n) LSB, with I, N, G, Q and D of paper_chain_path.
// Latency and II: M + 7, with YAW M + 8, M = ceil((S+1) / 3).
// Status: out_overflow (a link or the tip of 2^I units or more, or a coordinate that rounds to 2^(W-1) LSB).
// Source: paper eqs. 11-17, 24-31, Table II corrected. Model: paper.chain
`default_nettype none
module paper_chain #(
    parameter W   = 16,  // bits of a coordinate and of a link, F + 5 or more (default 16: Q7.8 is the paper's word)
    parameter F   = 8,   // fraction bits of a coordinate, 1 or more (default 8)
    parameter S   = 8,   // fraction bits of a joint word, 4 to 24 with N and D at most Q (default 8, the paper's)
    parameter YAW = 0    // 1: joint 3 turns the plane; 0 (default): it does not
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W-1:0] cfg_l1,
    input  wire        [W-1:0] cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire        [S+1:0] in_j1,
    input  wire        [S+1:0] in_j2,
    input  wire        [S+1:0] in_j3,  // 0 without YAW
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire                out_overflow
);
    localparam R = 3;            // digits of s' a clock
    localparam M = (S + R) / R;  // clocks of the division

    // Schedule, a clock a line
    localparam [4:0]        // factors of the multiplier; the square root takes its product
        QUAD   = 5'b00000,  // quad and spread (an operation that uses the product names them)
        DIFF_1 = 5'b00001,  // s1 (1-g), first product of s1 (-) g; g is s' or 1 - s'
        DIFF_2 = 5'b00010,  // g (1-s1), second product
        SINE   = 5'b00100,  // q3 s
        COSINE = 5'b01000,  // q3 (1-s)
        TURN   = 5'b10000;  // qa s3 or qa (1-s3)
    localparam [5:0]         // sums and division
        HOLD   = 6'b000000,  // nothing
        LAW    = 6'b000001,  // b -+ L1 with b = sqrt(Q2 (1-s2)), and Q2 s2
        Q3     = 6'b000010,  // q3 = (b -+ L1)^2 + Q2 s2; then acc = 0
        DIVIDE = 6'b000100,  // R digits of s' = Q2 s2 / q3
        DIFFER = 6'b001000,  // the root less acc
        QA     = 6'b010000,  // qa = q3 - qz, the product
        CLEAR  = 6'b100000;  // 0, so that the accepting clock squares L2 alone
    localparam [1:0]  // spread register, for the next line
        S1 = 2'b00,   // s1
        C1 = 2'b01,   // 1 - s1
        S3 = 2'b10,   // s3
        C3 = 2'b11;   // 1 - s3
    localparam [2:0]    // coordinate that the root is rounded to
        NONE = 3'b000,  // none
        Z    = 3'b001,  // z
        Y    = 3'b010,  // y
        X    = 3'b100;  // x, the last one
    localparam BITS = 16;
    //                             product sums    spread coordinate
    localparam [BITS*(M+4)-1:0] DIRECTION = {
        /* cross law        */ {   QUAD,   LAW,    S1,    NONE},
        /* q3               */ {   QUAD,   Q3,     S1,    NONE},
        /* digits of s'     */ {M{ QUAD,   DIVIDE, S1,    NONE}},
        /* s1 (-) s', first */ {   DIFF_1, DIFFER, C1,    NONE},
        /* s1 (-) s'        */ {   DIFF_2, DIFFER, S1,    NONE}};
    localparam [BITS*2-1:0] PLANE = {
        /* y                */ {   SINE,   HOLD,   S1,    Y},
        /* x                */ {   COSINE, CLEAR,  S1,    X}};
    localparam [BITS*3-1:0] SPACE = {
        /* z, qa            */ {   SINE,   QA,     S3,    Z},
        /* y                */ {   TURN,   HOLD,   C3,    Y},
        /* x                */ {   TURN,   CLEAR,  S1,    X}};

    wire            accept = in_valid && in_ready;
    wire            idle;
    wire [BITS-1:0] op;
    generate
        if (YAW != 0) begin : g_space
            schedule #(.LINES(M + 7), .BITS(BITS), .TABLE({DIRECTION, SPACE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_plane
            schedule #(.LINES(M + 6), .BITS(BITS), .TABLE({DIRECTION, PLANE})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate

    paper_chain_path #(.W(W), .F(F), .S(S), .R(R)) path (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_start(accept), .in_j1(in_j1), .in_j2(in_j2),
        .in_j3(in_j3), .in_turn(op[15]), .in_cosine(op[14]), .in_sine(op[13]), .in_diff_2(op[12]),
        .in_diff_1(op[11]), .in_clear(op[10]), .in_qa(op[9]), .in_differ(op[8]), .in_divide(op[7]),
        .in_q3(op[6]), .in_law(op[5]), .in_next(op[4:3]), .in_x(op[2]), .in_y(op[1]), .in_z(op[0]),
        .out_x(out_x), .out_y(out_y), .out_z(out_z), .out_overflow(out_overflow));

    // A busy register is as small as an OR over all steps of the table and makes the clock 4 % faster
    reg    busy;
    wire   last = op[2];  // x
    wire   unused = idle;
    assign in_ready = !busy && (!out_valid || out_ready);
    always @(posedge clk) begin
        busy      <= !rst && (accept || (busy && !last));
        out_valid <= !rst && (last || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
