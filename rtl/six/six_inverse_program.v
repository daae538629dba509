// SPDX-License-Identifier: Apache-2.0
// Program of vector_ik6: a pose to the six unit vectors of one branch, in sums of two products and five roots.
//   p = tip - l4 z; rho; joint 1 = direction of (+-rho, b) to p; gap = |p'|^2 - l2^2 - k^2; cosine and sine
//   of the elbow (ce, ne) with its angle psi; joint 2; M = R03' R; joint 4 = direction of (m13, m23); joint 6
// Registers have the names of their words, ports I_; lN are the lengths c1 to c4. Line: word = A * B [+- C * D], DEST,
// and what else is done with it. One line a clock; a register is read from the third line behind its writer on.
// Model: six.ik6
`default_nettype none
module six_inverse_program (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    output wire        out_idle,
    output wire        out_done,
    output wire [46:0] out_op
);
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2, TABLE = 2'd3;
    localparam       OF = 1'b0, BY = 1'b1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'b100000, MINUS = 6'b100100, SLOPE = 6'd0, BACK = 6'b001000,
        DOWN = 6'b010000, FLIP = 6'b011000, NOUGHT = 6'b000100, POWER = 6'd1, FOUR = 6'd2, TWICE = 6'd3;
    localparam [1:0] LONE = 2'b00, ADD = 2'b10, SUB = 2'b11;
    localparam       DONE = 1'b0, KEEP = 1'b1;
    localparam [1:0] HIGH = 2'd0, LOW = 2'd1, MID = 2'd2;
    localparam [8:0] OTHER = 9'h000, FOLD = 9'h001, MORE = 9'h002, WRIST = 9'h004, ABOVE = 9'h008, ROOT = 9'h010,
        HOLD = 9'h020, FAR = 9'h040, CLAMP = 9'h080, CHECK = 9'h100;
    localparam [5:0]
        C1 = 6'd2, N1 = 6'd3, C2 = 6'd4, N2 = 6'd5, C3 = 6'd6, N3 = 6'd7, C4 = 6'd8, N4 = 6'd9, C5 = 6'd10, N5 = 6'd11,
        C6 = 6'd12, N6 = 6'd13, L4 = 6'd14, PZ = 6'd14, MAU = 6'd14, R32 = 6'd14, R13 = 6'd15, R31 = 6'd15, R23 = 6'd16,
        Gd = 6'd16, N23 = 6'd16, W2 = 6'd16, B = 6'd17, NN = 6'd17, PSI = 6'd17, MBU = 6'd17, C23 = 6'd17, W3 = 6'd17,
        PX = 6'd18, NAU = 6'd18, CE = 6'd18, M23 = 6'd18, PY = 6'd19, NBU = 6'd19, R11 = 6'd19, R33 = 6'd20,
        Q = 6'd21, L2 = 6'd21, TT = 6'd21, R21 = 6'd21, Ta = 6'd22, K = 6'd22, R12 = 6'd22,
        Ga = 6'd23, X1 = 6'd23, CU = 6'd23, YY = 6'd23, R22 = 6'd23, XX = 6'd24, M13 = 6'd24, NA = 6'd25, Gb = 6'd25,
        K1 = 6'd25, M13U = 6'd25, W1 = 6'd25, NB = 6'd26, U3 = 6'd26, Tc = 6'd27, K2 = 6'd27, M23U = 6'd27, Gc = 6'd28,
        NE = 6'd28, Ge = 6'd28, MA = 6'd29, T4 = 6'd29, MB = 6'd30;
    localparam [5:0]
        I_R11 = 6'd0, I_R12 = 6'd1, I_R13 = 6'd2, I_R21 = 6'd3, I_R22 = 6'd4, I_R23 = 6'd5, I_R31 = 6'd6,
        I_R32 = 6'd7, I_R33 = 6'd8, I_X = 6'd9, I_Y = 6'd10, I_Z = 6'd11, I_A1 = 6'd12, I_B = 6'd13, I_L1 = 6'd14,
        I_L2 = 6'd15, I_L4 = 6'd16, I_K = 6'd17, I_PC = 6'd18, I_PSI = 6'd19, I_RR = 6'd20, I_E = 6'd21,
        I_UNIT = 6'd22;
    //                           A              B           C     D     sum   keep  align dest  act
    localparam [90*47-1:0] LINES = {
        /* l4                */ {PORT,  I_L4,   BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, L4,   OTHER},
        /* r13               */ {PORT,  I_R13,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R13,  OTHER},
        /* r23               */ {PORT,  I_R23,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R23,  OTHER},
        /* b                 */ {PORT,  I_B,    BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, B,    OTHER},
        /* px                */ {PORT,  I_X,    BY, PLUS,   L4,   R13,  SUB,  DONE, HIGH, PX,   OTHER},
        /* py                */ {PORT,  I_Y,    BY, PLUS,   L4,   R23,  SUB,  DONE, HIGH, PY,   OTHER},
        /* r33               */ {PORT,  I_R33,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R33,  OTHER},
        /* px^2 - b^2        */ {REG,   PX,     OF, PX,     B,    B,    SUB,  KEEP, HIGH, NIL,  OTHER},
        /* rho^2             */ {REG,   PY,     OF, PY,     NIL,  NIL,  LONE, DONE, HIGH, Q,    FOLD | ABOVE},
        /* z - l4 r33        */ {PORT,  I_Z,    BY, PLUS,   L4,   R33,  SUB,  KEEP, HIGH, NIL,  OTHER},
        /* pz                */ {PORT,  I_L1,   BY, MINUS,  NIL,  NIL,  LONE, DONE, HIGH, PZ,   OTHER},
        /* rho^2 4^j         */ {REG,   Q,      BY, FOUR,   NIL,  NIL,  LONE, DONE, LOW,  NIL,  ROOT},
        /* rho^2 2^j         */ {REG,   Q,      BY, TWICE,  NIL,  NIL,  LONE, DONE, LOW,  Ta,   OTHER},
        /* l2                */ {PORT,  I_L2,   BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, L2,   OTHER},
        /* 1 / root          */ {TABLE, NIL,    BY, BACK,   NIL,  NIL,  LONE, DONE, MID,  Ga,   OTHER},
        /* x1                */ {LAST,  NIL,    OF, Ta,     NIL,  NIL,  LONE, DONE, HIGH, X1,   OTHER},
        /* k                 */ {PORT,  I_K,    BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, K,    OTHER},
        /* -a1               */ {PORT,  I_A1,   BY, MINUS,  NIL,  NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
        /* x                 */ {REG,   X1,     BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, XX,   OTHER},
        /* x1 px + b py      */ {REG,   X1,     OF, PX,     B,    PY,   ADD,  DONE, HIGH, NA,   FOLD},
        /* x1 py - b px      */ {REG,   X1,     OF, PY,     B,    PX,   SUB,  DONE, HIGH, NB,   MORE},
        /* x^2 - l2^2        */ {REG,   XX,     OF, XX,     L2,   L2,   SUB,  KEEP, HIGH, NIL,  OTHER},
        /* gap               */ {REG,   PZ,     OF, PZ,     K,    K,    SUB,  DONE, HIGH, NN,   FAR},
        /* NA up             */ {REG,   NA,     BY, POWER,  NIL,  NIL,  LONE, DONE, LOW,  NAU,  OTHER},
        /* NB up             */ {REG,   NB,     BY, POWER,  NIL,  NIL,  LONE, DONE, LOW,  NBU,  OTHER},
        /* gap r             */ {PORT,  I_RR,   OF, NN,     NIL,  NIL,  LONE, DONE, HIGH, TT,   OTHER},
        /* psi               */ {PORT,  I_PSI,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, PSI,  OTHER},
        /* qb                */ {REG,   NAU,    OF, NAU,    NBU,  NBU,  ADD,  DONE, HIGH, NIL,  ROOT},
        /* ce, unbounded     */ {PORT,  I_E,    OF, TT,     NIL,  NIL,  LONE, DONE, LOW,  CU,   FAR},
        /* r21               */ {PORT,  I_R21,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R21,  OTHER},
        /* 1 / root          */ {TABLE, NIL,    BY, SLOPE,  NIL,  NIL,  LONE, DONE, MID,  Gb,   OTHER},
        /* c1                */ {LAST,  NIL,    OF, NAU,    NIL,  NIL,  LONE, DONE, HIGH, C1,   HOLD},
        /* ce                */ {REG,   CU,     BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, CE,   CLAMP},
        /* n1                */ {REG,   Gb,     OF, NBU,    NIL,  NIL,  LONE, DONE, HIGH, N1,   HOLD},
        /* r11               */ {PORT,  I_R11,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R11,  OTHER},
        /* 1 - ce^2          */ {PORT,  I_UNIT, BY, PLUS,   CE,   CE,   SUB,  DONE, HIGH, YY,   FOLD},
        /* k1                */ {PORT,  I_L2,   BY, PLUS,   K,    CE,   ADD,  DONE, HIGH, K1,   OTHER},
        /* u3                */ {REG,   C1,     OF, R13,    N1,   R23,  ADD,  DONE, HIGH, U3,   OTHER},
        /* 1 - ce^2 4^j      */ {REG,   YY,     BY, FOUR,   NIL,  NIL,  LONE, DONE, LOW,  NIL,  ROOT},
        /* 1 - ce^2 2^j      */ {REG,   YY,     BY, TWICE,  NIL,  NIL,  LONE, DONE, LOW,  Tc,   OTHER},
        /* r22               */ {PORT,  I_R22,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R22,  OTHER},
        /* 1 / root          */ {TABLE, NIL,    BY, DOWN,   NIL,  NIL,  LONE, DONE, MID,  Gc,   OTHER},
        /* ne                */ {LAST,  NIL,    OF, Tc,     NIL,  NIL,  LONE, DONE, HIGH, NE,   OTHER},
        /* k2                */ {LAST,  NIL,    OF, K,      NIL,  NIL,  LONE, DONE, HIGH, K2,   OTHER},
        /* r12               */ {PORT,  I_R12,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R12,  OTHER},
        /* n3                */ {PORT,  I_PC,   OF, NE,     CE,   PSI,  SUB,  DONE, HIGH, N3,   OTHER},
        /* k1 z + k2 x       */ {REG,   K1,     OF, PZ,     K2,   XX,   ADD,  DONE, HIGH, MA,   FOLD},
        /* k1 x - k2 z       */ {REG,   K1,     OF, XX,     K2,   PZ,   SUB,  DONE, HIGH, MB,   MORE},
        /* c3                */ {PORT,  I_PC,   OF, CE,     NE,   PSI,  ADD,  DONE, HIGH, C3,   OTHER},
        /* MA up             */ {REG,   MA,     BY, POWER,  NIL,  NIL,  LONE, DONE, LOW,  MAU,  OTHER},
        /* MB up             */ {REG,   MB,     BY, POWER,  NIL,  NIL,  LONE, DONE, LOW,  MBU,  OTHER},
        /* -r33              */ {PORT,  I_R33,  BY, MINUS,  NIL,  NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
        /* cross 3           */ {REG,   R11,    OF, R22,    R21,  R12,  SUB,  DONE, HIGH, NIL,  CHECK},
        /* qd                */ {REG,   MAU,    OF, MAU,    MBU,  MBU,  ADD,  DONE, HIGH, NIL,  ROOT},
        /* m23               */ {REG,   C1,     OF, R23,    N1,   R13,  SUB,  DONE, HIGH, M23,  FOLD | WRIST},
        /* r31               */ {PORT,  I_R31,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R31,  OTHER},
        /* 1 / root          */ {TABLE, NIL,    BY, SLOPE,  NIL,  NIL,  LONE, DONE, MID,  Gd,   OTHER},
        /* c2                */ {LAST,  NIL,    OF, MAU,    NIL,  NIL,  LONE, DONE, HIGH, C2,   HOLD},
        /* r32               */ {PORT,  I_R32,  BY, PLUS,   NIL,  NIL,  LONE, DONE, HIGH, R32,  OTHER},
        /* n2                */ {REG,   Gd,     OF, MBU,    NIL,  NIL,  LONE, DONE, HIGH, N2,   HOLD},
        /* -r23              */ {PORT,  I_R23,  BY, MINUS,  NIL,  NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
        /* cross 2           */ {REG,   R31,    OF, R12,    R11,  R32,  SUB,  DONE, HIGH, NIL,  CHECK},
        /* n23               */ {REG,   N2,     OF, C3,     C2,   N3,   ADD,  DONE, HIGH, N23,  OTHER},
        /* c23               */ {REG,   C2,     OF, C3,     N2,   N3,   SUB,  DONE, HIGH, C23,  OTHER},
        /* -r13              */ {PORT,  I_R13,  BY, MINUS,  NIL,  NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
        /* cross 1           */ {REG,   R21,    OF, R32,    R31,  R22,  SUB,  DONE, HIGH, NIL,  CHECK},
        /* m13               */ {REG,   C23,    OF, U3,     N23,  R33,  SUB,  DONE, HIGH, M13,  MORE | WRIST},
        /* r11 r12 + r21 r22 */ {REG,   R11,    OF, R12,    R21,  R22,  ADD,  KEEP, HIGH, NIL,  OTHER},
        /* skew              */ {REG,   R31,    OF, R32,    NIL,  NIL,  LONE, DONE, HIGH, NIL,  CHECK},
        /* M23 up            */ {REG,   M23,    BY, POWER,  NIL,  NIL,  LONE, DONE, LOW,  M23U, OTHER},
        /* M13 up            */ {REG,   M13,    BY, POWER,  NIL,  NIL,  LONE, DONE, LOW,  M13U, OTHER},
        /* r11^2 - 1         */ {PORT,  I_UNIT, BY, MINUS,  R11,  R11,  ADD,  KEEP, HIGH, NIL,  OTHER},
        /* column 1          */ {REG,   R21,    OF, R21,    R31,  R31,  ADD,  DONE, HIGH, NIL,  CHECK},
        /* qe                */ {REG,   M13U,   OF, M13U,   M23U, M23U, ADD,  DONE, HIGH, NIL,  ROOT},
        /* r12^2 - 1         */ {PORT,  I_UNIT, BY, MINUS,  R12,  R12,  ADD,  KEEP, HIGH, NIL,  OTHER},
        /* column 2          */ {REG,   R22,    OF, R22,    R32,  R32,  ADD,  DONE, HIGH, NIL,  CHECK},
        /* 1 / root          */ {TABLE, NIL,    BY, FLIP,   NIL,  NIL,  LONE, DONE, MID,  Ge,   OTHER},
        /* n4                */ {LAST,  NIL,    OF, M23U,   NIL,  NIL,  LONE, DONE, HIGH, N4,   HOLD},
        /*                   */ {PORT,  NIL,    BY, NOUGHT, NIL,  NIL,  LONE, DONE, HIGH, NIL,  OTHER},
        /* c4                */ {REG,   Ge,     OF, M13U,   NIL,  NIL,  LONE, DONE, HIGH, C4,   HOLD},
        /* -n4 c23           */ {PORT,  I_UNIT, BY, NOUGHT, N4,   C23,  SUB,  DONE, HIGH, T4,   OTHER},
        /* c5                */ {REG,   N23,    OF, U3,     C23,  R33,  ADD,  DONE, HIGH, C5,   OTHER},
        /* w3                */ {REG,   N4,     OF, N23,    NIL,  NIL,  LONE, DONE, HIGH, W3,   OTHER},
        /* w1                */ {REG,   T4,     OF, C1,     C4,   N1,   SUB,  DONE, HIGH, W1,   OTHER},
        /* w2                */ {REG,   T4,     OF, N1,     C4,   C1,   ADD,  DONE, HIGH, W2,   OTHER},
        /* n5                */ {REG,   C4,     OF, M13,    N4,   M23,  ADD,  DONE, HIGH, N5,   OTHER},
        /* n6, one of 3      */ {REG,   W3,     OF, R31,    NIL,  NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
        /* n6                */ {REG,   W1,     OF, R11,    W2,   R21,  ADD,  DONE, HIGH, N6,   OTHER},
        /* c6, one of 3      */ {REG,   W3,     OF, R32,    NIL,  NIL,  LONE, KEEP, HIGH, NIL,  OTHER},
        /* c6                */ {REG,   W1,     OF, R12,    W2,   R22,  ADD,  DONE, HIGH, C6,   OTHER}};
    engine_program #(.LINES(90), .BITS(47), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
endmodule
`default_nettype wire
