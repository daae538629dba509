// SPDX-License-Identifier: Apache-2.0
// Minor root of a turn-spread, completed from the table segment of spread_chords and shifted by the range of the
// spread.
//   out_root = (in_knot + in_rise) 2^-(3 + e), e = 0, 2, 4, 7, 10 in range 0 to 4;
//   of spread_parabolas, whose U is above 18, e = 0, 2, 4, 6, 9, 12, 15 in range 0 to 6
// Formats: in_knot, in_rise u0.(U+3), in_rise is step * offset; out_root u0.U. Error: truncation. Combinational.
// Models: codecs.spread_chords, codec_wide.spread_roots
`default_nettype none
module spread_minor #(
    parameter U = 16  // fraction bits of a root, 13 to 24 (default 16)
) (
    input  wire [2:0]   in_range,
    input  wire [U+2:0] in_knot,
    input  wire [U+2:0] in_rise,
    output reg  [U-1:0] out_root
);
    wire [U+2:0] root = in_knot + in_rise;
    wire         unused = &{1'b0, root[2:0]};
    generate
        if (U > 18) begin : g_parabola
            always @*
                case (in_range)
                    3'd0: out_root = root[U+2:3];
                    3'd1: out_root = {2'd0, root[U+2:5]};
                    3'd2: out_root = {4'd0, root[U+2:7]};
                    3'd3: out_root = {6'd0, root[U+2:9]};
                    3'd4: out_root = {9'd0, root[U+2:12]};
                    3'd5: out_root = {12'd0, root[U+2:15]};
                    default: out_root = {15'd0, root[U+2:18]};
                endcase
        end else begin : g_straight
            always @*
                case (in_range)
                    3'd0: out_root = root[U+2:3];
                    3'd1: out_root = {2'd0, root[U+2:5]};
                    3'd2: out_root = {4'd0, root[U+2:7]};
                    3'd3: out_root = {7'd0, root[U+2:10]};
                    default: out_root = {10'd0, root[U+2:13]};
                endcase
        end
    endgenerate
endmodule
`default_nettype wire
