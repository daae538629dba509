// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints in the plane by quaternion gradient descent: theta <- theta + alpha E J, with the
// error E of the tip and the Jacobian J. It stops when |E|^2 < cfg_tol, or after cfg_limit steps.
// Formats: in_j1, in_j2, out_j1, out_j2 angle of A bits, joint 2 relative to link 1; in_x, in_y sQ(W-F).F; cfg_l1,
// cfg_l2 uQ(W-F).F; cfg_alpha, cfg_shift by iterative.fixed.config; cfg_tol, out_error in 1/256 LSB^2, with out_coarse
// in LSB^2; out_d1, out_d2 sA: the last step moved joint 1 by their sum, joint 2 by out_d2. in_warm: start from the
// last answer, 0 after reset, not from in_j1, in_j2.
// Error: a converged tip is within sqrt(out_error + 2) / 16 + 0.05 + 3.0 (L1 + L2) / 2^(W+1) LSB, lengths in LSB.
// Latency 12 + 4 PIPE a pass less 1 + PIPE, II the same. Passes: out_iters + 1, and those that only change the range.
// Status: not converged (the limit was reached: out of reach, alpha too large, or a start along the arm).
// Source: quaternion gradient paper, eqs. 18, 25, 31. Model: iterative.fixed.gd
`default_nettype none
module engine_quaternion_gd #(
    parameter W = 16,  // bits of a coordinate and of a length, 14 to 20 (default 16)
    parameter F = 8,   // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 24,  // bits of a joint word, 16 to 24 (default 24, 0.006 LSB at 2^14 LSB); a full turn is 2^A
    parameter PIPE = 0 // registers behind the products, 0 or 1 (default 0: fewest clocks); 1: a faster clock
) (
    input  wire           clk,
    input  wire           rst,
    input  wire [W-1:0]   cfg_l1,
    input  wire [W-1:0]   cfg_l2,
    input  wire [W:0]     cfg_alpha,
    input  wire           cfg_shift,
    input  wire [21:0]    cfg_tol,
    input  wire [9:0]     cfg_limit,
    input  wire           in_valid,
    output wire           in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire [A-1:0]   in_j1,
    input  wire [A-1:0]   in_j2,
    input  wire           in_warm,
    output wire           out_valid,
    input  wire           out_ready,
    output wire [A-1:0]   out_j1,
    output wire [A-1:0]   out_j2,
    output wire [9:0]     out_iters,
    output wire [2*W-1:0] out_error,
    output wire           out_coarse,
    output reg  signed [A-1:0] out_d1,
    output reg  signed [A-1:0] out_d2,
    output wire [3:0]     out_status
);
    generate
        if (W < 14 || W > 20 || F < 0 || F >= W || A < 16 || A > 24 || PIPE < 0 || PIPE > 1) begin : g_illegal
            engine_quaternion_gd_needs_W_from_14_to_20_and_F_below_W_and_A_from_16_to_24_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    // Schedule, a clock a line
    localparam [1:0]            // operands of the two multipliers
        NONE   = 2'b00,         // nothing
        CHORD  = 2'b00,         // a chord, and the root of the one before
        LINK1  = 2'b01,         // of link 1 and alpha E
        LINK2  = 2'b10,         // of link 2 and alpha E
        ERROR  = 2'b11;         // alpha and an error, and its square
    localparam [1:0]            // right operand of the second
        L1     = 2'b00,         // length of link 1
        L2     = 2'b01,         // length of link 2
        E      = 2'b10,         // an error
        ALPHA  = 2'b11;         // alpha times the error of y
    localparam [9:0]            // the rest
        COS    = 10'h001,       // read the cosine of joint 1
        SIN    = 10'h000,       // read the sine of joint 1
        COS12  = 10'h003,       // read the cosine of both joints: COS and SIN12
        SIN12  = 10'h002,       // read the sine of both joints
        X      = 10'h004,       // x, less a product
        Y      = 10'h008,       // y, less a product
        TIP    = 10'h010,       // the error, less a product
        CLEAR  = 10'h020,       // the squares begin
        SQUARE = 10'h040,       // a square is added to the sum
        STOP   = 10'h080,       // stop here if converged or at the limit
        MOVE1  = 10'h100,       // joint 1 by what its own link asks for
        MOVE2  = 10'h200;       // with MOVE1: both by what link 2 asks for
    localparam [14*12-1:0] PASS = {
        /* read c1         */ {NONE,  L1,    COS},
        /* read s1         */ {CHORD, L1,    SIN},
        /* read c12; c1    */ {CHORD, L1,    COS12},
        /* read s12; L1 c1 */ {CHORD, L1,    SIN12 | X},
        /* L1 s1           */ {CHORD, L2,    Y},
        /* L2 c12: Ex      */ {CHORD, L2,    TIP},
        /* L2 s12: Ey      */ {ERROR, E,     TIP | CLEAR},
        /* Ex^2, alpha Ex  */ {ERROR, E,     SQUARE},
        /* Ey^2, alpha Ey  */ {LINK1, ALPHA, SQUARE},
        /* e1; stop?       */ {LINK2, ALPHA, STOP},
        /* e2              */ {NONE,  L1,    MOVE1},
        /* joints          */ {NONE,  L1,    MOVE1 | MOVE2}};
    // PIPE = 1: a product is used two lines after the one that names its factors
    localparam [14*16-1:0] PASS_1 = {
        /* read c1         */ {NONE,  L1,    COS},
        /* read s1         */ {CHORD, L1,    SIN},
        /* read c12        */ {CHORD, L1,    COS12},
        /* read s12; c1    */ {CHORD, L1,    SIN12},
        /* s1              */ {CHORD, L1,    SIN},
        /* c12; L1 c1      */ {CHORD, L2,    X},
        /* s12; L1 s1      */ {CHORD, L2,    Y},
        /* L2 c12: Ex      */ {NONE,  L2,    TIP},
        /* L2 s12: Ey      */ {ERROR, E,     TIP},
        /* Ey there        */ {ERROR, E,     CLEAR},
        /* Ex^2, alpha Ex  */ {NONE,  E,     SQUARE},
        /* Ey^2, alpha Ey  */ {LINK1, ALPHA, SQUARE},
        /* stop?           */ {LINK2, ALPHA, STOP},
        /* e1              */ {NONE,  L1,    SIN},
        /* e2              */ {NONE,  L1,    MOVE1},
        /* joints          */ {NONE,  L1,    MOVE1 | MOVE2}};
    localparam LINES = PIPE == 0 ? 12 : 16;
    localparam [14*16-1:0] TABLE = PIPE == 0 ? {{14*4{1'b0}}, PASS} : PASS_1;
    wire [13:0] op;
    wire [1:0]  left, right;
    wire [9:0]  rest;
    assign      {left, right, rest} = op;
    wire        cosine = |(rest & COS), both = |(rest & SIN12), stop = |(rest & STOP);
    wire        move1 = |(rest & MOVE1), move2 = |(rest & MOVE2), square = |(rest & SQUARE), clear = |(rest & CLEAR);
    wire        tip = |(rest & TIP), first = |(rest & X), second = |(rest & Y);
    wire        idle, halt;
    wire        accept = in_valid && in_ready;
    assign      in_ready = idle && (!out_valid || out_ready);
    schedule #(.LINES(LINES), .BITS(14), .TABLE(TABLE[14*LINES-1:0])) control (.clk(clk), .rst(rst || halt),
        .in_start(accept || move2), .out_idle(idle), .out_op(op));

    // Joints
    localparam K = W + 1, T = (W + 4) / 2;  // fraction bits of a sine, address bits of its table
    reg  [A-1:0]       th1, th2, th12;
    wire [A-1:0]       step;
    wire [2*K-T+19:0]  chord;
    assign out_j1 = th1;
    assign out_j2 = th2;
    angle_chord #(.A(A), .K(K), .T(T)) codec (.clk(clk), .in_read(1'b1), .in_keep(1'b0), .in_cos(cosine),
        .in_j(both ? th12 : th1), .out_chord(chord));
    always @(posedge clk) begin
        th12 <= th1 + th2;
        if (accept ? !in_warm : move1)
            th1 <= accept ? in_j1 : th1 + step;
        if (accept ? !in_warm : move2)
            th2 <= accept ? in_j2 : th2 + step;
        if (rst) begin
            th1 <= {A{1'b0}};
            th2 <= {A{1'b0}};
        end
    end

    // Datapath and end of a sample
    reg  [W-1:0] x, y;
    wire         fine, wide, failed;
    engine_gd_path #(.W(W), .A(A), .K(K), .T(T), .PIPE(PIPE)) path (.clk(clk), .cfg_l1(cfg_l1),
        .cfg_l2(cfg_l2), .cfg_alpha(cfg_alpha), .in_shift(cfg_shift), .in_fine(fine), .in_still(wide),
        .in_op({left, right, move2, move1, stop, square, clear, tip, second, first}),
        .in_chord(chord), .in_x(x), .in_y(y), .out_step(step), .out_square(out_error));
    engine_gd_judge #(.W(W)) judge (.clk(clk), .rst(rst), .cfg_tol(cfg_tol), .cfg_limit(cfg_limit), .in_start(accept),
        .in_stop(stop), .in_step(move2), .in_square(out_error), .out_ready(out_ready), .out_fine(fine),
        .out_wide(wide), .out_halt(halt), .out_valid(out_valid), .out_iters(out_iters), .out_failed(failed));
    assign out_coarse = !fine;
    assign out_status = {failed, 3'b000};
    always @(posedge clk) begin
        if (accept)
            {x, y} <= {in_x, in_y};
        if (accept)
            {out_d1, out_d2} <= {2*A{1'b0}};
        else if (move1 && !wide) begin
            if (move2)
                out_d2 <= step;
            else
                out_d1 <= step;
        end
    end
endmodule
`default_nettype wire
