// SPDX-License-Identifier: Apache-2.0
// Assembled from vector_ur_fk.kin by `quadrance assemble`; do not edit.
//   Six unit vectors to the rotation matrix and the tip: axes 2, 3 and 4 are parallel
// Line: word = A * B [+- C * D], DEST, and what else is done with it; one line a clock. I_ begins the name of an input;
// a word of capitals and a small letter is one that the assembler has added.
// Latency of a core that plays it: 45 at PIPE 0, 46 at PIPE 1, 48 at PIPE 2. Model: quadrance.program.meaning
`default_nettype none
module vector_ur_fk_program #(
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
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36, NOUGHT = 6'd4;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        R11 = 6'd2, R12 = 6'd3, R13 = 6'd4, R21 = 6'd5, R22 = 6'd6, R23 = 6'd7, R31 = 6'd8, R32 = 6'd9,
        R33 = 6'd10, X = 6'd11, Y = 6'd12, Z = 6'd13, N2 = 6'd14, N23 = 6'd15, N3 = 6'd15, C3 = 6'd16,
        L2 = 6'd16, C2 = 6'd17, W = 6'd17, CF = 6'd18, N4 = 6'd18, C6 = 6'd19, T = 6'd19, C23 = 6'd20,
        D4 = 6'd20, N6 = 6'd21, C1 = 6'd22, C5 = 6'd23, L3 = 6'd24, NF = 6'd25, D5 = 6'd26, S = 6'd27,
        M5 = 6'd28, N1 = 6'd29, U3 = 6'd30, E1 = 6'd31;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_C6 = 6'd10, I_N6 = 6'd11, I_D1 = 6'd12, I_D4 = 6'd13, I_D5 = 6'd14,
        I_D6 = 6'd15, I_L2 = 6'd16, I_L3 = 6'd17, I_ONE = 6'd18;
    localparam [41*36-1:0] LINES = {
    /* n2                      */ {PORT, I_N2,  BY, PLUS,   NIL, NIL, LONE, DONE, N2},
    /* n3                      */ {PORT, I_N3,  BY, PLUS,   NIL, NIL, LONE, DONE, N3},
    /* c3                      */ {PORT, I_C3,  BY, PLUS,   NIL, NIL, LONE, DONE, C3},
    /* c2                      */ {PORT, I_C2,  BY, PLUS,   NIL, NIL, LONE, DONE, C2},
    /* n4                      */ {PORT, I_N4,  BY, PLUS,   NIL, NIL, LONE, DONE, N4},
    /* c6                      */ {PORT, I_C6,  BY, PLUS,   NIL, NIL, LONE, DONE, C6},
    /* c23 = c2*c3 - n2*n3     */ {REG,  C2,    OF, C3,     N2,  N3,  SUB,  DONE, C23},
    /* n23 = n2*c3 + c2*n3     */ {REG,  N2,    OF, C3,     C2,  N3,  ADD,  DONE, N23},
    /* l2                      */ {PORT, I_L2,  BY, PLUS,   NIL, NIL, LONE, DONE, L2},
    /* n6                      */ {PORT, I_N6,  BY, PLUS,   NIL, NIL, LONE, DONE, N6},
    /* c1                      */ {PORT, I_C1,  BY, PLUS,   NIL, NIL, LONE, DONE, C1},
    /* c5                      */ {PORT, I_C5,  BY, PLUS,   NIL, NIL, LONE, DONE, C5},
    /* l3                      */ {PORT, I_L3,  BY, PLUS,   NIL, NIL, LONE, DONE, L3},
    /* nf = n23*c4 + c23*n4    */ {PORT, I_C4,  OF, N23,    C23, N4,  ADD,  DONE, NF},
    /* d5                      */ {PORT, I_D5,  BY, PLUS,   NIL, NIL, LONE, DONE, D5},
    /* cf = c23*c4 - n23*n4    */ {PORT, I_C4,  OF, C23,    N23, N4,  SUB,  DONE, CF},
    /* s = n5*c6               */ {PORT, I_N5,  OF, C6,     NIL, NIL, LONE, DONE, S},
    /* m5 = -n5                */ {PORT, I_N5,  BY, MINUS,  NIL, NIL, LONE, DONE, M5},
    /* n1                      */ {PORT, I_N1,  BY, PLUS,   NIL, NIL, LONE, DONE, N1},
    /* t = c5*c6               */ {REG,  C5,    OF, C6,     NIL, NIL, LONE, DONE, T},
    /* u3 = cf*m5              */ {REG,  CF,    OF, M5,     NIL, NIL, LONE, DONE, U3},
    /* w: d5*nf - l2*c2        */ {REG,  D5,    OF, NF,     L2,  C2,  SUB,  KEEP, NIL},
    /* w = .. - l3*c23         */ {PORT, I_ONE, BY, NOUGHT, L3,  C23, SUB,  DONE, W},
    /* d4                      */ {PORT, I_D4,  BY, PLUS,   NIL, NIL, LONE, DONE, D4},
    /* e1 = cf*t - nf*n6       */ {REG,  CF,    OF, T,      NF,  N6,  SUB,  DONE, E1},
    /* r33 = nf*m5             */ {REG,  NF,    OF, M5,     NIL, NIL, LONE, DONE, R33},
    /* r13 = c1*u3 + n1*c5     */ {REG,  C1,    OF, U3,     N1,  C5,  ADD,  DONE, R13},
    /* r23 = n1*u3 - c1*c5     */ {REG,  N1,    OF, U3,     C1,  C5,  SUB,  DONE, R23},
    /* r31 = nf*t + cf*n6      */ {REG,  NF,    OF, T,      CF,  N6,  ADD,  DONE, R31},
    /* r11 = c1*e1 + n1*s      */ {REG,  C1,    OF, E1,     N1,  S,   ADD,  DONE, R11},
    /* r21 = n1*e1 - c1*s      */ {REG,  N1,    OF, E1,     C1,  S,   SUB,  DONE, R21},
    /* z: d1 - l2*n2           */ {PORT, I_D1,  BY, PLUS,   L2,  N2,  SUB,  KEEP, NIL},
    /* z .. + d6*r33 - l3*n23  */ {PORT, I_D6,  OF, R33,    L3,  N23, SUB,  KEEP, NIL},
    /* z = .. - d5*cf          */ {PORT, I_ONE, BY, NOUGHT, D5,  CF,  SUB,  DONE, Z},
    /* x: d6*r13 + c1*w        */ {PORT, I_D6,  OF, R13,    C1,  W,   ADD,  KEEP, NIL},
    /* x = .. + d4*n1          */ {REG,  D4,    OF, N1,     NIL, NIL, LONE, DONE, X},
    /* y: d6*r23 - d4*c1       */ {PORT, I_D6,  OF, R23,    D4,  C1,  SUB,  KEEP, NIL},
    /* y = .. + n1*w           */ {REG,  N1,    OF, W,      NIL, NIL, LONE, DONE, Y},
    /* r12 = r23*r31 - r33*r21 */ {REG,  R23,   OF, R31,    R33, R21, SUB,  DONE, R12},
    /* r22 = r33*r11 - r13*r31 */ {REG,  R33,   OF, R11,    R13, R31, SUB,  DONE, R22},
    /* r32 = r13*r21 - r23*r11 */ {REG,  R13,   OF, R21,    R23, R11, SUB,  DONE, R32}};
    wire [35:0] op;
    engine_program #(.LINES(41), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE == 1) begin : g_pipe1
    localparam [1:0] REG = 2'd0, PORT = 2'd1;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36, NOUGHT = 6'd4;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        R11 = 6'd2, R12 = 6'd3, R13 = 6'd4, R21 = 6'd5, R22 = 6'd6, R23 = 6'd7, R31 = 6'd8, R32 = 6'd9,
        R33 = 6'd10, X = 6'd11, Y = 6'd12, Z = 6'd13, N2 = 6'd14, N23 = 6'd15, N3 = 6'd15, C3 = 6'd16,
        N6 = 6'd16, C2 = 6'd17, W = 6'd17, CF = 6'd18, N4 = 6'd18, C6 = 6'd19, T = 6'd19, L2 = 6'd20,
        C23 = 6'd21, U3 = 6'd21, C1 = 6'd22, C5 = 6'd23, L3 = 6'd24, NF = 6'd25, S = 6'd26, D5 = 6'd27,
        M5 = 6'd28, N1 = 6'd29, D4 = 6'd30, E1 = 6'd31;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_C6 = 6'd10, I_N6 = 6'd11, I_D1 = 6'd12, I_D4 = 6'd13, I_D5 = 6'd14,
        I_D6 = 6'd15, I_L2 = 6'd16, I_L3 = 6'd17, I_ONE = 6'd18;
    localparam [41*36-1:0] LINES = {
    /* n2                      */ {PORT, I_N2,  BY, PLUS,   NIL, NIL, LONE, DONE, N2},
    /* n3                      */ {PORT, I_N3,  BY, PLUS,   NIL, NIL, LONE, DONE, N3},
    /* c3                      */ {PORT, I_C3,  BY, PLUS,   NIL, NIL, LONE, DONE, C3},
    /* c2                      */ {PORT, I_C2,  BY, PLUS,   NIL, NIL, LONE, DONE, C2},
    /* n4                      */ {PORT, I_N4,  BY, PLUS,   NIL, NIL, LONE, DONE, N4},
    /* c6                      */ {PORT, I_C6,  BY, PLUS,   NIL, NIL, LONE, DONE, C6},
    /* l2                      */ {PORT, I_L2,  BY, PLUS,   NIL, NIL, LONE, DONE, L2},
    /* c23 = c2*c3 - n2*n3     */ {REG,  C2,    OF, C3,     N2,  N3,  SUB,  DONE, C23},
    /* n23 = n2*c3 + c2*n3     */ {REG,  N2,    OF, C3,     C2,  N3,  ADD,  DONE, N23},
    /* n6                      */ {PORT, I_N6,  BY, PLUS,   NIL, NIL, LONE, DONE, N6},
    /* c1                      */ {PORT, I_C1,  BY, PLUS,   NIL, NIL, LONE, DONE, C1},
    /* c5                      */ {PORT, I_C5,  BY, PLUS,   NIL, NIL, LONE, DONE, C5},
    /* l3                      */ {PORT, I_L3,  BY, PLUS,   NIL, NIL, LONE, DONE, L3},
    /* nf = n23*c4 + c23*n4    */ {PORT, I_C4,  OF, N23,    C23, N4,  ADD,  DONE, NF},
    /* s = n5*c6               */ {PORT, I_N5,  OF, C6,     NIL, NIL, LONE, DONE, S},
    /* d5                      */ {PORT, I_D5,  BY, PLUS,   NIL, NIL, LONE, DONE, D5},
    /* cf = c23*c4 - n23*n4    */ {PORT, I_C4,  OF, C23,    N23, N4,  SUB,  DONE, CF},
    /* m5 = -n5                */ {PORT, I_N5,  BY, MINUS,  NIL, NIL, LONE, DONE, M5},
    /* n1                      */ {PORT, I_N1,  BY, PLUS,   NIL, NIL, LONE, DONE, N1},
    /* t = c5*c6               */ {REG,  C5,    OF, C6,     NIL, NIL, LONE, DONE, T},
    /* w: d5*nf - l2*c2        */ {REG,  D5,    OF, NF,     L2,  C2,  SUB,  KEEP, NIL},
    /* w = .. - l3*c23         */ {PORT, I_ONE, BY, NOUGHT, L3,  C23, SUB,  DONE, W},
    /* u3 = cf*m5              */ {REG,  CF,    OF, M5,     NIL, NIL, LONE, DONE, U3},
    /* d4                      */ {PORT, I_D4,  BY, PLUS,   NIL, NIL, LONE, DONE, D4},
    /* e1 = cf*t - nf*n6       */ {REG,  CF,    OF, T,      NF,  N6,  SUB,  DONE, E1},
    /* r33 = nf*m5             */ {REG,  NF,    OF, M5,     NIL, NIL, LONE, DONE, R33},
    /* r13 = c1*u3 + n1*c5     */ {REG,  C1,    OF, U3,     N1,  C5,  ADD,  DONE, R13},
    /* r23 = n1*u3 - c1*c5     */ {REG,  N1,    OF, U3,     C1,  C5,  SUB,  DONE, R23},
    /* r31 = nf*t + cf*n6      */ {REG,  NF,    OF, T,      CF,  N6,  ADD,  DONE, R31},
    /* r11 = c1*e1 + n1*s      */ {REG,  C1,    OF, E1,     N1,  S,   ADD,  DONE, R11},
    /* r21 = n1*e1 - c1*s      */ {REG,  N1,    OF, E1,     C1,  S,   SUB,  DONE, R21},
    /* z: d1 - l2*n2           */ {PORT, I_D1,  BY, PLUS,   L2,  N2,  SUB,  KEEP, NIL},
    /* z .. + d6*r33 - l3*n23  */ {PORT, I_D6,  OF, R33,    L3,  N23, SUB,  KEEP, NIL},
    /* z = .. - d5*cf          */ {PORT, I_ONE, BY, NOUGHT, D5,  CF,  SUB,  DONE, Z},
    /* x: d6*r13 + c1*w        */ {PORT, I_D6,  OF, R13,    C1,  W,   ADD,  KEEP, NIL},
    /* x = .. + d4*n1          */ {REG,  D4,    OF, N1,     NIL, NIL, LONE, DONE, X},
    /* y: d6*r23 - d4*c1       */ {PORT, I_D6,  OF, R23,    D4,  C1,  SUB,  KEEP, NIL},
    /* y = .. + n1*w           */ {REG,  N1,    OF, W,      NIL, NIL, LONE, DONE, Y},
    /* r12 = r23*r31 - r33*r21 */ {REG,  R23,   OF, R31,    R33, R21, SUB,  DONE, R12},
    /* r22 = r33*r11 - r13*r31 */ {REG,  R33,   OF, R11,    R13, R31, SUB,  DONE, R22},
    /* r32 = r13*r21 - r23*r11 */ {REG,  R13,   OF, R21,    R23, R11, SUB,  DONE, R32}};
    wire [35:0] op;
    engine_program #(.LINES(41), .DRAIN(4), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE == 2) begin : g_pipe2
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36, NOUGHT = 6'd4;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        R11 = 6'd2, R12 = 6'd3, R13 = 6'd4, R21 = 6'd5, R22 = 6'd6, R23 = 6'd7, R31 = 6'd8, R32 = 6'd9,
        R33 = 6'd10, X = 6'd11, Y = 6'd12, Z = 6'd13, N2 = 6'd14, N23 = 6'd15, N3 = 6'd15, C3 = 6'd16,
        L2 = 6'd16, C2 = 6'd17, W = 6'd17, CF = 6'd18, N4 = 6'd18, C6 = 6'd19, T = 6'd19, C23 = 6'd20,
        D4 = 6'd20, N6 = 6'd21, C1 = 6'd22, C5 = 6'd23, L3 = 6'd24, NF = 6'd25, S = 6'd26, D5 = 6'd27,
        M5 = 6'd28, N1 = 6'd29, U3 = 6'd30, E1 = 6'd31;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_C6 = 6'd10, I_N6 = 6'd11, I_D1 = 6'd12, I_D4 = 6'd13, I_D5 = 6'd14,
        I_D6 = 6'd15, I_L2 = 6'd16, I_L3 = 6'd17, I_ONE = 6'd18;
    localparam [41*36-1:0] LINES = {
    /* n2                      */ {PORT, I_N2,  BY, PLUS,   NIL, NIL, LONE, DONE, N2},
    /* n3                      */ {PORT, I_N3,  BY, PLUS,   NIL, NIL, LONE, DONE, N3},
    /* c3                      */ {PORT, I_C3,  BY, PLUS,   NIL, NIL, LONE, DONE, C3},
    /* c2                      */ {PORT, I_C2,  BY, PLUS,   NIL, NIL, LONE, DONE, C2},
    /* n4                      */ {PORT, I_N4,  BY, PLUS,   NIL, NIL, LONE, DONE, N4},
    /* c6                      */ {PORT, I_C6,  BY, PLUS,   NIL, NIL, LONE, DONE, C6},
    /* c23 = c2*c3 - n2*n3     */ {LAST, NIL,   OF, C3,     N2,  N3,  SUB,  DONE, C23},
    /* n23 = n2*c3 + c2*n3     */ {REG,  N2,    OF, C3,     C2,  N3,  ADD,  DONE, N23},
    /* l2                      */ {PORT, I_L2,  BY, PLUS,   NIL, NIL, LONE, DONE, L2},
    /* n6                      */ {PORT, I_N6,  BY, PLUS,   NIL, NIL, LONE, DONE, N6},
    /* c1                      */ {PORT, I_C1,  BY, PLUS,   NIL, NIL, LONE, DONE, C1},
    /* c5                      */ {PORT, I_C5,  BY, PLUS,   NIL, NIL, LONE, DONE, C5},
    /* l3                      */ {PORT, I_L3,  BY, PLUS,   NIL, NIL, LONE, DONE, L3},
    /* nf = n23*c4 + c23*n4    */ {PORT, I_C4,  OF, N23,    C23, N4,  ADD,  DONE, NF},
    /* s = n5*c6               */ {PORT, I_N5,  OF, C6,     NIL, NIL, LONE, DONE, S},
    /* d5                      */ {PORT, I_D5,  BY, PLUS,   NIL, NIL, LONE, DONE, D5},
    /* cf = c23*c4 - n23*n4    */ {PORT, I_C4,  OF, C23,    N23, N4,  SUB,  DONE, CF},
    /* m5 = -n5                */ {PORT, I_N5,  BY, MINUS,  NIL, NIL, LONE, DONE, M5},
    /* n1                      */ {PORT, I_N1,  BY, PLUS,   NIL, NIL, LONE, DONE, N1},
    /* t = c5*c6               */ {REG,  C5,    OF, C6,     NIL, NIL, LONE, DONE, T},
    /* u3 = cf*m5              */ {LAST, NIL,   OF, CF,     NIL, NIL, LONE, DONE, U3},
    /* w: d5*nf - l2*c2        */ {REG,  D5,    OF, NF,     L2,  C2,  SUB,  KEEP, NIL},
    /* w = .. - l3*c23         */ {PORT, I_ONE, BY, NOUGHT, L3,  C23, SUB,  DONE, W},
    /* d4                      */ {PORT, I_D4,  BY, PLUS,   NIL, NIL, LONE, DONE, D4},
    /* e1 = cf*t - nf*n6       */ {REG,  CF,    OF, T,      NF,  N6,  SUB,  DONE, E1},
    /* r33 = nf*m5             */ {REG,  NF,    OF, M5,     NIL, NIL, LONE, DONE, R33},
    /* r13 = c1*u3 + n1*c5     */ {REG,  C1,    OF, U3,     N1,  C5,  ADD,  DONE, R13},
    /* r23 = n1*u3 - c1*c5     */ {REG,  N1,    OF, U3,     C1,  C5,  SUB,  DONE, R23},
    /* r31 = nf*t + cf*n6      */ {REG,  NF,    OF, T,      CF,  N6,  ADD,  DONE, R31},
    /* r11 = c1*e1 + n1*s      */ {REG,  C1,    OF, E1,     N1,  S,   ADD,  DONE, R11},
    /* r21 = n1*e1 - c1*s      */ {REG,  N1,    OF, E1,     C1,  S,   SUB,  DONE, R21},
    /* z: d1 - l2*n2           */ {PORT, I_D1,  BY, PLUS,   L2,  N2,  SUB,  KEEP, NIL},
    /* z .. + d6*r33 - l3*n23  */ {PORT, I_D6,  OF, R33,    L3,  N23, SUB,  KEEP, NIL},
    /* z = .. - d5*cf          */ {PORT, I_ONE, BY, NOUGHT, D5,  CF,  SUB,  DONE, Z},
    /* x: d6*r13 + c1*w        */ {PORT, I_D6,  OF, R13,    C1,  W,   ADD,  KEEP, NIL},
    /* x = .. + d4*n1          */ {REG,  D4,    OF, N1,     NIL, NIL, LONE, DONE, X},
    /* y: d6*r23 - d4*c1       */ {PORT, I_D6,  OF, R23,    D4,  C1,  SUB,  KEEP, NIL},
    /* y = .. + n1*w           */ {REG,  N1,    OF, W,      NIL, NIL, LONE, DONE, Y},
    /* r12 = r23*r31 - r33*r21 */ {REG,  R23,   OF, R31,    R33, R21, SUB,  DONE, R12},
    /* r22 = r33*r11 - r13*r31 */ {REG,  R33,   OF, R11,    R13, R31, SUB,  DONE, R22},
    /* r32 = r13*r21 - r23*r11 */ {REG,  R13,   OF, R21,    R23, R11, SUB,  DONE, R32}};
    wire [35:0] op;
    engine_program #(.LINES(41), .DRAIN(6), .REGISTER(1), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE != 0 && PIPE != 1 && PIPE != 2) begin : g_illegal
        vector_ur_fk_program_needs_PIPE_0_or_1_or_2 rule ();
    end
    endgenerate
endmodule
`default_nettype wire
