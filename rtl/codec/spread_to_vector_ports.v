// SPDX-License-Identifier: Apache-2.0
// What comes before and after the roots of a turn-spread word, shared by the _comb and _iter codecs.
//   before: radicands of f and g = 1 - f, cut to the 2U+2 bits whose root has one bit below the LSB
//   after: round, put the roots on c and n by quadrant, give them their signs
// Formats: in_f u0.S, in_j_then u2.S; radicands u0.(2U+2); roots u0.(U+1); out_c out_n s2.U.
// g = 1 (f = 0) does not fit its radicand: its root, with those that round to 1 as well, is replaced by 1 after.
// Model: codecs.spread_to_vector
`default_nettype none
module spread_to_vector_ports #(
    parameter S = 24,
    parameter U = 16
) (
    input  wire [S-1:0]   in_f,
    output wire [2*U+1:0] out_radicand_f,
    output wire [2*U+1:0] out_radicand_g,
    input  wire [S+1:0]   in_j_then,  // the word that the roots belong to
    input  wire [U:0]     in_root_f,
    input  wire [U:0]     in_root_g,
    output wire [U+1:0]   out_c,
    output wire [U+1:0]   out_n
);
    generate
        if (S < 1 || S > 31 || U < 1 || U > 30) begin : g_illegal
            spread_to_vector_ports_needs_S_from_1_to_31_and_U_from_1_to_30 rule ();
        end
    endgenerate

    wire [S-1:0]     g = ~in_f + 1'b1;
    wire [2*U+S+1:0] wide_f = {in_f, {(2*U+2){1'b0}}};
    wire [2*U+S+1:0] wide_g = {g, {(2*U+2){1'b0}}};
    assign out_radicand_f = wide_f[2*U+S+1 -: 2*U+2];
    assign out_radicand_g = wide_g[2*U+S+1 -: 2*U+2];

    localparam NEAR = S > U + 1 ? S - U - 1 : 0;  // g > 1 - 2^-(U+1) is 1 to the nearest

    wire [1:0] k = in_j_then[S+1:S];
    wire       one = ~|in_j_then[S-1:NEAR];
    wire [U:0] near_f = {1'b0, in_root_f[U:1]} + {{U{1'b0}}, in_root_f[0]};
    wire [U:0] near_g = one ? {1'b1, {U{1'b0}}} : {1'b0, in_root_g[U:1]} + {{U{1'b0}}, in_root_g[0]};
    wire [U:0] c = k[0] ? near_f : near_g;
    wire [U:0] n = k[0] ? near_g : near_f;
    wire       c_minus = k[1] ^ k[0];
    wire       n_minus = k[1];
    wire       unused = &{1'b0, wide_f, wide_g, in_j_then};
    assign out_c = ({1'b0, c} ^ {(U+2){c_minus}}) + {{(U+1){1'b0}}, c_minus};
    assign out_n = ({1'b0, n} ^ {(U+2){n_minus}}) + {{(U+1){1'b0}}, n_minus};
endmodule
`default_nettype wire
