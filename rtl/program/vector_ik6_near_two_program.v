// SPDX-License-Identifier: Apache-2.0
// Assembled from vector_ik6_near.kin by `quadrance assemble` for two poses; do not edit.
//   vector_ik6 with margin and slack
// Line: word = A * B [+- C * D], DEST, and what else is done with it; one line a clock. I_ begins the name of an input;
// a word of capitals and a small letter is one that the assembler has added.
// Marked lines end the pose before. Clocks of a run: 107 at PIPE 1, 110 at PIPE 2. Model: quadrance.program.meaning
`default_nettype none
module vector_ik6_near_two_program #(
    parameter PIPE = 1  // registers behind the products of product_engine: 1 or 2 (default 1)
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    output wire        out_idle,
    output wire        out_done,
    output wire [46:0] out_op
);
    generate
    if (PIPE == 1) begin : g_pipe1
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2, TABLE = 2'd3;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36, SLOPE = 6'd0, BACK = 6'd8, DOWN = 6'd16, FLIP = 6'd24,
        NOUGHT = 6'd4, POWER = 6'd1, FOUR = 6'd2, TWICE = 6'd3;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [1:0] HIGH = 2'd0, LOW = 2'd1, MID = 2'd2;
    localparam [8:0] OTHER = 9'd0, FOLD = 9'd1, MORE = 9'd2, WRIST = 9'd4, ABOVE = 9'd8, ROOT = 9'd16, HOLD = 9'd32,
        FAR = 9'd64, CLAMP = 9'd128, CHECK = 9'd256, NEAR = 9'd260, OVER = 9'd320;
    localparam [5:0]
        C1 = 6'd2, N1 = 6'd3, C2 = 6'd4, N2 = 6'd5, C3 = 6'd6, N3 = 6'd7, C4 = 6'd8, N4 = 6'd9, C5 = 6'd10,
        N5 = 6'd11, C6 = 6'd12, N6 = 6'd13, L4 = 6'd14, NEt = 6'd14, T4 = 6'd14, W1 = 6'd14, X1g = 6'd14,
        YY = 6'd14, N1v = 6'd15, PY = 6'd15, B = 6'd16, R23 = 6'd16, PX = 6'd17, R13 = 6'd17, N2u = 6'd18,
        N2v = 6'd18, PZ = 6'd18, R23s = 6'd19, R13s = 6'd20, N4u = 6'd21, X1 = 6'd21, C1g = 6'd22, C2g = 6'd22,
        X1t = 6'd22, XX = 6'd22, K = 6'd23, R21 = 6'd24, R31 = 6'd25, R22 = 6'd26, CE = 6'd27, CEd = 6'd27,
        CEp = 6'd27, CEr = 6'd27, U3 = 6'd27, R11 = 6'd28, R32 = 6'd29, R12 = 6'd30, M23 = 6'd31, NE = 6'd31,
        NEg = 6'd31, Q = 6'd31, W2 = 6'd31, R33s = 6'd32, W3 = 6'd32, C4u = 6'd33, K2 = 6'd33, K5 = 6'd33,
        C2u = 6'd34, K1 = 6'd34, N23 = 6'd34, C1m = 6'd35, C1u = 6'd36, C1v = 6'd36, M = 6'd36, C4g = 6'd37,
        NP = 6'd37, R33 = 6'd37, C23 = 6'd38, N1u = 6'd38, C2m = 6'd39, C2v = 6'd40, EDGE = 6'd40, M13 = 6'd41,
        L2 = 6'd42, C4m = 6'd47;
    localparam [5:0]
        I_R11 = 6'd0, I_R12 = 6'd1, I_R13 = 6'd2, I_R21 = 6'd3, I_R22 = 6'd4, I_R23 = 6'd5, I_R31 = 6'd6,
        I_R32 = 6'd7, I_R33 = 6'd8, I_X = 6'd9, I_Y = 6'd10, I_Z = 6'd11, I_A1 = 6'd12, I_B = 6'd13,
        I_L1 = 6'd14, I_L2 = 6'd15, I_L4 = 6'd16, I_K = 6'd17, I_CP = 6'd18, I_NP = 6'd19, I_R = 6'd20,
        I_E = 6'd21, I_M = 6'd22, I_SL = 6'd23, I_ONE = 6'd24;
    localparam [102*47-1:0] LINES = {
    /* l4                           */ {PORT,  I_L4,  BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, L4,   OTHER},
    /* < C1v = x1*px + b*py         */ {REG,   X1,    OF, PX,     B,   PY,   ADD,  DONE, HIGH, C1v,  FOLD},
    /* < N1v = x1*py - b*px         */ {REG,   X1,    OF, PY,     B,   PX,   SUB,  DONE, HIGH, N1v,  MORE},
    /* < np                         */ {PORT,  I_NP,  BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, NP,   OTHER},
    /* r23                          */ {PORT,  I_R23, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R23,  OTHER},
    /* < C1u = C1v 2^s              */ {REG,   C1v,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  C1u,  OTHER},
    /* < N1u = N1v 2^s              */ {REG,   N1v,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  N1u,  OTHER},
    /* r13                          */ {PORT,  I_R13, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R13,  OTHER},
    /* py = y - l4*r23              */ {PORT,  I_Y,   BY, PLUS,   L4,  R23,  SUB,  DONE, HIGH, PY,   OTHER},
    /* b                            */ {PORT,  I_B,   BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, B,    OTHER},
    /* < |C1u, N1u|^2               */ {REG,   C1u,   OF, C1u,    N1u, N1u,  ADD,  DONE, HIGH, NIL,  ROOT},
    /* < C2v = k1*pz + k2*xx        */ {REG,   K1,    OF, PZ,     K2,  XX,   ADD,  DONE, HIGH, C2v,  FOLD},
    /* < N2v = k1*xx - k2*pz        */ {REG,   K1,    OF, XX,     K2,  PZ,   SUB,  DONE, HIGH, N2v,  MORE},
    /* < C1g = 1 / root             */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL,  LONE, DONE, MID,  C1g,  OTHER},
    /* px = x - l4*r13              */ {PORT,  I_X,   BY, PLUS,   L4,  R13,  SUB,  DONE, HIGH, PX,   OTHER},
    /* < c1 = C1g * C1u             */ {LAST,  NIL,   OF, C1u,    NIL, NIL,  LONE, DONE, HIGH, C1,   HOLD},
    /* < N2u = N2v 2^s              */ {REG,   N2v,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  N2u,  OTHER},
    /* < C2u = C2v 2^s              */ {REG,   C2v,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  C2u,  OTHER},
    /* < n1 = C1g * N1u             */ {REG,   C1g,   OF, N1u,    NIL, NIL,  LONE, DONE, HIGH, N1,   HOLD},
    /* < m                          */ {PORT,  I_M,   BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, M,    OTHER},
    /* < c3 = cp*ce + ne*np         */ {PORT,  I_CP,  OF, CE,     NE,  NP,   ADD,  DONE, HIGH, C3,   OTHER},
    /* < |C2u, N2u|^2               */ {REG,   C2u,   OF, C2u,    N2u, N2u,  ADD,  DONE, HIGH, NIL,  ROOT},
    /* < n3 = cp*ne - ce*np         */ {PORT,  I_CP,  OF, NE,     CE,  NP,   SUB,  DONE, HIGH, N3,   OTHER},
    /* < u3 = c1*r13 + n1*r23       */ {REG,   R13s,  OF, C1,     N1,  R23s, ADD,  DONE, HIGH, U3,   OTHER},
    /* < C2g = 1 / root             */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL,  LONE, DONE, MID,  C2g,  OTHER},
    /* q: px*px - b*b               */ {REG,   PX,    OF, PX,     B,   B,    SUB,  KEEP, HIGH, NIL,  OTHER},
    /* q = .. + py*py               */ {REG,   PY,    OF, PY,     NIL, NIL,  LONE, DONE, HIGH, Q,    FOLD | ABOVE},
    /* r33                          */ {PORT,  I_R33, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R33,  OTHER},
    /* < n2 = C2g * N2u             */ {REG,   C2g,   OF, N2u,    NIL, NIL,  LONE, DONE, HIGH, N2,   HOLD},
    /* < c2 = C2g * C2u             */ {REG,   C2g,   OF, C2u,    NIL, NIL,  LONE, DONE, HIGH, C2,   HOLD},
    /* X1t = q 2^j                  */ {REG,   Q,     BY, TWICE,  NIL, NIL,  LONE, DONE, LOW,  X1t,  OTHER},
    /* q 4^j                        */ {REG,   Q,     BY, FOUR,   NIL, NIL,  LONE, DONE, LOW,  NIL,  ROOT},
    /* < m23 = c1*r23 - n1*r13      */ {REG,   R23s,  OF, C1,     N1,  R13s, SUB,  DONE, HIGH, M23,  FOLD | WRIST},
    /* < n23 = n2*c3 + c2*n3        */ {REG,   N2,    OF, C3,     C2,  N3,   ADD,  DONE, HIGH, N23,  OTHER},
    /* < c23 = c2*c3 - n2*n3        */ {REG,   C2,    OF, C3,     N2,  N3,   SUB,  DONE, HIGH, C23,  OTHER},
    /* edge: l2                     */ {PORT,  I_L2,  BY, PLUS,   NIL, NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
    /* edge .. + k                  */ {PORT,  I_K,   BY, PLUS,   NIL, NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
    /* edge = .. + sl               */ {PORT,  I_SL,  BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, EDGE, OTHER},
    /* < m13 = c23*u3 - n23*r33     */ {REG,   C23,   OF, U3,     N23, R33s, SUB,  DONE, HIGH, M13,  MORE | WRIST},
    /* < near c2 k2*k2 - m*m        */ {REG,   K2,    OF, K2,     M,   M,    SUB,  DONE, HIGH, C2m,  NEAR},
    /* < near c1 x1*x1 - m*m        */ {REG,   X1,    OF, X1,     M,   M,    SUB,  DONE, HIGH, C1m,  NEAR},
    /* < N4u = m23 2^s              */ {REG,   M23,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  N4u,  OTHER},
    /* < C4u = m13 2^s              */ {REG,   M13,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  C4u,  OTHER},
    /* l2                           */ {PORT,  I_L2,  BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, L2,   OTHER},
    /* pz: z - l4*r33               */ {PORT,  I_Z,   BY, PLUS,   L4,  R33,  SUB,  KEEP, HIGH, NIL,  OTHER},
    /* pz = .. - l1                 */ {PORT,  I_L1,  BY, MINUS,  NIL, NIL,  LONE, DONE, HIGH, PZ,   OTHER},
    /* < |C4u, N4u|^2               */ {REG,   C4u,   OF, C4u,    N4u, N4u,  ADD,  DONE, HIGH, NIL,  ROOT},
    /* R23s = r23                   */ {PORT,  I_R23, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R23s, OTHER},
    /* X1g = 1 / root               */ {TABLE, NIL,   BY, BACK,   NIL, NIL,  LONE, DONE, MID,  X1g,  OTHER},
    /* < C4g = 1 / root             */ {TABLE, NIL,   BY, FLIP,   NIL, NIL,  LONE, DONE, MID,  C4g,  OTHER},
    /* R13s = r13                   */ {PORT,  I_R13, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R13s, OTHER},
    /* < n4 = C4g * N4u             */ {LAST,  NIL,   OF, N4u,    NIL, NIL,  LONE, DONE, HIGH, N4,   HOLD},
    /* x1 = X1g * X1t               */ {REG,   X1g,   OF, X1t,    NIL, NIL,  LONE, DONE, HIGH, X1,   OTHER},
    /* < c4 = C4g * C4u             */ {REG,   C4g,   OF, C4u,    NIL, NIL,  LONE, DONE, HIGH, C4,   HOLD},
    /* xx: x1                       */ {LAST,  NIL,   BY, PLUS,   NIL, NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
    /* xx = .. - a1                 */ {PORT,  I_A1,  BY, MINUS,  NIL, NIL,  LONE, DONE, HIGH, XX,   OTHER},
    /* < t4 = -n4*c23               */ {PORT,  I_ONE, BY, NOUGHT, N4,  C23,  SUB,  DONE, HIGH, T4,   OTHER},
    /* < n5 = c4*m13 + n4*m23       */ {REG,   C4,    OF, M13,    N4,  M23,  ADD,  DONE, HIGH, N5,   OTHER},
    /* < w2 = t4*n1 + c4*c1         */ {LAST,  NIL,   OF, N1,     C4,  C1,   ADD,  DONE, HIGH, W2,   OTHER},
    /* < k5 = n5*k                  */ {LAST,  NIL,   OF, K,      NIL, NIL,  LONE, DONE, HIGH, K5,   OTHER},
    /* k                            */ {PORT,  I_K,   BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, K,    OTHER},
    /* < c5 = n23*u3 + c23*r33      */ {REG,   N23,   OF, U3,     C23, R33s, ADD,  DONE, HIGH, C5,   OTHER},
    /* < w1 = t4*c1 - c4*n1         */ {REG,   T4,    OF, C1,     C4,  N1,   SUB,  DONE, HIGH, W1,   OTHER},
    /* CEd: xx*xx - l2*l2           */ {REG,   XX,    OF, XX,     L2,  L2,   SUB,  KEEP, HIGH, NIL,  OTHER},
    /* CEd = .. + pz*pz - k*k       */ {REG,   PZ,    OF, PZ,     K,   K,    SUB,  DONE, HIGH, CEd,  FAR},
    /* < w3 = n4*n23                */ {REG,   N4,    OF, N23,    NIL, NIL,  LONE, DONE, HIGH, W3,   OTHER},
    /* < n6: w1*r11 + w2*r21        */ {REG,   R11,   OF, W1,     W2,  R21,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* < n6 = .. + w3*r31           */ {LAST,  NIL,   OF, R31,    NIL, NIL,  LONE, DONE, HIGH, N6,   OTHER},
    /* CEr = CEd * r                */ {PORT,  I_R,   OF, CEd,    NIL, NIL,  LONE, DONE, HIGH, CEr,  OTHER},
    /* < near c4 k5*k5 - m*m        */ {REG,   K5,    OF, K5,     M,   M,    SUB,  DONE, HIGH, C4m,  NEAR},
    /* r21                          */ {PORT,  I_R21, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R21,  OTHER},
    /* r31                          */ {PORT,  I_R31, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R31,  OTHER},
    /* CEp = CEr * e                */ {PORT,  I_E,   OF, CEr,    NIL, NIL,  LONE, DONE, LOW,  CEp,  FAR},
    /* < c6: w1*r12 + w2*r22        */ {REG,   R12,   OF, W1,     W2,  R22,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* < c6 = .. + w3*r32           */ {REG,   R32,   OF, W3,     NIL, NIL,  LONE, DONE, HIGH, C6,   OTHER},
    /* r22                          */ {PORT,  I_R22, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R22,  OTHER},
    /* ce = clamp CEp               */ {REG,   CEp,   BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, CE,   CLAMP},
    /* r11                          */ {PORT,  I_R11, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R11,  OTHER},
    /* r32                          */ {PORT,  I_R32, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R32,  OTHER},
    /* check: -r13 - r31*r22        */ {PORT,  I_R13, BY, MINUS,  R31, R22,  SUB,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r21*r32           */ {LAST,  NIL,   OF, R21,    NIL, NIL,  LONE, DONE, HIGH, NIL,  CHECK},
    /* yy = one - ce*ce             */ {PORT,  I_ONE, BY, PLUS,   CE,  CE,   SUB,  DONE, HIGH, YY,   FOLD},
    /* r12                          */ {PORT,  I_R12, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R12,  OTHER},
    /* check: -r23 - r11*r32        */ {PORT,  I_R23, BY, MINUS,  R11, R32,  SUB,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r31*r12           */ {LAST,  NIL,   OF, R31,    NIL, NIL,  LONE, DONE, HIGH, NIL,  CHECK},
    /* yy 4^j                       */ {REG,   YY,    BY, FOUR,   NIL, NIL,  LONE, DONE, LOW,  NIL,  ROOT},
    /* check: r11*r12 + r21*r22     */ {REG,   R11,   OF, R12,    R21, R22,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r31*r32           */ {REG,   R31,   OF, R32,    NIL, NIL,  LONE, DONE, HIGH, NIL,  CHECK},
    /* NEg = 1 / root               */ {TABLE, NIL,   BY, DOWN,   NIL, NIL,  LONE, DONE, MID,  NEg,  OTHER},
    /* NEt = yy 2^j                 */ {REG,   YY,    BY, TWICE,  NIL, NIL,  LONE, DONE, LOW,  NEt,  OTHER},
    /* check: -r33 - r21*r12        */ {PORT,  I_R33, BY, MINUS,  R21, R12,  SUB,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r11*r22           */ {REG,   R11,   OF, R22,    NIL, NIL,  LONE, DONE, HIGH, NIL,  CHECK},
    /* check: -one + r11*r11        */ {PORT,  I_ONE, BY, MINUS,  R11, R11,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r21*r21 + r31*r31 */ {REG,   R21,   OF, R21,    R31, R31,  ADD,  DONE, HIGH, NIL,  CHECK},
    /* ne = NEg * NEt               */ {REG,   NEg,   OF, NEt,    NIL, NIL,  LONE, DONE, HIGH, NE,   OTHER},
    /* R33s = r33                   */ {PORT,  I_R33, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R33s, OTHER},
    /* k2 = ne*k                    */ {LAST,  NIL,   OF, K,      NIL, NIL,  LONE, DONE, HIGH, K2,   OTHER},
    /* k1 = l2 + k*ce               */ {PORT,  I_L2,  BY, PLUS,   K,   CE,   ADD,  DONE, HIGH, K1,   OTHER},
    /* check: -one + r12*r12        */ {PORT,  I_ONE, BY, MINUS,  R12, R12,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r22*r22 + r32*r32 */ {REG,   R22,   OF, R22,    R32, R32,  ADD,  DONE, HIGH, NIL,  CHECK},
    /* far ce: edge*edge - xx*xx    */ {REG,   EDGE,  OF, EDGE,   XX,  XX,   SUB,  KEEP, HIGH, NIL,  OTHER},
    /* far ce .. - pz*pz            */ {PORT,  I_ONE, BY, NOUGHT, PZ,  PZ,   SUB,  DONE, HIGH, NIL,  OVER}};
    engine_program #(.LINES(102), .DRAIN(4), .BITS(47), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
    end
    if (PIPE == 2) begin : g_pipe2
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2, TABLE = 2'd3;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36, SLOPE = 6'd0, BACK = 6'd8, DOWN = 6'd16, FLIP = 6'd24,
        NOUGHT = 6'd4, POWER = 6'd1, FOUR = 6'd2, TWICE = 6'd3;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [1:0] HIGH = 2'd0, LOW = 2'd1, MID = 2'd2;
    localparam [8:0] OTHER = 9'd0, FOLD = 9'd1, MORE = 9'd2, WRIST = 9'd4, ABOVE = 9'd8, ROOT = 9'd16, HOLD = 9'd32,
        FAR = 9'd64, CLAMP = 9'd128, CHECK = 9'd256, NEAR = 9'd260, OVER = 9'd320;
    localparam [5:0]
        C1 = 6'd2, N1 = 6'd3, C2 = 6'd4, N2 = 6'd5, C3 = 6'd6, N3 = 6'd7, C4 = 6'd8, N4 = 6'd9, C5 = 6'd10,
        N5 = 6'd11, C6 = 6'd12, N6 = 6'd13, CEp = 6'd14, CEr = 6'd14, L4 = 6'd14, N4u = 6'd14, NEt = 6'd14,
        T4 = 6'd14, W2 = 6'd14, YY = 6'd14, N1v = 6'd15, PY = 6'd15, PX = 6'd16, R13 = 6'd16, B = 6'd17,
        C1g = 6'd17, R23 = 6'd17, C2u = 6'd18, C2v = 6'd18, PZ = 6'd18, Q = 6'd18, X1 = 6'd19, R23s = 6'd20,
        X1t = 6'd20, N2u = 6'd21, X1g = 6'd21, XX = 6'd21, C4u = 6'd22, R13s = 6'd22, K = 6'd23, R12 = 6'd24,
        CEd = 6'd25, R21 = 6'd25, R31 = 6'd26, R32 = 6'd27, R22 = 6'd28, R11 = 6'd29, C2g = 6'd30, CE = 6'd30,
        U3 = 6'd30, W3 = 6'd30, K1 = 6'd31, M = 6'd31, L2 = 6'd32, NE = 6'd32, NEg = 6'd32, R33 = 6'd32,
        C4g = 6'd33, K2 = 6'd33, W1 = 6'd33, K5 = 6'd34, R33s = 6'd34, C1m = 6'd35, C1u = 6'd36, C1v = 6'd36,
        N23 = 6'd36, C23 = 6'd37, NP = 6'd37, M23 = 6'd38, N1u = 6'd38, C2m = 6'd39, EDGE = 6'd40, M13 = 6'd41,
        N2v = 6'd41, C4m = 6'd47;
    localparam [5:0]
        I_R11 = 6'd0, I_R12 = 6'd1, I_R13 = 6'd2, I_R21 = 6'd3, I_R22 = 6'd4, I_R23 = 6'd5, I_R31 = 6'd6,
        I_R32 = 6'd7, I_R33 = 6'd8, I_X = 6'd9, I_Y = 6'd10, I_Z = 6'd11, I_A1 = 6'd12, I_B = 6'd13,
        I_L1 = 6'd14, I_L2 = 6'd15, I_L4 = 6'd16, I_K = 6'd17, I_CP = 6'd18, I_NP = 6'd19, I_R = 6'd20,
        I_E = 6'd21, I_M = 6'd22, I_SL = 6'd23, I_ONE = 6'd24;
    localparam [103*47-1:0] LINES = {
    /* l4                           */ {PORT,  I_L4,  BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, L4,   OTHER},
    /* < C1v = x1*px + b*py         */ {REG,   X1,    OF, PX,     B,   PY,   ADD,  DONE, HIGH, C1v,  FOLD},
    /* < N1v = x1*py - b*px         */ {REG,   X1,    OF, PY,     B,   PX,   SUB,  DONE, HIGH, N1v,  MORE},
    /* < np                         */ {PORT,  I_NP,  BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, NP,   OTHER},
    /* r13                          */ {PORT,  I_R13, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R13,  OTHER},
    /* r23                          */ {PORT,  I_R23, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R23,  OTHER},
    /* < N1u = N1v 2^s              */ {REG,   N1v,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  N1u,  OTHER},
    /* < C1u = C1v 2^s              */ {REG,   C1v,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  C1u,  OTHER},
    /* edge: l2                     */ {PORT,  I_L2,  BY, PLUS,   NIL, NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
    /* edge .. + k                  */ {PORT,  I_K,   BY, PLUS,   NIL, NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
    /* edge = .. + sl               */ {PORT,  I_SL,  BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, EDGE, OTHER},
    /* < |C1u, N1u|^2               */ {REG,   C1u,   OF, C1u,    N1u, N1u,  ADD,  DONE, HIGH, NIL,  ROOT},
    /* < N2v = k1*xx - k2*pz        */ {REG,   K1,    OF, XX,     K2,  PZ,   SUB,  DONE, HIGH, N2v,  FOLD},
    /* < C2v = k1*pz + k2*xx        */ {REG,   K1,    OF, PZ,     K2,  XX,   ADD,  DONE, HIGH, C2v,  MORE},
    /* py = y - l4*r23              */ {PORT,  I_Y,   BY, PLUS,   L4,  R23,  SUB,  DONE, HIGH, PY,   OTHER},
    /* < C1g = 1 / root             */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL,  LONE, DONE, MID,  C1g,  OTHER},
    /* px = x - l4*r13              */ {PORT,  I_X,   BY, PLUS,   L4,  R13,  SUB,  DONE, HIGH, PX,   OTHER},
    /* < C2u = C2v 2^s              */ {REG,   C2v,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  C2u,  OTHER},
    /* < N2u = N2v 2^s              */ {REG,   N2v,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  N2u,  OTHER},
    /* < c1 = C1g * C1u             */ {REG,   C1g,   OF, C1u,    NIL, NIL,  LONE, DONE, HIGH, C1,   HOLD},
    /* < n1 = C1g * N1u             */ {REG,   C1g,   OF, N1u,    NIL, NIL,  LONE, DONE, HIGH, N1,   HOLD},
    /* < m                          */ {PORT,  I_M,   BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, M,    OTHER},
    /* < |C2u, N2u|^2               */ {REG,   C2u,   OF, C2u,    N2u, N2u,  ADD,  DONE, HIGH, NIL,  ROOT},
    /* b                            */ {PORT,  I_B,   BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, B,    OTHER},
    /* < n3 = cp*ne - ce*np         */ {PORT,  I_CP,  OF, NE,     CE,  NP,   SUB,  DONE, HIGH, N3,   OTHER},
    /* < c3 = cp*ce + ne*np         */ {PORT,  I_CP,  OF, CE,     NE,  NP,   ADD,  DONE, HIGH, C3,   OTHER},
    /* < C2g = 1 / root             */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL,  LONE, DONE, MID,  C2g,  OTHER},
    /* r33                          */ {PORT,  I_R33, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R33,  OTHER},
    /*                              */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL,  LONE, DONE, HIGH, NIL,  OTHER},
    /* < c2 = C2g * C2u             */ {LAST,  NIL,   OF, C2u,    NIL, NIL,  LONE, DONE, HIGH, C2,   HOLD},
    /* < n2 = C2g * N2u             */ {REG,   C2g,   OF, N2u,    NIL, NIL,  LONE, DONE, HIGH, N2,   HOLD},
    /* q: px*px - b*b               */ {REG,   PX,    OF, PX,     B,   B,    SUB,  KEEP, HIGH, NIL,  OTHER},
    /* q = .. + py*py               */ {REG,   PY,    OF, PY,     NIL, NIL,  LONE, DONE, HIGH, Q,    FOLD | ABOVE},
    /* < u3 = c1*r13 + n1*r23       */ {REG,   R13s,  OF, C1,     N1,  R23s, ADD,  DONE, HIGH, U3,   OTHER},
    /* < n23 = n2*c3 + c2*n3        */ {REG,   N2,    OF, C3,     C2,  N3,   ADD,  DONE, HIGH, N23,  OTHER},
    /* < c23 = c2*c3 - n2*n3        */ {REG,   C2,    OF, C3,     N2,  N3,   SUB,  DONE, HIGH, C23,  OTHER},
    /* q 4^j                        */ {REG,   Q,     BY, FOUR,   NIL, NIL,  LONE, DONE, LOW,  NIL,  ROOT},
    /* < m23 = c1*r23 - n1*r13      */ {REG,   R23s,  OF, C1,     N1,  R13s, SUB,  DONE, HIGH, M23,  FOLD | WRIST},
    /* < m13 = c23*u3 - n23*r33     */ {LAST,  NIL,   OF, U3,     N23, R33s, SUB,  DONE, HIGH, M13,  MORE | WRIST},
    /* X1t = q 2^j                  */ {REG,   Q,     BY, TWICE,  NIL, NIL,  LONE, DONE, LOW,  X1t,  OTHER},
    /* pz: z - l4*r33               */ {PORT,  I_Z,   BY, PLUS,   L4,  R33,  SUB,  KEEP, HIGH, NIL,  OTHER},
    /* pz = .. - l1                 */ {PORT,  I_L1,  BY, MINUS,  NIL, NIL,  LONE, DONE, HIGH, PZ,   OTHER},
    /* < N4u = m23 2^s              */ {REG,   M23,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  N4u,  OTHER},
    /* < C4u = m13 2^s              */ {REG,   M13,   BY, POWER,  NIL, NIL,  LONE, DONE, LOW,  C4u,  OTHER},
    /* X1g = 1 / root               */ {TABLE, NIL,   BY, BACK,   NIL, NIL,  LONE, DONE, MID,  X1g,  OTHER},
    /* < near c1 x1*x1 - m*m        */ {REG,   X1,    OF, X1,     M,   M,    SUB,  DONE, HIGH, C1m,  NEAR},
    /* l2                           */ {PORT,  I_L2,  BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, L2,   OTHER},
    /* < |C4u, N4u|^2               */ {REG,   C4u,   OF, C4u,    N4u, N4u,  ADD,  DONE, HIGH, NIL,  ROOT},
    /* x1 = X1g * X1t               */ {REG,   X1g,   OF, X1t,    NIL, NIL,  LONE, DONE, HIGH, X1,   OTHER},
    /* R23s = r23                   */ {PORT,  I_R23, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R23s, OTHER},
    /* < near c2 k2*k2 - m*m        */ {REG,   K2,    OF, K2,     M,   M,    SUB,  DONE, HIGH, C2m,  NEAR},
    /* < C4g = 1 / root             */ {TABLE, NIL,   BY, FLIP,   NIL, NIL,  LONE, DONE, MID,  C4g,  OTHER},
    /* xx: x1                       */ {REG,   X1,    BY, PLUS,   NIL, NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
    /* xx = .. - a1                 */ {PORT,  I_A1,  BY, MINUS,  NIL, NIL,  LONE, DONE, HIGH, XX,   OTHER},
    /* < n4 = C4g * N4u             */ {LAST,  NIL,   OF, N4u,    NIL, NIL,  LONE, DONE, HIGH, N4,   HOLD},
    /* < c4 = C4g * C4u             */ {REG,   C4g,   OF, C4u,    NIL, NIL,  LONE, DONE, HIGH, C4,   HOLD},
    /* R13s = r13                   */ {PORT,  I_R13, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R13s, OTHER},
    /* < c5 = n23*u3 + c23*r33      */ {REG,   N23,   OF, U3,     C23, R33s, ADD,  DONE, HIGH, C5,   OTHER},
    /* < t4 = -n4*c23               */ {PORT,  I_ONE, BY, NOUGHT, N4,  C23,  SUB,  DONE, HIGH, T4,   OTHER},
    /* < w3 = n4*n23                */ {REG,   N4,    OF, N23,    NIL, NIL,  LONE, DONE, HIGH, W3,   OTHER},
    /* < n5 = c4*m13 + n4*m23       */ {REG,   C4,    OF, M13,    N4,  M23,  ADD,  DONE, HIGH, N5,   OTHER},
    /* < w1 = t4*c1 - c4*n1         */ {LAST,  NIL,   OF, C1,     C4,  N1,   SUB,  DONE, HIGH, W1,   OTHER},
    /* < w2 = t4*n1 + c4*c1         */ {REG,   T4,    OF, N1,     C4,  C1,   ADD,  DONE, HIGH, W2,   OTHER},
    /* < k5 = n5*k                  */ {LAST,  NIL,   OF, K,      NIL, NIL,  LONE, DONE, HIGH, K5,   OTHER},
    /* k                            */ {PORT,  I_K,   BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, K,    OTHER},
    /* < n6: w1*r11 + w2*r21        */ {LAST,  NIL,   OF, R21,    R11, W1,   ADD,  KEEP, HIGH, NIL,  OTHER},
    /* < n6 = .. + w3*r31           */ {REG,   R31,   OF, W3,     NIL, NIL,  LONE, DONE, HIGH, N6,   OTHER},
    /* < near c4 k5*k5 - m*m        */ {REG,   K5,    OF, K5,     M,   M,    SUB,  DONE, HIGH, C4m,  NEAR},
    /* CEd: xx*xx - l2*l2           */ {REG,   XX,    OF, XX,     L2,  L2,   SUB,  KEEP, HIGH, NIL,  OTHER},
    /* CEd = .. + pz*pz - k*k       */ {REG,   PZ,    OF, PZ,     K,   K,    SUB,  DONE, HIGH, CEd,  FAR},
    /* < c6: w1*r12 + w2*r22        */ {REG,   R12,   OF, W1,     W2,  R22,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* < c6 = .. + w3*r32           */ {REG,   R32,   OF, W3,     NIL, NIL,  LONE, DONE, HIGH, C6,   OTHER},
    /* r12                          */ {PORT,  I_R12, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R12,  OTHER},
    /* CEr = CEd * r                */ {PORT,  I_R,   OF, CEd,    NIL, NIL,  LONE, DONE, HIGH, CEr,  OTHER},
    /* r21                          */ {PORT,  I_R21, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R21,  OTHER},
    /* r31                          */ {PORT,  I_R31, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R31,  OTHER},
    /* r32                          */ {PORT,  I_R32, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R32,  OTHER},
    /* r22                          */ {PORT,  I_R22, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R22,  OTHER},
    /* CEp = CEr * e                */ {PORT,  I_E,   OF, CEr,    NIL, NIL,  LONE, DONE, LOW,  CEp,  FAR},
    /* r11                          */ {PORT,  I_R11, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R11,  OTHER},
    /* check: -one + r12*r12        */ {PORT,  I_ONE, BY, MINUS,  R12, R12,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r22*r22 + r32*r32 */ {REG,   R22,   OF, R22,    R32, R32,  ADD,  DONE, HIGH, NIL,  CHECK},
    /* ce = clamp CEp               */ {REG,   CEp,   BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, CE,   CLAMP},
    /* check: r11*r12 + r21*r22     */ {REG,   R11,   OF, R12,    R21, R22,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r31*r32           */ {REG,   R31,   OF, R32,    NIL, NIL,  LONE, DONE, HIGH, NIL,  CHECK},
    /* check: -r13 - r31*r22        */ {PORT,  I_R13, BY, MINUS,  R31, R22,  SUB,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r21*r32           */ {REG,   R21,   OF, R32,    NIL, NIL,  LONE, DONE, HIGH, NIL,  CHECK},
    /* yy = one - ce*ce             */ {PORT,  I_ONE, BY, PLUS,   CE,  CE,   SUB,  DONE, HIGH, YY,   FOLD},
    /* k1 = l2 + k*ce               */ {PORT,  I_L2,  BY, PLUS,   K,   CE,   ADD,  DONE, HIGH, K1,   OTHER},
    /* check: -r33 - r21*r12        */ {PORT,  I_R33, BY, MINUS,  R21, R12,  SUB,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r11*r22           */ {REG,   R11,   OF, R22,    NIL, NIL,  LONE, DONE, HIGH, NIL,  CHECK},
    /* yy 4^j                       */ {REG,   YY,    BY, FOUR,   NIL, NIL,  LONE, DONE, LOW,  NIL,  ROOT},
    /* check: -r23 - r11*r32        */ {PORT,  I_R23, BY, MINUS,  R11, R32,  SUB,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r31*r12           */ {REG,   R31,   OF, R12,    NIL, NIL,  LONE, DONE, HIGH, NIL,  CHECK},
    /* NEt = yy 2^j                 */ {REG,   YY,    BY, TWICE,  NIL, NIL,  LONE, DONE, LOW,  NEt,  OTHER},
    /* NEg = 1 / root               */ {TABLE, NIL,   BY, DOWN,   NIL, NIL,  LONE, DONE, MID,  NEg,  OTHER},
    /* far ce: edge*edge - xx*xx    */ {REG,   EDGE,  OF, EDGE,   XX,  XX,   SUB,  KEEP, HIGH, NIL,  OTHER},
    /* far ce .. - pz*pz            */ {PORT,  I_ONE, BY, NOUGHT, PZ,  PZ,   SUB,  DONE, HIGH, NIL,  OVER},
    /* ne = NEg * NEt               */ {LAST,  NIL,   OF, NEt,    NIL, NIL,  LONE, DONE, HIGH, NE,   OTHER},
    /* check: -one + r11*r11        */ {PORT,  I_ONE, BY, MINUS,  R11, R11,  ADD,  KEEP, HIGH, NIL,  OTHER},
    /* check .. + r21*r21 + r31*r31 */ {REG,   R21,   OF, R21,    R31, R31,  ADD,  DONE, HIGH, NIL,  CHECK},
    /* k2 = ne*k                    */ {LAST,  NIL,   OF, K,      NIL, NIL,  LONE, DONE, HIGH, K2,   OTHER},
    /* R33s = r33                   */ {PORT,  I_R33, BY, PLUS,   NIL, NIL,  LONE, DONE, HIGH, R33s, OTHER}};
    engine_program #(.LINES(103), .DRAIN(6), .REGISTER(1), .BITS(47), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
    end
    if (PIPE != 1 && PIPE != 2) begin : g_illegal
        vector_ik6_near_two_program_needs_PIPE_1_or_2 rule ();
    end
    endgenerate
endmodule
`default_nettype wire

// Order of the lines of vector_ik6_near.kin, for each PIPE
// pipe 1: 0 25 26 7 2 27 28 1 16 4 29 47 48 30 15 31 50 49 32 14 55 51 56 59 52 19 20 3 54 53 22 21 60 58 57 91 92
// pipe 1: 93 61 96 90 63 62 5 17 18 64 100 23 65 99 67 24 66 33 34 70 69 72 97 6 68 71 35 36 73 74 75 37 98 13 8 38
// pipe 1: 76 77 9 39 11 10 78 79 40 12 80 81 41 84 85 43 42 82 83 86 87 44 101 46 45 88 89 94 95
// pipe 2: 0 25 26 7 1 2 28 27 91 92 93 29 48 47 16 30 15 49 50 31 32 14 51 4 56 55 52 3 - 53 54 19 20 59 58 57 21
// pipe 2: 60 61 22 17 18 63 62 23 90 5 64 24 100 96 65 33 34 67 66 99 68 70 73 69 71 72 97 6 74 75 98 35 36 76 77
// pipe 2: 12 37 13 8 10 9 38 11 88 89 39 84 85 78 79 40 45 82 83 41 80 81 42 43 94 95 44 86 87 46 101
