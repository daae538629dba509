// SPDX-License-Identifier: Apache-2.0
// This part gives R fraction digits of a quotient of two quadrances, which is a spread and so at most 1.
//   in_rem 2^R = out_digits in_d + out_rem, 0 <= in_rem <= in_d; in_rem = in_d gives ones and keeps the remainder
// Formats: in_rem, in_d and out_rem are uQ in one scale, out_digits u0.R. Truncated; exact with the remainder.
// Restoring, combinational. 2 rem - d = {rem, 1} + ~d: the free bit below 2 rem carries the increment of -d, so a row
// costs no cell for it.
// Model: paper.quotient
`default_nettype none
module paper_quotient #(
    parameter Q = 22,  // bits of remainder and divisor, 1 to 61 (default 22: a quadrance of paper_fk2 at S = 8)
    parameter R = 3    // digits, 1 to 62 (default 3: what paper_chain computes a clock)
) (
    input  wire [Q-1:0] in_rem,
    input  wire [Q-1:0] in_d,
    output wire [Q-1:0] out_rem,
    output wire [R-1:0] out_digits
);
    genvar i;
    generate
        if (Q < 1 || R < 1 || Q > 61 || R > 62) begin : g_illegal
            paper_quotient_needs_Q_from_1_to_61_and_R_from_1_to_62 rule ();
        end
        for (i = 0; i < R; i = i + 1) begin : g_digit
            wire [Q-1:0] rem;
            wire [Q:0]   trial = {rem, 1'b1} + {1'b1, ~in_d};
            wire [Q-1:0] next = trial[Q] ? rem << 1 : trial[Q-1:0];
            assign out_digits[R-1-i] = !trial[Q];
            if (i == 0) begin : g_first
                assign rem = in_rem;
            end else begin : g_next
                assign rem = g_digit[i-1].next;
            end
        end
    endgenerate
    assign out_rem = g_digit[R-1].next;
endmodule
`default_nettype wire
