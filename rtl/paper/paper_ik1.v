// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of one joint, the paper's way: the spread is a quotient of quadrances.
//   s1 = qy / (qx + qy), qx = x^2, qy = y^2; out_j1 = {k, s1} in even quadrants, {k, 1 - s1} in odd ones
// Formats: in_x in_y s(W-F).F, out_j1 turn-spread u2.S modulo 4, rounded to nearest.
// Error: arithmetic <= 1/2 LSB of the spread (all S+1 quotient bits are exact; the last one rounds).
// Latency and II: 1 + ceil((S+1) / 3). Clock 1: squares and their sum; then three quotient bits a clock.
// Status: singular (x = y = 0: the last joint word is held)
// Source: paper eq. 9, quadrant by the signs of x and y (Table I); the paper does not recover the quadrant
// Model: paper.ik1
`default_nettype none
module paper_ik1 #(
    parameter W = 16,
    parameter F = 8,
    parameter S = 8
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [W-1:0] in_x,
    input  wire [W-1:0] in_y,
    output reg          out_valid,
    input  wire         out_ready,
    output wire [S+1:0] out_j1,
    output wire [3:0]   out_status
);
    localparam R = 3;              // quotient bits a clock
    localparam M = (S + R) / R;  // clocks of the division
    localparam N = R * M;          // quotient bits, those below the rounding bit are dropped

    generate
        if (W < 4 || W > 18 || F < 0 || F >= W || S < 2 || S > 24) begin : g_illegal
            paper_ik1_needs_W_from_4_to_18_F_below_W_and_S_from_2_to_24 rule ();
        end
    endgenerate

    wire               accept = in_valid && in_ready;
    wire [2*W-1:0]     qx = $signed(in_x) * $signed(in_x);
    wire [2*W-1:0]     qy = $signed(in_y) * $signed(in_y);
    wire               nothing = ~|in_x && ~|in_y;

    reg  [2*W-1:0]     d, rem;
    reg  [1:0]         k;
    reg  [N-1:0]       digits;
    reg                singular;
    reg  [M-1:0]       step;  // one-hot, M-1 down to 0
    wire [2*W-1:0]     next_rem;
    wire [R-1:0]       next;

    divide_digits #(.K(2*W), .R(R), .WD(2*W)) divide (
        .in_rem(rem), .in_d(d), .in_bits({R{1'b0}}), .out_rem(next_rem), .out_q(next));

    always @(posedge clk) begin
        if (accept) begin
            d        <= qx + qy;
            rem      <= qy;
            singular <= nothing;
        end else
            rem <= next_rem;
        if (rst) begin
            k      <= 2'd0;
            digits <= {N{1'b0}};
        end else begin
            if (accept && !nothing) k <= {in_y[W-1], in_y[W-1] ^ in_x[W-1]};
            // 1 - s has the inverted digits of s
            if (|step && !singular) digits <= {digits[N-R-1:0], next ^ {R{k[0]}}};
        end
    end

    // the carry of the rounding steps into the next quadrant: s = 1 there is the border between the two
    assign out_j1 = {k, digits[N-1 -: S]} + {{(S+1){1'b0}}, digits[N-S-1]};
    wire   unused = &{1'b0, digits};
    assign out_status = {2'b00, singular, 1'b0};
    assign in_ready = ~|step && (!out_valid || out_ready);
    always @(posedge clk) begin
        step      <= {accept, {(M-1){1'b0}}} | step >> 1;
        out_valid <= step[0] || (out_valid && !out_ready);
        if (rst) begin
            step      <= {M{1'b0}};
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
