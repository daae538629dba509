// SPDX-License-Identifier: Apache-2.0
// This part gives the spread of a joint word's fraction: out_s = in_fall ? 1 - in_f : in_f.
// Formats: in_f is u0.S, out_s u1.S (1 - 0 is 1.0). Exact; combinational.
// The two's complement inverts the bits above the lowest 1. As gates this is smaller than an adder and a multiplexer.
// Source: paper Table I read as turn-spread (odd quadrants exchange s and 1 - s). Model: paper.complement
`default_nettype none
module paper_complement #(
    parameter S = 8  // fraction bits of a spread, 1 or more (default 8, the paper's)
) (
    input  wire [S-1:0] in_f,
    input  wire         in_fall,
    output reg  [S:0]   out_s
);
    generate
        if (S < 1) begin : g_illegal
            paper_complement_needs_S_from_1 rule ();
        end
    endgenerate

    reg     any;  // a lower bit is 1
    integer i;
    always @* begin
        any = 1'b0;
        for (i = 0; i < S; i = i + 1) begin
            out_s[i] = in_f[i] ^ (in_fall & any);
            any = any | in_f[i];
        end
        out_s[S] = in_fall & ~any;
    end
endmodule
`default_nettype wire
