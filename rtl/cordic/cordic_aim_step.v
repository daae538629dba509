// SPDX-License-Identifier: Apache-2.0
// This combinational part is micro-rotation i of a sequential vectoring. cordic_aim_iter and classic_aim_iter use it.
//   y' = 2 (y - d x),  z' = z + d atan 2^-i, with in_mirror z - d atan 2^-i,  d = sign of y, -1 or 1
// Minus is the one's complement. out_shifted = y >> 2i is the word to be added to x, i = 3 in_by6 + in_by2, at most U.
// in_divide clears the low B bits of x. The sign is one more input of the cell of the angle ROM. Model: cordic.aim
`default_nettype none
module cordic_aim_step #(
    parameter D = 21,  // bits of x, guard bits included (default 21 = W + 5 at W = 16)
    parameter Z = 21,  // bits of the angle, a turn is 2^Z (default 21 = A + 5 at A = 16)
    parameter U = 8,   // last micro-rotation that changes x, at most 12 (default 8)
    parameter L = 16,  // last micro-rotation, at most 31 (default 16 = C + 8 at W = 16)
    parameter B = 8    // low bits of x that a division ignores, below D (default 8 = G + C / 2 at W = 16)
) (
    input  wire        [D-1:0] in_x,
    input  wire signed [D+1:0] in_y,
    input  wire        [Z-1:0] in_z,
    input  wire        [4:0]   in_step,
    input  wire        [1:0]   in_by2,
    input  wire        [1:0]   in_by6,
    input  wire                in_mirror,
    input  wire                in_divide,
    output wire                out_minus,
    output reg         [D-1:0] out_shifted,
    output wire signed [D+1:0] out_y,
    output wire        [Z-1:0] out_z
);
    localparam Y = D + 2;
    wire [64*Z-1:0] angles;  // plus, then minus
    genvar          g;
    generate
        for (g = 0; g < 64; g = g + 1) begin : g_word
            if (g % 32 > L) begin : g_none
                assign angles[Z*g +: Z] = {Z{1'b0}};
            end else begin : g_some
                cordic_angle #(.I(g % 32), .Z(Z)) constant (.in_minus(g > 31), .out_sum(angles[Z*g +: Z]));
            end
        end
    endgenerate
    wire [Y-1:0] sum = in_y + (({2'b00, in_x} ^ {Y{!out_minus}}) & {{(Y-B){1'b1}}, {B{!in_divide}}});
    assign out_minus = in_y[Y-1];
    assign out_y = sum << 1;
    assign out_z = in_z + angles[Z*{out_minus ^ in_mirror, in_step} +: Z];

    reg  signed [Y-1:0] y2;
    wire signed [Y-1:0] y18 = y2 >>> 18;
    wire                unused = &{1'b0, y18};
    always @* begin
        case (in_by2)
            2'd0: y2 = in_y;
            2'd1: y2 = in_y >>> 2;
            2'd2: y2 = in_y >>> 4;
            default: y2 = U > 11 ? in_y >>> 6 : $signed({Y{1'bx}});  // else not a digit
        endcase
        case (in_by6)
            2'd0: out_shifted = y2[D-1:0];
            2'd1: out_shifted = {{4{y2[Y-1]}}, y2[Y-1:6]};
            2'd2: out_shifted = {{10{y2[Y-1]}}, y2[Y-1:12]};
            default: out_shifted = U > 8 ? y18[D-1:0] : {D{1'bx}};
        endcase
    end
endmodule
`default_nettype wire
