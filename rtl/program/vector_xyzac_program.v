// SPDX-License-Identifier: Apache-2.0
// Assembled from vector_xyzac.kin by `quadrance assemble`; do not edit.
//   Axes of a machine tool from a point of its workpiece: a table that turns about z on one that tilts about x
// Line: word = A * B [+- C * D], DEST, and what else is done with it; one line a clock. I_ begins the name of an input;
// a word of capitals and a small letter is one that the assembler has added.
// Latency of a core that plays it: 21 at PIPE 0, 22 at PIPE 1, 24 at PIPE 2. Model: quadrance.program.meaning
`default_nettype none
module vector_xyzac_program #(
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
        X = 6'd2, Y = 6'd3, Z = 6'd4, NC = 6'd5, AX = 6'd6, AY = 6'd7, AZ = 6'd8, T = 6'd9, NA = 6'd10,
        CA = 6'd11;
    localparam [5:0]
        I_CA = 6'd0, I_NA = 6'd1, I_CC = 6'd2, I_NC = 6'd3, I_PX = 6'd4, I_PY = 6'd5, I_PZ = 6'd6, I_XR = 6'd7,
        I_YR = 6'd8, I_D = 6'd9, I_ZS = 6'd10;
    localparam [17*36-1:0] LINES = {
    /* nc                 */ {PORT, I_NC, BY, PLUS,  NIL, NIL, LONE, DONE, NC},
    /* ax: px             */ {PORT, I_PX, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* ax = .. - xr       */ {PORT, I_XR, BY, MINUS, NIL, NIL, LONE, DONE, AX},
    /* ay: py             */ {PORT, I_PY, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* ay = .. - yr       */ {PORT, I_YR, BY, MINUS, NIL, NIL, LONE, DONE, AY},
    /* az: pz             */ {PORT, I_PZ, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* az = .. - zs       */ {PORT, I_ZS, BY, MINUS, NIL, NIL, LONE, DONE, AZ},
    /* t: -d + nc*ax      */ {PORT, I_D,  BY, MINUS, NC,  AX,  ADD,  KEEP, NIL},
    /* t = .. + cc*ay     */ {PORT, I_CC, OF, AY,    NIL, NIL, LONE, DONE, T},
    /* na                 */ {PORT, I_NA, BY, PLUS,  NIL, NIL, LONE, DONE, NA},
    /* ca                 */ {PORT, I_CA, BY, PLUS,  NIL, NIL, LONE, DONE, CA},
    /* x: xr - nc*ay      */ {PORT, I_XR, BY, PLUS,  NC,  AY,  SUB,  KEEP, NIL},
    /* x = .. + cc*ax     */ {PORT, I_CC, OF, AX,    NIL, NIL, LONE, DONE, X},
    /* z: zs + na*t       */ {PORT, I_ZS, BY, PLUS,  NA,  T,   ADD,  KEEP, NIL},
    /* z = .. + ca*az     */ {REG,  CA,   OF, AZ,    NIL, NIL, LONE, DONE, Z},
    /* y: d - na*az       */ {PORT, I_D,  BY, PLUS,  NA,  AZ,  SUB,  KEEP, NIL},
    /* y = .. + yr + ca*t */ {PORT, I_YR, BY, PLUS,  CA,  T,   ADD,  DONE, Y}};
    wire [35:0] op;
    engine_program #(.LINES(17), .BITS(36), .TABLE(LINES)) control (
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
        X = 6'd2, Y = 6'd3, Z = 6'd4, NC = 6'd5, AX = 6'd6, AY = 6'd7, AZ = 6'd8, T = 6'd9, NA = 6'd10,
        CA = 6'd11;
    localparam [5:0]
        I_CA = 6'd0, I_NA = 6'd1, I_CC = 6'd2, I_NC = 6'd3, I_PX = 6'd4, I_PY = 6'd5, I_PZ = 6'd6, I_XR = 6'd7,
        I_YR = 6'd8, I_D = 6'd9, I_ZS = 6'd10;
    localparam [17*36-1:0] LINES = {
    /* nc                 */ {PORT, I_NC, BY, PLUS,  NIL, NIL, LONE, DONE, NC},
    /* ax: px             */ {PORT, I_PX, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* ax = .. - xr       */ {PORT, I_XR, BY, MINUS, NIL, NIL, LONE, DONE, AX},
    /* ay: py             */ {PORT, I_PY, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* ay = .. - yr       */ {PORT, I_YR, BY, MINUS, NIL, NIL, LONE, DONE, AY},
    /* az: pz             */ {PORT, I_PZ, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* az = .. - zs       */ {PORT, I_ZS, BY, MINUS, NIL, NIL, LONE, DONE, AZ},
    /* t: -d + nc*ax      */ {PORT, I_D,  BY, MINUS, NC,  AX,  ADD,  KEEP, NIL},
    /* t = .. + cc*ay     */ {PORT, I_CC, OF, AY,    NIL, NIL, LONE, DONE, T},
    /* na                 */ {PORT, I_NA, BY, PLUS,  NIL, NIL, LONE, DONE, NA},
    /* ca                 */ {PORT, I_CA, BY, PLUS,  NIL, NIL, LONE, DONE, CA},
    /* x: xr - nc*ay      */ {PORT, I_XR, BY, PLUS,  NC,  AY,  SUB,  KEEP, NIL},
    /* x = .. + cc*ax     */ {PORT, I_CC, OF, AX,    NIL, NIL, LONE, DONE, X},
    /* y: d - na*az       */ {PORT, I_D,  BY, PLUS,  NA,  AZ,  SUB,  KEEP, NIL},
    /* y = .. + yr + ca*t */ {PORT, I_YR, BY, PLUS,  CA,  T,   ADD,  DONE, Y},
    /* z: zs + na*t       */ {PORT, I_ZS, BY, PLUS,  NA,  T,   ADD,  KEEP, NIL},
    /* z = .. + ca*az     */ {REG,  CA,   OF, AZ,    NIL, NIL, LONE, DONE, Z}};
    wire [35:0] op;
    engine_program #(.LINES(17), .DRAIN(4), .BITS(36), .TABLE(LINES)) control (
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
        X = 6'd2, Y = 6'd3, Z = 6'd4, NC = 6'd5, AX = 6'd6, AY = 6'd7, AZ = 6'd8, T = 6'd9, NA = 6'd10,
        CA = 6'd11;
    localparam [5:0]
        I_CA = 6'd0, I_NA = 6'd1, I_CC = 6'd2, I_NC = 6'd3, I_PX = 6'd4, I_PY = 6'd5, I_PZ = 6'd6, I_XR = 6'd7,
        I_YR = 6'd8, I_D = 6'd9, I_ZS = 6'd10;
    localparam [17*36-1:0] LINES = {
    /* nc                 */ {PORT, I_NC, BY, PLUS,  NIL, NIL, LONE, DONE, NC},
    /* ax: px             */ {PORT, I_PX, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* ax = .. - xr       */ {PORT, I_XR, BY, MINUS, NIL, NIL, LONE, DONE, AX},
    /* ay: py             */ {PORT, I_PY, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* ay = .. - yr       */ {PORT, I_YR, BY, MINUS, NIL, NIL, LONE, DONE, AY},
    /* az: pz             */ {PORT, I_PZ, BY, PLUS,  NIL, NIL, LONE, KEEP, NIL},
    /* az = .. - zs       */ {PORT, I_ZS, BY, MINUS, NIL, NIL, LONE, DONE, AZ},
    /* t: -d + nc*ax      */ {PORT, I_D,  BY, MINUS, NC,  AX,  ADD,  KEEP, NIL},
    /* t = .. + cc*ay     */ {PORT, I_CC, OF, AY,    NIL, NIL, LONE, DONE, T},
    /* na                 */ {PORT, I_NA, BY, PLUS,  NIL, NIL, LONE, DONE, NA},
    /* ca                 */ {PORT, I_CA, BY, PLUS,  NIL, NIL, LONE, DONE, CA},
    /* x: xr - nc*ay      */ {PORT, I_XR, BY, PLUS,  NC,  AY,  SUB,  KEEP, NIL},
    /* x = .. + cc*ax     */ {PORT, I_CC, OF, AX,    NIL, NIL, LONE, DONE, X},
    /* z: zs + na*t       */ {PORT, I_ZS, BY, PLUS,  NA,  T,   ADD,  KEEP, NIL},
    /* z = .. + ca*az     */ {REG,  CA,   OF, AZ,    NIL, NIL, LONE, DONE, Z},
    /* y: d - na*az       */ {PORT, I_D,  BY, PLUS,  NA,  AZ,  SUB,  KEEP, NIL},
    /* y = .. + yr + ca*t */ {PORT, I_YR, BY, PLUS,  CA,  T,   ADD,  DONE, Y}};
    wire [35:0] op;
    engine_program #(.LINES(17), .DRAIN(6), .REGISTER(1), .BITS(36), .TABLE(LINES)) control (
        .clk(clk), .rst(rst), .in_start(in_start), .out_idle(out_idle), .out_done(out_done), .out_op(op));
    assign out_op = {op[35:6], 2'b00, op[5:0], 9'd0};
    end
    if (PIPE != 0 && PIPE != 1 && PIPE != 2) begin : g_illegal
        vector_xyzac_program_needs_PIPE_0_or_1_or_2 rule ();
    end
    endgenerate
endmodule
`default_nettype wire
