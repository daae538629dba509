// SPDX-License-Identifier: Apache-2.0
// Unit vector of a turn-spread word: |c| = sqrt(1 - s), |n| = sqrt(s), signs by quadrant, combinational.
//   s = f in even quadrants, 1 - f in odd ones; c < 0 for k = 1, 2; n < 0 for k = 2, 3
// Formats: in_j u2.S; out_c out_n s2.U (1.0 is 2^U), rounded to nearest, ties outward.
// Error: <= 1/2 LSB. Roots truncated below their rounding bit round alike, so bits of f past 2U+2 change nothing.
// Monotone in each quadrant and continuous over its borders: f = 0 gives exactly 0 and 1.
// Latency 0. Source: paper eqs. 3 and 5-6 with Table I in the continuous reading.
// Model: codecs.spread_to_vector
`default_nettype none
module spread_to_vector_comb #(
    parameter S = 24,
    parameter U = 16
) (
    input  wire [S+1:0] in_j,
    output wire [U+1:0] out_c,
    output wire [U+1:0] out_n
);
    wire [2*U+1:0] radicand_f, radicand_g;
    wire [U:0]     root_f, root_g;
    wire [U+1:0]   rem_f, rem_g;
    wire           unused = &{1'b0, rem_f, rem_g};

    spread_to_vector_ports #(.S(S), .U(U)) ports (
        .in_f(in_j[S-1:0]), .out_radicand_f(radicand_f), .out_radicand_g(radicand_g),
        .in_j_then(in_j), .in_root_f(root_f), .in_root_g(root_g), .out_c(out_c), .out_n(out_n));
    isqrt_comb #(.W(2*U+2)) root_of_f (.in_d(radicand_f), .out_root(root_f), .out_rem(rem_f));
    isqrt_comb #(.W(2*U+2)) root_of_g (.in_d(radicand_g), .out_root(root_g), .out_rem(rem_g));
endmodule
`default_nettype wire
