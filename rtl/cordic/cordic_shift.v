// SPDX-License-Identifier: Apache-2.0
// This part adds a shifted word or its one's complement, combinational.
//   out_sum = in_a + (in_v >>> n) or in_a + ~(in_v >>> n), n = 9 in_shift[5:4] + 3 in_shift[3:2] + in_shift[1:0]
//   in_shift[1:0] = 3 replaces in_v by R
// Shifts are in base 3, because a multiplexer of three words is one five-input cell: 27 shifts cost three cells a bit.
`default_nettype none
module cordic_shift #(
    parameter D       = 22,  // bits of the vector, guard bits included, 9 or more (default 22 = W + 6 at W = 16)
    parameter [7:0] R = 24   // constant added last, in guard units (default 24: half an LSB and the mean of the shifts)
) (
    input  wire signed [D-1:0] in_v,
    input  wire        [5:0]   in_shift,
    input  wire                in_minus,
    input  wire signed [D-1:0] in_a,
    output wire signed [D-1:0] out_sum
);
    wire signed [D-1:0] round = {{(D-8){1'b0}}, R};
    reg  signed [D-1:0] by1, by3;
    always @* begin
        case (in_shift[1:0])
            2'd0: by1 = in_v;
            2'd1: by1 = in_v >>> 1;
            2'd2: by1 = in_v >>> 2;
            2'd3: by1 = round;
        endcase
        case (in_shift[3:2])
            2'd0: by3 = by1;
            2'd1: by3 = by1 >>> 3;
            2'd2: by3 = by1 >>> 6;
            default: by3 = {D{1'bx}};  // not a digit
        endcase
    end
    wire signed [D-1:0] by9 = in_shift[5] ? by3 >>> 18 : in_shift[4] ? by3 >>> 9 : by3;
    assign out_sum = in_a + (by9 ^ {D{in_minus}});
endmodule
`default_nettype wire
