// SPDX-License-Identifier: Apache-2.0
// Turn-spread word of one joint from a direction that is given about its nearer axis, with the side as a sign.
//   word = axis + square, modulo 4; |square| is the square of the sine between direction and axis, < 0: clockwise of it
// Formats: in_axis u2.0 quarter turns; in_square s0.40, of magnitude below 1; out_j turn-spread u2.S.
// Error: 1/2 LSB, ties anticlockwise. One adder does axis, sign and rounding. Timing: in_take writes the word at the
// end of the clock. The word is held until the next write; reset sets it to 0. With PIPE = 1 the adder follows the
// register, for a faster clock.
// Source: paper eq. 3. Model: rational.ik1
`default_nettype none
module spread_from_axis #(
    parameter S = 24,   // fraction bits of a spread, 2 to 24 (default 24, the accuracy of the kernel's square)
    parameter PIPE = 0  // 0 or 1 (default 0: the register is behind the adder)
) (
    input  wire               clk,
    input  wire               rst,
    input  wire               in_take,
    input  wire [1:0]         in_axis,
    input  wire signed [40:0] in_square,
    output wire [S+1:0]       out_j
);
    wire         carried;
    wire [S+1:0] word;
    wire [1:0]   axis;
    wire [S+1:0] square;  // sign and guard bit included
    assign {word, carried} = {{2{square[S+1]}}, square[S:1], 1'b1} + {axis, {S{1'b0}}, square[0]};
    generate
        if (PIPE == 0) begin : g_behind
            reg [S+1:0] held;
            assign      {axis, square, out_j} = {in_axis, in_square[40 -: S+2], held};
            always @(posedge clk) begin
                if (in_take)
                    held <= word;
                if (rst)
                    held <= {(S+2){1'b0}};
            end
        end else begin : g_before
            reg [S+3:0] held;
            assign      {axis, square, out_j} = {held, word};
            always @(posedge clk) begin
                if (in_take)
                    held <= {in_axis, in_square[40 -: S+2]};
                if (rst)
                    held <= {(S+4){1'b0}};
            end
        end
    endgenerate
    wire         unused = &{1'b0, carried, in_square[38-S:0]};  // below the guard bit
endmodule
`default_nettype wire
