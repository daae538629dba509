// SPDX-License-Identifier: Apache-2.0
// This core rounds away SHIFT low bits of a signed word and clamps the result to WO bits. Combinational.
//   out_x = clamp(floor(in_x / 2^SHIFT + 1/2)), nearest, ties upward; out_overflow = it was clamped
// Formats: in_x is sWI.f, out_x sWO.(f-SHIFT). Error: at most 1/2 LSB of out_x unless clamped.
// Model: arith.round_saturate
`default_nettype none
module round_saturate #(
    parameter WI    = 24,  // bits of the word, above SHIFT, to 62 (default 24)
    parameter WO    = 16,  // bits of the result, 2 to 62 (default 16)
    parameter SHIFT = 4    // low bits that are rounded away, 0 to WI - 1 (default 4)
) (
    input  wire signed [WI-1:0] in_x,
    output wire signed [WO-1:0] out_x,
    output wire                 out_overflow
);
    localparam WR = WI - SHIFT + 1;  // rounding up may need one more bit
    wire [WR-1:0] rounded;
    generate
        if (WO < 2 || WO > 62 || WI > 62 || SHIFT < 0 || SHIFT >= WI) begin : g_illegal
            round_saturate_needs_WO_from_2_to_62_WI_to_62_and_SHIFT_from_0_to_below_WI rule ();
        end
        if (SHIFT == 0) begin : g_whole
            assign rounded = {in_x[WI-1], in_x};
        end else begin : g_round
            // the bit below the new LSB is the rounding carry; the bits below that cannot change the result
            assign rounded = {in_x[WI-1], in_x[WI-1:SHIFT]} + {{(WR-1){1'b0}}, in_x[SHIFT-1]};
        end
        if (WO >= WR) begin : g_fits
            assign out_overflow = 1'b0;
            assign out_x = {{(WO-WR){rounded[WR-1]}}, rounded};
        end else begin : g_clamp
            wire sign = rounded[WR-1];
            assign out_overflow = |(rounded[WR-2:WO-1] ^ {(WR-WO){sign}});
            assign out_x = out_overflow ? {sign, {(WO-1){!sign}}} : rounded[WO-1:0];
        end
    endgenerate
endmodule
`default_nettype wire
