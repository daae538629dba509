// SPDX-License-Identifier: Apache-2.0
// Datapath of arm_inverse, whose cycle table controls it: in_op is one line of that table, column by column. Ports,
// formats, error and models are those of arm_inverse. in_start loads in_c1 ... in_z at the end of its clock. out_q is
// the quotient and out_zero says that its divisor was 0. out_near: |n2| is below cfg_sine, or the last divisor was
// cfg_radius. The outputs are combinational in the registers.
`default_nettype none
module arm_inverse_path #(
    parameter JOINTS = 2,  // joints, 2 (default) in the plane, or 3
    parameter W = 16,  // bits of a length, a rate and a velocity, 8 to 18 (default 16)
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 18 (default 16)
    parameter V = 12,  // fraction bits of a rate, W - 8 to W - 1 and at most U (default 12)
    parameter R = 4    // digits of a quotient in one clock, 1 to 5 (default 4)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire [U:0]          cfg_sine,
    input  wire [W-1:0]        cfg_radius,
    input  wire                in_start,
    input  wire [21:0]         in_op,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    output wire signed [W+1:0] out_q,
    output wire                out_zero,
    output wire                out_near
);
    localparam G = 4, N = 2*W - V + 3 + G, M = W + 2 + U - V, X = W - V, L = W + 4 + G;  // L: bits of a divisor
    wire       keep, to_t, to_xy, to_p, to_q, to_a, to_b, start;
    wire [1:0] left1_from, what;
    wire [2:0] left2_from;
    wire [6:0] right_from;
    assign {keep, left1_from, left2_from, right_from, to_t, to_xy, to_p, to_q, to_a, to_b, start, what} = in_op;

    // Operands are selected one clock before their product: the left operand is registered, and so is the select of
    // the right one. left2 may be |n2|, or cfg_sine in its place
    reg  signed [M-1:0] c1, n1, c2, n2, left1, left2, next1, next2;
    reg  signed [N-1:0] x, y, z, t, p, q, a, b, right1, right2;
    reg  [6:0]    right;
    wire [N-1:0]  l1 = {{(N-W-G){1'b0}}, cfg_l1, {G{1'b0}}}, l2 = {{(N-W-G){1'b0}}, cfg_l2, {G{1'b0}}};
    wire [M-1:0]  one = {{(M-U-1){1'b0}}, 1'b1, {U{1'b0}}};
    wire [U+1:0]  sine = n2[U+1] ? -n2[U+1:0] : n2[U+1:0];
    wire          flat = sine < {1'b0, cfg_sine};
    always @* begin
        case (left1_from)
            2'd1: next1 = one;
            2'd2: next1 = c1;
            default: next1 = c2;
        endcase
        case (left2_from)
            3'd1: next2 = {out_q, {(U-V){1'b0}}};
            3'd2: next2 = n1;
            3'd3: next2 = n2;
            3'd4: next2 = c1;
            default: next2 = {{(M-U-2){1'b0}}, flat ? {1'b0, cfg_sine} : sine};
        endcase
        case (right[6:4])
            3'd1: right1 = x;
            3'd2: right1 = l2;
            3'd3: right1 = q;
            3'd4: right1 = l1;
            3'd5: right1 = p;
            default: right1 = y;
        endcase
        case (right[3:1])
            3'd1: right2 = y;
            3'd2: right2 = l2;
            3'd3: right2 = a;
            3'd4: right2 = b;
            default: right2 = x;
        endcase
        right2 = right2 ^ {N{!right[0]}};
    end
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [M+N-1:0] product1 = left1 * right1, product2 = left2 * right2;
    /* verilator lint_on UNUSEDSIGNAL */
    wire [N-1:0] cut1 = product1[N+U-1:U], cut2 = product2[N+U-1:U];
    wire [N-1:0] sum = cut1 + cut2;

    // Quotients v'x / |f|, (v'y - e s) / L1 and v_t / |rho|; lengths fit L bits
    wire [L-1:0] size = p[L-1:0] ^ {L{p[N-1]}}, radius = {4'd0, cfg_radius, {G{1'b0}}};
    wire         close = size < radius;
    reg          was_close;
    wire [L-1:0] divisor = what[1] ? (close ? radius : size) : what[0] ? l1[L-1:0] : b[L-1:0];
    arm_quotient #(.W(W), .V(V), .N(N), .D(L), .R(R)) quotient (
        .clk(clk), .rst(rst), .in_start(start), .in_n(what[1] ? t : what[0] ? q : p),
        .in_negative(what[1] ? p[N-1] : !what[0] && !n2[U+1]), .in_d(divisor), .out_q(out_q), .out_zero(out_zero));
    assign       out_near = flat || was_close;
    always @(posedge clk) begin
        if (in_start) begin
            c1 <= {{X{in_c1[U+1]}}, in_c1};
            n1 <= {{X{in_n1[U+1]}}, in_n1};
            c2 <= {{X{in_c2[U+1]}}, in_c2};
            n2 <= {{X{in_n2[U+1]}}, in_n2};
            z  <= {{(N-W-G){in_z[W-1]}}, in_z, {G{1'b0}}};
        end
        if (!keep) begin
            left1 <= !in_start ? next1 : JOINTS == 3 ? {{X{in_c3[U+1]}}, in_c3} : {{X{in_c1[U+1]}}, in_c1};
            left2 <= !in_start ? next2 : JOINTS == 3 ? {{X{in_n3[U+1]}}, in_n3} : {{X{in_n1[U+1]}}, in_n1};
        end
        right <= right_from;
        if (in_start || to_xy) begin
            x <= in_start ? {{(N-W-G){in_x[W-1]}}, in_x, {G{1'b0}}} : sum;
            y <= in_start ? {{(N-W-G){in_y[W-1]}}, in_y, {G{1'b0}}} : z;
        end
        if (to_t)
            t <= sum;
        if (to_p)
            p <= sum;
        if (to_q)
            q <= sum;
        if (to_a)
            a <= cut1;
        if (to_b)
            b <= cut2;
        if (start)
            was_close <= what[1] && close;
    end
endmodule
`default_nettype wire
