// SPDX-License-Identifier: Apache-2.0
// The two multipliers of kernel_solve and their operands: squares, and a point seen from a turned axis.
//   out_sum = k1 * xs + k2 * ys, or k1 * xs - k2 * ys with in_minus; squares where k1 = xs and k2 = ys
// Formats: in_word, k1, k2 s17.4; xs, ys s17.X; out_sum s34.0, both products truncated. -k2 is its one's complement.
// Every in_* but in_word, in_sign and in_minus writes its register at the end of the clock:
//   in_ys: ys <- word; in_xs: xs <- ys; in_k1: k1 <- word; in_k2: k2 <- word; in_one: (k1, k2) <- (1.0, 0), 1.0 = 2^15;
//   in_zero: k1 <- 0; in_clamp, with in_k1: k1 <- +-1.0 instead; in_flat, with in_k2: k2 <- 0 instead
// Model: rational._elbow
`default_nettype none
module kernel_solve_turn #(
    parameter X = 0  // fraction bits of xs and ys, 0 or 1: 0, coordinates have none; 1 for the rho of three joints
) (
    input  wire               clk,
    input  wire signed [20:0] in_word,
    input  wire               in_ys,
    input  wire               in_xs,
    input  wire               in_k1,
    input  wire               in_k2,
    input  wire               in_one,
    input  wire               in_zero,
    input  wire               in_clamp,
    input  wire               in_sign,  // of the +-1.0 of in_clamp
    input  wire               in_flat,
    input  wire               in_minus,
    output wire [33:0]        out_sum
);
    reg  signed [16+X:0] xs, ys;
    reg  signed [20:0]   k1, k2;
    wire signed [20:0]   turned = k2 ^ {21{in_minus}};
    wire signed [37+X:0] product1 = k1 * xs;
    wire signed [37+X:0] product2 = turned * ys;
    assign               out_sum = product1[37+X:4+X] + product2[37+X:4+X];
    wire                 unused = &{1'b0, in_word[3-X:0], product1[3+X:0], product2[3+X:0]};

    always @(posedge clk) begin
        if (in_ys)
            ys <= in_word[20:4-X];
        if (in_xs)
            xs <= ys;
        if (in_k1)
            k1 <= in_clamp ? {in_sign, 1'b1, 19'd0} : in_word;
        if (in_one || in_zero)  // one condition, so that most bits are a synchronous clear
            k1 <= {1'b0, in_one, 19'd0};
        if (in_k2)
            k2 <= in_flat ? 21'sd0 : in_word;
        if (in_one)
            k2 <= 21'sd0;
    end
endmodule
`default_nettype wire
