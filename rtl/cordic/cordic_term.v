// SPDX-License-Identifier: Apache-2.0
// This part adds a shifted word, one of two other words or a constant, or its one's complement. Combinational.
//   out_sum = in_a + (t ^ minus),  t = in_v >> n, n = 9 in_shift[4] + 3 in_shift[3:2] + in_shift[1:0], arithmetic
//   in_shift[1:0] = 3: t = in_s1;  in_shift[3:2] = 3: t = in_s2;  in_shift[5]: t = in_round
// Shifts are in base 3, because a multiplexer of three words is one five-input cell: 18 shifts and the sign cost three
// cells a bit. The free fourth input of each multiplexer serves the other words, so the vector registers need no load
// multiplexer.
`default_nettype none
module cordic_term #(
    parameter D = 23  // bits of the vector, guard bits included, 8 or more (default 23 = W + 7 at W = 16)
) (
    input  wire signed [D-1:0] in_v,
    input  wire signed [D-1:0] in_s1,
    input  wire signed [D-1:0] in_s2,
    input  wire        [4:0]   in_round,
    input  wire        [5:0]   in_shift,
    input  wire                in_minus,
    input  wire signed [D-1:0] in_a,
    output wire signed [D-1:0] out_sum
);
    reg  signed [D-1:0] by1, by3, by9;
    wire signed [D-1:0] round = {{(D-5){1'b0}}, in_round};
    always @* begin
        case (in_shift[1:0])
            2'd0: by1 = in_v;
            2'd1: by1 = in_v >>> 1;
            2'd2: by1 = in_v >>> 2;
            2'd3: by1 = in_s1;
        endcase
        case (in_shift[3:2])
            2'd0: by3 = by1;
            2'd1: by3 = by1 >>> 3;
            2'd2: by3 = by1 >>> 6;
            2'd3: by3 = in_s2;
        endcase
        by9 = in_shift[5] ? round : in_shift[4] ? by3 >>> 9 : by3;
    end
    assign out_sum = in_a + (by9 ^ {D{in_minus}});
endmodule
`default_nettype wire
