// SPDX-License-Identifier: Apache-2.0
// Program of engine_rus_fk: out_op is line in_line, a clock later; engine_rus_fk_steps selects the next line. A line is
// DEST = A B + C D, or with SUB or SUBK A B - C D. After KEEP or SUBK the next line continues this sum. A register is
// kind 16 + word; kinds are named below. It may be read from line 4 + PIPE after its writer on; in section PAIR the
// first two lines read the old value of t. ACT: NONE; MISS and UNIT test the miss of a rod and of the quaternion's
// length; SCALE replaces constant I4 by I4, I1 or nearly 2, by the range of |row|^2 that RANGE measured; the sign of a
// SIDE word is one of two that tell the side of the singularities; JUMP increments j. With LOOSE, RANGE, SIDE the word
// may overflow. Model: engine_rus_fk.fk
`default_nettype none
module engine_rus_fk_program #(
    parameter PIPE = 0  // registers of engine_rus_fk_products, for which lines wait, 0 or 1 (default 0)
) (
    input  wire        clk,
    input  wire [7:0]  in_line,
    output reg  [39:0] out_op
);
    localparam [6:0]  // page 0: start and link angle
        gw = 7'd0, gx = 7'd1, gy = 7'd2, gz = 7'd3, gpx = 7'd4, gpy = 7'd5, gpz = 7'd6, cb = 7'd7, nb = 7'd8;
    localparam [6:0]  // page 7: the pose and its matrix
        w = 7'd16, x = 7'd17, y = 7'd18, z = 7'd19, px = 7'd20, py = 7'd21, pz = 7'd22, r11 = 7'd23, r12 = 7'd24,
        r13 = 7'd25, r21 = 7'd26, r22 = 7'd27, r23 = 7'd28, r31 = 7'd29, r32 = 7'd30, r33 = 7'd31;
    localparam [6:0]  // page 8: constants, and words that are soon read
        I4 = 7'd32, I2 = 7'd33, I1 = 7'd34, O = 7'd36, I3 = 7'd37, P0 = 7'd38, P1 = 7'd39, P2 = 7'd40, v1 = 7'd41,
        v2 = 7'd42, v3 = 7'd43, qw = 7'd44, qx = 7'd45, qy = 7'd46, nil = 7'd47;
    localparam [6:0]  // page 15: the step, and words that are soon read
        s1 = 7'd48, s2 = 7'd49, s3 = 7'd50, s4 = 7'd51, s5 = 7'd52, s6 = 7'd53, t = 7'd54, nn = 7'd55, e1 = 7'd56,
        e2 = 7'd57, e3 = 7'd58, qz = 7'd59, ff = 7'd60;
    localparam [6:0]  // page i: leg i, its elbow
        c1 = 7'd64, c2 = 7'd65, c3 = 7'd66, fx = 7'd67, fy = 7'd68, fz = 7'd69, rx = 7'd70, rz = 7'd71, link = 7'd72,
        la = 7'd73, lb = 7'd74, c = 7'd75, n = 7'd76, bx = 7'd77, by = 7'd78, bz = 7'd79;
    localparam [6:0]  // page 8 + i: row i, its miss, and what belongs to it
        R1 = 7'd80, R2 = 7'd81, R3 = 7'd82, R4 = 7'd83, R5 = 7'd84, R6 = 7'd85, R7 = 7'd86, ss = 7'd87, h = 7'd88,
        g = 7'd89, gg = 7'd90, f = 7'd91, ax = 7'd92, ay = 7'd93, az = 7'd94;
    localparam [6:0]  // page 8 + j: row j
        J1 = 7'd96, J2 = 7'd97, J3 = 7'd98, J4 = 7'd99, J5 = 7'd100, J6 = 7'd101, J7 = 7'd102;
    localparam [6:0]  // page 9 + j: the row after it
        K1 = 7'd112, K2 = 7'd113, K3 = 7'd114, K4 = 7'd115, K5 = 7'd116, K6 = 7'd117;
    localparam [1:0] ADD = 2'd0, KEEP = 2'd1, SUB = 2'd2, SUBK = 2'd3;
    localparam [2:0] NONE = 3'd0, MISS = 3'd1, UNIT = 3'd2, SCALE = 3'd3, LOOSE = 3'd4, RANGE = 3'd5, SIDE = 3'd6,
                     JUMP = 3'd7;
    localparam [39:0] NOP = {O, O, O, O, nil, ADD, LOOSE};
    localparam [39:0] NEXT = {O, O, O, O, nil, ADD, JUMP};
    localparam         COUNT = 192 + 25 * PIPE;  // number of lines
    localparam [40*COUNT-1:0] LINES = {
        /* ELBOW: elbow      */ {la,  c,  link, cb, ss,   ADD,  NONE},
        /*                   */ {la,  n,  link, nb, nil, KEEP, LOOSE},
        /*                   */ {I1,  fy, O,    O,  by,  ADD,  NONE},
        /*                   */ NOP, {PIPE{NOP}},
        /*                   */ {I1,  fx, ss,   rx, bx,  ADD,  NONE},
        /*                   */ {I1,  fz, ss,   rz, bz,  ADD,  NONE},
        /* COPY: start       */ {gw,  I1, O,    O,  w,   ADD,  NONE},
        /*                   */ {gx,  I1, O,    O,  x,   ADD,  NONE},
        /*                   */ {gy,  I1, O,    O,  y,   ADD,  NONE},
        /*                   */ {gz,  I1, O,    O,  z,   ADD,  NONE},
        /*                   */ {gpx, I1, O,    O,  px,  ADD,  NONE},
        /*                   */ {gpy, I1, O,    O,  py,  ADD,  NONE},
        /*                   */ {gpz, I1, O,    O,  pz,  ADD,  NONE},
        /* TURN: |q|^2 - 1   */ {w,   w,  x,    x,  nil, KEEP, LOOSE},
        /*                   */ {y,   y,  z,    z,  nil, KEEP, LOOSE},
        /*                   */ {O,   O,  I1,   I1, nil, SUB,  UNIT},
        /* R                 */ {w,   w,  y,    y,  nil, SUBK, LOOSE},
        /*                   */ {x,   x,  z,    z,  r11, SUB,  NONE},
        /*                   */ {x,   y,  w,    z,  nil, SUBK, LOOSE},
        /*                   */ {x,   y,  w,    z,  r12, SUB,  NONE},
        /*                   */ {x,   z,  w,    y,  nil, KEEP, LOOSE},
        /*                   */ {x,   z,  w,    y,  r13, ADD,  NONE},
        /*                   */ {x,   y,  w,    z,  nil, KEEP, LOOSE},
        /*                   */ {x,   y,  w,    z,  r21, ADD,  NONE},
        /*                   */ {w,   w,  x,    x,  nil, SUBK, LOOSE},
        /*                   */ {y,   y,  z,    z,  r22, SUB,  NONE},
        /*                   */ {y,   z,  w,    x,  nil, SUBK, LOOSE},
        /*                   */ {y,   z,  w,    x,  r23, SUB,  NONE},
        /*                   */ {x,   z,  w,    y,  nil, SUBK, LOOSE},
        /*                   */ {x,   z,  w,    y,  r31, SUB,  NONE},
        /*                   */ {y,   z,  w,    x,  nil, KEEP, LOOSE},
        /*                   */ {y,   z,  w,    x,  r32, ADD,  NONE},
        /*                   */ {w,   w,  x,    x,  nil, SUBK, LOOSE},
        /*                   */ {z,   z,  y,    y,  r33, SUB,  NONE},
        /* step = 0          */ {O,   O,  O,    O,  s1,  ADD,  NONE},
        /*                   */ {O,   O,  O,    O,  s2,  ADD,  NONE},
        /*                   */ {O,   O,  O,    O,  s3,  ADD,  NONE},
        /*                   */ {O,   O,  O,    O,  s4,  ADD,  NONE},
        /*                   */ {O,   O,  O,    O,  s5,  ADD,  NONE},
        /*                   */ {O,   O,  O,    O,  s6,  ADD,  NONE},
        /* LEG: R c, d       */ {r11, c1, r12,  c2, nil, KEEP, LOOSE},
        /*                   */ {r13, c3, O,    O,  ax,  KEEP, NONE},
        /*                   */ {px,  I1, bx,   I1, R1,  SUB,  NONE},
        /*                   */ {r21, c1, r22,  c2, nil, KEEP, LOOSE},
        /*                   */ {r23, c3, O,    O,  ay,  KEEP, NONE},
        /*                   */ {py,  I1, by,   I1, R2,  SUB,  NONE},
        /*                   */ {r31, c1, r32,  c2, nil, KEEP, LOOSE},
        /*                   */ {r33, c3, O,    O,  az,  KEEP, NONE},
        /*                   */ {pz,  I1, bz,   I1, R3,  SUB,  NONE},
        /*                   */ {PIPE{NOP}},
        /* R c x d           */ {ax,  R2, ay,   R1, R6,  SUB,  NONE},
        /*                   */ NOP, NOP,
        /*                   */ {ay,  R3, az,   R2, R4,  SUB,  NONE},
        /*                   */ {az,  R1, ax,   R3, R5,  SUB,  NONE},
        /* miss              */ {R1,  R1, R2,   R2, nil, KEEP, LOOSE},
        /*                   */ {R3,  R3, lb,   lb, R7,  SUB,  MISS},
        /* JUDGE             */ NOP, NOP, NOP, NOP, {3 * PIPE{NOP}},
        /* NORM: |row|^2     */ {R1,  R1, R2,   R2, nil, KEEP, LOOSE},
        /*                   */ {R3,  R3, R4,   R4, nil, KEEP, LOOSE},
        /*                   */ {R5,  R5, R6,   R6, ss,  ADD,  RANGE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /* 1 / 2|row|        */ {P2,  ss, P1,   I1, g,   ADD,  LOOSE},
        /*                   */ {2 * PIPE{NOP}},
        /*                   */ {ss,  I1, ss,   I1, h,   ADD,  NONE},
        /*                   */ NOP, NOP,
        /*                   */ {g,   ss, P0,   I1, g,   ADD,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /* Newton            */ {g,   g,  O,    O,  gg,  ADD,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /*                   */ {I3,  I1, gg,   h,  f,   SUB,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /*                   */ {g,   f,  O,    O,  g,   ADD,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /* Newton            */ {g,   g,  O,    O,  gg,  ADD,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /*                   */ {I3,  I1, gg,   h,  f,   SUB,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /*                   */ {g,   f,  O,    O,  g,   ADD,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /* unit row          */ {R7,  g,  R7,   g,  R7,  ADD,  NONE},
        /*                   */ {R1,  g,  R1,   g,  R1,  ADD,  NONE},
        /*                   */ {R2,  g,  R2,   g,  R2,  ADD,  NONE},
        /*                   */ {R3,  g,  R3,   g,  R3,  ADD,  NONE},
        /*                   */ {R4,  g,  R4,   g,  R4,  ADD,  NONE},
        /*                   */ {R5,  g,  R5,   g,  R5,  ADD,  NONE},
        /*                   */ {R6,  g,  R6,   g,  R6,  ADD,  NONE},
        /* step              */ {s1,  I1, R7,   R1, s1,  SUB,  NONE},
        /*                   */ {s2,  I1, R7,   R2, s2,  SUB,  NONE},
        /*                   */ {s3,  I1, R7,   R3, s3,  SUB,  NONE},
        /*                   */ {s4,  I1, R7,   R4, s4,  SUB,  NONE},
        /*                   */ {s5,  I1, R7,   R5, s5,  SUB,  NONE},
        /*                   */ {s6,  I1, R7,   R6, s6,  SUB,  NONE},
        /* DOT: along        */ {R1,  J1, R2,   J2, nil, KEEP, LOOSE},
        /*                   */ {R3,  J3, R4,   J4, nil, KEEP, LOOSE},
        /*                   */ {R5,  J5, R6,   J6, t,   ADD,  LOOSE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /* PAIR: less that   */ {J1,  I1, t,    R1, J1,  SUB,  NONE},
        /*                   */ {J2,  I1, t,    R2, J2,  SUB,  NONE},
        /*                   */ {J3,  I1, t,    R3, J3,  SUB,  NONE},
        /*                   */ {J4,  I1, t,    R4, J4,  SUB,  NONE},
        /*                   */ {J5,  I1, t,    R5, J5,  SUB,  NONE},
        /* next along        */ {R1,  K1, R2,   K2, nil, KEEP, LOOSE},
        /*                   */ {R3,  K3, R4,   K4, nil, KEEP, LOOSE},
        /*                   */ {R5,  K5, R6,   K6, t,   ADD,  LOOSE},
        /*                   */ {J6,  I1, t,    R6, J6,  SUB,  NONE},
        /*                   */ {J7,  I1, t,    R7, J7,  SUB,  NONE},
        /*                   */ NOP, {PIPE{NOP}},
        /* SCALE: row        */ {R1,  I4, R1,   I4, R1,  ADD,  SCALE},
        /*                   */ {R2,  I4, R2,   I4, R2,  ADD,  SCALE},
        /*                   */ {R3,  I4, R3,   I4, R3,  ADD,  SCALE},
        /*                   */ {R4,  I4, R4,   I4, R4,  ADD,  SCALE},
        /*                   */ {R5,  I4, R5,   I4, R5,  ADD,  SCALE},
        /*                   */ {R6,  I4, R6,   I4, R6,  ADD,  SCALE},
        /*                   */ {R7,  I4, R7,   I4, R7,  ADD,  SCALE},
        /*                   */ {PIPE{NOP}},
        /* SIDE: rows 1, 2   */ {J2,  K3, J3,   K2, e1,  SUB,  NONE},
        /*                   */ {J3,  K1, J1,   K3, e2,  SUB,  NONE},
        /*                   */ {J1,  K2, J2,   K1, e3,  SUB,  NONE},
        /*                   */ NEXT, NOP, {PIPE{NOP}},
        /* and 3             */ {e1,  K1, e2,   K2, nil, KEEP, LOOSE},
        /*                   */ {e3,  K3, O,    O,  nil, ADD,  SIDE},
        /*                   */ NEXT,
        /* rows 4, 6         */ {K5,  R6, K6,   R5, e1,  SUB,  NONE},
        /*                   */ {K6,  R4, K4,   R6, e2,  SUB,  NONE},
        /*                   */ {K4,  R5, K5,   R4, e3,  SUB,  NONE},
        /*                   */ NEXT, NOP, {PIPE{NOP}},
        /* and 5             */ {e1,  K4, e2,   K5, nil, KEEP, LOOSE},
        /*                   */ {e3,  K6, O,    O,  nil, ADD,  SIDE},
        /* MOVE: turn        */ {O,   O,  s4,   I4, v1,  SUB,  NONE},
        /*                   */ {O,   O,  s5,   I4, v2,  SUB,  NONE},
        /*                   */ {O,   O,  s6,   I4, v3,  SUB,  NONE},
        /* place             */ {px,  I1, s1,   I2, px,  ADD,  NONE},
        /*                   */ {py,  I1, s2,   I2, py,  ADD,  NONE},
        /*                   */ {pz,  I1, s3,   I2, pz,  ADD,  NONE},
        /* q                 */ {w,   I1, v1,   x,  nil, KEEP, LOOSE},
        /*                   */ {v2,  y,  v3,   z,  qw,  ADD,  NONE},
        /*                   */ {x,   I1, v1,   w,  nil, SUBK, LOOSE},
        /*                   */ {v3,  y,  v2,   z,  qx,  SUB,  NONE},
        /*                   */ {y,   I1, v2,   w,  nil, SUBK, LOOSE},
        /*                   */ {v1,  z,  v3,   x,  qy,  SUB,  NONE},
        /*                   */ {z,   I1, v3,   w,  nil, SUBK, LOOSE},
        /*                   */ {v2,  x,  v1,   y,  qz,  SUB,  NONE},
        /*                   */ NOP, NOP, {PIPE{NOP}},
        /* |q|^2             */ {qw,  qw, qx,   qx, nil, KEEP, LOOSE},
        /*                   */ {qy,  qy, qz,   qz, nn,  ADD,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /* Newton            */ {I3,  I1, nn,   I2, ff,  SUB,  NONE},
        /*                   */ NOP, NOP, NOP, {PIPE{NOP}},
        /*                   */ {qw,  ff, O,    O,  w,   ADD,  NONE},
        /*                   */ {qx,  ff, O,    O,  x,   ADD,  NONE},
        /*                   */ {qy,  ff, O,    O,  y,   ADD,  NONE},
        /*                   */ {qz,  ff, O,    O,  z,   ADD,  NONE},
        /*                   */ NOP, NOP, NOP,
        /* DONE: pose        */ {w,   I1, O,    O,  gw,  ADD,  NONE},
        /*                   */ {x,   I1, O,    O,  gx,  ADD,  NONE},
        /*                   */ {y,   I1, O,    O,  gy,  ADD,  NONE},
        /*                   */ {z,   I1, O,    O,  gz,  ADD,  NONE},
        /*                   */ {px,  I1, O,    O,  gpx, ADD,  NONE},
        /*                   */ {py,  I1, O,    O,  gpy, ADD,  NONE},
        /*                   */ {pz,  I1, O,    O,  gpz, ADD,  NONE},
        /*                   */ NOP, NOP, NOP, {2 * PIPE{NOP}}};
    reg [39:0] lines[0:255];
    integer    i;
    initial
        for (i = 0; i < 256; i = i + 1)
            lines[i] = i < COUNT ? LINES[40*(COUNT-1-i) +: 40] : 40'd0;
    always @(posedge clk)
        out_op <= lines[in_line];
endmodule
`default_nettype wire
