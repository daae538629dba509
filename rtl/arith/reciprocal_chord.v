// SPDX-License-Identifier: Apache-2.0
// Chord of 1/q in its segment, for a user who interpolates with a multiplier of his own:
//   2^16 / q = out_knot - (out_step * out_offset >> 8), q = (a + d) / 256, d in [0, 1): segment a, out_offset = 256 d
// Formats: in_q u2.16 from 1/4 to below 2; out_knot u18.0, out_step u12.0, out_offset u8.0, one clock after in_q.
// A knot is lowered by half the sag of the chord, and moved by half of what truncating q to in_q loses.
// Error: relative 0.08 * 2^-16 of sag at 1/4, less above; half a unit of each knot. q = 2 reads segment 0, whose
// chord is 0 and 0: there the user has an answer of his own.
// Model: rational._reciprocal_knots
`default_nettype none
module reciprocal_chord (
    input  wire        clk,
    input  wire [16:0] in_q,
    output wire [17:0] out_knot,
    output wire [11:0] out_step,
    output reg  [7:0]  out_offset
);
    // {step, knot} from q = a / 256 to the next segment
    function [29:0] chord_from(input integer a);
        reg [63:0] here, next;
        begin
            here = {32'd0, a};
            next = here + 1;
            if (a < 64)
                here = 0;  // below 1/4: never read
            else begin
                here = (((8 * here * here - 1) << 30) / (here * here * (256 * here + 1)) + 1) >> 1;
                next = (((8 * next * next - 1) << 30) / (next * next * (256 * next + 1)) + 1) >> 1;
                next = here - next;
            end
            chord_from = {next[11:0], here[17:0]};
        end
    endfunction
    reg [29:0] chords[0:511];
    integer    a;
    initial
        for (a = 0; a < 512; a = a + 1)
            chords[a] = chord_from(a);

    reg [29:0] chord;
    assign {out_step, out_knot} = chord;
    always @(posedge clk) begin
        chord      <= chords[in_q[16:8]];
        out_offset <= in_q[7:0];
    end
endmodule
`default_nettype wire
