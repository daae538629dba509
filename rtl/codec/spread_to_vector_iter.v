// SPDX-License-Identifier: Apache-2.0
// Unit vector of a turn-spread word: |c| = sqrt(1 - s), |n| = sqrt(s), R digits of both roots a clock.
//   s = f in even quadrants, 1 - f in odd ones; c < 0 for k = 1, 2; n < 0 for k = 2, 3
// Formats: in_j u2.S; out_c out_n s2.U (1.0 is 2^U), rounded to nearest, ties outward.
// Error: <= 1/2 LSB; bit-identical to spread_to_vector_comb.
// Latency and II: ceil((U+1) / R).
// Source: paper eqs. 3 and 5-6 with Table I in the continuous reading. Model: codecs.spread_to_vector
`default_nettype none
module spread_to_vector_iter #(
    parameter S = 24,
    parameter U = 16,
    parameter R = 2
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [S+1:0] in_j,
    output wire         out_valid,
    input  wire         out_ready,
    output wire [U+1:0] out_c,
    output wire [U+1:0] out_n
);
    generate
        if (R < 1 || R > U) begin : g_illegal
            spread_to_vector_iter_needs_R_from_1_to_U rule ();
        end
    endgenerate

    reg  [S+1:0]   j;
    wire [2*U+1:0] radicand_f, radicand_g;
    wire [U:0]     root_f, root_g;
    wire [U+1:0]   rem_f, rem_g;
    wire           ready_g, valid_g;  // both roots walk in step
    wire           unused = &{1'b0, rem_f, rem_g, ready_g, valid_g};

    spread_to_vector_ports #(.S(S), .U(U)) ports (
        .in_f(in_j[S-1:0]), .out_radicand_f(radicand_f), .out_radicand_g(radicand_g),
        .in_j_then(j), .in_root_f(root_f), .in_root_g(root_g), .out_c(out_c), .out_n(out_n));
    isqrt_iter #(.W(2*U+2), .R(R)) root_of_f (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_d(radicand_f),
        .out_valid(out_valid), .out_ready(out_ready), .out_root(root_f), .out_rem(rem_f));
    isqrt_iter #(.W(2*U+2), .R(R)) root_of_g (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(ready_g), .in_d(radicand_g),
        .out_valid(valid_g), .out_ready(out_ready), .out_root(root_g), .out_rem(rem_g));
    always @(posedge clk)
        if (in_valid && in_ready)
            j <= in_j;
endmodule
`default_nettype wire
