// SPDX-License-Identifier: Apache-2.0
// Turn-spread words of one to three joints, each from a direction that is given about its nearer axis.
//   word = axis + spread or axis - spread, modulo 4; the spread is the square of the sine between direction and axis
// Formats: in_axis u2.0 quarter turns; in_square u1.40; out_j turn-spread u2.S, joint 1 in the low S + 2 bits.
// Error: 1/2 LSB. Ties round away from the axis, so both sides of an axis meet in the same word. Timing: bit i of
// in_take writes the word of joint i + 1 at the end of the clock. A word is held until the next write. Reset sets every
// word of HELD to 0. Source: paper eq. 3. Model: rational.ik2
`default_nettype none
module spread_about_axis #(
    parameter JOINTS = 1,  // joints, 1 or more (default 1)
    parameter [JOINTS-1:0] HELD = {JOINTS{1'b1}},  // bit i: reset the word of joint i + 1 (default all)
    parameter S = 24,      // fraction bits of a spread, 2 to 24 (default 24, the accuracy of the kernels' squares)
    parameter PIPE = 0     // 0 or 1 (default 0: fewest cells); 1: a carry chain, for a faster clock
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire [JOINTS-1:0]         in_take,
    input  wire [1:0]                in_axis,
    input  wire                      in_below,  // the direction lies clockwise of the axis: subtract the spread
    input  wire [40:0]               in_square,
    output reg  [JOINTS*(S+2)-1:0]   out_j
);
    // Rounding and sign share one increment, since -(s + g) = ~s + ~g with guard bit g. With PIPE = 0 the increment is
    // made of gates, which are smaller than a carry chain here.
    wire [1:0]   quarter = in_axis + {in_below, in_below ^ in_square[40]};
    wire [S+1:0] floor = {quarter, in_square[39 -: S] ^ {S{in_below}}};
    wire         guard = in_square[39-S] ^ in_below;
    wire [S+1:0] word;
    generate
        if (PIPE == 0) begin : g_gates
            reg [S+1:0] nearest;
            reg         carry;
            integer     i;
            assign      word = nearest;
            always @* begin
                carry = guard;
                for (i = 0; i < S + 2; i = i + 1) begin
                    nearest[i] = floor[i] ^ carry;
                    carry = floor[i] & carry;
                end
            end
        end else begin : g_chain
            assign word = floor + {{(S+1){1'b0}}, guard};
        end
    endgenerate
    wire unused = &{1'b0, in_square[38-S:0]};  // below the guard bit

    integer joint;
    always @(posedge clk) begin
        for (joint = 0; joint < JOINTS; joint = joint + 1) begin
            if (in_take[joint])
                out_j[joint*(S+2) +: S+2] <= word;
            if (rst && HELD[joint])
                out_j[joint*(S+2) +: S+2] <= {(S+2){1'b0}};
        end
    end
endmodule
`default_nettype wire
