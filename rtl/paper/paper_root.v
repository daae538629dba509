// SPDX-License-Identifier: Apache-2.0
// This part is a non-restoring square root, combinational: the paper's kind of root (its reference 27).
//   out_root = floor(sqrt(in_d)), in_d u(2N).0, out_root uN.0
// Error: truncation, 0 <= sqrt - root < 1.
// A row adds or subtracts 4 root + 1 or 3 and never restores. The sign of its result is the digit and selects between
// addition and subtraction in the next row.
// Model: paper.root
`default_nettype none
module paper_root #(
    parameter N = 15  // digits of the root, 2 to 31 (default 15: a coordinate of Q7.8 without its sign)
) (
    input  wire [2*N-1:0] in_d,
    output wire [N-1:0]   out_root
);
    genvar i;
    generate
        if (N < 2 || N > 31) begin : g_illegal
            paper_root_needs_N_from_2_to_31 rule ();
        end
        for (i = 0; i < N; i = i + 1) begin : g_digit
            wire [1:0]   pair = in_d[2*(N-1-i) +: 2];
            wire [i+1:0] rem;  // without its lowest bit, which is ~pair[0]
            assign out_root[N-1-i] = !rem[i+1];
            if (i == 0) begin : g_first
                assign rem = {~|pair, ~^pair};
            end else begin : g_row
                wire add = g_digit[i-1].rem[i];
                // rem + pair - (4 root + 1) or + (4 root + 3), one chain: the lowest bit only borrows
                assign rem = {g_digit[i-1].rem[i-1:0], ~g_digit[i-1].pair[0], pair[1]}
                           - {add, out_root[N-1 -: i] ^ {i{add}}, ~pair[0]};
            end
        end
        wire unused = &{1'b0, g_digit[N-1].rem};
    endgenerate
endmodule
`default_nettype wire
