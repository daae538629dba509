// SPDX-License-Identifier: Apache-2.0
// Assembled from vector_ik6.kin and vector_ik6.order by `quadrance assemble`; do not edit.
//   A pose to the six unit vectors of one branch: ortho-parallel base, spherical wrist
// Line: word = A * B [+- C * D], DEST, and what else is done with it; one line a clock. I_ begins the name of an input;
// a word of capitals and a small letter is one that the assembler has added. Latency of a core that plays it: 93.
// For product_engine with PIPE = 0. Model: quadrance.program.meaning
`default_nettype none
module vector_ik6_program (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    output wire        out_idle,
    output wire        out_done,
    output wire [46:0] out_op
);
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2, TABLE = 2'd3;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36, SLOPE = 6'd0, BACK = 6'd8, DOWN = 6'd16, FLIP = 6'd24,
        NOUGHT = 6'd4, POWER = 6'd1, FOUR = 6'd2, TWICE = 6'd3;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [1:0] HIGH = 2'd0, LOW = 2'd1, MID = 2'd2;
    localparam [8:0] OTHER = 9'd0, FOLD = 9'd1, MORE = 9'd2, WRIST = 9'd4, ABOVE = 9'd8, ROOT = 9'd16, HOLD = 9'd32,
        FAR = 9'd64, CLAMP = 9'd128, CHECK = 9'd256;
    localparam [5:0]
        C1 = 6'd2, N1 = 6'd3, C2 = 6'd4, N2 = 6'd5, C3 = 6'd6, N3 = 6'd7, C4 = 6'd8, N4 = 6'd9, C5 = 6'd10,
        N5 = 6'd11, C6 = 6'd12, N6 = 6'd13, L4 = 6'd14, N23 = 6'd14, N2u = 6'd14, N2v = 6'd14, PZ = 6'd14,
        W3 = 6'd14, M23 = 6'd15, R13 = 6'd15, W2 = 6'd15, R12 = 6'd16, R23 = 6'd16, B = 6'd17, C2u = 6'd17,
        N1u = 6'd17, N1v = 6'd17, NE = 6'd17, NEt = 6'd17, R21 = 6'd17, CE = 6'd18, CEd = 6'd18, CEp = 6'd18,
        CEr = 6'd18, PX = 6'd18, R32 = 6'd18, C1u = 6'd19, PY = 6'd19, U3 = 6'd19, W1 = 6'd19, YY = 6'd19,
        R33 = 6'd20, NP = 6'd21, Q = 6'd21, R11 = 6'd21, X1 = 6'd21, X1t = 6'd21, L2 = 6'd22, R31 = 6'd22,
        C23 = 6'd23, C2g = 6'd23, K = 6'd23, K2 = 6'd23, M13 = 6'd24, X1g = 6'd24, XX = 6'd24, C1g = 6'd25,
        C1v = 6'd25, C2v = 6'd25, C4u = 6'd25, NEg = 6'd25, T4 = 6'd25, R22 = 6'd26, K1 = 6'd27, N4u = 6'd27,
        C4g = 6'd28;
    localparam [5:0]
        I_R11 = 6'd0, I_R12 = 6'd1, I_R13 = 6'd2, I_R21 = 6'd3, I_R22 = 6'd4, I_R23 = 6'd5, I_R31 = 6'd6,
        I_R32 = 6'd7, I_R33 = 6'd8, I_X = 6'd9, I_Y = 6'd10, I_Z = 6'd11, I_A1 = 6'd12, I_B = 6'd13,
        I_L1 = 6'd14, I_L2 = 6'd15, I_L4 = 6'd16, I_K = 6'd17, I_CP = 6'd18, I_NP = 6'd19, I_R = 6'd20,
        I_E = 6'd21, I_ONE = 6'd22;
    localparam [89*47-1:0] LINES = {
    /* l4                           */ {PORT,  I_L4,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, L4,  OTHER},
    /* r13                          */ {PORT,  I_R13, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R13, OTHER},
    /* r23                          */ {PORT,  I_R23, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R23, OTHER},
    /* b                            */ {PORT,  I_B,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, B,   OTHER},
    /* px = x - l4*r13              */ {PORT,  I_X,   BY, PLUS,   L4,  R13, SUB,  DONE, HIGH, PX,  OTHER},
    /* py = y - l4*r23              */ {PORT,  I_Y,   BY, PLUS,   L4,  R23, SUB,  DONE, HIGH, PY,  OTHER},
    /* r33                          */ {PORT,  I_R33, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R33, OTHER},
    /* q: px*px - b*b               */ {REG,   PX,    OF, PX,     B,   B,   SUB,  KEEP, HIGH, NIL, OTHER},
    /* q = .. + py*py               */ {REG,   PY,    OF, PY,     NIL, NIL, LONE, DONE, HIGH, Q,   FOLD | ABOVE},
    /* l2                           */ {PORT,  I_L2,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, L2,  OTHER},
    /* pz: z - l4*r33               */ {PORT,  I_Z,   BY, PLUS,   L4,  R33, SUB,  KEEP, HIGH, NIL, OTHER},
    /* pz = .. - l1                 */ {PORT,  I_L1,  BY, MINUS,  NIL, NIL, LONE, DONE, HIGH, PZ,  OTHER},
    /* q 4^j                        */ {REG,   Q,     BY, FOUR,   NIL, NIL, LONE, DONE, LOW,  NIL, ROOT},
    /* X1t = q 2^j                  */ {REG,   Q,     BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  X1t, OTHER},
    /* k                            */ {PORT,  I_K,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, K,   OTHER},
    /* X1g = 1 / root               */ {TABLE, NIL,   BY, BACK,   NIL, NIL, LONE, DONE, MID,  X1g, OTHER},
    /* x1 = X1g * X1t               */ {LAST,  NIL,   OF, X1t,    NIL, NIL, LONE, DONE, HIGH, X1,  OTHER},
    /* xx: x1                       */ {LAST,  NIL,   BY, PLUS,   NIL, NIL, LONE, KEEP, HIGH, NIL, OTHER},
    /* xx = .. - a1                 */ {PORT,  I_A1,  BY, MINUS,  NIL, NIL, LONE, DONE, HIGH, XX,  OTHER},
    /* C1v = x1*px + b*py           */ {REG,   X1,    OF, PX,     B,   PY,  ADD,  DONE, HIGH, C1v, FOLD},
    /* N1v = x1*py - b*px           */ {REG,   X1,    OF, PY,     B,   PX,  SUB,  DONE, HIGH, N1v, MORE},
    /* CEd: xx*xx - l2*l2           */ {REG,   XX,    OF, XX,     L2,  L2,  SUB,  KEEP, HIGH, NIL, OTHER},
    /* CEd = .. + pz*pz - k*k       */ {REG,   PZ,    OF, PZ,     K,   K,   SUB,  DONE, HIGH, CEd, FAR},
    /* C1u = C1v 2^s                */ {REG,   C1v,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  C1u, OTHER},
    /* N1u = N1v 2^s                */ {REG,   N1v,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  N1u, OTHER},
    /* CEr = CEd * r                */ {PORT,  I_R,   OF, CEd,    NIL, NIL, LONE, DONE, HIGH, CEr, OTHER},
    /* np                           */ {PORT,  I_NP,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, NP,  OTHER},
    /* |C1u, N1u|^2                 */ {REG,   C1u,   OF, C1u,    N1u, N1u, ADD,  DONE, HIGH, NIL, ROOT},
    /* CEp = CEr * e                */ {PORT,  I_E,   OF, CEr,    NIL, NIL, LONE, DONE, LOW,  CEp, FAR},
    /* r31                          */ {PORT,  I_R31, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R31, OTHER},
    /* C1g = 1 / root               */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL, LONE, DONE, MID,  C1g, OTHER},
    /* ce = clamp CEp               */ {REG,   CEp,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, CE,  CLAMP},
    /* r22                          */ {PORT,  I_R22, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R22, OTHER},
    /* c1 = C1g * C1u               */ {REG,   C1g,   OF, C1u,    NIL, NIL, LONE, DONE, HIGH, C1,  HOLD},
    /* yy = one - ce*ce             */ {PORT,  I_ONE, BY, PLUS,   CE,  CE,  SUB,  DONE, HIGH, YY,  FOLD},
    /* k1 = l2 + k*ce               */ {PORT,  I_L2,  BY, PLUS,   K,   CE,  ADD,  DONE, HIGH, K1,  OTHER},
    /* n1 = C1g * N1u               */ {REG,   C1g,   OF, N1u,    NIL, NIL, LONE, DONE, HIGH, N1,  HOLD},
    /* yy 4^j                       */ {REG,   YY,    BY, FOUR,   NIL, NIL, LONE, DONE, LOW,  NIL, ROOT},
    /* NEt = yy 2^j                 */ {REG,   YY,    BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  NEt, OTHER},
    /* u3 = c1*r13 + n1*r23         */ {REG,   R13,   OF, C1,     N1,  R23, ADD,  DONE, HIGH, U3,  OTHER},
    /* NEg = 1 / root               */ {TABLE, NIL,   BY, DOWN,   NIL, NIL, LONE, DONE, MID,  NEg, OTHER},
    /* ne = NEg * NEt               */ {LAST,  NIL,   OF, NEt,    NIL, NIL, LONE, DONE, HIGH, NE,  OTHER},
    /* k2 = ne*k                    */ {LAST,  NIL,   OF, K,      NIL, NIL, LONE, DONE, HIGH, K2,  OTHER},
    /* C2v = k1*pz + k2*xx          */ {LAST,  NIL,   OF, XX,     K1,  PZ,  ADD,  DONE, HIGH, C2v, FOLD},
    /* c3 = cp*ce + ne*np           */ {PORT,  I_CP,  OF, CE,     NE,  NP,  ADD,  DONE, HIGH, C3,  OTHER},
    /* N2v = k1*xx - k2*pz          */ {REG,   K1,    OF, XX,     K2,  PZ,  SUB,  DONE, HIGH, N2v, MORE},
    /* n3 = cp*ne - ce*np           */ {PORT,  I_CP,  OF, NE,     CE,  NP,  SUB,  DONE, HIGH, N3,  OTHER},
    /* C2u = C2v 2^s                */ {REG,   C2v,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  C2u, OTHER},
    /* N2u = N2v 2^s                */ {REG,   N2v,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  N2u, OTHER},
    /* r32                          */ {PORT,  I_R32, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R32, OTHER},
    /* r11                          */ {PORT,  I_R11, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R11, OTHER},
    /* |C2u, N2u|^2                 */ {REG,   C2u,   OF, C2u,    N2u, N2u, ADD,  DONE, HIGH, NIL, ROOT},
    /* m23 = c1*r23 - n1*r13        */ {REG,   R23,   OF, C1,     N1,  R13, SUB,  DONE, HIGH, M23, FOLD | WRIST},
    /* r12                          */ {PORT,  I_R12, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R12, OTHER},
    /* C2g = 1 / root               */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL, LONE, DONE, MID,  C2g, OTHER},
    /* c2 = C2g * C2u               */ {LAST,  NIL,   OF, C2u,    NIL, NIL, LONE, DONE, HIGH, C2,  HOLD},
    /* r21                          */ {PORT,  I_R21, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, R21, OTHER},
    /* n2 = C2g * N2u               */ {REG,   C2g,   OF, N2u,    NIL, NIL, LONE, DONE, HIGH, N2,  HOLD},
    /* check: -r13 - r31*r22        */ {PORT,  I_R13, BY, MINUS,  R31, R22, SUB,  KEEP, HIGH, NIL, OTHER},
    /* check .. + r21*r32           */ {REG,   R21,   OF, R32,    NIL, NIL, LONE, DONE, HIGH, NIL, CHECK},
    /* n23 = n2*c3 + c2*n3          */ {REG,   N2,    OF, C3,     C2,  N3,  ADD,  DONE, HIGH, N23, OTHER},
    /* c23 = c2*c3 - n2*n3          */ {REG,   C2,    OF, C3,     N2,  N3,  SUB,  DONE, HIGH, C23, OTHER},
    /* check: -r23 - r11*r32        */ {PORT,  I_R23, BY, MINUS,  R11, R32, SUB,  KEEP, HIGH, NIL, OTHER},
    /* check .. + r31*r12           */ {REG,   R31,   OF, R12,    NIL, NIL, LONE, DONE, HIGH, NIL, CHECK},
    /* m13 = c23*u3 - n23*r33       */ {REG,   C23,   OF, U3,     N23, R33, SUB,  DONE, HIGH, M13, MORE | WRIST},
    /* check: -r33 - r21*r12        */ {PORT,  I_R33, BY, MINUS,  R21, R12, SUB,  KEEP, HIGH, NIL, OTHER},
    /* check .. + r11*r22           */ {REG,   R11,   OF, R22,    NIL, NIL, LONE, DONE, HIGH, NIL, CHECK},
    /* C4u = m13 2^s                */ {REG,   M13,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  C4u, OTHER},
    /* N4u = m23 2^s                */ {REG,   M23,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  N4u, OTHER},
    /* check: r11*r12 + r21*r22     */ {REG,   R11,   OF, R12,    R21, R22, ADD,  KEEP, HIGH, NIL, OTHER},
    /* check .. + r31*r32           */ {REG,   R31,   OF, R32,    NIL, NIL, LONE, DONE, HIGH, NIL, CHECK},
    /* |C4u, N4u|^2                 */ {REG,   C4u,   OF, C4u,    N4u, N4u, ADD,  DONE, HIGH, NIL, ROOT},
    /* check: -one + r11*r11        */ {PORT,  I_ONE, BY, MINUS,  R11, R11, ADD,  KEEP, HIGH, NIL, OTHER},
    /* check .. + r21*r21 + r31*r31 */ {REG,   R21,   OF, R21,    R31, R31, ADD,  DONE, HIGH, NIL, CHECK},
    /* C4g = 1 / root               */ {TABLE, NIL,   BY, FLIP,   NIL, NIL, LONE, DONE, MID,  C4g, OTHER},
    /* n4 = C4g * N4u               */ {LAST,  NIL,   OF, N4u,    NIL, NIL, LONE, DONE, HIGH, N4,  HOLD},
    /* check: -one + r12*r12        */ {PORT,  I_ONE, BY, MINUS,  R12, R12, ADD,  KEEP, HIGH, NIL, OTHER},
    /* check .. + r22*r22 + r32*r32 */ {REG,   R22,   OF, R22,    R32, R32, ADD,  DONE, HIGH, NIL, CHECK},
    /* c4 = C4g * C4u               */ {REG,   C4g,   OF, C4u,    NIL, NIL, LONE, DONE, HIGH, C4,  HOLD},
    /* t4 = -n4*c23                 */ {PORT,  I_ONE, BY, NOUGHT, N4,  C23, SUB,  DONE, HIGH, T4,  OTHER},
    /* c5 = n23*u3 + c23*r33        */ {REG,   N23,   OF, U3,     C23, R33, ADD,  DONE, HIGH, C5,  OTHER},
    /* n5 = c4*m13 + n4*m23         */ {REG,   C4,    OF, M13,    N4,  M23, ADD,  DONE, HIGH, N5,  OTHER},
    /* w2 = t4*n1 + c4*c1           */ {REG,   T4,    OF, N1,     C4,  C1,  ADD,  DONE, HIGH, W2,  OTHER},
    /* w3 = n4*n23                  */ {REG,   N4,    OF, N23,    NIL, NIL, LONE, DONE, HIGH, W3,  OTHER},
    /* w1 = t4*c1 - c4*n1           */ {REG,   T4,    OF, C1,     C4,  N1,  SUB,  DONE, HIGH, W1,  OTHER},
    /* n6: w1*r11 + w2*r21          */ {LAST,  NIL,   OF, R11,    W2,  R21, ADD,  KEEP, HIGH, NIL, OTHER},
    /* n6 = .. + w3*r31             */ {REG,   R31,   OF, W3,     NIL, NIL, LONE, DONE, HIGH, N6,  OTHER},
    /* c6: w1*r12 + w2*r22          */ {REG,   R12,   OF, W1,     W2,  R22, ADD,  KEEP, HIGH, NIL, OTHER},
    /* c6 = .. + w3*r32             */ {REG,   R32,   OF, W3,     NIL, NIL, LONE, DONE, HIGH, C6,  OTHER}};
    engine_program #(.LINES(89), .BITS(47), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
endmodule
`default_nettype wire
