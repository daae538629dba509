// SPDX-License-Identifier: Apache-2.0
// Velocity of the tip from the joints' rates, for two joints in the plane, or for three of which the third yaws it.
//   e + i f = L2 (c2 + i n2), s = w1 + w2: v' = -f s + i ((L1 + e) s - L1 w2) seen from link 1; joint 1 turns it
//   JOINTS = 3: x + i y = (v_rho + i rho w3)(c3 + i n3), rho = (L1 + e) c1 - f n1
// Formats: c, n s2.U (1.0 is 2^U); rates s(W-V).V; a, b, p, q s(2W-V+3).G with G = 4 guard bits below the LSB of a
// coordinate, to which every product is truncated. Outputs are rounded to nearest (ties upward) and saturated.
// Error of a coordinate: 1/2 + E / 16 LSB, E = 3 + sqrt((|s| + |w2| + 2)^2 + (2 |s| + 1)^2), rates in radians;
// JOINTS = 3: 1/2 + (3 + sqrt(E^2 + (1 + (3 + sqrt 2) |w3|)^2)) / 16.
// Latency and II: 6, with three joints 10. Overflow: a coordinate was saturated.
// Models: arm_velocity.velocity2, arm_velocity.velocity3
`default_nettype none
module arm_jacobian #(
    parameter JOINTS = 2,  // joints, 2 or 3 (default 2); the third turns the plane of the others about an upright axis
    parameter W = 16,      // bits of a length, a rate and a velocity, 8 to 18 (default 16)
    parameter U = 16,      // fraction bits of cosine and sine, 8 to 18 (default 16)
    parameter V = 12       // fraction bits of a rate, W - 8 to W - 1 and at most U (default 12: rates below 8 rad)
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
    input  wire signed [W-1:0] in_w1,
    input  wire signed [W-1:0] in_w2,
    input  wire signed [W-1:0] in_w3,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire                out_overflow
);
    // Schedule, a clock a line
    // The operands of the first line are L2 and (c2, n2): the choice of right ones that is 0, and what a start loads
    localparam [10:0]                  // operands of the next clock
        ALONG = 11'b001_001_01_01_1,   // velocity across link 1, a s - L1 w2
        DOWN  = 11'b000_010_01_10_1,   // velocity along link 1, -b s
        RHO   = 11'b010_011_01_10_1,   // distance from the yaw axis, a c1 - b n1
        YAW   = 11'b100_000_01_00_0,   // velocity of the plane there, a w3
        LEVEL = 11'b010_011_10_11_1,   // v' turned by joint 1, the first coordinate, q c1 - p n1
        UP    = 11'b011_100_10_11_0,   // the second, q n1 + p c1
        TURN3 = 11'b101_101_11_10_1,   // (p, b) turned by joint 3, the first coordinate
        LAST3 = 11'b110_110_11_10_0,   // the second sum
        NONE  = 11'b000_000_00_00_0;   // the table ends
    localparam [7:0]                   // where the sum goes
        TO_AB = 8'b1_1100_000,         // each product alone, and L1 to a
        TO_A  = 8'b0_1000_000,         // the sum goes to a
        TO_B  = 8'b0_0100_000,         // the sum goes to b
        TO_P  = 8'b0_0010_000,         // the sum goes to p
        TO_Q  = 8'b0_0001_000,         // the sum goes to q
        OUT_Z = 8'b0_0010_100,         // a is z, the sum goes to p
        OUT_X = 8'b0_1000_011;         // a is x, the sum is y
    localparam [5*19-1:0] PLANE = {
        /* L1 + e, f */ {ALONG, TO_AB},
        /* v' across */ {DOWN,  TO_P},
        /* v' along  */ {LEVEL, TO_Q},
        /* x         */ {UP,    TO_A},
        /* y         */ {NONE,  OUT_X}};
    localparam [9*19-1:0] SPACE = {
        /* L1 + e, f */ {ALONG, TO_AB},
        /* v' across */ {DOWN,  TO_P},
        /* v' along  */ {RHO,   TO_Q},
        /* rho       */ {YAW,   TO_A},
        /* rho w3    */ {UP,    TO_B},
        /* z         */ {LEVEL, TO_A},
        /* v_rho     */ {TURN3, OUT_Z},
        /* x         */ {LAST3, TO_A},
        /* y         */ {NONE,  OUT_X}};
    wire [18:0] op;
    wire        idle;
    wire        accept = in_valid && in_ready;
    assign      in_ready = idle && (!out_valid || out_ready);
    generate
        if (JOINTS == 2) begin : g_two
            schedule #(.LINES(5), .BITS(19), .TABLE(PLANE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end else begin : g_three
            schedule #(.LINES(9), .BITS(19), .TABLE(SPACE)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op(op));
        end
    endgenerate

    arm_jacobian_path #(.W(W), .U(U), .V(V)) path (
        .clk(clk), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_start(accept), .in_op(op[18:1]), .in_c1(in_c1), .in_n1(in_n1),
        .in_c2(in_c2), .in_n2(in_n2), .in_c3(in_c3), .in_n3(in_n3), .in_w1(in_w1), .in_w2(in_w2), .in_w3(in_w3),
        .out_x(out_x), .out_y(out_y), .out_z(out_z), .out_overflow(out_overflow));
    always @(posedge clk)
        out_valid <= !rst && (op[0] || (out_valid && !out_ready));
endmodule
`default_nettype wire
