// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of two or three joints that are unit vectors, on two multipliers and no table.
//   x = A c1 - B n1, y = A n1 + B c1 with A = L1 + L2 c2, B = L2 n2; JOINTS = 3: rho, z = x, y; x = rho c3, y = rho n3
// Formats: c, n s2.U (1.0 is 2^U), of any length; A, B, rho s(W+2+G) with G bits below the LSB of a coordinate, to
// which every product is truncated; outputs to nearest (ties upward), saturated.
// Exact in its range: (L1 + L2 |v2|) |v1| (|v3| or 1) below 2^(W+1) LSB; beyond it a coordinate wraps.
// Latency and II: lines of the table + 1. Overflow: a coordinate was saturated.
// Models: vector.fk2, vector.fk3
`default_nettype none
module vector_chain #(
    parameter JOINTS = 2,  // 2 or 3: the third turns the plane of the first two about an upright axis
    parameter W = 16,      // bits of a length and of a coordinate, 4 to 20; their fraction bits do not matter here
    parameter U = 16       // fraction bits of cosine and sine, 4 to 24
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_overflow
);
    localparam G = 5, N = W + 2 + G;  // guard bits; bits of A, B and rho

    // Schedule. start: exact c1 n1 n2 c3 n3 base sine <- in_c1 in_n1 in_c2 in_n2 in_c3 in_n3
    localparam [4:0]
        PLACE = 5'b00001,  // a b <- exact n2 base: A is L1 behind L2 c2, B is L2 n2; later a is rho
        TURN  = 5'b00010,  // turn exact <- c1 n1: the next clock turns (A, B) by joint 1
        YAW   = 5'b00100,  // yaw exact z <- c3 n3: the next clock turns (rho, 0) by joint 3; z is rounded before y
        SINE  = 5'b01000,  // sine <- -: the next clock does so with the sine at the first multiplier: y, not x
        LAST  = 5'b10000;  // x <- exact: x is rounded; y is in the clock after
    //                 work
    localparam [5*3-1:0] PLANE = {
        /* A, B   */ {PLACE | TURN},
        /* x      */ {TURN | SINE},
        /* y      */ {LAST}};
    localparam [5*5-1:0] SPACE = {
        /* A, B   */ {PLACE | TURN},
        /* rho    */ {TURN | SINE},
        /* z      */ {PLACE | YAW},
        /* x      */ {YAW | SINE},
        /* y      */ {LAST}};
    wire idle, place, to_turn, to_yaw, to_sine, last;
    reg  turn, yaw, sine;  // in registers, for each bit in front of a multiplier to fit one logic cell
    wire accept = in_valid && in_ready;
    generate
        if (JOINTS == 2) begin : g_two
            schedule #(.LINES(3), .BITS(5), .TABLE(PLANE)) control (.clk(clk), .rst(rst), .in_start(accept),
                .out_idle(idle), .out_op({last, to_sine, to_yaw, to_turn, place}));
        end else begin : g_three
            schedule #(.LINES(5), .BITS(5), .TABLE(SPACE)) control (.clk(clk), .rst(rst), .in_start(accept),
                .out_idle(idle), .out_op({last, to_sine, to_yaw, to_turn, place}));
        end
    endgenerate
    assign in_ready = idle && (!out_valid || out_ready);

    // First multiplier: A c1, A n1, rho c3, rho n3. Second: L2 c2 from the port, L2 n2, -B n1, B c1.
    // Between samples A and B are 0, so that L2 needs no selector, nor the sum
    reg  signed [U+1:0] c1, n1, n2, c3, n3;
    reg  signed [N-1:0] a, b;
    wire signed [U+1:0] left1 = yaw ? (sine ? n3 : c3) : (sine ? n1 : c1);
    wire signed [U+1:0] left2 = turn ? (sine ? c1 : n1) : (sine ? n2 : in_c2);
    wire [W-1:0]        reach = cfg_l2 & {W{!turn && !yaw}};
    wire signed [N-1:0] right2 = (b ^ {N{turn && !sine}}) | {2'd0, reach, {G{1'b0}}};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [N+U+1:0] product1 = left1 * a, product2 = left2 * right2;
    /* verilator lint_on UNUSEDSIGNAL */
    wire [N-1:0] cut1 = product1[N+U-1:U], cut2 = product2[N+U-1:U];
    reg  [N-1:0] exact;

    // One adder puts L1 to A and rounds: base is L1 in the first line and 0 in all others
    reg  [W-1:0] base;
    wire [W+2:0] near = exact[N-1:G-1] + {2'd0, base, !place};
    wire [W+1:0] nearest = near[W+2:1];
    wire         over = nearest[W+1:W-1] != {3{nearest[W+1]}};
    reg          over_before;
    assign       out_y = over ? {nearest[W+1], {(W-1){!nearest[W+1]}}} : nearest[W-1:0];
    assign       out_overflow = over || over_before;

    always @(posedge clk) begin
        base <= accept ? cfg_l1 : {W{1'b0}};
        if (accept) begin
            c1 <= in_c1;
            n1 <= in_n1;
            n2 <= in_n2;
            c3 <= in_c3;
            n3 <= in_n3;
        end
        if (accept || turn || yaw)
            exact <= cut1 + cut2;
        if (place) begin
            a <= {near, exact[G-2:0]};
            b <= cut2;
        end
        if (yaw && !sine)
            out_z <= out_y;
        if (last)
            out_x <= out_y;
        if (place || yaw || last)
            over_before <= !place && out_overflow;
        out_valid <= last || (out_valid && !out_ready);
        if (rst || last)
            a <= {N{1'b0}};
        if (rst || (turn && sine))
            b <= {N{1'b0}};
        turn <= !rst && to_turn;
        yaw  <= !rst && to_yaw;
        sine <= !rst && (accept || to_sine);
        if (rst) begin
            c1        <= {(U+2){1'b0}};  // 0 times an unknown c1 is unknown in a simulator
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
