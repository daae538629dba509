// SPDX-License-Identifier: Apache-2.0
// R fraction digits of a quotient of quadrances that is at most 1, restoring, combinational: a spread is one.
//   in_rem 2^R = out_digits in_d + out_rem, 0 <= in_rem <= in_d; in_rem = in_d gives ones and keeps the remainder
// 2 rem - d = {rem, 1} + ~d: the digit that is not there carries the increment, so a row costs no cell for it.
// Model: paper.quotient
`default_nettype none
module paper_quotient #(
    parameter Q = 22,
    parameter R = 3
) (
    input  wire [Q-1:0] in_rem,
    input  wire [Q-1:0] in_d,
    output wire [Q-1:0] out_rem,
    output wire [R-1:0] out_digits
);
    genvar i;
    generate
        if (Q < 1 || R < 1) begin : g_illegal
            paper_quotient_needs_Q_and_R_from_1 rule ();
        end
        for (i = 0; i < R; i = i + 1) begin : g_digit
            wire [Q-1:0] rem;
            wire [Q:0]   trial = {rem, 1'b1} + {1'b1, ~in_d};
            wire [Q-1:0] next = trial[Q] ? {rem[Q-2:0], 1'b0} : trial[Q-1:0];
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
