// SPDX-License-Identifier: Apache-2.0
// This part sums the signed angles of N micro-rotations from I on by look-up, combinational; N = 1: a constant.
//   out_sum = sum over k of a_k or, where in_minus[N-1-k], ~a_k,  a_k = floor(atan 2^-(I+k) / (2 pi) * 2^Z)
// Up to six signs are the inputs of one cell a bit, a fifth of the cells that adders would need. Model: cordic.angle
`default_nettype none
module cordic_angle #(
    parameter I = 0,  // first micro-rotation, 0 to 31 (default 0)
    parameter N = 1,  // angles that are summed, 1 to 6 (default 1: a constant)
    parameter Z = 21  // bits of the sum, a turn is 2^Z, 8 to 40 (default 21 = A + 5 at A = 16)
) (
    input  wire [N-1:0] in_minus,
    output wire [Z-1:0] out_sum
);
    function [31:0] angle(input integer i);  // in 2^-(32 + i) turns; from i = 9 on it is the radian
        case (i)
            0: angle = 32'h20000000;
            1: angle = 32'h25c80a3b;
            2: angle = 32'h27ece16d;
            3: angle = 32'h28888ea0;
            4: angle = 32'h28b0d430;
            5: angle = 32'h28bafc2b;
            6: angle = 32'h28bd8797;
            7: angle = 32'h28be2a88;
            8: angle = 32'h28be5346;
            default: angle = 32'h28be5d76;
        endcase
    endfunction
    function [(Z<<N)-1:0] table_of_sums(input integer entries);
        integer c, k;
        reg [39:0] term;
        begin
            table_of_sums = {(Z<<N){1'b0}};
            for (c = 0; c < entries; c = c + 1)
                for (k = 0; k < N; k = k + 1) begin
                    term = {8'd0, angle(I + k)} >> 32 - Z + I + k;
                    if (((c >> N - 1 - k) & 1) != 0) term = ~term;
                    table_of_sums[Z*c +: Z] = table_of_sums[Z*c +: Z] + term[Z-1:0];
                end
        end
    endfunction
    localparam [(Z<<N)-1:0] SUMS = table_of_sums(1 << N);
    assign out_sum = SUMS[Z*in_minus +: Z];
endmodule
`default_nettype wire
