// SPDX-License-Identifier: Apache-2.0
// This part computes the legs of the triangle of half the elbow, and the products at which vectorings start.
//   a^2 = far - r^2,  b^2 = r^2 - near, each 0 where it would be negative,  r^2 = x^2 + y^2 (+ z^2);  f a;  K z
// The roots are computed beside the table, one after the other on one engine: a as soon as r^2 is known, then b.
// JOINTS = 2: r^2 is known in the clock after in_start. JOINTS = 3: three clocks with in_add sum it, the third of which
// also has in_ask. in_height sends z to the multiplier, first to be squared (in_first), later times K.
// Formats: in_f is s1.(W+2); out_a and out_b have 4 guard bits; out_product has 5 and follows its factors by a clock.
// out_b is held until the next in_start.
// Rounding: the roots and the products are truncated. Status: out_unreachable. Model: classic.ik2, classic.ik3
`default_nettype none
module classic_legs #(
    parameter W      = 16,  // bits of a coordinate, 8 to 24 (default 16)
    parameter JOINTS = 2    // 2 (default): in the plane, in_z is not used; 3: in space
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
    input  wire                  in_add,
    input  wire                  in_first,
    input  wire                  in_ask,
    input  wire                  in_height,
    output reg         [W+4:0]   out_a,
    output wire        [W+4:0]   out_b,
    output wire signed [W+7:0]   out_product,
    output wire                  out_unreachable
);
    localparam G = 4;  // guard bits
    localparam [31:0] GROWTH = 32'h69648523;  // K = 1.646760 * 2^30, the gain of the vectoring

    // roots
    reg  [2*W-1:0] q;
    reg            ask, second, far, near;
    wire           begun, ready;
    wire           accept = ask && ready;
    wire [2*W+2:0] to_far = {1'b0, in_far} - {3'd0, q};
    wire [2*W:0]   from_near = {1'b0, q} - {1'b0, in_near};
    wire [2*W+1:0] radicand = second ? {2'b00, from_near[2*W-1:0] & {2*W{!from_near[2*W]}}}
                                     : to_far[2*W+1:0] & {(2*W+2){!to_far[2*W+2]}};
    wire [W+G+1:0] unused_rem;
    wire           unused_valid;
    isqrt #(.W(2 * W + 2), .F(G), .R(2)) roots (.clk(clk), .rst(rst), .in_valid(ask), .in_ready(ready),
        .in_d(radicand), .out_valid(unused_valid), .out_ready(1'b1), .out_root(out_b), .out_rem(unused_rem));
    assign out_unreachable = far || near;
    always @(posedge clk) begin
        ask    <= !rst && (begun || (ask && !(accept && second)));
        second <= !in_start && (second || accept);
        if (accept && !second) far <= to_far[2*W+2];
        if (accept && second) {near, out_a} <= {from_near[2*W], out_b};
    end

    // squares and products
    reg  signed [W+G+1:0]   left;
    reg  signed [W+3:0]     right;
    wire signed [2*W+G+5:0] whole = left * right;
    wire        [2*W-1:0]   square_x = in_x * in_x, square_y = in_y * in_y;
    reg  signed [2*W+G+5:0] done;
    wire                    unused = &{1'b0, done};
    always @(posedge clk) done <= whole;
    assign out_product = done[2*W+G+5 -: W+8];
    generate
        if (JOINTS == 2) begin : g_plane
            wire unused_ports = &{1'b0, in_z, in_add, in_first, in_ask, in_height};
            assign begun = in_start;
            always @* {left, right} = {1'b0, out_a, in_f};
            always @(posedge clk) if (in_start) q <= square_x + square_y;
        end else begin : g_space
            reg signed [W-1:0]   height;
            reg        [2*W-1:0] term, last;
            assign begun = in_ask;
            always @(posedge clk) begin
                if (in_start) {height, last} <= {in_z, square_y};
                if (in_start) q <= {2*W{1'b0}};
                else if (in_add) q <= q + term;
                term  <= in_start ? square_x : in_first ? last : done[G +: 2*W];
                left  <= in_height ? {{2{height[W-1]}}, height, {G{1'b0}}} : {1'b0, out_a};
                right <= !in_height ? in_f : in_first ? {{4{height[W-1]}}, height} : GROWTH[31 -: W+4];
            end
        end
    endgenerate
endmodule
`default_nettype wire
