// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints in the plane by quaternion gradient descent, without an angle: the direction of a
// link turns by (c, n) <- (c - d n, n + d c) and is normalised by one Newton step. No sine, no table.
// Formats: in_c1, in_n1 direction of link 1, in_c12, in_n12 of link 2, both absolute, s2.W, and answers alike; in_x,
// in_y sQ(W-F).F; cfg_l1, cfg_l2 uQ(W-F).F; cfg_alpha, cfg_shift by iterative.fixed.config_vector; cfg_tol, out_error
// in 1/256 LSB^2, with out_coarse in LSB^2; out_d1, out_d12 s0.(W+4) rad: last turn of each link, at most 1/2. in_warm:
// start from the last answer, (1, 0) after reset. Error: a converged tip of the answered words is within sqrt(out_error
// + 2) / 16 + 0.05 LSB; their length is 1 within 3/8 d^4 of the last step and 1.8 2^-W.
// Latency 13 + 7 PIPE a step, 10 at the end and for a pass that only changes the range; II the same. Steps: out_iters.
// Status: not converged (the limit was reached), singular (a start far from length 1, held until the next start).
// Source: quaternion gradient paper, eqs. 18, 25, 31. Model: iterative.fixed.gd_vector
`default_nettype none
module engine_quaternion_gd_vector #(
    parameter W = 16,        // bits of a coordinate and of a length, 14 to 20 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks); 1: a faster clock
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
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
    input  wire signed [W+1:0] in_c1,
    input  wire signed [W+1:0] in_n1,
    input  wire signed [W+1:0] in_c12,
    input  wire signed [W+1:0] in_n12,
    input  wire                in_warm,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W+1:0] out_c1,
    output wire signed [W+1:0] out_n1,
    output wire signed [W+1:0] out_c12,
    output wire signed [W+1:0] out_n12,
    output wire [9:0]          out_iters,
    output wire [2*W-1:0]      out_error,
    output wire                out_coarse,
    output wire signed [W+3:0] out_d1,
    output wire signed [W+3:0] out_d12,
    output wire [3:0]          out_status
);
    generate
        if (W < 14 || W > 20 || F < 0 || F >= W || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0) begin : g_illegal
            engine_quaternion_gd_vector_needs_W_from_14_to_20_F_below_W_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    // Schedule, a clock a line
    localparam [1:0]            // left operands; a direction swaps the links
        ERROR  = 2'b00,         // errors, x and y
        LINK   = 2'b01,         // a link, y and x
        SELF   = 2'b10,         // a direction
        NORMAL = 2'b11;         // its normal
    localparam [3:0]            // right operands
        L1     = 4'b0000,       // length of link 1
        L2     = 4'b0001,       // length of link 2
        ALPHA  = 4'b0010,       // the step
        D      = 4'b0011,       // what the link turns by
        GAIN   = 4'b1011,       // half of what its square is above 1
        PUSH   = 4'b0100,       // alpha times the errors
        HOLD   = 4'b1000,       // the same
        SQUARE = 4'b1100;       // the left operand
    localparam                  // bits of what becomes of the products of the line before
        MOVE   = 0,             // less than the other link's direction
        TIP    = 1,             // the error, less them: link 2
        FIRST  = 2,             // with TIP: the target, less them: link 1
        ASK    = 3,             // what a link asks for
        ADD    = 4,             // the step before is added to the sum, which ASK alone clears
        SUM    = 5,             // square of the error or of a direction
        STOP   = 6,             // stop here if converged or at the limit
        LAST   = 7,             // the pass ends
        REST   = 8;
    localparam [REST-1:0] BIT = 1, NONE = 0;
    localparam [14*13-1:0] PASS = {
        /* link 1          */ {SELF,   L1,     BIT << MOVE},
        /* link 2          */ {SELF,   L2,     BIT << FIRST | BIT << TIP},
        /*                 */ {ERROR,  HOLD,   BIT << TIP},
        /* alpha E         */ {ERROR,  ALPHA,  NONE},
        /* e1              */ {LINK,   PUSH,   NONE},
        /* e2              */ {LINK,   HOLD,   BIT << ASK},
        /* E^2             */ {ERROR,  SQUARE, BIT << ASK | BIT << ADD},
        /* turn 1          */ {NORMAL, D,      BIT << SUM | BIT << ADD},
        /* turn 2; stop?   */ {NORMAL, D,      BIT << STOP | BIT << MOVE},
        /* q1              */ {SELF,   SQUARE, BIT << MOVE},
        /* q2              */ {SELF,   SQUARE, BIT << SUM},
        /* length 1        */ {SELF,   GAIN,   BIT << SUM},
        /* length 2        */ {SELF,   GAIN,   BIT << MOVE | BIT << LAST}};
    // PIPE = 1: a product is used two lines after the one that names its factors
    localparam STAY = 1'b1, SWAP = 1'b0;  // of a direction: the links are not swapped, or they are
    localparam [15*20-1:0] PASS_1 = {
        /* link 1          */ {SWAP, SELF,   L1,     BIT << MOVE},
        /* link 2          */ {SWAP, SELF,   L2,     NONE},
        /*                 */ {SWAP, ERROR,  HOLD,   BIT << FIRST | BIT << TIP},
        /*                 */ {SWAP, ERROR,  HOLD,   BIT << TIP},
        /* alpha E         */ {SWAP, ERROR,  ALPHA,  NONE},
        /* E^2             */ {SWAP, ERROR,  SQUARE, NONE},
        /* e1              */ {SWAP, LINK,   PUSH,   NONE},
        /* e2              */ {SWAP, LINK,   HOLD,   BIT << SUM},
        /* stop?           */ {SWAP, ERROR,  HOLD,   BIT << ASK | BIT << STOP},
        /*                 */ {SWAP, ERROR,  HOLD,   BIT << ASK | BIT << ADD},
        /*                 */ {SWAP, ERROR,  HOLD,   BIT << ADD},
        /* turn 1          */ {SWAP, NORMAL, D,      BIT << ADD},
        /* turn 2          */ {STAY, NORMAL, D,      NONE},
        /*                 */ {SWAP, SELF,   L1,     BIT << MOVE},
        /* q1              */ {SWAP, SELF,   SQUARE, BIT << MOVE},
        /* q2              */ {SWAP, SELF,   SQUARE, NONE},
        /*                 */ {SWAP, ERROR,  HOLD,   BIT << SUM},
        /* length 1        */ {SWAP, SELF,   GAIN,   BIT << SUM},
        /* length 2        */ {STAY, SELF,   GAIN,   NONE},
        /*                 */ {SWAP, SELF,   L1,     BIT << MOVE | BIT << LAST}};
    localparam LINES = PIPE == 0 ? 13 : 20, BITS = PIPE == 0 ? 14 : 15;
    localparam [15*20-1:0] TABLE = PIPE == 0 ? {{(15*20-14*13){1'b0}}, PASS} : PASS_1;
    wire [BITS-1:0] op;
    wire            stay_1;  // the column of PIPE = 1
    wire [5:0]      operands;
    wire [REST-1:0] rest;
    assign          {stay_1, operands, rest} = {{(15-BITS){1'b0}}, op};
    wire        stay = PIPE == 1 && stay_1;
    wire        idle, fine, wide, halt, failed;
    reg         again;  // repeat the pass in the other range
    reg         fresh;  // line 1 of a pass without an earlier turn
    wire        accept = in_valid && in_ready, stop = rest[STOP];
    wire        keep = stop && wide || halt;
    assign      in_ready = idle && !again && (!out_valid || out_ready);
    schedule #(.LINES(LINES), .BITS(BITS), .TABLE(TABLE[BITS*LINES-1:0])) control (.clk(clk), .rst(rst || keep),
        .in_start(accept || again || rest[LAST]), .out_idle(idle), .out_op(op));
    always @(posedge clk) begin
        again <= !rst && keep && !halt;
        fresh <= accept || again;
    end

    // Start
    reg  [W-1:0] x, y;
    reg          singular;
    // Length below 0.5 or from 1.25 on; below 1.25 a turn by 1/2 leaves it below sqrt(2)
    function none(input [W+1:0] c, input [W+1:0] n);
        reg [3:0] u, v;  // magnitudes in 1/8
        begin
            u = c[W:W-3] ^ {4{c[W+1]}};
            v = n[W:W-3] ^ {4{n[W+1]}};
            none = u > 4'd8 || v > 4'd8 || (u > 4'd7 && v > 4'd3) || (v > 4'd7 && u > 4'd3) || (u > 4'd5 && v > 4'd5)
                || (u < 4'd4 && v < 4'd4);
        end
    endfunction
    always @(posedge clk) begin
        if (accept) begin
            x <= in_x;
            y <= in_y;
        end
        if (rst)
            singular <= 1'b0;
        else if (accept && !in_warm)
            singular <= none(in_c1, in_n1) || none(in_c12, in_n12);
    end

    // Datapath and end of a sample
    engine_gd_vector_path #(.W(W), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) path (.clk(clk), .rst(rst), .cfg_l1(cfg_l1),
        .cfg_l2(cfg_l2), .cfg_alpha(cfg_alpha), .in_shift(cfg_shift), .in_fine(fine),
        .in_keep(keep || fresh), .in_load(accept && !in_warm), .in_clear(accept), .in_stay(stay),
        .in_op({operands, rest}), .in_c1(in_c1), .in_n1(in_n1), .in_c12(in_c12), .in_n12(in_n12), .in_x(x), .in_y(y),
        .out_c1(out_c1), .out_n1(out_n1), .out_c12(out_c12), .out_n12(out_n12), .out_d1(out_d1),
        .out_d12(out_d12), .out_square(out_error));
    engine_gd_judge #(.W(W)) judge (.clk(clk), .rst(rst), .cfg_tol(cfg_tol), .cfg_limit(cfg_limit), .in_start(accept),
        .in_stop(stop), .in_step(stop), .in_square(out_error), .out_ready(out_ready), .out_fine(fine),
        .out_wide(wide), .out_halt(halt), .out_valid(out_valid), .out_iters(out_iters), .out_failed(failed));
    assign out_coarse = !fine;
    assign out_status = {failed, 1'b0, singular, 1'b0};
endmodule
`default_nettype wire
