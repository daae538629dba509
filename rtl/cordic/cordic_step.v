// SPDX-License-Identifier: Apache-2.0
// This part gives the shift of a step of a sequential rotation in the code of cordic_term (9s, 3s, 1s). Combinational.
//   in_step = 0 .. C-1: n = in_step + 1, for the micro-rotations;  C + k: n = C + 1 + 2 k, for digit k
//   in_two makes n one less, for a digit of 2; without in_turn n is 0
`default_nettype none
module cordic_step #(
    parameter W = 16  // bits of a coordinate, 8 to 24 (default 16); it sets the number of steps
) (
    input  wire       in_turn,
    input  wire [4:0] in_step,
    input  wire       in_two,
    output wire [5:0] out_shift
);
    localparam C = (W + 1) / 2;
    localparam T = (W - C + 1) / 2 + 1;
    function [5:0] code(input integer step, input integer two);
        integer n;
        begin
            n = step < C ? step + 1 : step < C + T ? C + 1 + 2 * (step - C) - two : 0;
            n = 16 * (n / 9) + 4 * (n % 9 / 3) + n % 3;
            code = n[5:0];
        end
    endfunction
    localparam B = C + T > 16 ? 5 : 4;  // bits of in_step in use, which counts on to C + T
    genvar b, i;
    generate
        for (b = 0; b < 6; b = b + 1) begin : g_bit
            wire [(2<<B)-1:0] column;
            for (i = 0; i < 2 << B; i = i + 1) begin : g_step
                localparam [5:0] CODE = code(i % (1 << B), i >> B);
                assign column[i] = CODE[b];
            end
            assign out_shift[b] = in_turn && (b < 5 || W > 16) && column[{in_two, in_step[B-1:0]}];
        end
    endgenerate
    wire unused = &{1'b0, in_step};
endmodule
`default_nettype wire
