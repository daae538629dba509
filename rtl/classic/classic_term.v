// SPDX-License-Identifier: Apache-2.0
// Adds a shifted word, one of two start words or a constant, or its one's complement, combinational.
//   out_sum = in_a + (t ^ minus),  t = in_v >> n, n = 9 in_shift[4] + 3 in_shift[3:2] + in_shift[1:0], arithmetic
//   in_shift[1:0] = 3: t = in_s1;  in_shift[3:2] = 3: t = in_s2;  in_shift[5]: t = in_round
// The base-3 shifter of the CORDIC engines has a free input in each of its three multiplexers: they hold what else is
// to be added, so that a vector needs no load multiplexer.
`default_nettype none
module classic_term #(
    parameter D = 23
) (
    input  wire signed [D-1:0] in_v,
    input  wire signed [D-1:0] in_s1,
    input  wire signed [D-1:0] in_s2,
    input  wire        [4:0]   in_round,
    input  wire        [5:0]   in_shift,
    input  wire                in_minus,
    input  wire        [D-1:0] in_a,
    output wire        [D-1:0] out_sum
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
