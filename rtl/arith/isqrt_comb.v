// SPDX-License-Identifier: Apache-2.0
// This core computes the square root of an unsigned word, with F extra fraction bits. Combinational.
//   out_root = floor(sqrt(in_d * 4^F)), out_rem = in_d * 4^F - out_root^2 <= 2 out_root
// Formats: in_d is uW.0, out_root u(ceil(W/2)).F; out_rem is exact. in_d uW.2f gives out_root with f + F fraction bits.
// Error: truncation, 0 <= sqrt - out_root < 1 LSB. The nearest root is out_root + (out_rem > out_root).
// Model: arith.isqrt
`default_nettype none
module isqrt_comb #(
    parameter W = 16,  // bits of the radicand, 1 or more, W + 2 F to 62 (default 16)
    parameter F = 0    // further fraction bits of the root, 0 or more (default 0)
) (
    input  wire [W-1:0]         in_d,
    output wire [(W+1)/2+F-1:0] out_root,
    output wire [(W+1)/2+F:0]   out_rem
);
    localparam N = (W + 1) / 2 + F;  // digits
    wire [2*N-1:0] d = {{(W%2){1'b0}}, in_d, {(2*F){1'b0}}};
    wire       root = |d[2*N-1 -: 2];
    wire [1:0] rem = {&d[2*N-1 -: 2], d[2*N-1] & ~d[2*N-2]};
    generate
        if (W < 1 || F < 0 || W + 2*F > 62) begin : g_illegal
            isqrt_comb_needs_W_from_1_F_from_0_and_W_plus_2F_to_62 rule ();
        end
        if (N == 1) begin : g_one
            assign {out_rem, out_root} = {rem, root};
        end else begin : g_more
            isqrt_digits #(.K(1), .R(N-1)) digits (
                .in_rem(rem), .in_root(root), .in_pairs(d[2*N-3:0] ^ {(N-1){2'b01}}),
                .out_rem(out_rem), .out_root(out_root));
        end
    endgenerate
endmodule
`default_nettype wire
