// SPDX-License-Identifier: Apache-2.0
// Shifter of kernel_vector_wide: out_word = in_sum * 2^(2 s - 2 N + F) without its fraction, in F + 2 bits.
//   out_over: it does not fit
//   out_coarse: bytes that in_sum, not negative, can spare; out_fine: pairs of bits that it can spare beside the bytes
//   that in_s takes; out_zero: nothing is left of it
// Formats: in_sum s(2N+2).3; in_s bytes and, in its two low bits, pairs of bits. Combinational. Error: less than one
// unit of out_word. Model: kernel_vector_wide.plane
`default_nettype none
module kernel_vector_wide_shift #(
    parameter N = 20,                // bits of the kernel's coordinate, 20 or 24 (default 20)
    parameter F = N == 24 ? 29 : 25  // fraction bits of out_word, of one value (default 25)
) (
    input  wire [2*N+4:0] in_sum,
    input  wire [4:0]     in_s,
    output reg  [F+1:0]   out_word,
    output reg            out_over,
    output reg  [2:0]     out_coarse,
    output wire [1:0]     out_fine,
    output wire           out_zero
);
    localparam      TOP = 2 * N + 4, BYTE = N == 24 ? 6 : 5;  // bytes of q
    reg  [F+7:0]    moved;  // 6 bits more than the word, for the shift by pairs
    integer         i;
    wire            sign = in_sum[TOP];
    /* verilator lint_off UNUSEDSIGNAL */
    wire [TOP+40:0] longer = {in_sum, 40'd0};
    /* verilator lint_on UNUSEDSIGNAL */
    always @* begin
        case (in_s[4:2])
            3'd0: moved = longer[TOP+40 -: F+8];
            3'd1: moved = longer[TOP+32 -: F+8];
            3'd2: moved = longer[TOP+24 -: F+8];
            3'd3: moved = longer[TOP+16 -: F+8];
            3'd4: moved = longer[TOP+8 -: F+8];
            default: moved = longer[TOP+48-8*BYTE -: F+8];
        endcase
        case (in_s[1:0])
            2'd0: out_word = moved[F+7:6];
            2'd1: out_word = moved[F+5:4];
            2'd2: out_word = moved[F+3:2];
            default: out_word = moved[F+1:0];
        endcase
        out_over = moved[F+7] != sign || in_s[1:0] != 0 && moved[F+6:F+5] != {2{sign}}
                   || in_s[1] && (moved[F+4:F+3] != {2{sign}} || in_s[0] && moved[F+2:F+1] != {2{sign}});
        out_coarse = N == 24 ? 3'd5 : 3'd4;
        for (i = BYTE - 1; i > 0; i = i - 1) begin
            if (in_s[4:2] >= i[2:0] && in_sum[TOP+7-8*i -: 8] != {8{sign}})
                out_over = 1'b1;
            if (in_sum[TOP+6-8*i -: 8] != 0)
                out_coarse = i[2:0] - 3'd1;
        end
    end
    wire [3:0] low = {moved[F+5:F+4] != 0, moved[F+3:F+2] != 0, moved[F+1:F] != 0, moved[F-1:F-2] != 0};
    assign     out_fine = {!low[3] && !low[2], !low[3] && (low[2] || !low[1])};
    assign     out_zero = low == 0;
endmodule
`default_nettype wire
