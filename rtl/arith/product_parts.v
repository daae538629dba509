// SPDX-License-Identifier: Apache-2.0
// This part multiplies two signed words on multipliers of MULTIPLY bits, with a register behind each of them.
//   out_p = in_a * in_b of the clock before
// A word longer than MULTIPLY is cut into a high part and MULTIPLY - 1 low bits, so a product takes one, two or four
// multipliers, and their sum follows the registers. A tool that splits a product adds in front of the register.
// Error: none. Latency 1; out_p is held while in_move is low. Model: the product
`default_nettype none
module product_parts #(
    parameter A = 23,        // bits of in_a, 2 to 2 MULTIPLY - 1 (default 23)
    parameter B = 18,        // bits of in_b, 2 to 2 MULTIPLY - 1 (default 18)
    parameter MULTIPLY = 18  // bits of a factor of the chip's multiplier, 18 or 27 (default 18)
) (
    input  wire                  clk,
    input  wire                  in_move,
    input  wire signed [A-1:0]   in_a,
    input  wire signed [B-1:0]   in_b,
    output wire signed [A+B-1:0] out_p
);
    localparam L = MULTIPLY - 1;                  // bits of a low part
    localparam X = A > B ? A : B, Y = A + B - X;  // bits of the longer word, of the shorter one
    wire signed [X-1:0] x;
    wire signed [Y-1:0] y;
    generate
        if (A < 2 || A > 2 * MULTIPLY - 1 || B < 2 || B > 2 * MULTIPLY - 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0) begin : g_illegal
            product_parts_needs_MULTIPLY_18_or_27_and_A_and_B_from_2_to_2_MULTIPLY_less_1 rule ();
        end
        if (A > B) begin : g_same
            assign x = in_a;
            assign y = in_b;
        end else begin : g_swapped
            assign x = in_b;
            assign y = in_a;
        end
        /* verilator lint_off UNUSEDSIGNAL */
        if (X <= MULTIPLY) begin : g_one
            reg signed [X+Y-1:0] whole;
            assign out_p = whole;
            always @(posedge clk)
                if (in_move)
                    whole <= x * y;
        end
        if (X > MULTIPLY && Y <= MULTIPLY) begin : g_two
            reg  signed [X+Y-L-1:0] high;
            reg  signed [L+Y:0]     low;
            wire        [X+Y-L-1:0] upper = high + {{(X-L){low[L+Y]}}, low[L+Y-1:L]};
            assign                  out_p = {upper, low[L-1:0]};
            always @(posedge clk)
                if (in_move) begin
                    high <= $signed(x[X-1:L]) * y;
                    low  <= $signed({1'b0, x[L-1:0]}) * y;
                end
        end
        if (Y > MULTIPLY) begin : g_four
            reg  signed [X+Y-2*L-1:0] high;
            reg  signed [2*L+1:0]     low;
            reg  signed [X:0]         right;
            reg  signed [Y:0]         left;
            wire        [X+Y-L-1:0]   middle = {{(Y-L-1){right[X]}}, right} + {{(X-L-1){left[Y]}}, left};
            wire        [X+Y-L-1:0]   upper = {high, low[2*L-1:L]} + middle;
            assign                    out_p = {upper, low[L-1:0]};
            always @(posedge clk)
                if (in_move) begin
                    high  <= $signed(x[X-1:L]) * $signed(y[Y-1:L]);
                    low   <= $signed({1'b0, x[L-1:0]}) * $signed({1'b0, y[L-1:0]});
                    right <= $signed(x[X-1:L]) * $signed({1'b0, y[L-1:0]});
                    left  <= $signed({1'b0, x[L-1:0]}) * $signed(y[Y-1:L]);
                end
        end
        /* verilator lint_on UNUSEDSIGNAL */
    endgenerate
endmodule
`default_nettype wire
