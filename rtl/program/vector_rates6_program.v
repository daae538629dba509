// SPDX-License-Identifier: Apache-2.0
// Assembled from vector_rates6.kin and vector_rates6.order by `quadrance assemble`; do not edit.
//   Rates of six joints from the tip's velocity and turn: ortho-parallel base, spherical wrist
// Line: word = A * B [+- C * D], DEST, and what else is done with it; one line a clock. I_ begins the name of an input;
// a word of capitals and a small letter is one that the assembler has added. Latency of a core that plays it: 87.
// For product_engine with PIPE = 0. Model: quadrance.program.meaning
`default_nettype none
module vector_rates6_program (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    output wire        out_idle,
    output wire        out_done,
    output wire [46:0] out_op
);
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2, TABLE = 2'd3;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36, SLOPE = 6'd0, NOUGHT = 6'd4, POWER = 6'd1;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [1:0] HIGH = 2'd0, LOW = 2'd1, MID = 2'd2;
    localparam [8:0] OTHER = 9'd0, FOLD = 9'd1, ROOT = 9'd16, FAR = 9'd64, CLAMP = 9'd128;
    localparam [5:0]
        D5 = 6'd2, Q1 = 6'd3, Q2 = 6'd4, Q3 = 6'd5, Q4 = 6'd6, Q5 = 6'd7, Q6 = 6'd8, D1 = 6'd9, D3 = 6'd10,
        MM = 6'd11, N3 = 6'd11, WT = 6'd11, WY = 6'd11, C3 = 6'd12, GZ = 6'd12, M1 = 6'd12, PR = 6'd12,
        Q3c = 6'd12, Q3n = 6'd12, Q3w = 6'd12, QR = 6'd12, N2 = 6'd13, Q2g = 6'd13, Q2i = 6'd13, Q6g = 6'd13,
        Q6i = 6'd13, XX = 6'd13, L2 = 6'd14, M3 = 6'd14, Q6s = 6'd14, Q6x = 6'd14, ZZ = 6'd14, C2 = 6'd15,
        Q6c = 6'd15, WW = 6'd15, N23 = 6'd16, A2 = 6'd17, Q2c = 6'd17, Q6n = 6'd17, Q6w = 6'd17, ZF = 6'd17,
        C23 = 6'd18, N5 = 6'd19, Q2s = 6'd19, C5 = 6'd20, Q2n = 6'd21, Q2w = 6'd21, XF = 6'd21, GT = 6'd22,
        L5 = 6'd22, PZ = 6'd22, F3 = 6'd23, Q1g = 6'd23, Q1i = 6'd23, VY = 6'd24, VX = 6'd25, N1 = 6'd26,
        F1 = 6'd27, WR = 6'd27, GR = 6'd28, Q1c = 6'd29, Q1n = 6'd29, Q1w = 6'd29, WX = 6'd29, Q1s = 6'd30,
        Q1x = 6'd30, Q2x = 6'd30, WZ = 6'd31, DET = 6'd32, N4 = 6'd33, B = 6'd34;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_VX = 6'd10, I_VY = 6'd11, I_VZ = 6'd12, I_WX = 6'd13, I_WY = 6'd14,
        I_WZ = 6'd15, I_A1 = 6'd16, I_A2 = 6'd17, I_B = 6'd18, I_L2 = 6'd19, I_L3 = 6'd20, I_L4 = 6'd21,
        I_ONE = 6'd22;
    localparam [83*47-1:0] LINES = {
    /* n3                       */ {PORT,  I_N3,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, N3,  OTHER},
    /* c3                       */ {PORT,  I_C3,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, C3,  OTHER},
    /* n2                       */ {PORT,  I_N2,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, N2,  OTHER},
    /* l2                       */ {PORT,  I_L2,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, L2,  OTHER},
    /* c2                       */ {PORT,  I_C2,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, C2,  OTHER},
    /* n23 = n2*c3 + c2*n3      */ {LAST,  NIL,   OF, N3,     N2,  C3,  ADD,  DONE, HIGH, N23, OTHER},
    /* a2                       */ {PORT,  I_A2,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, A2,  OTHER},
    /* c23 = c2*c3 - n2*n3      */ {REG,   C2,    OF, C3,     N2,  N3,  SUB,  DONE, HIGH, C23, OTHER},
    /* n5                       */ {PORT,  I_N5,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, N5,  OTHER},
    /* c5                       */ {PORT,  I_C5,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, C5,  OTHER},
    /* xf = l3*n23 + a2*c23     */ {PORT,  I_L3,  OF, N23,    A2,  C23, ADD,  DONE, HIGH, XF,  OTHER},
    /* xx = xf + l2*n2          */ {LAST,  NIL,   BY, PLUS,   L2,  N2,  ADD,  DONE, HIGH, XX,  OTHER},
    /* l5 = l4*n5               */ {PORT,  I_L4,  OF, N5,     NIL, NIL, LONE, DONE, HIGH, L5,  OTHER},
    /* f3 = l4*c5               */ {PORT,  I_L4,  OF, C5,     NIL, NIL, LONE, DONE, HIGH, F3,  OTHER},
    /* d1: xx                   */ {REG,   XX,    BY, PLUS,   NIL, NIL, LONE, KEEP, HIGH, NIL, OTHER},
    /* d1 = .. + a1             */ {PORT,  I_A1,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, D1,  FOLD},
    /* vy                       */ {PORT,  I_VY,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, VY,  OTHER},
    /* vx                       */ {PORT,  I_VX,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, VX,  OTHER},
    /* n1                       */ {PORT,  I_N1,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, N1,  OTHER},
    /* f1 = l5*c4               */ {PORT,  I_C4,  OF, L5,     NIL, NIL, LONE, DONE, HIGH, F1,  OTHER},
    /* gr = c23*f1 + n23*f3     */ {LAST,  NIL,   OF, C23,    N23, F3,  ADD,  DONE, HIGH, GR,  OTHER},
    /* wx                       */ {PORT,  I_WX,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, WX,  OTHER},
    /* Q1x = d1 2^s             */ {REG,   D1,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  Q1x, OTHER},
    /* wz                       */ {PORT,  I_WZ,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, WZ,  OTHER},
    /* d3 = l3*n3 + a2*c3       */ {PORT,  I_L3,  OF, N3,     A2,  C3,  ADD,  DONE, HIGH, D3,  OTHER},
    /* Q1x^2                    */ {REG,   Q1x,   OF, Q1x,    NIL, NIL, LONE, DONE, HIGH, NIL, ROOT},
    /* wy                       */ {PORT,  I_WY,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, WY,  OTHER},
    /* gz = c23*f3 - n23*f1     */ {REG,   C23,   OF, F3,     N23, F1,  SUB,  DONE, HIGH, GZ,  OTHER},
    /* Q1g = 1 / root           */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL, LONE, DONE, MID,  Q1g, OTHER},
    /* wr = c1*wx + n1*wy       */ {PORT,  I_C1,  OF, WX,     N1,  WY,  ADD,  DONE, HIGH, WR,  OTHER},
    /* wt = c1*wy - n1*wx       */ {PORT,  I_C1,  OF, WY,     N1,  WX,  SUB,  DONE, HIGH, WT,  OTHER},
    /* Q1n: c1*vy - n1*vx       */ {PORT,  I_C1,  OF, VY,     N1,  VX,  SUB,  KEEP, HIGH, NIL, OTHER},
    /* Q1n = .. + wr*gz - wz*gr */ {REG,   WR,    OF, GZ,     WZ,  GR,  SUB,  DONE, HIGH, Q1n, FAR},
    /* Q1w = Q1n 2^s            */ {LAST,  NIL,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  Q1w, FAR},
    /* det = l2*d3              */ {REG,   L2,    OF, D3,     NIL, NIL, LONE, DONE, HIGH, DET, FOLD},
    /* Q1s = Q1g * Q1x          */ {REG,   Q1g,   OF, Q1x,    NIL, NIL, LONE, DONE, HIGH, Q1s, OTHER},
    /* Q1c = limit Q1w          */ {REG,   Q1w,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, Q1c, CLAMP},
    /* n4                       */ {PORT,  I_N4,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, N4,  OTHER},
    /* b                        */ {PORT,  I_B,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, B,   OTHER},
    /* Q1i = Q1s * Q1g          */ {REG,   Q1s,   OF, Q1g,    NIL, NIL, LONE, DONE, HIGH, Q1i, OTHER},
    /* gt = l5*n4               */ {REG,   N4,    OF, L5,     NIL, NIL, LONE, DONE, HIGH, GT,  OTHER},
    /* Q2x = det 2^s            */ {REG,   DET,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  Q2x, OTHER},
    /* q1 = Q1i * Q1c           */ {REG,   Q1i,   OF, Q1c,    NIL, NIL, LONE, DONE, HIGH, Q1,  OTHER},
    /* pr: c1*vx - wt*gz        */ {PORT,  I_C1,  OF, VX,     WT,  GZ,  SUB,  KEEP, HIGH, NIL, OTHER},
    /* pr = .. + n1*vy + wz*gt  */ {REG,   N1,    OF, VY,     WZ,  GT,  ADD,  DONE, HIGH, PR,  OTHER},
    /* zf = l3*c23 - a2*n23     */ {PORT,  I_L3,  OF, C23,    A2,  N23, SUB,  DONE, HIGH, ZF,  OTHER},
    /* pz: vz - wr*gt           */ {PORT,  I_VZ,  BY, PLUS,   WR,  GT,  SUB,  KEEP, HIGH, NIL, OTHER},
    /* pz = .. + wt*gr          */ {REG,   WT,    OF, GR,     NIL, NIL, LONE, DONE, HIGH, PZ,  OTHER},
    /* Q2x^2                    */ {REG,   Q2x,   OF, Q2x,    NIL, NIL, LONE, DONE, HIGH, NIL, ROOT},
    /* qr = pr + b*q1           */ {REG,   PR,    BY, PLUS,   B,   Q1,  ADD,  DONE, HIGH, QR,  OTHER},
    /* Q2n = xf*qr + zf*pz      */ {LAST,  NIL,   OF, XF,     ZF,  PZ,  ADD,  DONE, HIGH, Q2n, FAR},
    /* Q2w = Q2n 2^s            */ {LAST,  NIL,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  Q2w, FAR},
    /* zz = zf + l2*c2          */ {REG,   ZF,    BY, PLUS,   L2,  C2,  ADD,  DONE, HIGH, ZZ,  OTHER},
    /* ww: wz                   */ {PORT,  I_WZ,  BY, PLUS,   NIL, NIL, LONE, KEEP, HIGH, NIL, OTHER},
    /* ww = .. - q1             */ {REG,   Q1,    BY, MINUS,  NIL, NIL, LONE, DONE, HIGH, WW,  OTHER},
    /* Q2c = limit Q2w          */ {REG,   Q2w,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, Q2c, CLAMP},
    /* Q3n: -xx*qr              */ {PORT,  I_ONE, BY, NOUGHT, XX,  QR,  SUB,  KEEP, HIGH, NIL, OTHER},
    /* Q3n = .. - zz*pz         */ {PORT,  I_ONE, BY, NOUGHT, ZZ,  PZ,  SUB,  DONE, HIGH, Q3n, FAR},
    /* Q3w = Q3n 2^s            */ {LAST,  NIL,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  Q3w, FAR},
    /* d5 = one*n5              */ {PORT,  I_ONE, OF, N5,     NIL, NIL, LONE, DONE, HIGH, D5,  FOLD},
    /* Q2g = 1 / root           */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL, LONE, DONE, MID,  Q2g, OTHER},
    /* Q3c = limit Q3w          */ {REG,   Q3w,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, Q3c, CLAMP},
    /* Q6x = d5 2^s             */ {REG,   D5,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  Q6x, OTHER},
    /* Q2s = Q2g * Q2x          */ {REG,   Q2g,   OF, Q2x,    NIL, NIL, LONE, DONE, HIGH, Q2s, OTHER},
    /* Q2i = Q2s * Q2g          */ {LAST,  NIL,   OF, Q2g,    NIL, NIL, LONE, DONE, HIGH, Q2i, OTHER},
    /* q2 = Q2i * Q2c           */ {LAST,  NIL,   OF, Q2c,    NIL, NIL, LONE, DONE, HIGH, Q2,  OTHER},
    /* Q6x^2                    */ {REG,   Q6x,   OF, Q6x,    NIL, NIL, LONE, DONE, HIGH, NIL, ROOT},
    /* q3 = Q2i * Q3c           */ {REG,   Q2i,   OF, Q3c,    NIL, NIL, LONE, DONE, HIGH, Q3,  OTHER},
    /* mm: wt                   */ {REG,   WT,    BY, PLUS,   NIL, NIL, LONE, KEEP, HIGH, NIL, OTHER},
    /* mm .. - q2               */ {REG,   Q2,    BY, MINUS,  NIL, NIL, LONE, KEEP, HIGH, NIL, OTHER},
    /* mm = .. - q3             */ {REG,   Q3,    BY, MINUS,  NIL, NIL, LONE, DONE, HIGH, MM,  OTHER},
    /* m1 = c23*wr - n23*ww     */ {REG,   C23,   OF, WR,     N23, WW,  SUB,  DONE, HIGH, M1,  OTHER},
    /* Q6g = 1 / root           */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL, LONE, DONE, MID,  Q6g, OTHER},
    /* Q6s = Q6g * Q6x          */ {LAST,  NIL,   OF, Q6x,    NIL, NIL, LONE, DONE, HIGH, Q6s, OTHER},
    /* Q6n = c4*m1 + n4*mm      */ {PORT,  I_C4,  OF, M1,     N4,  MM,  ADD,  DONE, HIGH, Q6n, FAR},
    /* Q6w = Q6n 2^s            */ {LAST,  NIL,   BY, POWER,  NIL, NIL, LONE, DONE, LOW,  Q6w, FAR},
    /* Q6i = Q6s * Q6g          */ {REG,   Q6s,   OF, Q6g,    NIL, NIL, LONE, DONE, HIGH, Q6i, OTHER},
    /* m3 = n23*wr + c23*ww     */ {REG,   N23,   OF, WR,     C23, WW,  ADD,  DONE, HIGH, M3,  OTHER},
    /* Q6c = limit Q6w          */ {REG,   Q6w,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, Q6c, CLAMP},
    /* q6 = Q6i * Q6c           */ {LAST,  NIL,   OF, Q6i,    NIL, NIL, LONE, DONE, HIGH, Q6,  OTHER},
    /* q5 = c4*mm - n4*m1       */ {PORT,  I_C4,  OF, MM,     N4,  M1,  SUB,  DONE, HIGH, Q5,  OTHER},
    /*                          */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
    /* q4 = m3 - c5*q6          */ {REG,   M3,    BY, PLUS,   C5,  Q6,  SUB,  DONE, HIGH, Q4,  OTHER}};
    engine_program #(.LINES(83), .BITS(47), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
endmodule
`default_nettype wire
