// SPDX-License-Identifier: Apache-2.0
// Program of engine_quaternion_gd_plane: the table of a link and that of the end of a pass, which overlap. In the clock
// after in_start link 1 begins. With in_last, NEXT starts the end of the pass instead of a link. in_halt, with STOP,
// ends link 1 of the next pass, which has begun. out_op holds the columns of engine_gd_plane_path, of both tables;
// out_link {STORE, PLACE, NEXT, STEP, READ} and out_tail {STOP, GO, FITS, BASE, RANGE} are the last column of each.
// Model: iterative.plane.gd
`default_nettype none
module engine_gd_plane_program #(
    parameter PIPE = 0  // registers behind the products, 0 or 1 (default 0: fewest clocks)
) (
    input  wire       clk,
    input  wire       rst,
    input  wire       in_start,
    input  wire       in_last,
    input  wire       in_halt,
    output wire [8:0] out_op,
    output wire [4:0] out_link,
    output wire [4:0] out_tail
);
    // Schedule, a clock a line
    // A link begins every three clocks, up to three are played at a time: the joint of one moves by what those before
    // it have left of the lever. Behind the last one the error becomes alpha E, and link 1 of the next pass begins.
    localparam [1:0]            // operands of multiplier A
        CHORD  = 2'b00,         // an operand is a chord
        LEFT   = 2'b01,         // y of the link of the pass before, alpha Ex
        GAIN   = 2'b10,         // alpha and an error
        AIM_A  = 2'b11;         // y of the target, alpha Ex
    localparam [1:0]            // operands of multiplier B
        ROOT   = 2'b00,         // a root and the length
        RIGHT  = 2'b01,         // x of the link of the pass before, alpha Ey
        SQUARE = 2'b10,         // an error, twice
        AIM_B  = 2'b11;         // x of the target, alpha Ey
    localparam [4:0]            // sums behind them
        NONE   = 5'b00000,      // nothing
        LESS   = 5'b00001,      // the lever, less a product of B
        MORE   = 5'b00010,      // the lever, and a product of A: what the links from the next one on ask for
        TIP    = 5'b00100,      // the error, less a product
        ADD    = 5'b01000,      // a square is added to the sum
        CLEAR  = 5'b10000;      // sum of squares and lever begin
    localparam [4:0]            // joints, links
        STAY   = 5'b00000,      // nothing
        READ   = 5'b00001,      // read joint and length of the link
        STEP   = 5'b00010,      // the joint moves
        NEXT   = 5'b00100,      // stored; the next link
        PLACE  = 5'b01000,      // the length is wanted later
        STORE  = 5'b10000;      // x and y of the link are stored
    localparam [14*7-1:0] LINK = {
        /* read joint       */ {CHORD, RIGHT, NONE, READ},
        /* step             */ {CHORD, ROOT,  LESS, STEP},
        /* angle            */ {LEFT,  ROOT,  NONE, NEXT},
        /* chord of sine    */ {CHORD, ROOT,  MORE, PLACE},
        /* sine, its chord  */ {CHORD, ROOT,  NONE, STAY},
        /* y; cosine        */ {CHORD, ROOT,  TIP,  STAY},
        /* x                */ {CHORD, ROOT,  TIP,  STORE}};
    localparam [4:0]            // end of a pass
        WAIT   = 5'b00000,      // nothing
        RANGE  = 5'b00001,      // the range that the pass before asks for
        BASE   = 5'b00010,      // the chain is at the base again
        FITS   = 5'b00100,      // does an error fit the fine range?
        GO     = 5'b01000,      // link 1 of the next pass begins
        STOP   = 5'b10000;      // end if converged or at the limit
    localparam [14*8-1:0] TAIL = {
        /* range            */ {CHORD, ROOT,   NONE,       RANGE},
        /* base             */ {CHORD, ROOT,   NONE,       BASE},
        /* -                */ {CHORD, ROOT,   NONE,       WAIT},
        /* Ey there         */ {GAIN,  SQUARE, CLEAR,      FITS},
        /* Ex; alpha Ey     */ {GAIN,  AIM_B,  ADD,        FITS},
        /* alpha Ex         */ {AIM_A, SQUARE, LESS,       GO},
        /* link 1 begins    */ {CHORD, ROOT,   MORE | ADD, WAIT},
        /* stop?            */ {CHORD, ROOT,   NONE,       STOP}};
    // PIPE = 1: a product is used two lines after the one that names its factors, and LEFT is for the next link
    localparam [14*9-1:0] LINK_1 = {
        /* read joint       */ {CHORD, ROOT,  NONE, READ},
        /* step             */ {CHORD, RIGHT, MORE, STEP},
        /* angle            */ {LEFT,  ROOT,  NONE, NEXT},
        /* chord of sine    */ {CHORD, ROOT,  LESS, PLACE},
        /* chord of cosine  */ {CHORD, ROOT,  NONE, STAY},
        /* sine             */ {CHORD, ROOT,  NONE, STAY},
        /* cosine           */ {CHORD, ROOT,  NONE, STAY},
        /* y                */ {CHORD, ROOT,  TIP,  STAY},
        /* x                */ {CHORD, ROOT,  TIP,  STORE}};
    localparam [14*12-1:0] TAIL_1 = {
        /* range            */ {CHORD, ROOT,   NONE,       RANGE},
        /* base             */ {CHORD, ROOT,   NONE,       BASE},
        /* -                */ {CHORD, ROOT,   NONE,       WAIT},
        /* -                */ {CHORD, ROOT,   NONE,       WAIT},
        /* -                */ {CHORD, ROOT,   NONE,       WAIT},
        /* Ey there         */ {GAIN,  SQUARE, CLEAR,      FITS},
        /* Ex there         */ {GAIN,  SQUARE, NONE,       FITS},
        /* Ey^2, alpha Ey   */ {CHORD, AIM_B,  ADD,        WAIT},
        /* Ex^2, alpha Ex   */ {AIM_A, ROOT,   ADD,        WAIT},
        /* link 1           */ {LEFT,  ROOT,   LESS,       GO},
        /* link 1 begins    */ {CHORD, ROOT,   MORE,       WAIT},
        /* stop?            */ {CHORD, ROOT,   NONE,       STOP}};
    localparam LINKS = PIPE == 0 ? 7 : 9, TAILS = PIPE == 0 ? 8 : 12;
    localparam [14*9-1:0]  TABLE_LINK = PIPE == 0 ? {{14*2{1'b0}}, LINK} : LINK_1;
    localparam [14*12-1:0] TABLE_TAIL = PIPE == 0 ? {{14*4{1'b0}}, TAIL} : TAIL_1;
    wire [13:0] link_op, tail_op;
    wire [8:0]  link_path, tail_path;
    wire        next = |(out_link & NEXT), go = |(out_tail & GO);
    /* verilator lint_off UNUSEDSIGNAL */
    wire        unused_link, unused_tail;
    /* verilator lint_on UNUSEDSIGNAL */
    assign      {link_path, out_link} = link_op;
    assign      {tail_path, out_tail} = tail_op;
    assign      out_op = link_path | tail_path;
    schedule #(.LINES(LINKS), .BITS(14), .TABLE(TABLE_LINK[14*LINKS-1:0])) links (.clk(clk), .rst(rst || in_halt),
        .in_start(in_start || (next && !in_last) || go), .out_idle(unused_link), .out_op(link_op));
    schedule #(.LINES(TAILS), .BITS(14), .TABLE(TABLE_TAIL[14*TAILS-1:0])) tail (.clk(clk), .rst(rst),
        .in_start(next && in_last), .out_idle(unused_tail), .out_op(tail_op));
endmodule
`default_nettype wire
