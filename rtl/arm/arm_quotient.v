// SPDX-License-Identifier: Apache-2.0
// Signed quotient of a velocity and a length: a rate with V fraction bits, rounded to nearest, saturated to W + 2 bits.
//   out_q = +-(2 |in_n| 2^V / in_d + 1) / 2, |in_n| being the one's complement of a negative in_n
//   out_q is negative where exactly one of in_n < 0 and in_negative holds
// Formats: in_n s(N) and in_d u(D) with the same LSB; out_q s(W-V+2).V. out_zero: in_d is 0, and out_q is 0. in_start
// is high for one clock; out_q is valid PIPE + ceil((N + V) / R) clocks later.
// Error: 1/2 LSB, and 1 LSB of in_n where in_n is negative. Models: arm_velocity.rates2, arm_velocity.rates3
`default_nettype none
module arm_quotient #(
    parameter W = 16,  // bits of a rate, 8 to 24 (default 16)
    parameter V = 12,  // fraction bits of a rate, W - 8 to W - 1 (default 12)
    parameter N = 27,  // bits of the numerator (default 27: a velocity inside arm_inverse)
    parameter D = 24,  // bits of the divisor (default 24: a length there)
    parameter R = 4,   // digits in one clock, 1 to 5 (default 4)
    parameter PIPE = 0 // 0 or 1 (default 0); 1: a register behind the rounded quotient
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_start,
    input  wire signed [N-1:0] in_n,
    input  wire                in_negative,
    input  wire [D-1:0]        in_d,
    output wire signed [W+1:0] out_q,
    output wire                out_zero
);
    reg          minus;
    wire         ready, valid;
    wire [N+V-1:0] digits;
    wire [D-1:0] rest;
    divide #(.WN(N-1), .WD(D), .F(V+1), .R(R)) divider (
        .clk(clk), .rst(rst), .in_valid(in_start), .in_ready(ready), .in_n(in_n[N-2:0] ^ {(N-1){in_n[N-1]}}),
        .in_d(in_d), .out_valid(valid), .out_ready(1'b1), .out_q(digits), .out_r(rest), .out_div_by_zero(out_zero));
    wire         unused = &{1'b0, ready, valid, rest};
    wire [N+V-1:0] near = {1'b0, digits[N+V-1:1]} + {{(N+V-1){1'b0}}, digits[0]};
    wire [W+1:0] size = out_zero ? {(W+2){1'b0}} : near[N+V-1:W+1] != 0 ? {1'b0, {(W+1){1'b1}}} : near[W+1:0];
    wire [W+1:0] magnitude;
    assign       out_q = minus ? -magnitude : magnitude;
    generate
        if (PIPE == 0) begin : g_now
            assign magnitude = size;
        end else begin : g_registered
            reg [W+1:0] last;
            always @(posedge clk)
                last <= size;
            assign magnitude = last;
        end
    endgenerate
    always @(posedge clk)
        if (in_start)
            minus <= in_n[N-1] ^ in_negative;
endmodule
`default_nettype wire
