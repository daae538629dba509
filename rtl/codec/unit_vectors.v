// SPDX-License-Identifier: Apache-2.0
// Registers of the unit vectors that kernel_vector_solve gives coordinate by coordinate; its table says when.
//   in_cos, in_sin: a bit a joint, in_word is its cosine or sine; in_flat: c2 is 1, -1 if in_negative, not in_word
// Formats: in_word s4.20, rounded to U fraction bits; out_c, out_n s2.U, joint 1 in the lowest bits.
// After reset (1, 0), but of joint 2, whose words are never held. Error: none. Latency 1.
// Model: vector_solve._word
`default_nettype none
module unit_vectors #(
    parameter JOINTS = 2,  // 2 or 3: as the kernel has. 2
    parameter U = 16       // fraction bits of cosine and sine, 8 to 17: 16, 0.0009 degrees
) (
    input  wire                    clk,
    input  wire                    rst,
    input  wire [2:0]              in_cos,
    input  wire [2:0]              in_sin,
    input  wire [23:0]             in_word,
    input  wire                    in_flat,
    input  wire                    in_negative,
    output reg  [JOINTS*(U+2)-1:0] out_c,
    output reg  [JOINTS*(U+2)-1:0] out_n
);
    wire   [U+1:0] word = in_word[21:20-U];
    wire           unused = &{1'b0, in_cos, in_sin, in_word};
    genvar         i;
    generate
        for (i = 0; i < JOINTS; i = i + 1) begin : g_joint
            localparam J = i * (U + 2);
            always @(posedge clk) begin
                if (in_cos[i])
                    out_c[J +: U+2] <= i == 1 && in_flat ? {in_negative, 1'b1, {U{1'b0}}} : word;
                if (in_sin[i])
                    out_n[J +: U+2] <= word;
                if (rst && i != 1) begin
                    out_c[J +: U+2] <= {2'b01, {U{1'b0}}};
                    out_n[J +: U+2] <= {(U+2){1'b0}};
                end
            end
        end
    endgenerate
endmodule
`default_nettype wire
