// SPDX-License-Identifier: Apache-2.0
// Numerator of the cosine of joint 2, normalised by whole bytes: n = (q - Q1 - Q2) * 2^(8 e - 7), for kernel_solve.
// Formats: in_q u32.0; cfg_q u33.0 = Q1 + Q2 less the half that rounds n; cfg_e u2.0; out_n s27.0, truncated.
// out_beyond: the shifted gap does not fit 27 bits, so out_n is not it; out_negative is right all the same.
// Combinational. Error: half a unit of n.
// Model: rational._elbow
`default_nettype none
module kernel_solve_gap (
    input  wire [32:0]        cfg_q,
    input  wire [1:0]         cfg_e,
    input  wire [31:0]        in_q,
    output reg  signed [26:0] out_n,
    output wire               out_beyond,
    output wire               out_negative
);
    wire [33:0] gap = {2'd0, in_q} - {1'b0, cfg_q};
    wire        over8 = gap[33:26] != {8{gap[25]}}, over16 = gap[25:18] != {8{gap[17]}},
                over24 = gap[17:10] != {8{gap[9]}};  // bits of one byte more that are not the sign
    assign      out_beyond = cfg_e != 0 && over8 || cfg_e[1] && (over16 || cfg_e[0] && over24);
    assign      out_negative = gap[33];
    always @*
        case (cfg_e)
            2'd0: out_n = gap[33:7];
            2'd1: out_n = {gap[25:0], 1'b0};
            2'd2: out_n = {gap[17:0], 9'd0};
            default: out_n = {gap[9:0], 17'd0};
        endcase
endmodule
`default_nettype wire
