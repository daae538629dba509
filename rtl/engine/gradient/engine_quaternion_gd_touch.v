// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of the Geomagic Touch by quaternion gradient descent: joint 1 yaws about y, joint 2 lifts link 1,
// joint 3 is the absolute angle of link 2. tip = (-s1 rho, L1 s2 - L2 c3, c1 rho) with rho = L1 c2 + L2 s3.
// Formats: joints angle of A bits; in_x, in_y, in_z sQ(W-F).F, from the point between the axes; cfg_l1, cfg_l2
// uQ(W-F).F, L1 + L2 below 2^W LSB; cfg_alpha, cfg_shift by iterative.fixed.config; cfg_tol, out_error in 1/256 LSB^2,
// with out_coarse in LSB^2; out_d1, out_d2, out_d3 sA: the last step. in_warm: start from the last answer, 0 after
// reset.
// Error: a converged tip is within bounds.iterative.tip_touch: 0.85 LSB more than sqrt(out_error + 3) / 16 at lengths
// of 2^13 LSB. Latency 14 + 3 PIPE a pass, II the same. Passes: out_iters + 1, and those that only change the range.
// Status: not converged (the limit was reached: out of reach, alpha too large, or a start where the gradient is 0).
// Source: quaternion gradient paper, eqs. 28, 31, its Jacobian corrected. Model: iterative.fixed.gd_touch
`default_nettype none
module engine_quaternion_gd_touch #(
    parameter W = 16,  // bits of a coordinate and of a length, 14 to 20 (default 16)
    parameter F = 8,   // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 24,  // bits of a joint word, 16 to 24 (default 24, 0.006 LSB at 2^14 LSB); a full turn is 2^A
    parameter PIPE = 0 // registers behind the products, 0 or 1 (default 0: fewest clocks); 1: a faster clock
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire [W:0]          cfg_alpha,
    input  wire                cfg_shift,
    input  wire [21:0]         cfg_tol,
    input  wire [9:0]          cfg_limit,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    input  wire [A-1:0]        in_j1,
    input  wire [A-1:0]        in_j2,
    input  wire [A-1:0]        in_j3,
    input  wire                in_warm,
    output wire                out_valid,
    input  wire                out_ready,
    output wire [A-1:0]        out_j1,
    output wire [A-1:0]        out_j2,
    output wire [A-1:0]        out_j3,
    output wire [9:0]          out_iters,
    output wire [2*W-1:0]      out_error,
    output wire                out_coarse,
    output reg  signed [A-1:0] out_d1,
    output reg  signed [A-1:0] out_d2,
    output reg  signed [A-1:0] out_d3,
    output wire [3:0]          out_status
);
    generate
        if (W < 14 || W > 20 || F < 0 || F >= W || A < 16 || A > 24 || PIPE < 0 || PIPE > 1) begin : g_illegal
            engine_quaternion_gd_touch_needs_W_from_14_to_20_and_F_below_W_and_A_from_16_to_24_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    // Schedule, a clock a line
    localparam [2:0]            // operands of the first multiplier
        CHORD  = 3'b000,        // an operand is a chord
        ACROSS = 3'b010,        // a root of joint 1 and x or z
        PRIOR  = 3'b101,        // alpha and the error squared in the line before
        ALPHA  = 3'b100,        // alpha and an error
        SINK   = 3'b110;        // alpha v and a link
    localparam [2:0]            // operands of the second
        ROOT   = 3'b000,        // the root of the chord before, and a word
        SQUARE = 3'b010,        // the square of an error
        ARM    = 3'b100,        // rho and alpha u
        LIFT   = 3'b110,        // a link and alpha w
        AGAIN  = 3'b111;        // the next link and alpha w
    localparam [2:0]            // word: of the second, and of the first
        L1     = 3'b000,        // length of link 1, z
        L2     = 3'b010,        // length of link 2, z
        Z      = 3'b100,        // z, z
        X      = 3'b101,        // x, x
        L1_X   = 3'b001,        // length of link 1, x
        L2_X   = 3'b011;        // length of link 2, x
    localparam [1:0]            // error
        V      = 2'b00,         // along the plane of the links
        U      = 2'b10,         // across it; alpha v is kept
        W_UP   = 2'b01;         // up
    localparam [1:0]            // sum of the products of the line before
        OUT    = 2'b00,         // 0, less a product
        LESS   = 2'b01,         // the error, less a product
        UP     = 2'b10,         // y, less a product; v is kept
        STAY   = 2'b11;         // stays
    localparam [4:0]            // joints
        SIN    = 5'h00,         // read a sine
        THIRD  = 5'h01,         // read joint 1 in line 1, joint 3 in the next one; else joint 2, in line 2 joint 1
        COS    = 5'h02,         // read a cosine
        MINUS  = 5'h04,         // read half a turn on
        MOVE   = 5'h08,         // a joint by its step, and the next
        STOP   = 5'h10;         // stop here if converged or at the limit
    localparam [4:0]            // the rest
        NONE   = 5'h00,         // nothing
        CLEAR  = 5'h01,         // the squares begin
        ADD    = 5'h02,         // a square is added to the sum
        TURN   = 5'h04,         // across, both products
        PAIR   = 5'h08,         // a root of joint 1, or the next
        LINK   = 5'h10;         // a link, or the next
    localparam [23*14-1:0] PASS = {
        /* read -c1; step 2       */ {CHORD,  ROOT,   L1,   V,    STAY, THIRD | COS | MINUS | MOVE, NONE},
        /* read s1; step 3        */ {CHORD,  ROOT,   L1,   V,    STAY, SIN | MOVE,                 NONE},
        /* read c2; -c1 z         */ {CHORD,  ROOT,   Z,    V,    STAY, COS,                        PAIR},
        /* read s3; s1 x          */ {CHORD,  ROOT,   X,    V,    OUT,  THIRD | SIN,                PAIR},
        /* read s2; L1 c2         */ {CHORD,  ROOT,   L1,   V,    LESS, SIN,                        NONE},
        /* read -c3; L2 s3        */ {CHORD,  ROOT,   L2,   V,    LESS, THIRD | COS | MINUS,        LINK},
        /* L1 s2                  */ {CHORD,  ROOT,   L1,   V,    LESS, NONE,                       LINK},
        /* -c1 x, -L2 c3; v       */ {ACROSS, ROOT,   L2_X, V,    UP,   NONE,                       LINK | PAIR},
        /* s1 z, v^2              */ {ACROSS, SQUARE, Z,    V,    LESS, NONE,                       LINK | CLEAR},
        /* alpha v, w^2; u        */ {PRIOR,  SQUARE, L1,   W_UP, STAY, NONE,                       TURN | ADD},
        /* alpha u, u^2           */ {ALPHA,  SQUARE, L1,   U,    STAY, NONE,                       ADD},
        /* alpha w, rho alpha u   */ {ALPHA,  ARM,    L1,   W_UP, STAY, NONE,                       ADD},
        /* e2; stop?              */ {SINK,   LIFT,   L1,   V,    STAY, STOP,                       LINK},
        /* e3; step 1             */ {SINK,   AGAIN,  L1,   V,    STAY, MOVE,                       NONE}};
    // PIPE = 1: a product is used two lines after the one that names its factors
    localparam [23*17-1:0] PASS_1 = {
        /* read -c1; step 2       */ {CHORD,  ROOT,   L1,   V,    STAY, THIRD | COS | MINUS | MOVE, NONE},
        /* read s1; step 3        */ {CHORD,  ROOT,   L1,   V,    STAY, SIN | MOVE,                 NONE},
        /* read c2                */ {CHORD,  ROOT,   L1,   V,    STAY, COS,                        NONE},
        /* read s3; -c1           */ {CHORD,  ROOT,   Z,    V,    STAY, THIRD | SIN,                PAIR},
        /* read s2; s1            */ {CHORD,  ROOT,   X,    V,    STAY, SIN,                        PAIR},
        /* read -c3; -c1 z        */ {CHORD,  ROOT,   L1,   V,    OUT,  THIRD | COS | MINUS,        NONE},
        /* s1 x                   */ {CHORD,  ROOT,   L2,   V,    LESS, SIN,                        NONE},
        /* L1 c2                  */ {ACROSS, ROOT,   L1_X, V,    LESS, NONE,                       LINK | PAIR},
        /* L2 s3; v               */ {ACROSS, ROOT,   L2,   V,    LESS, NONE,                       LINK},
        /* L1 s2, -c1 x; v there  */ {ALPHA,  SQUARE, L1,   V,    UP,   NONE,                       LINK | CLEAR},
        /* -L2 c3, s1 z; u, w     */ {CHORD,  ROOT,   L1,   V,    LESS, NONE,                       LINK | TURN},
        /* alpha v, v^2           */ {ALPHA,  SQUARE, L1,   U,    STAY, NONE,                       ADD},
        /* w there                */ {ALPHA,  SQUARE, L1,   W_UP, STAY, SIN,                        NONE},
        /* alpha u, u^2           */ {CHORD,  ARM,    L1,   V,    STAY, NONE,                       ADD},
        /* alpha w, w^2           */ {SINK,   LIFT,   L1,   V,    STAY, NONE,                       LINK | ADD},
        /* rho alpha u; stop?     */ {SINK,   AGAIN,  L1,   V,    STAY, STOP,                       NONE},
        /* e2; step 1             */ {SINK,   ROOT,   L1,   V,    STAY, MOVE,                       NONE}};
    localparam LINES = PIPE == 0 ? 14 : 17;
    localparam [23*17-1:0] TABLE = PIPE == 0 ? {{23*3{1'b0}}, PASS} : PASS_1;
    wire [22:0] op;
    wire [2:0]  left, right, word;
    wire [1:0]  seen, sum;
    wire [4:0]  joints, rest;
    assign      {left, right, word, seen, sum, joints, rest} = op;
    wire        stop = |(joints & STOP), move = |(joints & MOVE), minus = |(joints & MINUS);
    wire        cosine = |(joints & COS), third = |(joints & THIRD);
    wire        idle, fine, wide, halt, failed;
    reg         again;  // repeat the pass in the other range
    reg         finer;  // range of the step is fine
    reg  [1:0]  late;   // steps 2 and 3 follow in the first lines of the next pass
    wire        accept = in_valid && in_ready, leave = halt || (stop && wide);
    wire        last = move && |(left & ALPHA);  // the first lines, which move too, have a chord
    wire        steps = last || late != 0;
    assign      in_ready = idle && !again && (!out_valid || out_ready);
    schedule #(.LINES(LINES), .BITS(23), .TABLE(TABLE[23*LINES-1:0])) control (.clk(clk), .rst(rst || leave),
        .in_start(accept || again || last), .out_idle(idle), .out_op(op));
    always @(posedge clk) begin
        again <= !rst && leave && !halt;
        late  <= rst ? 2'b00 : {late[0], last};
        if (stop)
            finer <= fine;
    end

    // Joints: th1 to th3 are joints 1, 2, 3 at an answer and 2, 3, 1 in line 1 of a pass; each move rotates them
    localparam K = W + 1, T = (W + 4) / 2;  // fraction bits of a sine, address bits of its table
    reg  [A-1:0]      th1, th2, th3;
    reg  [W-1:0]      x, y, z;
    wire [A-1:0]      joint = third ? th3 : th2;
    wire [A-1:0]      step;
    wire [2*K-T+19:0] chord;
    assign            out_j1 = th1;
    assign            out_j2 = th2;
    assign            out_j3 = th3;
    angle_chord #(.A(A), .K(K), .T(T)) codec (.clk(clk), .in_read(1'b1), .in_keep(1'b0), .in_cos(cosine),
        .in_j({joint[A-1] ^ minus, joint[A-2:0]}), .out_chord(chord));
    always @(posedge clk) begin
        if (accept || again || move) begin
            th1 <= accept && !in_warm ? in_j2 : th2;
            th2 <= accept && !in_warm ? in_j3 : th3;
            th3 <= accept && !in_warm ? in_j1 : steps ? th1 + step : th1;
        end
        if (rst)
            {th1, th2, th3} <= {3*A{1'b0}};
        if (accept) begin
            {x, y, z} <= {in_x, in_y, in_z};
            {out_d1, out_d2, out_d3} <= {3*A{1'b0}};
        end else if (steps)
            {out_d1, out_d2, out_d3} <= {out_d2, out_d3, step};
    end

    // Datapath and end of a sample
    engine_gd_touch_path #(.W(W), .A(A), .K(K), .T(T), .PIPE(PIPE)) path (.clk(clk), .cfg_l1(cfg_l1),
        .cfg_l2(cfg_l2), .cfg_alpha(cfg_alpha), .in_shift(cfg_shift), .in_fine(fine), .in_finer(finer), .in_alone(stop),
        .in_op({left, right, word, seen, sum, rest}), .in_chord(chord), .in_x(x), .in_y(y), .in_z(z), .out_step(step),
        .out_square(out_error));
    engine_gd_judge #(.W(W)) judge (.clk(clk), .rst(rst), .cfg_tol(cfg_tol), .cfg_limit(cfg_limit), .in_start(accept),
        .in_stop(stop), .in_step(stop), .in_square(out_error), .out_ready(out_ready), .out_fine(fine),
        .out_wide(wide), .out_halt(halt), .out_valid(out_valid), .out_iters(out_iters), .out_failed(failed));
    assign out_coarse = !fine;
    assign out_status = {failed, 3'b000};
endmodule
`default_nettype wire
