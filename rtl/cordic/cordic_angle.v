// SPDX-License-Identifier: Apache-2.0
// The angle of micro-rotation I as a constant, no logic: out_angle = floor(atan(2^-I) / (2 pi) * 2^(I + Z)),
// the LOW last bits 0. Scaled by 2^I every angle lies between 0.125 and 0.16 turns; from I = 9 on it is the radian.
`default_nettype none
module cordic_angle #(
    parameter I   = 1,
    parameter Z   = 20,
    parameter LOW = 0
) (
    output wire [Z-1:0] out_angle
);
    function [31:0] angle(input integer i);
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
    localparam [31:0] ANGLE = angle(I);
    assign out_angle = {ANGLE[31 -: Z-LOW], {LOW{1'b0}}};
endmodule
`default_nettype wire
