// SPDX-License-Identifier: Apache-2.0
// This part computes R digits of a restoring square root, combinational. All forms of the root share it.
//   one digit: t = 4 rem + pair - (4 root + 1); t >= 0 ? (2 root + 1, t) : (2 root, 4 rem + pair)
// in_root holds the K digits known so far; in_rem = radicand so far - root^2 <= 2 root has K+1 bits; in_pairs holds the
// next R bit pairs of the radicand, the first one on top, the lower bit of each inverted: a register in front of it can
// store that for nothing.
// The invariant 0 <= rem <= 2 root keeps t inside K+2 bits of the carry chain, so its sign bit is the digit. Exact.
// With R = 2 and K above 24 the second digit is tried for both values of the first, so that a long word is fast enough.
// Model: arith.isqrt
`default_nettype none
module isqrt_digits #(
    parameter K = 7,  // digits known before, 1 or more (default 7: the last digit of a 16-bit radicand)
    parameter R = 1   // digits to add, 1 or more (default 1)
) (
    input  wire [K:0]     in_rem,
    input  wire [K-1:0]   in_root,
    input  wire [2*R-1:0] in_pairs,
    output wire [K+R:0]   out_rem,
    output wire [K+R-1:0] out_root
);
    genvar i;
    generate
        if (K < 1 || R < 1) begin : g_illegal
            isqrt_digits_needs_K_and_R_from_1 rule ();
        end
        for (i = 0; i < R; i = i + 1) begin : g_digit
            localparam D = K + i;  // digits known
            wire [D:0]   rem;
            wire [D-1:0] root;
            wire         high = in_pairs[2*(R-1-i)+1], none = in_pairs[2*(R-1-i)];  // none: the lower bit is 0
            wire [D+1:0] trial;
            wire         digit = ~trial[D+1];
            wire [D+1:0] next_rem = digit ? {trial[D:0], none} : {rem[D-1:0], high, ~none};
            wire [D:0]   next_root = {root, digit};

            if (i == 0) begin : g_first
                assign rem = in_rem;
                assign root = in_root;
            end else begin : g_next
                assign rem = g_digit[i-1].next_rem;
                assign root = g_digit[i-1].next_root;
            end

            // pair - 1 borrows exactly when pair = 0, and so does high - none, which is one bit shorter
            case (D < 3 ? 0 : R == 2 && i == 1 && K > 24 ? 2 : 1)
            0: begin : g_gates  // as gates the first three digits cost one 6-input LUT a bit
                wire [D+1:0] a = {rem, high};
                wire [D+1:0] b = {1'b0, root, none};
                reg  [D+1:0] difference;
                reg          borrow;
                integer      j;
                always @* begin
                    borrow = 1'b0;
                    for (j = 0; j < D + 2; j = j + 1) begin
                        difference[j] = a[j] ^ b[j] ^ borrow;
                        borrow = a[j] ? b[j] & borrow : b[j] | borrow;
                    end
                end
                assign trial = difference;
            end
            1: begin : g_chain
                assign trial = {rem, high} - {1'b0, root, none};
            end
            default: begin : g_both  // no multiplexer between two long chains
                wire [D:0]   rem_1 = {g_digit[0].trial[D-1:0], g_digit[0].none};  // if the first digit is 1
                wire [D:0]   rem_0 = {in_rem[D-2:0], g_digit[0].high, ~g_digit[0].none};
                wire [D+1:0] after_1 = {rem_1, high} - {1'b0, in_root, 1'b1, none};
                wire [D+1:0] after_0 = {rem_0, high} - {1'b0, in_root, 1'b0, none};
                assign trial = g_digit[0].digit ? after_1 : after_0;
                wire unused = &{1'b0, rem[D]};
            end
            endcase

            if (i == R - 1) begin : g_last
                assign out_rem = next_rem;
                assign out_root = next_root;
            end
        end
    endgenerate
endmodule
`default_nettype wire
