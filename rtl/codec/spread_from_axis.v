// SPDX-License-Identifier: Apache-2.0
// Turn-spread word of one joint from a direction that is given about its nearer axis, with the side as a sign.
//   word = axis + square, modulo 4; |square| is the square of the sine between direction and axis, < 0: clockwise of it
// Formats: in_axis u2.0 quarter turns; in_square s0.40, of magnitude below 1; out_j turn-spread u2.S.
// Error: 1/2 LSB, ties anticlockwise. One adder does axis, sign and rounding. Timing: in_take writes the word at the
// end of the clock. The word is held until the next write; reset sets it to 0.
// Source: paper eq. 3. Model: rational.ik1
`default_nettype none
module spread_from_axis #(
    parameter S = 24  // fraction bits of a spread, 2 to 24 (default 24, the accuracy of the kernel's square)
) (
    input  wire               clk,
    input  wire               rst,
    input  wire               in_take,
    input  wire [1:0]         in_axis,
    input  wire signed [40:0] in_square,
    output reg  [S+1:0]       out_j
);
    wire         carried;
    wire [S+1:0] word;
    assign {word, carried} = {{2{in_square[40]}}, in_square[39 -: S], 1'b1} + {in_axis, {S{1'b0}}, in_square[39-S]};
    wire         unused = &{1'b0, carried, in_square[38-S:0]};  // below the guard bit
    always @(posedge clk) begin
        if (in_take)
            out_j <= word;
        if (rst)
            out_j <= {(S+2){1'b0}};
    end
endmodule
`default_nettype wire
