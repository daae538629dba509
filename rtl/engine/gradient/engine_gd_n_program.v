// SPDX-License-Identifier: Apache-2.0
// Program of engine_quaternion_gd_n: 11 lines that begin a pass and 30 for a joint, with PIPE 42 and 35; out_op is line
// in_line, a clock later. A line is DEST = A B + C D + E F - G H. Q = (q0, q) is the rotation of all joints before, u =
// target - position of this joint, (ax, ay, az) = STEP(step E). For a joint, (c, s) turns by d = STEP(alpha E . J of
// the pass before) and is normalised; R = Q axis (r0 is that of -R); w = R Q~ is the axis in space; g = w x u is the
// column of J; Q becomes Q (c + s axis); t = q x 2 link, v = link + q0 t + q x t is the link in space; u becomes u - v,
// which is E after the last joint. The d of a joint is formed in the lines of the joint before, so that no line of (c,
// s) waits for it. A register is read from the third line after its writer on, with PIPE from the seventh.
// Model: iterative.space.gd
`default_nettype none
module engine_gd_n_program #(
    parameter PIPE = 0  // 0 or 1 (default 0): the table of engine_gd_n_products with that PIPE
) (
    input  wire        clk,
    input  wire [PIPE == 0 ? 5 : 6:0] in_line,
    output reg  [55:0] out_op
);
    localparam [5:0]  // registers; t shares those of R, Newton's factor that of the square
        tx = 6'd0, ty = 6'd1, tz = 6'd2, al = 6'd3, I1 = 6'd4, I2 = 6'd5, I3 = 6'd6, O = 6'd7, ax = 6'd8, ay = 6'd9,
        az = 6'd10, q0 = 6'd11, q1 = 6'd12, q2 = 6'd13, q3 = 6'd14, r0 = 6'd15, r1 = 6'd16, r2 = 6'd17, r3 = 6'd18,
        wx = 6'd19, wy = 6'd20, wz = 6'd21, ux = 6'd22, uy = 6'd23, uz = 6'd24, vx = 6'd25, vy = 6'd26, vz = 6'd27,
        d = 6'd28, c1 = 6'd29, s1 = 6'd30, nn = 6'd31;
    localparam [5:0]  // words of the joint: axis, twice the link, half-angle, column of J; column of the next joint
        jx = 6'd32, jy = 6'd33, jz = 6'd34, lx = 6'd35, ly = 6'd36, lz = 6'd37, c = 6'd38, s = 6'd39, gx = 6'd40,
        gy = 6'd41, gz = 6'd42, hx = 6'd56, hy = 6'd57, hz = 6'd58;
    localparam [1:0] SUM = 2'd0, ERR = 2'd1, STEP = 2'd2, UNIT = 2'd3;
    localparam [56*41-1:0] LINES = {
        /* a = step E   */ {al, ux,  O,  O,   O,  O,   O,  O,   ax, STEP},
        /*              */ {al, uy,  O,  O,   O,  O,   O,  O,   ay, STEP},
        /*              */ {al, uz,  O,  O,   O,  O,   O,  O,   az, STEP},
        /* Q = 1        */ {I1, I1,  O,  O,   O,  O,   O,  O,   q0, SUM},
        /*              */ {O,  O,   O,  O,   O,  O,   O,  O,   q1, SUM},
        /*              */ {O,  O,   O,  O,   O,  O,   O,  O,   q2, SUM},
        /*              */ {O,  O,   O,  O,   O,  O,   O,  O,   q3, SUM},
        /* next d       */ {ax, hx,  ay, hy,  az, hz,  O,  O,   d,  STEP},
        /* u = target   */ {I1, tx,  O,  O,   O,  O,   O,  O,   ux, SUM},
        /*              */ {I1, ty,  O,  O,   O,  O,   O,  O,   uy, SUM},
        /*              */ {I1, tz,  O,  O,   O,  O,   O,  O,   uz, SUM},
        /* turned c     */ {I1, c,   O,  O,   O,  O,   d,  s,   c1, SUM},
        /* turned s     */ {I1, s,   d,  c,   O,  O,   O,  O,   s1, SUM},
        /* -R           */ {q1, jx,  q2, jy,  q3, jz,  O,  O,   r0, SUM},
        /* R            */ {q0, jx,  q2, jz,  O,  O,   q3, jy,  r1, SUM},
        /* its square   */ {c1, c1,  s1, s1,  O,  O,   O,  O,   nn, UNIT},
        /* R            */ {q0, jy,  q3, jx,  O,  O,   q1, jz,  r2, SUM},
        /* R            */ {q0, jz,  q1, jy,  O,  O,   q2, jx,  r3, SUM},
        /* Newton       */ {I1, I3,  O,  O,   O,  O,   I2, nn,  nn, SUM},
        /* next d       */ {ax, hx,  ay, hy,  az, hz,  O,  O,   d,  STEP},
        /* w            */ {q0, r1,  r0, q1,  r3, q2,  r2, q3,  wx, SUM},
        /* c            */ {nn, c1,  O,  O,   O,  O,   O,  O,   c,  SUM},
        /* s            */ {nn, s1,  O,  O,   O,  O,   O,  O,   s,  SUM},
        /* w            */ {q0, r2,  r0, q2,  r1, q3,  r3, q1,  wy, SUM},
        /*              */ {q0, r3,  r0, q3,  r2, q1,  r1, q2,  wz, SUM},
        /* Q            */ {c,  q2,  s,  r2,  O,  O,   O,  O,   q2, SUM},
        /*              */ {c,  q3,  s,  r3,  O,  O,   O,  O,   q3, SUM},
        /*              */ {c,  q1,  s,  r1,  O,  O,   O,  O,   q1, SUM},
        /*              */ {c,  q0,  O,  O,   O,  O,   s,  r0,  q0, SUM},
        /* t            */ {q2, lz,  O,  O,   O,  O,   q3, ly,  r1, SUM},
        /*              */ {q3, lx,  O,  O,   O,  O,   q1, lz,  r2, SUM},
        /*              */ {q1, ly,  O,  O,   O,  O,   q2, lx,  r3, SUM},
        /* g            */ {wy, uz,  O,  O,   O,  O,   wz, uy,  gx, SUM},
        /*              */ {wz, ux,  O,  O,   O,  O,   wx, uz,  gy, SUM},
        /* v            */ {I2, lx,  q0, r1,  q2, r3,  q3, r2,  vx, SUM},
        /*              */ {I2, ly,  q0, r2,  q3, r1,  q1, r3,  vy, SUM},
        /*              */ {I2, lz,  q0, r3,  q1, r2,  q2, r1,  vz, SUM},
        /* g            */ {wx, uy,  O,  O,   O,  O,   wy, ux,  gz, SUM},
        /* u            */ {I1, ux,  O,  O,   O,  O,   I1, vx,  ux, ERR},
        /*              */ {I1, uy,  O,  O,   O,  O,   I1, vy,  uy, ERR},
        /*              */ {I1, uz,  O,  O,   O,  O,   I1, vz,  uz, ERR}};
    // PIPE = 1: c1, s1, Newton's factor and R of a joint are formed in the lines of the joint before too, those of
    // joint 1 in the lines that begin a pass. Behind the last joint they are of no joint: no line reads them.
    localparam [5:0]  // axis and half-angle of the next joint; what WAIT writes, in the place of v
        kx = 6'd48, ky = 6'd49, kz = 6'd50, hc = 6'd54, hs = 6'd55, nil = 6'd25;
    localparam [55:0] WAIT = {O, O, O, O, O, O, O, O, nil, SUM};
    localparam [56*77-1:0] LINES_1 = {
        /* Q = 1         */ {I1, I1,  O,  O,   O,  O,   O,  O,   q0,  SUM},
        /*               */ {O,  O,   O,  O,   O,  O,   O,  O,   q1,  SUM},
        /*               */ {O,  O,   O,  O,   O,  O,   O,  O,   q2,  SUM},
        /*               */ {O,  O,   O,  O,   O,  O,   O,  O,   q3,  SUM},
        /* a = step E    */ {al, ux,  O,  O,   O,  O,   O,  O,   ax,  STEP},
        /*               */ {al, uy,  O,  O,   O,  O,   O,  O,   ay,  STEP},
        /*               */ {al, uz,  O,  O,   O,  O,   O,  O,   az,  STEP},
        /* u = target    */ {I1, tx,  O,  O,   O,  O,   O,  O,   ux,  SUM},
        /*               */ {I1, ty,  O,  O,   O,  O,   O,  O,   uy,  SUM},
        /*               */ {I1, tz,  O,  O,   O,  O,   O,  O,   uz,  SUM},
        /*               */ WAIT, WAIT, WAIT,
        /* next d        */ {ax, hx,  ay, hy,  az, hz,  O,  O,   d,   STEP},
        /* next -R       */ {q1, kx,  q2, ky,  q3, kz,  O,  O,   r0,  SUM},
        /* next R        */ {q0, kx,  q2, kz,  O,  O,   q3, ky,  r1,  SUM},
        /*               */ {q0, ky,  q3, kx,  O,  O,   q1, kz,  r2,  SUM},
        /*               */ {q0, kz,  q1, ky,  O,  O,   q2, kx,  r3,  SUM},
        /*               */ WAIT, WAIT,
        /* next turned c */ {I1, hc,  O,  O,   O,  O,   d,  hs,  c1,  SUM},
        /* next turned s */ {I1, hs,  d,  hc,  O,  O,   O,  O,   s1,  SUM},
        /*               */ WAIT, WAIT, WAIT, WAIT, WAIT, WAIT,
        /* next square   */ {c1, c1,  s1, s1,  O,  O,   O,  O,   nn,  UNIT},
        /*               */ WAIT, WAIT, WAIT, WAIT, WAIT, WAIT,
        /* next Newton   */ {I1, I3,  O,  O,   O,  O,   I2, nn,  nn,  SUM},
        /*               */ WAIT, WAIT, WAIT, WAIT, WAIT, WAIT,
        /* c             */ {nn, c1,  O,  O,   O,  O,   O,  O,   c,   SUM},
        /* s             */ {nn, s1,  O,  O,   O,  O,   O,  O,   s,   SUM},
        /* next d        */ {ax, hx,  ay, hy,  az, hz,  O,  O,   d,   STEP},
        /*               */ WAIT, WAIT,
        /* w             */ {q0, r1,  r0, q1,  r3, q2,  r2, q3,  wx,  SUM},
        /*               */ {q0, r2,  r0, q2,  r1, q3,  r3, q1,  wy,  SUM},
        /*               */ {q0, r3,  r0, q3,  r2, q1,  r1, q2,  wz,  SUM},
        /* Q             */ {c,  q2,  s,  r2,  O,  O,   O,  O,   q2,  SUM},
        /*               */ {c,  q3,  s,  r3,  O,  O,   O,  O,   q3,  SUM},
        /*               */ {c,  q1,  s,  r1,  O,  O,   O,  O,   q1,  SUM},
        /*               */ {c,  q0,  O,  O,   O,  O,   s,  r0,  q0,  SUM},
        /* next turned c */ {I1, hc,  O,  O,   O,  O,   d,  hs,  c1,  SUM},
        /* next turned s */ {I1, hs,  d,  hc,  O,  O,   O,  O,   s1,  SUM},
        /*               */ WAIT, WAIT,
        /* t             */ {q2, lz,  O,  O,   O,  O,   q3, ly,  r1,  SUM},
        /*               */ {q3, lx,  O,  O,   O,  O,   q1, lz,  r2,  SUM},
        /*               */ {q1, ly,  O,  O,   O,  O,   q2, lx,  r3,  SUM},
        /*               */ WAIT,
        /* next square   */ {c1, c1,  s1, s1,  O,  O,   O,  O,   nn,  UNIT},
        /* g             */ {wy, uz,  O,  O,   O,  O,   wz, uy,  gx,  SUM},
        /*               */ {wz, ux,  O,  O,   O,  O,   wx, uz,  gy,  SUM},
        /*               */ {wx, uy,  O,  O,   O,  O,   wy, ux,  gz,  SUM},
        /* next -R       */ {q1, kx,  q2, ky,  q3, kz,  O,  O,   r0,  SUM},
        /* v             */ {I2, lx,  q0, r1,  q2, r3,  q3, r2,  vx,  SUM},
        /*               */ {I2, ly,  q0, r2,  q3, r1,  q1, r3,  vy,  SUM},
        /*               */ {I2, lz,  q0, r3,  q1, r2,  q2, r1,  vz,  SUM},
        /* next Newton   */ {I1, I3,  O,  O,   O,  O,   I2, nn,  nn,  SUM},
        /* next R        */ {q0, kx,  q2, kz,  O,  O,   q3, ky,  r1,  SUM},
        /*               */ {q0, ky,  q3, kx,  O,  O,   q1, kz,  r2,  SUM},
        /*               */ {q0, kz,  q1, ky,  O,  O,   q2, kx,  r3,  SUM},
        /* u             */ {I1, ux,  O,  O,   O,  O,   I1, vx,  ux,  ERR},
        /*               */ {I1, uy,  O,  O,   O,  O,   I1, vy,  uy,  ERR},
        /*               */ {I1, uz,  O,  O,   O,  O,   I1, vz,  uz,  ERR}};
    localparam COUNT = PIPE == 0 ? 41 : 77, SIZE = PIPE == 0 ? 64 : 128;
    localparam [56*77-1:0] TABLE = PIPE == 0 ? {LINES, {56*36{1'b0}}} : LINES_1;
    reg [55:0] lines[0:SIZE-1];
    integer    i;
    initial
        for (i = 0; i < SIZE; i = i + 1)
            lines[i] = i < COUNT ? TABLE[56*(76-i) +: 56] : 56'd0;
    always @(posedge clk)
        out_op <= lines[in_line];
endmodule
`default_nettype wire
