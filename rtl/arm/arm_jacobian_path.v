// SPDX-License-Identifier: Apache-2.0
// Datapath of arm_jacobian, whose cycle table controls it: in_op is one line of that table, column by column. Ports,
// formats, error and models are those of arm_jacobian. in_start loads in_c1 ... in_w3 at the end of its clock.
`default_nettype none
module arm_jacobian_path #(
    parameter W = 16,  // bits of a length, a rate and a velocity, 8 to 18 (default 16)
    parameter U = 16,  // fraction bits of cosine and sine, 8 to 18 (default 16)
    parameter V = 12   // fraction bits of a rate, W - 8 to W - 1 and at most U (default 12)
) (
    input  wire                clk,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_start,
    input  wire [17:0]         in_op,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire signed [U+1:0] in_c2,
    input  wire signed [U+1:0] in_n2,
    input  wire signed [U+1:0] in_c3,
    input  wire signed [U+1:0] in_n3,
    input  wire signed [W-1:0] in_w1,
    input  wire signed [W-1:0] in_w2,
    input  wire signed [W-1:0] in_w3,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire                out_overflow
);
    localparam G = 4, N = 2*W - V + 3 + G;  // guard bits; bits of a velocity word
    localparam M = W + 1 + U - V, X = W - 1 - V;  // bits of a left operand; integer bits it has more than a cosine
    wire [2:0] left1_from, left2_from;
    wire [4:0] right_from;
    wire       add, to_a, to_b, to_p, to_q, to_z, to_x;
    assign     {left1_from, left2_from, right_from, add, to_a, to_b, to_p, to_q, to_z, to_x} = in_op;

    // Left operands are c, n and the rates, aligned to U fraction bits; right ones are lengths and velocities. Both are
    // selected one clock before their product: the left operand is registered, and so is the select of the right one
    reg  signed [M-1:0] c1, n1, c3, n3, s, w2, w3, left1, left2, next1, next2;
    reg  signed [N-1:0] a, b, p, q, right1, right2;
    reg         [4:0]   right;
    wire        [N-1:0] l1 = {{(N-W-G){1'b0}}, cfg_l1, {G{1'b0}}}, l2 = {{(N-W-G){1'b0}}, cfg_l2, {G{1'b0}}};
    wire        [W:0]   both = {in_w1[W-1], in_w1} + {in_w2[W-1], in_w2};
    always @* begin
        case (left1_from)
            3'd1: next1 = s;
            3'd2: next1 = c1;
            3'd3: next1 = n1;
            3'd4: next1 = w3;
            3'd5: next1 = c3;
            3'd6: next1 = n3;
            default: next1 = {M{1'b0}};
        endcase
        case (left2_from)
            3'd1: next2 = w2;
            3'd2: next2 = s;
            3'd3: next2 = n1;
            3'd4: next2 = c1;
            3'd5: next2 = n3;
            3'd6: next2 = c3;
            default: next2 = {M{1'b0}};
        endcase
        case (right[4:3])
            2'd1: right1 = a;
            2'd2: right1 = q;
            2'd3: right1 = p;
            default: right1 = l2;
        endcase
        case (right[2:1])
            2'd1: right2 = l1;
            2'd2: right2 = b;
            2'd3: right2 = p;
            default: right2 = l2;
        endcase
        right2 = right2 ^ {N{right[0]}};
    end
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [M+N-1:0] product1 = left1 * right1, product2 = left2 * right2;
    /* verilator lint_on UNUSEDSIGNAL */
    // When L1 is added to the first product, the second product alone goes to b
    wire [N-1:0] cut1 = product1[N+U-1:U], cut2 = product2[N+U-1:U];
    wire [N-1:0] sum = cut1 + (add ? l1 : cut2);

    // The outputs are a, rounded and saturated
    wire [N-G-1:0] nearest = a[N-1:G] + {{(N-G-1){1'b0}}, a[G-1]};
    wire           over = nearest[N-G-1:W-1] != {(N-G-W+1){nearest[N-G-1]}};
    reg            over_before;
    assign         out_y = over ? {nearest[N-G-1], {(W-1){!nearest[N-G-1]}}} : nearest[W-1:0];
    assign         out_overflow = over || over_before;
    always @(posedge clk) begin
        if (in_start) begin
            c1 <= {{X{in_c1[U+1]}}, in_c1};
            n1 <= {{X{in_n1[U+1]}}, in_n1};
            c3 <= {{X{in_c3[U+1]}}, in_c3};
            n3 <= {{X{in_n3[U+1]}}, in_n3};
            s  <= {both, {(U-V){1'b0}}};
            w2 <= {in_w2[W-1], in_w2, {(U-V){1'b0}}};
            w3 <= {in_w3[W-1], in_w3, {(U-V){1'b0}}};
        end
        left1 <= in_start ? {{X{in_c2[U+1]}}, in_c2} : next1;
        left2 <= in_start ? {{X{in_n2[U+1]}}, in_n2} : next2;
        right <= right_from;
        if (to_a)
            a <= sum;
        if (to_b)
            b <= add ? cut2 : sum;
        if (to_p)
            p <= sum;
        if (to_q)
            q <= sum;
        if (to_z)
            out_z <= out_y;
        if (to_x)
            out_x <= out_y;
        if (in_start || to_z || to_x)
            over_before <= !in_start && (over || over_before);
    end
endmodule
`default_nettype wire
