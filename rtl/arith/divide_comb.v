// SPDX-License-Identifier: Apache-2.0
// This core divides unsigned words, with F extra fraction bits of the quotient. Combinational.
//   in_n * 2^F = out_q * in_d + out_r, 0 <= out_r < in_d
// Formats: in_n is uWN.0, in_d uWD.0, out_q uWN.F; out_r is exact. Error: truncation, 0 <= n/d - out_q < 1 LSB.
// Status: in_d = 0 raises out_div_by_zero; out_q is then all ones and out_r = in_n * 2^F mod 2^WD.
// Model: arith.divide
`default_nettype none
module divide_comb #(
    parameter WN = 16,  // bits of the numerator, 1 or more, WN + F to 62 (default 16)
    parameter WD = 16,  // bits of the divisor, 1 to 62 (default 16)
    parameter F  = 0    // further fraction bits of the quotient, 0 or more (default 0)
) (
    input  wire [WN-1:0]   in_n,
    input  wire [WD-1:0]   in_d,
    output wire [WN+F-1:0] out_q,
    output wire [WD-1:0]   out_r,
    output wire            out_div_by_zero
);
    localparam N = WN + F;             // digits
    localparam B = N < WD ? N : WD;    // bits of the remainder
    wire [B-1:0] rem;
    generate
        if (WN < 1 || WD < 1 || F < 0 || WN + F > 62 || WD > 62) begin : g_illegal
            divide_comb_needs_WN_from_1_F_from_0_WN_plus_F_to_62_and_WD_from_1_to_62 rule ();
        end
    endgenerate
    divide_digits #(.K(0), .R(N), .WD(WD)) digits (
        .in_rem(1'b0), .in_d(in_d), .in_bits({in_n, {F{1'b0}}}), .out_rem(rem), .out_q(out_q));
    assign out_r = {{(WD-B){1'b0}}, rem};
    assign out_div_by_zero = ~|in_d;
endmodule
`default_nettype wire
