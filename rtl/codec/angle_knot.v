// SPDX-License-Identifier: Apache-2.0
// This part takes a segment of angle_chord apart and lifts its knot from the chord to the parabola, combinational.
//   root = out_knot + floor(out_step * out_offset / 2^15);  out_knot = knot + floor(bend * hump / 2^(11 - K + 2T))
// Up to K = 21 segments are straight, and the knot is that of the table.
// Formats: in_chord as angle_chord gives it. Error: that of angle_chord. Models: codecs.angle_chord, codec_wide.sine
`default_nettype none
module angle_knot #(
    parameter K = 17,  // fraction bits of a root, 14 to 25 (default 17)
    parameter T = 9    // address bits of the codec's table (default 9); a step has K - T + 4 bits
) (
    input  wire [2*K-T+19+15*(K>21):0] in_chord,
    output wire [K:0]                  out_knot,
    output wire [K-T+3:0]              out_step,
    output wire [14:0]                 out_offset
);
    generate
        if (K > 21) begin : g_bent
            localparam S = 11 - K + 2 * T;
            wire [K:0]         knot;
            wire signed [7:0]  bend;
            wire [6:0]         hump;
            wire signed [15:0] product = bend * $signed({1'b0, hump});
            wire               unused = &{1'b0, product[S-1:0]};
            assign {knot, out_step, out_offset, bend, hump} = in_chord;
            assign out_knot = knot + {{(K-15+S){product[15]}}, product[15:S]};
        end else begin : g_straight
            assign {out_knot, out_step, out_offset} = in_chord;
        end
    endgenerate
endmodule
`default_nettype wire
