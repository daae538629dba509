// SPDX-License-Identifier: Apache-2.0
// This part computes R digits of a restoring division, combinational. All forms of the divider share it.
//   one digit: p = 2 rem + bit; p >= d ? (2 quotient + 1, p - d) : (2 quotient, p)
// in_rem is the remainder of the first K numerator bits; in_bits holds the next R bits, the first one on top.
// A remainder has min(K, WD) bits (1 at K = 0), so the first rows compare few bits and only test whether d has more.
// d = 0 gives digits 1 and keeps p, of which WD bits remain. Exact. Model: arith.divide
`default_nettype none
module divide_digits #(
    parameter K  = 16,  // digits known before, 0 or more (default 16; every instance sets it)
    parameter R  = 1,   // digits to add, 1 or more (default 1)
    parameter WD = 16   // bits of the divisor, 1 or more (default 16)
) (
    input  wire [(K < 1 ? 1 : K < WD ? K : WD)-1:0] in_rem,
    input  wire [WD-1:0]                            in_d,
    input  wire [R-1:0]                             in_bits,
    output wire [(K+R < WD ? K+R : WD)-1:0]         out_rem,
    output wire [R-1:0]                             out_q
);
    genvar i;
    generate
        if (K < 0 || R < 1 || WD < 1) begin : g_illegal
            divide_digits_needs_K_from_0_R_and_WD_from_1 rule ();
        end
        for (i = 0; i < R; i = i + 1) begin : g_digit
            localparam D = K + i;                             // digits known
            localparam B = D < 1 ? 1 : D < WD ? D : WD;       // bits of the remainder before
            localparam A = D + 1 < WD ? D + 1 : WD;           // and after this digit
            wire [B-1:0] rem;
            wire [B:0]   p = {rem, in_bits[R-1-i]};
            wire         digit;
            wire [A-1:0] next_rem;
            assign out_q[R-1-i] = digit;

            if (i == 0) begin : g_first
                assign rem = in_rem;
            end else begin : g_next
                assign rem = g_digit[i-1].next_rem;
            end

            if (B < WD) begin : g_short
                wire [B+1:0] trial;
                wire         high;
                if (B < 2) begin : g_gates  // as gates the first two digits cost a few LUTs, as sums two carry chains
                    wire borrow = ~p[0] & in_d[0];
                    assign trial[2] = p[1] ? in_d[1] & borrow : in_d[1] | borrow;
                    assign trial[1:0] = {p[1] ^ in_d[1] ^ borrow, p[0] ^ in_d[0]};
                end else begin : g_chain
                    assign trial = {1'b0, p} - {1'b0, in_d[B:0]};
                end
                if (B + 1 < WD) begin : g_high
                    assign high = |in_d[WD-1:B+1];
                end else begin : g_whole
                    assign high = 1'b0;
                end
                assign digit = !trial[B+1] && !high;
                assign next_rem = digit ? trial[A-1:0] : p[A-1:0];
            end else begin : g_full
                // p < 2 d, so p - d fits WD+1 bits with its sign; p[WD] matters only for d = 0
                wire [WD:0] trial = p - {1'b0, in_d};
                assign digit = !trial[WD] || p[WD];
                assign next_rem = digit ? trial[A-1:0] : p[A-1:0];
            end

            if (i == R - 1) begin : g_last
                assign out_rem = next_rem;
            end
        end
    endgenerate
endmodule
`default_nettype wire
