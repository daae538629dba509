// SPDX-License-Identifier: Apache-2.0
// This engine finds two or three joints from the tip by vectorings on one CORDIC. It has no handshake.
// JOINTS = 3: j3 = atan2(y, x), which leaves K rho in x;  then, (K rho, K z) for (x, y), r^2 = x^2 + y^2 (+ z^2):
//   phi = atan2(y, x),  h = atan2(a, b),  d = atan2(f a, b),  a^2 = far - r^2,  b^2 = r^2 - near
//   j2 = 2 h,  j1 = phi - h - d (elbow 1: -2 h, phi + h + d);  far, near = (L1 +- L2)^2,  f = (L2 - L1) / (L1 + L2)
// h is half the elbow (a, b: legs of a right triangle over 2 sqrt(L1 L2)), d follows from the law of tangents.
// A vectoring is that of cordic_aim_iter without MAGNITUDE: micro-rotations i = 0 .. L.
// Formats: coordinates are sW, angles uA, in_f s1.(W+2). Error of an angle at W = A = 16: 1.73e-5 rad + 0.24 rad LSB /
// length a vectoring, and half an LSB.
// The result is valid from the clock after out_done on. out_singular: x = y = 0, and j3 (j1 at the origin) is held.
// Model: classic.ik2, classic.ik3
`default_nettype none
module classic_solve_iter #(
    parameter W        = 16, // bits of a coordinate, 8 to 24 (default 16)
    parameter A        = 16, // bits of an angle, a turn is 2^A, 4 to 24 (default 16)
    parameter JOINTS   = 2,  // 2 (default): in the plane, in_z and out_j3 are not used; 3: in space
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18)
) (
    input  wire                  clk,
    input  wire                  rst,
    input  wire                  in_start,
    input  wire        [2*W+1:0] in_far,
    input  wire        [2*W-1:0] in_near,
    input  wire signed [W+3:0]   in_f,
    input  wire signed [W-1:0]   in_x,
    input  wire signed [W-1:0]   in_y,
    input  wire signed [W-1:0]   in_z,
    input  wire                  in_elbow,
    output wire                  out_busy,
    output wire                  out_done,
    output reg         [A-1:0]   out_j1,
    output reg         [A-1:0]   out_j2,
    output reg         [A-1:0]   out_j3,
    output wire                  out_singular,
    output wire                  out_unreachable
);
    localparam G = 4;            // guard bits of the vectors
    localparam Z = A + 6;        // bits of an angle
    localparam L = W + 1;        // last step: up to C a step is a micro-rotation, then a digit of a division
    localparam C = (W + 1) / 2;
    localparam U = JOINTS == 3 ? C : (W + 1) / 3 + 1;  // last step that changes x; with a yaw as far as rho has bits
    localparam WAIT = JOINTS == 3 ? 0 : 8 - W % 2;  // clocks: the roots need W + 9 or one more, phi alone W + 2

    // Schedule, a clock a line
    localparam [2:0]         // the vectoring; x, y and z are those of cordic_aim_step
        HOLD    = 3'b000,    // the roots are not there yet
        JOIN    = 3'b000,    // the last line
        GROW    = 3'b011,    // micro-rotation
        TURN    = 3'b001,    // what it adds to x is below the last bit
        DIVIDE  = 3'b101;    // the same without the low bits of x
    localparam [2:0]         // at its end
        STAY    = 3'b000,    // it goes on
        TO_PHI  = 3'b001,    // the next one is of (K rho, K z)
        TO_HALF = 3'b010,    // the next one is of (b, a)
        TO_REST = 3'b100;    // the next one is of (b, f a), z goes on
    localparam [1:0]         // squares, in classic_legs
        NONE    = 2'b00,
        ADD     = 2'b01,     // the next square is added: x^2, y^2, z^2
        ASK     = 2'b11;     // the last one is added; the roots begin
    localparam [1:0] FIRST = JOINTS == 3 ? NONE : ADD, LAST = JOINTS == 3 ? NONE : ASK;
    localparam BITS = 8;
    //                                vectoring at its end squares
    localparam [BITS*(L+1)-1:0] YAW = {
        /* j3             */ {        GROW,   STAY,    NONE},
        /* x^2 + y^2      */ {2{      GROW,   STAY,    ADD}},
        /* r^2            */ {        GROW,   STAY,    ASK},
        /* rho grows      */ {(C - 3){GROW,   STAY,    NONE}},
        /* bits of j3     */ {(L - C - 1){DIVIDE, STAY, NONE}},
        /* j3             */ {        DIVIDE, TO_PHI,  NONE}};
    localparam [BITS*(L+1+WAIT)-1:0] PHI = {
        /* phi            */ {        GROW,   STAY,    NONE},
        /* x^2 in a plane */ {        GROW,   STAY,    FIRST},
        /* r^2 in a plane */ {        GROW,   STAY,    LAST},
        /* phi            */ {(U - 2){GROW,   STAY,    NONE}},
        /* x is held */     {(C - U){TURN,   STAY,    NONE}},
        /* last bits      */ {(L - C - 1){DIVIDE, STAY, NONE}},
        /* roots          */ {WAIT{   HOLD,   STAY,    NONE}},
        /* last one       */ {        DIVIDE, TO_HALF, NONE}};
    localparam [BITS*(2*L+3)-1:0] ELBOW = {
        /* h              */ {(U + 1){GROW,   STAY,    NONE}},
        /* x is held */     {(C - U){TURN,   STAY,    NONE}},
        /* last bits      */ {(L - C - 1){DIVIDE, STAY, NONE}},
        /* j2             */ {        DIVIDE, TO_REST, NONE},
        /* h + d          */ {(U + 1){GROW,   STAY,    NONE}},
        /* x is held */     {(C - U){TURN,   STAY,    NONE}},
        /* last bits      */ {(L - C){DIVIDE, STAY,    NONE}},
        /* j1             */ {        JOIN,   STAY,    NONE}};

    wire            idle;
    wire [BITS-1:0] op, unused_ahead;
    generate
        if (JOINTS == 3) begin : g_space
            schedule_counter #(.LINES(4*L+5), .BITS(BITS), .TABLE({YAW, PHI, ELBOW})) control (.clk(clk), .rst(rst),
                .in_start(in_start), .out_idle(idle), .out_last(out_done), .out_ahead(unused_ahead), .out_op(op));
        end else begin : g_plane
            schedule_counter #(.LINES(3*L+4+WAIT), .BITS(BITS), .TABLE({PHI, ELBOW})) control (.clk(clk), .rst(rst),
                .in_start(in_start), .out_idle(idle), .out_last(out_done), .out_ahead(unused_ahead), .out_op(op));
        end
    endgenerate
    wire divide, grow, turn, to_rest, to_half, to_phi, ask, add;
    assign {divide, grow, turn, to_rest, to_half, to_phi, ask, add} = op;
    assign out_busy = !idle;

    wire        [W+G:0] a, b;
    wire signed [W+7:0] product;
    classic_legs #(.W(W), .JOINTS(JOINTS), .MULTIPLY(MULTIPLY)) legs (.clk(clk), .rst(rst), .in_start(in_start),
        .in_far(in_far), .in_near(in_near), .in_f(in_f), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_add(add),
        .in_ask(ask), .in_taken(to_phi), .out_a(a), .out_b(b), .out_product(product),
        .out_unreachable(out_unreachable));

    wire [Z-1:0] z, next_z, joint1;
    classic_aim_iter #(.W(W), .A(A), .JOINTS(JOINTS)) aim (.clk(clk), .in_start(in_start), .in_x(in_x), .in_y(in_y),
        .in_elbow(in_elbow), .in_a(a), .in_b(b), .in_product(product), .in_turn(turn), .in_grow(grow),
        .in_divide(divide), .in_to_phi(to_phi), .in_to_half(to_half), .in_to_rest(to_rest), .out_z(z),
        .out_next(next_z));

    // joints
    reg  [Z-1:0] phi;
    reg          axis, origin;
    wire         unused = &{1'b0, joint1};
    assign joint1 = phi + z;
    assign out_singular = axis;
    always @(posedge clk) begin
        if (in_start) axis <= {in_x, in_y} == {2*W{1'b0}};
        if (in_start) origin <= {in_x, in_y, in_z} == {3*W{1'b0}};
        if (to_half) phi <= next_z;
        if (rst) {out_j1, out_j2, out_j3} <= {3*A{1'b0}};
        else begin
            if (to_phi && !axis) out_j3 <= next_z[Z-1:6];
            if (to_rest) out_j2 <= ~next_z[Z-2:5];
            if (out_done && !origin) out_j1 <= joint1[Z-1:6];
        end
    end
endmodule
`default_nettype wire
