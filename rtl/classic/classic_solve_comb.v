// SPDX-License-Identifier: Apache-2.0
// This engine has the arithmetic of classic_solve_iter, bit for bit, on combinational arrays: one vectoring or root a
// clock. It has no handshake.
// JOINTS = 2: phi (in the clock of in_start); root a; root b; h; d.
// JOINTS = 3: the yaw (in the clock of in_start); K z; phi and root a; root b; h; d.
// Formats: coordinates are sW, angles uA, in_f s1.(W+2); in_far and in_near are squares of LSB.
// Status: out_unreachable, out_singular (x = y = 0).
// Model: classic.ik2, classic.ik3
`default_nettype none
module classic_solve_comb #(
    parameter W      = 16,  // bits of a coordinate, 8 to 24 (default 16)
    parameter A      = 16,  // bits of an angle, a turn is 2^A, 4 to 24 (default 16)
    parameter JOINTS = 2    // 2 (default): in the plane; 3: in space
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
    localparam G = 4;
    localparam C = (W + 1) / 2;
    localparam U = JOINTS == 3 ? C : (W + 1) / 3 + 1;
    localparam D = W + 2 + G;
    localparam Y = D + 2;
    localparam Z = A + 6;
    localparam H = (W + 2) / 2;
    localparam [31:0] ALONE = 32 + H, LEADING = 48 + 2 * H, TRAILING = H + 16;
    localparam [31:0] GROWTH = 32'h69648523;  // 1.646760 * 2^30

    reg  [2:0] phase;
    reg        elbow, axis, origin, far, near;
    wire       root_a = phase == JOINTS[2:0] - 3'd1;
    wire       root_b = phase == JOINTS[2:0];
    wire       half = phase == JOINTS[2:0] + 3'd1;
    wire       rest = phase == JOINTS[2:0] + 3'd2;
    wire       to_phi = JOINTS == 3 ? root_a : in_start;
    assign out_busy = phase != 3'd0;
    assign out_done = rest;
    assign out_singular = axis;
    assign out_unreachable = far || near;
    always @(posedge clk) begin
        phase <= rst || rest || !(in_start || out_busy) ? 3'd0 : phase + 3'd1;
        if (in_start) begin
            elbow  <= in_elbow;
            axis   <= {in_x, in_y} == {2*W{1'b0}};
            origin <= {in_x, in_y, in_z} == {3*W{1'b0}};
        end
    end

    // squares, roots, products
    reg  signed [W-1:0]     height;
    reg         [2*W-1:0]   q;
    reg         [W+G:0]     a;
    reg  signed [Y-1:0]     product;
    wire signed [W-1:0]     x0 = in_x, y0 = in_y;
    wire        [2*W-1:0]   square = height * height;
    wire        [2*W+2:0]   to_far = {1'b0, in_far} - {3'd0, q};
    wire        [2*W:0]     from_near = {1'b0, q} - {1'b0, in_near};
    wire        [2*W+1:0]   radicand = root_b ? {2'b00, from_near[2*W-1:0] & {2*W{!from_near[2*W]}}}
                                              : to_far[2*W+1:0] & {(2*W+2){!to_far[2*W+2]}};
    wire        [W+G:0]     root;
    wire        [W+G+1:0]   unused_rem;
    wire                    lift = JOINTS == 3 && !root_b;
    wire signed [W+G+1:0]   short = lift ? {{2{height[W-1]}}, height, {G{1'b0}}} : {1'b0, a};
    wire signed [W+3:0]     factor = lift ? GROWTH[31 -: W+4] : in_f;
    wire signed [2*W+G+5:0] whole = short * factor;
    wire                    unused_low = &{1'b0, whole[W+1:0]};
    isqrt_comb #(.W(2 * W + 2), .F(G)) roots (.in_d(radicand), .out_root(root), .out_rem(unused_rem));
    always @(posedge clk) begin
        if (in_start) height <= in_z;
        if (in_start) q <= x0 * x0 + y0 * y0;
        else if (JOINTS == 3 && phase == 3'd1) q <= q + square;
        if (root_a) {far, a} <= {to_far[2*W+2], root};
        if (root_b) near <= from_near[2*W];
        if (!half) product <= whole[2*W+G+5 -: Y];
    end

    // vectorings
    reg  [D-1:0] x;
    reg  [Z-1:0] z, phi;
    wire [D-1:0] grown;
    wire [Z-1:0] angle;
    wire [Z-1:0] joint1 = phi + angle;
    wire         unused_fraction = &{1'b0, joint1[5:0]};
    wire [D-1:0] from_x = in_start ? {2'b00, in_x ^ {W{in_x[W-1]}}, {G{in_x[W-1]}}} : x;
    wire [Y-1:0] from_y = in_start ? {{4{in_y[W-1]}}, in_y, {(G-1){1'b0}}, 1'b1} : half ? {3'b000, a} : product;
    wire [Z-1:0] from_z = in_start ? {in_x[W-1], {(A-2){1'b0}}, JOINTS == 3 ? ALONE[6:0] : LEADING[6:0]}
                        : half ? {{(A+1){1'b1}}, TRAILING[4:0]} : rest ? z : {{(A-1){1'b0}}, LEADING[6:0]};
    classic_aim_array #(.W(W), .A(A), .U(U)) aim (.in_x(from_x), .in_y(from_y), .in_z(from_z),
        .in_minus(in_start ? in_x[W-1] : (half || rest) && !elbow), .out_x(grown), .out_z(angle));
    always @(posedge clk) begin
        if (root_b) x <= {1'b0, root};
        else if (in_start) x <= grown;
        if (to_phi) phi <= angle;
        z <= angle;
        if (rst) {out_j1, out_j2, out_j3} <= {3*A{1'b0}};
        else begin
            if (in_start && !(in_x == {W{1'b0}} && in_y == {W{1'b0}})) out_j3 <= angle[Z-1:6];
            if (half) out_j2 <= ~angle[Z-2:5];
            if (rest && !origin) out_j1 <= joint1[Z-1:6];
        end
    end
endmodule
`default_nettype wire
