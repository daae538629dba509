// SPDX-License-Identifier: Apache-2.0
// Assembled from vector_velocity6.kin by `quadrance assemble`; do not edit.
//   The tip's velocity and turn from the rates of six joints: ortho-parallel base, spherical wrist
// Line: word = A * B [+- C * D], DEST, and what else is done with it; one line a clock. I_ begins the name of an input;
// a word of capitals and a small letter is one that the assembler has added.
// Latency of a core that plays it: 56 at PIPE 0, 57 at PIPE 1, 59 at PIPE 2. Model: quadrance.program.meaning
`default_nettype none
module vector_velocity6_program #(
    parameter PIPE = 0  // registers behind the products of product_engine: 0 or 1 or 2 (default 0)
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    output wire        out_idle,
    output wire        out_done,
    output wire [46:0] out_op
);
    generate
    if (PIPE == 0) begin : g_pipe0
    localparam [1:0] REG = 2'd0, PORT = 2'd1;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, NOUGHT = 6'd4;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        VX = 6'd2, VY = 6'd3, VZ = 6'd4, WX = 6'd5, WY = 6'd6, WZ = 6'd7, C4 = 6'd8, MM = 6'd8, WT = 6'd8,
        C23 = 6'd9, C3 = 6'd9, WR = 6'd9, N2 = 6'd10, XX = 6'd10, M1 = 6'd11, N3 = 6'd11, Q2 = 6'd11,
        C2 = 6'd12, VR = 6'd12, ZZ = 6'd12, F2 = 6'd13, N4 = 6'd13, VT = 6'd13, X1 = 6'd13, Q3 = 6'd14,
        Q5 = 6'd14, GR = 6'd15, N23 = 6'd15, AR = 6'd16, F1 = 6'd16, N1 = 6'd16, Q6 = 6'd17, A2 = 6'd18,
        ZF = 6'd18, C5 = 6'd19, GT = 6'd19, L2 = 6'd20, AZ = 6'd21, GZ = 6'd21, B = 6'd22, Q1 = 6'd23,
        XF = 6'd24, M3 = 6'd25;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_Q1 = 6'd10, I_Q2 = 6'd11, I_Q3 = 6'd12, I_Q4 = 6'd13, I_Q5 = 6'd14,
        I_Q6 = 6'd15, I_A1 = 6'd16, I_A2 = 6'd17, I_B = 6'd18, I_L2 = 6'd19, I_L3 = 6'd20, I_L4 = 6'd21,
        I_ONE = 6'd22;
    localparam [52*36-1:0] LINES = {
    /* c4                    */ {PORT, I_C4,  BY, PLUS,   NIL, NIL, LONE, DONE, C4},
    /* c3                    */ {PORT, I_C3,  BY, PLUS,   NIL, NIL, LONE, DONE, C3},
    /* n2                    */ {PORT, I_N2,  BY, PLUS,   NIL, NIL, LONE, DONE, N2},
    /* n3                    */ {PORT, I_N3,  BY, PLUS,   NIL, NIL, LONE, DONE, N3},
    /* c2                    */ {PORT, I_C2,  BY, PLUS,   NIL, NIL, LONE, DONE, C2},
    /* n4                    */ {PORT, I_N4,  BY, PLUS,   NIL, NIL, LONE, DONE, N4},
    /* q5                    */ {PORT, I_Q5,  BY, PLUS,   NIL, NIL, LONE, DONE, Q5},
    /* n23 = n2*c3 + c2*n3   */ {REG,  N2,    OF, C3,     C2,  N3,  ADD,  DONE, N23},
    /* f1 = n5*c4            */ {PORT, I_N5,  OF, C4,     NIL, NIL, LONE, DONE, F1},
    /* q6                    */ {PORT, I_Q6,  BY, PLUS,   NIL, NIL, LONE, DONE, Q6},
    /* a2                    */ {PORT, I_A2,  BY, PLUS,   NIL, NIL, LONE, DONE, A2},
    /* c5                    */ {PORT, I_C5,  BY, PLUS,   NIL, NIL, LONE, DONE, C5},
    /* c23 = c2*c3 - n2*n3   */ {REG,  C2,    OF, C3,     N2,  N3,  SUB,  DONE, C23},
    /* m1 = f1*q6 - n4*q5    */ {REG,  Q6,    OF, F1,     N4,  Q5,  SUB,  DONE, M1},
    /* l2                    */ {PORT, I_L2,  BY, PLUS,   NIL, NIL, LONE, DONE, L2},
    /* f2 = n5*n4            */ {PORT, I_N5,  OF, N4,     NIL, NIL, LONE, DONE, F2},
    /* az = c23*c5 - n23*f1  */ {REG,  C5,    OF, C23,    N23, F1,  SUB,  DONE, AZ},
    /* b                     */ {PORT, I_B,   BY, PLUS,   NIL, NIL, LONE, DONE, B},
    /* q1                    */ {PORT, I_Q1,  BY, PLUS,   NIL, NIL, LONE, DONE, Q1},
    /* xf = l3*n23 + a2*c23  */ {PORT, I_L3,  OF, N23,    A2,  C23, ADD,  DONE, XF},
    /* m3 = q4 + c5*q6       */ {PORT, I_Q4,  BY, PLUS,   C5,  Q6,  ADD,  DONE, M3},
    /* zf = l3*c23 - a2*n23  */ {PORT, I_L3,  OF, C23,    A2,  N23, SUB,  DONE, ZF},
    /* wz: q1 - n23*m1       */ {PORT, I_Q1,  BY, PLUS,   N23, M1,  SUB,  KEEP, NIL},
    /* wz = .. + c23*m3      */ {REG,  C23,   OF, M3,     NIL, NIL, LONE, DONE, WZ},
    /* xx = xf + l2*n2       */ {REG,  XF,    BY, PLUS,   L2,  N2,  ADD,  DONE, XX},
    /* ar = c23*f1 + n23*c5  */ {REG,  C23,   OF, F1,     N23, C5,  ADD,  DONE, AR},
    /* gt = l4*f2            */ {PORT, I_L4,  OF, F2,     NIL, NIL, LONE, DONE, GT},
    /* gz = l4*az            */ {PORT, I_L4,  OF, AZ,     NIL, NIL, LONE, DONE, GZ},
    /* mm = f2*q6 + c4*q5    */ {REG,  Q6,    OF, F2,     C4,  Q5,  ADD,  DONE, MM},
    /* wr = c23*m1 + n23*m3  */ {REG,  C23,   OF, M1,     N23, M3,  ADD,  DONE, WR},
    /* q2                    */ {PORT, I_Q2,  BY, PLUS,   NIL, NIL, LONE, DONE, Q2},
    /* zz = zf + l2*c2       */ {REG,  ZF,    BY, PLUS,   L2,  C2,  ADD,  DONE, ZZ},
    /* x1: xx                */ {REG,  XX,    BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* x1 = .. + a1          */ {PORT, I_A1,  BY, PLUS,   NIL, NIL, LONE, DONE, X1},
    /* wt: mm                */ {REG,  MM,    BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* wt .. + q2            */ {PORT, I_Q2,  BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* wt = .. + q3          */ {PORT, I_Q3,  BY, PLUS,   NIL, NIL, LONE, DONE, WT},
    /* q3                    */ {PORT, I_Q3,  BY, PLUS,   NIL, NIL, LONE, DONE, Q3},
    /* gr = l4*ar            */ {PORT, I_L4,  OF, AR,     NIL, NIL, LONE, DONE, GR},
    /* vr: zz*q2 - b*q1      */ {REG,  Q2,    OF, ZZ,     B,   Q1,  SUB,  KEEP, NIL},
    /* vr .. + zf*q3 - wz*gt */ {REG,  Q3,    OF, ZF,     WZ,  GT,  SUB,  KEEP, NIL},
    /* vr = .. + wt*gz       */ {REG,  WT,    OF, GZ,     NIL, NIL, LONE, DONE, VR},
    /* vt: x1*q1 - wr*gz     */ {REG,  Q1,    OF, X1,     WR,  GZ,  SUB,  KEEP, NIL},
    /* vt = .. + wz*gr       */ {REG,  WZ,    OF, GR,     NIL, NIL, LONE, DONE, VT},
    /* n1                    */ {PORT, I_N1,  BY, PLUS,   NIL, NIL, LONE, DONE, N1},
    /* vz: wr*gt - xx*q2     */ {REG,  WR,    OF, GT,     XX,  Q2,  SUB,  KEEP, NIL},
    /* vz .. - xf*q3         */ {PORT, I_ONE, BY, NOUGHT, XF,  Q3,  SUB,  KEEP, NIL},
    /* vz = .. - wt*gr       */ {PORT, I_ONE, BY, NOUGHT, WT,  GR,  SUB,  DONE, VZ},
    /* vx = c1*vr - n1*vt    */ {PORT, I_C1,  OF, VR,     N1,  VT,  SUB,  DONE, VX},
    /* vy = c1*vt + n1*vr    */ {PORT, I_C1,  OF, VT,     N1,  VR,  ADD,  DONE, VY},
    /* wx = c1*wr - n1*wt    */ {PORT, I_C1,  OF, WR,     N1,  WT,  SUB,  DONE, WX},
    /* wy = c1*wt + n1*wr    */ {PORT, I_C1,  OF, WT,     N1,  WR,  ADD,  DONE, WY}};
    wire [35:0] op;
    engine_program #(.LINES(52), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE == 1) begin : g_pipe1
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, NOUGHT = 6'd4;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        VX = 6'd2, VY = 6'd3, VZ = 6'd4, WX = 6'd5, WY = 6'd6, WZ = 6'd7, C4 = 6'd8, MM = 6'd8, WT = 6'd8,
        C23 = 6'd9, C3 = 6'd9, VR = 6'd9, ZF = 6'd9, N2 = 6'd10, XX = 6'd10, A2 = 6'd11, N3 = 6'd11, Q2 = 6'd11,
        C2 = 6'd12, GR = 6'd12, ZZ = 6'd12, F2 = 6'd13, N4 = 6'd13, VT = 6'd13, X1 = 6'd13, Q3 = 6'd14,
        Q5 = 6'd14, AR = 6'd15, F1 = 6'd15, N1 = 6'd15, N23 = 6'd16, Q6 = 6'd17, C5 = 6'd18, GT = 6'd18,
        M1 = 6'd19, WR = 6'd19, AZ = 6'd20, GZ = 6'd20, L2 = 6'd21, B = 6'd22, Q1 = 6'd23, M3 = 6'd24,
        XF = 6'd25;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_Q1 = 6'd10, I_Q2 = 6'd11, I_Q3 = 6'd12, I_Q4 = 6'd13, I_Q5 = 6'd14,
        I_Q6 = 6'd15, I_A1 = 6'd16, I_A2 = 6'd17, I_B = 6'd18, I_L2 = 6'd19, I_L3 = 6'd20, I_L4 = 6'd21,
        I_ONE = 6'd22;
    localparam [52*36-1:0] LINES = {
    /* c4                    */ {PORT, I_C4,  BY, PLUS,   NIL, NIL, LONE, DONE, C4},
    /* c3                    */ {PORT, I_C3,  BY, PLUS,   NIL, NIL, LONE, DONE, C3},
    /* n2                    */ {PORT, I_N2,  BY, PLUS,   NIL, NIL, LONE, DONE, N2},
    /* n3                    */ {PORT, I_N3,  BY, PLUS,   NIL, NIL, LONE, DONE, N3},
    /* c2                    */ {PORT, I_C2,  BY, PLUS,   NIL, NIL, LONE, DONE, C2},
    /* n4                    */ {PORT, I_N4,  BY, PLUS,   NIL, NIL, LONE, DONE, N4},
    /* q5                    */ {PORT, I_Q5,  BY, PLUS,   NIL, NIL, LONE, DONE, Q5},
    /* f1 = n5*c4            */ {PORT, I_N5,  OF, C4,     NIL, NIL, LONE, DONE, F1},
    /* n23 = n2*c3 + c2*n3   */ {REG,  N2,    OF, C3,     C2,  N3,  ADD,  DONE, N23},
    /* q6                    */ {PORT, I_Q6,  BY, PLUS,   NIL, NIL, LONE, DONE, Q6},
    /* c5                    */ {PORT, I_C5,  BY, PLUS,   NIL, NIL, LONE, DONE, C5},
    /* c23 = c2*c3 - n2*n3   */ {REG,  C2,    OF, C3,     N2,  N3,  SUB,  DONE, C23},
    /* a2                    */ {PORT, I_A2,  BY, PLUS,   NIL, NIL, LONE, DONE, A2},
    /* m1 = f1*q6 - n4*q5    */ {REG,  Q6,    OF, F1,     N4,  Q5,  SUB,  DONE, M1},
    /* f2 = n5*n4            */ {PORT, I_N5,  OF, N4,     NIL, NIL, LONE, DONE, F2},
    /* az = c23*c5 - n23*f1  */ {REG,  C5,    OF, C23,    N23, F1,  SUB,  DONE, AZ},
    /* l2                    */ {PORT, I_L2,  BY, PLUS,   NIL, NIL, LONE, DONE, L2},
    /* b                     */ {PORT, I_B,   BY, PLUS,   NIL, NIL, LONE, DONE, B},
    /* q1                    */ {PORT, I_Q1,  BY, PLUS,   NIL, NIL, LONE, DONE, Q1},
    /* m3 = q4 + c5*q6       */ {PORT, I_Q4,  BY, PLUS,   C5,  Q6,  ADD,  DONE, M3},
    /* wz: q1 - n23*m1       */ {PORT, I_Q1,  BY, PLUS,   N23, M1,  SUB,  KEEP, NIL},
    /* wz = .. + c23*m3      */ {LAST, NIL,   OF, C23,    NIL, NIL, LONE, DONE, WZ},
    /* xf = l3*n23 + a2*c23  */ {PORT, I_L3,  OF, N23,    A2,  C23, ADD,  DONE, XF},
    /* ar = c23*f1 + n23*c5  */ {REG,  C23,   OF, F1,     N23, C5,  ADD,  DONE, AR},
    /* gt = l4*f2            */ {PORT, I_L4,  OF, F2,     NIL, NIL, LONE, DONE, GT},
    /* gz = l4*az            */ {PORT, I_L4,  OF, AZ,     NIL, NIL, LONE, DONE, GZ},
    /* wr = c23*m1 + n23*m3  */ {REG,  C23,   OF, M1,     N23, M3,  ADD,  DONE, WR},
    /* zf = l3*c23 - a2*n23  */ {PORT, I_L3,  OF, C23,    A2,  N23, SUB,  DONE, ZF},
    /* xx = xf + l2*n2       */ {REG,  XF,    BY, PLUS,   L2,  N2,  ADD,  DONE, XX},
    /* mm = f2*q6 + c4*q5    */ {REG,  Q6,    OF, F2,     C4,  Q5,  ADD,  DONE, MM},
    /* q2                    */ {PORT, I_Q2,  BY, PLUS,   NIL, NIL, LONE, DONE, Q2},
    /* zz = zf + l2*c2       */ {REG,  ZF,    BY, PLUS,   L2,  C2,  ADD,  DONE, ZZ},
    /* x1: xx                */ {REG,  XX,    BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* x1 = .. + a1          */ {PORT, I_A1,  BY, PLUS,   NIL, NIL, LONE, DONE, X1},
    /* wt: mm                */ {REG,  MM,    BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* wt .. + q2            */ {PORT, I_Q2,  BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* wt = .. + q3          */ {PORT, I_Q3,  BY, PLUS,   NIL, NIL, LONE, DONE, WT},
    /* q3                    */ {PORT, I_Q3,  BY, PLUS,   NIL, NIL, LONE, DONE, Q3},
    /* vr: zz*q2 - b*q1      */ {REG,  Q2,    OF, ZZ,     B,   Q1,  SUB,  KEEP, NIL},
    /* vr .. + zf*q3 - wz*gt */ {LAST, NIL,   OF, ZF,     WZ,  GT,  SUB,  KEEP, NIL},
    /* vr = .. + wt*gz       */ {REG,  WT,    OF, GZ,     NIL, NIL, LONE, DONE, VR},
    /* gr = l4*ar            */ {PORT, I_L4,  OF, AR,     NIL, NIL, LONE, DONE, GR},
    /* vt: x1*q1 - wr*gz     */ {REG,  Q1,    OF, X1,     WR,  GZ,  SUB,  KEEP, NIL},
    /* vt = .. + wz*gr       */ {LAST, NIL,   OF, WZ,     NIL, NIL, LONE, DONE, VT},
    /* n1                    */ {PORT, I_N1,  BY, PLUS,   NIL, NIL, LONE, DONE, N1},
    /* vz: wr*gt - xx*q2     */ {REG,  WR,    OF, GT,     XX,  Q2,  SUB,  KEEP, NIL},
    /* vz .. - xf*q3         */ {PORT, I_ONE, BY, NOUGHT, XF,  Q3,  SUB,  KEEP, NIL},
    /* vz = .. - wt*gr       */ {PORT, I_ONE, BY, NOUGHT, WT,  GR,  SUB,  DONE, VZ},
    /* vx = c1*vr - n1*vt    */ {PORT, I_C1,  OF, VR,     N1,  VT,  SUB,  DONE, VX},
    /* vy = c1*vt + n1*vr    */ {PORT, I_C1,  OF, VT,     N1,  VR,  ADD,  DONE, VY},
    /* wx = c1*wr - n1*wt    */ {PORT, I_C1,  OF, WR,     N1,  WT,  SUB,  DONE, WX},
    /* wy = c1*wt + n1*wr    */ {PORT, I_C1,  OF, WT,     N1,  WR,  ADD,  DONE, WY}};
    wire [35:0] op;
    engine_program #(.LINES(52), .DRAIN(4), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE == 2) begin : g_pipe2
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, NOUGHT = 6'd4;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        VX = 6'd2, VY = 6'd3, VZ = 6'd4, WX = 6'd5, WY = 6'd6, WZ = 6'd7, C4 = 6'd8, MM = 6'd8, WT = 6'd8,
        C23 = 6'd9, C3 = 6'd9, VR = 6'd9, ZF = 6'd9, N2 = 6'd10, XX = 6'd10, M1 = 6'd11, N3 = 6'd11, WR = 6'd11,
        C2 = 6'd12, VT = 6'd12, ZZ = 6'd12, F2 = 6'd13, N4 = 6'd13, Q2 = 6'd13, N1 = 6'd14, Q5 = 6'd14,
        X1 = 6'd14, N23 = 6'd15, Q3 = 6'd15, AR = 6'd16, F1 = 6'd16, GR = 6'd16, Q6 = 6'd17, C5 = 6'd18,
        GT = 6'd18, A2 = 6'd19, AZ = 6'd20, GZ = 6'd20, L2 = 6'd21, B = 6'd22, Q1 = 6'd23, M3 = 6'd24,
        XF = 6'd25;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_Q1 = 6'd10, I_Q2 = 6'd11, I_Q3 = 6'd12, I_Q4 = 6'd13, I_Q5 = 6'd14,
        I_Q6 = 6'd15, I_A1 = 6'd16, I_A2 = 6'd17, I_B = 6'd18, I_L2 = 6'd19, I_L3 = 6'd20, I_L4 = 6'd21,
        I_ONE = 6'd22;
    localparam [52*36-1:0] LINES = {
    /* c4                    */ {PORT, I_C4,  BY, PLUS,   NIL, NIL, LONE, DONE, C4},
    /* c3                    */ {PORT, I_C3,  BY, PLUS,   NIL, NIL, LONE, DONE, C3},
    /* n2                    */ {PORT, I_N2,  BY, PLUS,   NIL, NIL, LONE, DONE, N2},
    /* n3                    */ {PORT, I_N3,  BY, PLUS,   NIL, NIL, LONE, DONE, N3},
    /* c2                    */ {PORT, I_C2,  BY, PLUS,   NIL, NIL, LONE, DONE, C2},
    /* n4                    */ {PORT, I_N4,  BY, PLUS,   NIL, NIL, LONE, DONE, N4},
    /* q5                    */ {PORT, I_Q5,  BY, PLUS,   NIL, NIL, LONE, DONE, Q5},
    /* n23 = n2*c3 + c2*n3   */ {LAST, NIL,   OF, N3,     N2,  C3,  ADD,  DONE, N23},
    /* f1 = n5*c4            */ {PORT, I_N5,  OF, C4,     NIL, NIL, LONE, DONE, F1},
    /* q6                    */ {PORT, I_Q6,  BY, PLUS,   NIL, NIL, LONE, DONE, Q6},
    /* c5                    */ {PORT, I_C5,  BY, PLUS,   NIL, NIL, LONE, DONE, C5},
    /* c23 = c2*c3 - n2*n3   */ {REG,  C2,    OF, C3,     N2,  N3,  SUB,  DONE, C23},
    /* m1 = f1*q6 - n4*q5    */ {LAST, NIL,   OF, F1,     N4,  Q5,  SUB,  DONE, M1},
    /* a2                    */ {PORT, I_A2,  BY, PLUS,   NIL, NIL, LONE, DONE, A2},
    /* f2 = n5*n4            */ {PORT, I_N5,  OF, N4,     NIL, NIL, LONE, DONE, F2},
    /* az = c23*c5 - n23*f1  */ {REG,  C5,    OF, C23,    N23, F1,  SUB,  DONE, AZ},
    /* l2                    */ {PORT, I_L2,  BY, PLUS,   NIL, NIL, LONE, DONE, L2},
    /* b                     */ {PORT, I_B,   BY, PLUS,   NIL, NIL, LONE, DONE, B},
    /* q1                    */ {PORT, I_Q1,  BY, PLUS,   NIL, NIL, LONE, DONE, Q1},
    /* m3 = q4 + c5*q6       */ {PORT, I_Q4,  BY, PLUS,   C5,  Q6,  ADD,  DONE, M3},
    /* xf = l3*n23 + a2*c23  */ {PORT, I_L3,  OF, N23,    A2,  C23, ADD,  DONE, XF},
    /* wz: q1 - n23*m1       */ {PORT, I_Q1,  BY, PLUS,   N23, M1,  SUB,  KEEP, NIL},
    /* wz = .. + c23*m3      */ {LAST, NIL,   OF, C23,    NIL, NIL, LONE, DONE, WZ},
    /* ar = c23*f1 + n23*c5  */ {REG,  C23,   OF, F1,     N23, C5,  ADD,  DONE, AR},
    /* gt = l4*f2            */ {PORT, I_L4,  OF, F2,     NIL, NIL, LONE, DONE, GT},
    /* gz = l4*az            */ {PORT, I_L4,  OF, AZ,     NIL, NIL, LONE, DONE, GZ},
    /* wr = c23*m1 + n23*m3  */ {REG,  C23,   OF, M1,     N23, M3,  ADD,  DONE, WR},
    /* zf = l3*c23 - a2*n23  */ {PORT, I_L3,  OF, C23,    A2,  N23, SUB,  DONE, ZF},
    /* xx = xf + l2*n2       */ {REG,  XF,    BY, PLUS,   L2,  N2,  ADD,  DONE, XX},
    /* mm = f2*q6 + c4*q5    */ {REG,  Q6,    OF, F2,     C4,  Q5,  ADD,  DONE, MM},
    /* q2                    */ {PORT, I_Q2,  BY, PLUS,   NIL, NIL, LONE, DONE, Q2},
    /* zz = zf + l2*c2       */ {REG,  ZF,    BY, PLUS,   L2,  C2,  ADD,  DONE, ZZ},
    /* x1: xx                */ {REG,  XX,    BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* x1 = .. + a1          */ {PORT, I_A1,  BY, PLUS,   NIL, NIL, LONE, DONE, X1},
    /* wt: mm                */ {REG,  MM,    BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* wt .. + q2            */ {PORT, I_Q2,  BY, PLUS,   NIL, NIL, LONE, KEEP, NIL},
    /* wt = .. + q3          */ {PORT, I_Q3,  BY, PLUS,   NIL, NIL, LONE, DONE, WT},
    /* q3                    */ {PORT, I_Q3,  BY, PLUS,   NIL, NIL, LONE, DONE, Q3},
    /* gr = l4*ar            */ {PORT, I_L4,  OF, AR,     NIL, NIL, LONE, DONE, GR},
    /* vr: zz*q2 - b*q1      */ {REG,  Q2,    OF, ZZ,     B,   Q1,  SUB,  KEEP, NIL},
    /* vr .. + zf*q3 - wz*gt */ {LAST, NIL,   OF, ZF,     WZ,  GT,  SUB,  KEEP, NIL},
    /* vr = .. + wt*gz       */ {REG,  WT,    OF, GZ,     NIL, NIL, LONE, DONE, VR},
    /* vt: x1*q1 - wr*gz     */ {REG,  Q1,    OF, X1,     WR,  GZ,  SUB,  KEEP, NIL},
    /* vt = .. + wz*gr       */ {REG,  WZ,    OF, GR,     NIL, NIL, LONE, DONE, VT},
    /* n1                    */ {PORT, I_N1,  BY, PLUS,   NIL, NIL, LONE, DONE, N1},
    /* vz: wr*gt - xx*q2     */ {REG,  WR,    OF, GT,     XX,  Q2,  SUB,  KEEP, NIL},
    /* vz .. - xf*q3         */ {PORT, I_ONE, BY, NOUGHT, XF,  Q3,  SUB,  KEEP, NIL},
    /* vz = .. - wt*gr       */ {PORT, I_ONE, BY, NOUGHT, WT,  GR,  SUB,  DONE, VZ},
    /* vx = c1*vr - n1*vt    */ {PORT, I_C1,  OF, VR,     N1,  VT,  SUB,  DONE, VX},
    /* vy = c1*vt + n1*vr    */ {PORT, I_C1,  OF, VT,     N1,  VR,  ADD,  DONE, VY},
    /* wx = c1*wr - n1*wt    */ {PORT, I_C1,  OF, WR,     N1,  WT,  SUB,  DONE, WX},
    /* wy = c1*wt + n1*wr    */ {PORT, I_C1,  OF, WT,     N1,  WR,  ADD,  DONE, WY}};
    wire [35:0] op;
    engine_program #(.LINES(52), .DRAIN(6), .REGISTER(1), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE != 0 && PIPE != 1 && PIPE != 2) begin : g_illegal
        vector_velocity6_program_needs_PIPE_0_or_1_or_2 rule ();
    end
    endgenerate
endmodule
`default_nettype wire
