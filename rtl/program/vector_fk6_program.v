// SPDX-License-Identifier: Apache-2.0
// Assembled from vector_fk6.kin by `quadrance assemble`; do not edit.
//   Six unit vectors to R = R03 R36 and the tip: ortho-parallel base, spherical wrist
// Line: word = A * B [+- C * D], DEST, and what else is done with it; one line a clock. I_ begins the name of an input;
// a word of capitals and a small letter is one that the assembler has added.
// Latency of a core that plays it: 45 at PIPE 0, 46 at PIPE 1, 48 at PIPE 2. Model: quadrance.program.meaning
`default_nettype none
module vector_fk6_program #(
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
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        R11 = 6'd2, R12 = 6'd3, R13 = 6'd4, R21 = 6'd5, R22 = 6'd6, R23 = 6'd7, R31 = 6'd8, R32 = 6'd9,
        R33 = 6'd10, X = 6'd11, Y = 6'd12, Z = 6'd13, C4 = 6'd14, E2 = 6'd14, E1 = 6'd15, N4 = 6'd15,
        C2 = 6'd16, N2 = 6'd17, X1 = 6'd17, N23 = 6'd18, N3 = 6'd18, C1 = 6'd19, N6 = 6'd19, E3 = 6'd20,
        T = 6'd20, S = 6'd21, U3 = 6'd21, L2 = 6'd22, C23 = 6'd23, B = 6'd24, M5 = 6'd24, F1 = 6'd25,
        N1 = 6'd26, A2 = 6'd27, F2 = 6'd28, U1 = 6'd29;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_C6 = 6'd10, I_N6 = 6'd11, I_A1 = 6'd12, I_A2 = 6'd13, I_B = 6'd14,
        I_L1 = 6'd15, I_L2 = 6'd16, I_L3 = 6'd17, I_L4 = 6'd18;
    localparam [41*36-1:0] LINES = {
    /* c4                        */ {PORT, I_C4, BY, PLUS,  NIL, NIL, LONE, DONE, C4},
    /* n4                        */ {PORT, I_N4, BY, PLUS,  NIL, NIL, LONE, DONE, N4},
    /* c2                        */ {PORT, I_C2, BY, PLUS,  NIL, NIL, LONE, DONE, C2},
    /* n2                        */ {PORT, I_N2, BY, PLUS,  NIL, NIL, LONE, DONE, N2},
    /* n3                        */ {PORT, I_N3, BY, PLUS,  NIL, NIL, LONE, DONE, N3},
    /* n6                        */ {PORT, I_N6, BY, PLUS,  NIL, NIL, LONE, DONE, N6},
    /* t = c5*c4                 */ {PORT, I_C5, OF, C4,    NIL, NIL, LONE, DONE, T},
    /* s = c5*n4                 */ {PORT, I_C5, OF, N4,    NIL, NIL, LONE, DONE, S},
    /* l2                        */ {PORT, I_L2, BY, PLUS,  NIL, NIL, LONE, DONE, L2},
    /* c23 = c3*c2 - n2*n3       */ {PORT, I_C3, OF, C2,    N2,  N3,  SUB,  DONE, C23},
    /* n23 = c3*n2 + c2*n3       */ {PORT, I_C3, OF, N2,    C2,  N3,  ADD,  DONE, N23},
    /* m5 = -n5                  */ {PORT, I_N5, BY, MINUS, NIL, NIL, LONE, DONE, M5},
    /* f1 = n5*c4                */ {PORT, I_N5, OF, C4,    NIL, NIL, LONE, DONE, F1},
    /* n1                        */ {PORT, I_N1, BY, PLUS,  NIL, NIL, LONE, DONE, N1},
    /* a2                        */ {PORT, I_A2, BY, PLUS,  NIL, NIL, LONE, DONE, A2},
    /* f2 = n5*n4                */ {PORT, I_N5, OF, N4,    NIL, NIL, LONE, DONE, F2},
    /* e1 = c6*t - n4*n6         */ {PORT, I_C6, OF, T,     N4,  N6,  SUB,  DONE, E1},
    /* e2 = c6*s + c4*n6         */ {PORT, I_C6, OF, S,     C4,  N6,  ADD,  DONE, E2},
    /* c1                        */ {PORT, I_C1, BY, PLUS,  NIL, NIL, LONE, DONE, C1},
    /* e3 = c6*m5                */ {PORT, I_C6, OF, M5,    NIL, NIL, LONE, DONE, E3},
    /* u3 = c5*n23 + c23*f1      */ {PORT, I_C5, OF, N23,   C23, F1,  ADD,  DONE, U3},
    /* x1: a1 + l2*n2            */ {PORT, I_A1, BY, PLUS,  L2,  N2,  ADD,  KEEP, NIL},
    /* x1 = .. + l3*n23 + a2*c23 */ {PORT, I_L3, OF, N23,   A2,  C23, ADD,  DONE, X1},
    /* b                         */ {PORT, I_B,  BY, PLUS,  NIL, NIL, LONE, DONE, B},
    /* u1 = c23*e1 + n23*e3      */ {REG,  C23,  OF, E1,    N23, E3,  ADD,  DONE, U1},
    /* r13 = c1*u3 - n1*f2       */ {REG,  C1,   OF, U3,    N1,  F2,  SUB,  DONE, R13},
    /* r23 = n1*u3 + c1*f2       */ {REG,  N1,   OF, U3,    C1,  F2,  ADD,  DONE, R23},
    /* r31 = c23*e3 - n23*e1     */ {REG,  C23,  OF, E3,    N23, E1,  SUB,  DONE, R31},
    /* r11 = c1*u1 - n1*e2       */ {REG,  C1,   OF, U1,    N1,  E2,  SUB,  DONE, R11},
    /* r21 = n1*u1 + c1*e2       */ {REG,  N1,   OF, U1,    C1,  E2,  ADD,  DONE, R21},
    /* r33 = c5*c23 - n23*f1     */ {PORT, I_C5, OF, C23,   N23, F1,  SUB,  DONE, R33},
    /* z: l1 - a2*n23            */ {PORT, I_L1, BY, PLUS,  A2,  N23, SUB,  KEEP, NIL},
    /* z .. + l3*c23 + l2*c2     */ {PORT, I_L3, OF, C23,   L2,  C2,  ADD,  KEEP, NIL},
    /* z = .. + l4*r33           */ {PORT, I_L4, OF, R33,   NIL, NIL, LONE, DONE, Z},
    /* x: l4*r13 - b*n1          */ {PORT, I_L4, OF, R13,   B,   N1,  SUB,  KEEP, NIL},
    /* x = .. + x1*c1            */ {REG,  C1,   OF, X1,    NIL, NIL, LONE, DONE, X},
    /* y: l4*r23 + x1*n1         */ {PORT, I_L4, OF, R23,   X1,  N1,  ADD,  KEEP, NIL},
    /* y = .. + b*c1             */ {REG,  B,    OF, C1,    NIL, NIL, LONE, DONE, Y},
    /* r12 = r23*r31 - r33*r21   */ {REG,  R23,  OF, R31,   R33, R21, SUB,  DONE, R12},
    /* r22 = r33*r11 - r13*r31   */ {REG,  R33,  OF, R11,   R13, R31, SUB,  DONE, R22},
    /* r32 = r13*r21 - r23*r11   */ {REG,  R13,  OF, R21,   R23, R11, SUB,  DONE, R32}};
    wire [35:0] op;
    engine_program #(.LINES(41), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE == 1) begin : g_pipe1
    localparam [1:0] REG = 2'd0, PORT = 2'd1;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        R11 = 6'd2, R12 = 6'd3, R13 = 6'd4, R21 = 6'd5, R22 = 6'd6, R23 = 6'd7, R31 = 6'd8, R32 = 6'd9,
        R33 = 6'd10, X = 6'd11, Y = 6'd12, Z = 6'd13, C4 = 6'd14, E2 = 6'd14, E1 = 6'd15, N4 = 6'd15,
        C2 = 6'd16, N2 = 6'd17, X1 = 6'd17, N23 = 6'd18, N3 = 6'd18, C1 = 6'd19, N6 = 6'd19, E3 = 6'd20,
        T = 6'd20, S = 6'd21, U3 = 6'd21, L2 = 6'd22, C23 = 6'd23, B = 6'd24, M5 = 6'd24, F1 = 6'd25,
        N1 = 6'd26, A2 = 6'd27, F2 = 6'd28, U1 = 6'd29;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_C6 = 6'd10, I_N6 = 6'd11, I_A1 = 6'd12, I_A2 = 6'd13, I_B = 6'd14,
        I_L1 = 6'd15, I_L2 = 6'd16, I_L3 = 6'd17, I_L4 = 6'd18;
    localparam [41*36-1:0] LINES = {
    /* c4                        */ {PORT, I_C4, BY, PLUS,  NIL, NIL, LONE, DONE, C4},
    /* n4                        */ {PORT, I_N4, BY, PLUS,  NIL, NIL, LONE, DONE, N4},
    /* c2                        */ {PORT, I_C2, BY, PLUS,  NIL, NIL, LONE, DONE, C2},
    /* n2                        */ {PORT, I_N2, BY, PLUS,  NIL, NIL, LONE, DONE, N2},
    /* n3                        */ {PORT, I_N3, BY, PLUS,  NIL, NIL, LONE, DONE, N3},
    /* n6                        */ {PORT, I_N6, BY, PLUS,  NIL, NIL, LONE, DONE, N6},
    /* t = c5*c4                 */ {PORT, I_C5, OF, C4,    NIL, NIL, LONE, DONE, T},
    /* s = c5*n4                 */ {PORT, I_C5, OF, N4,    NIL, NIL, LONE, DONE, S},
    /* l2                        */ {PORT, I_L2, BY, PLUS,  NIL, NIL, LONE, DONE, L2},
    /* c23 = c3*c2 - n2*n3       */ {PORT, I_C3, OF, C2,    N2,  N3,  SUB,  DONE, C23},
    /* n23 = c3*n2 + c2*n3       */ {PORT, I_C3, OF, N2,    C2,  N3,  ADD,  DONE, N23},
    /* m5 = -n5                  */ {PORT, I_N5, BY, MINUS, NIL, NIL, LONE, DONE, M5},
    /* f1 = n5*c4                */ {PORT, I_N5, OF, C4,    NIL, NIL, LONE, DONE, F1},
    /* n1                        */ {PORT, I_N1, BY, PLUS,  NIL, NIL, LONE, DONE, N1},
    /* a2                        */ {PORT, I_A2, BY, PLUS,  NIL, NIL, LONE, DONE, A2},
    /* f2 = n5*n4                */ {PORT, I_N5, OF, N4,    NIL, NIL, LONE, DONE, F2},
    /* e1 = c6*t - n4*n6         */ {PORT, I_C6, OF, T,     N4,  N6,  SUB,  DONE, E1},
    /* e2 = c6*s + c4*n6         */ {PORT, I_C6, OF, S,     C4,  N6,  ADD,  DONE, E2},
    /* c1                        */ {PORT, I_C1, BY, PLUS,  NIL, NIL, LONE, DONE, C1},
    /* e3 = c6*m5                */ {PORT, I_C6, OF, M5,    NIL, NIL, LONE, DONE, E3},
    /* u3 = c5*n23 + c23*f1      */ {PORT, I_C5, OF, N23,   C23, F1,  ADD,  DONE, U3},
    /* x1: a1 + l2*n2            */ {PORT, I_A1, BY, PLUS,  L2,  N2,  ADD,  KEEP, NIL},
    /* x1 = .. + l3*n23 + a2*c23 */ {PORT, I_L3, OF, N23,   A2,  C23, ADD,  DONE, X1},
    /* b                         */ {PORT, I_B,  BY, PLUS,  NIL, NIL, LONE, DONE, B},
    /* u1 = c23*e1 + n23*e3      */ {REG,  C23,  OF, E1,    N23, E3,  ADD,  DONE, U1},
    /* r13 = c1*u3 - n1*f2       */ {REG,  C1,   OF, U3,    N1,  F2,  SUB,  DONE, R13},
    /* r23 = n1*u3 + c1*f2       */ {REG,  N1,   OF, U3,    C1,  F2,  ADD,  DONE, R23},
    /* r31 = c23*e3 - n23*e1     */ {REG,  C23,  OF, E3,    N23, E1,  SUB,  DONE, R31},
    /* r11 = c1*u1 - n1*e2       */ {REG,  C1,   OF, U1,    N1,  E2,  SUB,  DONE, R11},
    /* r21 = n1*u1 + c1*e2       */ {REG,  N1,   OF, U1,    C1,  E2,  ADD,  DONE, R21},
    /* r33 = c5*c23 - n23*f1     */ {PORT, I_C5, OF, C23,   N23, F1,  SUB,  DONE, R33},
    /* x: l4*r13 - b*n1          */ {PORT, I_L4, OF, R13,   B,   N1,  SUB,  KEEP, NIL},
    /* x = .. + x1*c1            */ {REG,  C1,   OF, X1,    NIL, NIL, LONE, DONE, X},
    /* z: l1 - a2*n23            */ {PORT, I_L1, BY, PLUS,  A2,  N23, SUB,  KEEP, NIL},
    /* z .. + l3*c23 + l2*c2     */ {PORT, I_L3, OF, C23,   L2,  C2,  ADD,  KEEP, NIL},
    /* z = .. + l4*r33           */ {PORT, I_L4, OF, R33,   NIL, NIL, LONE, DONE, Z},
    /* y: l4*r23 + x1*n1         */ {PORT, I_L4, OF, R23,   X1,  N1,  ADD,  KEEP, NIL},
    /* y = .. + b*c1             */ {REG,  B,    OF, C1,    NIL, NIL, LONE, DONE, Y},
    /* r12 = r23*r31 - r33*r21   */ {REG,  R23,  OF, R31,   R33, R21, SUB,  DONE, R12},
    /* r22 = r33*r11 - r13*r31   */ {REG,  R33,  OF, R11,   R13, R31, SUB,  DONE, R22},
    /* r32 = r13*r21 - r23*r11   */ {REG,  R13,  OF, R21,   R23, R11, SUB,  DONE, R32}};
    wire [35:0] op;
    engine_program #(.LINES(41), .DRAIN(4), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE == 2) begin : g_pipe2
    localparam [1:0] REG = 2'd0, PORT = 2'd1;
    localparam OF = 1'd0, BY = 1'd1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'd32, MINUS = 6'd36;
    localparam [1:0] LONE = 2'd0, ADD = 2'd2, SUB = 2'd3;
    localparam DONE = 1'd0, KEEP = 1'd1;
    localparam [5:0]
        R11 = 6'd2, R12 = 6'd3, R13 = 6'd4, R21 = 6'd5, R22 = 6'd6, R23 = 6'd7, R31 = 6'd8, R32 = 6'd9,
        R33 = 6'd10, X = 6'd11, Y = 6'd12, Z = 6'd13, C4 = 6'd14, E2 = 6'd14, E1 = 6'd15, N4 = 6'd15,
        C2 = 6'd16, N2 = 6'd17, X1 = 6'd17, N23 = 6'd18, N3 = 6'd18, C1 = 6'd19, N6 = 6'd19, E3 = 6'd20,
        T = 6'd20, S = 6'd21, U3 = 6'd21, L2 = 6'd22, C23 = 6'd23, B = 6'd24, M5 = 6'd24, F1 = 6'd25,
        N1 = 6'd26, A2 = 6'd27, F2 = 6'd28, U1 = 6'd29;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_C6 = 6'd10, I_N6 = 6'd11, I_A1 = 6'd12, I_A2 = 6'd13, I_B = 6'd14,
        I_L1 = 6'd15, I_L2 = 6'd16, I_L3 = 6'd17, I_L4 = 6'd18;
    localparam [41*36-1:0] LINES = {
    /* c4                        */ {PORT, I_C4, BY, PLUS,  NIL, NIL, LONE, DONE, C4},
    /* n4                        */ {PORT, I_N4, BY, PLUS,  NIL, NIL, LONE, DONE, N4},
    /* c2                        */ {PORT, I_C2, BY, PLUS,  NIL, NIL, LONE, DONE, C2},
    /* n2                        */ {PORT, I_N2, BY, PLUS,  NIL, NIL, LONE, DONE, N2},
    /* n3                        */ {PORT, I_N3, BY, PLUS,  NIL, NIL, LONE, DONE, N3},
    /* n6                        */ {PORT, I_N6, BY, PLUS,  NIL, NIL, LONE, DONE, N6},
    /* t = c5*c4                 */ {PORT, I_C5, OF, C4,    NIL, NIL, LONE, DONE, T},
    /* s = c5*n4                 */ {PORT, I_C5, OF, N4,    NIL, NIL, LONE, DONE, S},
    /* l2                        */ {PORT, I_L2, BY, PLUS,  NIL, NIL, LONE, DONE, L2},
    /* c23 = c3*c2 - n2*n3       */ {PORT, I_C3, OF, C2,    N2,  N3,  SUB,  DONE, C23},
    /* n23 = c3*n2 + c2*n3       */ {PORT, I_C3, OF, N2,    C2,  N3,  ADD,  DONE, N23},
    /* m5 = -n5                  */ {PORT, I_N5, BY, MINUS, NIL, NIL, LONE, DONE, M5},
    /* f1 = n5*c4                */ {PORT, I_N5, OF, C4,    NIL, NIL, LONE, DONE, F1},
    /* n1                        */ {PORT, I_N1, BY, PLUS,  NIL, NIL, LONE, DONE, N1},
    /* a2                        */ {PORT, I_A2, BY, PLUS,  NIL, NIL, LONE, DONE, A2},
    /* f2 = n5*n4                */ {PORT, I_N5, OF, N4,    NIL, NIL, LONE, DONE, F2},
    /* e1 = c6*t - n4*n6         */ {PORT, I_C6, OF, T,     N4,  N6,  SUB,  DONE, E1},
    /* e2 = c6*s + c4*n6         */ {PORT, I_C6, OF, S,     C4,  N6,  ADD,  DONE, E2},
    /* c1                        */ {PORT, I_C1, BY, PLUS,  NIL, NIL, LONE, DONE, C1},
    /* e3 = c6*m5                */ {PORT, I_C6, OF, M5,    NIL, NIL, LONE, DONE, E3},
    /* u3 = c5*n23 + c23*f1      */ {PORT, I_C5, OF, N23,   C23, F1,  ADD,  DONE, U3},
    /* x1: a1 + l2*n2            */ {PORT, I_A1, BY, PLUS,  L2,  N2,  ADD,  KEEP, NIL},
    /* x1 = .. + l3*n23 + a2*c23 */ {PORT, I_L3, OF, N23,   A2,  C23, ADD,  DONE, X1},
    /* b                         */ {PORT, I_B,  BY, PLUS,  NIL, NIL, LONE, DONE, B},
    /* u1 = c23*e1 + n23*e3      */ {REG,  C23,  OF, E1,    N23, E3,  ADD,  DONE, U1},
    /* r13 = c1*u3 - n1*f2       */ {REG,  C1,   OF, U3,    N1,  F2,  SUB,  DONE, R13},
    /* r23 = n1*u3 + c1*f2       */ {REG,  N1,   OF, U3,    C1,  F2,  ADD,  DONE, R23},
    /* r31 = c23*e3 - n23*e1     */ {REG,  C23,  OF, E3,    N23, E1,  SUB,  DONE, R31},
    /* r11 = c1*u1 - n1*e2       */ {REG,  C1,   OF, U1,    N1,  E2,  SUB,  DONE, R11},
    /* r21 = n1*u1 + c1*e2       */ {REG,  N1,   OF, U1,    C1,  E2,  ADD,  DONE, R21},
    /* r33 = c5*c23 - n23*f1     */ {PORT, I_C5, OF, C23,   N23, F1,  SUB,  DONE, R33},
    /* x: l4*r13 - b*n1          */ {PORT, I_L4, OF, R13,   B,   N1,  SUB,  KEEP, NIL},
    /* x = .. + x1*c1            */ {REG,  C1,   OF, X1,    NIL, NIL, LONE, DONE, X},
    /* z: l1 - a2*n23            */ {PORT, I_L1, BY, PLUS,  A2,  N23, SUB,  KEEP, NIL},
    /* z .. + l3*c23 + l2*c2     */ {PORT, I_L3, OF, C23,   L2,  C2,  ADD,  KEEP, NIL},
    /* z = .. + l4*r33           */ {PORT, I_L4, OF, R33,   NIL, NIL, LONE, DONE, Z},
    /* y: l4*r23 + x1*n1         */ {PORT, I_L4, OF, R23,   X1,  N1,  ADD,  KEEP, NIL},
    /* y = .. + b*c1             */ {REG,  B,    OF, C1,    NIL, NIL, LONE, DONE, Y},
    /* r12 = r23*r31 - r33*r21   */ {REG,  R23,  OF, R31,   R33, R21, SUB,  DONE, R12},
    /* r22 = r33*r11 - r13*r31   */ {REG,  R33,  OF, R11,   R13, R31, SUB,  DONE, R22},
    /* r32 = r13*r21 - r23*r11   */ {REG,  R13,  OF, R21,   R23, R11, SUB,  DONE, R32}};
    wire [35:0] op;
    engine_program #(.LINES(41), .DRAIN(6), .REGISTER(1), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE != 0 && PIPE != 1 && PIPE != 2) begin : g_illegal
        vector_fk6_program_needs_PIPE_0_or_1_or_2 rule ();
    end
    endgenerate
endmodule
`default_nettype wire
