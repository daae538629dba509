// SPDX-License-Identifier: Apache-2.0
// This part computes the legs of the triangle of half the elbow, and the products at which vectorings start.
//   a^2 = far - r^2,  b^2 = r^2 - near, each 0 where it would be negative,  r^2 = x^2 + y^2 (+ z^2);  f a;  K z
// The roots are computed beside the table, one after the other on one engine: a as soon as r^2 is known, then b. There
// is time for a product of one bit a clock: K z from in_start on, f a from the first root on.
// A clock with in_add adds a square to r^2, JOINTS of them from the second clock after in_start on; the last also has
// in_ask. JOINTS = 3: K z is taken with in_taken, and f a follows.
// Formats: in_f is s1.(W+2); out_a and out_b have 4 guard bits; out_product has 5. out_b is held until the next
// in_start.
// Rounding: the roots and the products are truncated. Status: out_unreachable. Model: classic.ik2, classic.ik3
`default_nettype none
module classic_legs #(
    parameter W        = 16, // bits of a coordinate, 8 to 24 (default 16)
    parameter JOINTS   = 2,  // 2 (default): in the plane, in_z is not used; 3: in space
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
    input  wire                  in_add,
    input  wire                  in_ask,
    input  wire                  in_taken,
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

    // Products: a bit of f or of z a clock from the lowest on, the last one is the sign. What leaves below is final
    localparam [31:0] LAST_F = W + 3, LAST_Z = W - 1;
    reg                  busy;
    wire                 lifts;        // K z, or nothing yet
    reg         [4:0]    left;         // bits behind this one
    reg         [W+3:0]  bits;
    reg  signed [W+7:0]  total;
    wire                 load_z, load_f;
    wire        [W+4:0]  other = lifts ? {1'b0, GROWTH[31 -: W+4]} : out_a;
    wire signed [W+6:0]  upper = {total[W+7], total[W+7:2]};
    wire signed [W+6:0]  term = {2'b00, other & {(W+5){bits[0]}}};
    wire signed [W+6:0]  sum = left == 5'd0 ? upper - term : upper + term;
    assign out_product = total;
    always @(posedge clk)
        if (load_z || load_f) begin
            busy  <= 1'b1;
            left  <= load_z ? LAST_Z[4:0] : LAST_F[4:0];
            bits  <= load_z ? {4'd0, in_z} : in_f;
            total <= {(W+8){1'b0}};
        end else if (busy) begin
            busy  <= left != 5'd0;
            left  <= left - 5'd1;
            bits  <= bits >> 1;
            total <= {sum, total[1]};
        end

    // Squares, one a clock
    reg  signed [W-1:0] side, next_side, last_side;
    wire [2*W-1:0]      square;
    product_parts #(.A(W), .B(W), .MULTIPLY(MULTIPLY)) squares (.clk(clk), .in_move(1'b1), .in_a(side),
        .in_b(side), .out_p(square));
    assign begun = in_ask;
    always @(posedge clk) begin
        {side, next_side, last_side} <= in_start ? {in_x, in_y, in_z} : {next_side, last_side, last_side};
        if (in_start) q <= {2*W{1'b0}};
        else if (in_add) q <= q + square;
    end
    generate
        if (JOINTS == 2) begin : g_plane
            wire unused = &{1'b0, in_taken};
            assign {lifts, load_z, load_f} = {2'b00, accept && second};
        end else begin : g_space
            reg lift, solved, taken;
            assign {lifts, load_z, load_f} = {lift, in_start, lift && solved && taken};
            always @(posedge clk) begin
                lift   <= in_start || lift && !load_f;
                solved <= !in_start && (solved || accept && second);
                taken  <= !in_start && (taken || in_taken);
            end
        end
    endgenerate
endmodule
`default_nettype wire
