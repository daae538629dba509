// SPDX-License-Identifier: Apache-2.0
// Program of vector_fk6: six unit vectors to R = R03 R36 and the tip, in sums of two products.
//   c23, n23 = those of q2 + q3; e = first column of R36, f = third; u = both turned by q2 + q3; then by q1
//   column 2 = column 3 x column 1; tip = (x1 c1 - b n1, x1 n1 + b c1, z1) + l4 column 3
// Registers have the names of their words, ports I_; lN are the lengths c1 to c4. Line: word = A * B [+- C * D], DEST.
// One line a clock; a register is read from the third line behind the one that writes it on. Model: six.fk6
`default_nettype none
module six_forward_program (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    output wire        out_idle,
    output wire        out_done,
    output wire [46:0] out_op
);
    localparam [1:0] REG = 2'd0, PORT = 2'd1;
    localparam       OF = 1'b0, BY = 1'b1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'b100000, MINUS = 6'b100100;
    localparam [1:0] LONE = 2'b00, ADD = 2'b10, SUB = 2'b11;
    localparam       DONE = 1'b0, KEEP = 1'b1;
    localparam [5:0]
        R11 = 6'd2, R12 = 6'd3, R13 = 6'd4, R21 = 6'd5, R22 = 6'd6, R23 = 6'd7, R31 = 6'd8, R32 = 6'd9, R33 = 6'd10,
        X = 6'd11, Y = 6'd12, Z = 6'd13, C4 = 6'd14, C2 = 6'd15, N2 = 6'd16, N3 = 6'd17, N4 = 6'd18, N6 = 6'd19,
        M5 = 6'd20, T = 6'd21, C23 = 6'd22, N23 = 6'd23, F1 = 6'd24, A2 = 6'd25, L2 = 6'd26, S = 6'd27, E1 = 6'd28,
        E3 = 6'd29, C1 = 6'd30, N1 = 6'd31, F2 = 6'd32, U3 = 6'd33, E2 = 6'd34, U1 = 6'd35, X1 = 6'd36, B = 6'd37;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_C4 = 6'd6, I_N4 = 6'd7,
        I_C5 = 6'd8, I_N5 = 6'd9, I_C6 = 6'd10, I_N6 = 6'd11, I_A1 = 6'd12, I_A2 = 6'd13, I_B = 6'd14, I_L1 = 6'd15,
        I_L2 = 6'd16, I_L3 = 6'd17, I_L4 = 6'd18;
    //                            A             B         C    D    sum   keep  dest
    localparam [41*36-1:0] LINES = {
        /* c4              */ {PORT, I_C4, BY, PLUS,  NIL, NIL, LONE, DONE, C4},
        /* c2              */ {PORT, I_C2, BY, PLUS,  NIL, NIL, LONE, DONE, C2},
        /* n2              */ {PORT, I_N2, BY, PLUS,  NIL, NIL, LONE, DONE, N2},
        /* n3              */ {PORT, I_N3, BY, PLUS,  NIL, NIL, LONE, DONE, N3},
        /* n4              */ {PORT, I_N4, BY, PLUS,  NIL, NIL, LONE, DONE, N4},
        /* n6              */ {PORT, I_N6, BY, PLUS,  NIL, NIL, LONE, DONE, N6},
        /* -n5             */ {PORT, I_N5, BY, MINUS, NIL, NIL, LONE, DONE, M5},
        /* t = c5 c4       */ {PORT, I_C5, OF, C4,    NIL, NIL, LONE, DONE, T},
        /* c23             */ {PORT, I_C3, OF, C2,    N2,  N3,  SUB,  DONE, C23},
        /* n23             */ {PORT, I_C3, OF, N2,    C2,  N3,  ADD,  DONE, N23},
        /* f1              */ {PORT, I_N5, OF, C4,    NIL, NIL, LONE, DONE, F1},
        /* s = c5 n4       */ {PORT, I_C5, OF, N4,    NIL, NIL, LONE, DONE, S},
        /* e1              */ {PORT, I_C6, OF, T,     N4,  N6,  SUB,  DONE, E1},
        /* e3              */ {PORT, I_C6, OF, M5,    NIL, NIL, LONE, DONE, E3},
        /* l2              */ {PORT, I_L2, BY, PLUS,  NIL, NIL, LONE, DONE, L2},
        /* a2              */ {PORT, I_A2, BY, PLUS,  NIL, NIL, LONE, DONE, A2},
        /* c1              */ {PORT, I_C1, BY, PLUS,  NIL, NIL, LONE, DONE, C1},
        /* n1              */ {PORT, I_N1, BY, PLUS,  NIL, NIL, LONE, DONE, N1},
        /* f2              */ {PORT, I_N5, OF, N4,    NIL, NIL, LONE, DONE, F2},
        /* u3              */ {PORT, I_C5, OF, N23,   C23, F1,  ADD,  DONE, U3},
        /* e2              */ {PORT, I_C6, OF, S,     C4,  N6,  ADD,  DONE, E2},
        /* u1              */ {REG, C23,   OF, E1,    N23, E3,  ADD,  DONE, U1},
        /* a1 + l2 n2      */ {PORT, I_A1, BY, PLUS,  L2,  N2,  ADD,  KEEP, NIL},
        /* x1              */ {PORT, I_L3, OF, N23,   A2,  C23, ADD,  DONE, X1},
        /* b               */ {PORT, I_B,  BY, PLUS,  NIL, NIL, LONE, DONE, B},
        /* r33             */ {PORT, I_C5, OF, C23,   N23, F1,  SUB,  DONE, R33},
        /* r13             */ {REG, C1,    OF, U3,    N1,  F2,  SUB,  DONE, R13},
        /* r23             */ {REG, N1,    OF, U3,    C1,  F2,  ADD,  DONE, R23},
        /* r31             */ {REG, C23,   OF, E3,    N23, E1,  SUB,  DONE, R31},
        /* r11             */ {REG, C1,    OF, U1,    N1,  E2,  SUB,  DONE, R11},
        /* r21             */ {REG, N1,    OF, U1,    C1,  E2,  ADD,  DONE, R21},
        /* l1 + l2 c2      */ {PORT, I_L1, BY, PLUS,  L2,  C2,  ADD,  KEEP, NIL},
        /* l3 c23 - a2 n23 */ {PORT, I_L3, OF, C23,   A2,  N23, SUB,  KEEP, NIL},
        /* z               */ {PORT, I_L4, OF, R33,   NIL, NIL, LONE, DONE, Z},
        /* x1 c1 - b n1    */ {REG, X1,    OF, C1,    B,   N1,  SUB,  KEEP, NIL},
        /* x               */ {PORT, I_L4, OF, R13,   NIL, NIL, LONE, DONE, X},
        /* x1 n1 + b c1    */ {REG, X1,    OF, N1,    B,   C1,  ADD,  KEEP, NIL},
        /* y               */ {PORT, I_L4, OF, R23,   NIL, NIL, LONE, DONE, Y},
        /* r12             */ {REG, R23,   OF, R31,   R33, R21, SUB,  DONE, R12},
        /* r22             */ {REG, R33,   OF, R11,   R13, R31, SUB,  DONE, R22},
        /* r32             */ {REG, R13,   OF, R21,   R23, R11, SUB,  DONE, R32}};
    wire [35:0] op;
    engine_program #(.LINES(41), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
endmodule
`default_nettype wire
