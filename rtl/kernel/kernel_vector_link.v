// SPDX-License-Identifier: Apache-2.0
// One link of kernel_vector_sum or kernel_vector_space at PIPE = 1: its direction, then its length times that.
//   (C, N) <- (C c - N n, C n + N c), from (1, 0) on; out_along = L C, one clock later L N
// in_at[i]: a link is in its clock i. (c, n) is taken in the clock before clock 1, in_l, in_yaw and in_last in clock 3;
// out_along is L C in clock 5 and L N in clock 6.
// in_yaw: the vector does not turn (C, N); it is at out_c1, out_n1 in clock 3. in_last: (C, N) restarts at (1, 0).
// Formats: vectors s2.U; in_l uW; C, N s2.(U+G); out_along s(W+2).(G+1). Error: every product is truncated, and a
// constant 1 centres each sum of (C, N).
// Latency 5, II 3; while in_move is low all registers are held, but for a reset.
// Source: that of the kernels. Model: chain.vector_directions
`default_nettype none
module kernel_vector_link #(
    parameter W = 16,        // bits of a length, 4 to 24 (default 16)
    parameter U = 16,        // fraction bits of cosine and sine, 4 to 24 (default 16)
    parameter G = 8,         // guard bits of C and N, 4 to 9 (default 8, for 32 links)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_move,
    input  wire [3:1]          in_at,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire [W-1:0]        in_l,
    input  wire                in_yaw,
    input  wire                in_last,
    output wire signed [U+1:0] out_c1,
    output wire signed [U+1:0] out_n1,
    output wire [W+G+2:0]      out_along
);
    localparam V = U + 2 + G;  // bits of C and N
    localparam [V-1:0] ONE = {2'b01, {(U+G){1'b0}}};
    localparam
        COSINE = 1,  // products of the cosine
        SINE   = 2,  // products of the sine; those of the cosine are truncated
        TURNED = 3;  // both sums

    // C c - N n without a word for -n: floor(-(N n 2^G + N) / 2^(U+G)) + 1 = -floor((N n + less) / 2^U)
    reg  signed [V-1:0] cosine, sine;  // of the previous link
    reg  signed [U+1:0] r1, r2;        // (c, n), then (n, c), then (c, n)
    reg  signed [U+2:0] less;          // floor((N - 1) / 2^G)
    reg         [V-1:0] kept, gone;    // C c, N n + less
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [V:0]     lower = {sine[V-1], sine} - 1'b1;
    wire signed [V+U+1:0] product1, product2;
    wire signed [V+U+1:0] shifted = product2 + {{(V-1){less[U+2]}}, less};
    wire signed [V+W:0]   product3;
    /* verilator lint_on UNUSEDSIGNAL */
    product_parts #(.A(V), .B(U+2), .MULTIPLY(MULTIPLY)) turn1 (.clk(clk), .in_move(in_move), .in_a(cosine),
        .in_b(r1), .out_p(product1));
    product_parts #(.A(V), .B(U+2), .MULTIPLY(MULTIPLY)) turn2 (.clk(clk), .in_move(in_move), .in_a(sine),
        .in_b(r2), .out_p(product2));
    wire [V-1:0] cut1 = product1[U +: V], cut2 = product2[U +: V];
    wire [V-1:0] new_cosine = kept - gone;
    wire [V-1:0] new_sine = cut1 + cut2 + {{(V-1){1'b0}}, 1'b1};  // the 1 centres both truncations
    assign       {out_c1, out_n1} = {r1, r2};

    // The third multiplier has the length of a link while the others turn the next one
    reg  signed [V-1:0] factor, other;  // C, N; N, which the next chain restarts in sine
    reg         [W-1:0] reach;
    product_parts #(.A(V), .B(W+1), .MULTIPLY(MULTIPLY)) along (.clk(clk), .in_move(in_move), .in_a(factor),
        .in_b({1'b0, reach}), .out_p(product3));
    assign              out_along = product3[U-1 +: W+G+3];

    always @(posedge clk) begin
        if (in_move) begin
            {r1, r2} <= in_at[COSINE] || in_at[SINE] ? {r2, r1} : {in_c1, in_n1};
            less     <= lower[V:G];
            kept     <= cut1;
            gone     <= shifted[U +: V];
            factor   <= in_at[TURNED] ? new_cosine : other;
            if (in_at[TURNED]) begin
                other <= new_sine;
                reach <= in_l;
            end
            if (in_at[TURNED] && !in_yaw) begin
                cosine <= new_cosine;
                sine   <= new_sine;
            end
        end
        if (rst || (in_at[TURNED] && in_move && in_last)) begin
            cosine <= ONE;
            sine   <= {V{1'b0}};
        end
    end
endmodule
`default_nettype wire
