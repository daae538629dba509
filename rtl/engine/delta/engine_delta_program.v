// SPDX-License-Identifier: Apache-2.0
// Program of engine_delta_fk: three cranks of a rotary delta to its tip, in sums of two products and two roots.
//   elbows e1, e1 + a, e1 + b; n = a x b; v = |a|^2 b - |b|^2 a; d = (2 lb n)^2 - v^2; q = v x n -+ n sqrt(d);
//   tip = e1 + lb q / |q|. up: times the power of two that brings the greater of |a|^2, |b|^2 to 1 ... 2
// A register has the name of its word, a port I_. A line is word = A * B [+- C * D], its DEST, and its acts. One line
// is played a clock, by the rules of rtl/program/README.md. Model: engine_delta.fk
`default_nettype none
module engine_delta_program #(
    parameter PIPE = 0  // registers behind the products of product_engine: 0 to 2 (default 0)
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
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2, TABLE = 2'd3;
    localparam       OF = 1'b0, BY = 1'b1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'b100000, SLOPE = 6'd0, BACK = 6'b001000,
        NOUGHT = 6'b000100, POWER = 6'd1, FOUR = 6'd2, TWICE = 6'd3;
    localparam [1:0] LONE = 2'b00, ADD = 2'b10, SUB = 2'b11;
    localparam       DONE = 1'b0, KEEP = 1'b1;
    localparam [1:0] HIGH = 2'd0, LOW = 2'd1, MID = 2'd2;
    localparam [8:0] OTHER = 9'h000, FOLD = 9'h001, MORE = 9'h002, WRIST = 9'h004, ABOVE = 9'h008, ROOT = 9'h010,
        HOLD = 9'h020, FAR = 9'h040;
    localparam [5:0]
        U = 6'd1, LA = 6'd2, B = 6'd4, L2 = 6'd5, Z1 = 6'd6, R1 = 6'd8, R2 = 6'd9, R3 = 6'd10, X1 = 6'd12,
        Y1 = 6'd13, AZ = 6'd14, BZ = 6'd15, AX = 6'd16, AY = 6'd17, BX = 6'd18, BYY = 6'd19, AA = 6'd20,
        BB = 6'd21, NX = 6'd22, NY = 6'd23, NZ = 6'd24, AAU = 6'd25, BBU = 6'd26, NXU = 6'd27, NYU = 6'd28,
        NZU = 6'd29, VX = 6'd30, VY = 6'd31, VZ = 6'd32, LX = 6'd33, LY = 6'd34, LZ = 6'd35, D = 6'd36,
        KX = 6'd37, KY = 6'd38, T = 6'd39, KZ = 6'd40, G = 6'd41, H = 6'd42, QX = 6'd43, LB = 6'd44, QY = 6'd45,
        QZ = 6'd46, E = 6'd47, QXU = 6'd48, QYU = 6'd49, QZU = 6'd50, G2 = 6'd51, F = 6'd52, X = 6'd3, Y = 6'd7,
        Z = 6'd11;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_BASE = 6'd6,
        I_LA = 6'd7, I_LB = 6'd8, I_LB2 = 6'd9, I_RX1 = 6'd10, I_RY1 = 6'd11, I_RX2 = 6'd12, I_RY2 = 6'd13,
        I_RX3 = 6'd14, I_RY3 = 6'd15, I_UNIT = 6'd16;
    //                       A               B            C    D    sum   keep  align dest act
    localparam [62*47-1:0] LINES = {
        /* 1                 */ {PORT,  I_UNIT, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, U,   OTHER},
        /* la                */ {PORT,  I_LA,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, LA,  OTHER},
        /* base              */ {PORT,  I_BASE, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, B,   OTHER},
        /* 2 lb              */ {PORT,  I_LB2,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, L2,  OTHER},
        /* elbow 1, z        */ {PORT,  I_N1,   OF, LA,     NIL, NIL, LONE, DONE, HIGH, Z1,  OTHER},
        /* its radius        */ {PORT,  I_C1,   OF, LA,     B,   U,   ADD,  DONE, HIGH, R1,  OTHER},
        /* radius 2          */ {PORT,  I_C2,   OF, LA,     B,   U,   ADD,  DONE, HIGH, R2,  OTHER},
        /* radius 3          */ {PORT,  I_C3,   OF, LA,     B,   U,   ADD,  DONE, HIGH, R3,  OTHER},
        /* x1                */ {PORT,  I_RX1,  OF, R1,     NIL, NIL, LONE, DONE, HIGH, X1,  OTHER},
        /* y1                */ {PORT,  I_RY1,  OF, R1,     NIL, NIL, LONE, DONE, HIGH, Y1,  OTHER},
        /* a, z              */ {PORT,  I_N2,   OF, LA,     Z1,  U,   SUB,  DONE, HIGH, AZ,  OTHER},
        /* b, z              */ {PORT,  I_N3,   OF, LA,     Z1,  U,   SUB,  DONE, HIGH, BZ,  OTHER},
        /* a, x              */ {PORT,  I_RX2,  OF, R2,     X1,  U,   SUB,  DONE, HIGH, AX,  OTHER},
        /* a, y              */ {PORT,  I_RY2,  OF, R2,     Y1,  U,   SUB,  DONE, HIGH, AY,  OTHER},
        /* b, x              */ {PORT,  I_RX3,  OF, R3,     X1,  U,   SUB,  DONE, HIGH, BX,  OTHER},
        /* b, y              */ {PORT,  I_RY3,  OF, R3,     Y1,  U,   SUB,  DONE, HIGH, BYY, OTHER},
        /* |a|^2, two of 3   */ {REG,   AX,     OF, AX,     AZ,  AZ,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |a|^2             */ {REG,   AY,     OF, AY,     NIL, NIL, LONE, DONE, HIGH, AA,  FOLD},
        /* |b|^2, two of 3   */ {REG,   BX,     OF, BX,     BZ,  BZ,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |b|^2             */ {REG,   BYY,    OF, BYY,    NIL, NIL, LONE, DONE, HIGH, BB,  MORE},
        /* n = a x b         */ {REG,   AY,     OF, BZ,     AZ,  BYY, SUB,  DONE, HIGH, NX,  OTHER},
        /*                   */ {REG,   AZ,     OF, BX,     AX,  BZ,  SUB,  DONE, HIGH, NY,  OTHER},
        /*                   */ {REG,   AX,     OF, BYY,    AY,  BX,  SUB,  DONE, HIGH, NZ,  OTHER},
        /* |a|^2 up          */ {REG,   AA,     BY, POWER,  NIL, NIL, LONE, DONE, LOW,  AAU, OTHER},
        /* |b|^2 up          */ {REG,   BB,     BY, POWER,  NIL, NIL, LONE, DONE, LOW,  BBU, OTHER},
        /* n up              */ {REG,   NX,     BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NXU, OTHER},
        /*                   */ {REG,   NY,     BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NYU, OTHER},
        /*                   */ {REG,   NZ,     BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NZU, OTHER},
        /* v                 */ {REG,   AAU,    OF, BX,     BBU, AX,  SUB,  DONE, HIGH, VX,  OTHER},
        /*                   */ {REG,   AAU,    OF, BYY,    BBU, AY,  SUB,  DONE, HIGH, VY,  OTHER},
        /*                   */ {REG,   AAU,    OF, BZ,     BBU, AZ,  SUB,  DONE, HIGH, VZ,  OTHER},
        /* 2 lb n            */ {REG,   L2,     OF, NXU,    NIL, NIL, LONE, DONE, HIGH, LX,  OTHER},
        /*                   */ {REG,   L2,     OF, NYU,    NIL, NIL, LONE, DONE, HIGH, LY,  OTHER},
        /*                   */ {REG,   L2,     OF, NZU,    NIL, NIL, LONE, DONE, HIGH, LZ,  OTHER},
        /* (2 lb n)^2 - v^2  */ {REG,   LX,     OF, LX,     VX,  VX,  SUB,  KEEP, HIGH, NIL, OTHER},
        /* (2 lb n)^2 - v^2  */ {REG,   LY,     OF, LY,     VY,  VY,  SUB,  KEEP, HIGH, NIL, OTHER},
        /* d                 */ {REG,   LZ,     OF, LZ,     VZ,  VZ,  SUB,  DONE, HIGH, D,   FOLD | ABOVE | FAR},
        /* v x n             */ {REG,   VY,     OF, NZU,    VZ,  NYU, SUB,  DONE, HIGH, KX,  OTHER},
        /*                   */ {REG,   VZ,     OF, NXU,    VX,  NZU, SUB,  DONE, HIGH, KY,  OTHER},
        /* d 4^j             */ {REG,   D,      BY, FOUR,   NIL, NIL, LONE, DONE, LOW,  NIL, ROOT},
        /* d 2^j             */ {REG,   D,      BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  T,   OTHER},
        /*                   */ {REG,   VX,     OF, NYU,    VY,  NXU, SUB,  DONE, HIGH, KZ,  OTHER},
        /* 1 / root          */ {TABLE, NIL,    BY, BACK,   NIL, NIL, LONE, DONE, MID,  G,   OTHER},
        /* -+root            */ {LAST,  NIL,    OF, T,      NIL, NIL, LONE, DONE, HIGH, H,   OTHER},
        /* q                 */ {LAST,  NIL,    OF, NXU,    KX,  U,   ADD,  DONE, HIGH, QX,  OTHER},
        /* lb                */ {PORT,  I_LB,   BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, LB,  OTHER},
        /*                   */ {REG,   H,      OF, NYU,    KY,  U,   ADD,  DONE, HIGH, QY,  OTHER},
        /*                   */ {REG,   H,      OF, NZU,    KZ,  U,   ADD,  DONE, HIGH, QZ,  OTHER},
        /*                   */ {PORT,  NIL,    BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* |q|^2, two of 3   */ {REG,   QX,     OF, QX,     QY,  QY,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |q|^2             */ {REG,   QZ,     OF, QZ,     NIL, NIL, LONE, DONE, HIGH, E,   FOLD | WRIST},
        /*                   */ {PORT,  NIL,    BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* q up              */ {REG,   QX,     BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QXU, OTHER},
        /* |q|^2 4^j         */ {REG,   E,      BY, FOUR,   NIL, NIL, LONE, DONE, LOW,  NIL, ROOT},
        /*                   */ {REG,   QY,     BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QYU, OTHER},
        /*                   */ {REG,   QZ,     BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QZU, OTHER},
        /* 1 / root          */ {TABLE, NIL,    BY, SLOPE,  NIL, NIL, LONE, DONE, MID,  G2,  OTHER},
        /* lb of it          */ {LAST,  NIL,    OF, LB,     NIL, NIL, LONE, DONE, HIGH, F,   OTHER},
        /* tip               */ {LAST,  NIL,    OF, QXU,    X1,  U,   ADD,  DONE, HIGH, X,   HOLD},
        /*                   */ {PORT,  NIL,    BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {REG,   F,      OF, QYU,    Y1,  U,   ADD,  DONE, HIGH, Y,   HOLD},
        /*                   */ {REG,   F,      OF, QZU,    Z1,  U,   ADD,  DONE, HIGH, Z,   HOLD}};
    engine_program #(.LINES(62), .BITS(47), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
    end
    if (PIPE == 1) begin : g_pipe1
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2, TABLE = 2'd3;
    localparam       OF = 1'b0, BY = 1'b1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'b100000, SLOPE = 6'd0, BACK = 6'b001000,
        NOUGHT = 6'b000100, POWER = 6'd1, FOUR = 6'd2, TWICE = 6'd3;
    localparam [1:0] LONE = 2'b00, ADD = 2'b10, SUB = 2'b11;
    localparam       DONE = 1'b0, KEEP = 1'b1;
    localparam [1:0] HIGH = 2'd0, LOW = 2'd1, MID = 2'd2;
    localparam [8:0] OTHER = 9'h000, FOLD = 9'h001, MORE = 9'h002, WRIST = 9'h004, ABOVE = 9'h008, ROOT = 9'h010,
        HOLD = 9'h020, FAR = 9'h040;
    localparam [5:0]
        U = 6'd1, LA = 6'd2, B = 6'd4, L2 = 6'd5, Z1 = 6'd6, R1 = 6'd8, R2 = 6'd9, R3 = 6'd10, X1 = 6'd12,
        Y1 = 6'd13, AZ = 6'd14, BZ = 6'd15, AX = 6'd16, AY = 6'd17, BX = 6'd18, BYY = 6'd19, AA = 6'd20,
        BB = 6'd21, NX = 6'd22, NY = 6'd23, NZ = 6'd24, AAU = 6'd25, BBU = 6'd26, NXU = 6'd27, NYU = 6'd28,
        NZU = 6'd29, VX = 6'd30, VY = 6'd31, VZ = 6'd32, LX = 6'd33, LY = 6'd34, LZ = 6'd35, D = 6'd36,
        KX = 6'd37, KY = 6'd38, T = 6'd39, KZ = 6'd40, G = 6'd41, H = 6'd42, QX = 6'd43, LB = 6'd44, QY = 6'd45,
        QZ = 6'd46, E = 6'd47, QXU = 6'd48, QYU = 6'd49, QZU = 6'd50, G2 = 6'd51, F = 6'd52, X = 6'd3, Y = 6'd7,
        Z = 6'd11;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_BASE = 6'd6,
        I_LA = 6'd7, I_LB = 6'd8, I_LB2 = 6'd9, I_RX1 = 6'd10, I_RY1 = 6'd11, I_RX2 = 6'd12, I_RY2 = 6'd13,
        I_RX3 = 6'd14, I_RY3 = 6'd15, I_UNIT = 6'd16;
    //                       A               B            C    D    sum   keep  align dest act
    localparam [72*47-1:0] LINES = {
        /* 1                 */ {PORT,  I_UNIT,BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, U,   OTHER},
        /* la                */ {PORT,  I_LA,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, LA,  OTHER},
        /* base              */ {PORT,  I_BASE,BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, B,   OTHER},
        /* 2 lb              */ {PORT,  I_LB2, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, L2,  OTHER},
        /* lb                */ {PORT,  I_LB,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, LB,  OTHER},
        /* elbow 1, z        */ {PORT,  I_N1,  OF, LA,     NIL, NIL, LONE, DONE, HIGH, Z1,  OTHER},
        /* its radius        */ {PORT,  I_C1,  OF, LA,     B,   U,   ADD,  DONE, HIGH, R1,  OTHER},
        /* radius 2          */ {PORT,  I_C2,  OF, LA,     B,   U,   ADD,  DONE, HIGH, R2,  OTHER},
        /* radius 3          */ {PORT,  I_C3,  OF, LA,     B,   U,   ADD,  DONE, HIGH, R3,  OTHER},
        /* a, z              */ {PORT,  I_N2,  OF, LA,     Z1,  U,   SUB,  DONE, HIGH, AZ,  OTHER},
        /* x1                */ {PORT,  I_RX1, OF, R1,     NIL, NIL, LONE, DONE, HIGH, X1,  OTHER},
        /* y1                */ {PORT,  I_RY1, OF, R1,     NIL, NIL, LONE, DONE, HIGH, Y1,  OTHER},
        /* b, z              */ {PORT,  I_N3,  OF, LA,     Z1,  U,   SUB,  DONE, HIGH, BZ,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* a, x              */ {PORT,  I_RX2, OF, R2,     X1,  U,   SUB,  DONE, HIGH, AX,  OTHER},
        /* a, y              */ {PORT,  I_RY2, OF, R2,     Y1,  U,   SUB,  DONE, HIGH, AY,  OTHER},
        /* b, x              */ {PORT,  I_RX3, OF, R3,     X1,  U,   SUB,  DONE, HIGH, BX,  OTHER},
        /* b, y              */ {PORT,  I_RY3, OF, R3,     Y1,  U,   SUB,  DONE, HIGH, BYY, OTHER},
        /* |a|^2, two of 3   */ {REG,   AX,    OF, AX,     AZ,  AZ,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |a|^2             */ {REG,   AY,    OF, AY,     NIL, NIL, LONE, DONE, HIGH, AA,  FOLD},
        /* |b|^2, two of 3   */ {REG,   BX,    OF, BX,     BZ,  BZ,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |b|^2             */ {REG,   BYY,   OF, BYY,    NIL, NIL, LONE, DONE, HIGH, BB,  MORE},
        /* n = a x b         */ {REG,   AY,    OF, BZ,     AZ,  BYY, SUB,  DONE, HIGH, NX,  OTHER},
        /* n = a x b         */ {REG,   AZ,    OF, BX,     AX,  BZ,  SUB,  DONE, HIGH, NY,  OTHER},
        /* n = a x b         */ {REG,   AX,    OF, BYY,    AY,  BX,  SUB,  DONE, HIGH, NZ,  OTHER},
        /* |b|^2 up          */ {REG,   BB,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  BBU, OTHER},
        /* |a|^2 up          */ {REG,   AA,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  AAU, OTHER},
        /* n up              */ {REG,   NX,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NXU, OTHER},
        /* n up              */ {REG,   NY,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NYU, OTHER},
        /* n up              */ {REG,   NZ,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NZU, OTHER},
        /* v                 */ {REG,   AAU,   OF, BX,     BBU, AX,  SUB,  DONE, HIGH, VX,  OTHER},
        /* 2 lb n            */ {REG,   L2,    OF, NXU,    NIL, NIL, LONE, DONE, HIGH, LX,  OTHER},
        /* v                 */ {REG,   AAU,   OF, BYY,    BBU, AY,  SUB,  DONE, HIGH, VY,  OTHER},
        /* 2 lb n            */ {REG,   L2,    OF, NYU,    NIL, NIL, LONE, DONE, HIGH, LY,  OTHER},
        /* v                 */ {REG,   AAU,   OF, BZ,     BBU, AZ,  SUB,  DONE, HIGH, VZ,  OTHER},
        /* 2 lb n            */ {REG,   L2,    OF, NZU,    NIL, NIL, LONE, DONE, HIGH, LZ,  OTHER},
        /* v x n             */ {LAST,  NIL,   OF, NXU,    VX,  NZU, SUB,  DONE, HIGH, KY,  OTHER},
        /* (2 lb n)^2 - v^2  */ {REG,   LX,    OF, LX,     VX,  VX,  SUB,  KEEP, HIGH, NIL, OTHER},
        /* (2 lb n)^2 - v^2  */ {REG,   LY,    OF, LY,     VY,  VY,  SUB,  KEEP, HIGH, NIL, OTHER},
        /* d                 */ {REG,   LZ,    OF, LZ,     VZ,  VZ,  SUB,  DONE, HIGH, D,   FOLD | ABOVE | FAR},
        /* v x n             */ {REG,   VY,    OF, NZU,    VZ,  NYU, SUB,  DONE, HIGH, KX,  OTHER},
        /* v x n             */ {REG,   VX,    OF, NYU,    VY,  NXU, SUB,  DONE, HIGH, KZ,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* d 4^j             */ {REG,   D,     BY, FOUR,   NIL, NIL, LONE, DONE, LOW,  NIL, ROOT},
        /* d 2^j             */ {REG,   D,     BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  T,   OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* 1 / root          */ {TABLE, NIL,   BY, BACK,   NIL, NIL, LONE, DONE, MID,  G,   OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* -+root            */ {LAST,  NIL,   OF, T,      NIL, NIL, LONE, DONE, HIGH, H,   OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* q                 */ {LAST,  NIL,   OF, NXU,    KX,  U,   ADD,  DONE, HIGH, QX,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* q                 */ {REG,   H,     OF, NYU,    KY,  U,   ADD,  DONE, HIGH, QY,  OTHER},
        /* q                 */ {REG,   H,     OF, NZU,    KZ,  U,   ADD,  DONE, HIGH, QZ,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* |q|^2, two of 3   */ {REG,   QX,    OF, QX,     QY,  QY,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |q|^2             */ {REG,   QZ,    OF, QZ,     NIL, NIL, LONE, DONE, HIGH, E,   FOLD | WRIST},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* q up              */ {REG,   QX,    BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QXU, OTHER},
        /* |q|^2 4^j         */ {REG,   E,     BY, FOUR,   NIL, NIL, LONE, DONE, LOW,  NIL, ROOT},
        /* q up              */ {REG,   QY,    BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QYU, OTHER},
        /* q up              */ {REG,   QZ,    BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QZU, OTHER},
        /* 1 / root          */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL, LONE, DONE, MID,  G2,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* lb of it          */ {LAST,  NIL,   OF, LB,     NIL, NIL, LONE, DONE, HIGH, F,   OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* tip               */ {LAST,  NIL,   OF, QXU,    X1,  U,   ADD,  DONE, HIGH, X,   HOLD},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* tip               */ {REG,   F,     OF, QYU,    Y1,  U,   ADD,  DONE, HIGH, Y,   HOLD},
        /* tip               */ {REG,   F,     OF, QZU,    Z1,  U,   ADD,  DONE, HIGH, Z,   HOLD}};
    engine_program #(.LINES(72), .DRAIN(4), .BITS(47), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
    end
    if (PIPE == 2) begin : g_pipe2
    localparam [1:0] REG = 2'd0, PORT = 2'd1, LAST = 2'd2, TABLE = 2'd3;
    localparam       OF = 1'b0, BY = 1'b1;
    localparam [5:0] NIL = 6'd0, PLUS = 6'b100000, SLOPE = 6'd0, BACK = 6'b001000,
        NOUGHT = 6'b000100, POWER = 6'd1, FOUR = 6'd2, TWICE = 6'd3;
    localparam [1:0] LONE = 2'b00, ADD = 2'b10, SUB = 2'b11;
    localparam       DONE = 1'b0, KEEP = 1'b1;
    localparam [1:0] HIGH = 2'd0, LOW = 2'd1, MID = 2'd2;
    localparam [8:0] OTHER = 9'h000, FOLD = 9'h001, MORE = 9'h002, WRIST = 9'h004, ABOVE = 9'h008, ROOT = 9'h010,
        HOLD = 9'h020, FAR = 9'h040;
    localparam [5:0]
        U = 6'd1, LA = 6'd2, B = 6'd4, L2 = 6'd5, Z1 = 6'd6, R1 = 6'd8, R2 = 6'd9, R3 = 6'd10, X1 = 6'd12,
        Y1 = 6'd13, AZ = 6'd14, BZ = 6'd15, AX = 6'd16, AY = 6'd17, BX = 6'd18, BYY = 6'd19, AA = 6'd20,
        BB = 6'd21, NX = 6'd22, NY = 6'd23, NZ = 6'd24, AAU = 6'd25, BBU = 6'd26, NXU = 6'd27, NYU = 6'd28,
        NZU = 6'd29, VX = 6'd30, VY = 6'd31, VZ = 6'd32, LX = 6'd33, LY = 6'd34, LZ = 6'd35, D = 6'd36,
        KX = 6'd37, KY = 6'd38, T = 6'd39, KZ = 6'd40, G = 6'd41, H = 6'd42, QX = 6'd43, LB = 6'd44, QY = 6'd45,
        QZ = 6'd46, E = 6'd47, QXU = 6'd48, QYU = 6'd49, QZU = 6'd50, G2 = 6'd51, F = 6'd52, X = 6'd3, Y = 6'd7,
        Z = 6'd11;
    localparam [5:0]
        I_C1 = 6'd0, I_N1 = 6'd1, I_C2 = 6'd2, I_N2 = 6'd3, I_C3 = 6'd4, I_N3 = 6'd5, I_BASE = 6'd6,
        I_LA = 6'd7, I_LB = 6'd8, I_LB2 = 6'd9, I_RX1 = 6'd10, I_RY1 = 6'd11, I_RX2 = 6'd12, I_RY2 = 6'd13,
        I_RX3 = 6'd14, I_RY3 = 6'd15, I_UNIT = 6'd16;
    //                       A               B            C    D    sum   keep  align dest act
    localparam [76*47-1:0] LINES = {
        /* 1                 */ {PORT,  I_UNIT,BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, U,   OTHER},
        /* la                */ {PORT,  I_LA,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, LA,  OTHER},
        /* base              */ {PORT,  I_BASE,BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, B,   OTHER},
        /* 2 lb              */ {PORT,  I_LB2, BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, L2,  OTHER},
        /* lb                */ {PORT,  I_LB,  BY, PLUS,   NIL, NIL, LONE, DONE, HIGH, LB,  OTHER},
        /* elbow 1, z        */ {PORT,  I_N1,  OF, LA,     NIL, NIL, LONE, DONE, HIGH, Z1,  OTHER},
        /* its radius        */ {PORT,  I_C1,  OF, LA,     B,   U,   ADD,  DONE, HIGH, R1,  OTHER},
        /* radius 2          */ {PORT,  I_C2,  OF, LA,     B,   U,   ADD,  DONE, HIGH, R2,  OTHER},
        /* radius 3          */ {PORT,  I_C3,  OF, LA,     B,   U,   ADD,  DONE, HIGH, R3,  OTHER},
        /* a, z              */ {PORT,  I_N2,  OF, LA,     Z1,  U,   SUB,  DONE, HIGH, AZ,  OTHER},
        /* x1                */ {PORT,  I_RX1, OF, R1,     NIL, NIL, LONE, DONE, HIGH, X1,  OTHER},
        /* y1                */ {PORT,  I_RY1, OF, R1,     NIL, NIL, LONE, DONE, HIGH, Y1,  OTHER},
        /* b, z              */ {PORT,  I_N3,  OF, LA,     Z1,  U,   SUB,  DONE, HIGH, BZ,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* a, x              */ {PORT,  I_RX2, OF, R2,     X1,  U,   SUB,  DONE, HIGH, AX,  OTHER},
        /* a, y              */ {PORT,  I_RY2, OF, R2,     Y1,  U,   SUB,  DONE, HIGH, AY,  OTHER},
        /* b, x              */ {PORT,  I_RX3, OF, R3,     X1,  U,   SUB,  DONE, HIGH, BX,  OTHER},
        /* b, y              */ {PORT,  I_RY3, OF, R3,     Y1,  U,   SUB,  DONE, HIGH, BYY, OTHER},
        /* |a|^2, two of 3   */ {REG,   AX,    OF, AX,     AZ,  AZ,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |a|^2             */ {REG,   AY,    OF, AY,     NIL, NIL, LONE, DONE, HIGH, AA,  FOLD},
        /* |b|^2, two of 3   */ {REG,   BX,    OF, BX,     BZ,  BZ,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |b|^2             */ {REG,   BYY,   OF, BYY,    NIL, NIL, LONE, DONE, HIGH, BB,  MORE},
        /* n = a x b         */ {REG,   AY,    OF, BZ,     AZ,  BYY, SUB,  DONE, HIGH, NX,  OTHER},
        /* n = a x b         */ {REG,   AZ,    OF, BX,     AX,  BZ,  SUB,  DONE, HIGH, NY,  OTHER},
        /* n = a x b         */ {REG,   AX,    OF, BYY,    AY,  BX,  SUB,  DONE, HIGH, NZ,  OTHER},
        /* |b|^2 up          */ {REG,   BB,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  BBU, OTHER},
        /* |a|^2 up          */ {REG,   AA,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  AAU, OTHER},
        /* n up              */ {REG,   NX,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NXU, OTHER},
        /* n up              */ {REG,   NY,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NYU, OTHER},
        /* n up              */ {REG,   NZ,    BY, POWER,  NIL, NIL, LONE, DONE, LOW,  NZU, OTHER},
        /* v                 */ {REG,   AAU,   OF, BX,     BBU, AX,  SUB,  DONE, HIGH, VX,  OTHER},
        /* 2 lb n            */ {REG,   L2,    OF, NXU,    NIL, NIL, LONE, DONE, HIGH, LX,  OTHER},
        /* v                 */ {REG,   AAU,   OF, BYY,    BBU, AY,  SUB,  DONE, HIGH, VY,  OTHER},
        /* 2 lb n            */ {REG,   L2,    OF, NYU,    NIL, NIL, LONE, DONE, HIGH, LY,  OTHER},
        /* v                 */ {REG,   AAU,   OF, BZ,     BBU, AZ,  SUB,  DONE, HIGH, VZ,  OTHER},
        /* 2 lb n            */ {REG,   L2,    OF, NZU,    NIL, NIL, LONE, DONE, HIGH, LZ,  OTHER},
        /* v x n             */ {REG,   VX,    OF, NYU,    VY,  NXU, SUB,  DONE, HIGH, KZ,  OTHER},
        /* (2 lb n)^2 - v^2  */ {REG,   LX,    OF, LX,     VX,  VX,  SUB,  KEEP, HIGH, NIL, OTHER},
        /* (2 lb n)^2 - v^2  */ {REG,   LY,    OF, LY,     VY,  VY,  SUB,  KEEP, HIGH, NIL, OTHER},
        /* d                 */ {REG,   LZ,    OF, LZ,     VZ,  VZ,  SUB,  DONE, HIGH, D,   FOLD | ABOVE | FAR},
        /* v x n             */ {REG,   VY,    OF, NZU,    VZ,  NYU, SUB,  DONE, HIGH, KX,  OTHER},
        /* v x n             */ {REG,   VZ,    OF, NXU,    VX,  NZU, SUB,  DONE, HIGH, KY,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* d 4^j             */ {REG,   D,     BY, FOUR,   NIL, NIL, LONE, DONE, LOW,  NIL, ROOT},
        /* d 2^j             */ {REG,   D,     BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  T,   OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* 1 / root          */ {TABLE, NIL,   BY, BACK,   NIL, NIL, LONE, DONE, MID,  G,   OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* -+root            */ {LAST,  NIL,   OF, T,      NIL, NIL, LONE, DONE, HIGH, H,   OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* q                 */ {LAST,  NIL,   OF, NXU,    KX,  U,   ADD,  DONE, HIGH, QX,  OTHER},
        /* q                 */ {REG,   H,     OF, NYU,    KY,  U,   ADD,  DONE, HIGH, QY,  OTHER},
        /* q                 */ {REG,   H,     OF, NZU,    KZ,  U,   ADD,  DONE, HIGH, QZ,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* |q|^2, two of 3   */ {REG,   QX,    OF, QX,     QY,  QY,  ADD,  KEEP, HIGH, NIL, OTHER},
        /* |q|^2             */ {REG,   QZ,    OF, QZ,     NIL, NIL, LONE, DONE, HIGH, E,   FOLD | WRIST},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* |q|^2 4^j         */ {REG,   E,     BY, FOUR,   NIL, NIL, LONE, DONE, LOW,  NIL, ROOT},
        /* q up              */ {REG,   QX,    BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QXU, OTHER},
        /* q up              */ {REG,   QY,    BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QYU, OTHER},
        /* q up              */ {REG,   QZ,    BY, TWICE,  NIL, NIL, LONE, DONE, LOW,  QZU, OTHER},
        /* 1 / root          */ {TABLE, NIL,   BY, SLOPE,  NIL, NIL, LONE, DONE, MID,  G2,  OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* lb of it          */ {LAST,  NIL,   OF, LB,     NIL, NIL, LONE, DONE, HIGH, F,   OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /*                   */ {PORT,  NIL,   BY, NOUGHT, NIL, NIL, LONE, DONE, HIGH, NIL, OTHER},
        /* tip               */ {LAST,  NIL,   OF, QXU,    X1,  U,   ADD,  DONE, HIGH, X,   HOLD},
        /* tip               */ {REG,   F,     OF, QYU,    Y1,  U,   ADD,  DONE, HIGH, Y,   HOLD},
        /* tip               */ {REG,   F,     OF, QZU,    Z1,  U,   ADD,  DONE, HIGH, Z,   HOLD}};
    engine_program #(.LINES(76), .DRAIN(6), .REGISTER(1), .BITS(47), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(out_op));
    end
    if (PIPE < 0 || PIPE > 2) begin : g_illegal
        engine_delta_program_needs_PIPE_from_0_to_2 rule ();
    end
    endgenerate
endmodule
`default_nettype wire
