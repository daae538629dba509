// SPDX-License-Identifier: Apache-2.0
// This part holds the residual angle of a sequential rotation and finds its next digit.
//   micro-rotation i = in_word + 1: z' = 2 (z -+ atan 2^-i);  digit d, |d| = in_word, 0 to 2: z' = 4 (z -+ d radian)
// z is scaled so that its leading bits are always on top, so three bits and the sign give a digit.
// Minus is the one's complement, as in cordic_rotation and cordic_digit. The sign is one more input of the ROM's cell.
// out_two and out_one say that |d| is 2 or 1 for the digit of the next clock; they come from z'.
// Format: in_z is s(W+4).(W+5) turns, |z| <= 1/8. Model: cordic.turn
`default_nettype none
module cordic_residual #(
    parameter W = 16  // bits of a coordinate, 8 to 24 (default 16); it sets the number of steps
) (
    input  wire                clk,
    input  wire                in_load,
    input  wire signed [W+3:0] in_z,
    input  wire                in_turn,
    input  wire                in_digit,
    input  wire        [3:0]   in_word,
    output wire                out_minus,
    output wire                out_two,
    output wire                out_one
);
    localparam Z = W + 4;
    localparam C = (W + 1) / 2;  // micro-rotations
    localparam B = C > 8 ? 4 : 3;  // bits of in_word in use
    localparam N = 1 << B;

    wire [4*N*Z-1:0] terms;  // to subtract, then to add
    genvar g;
    generate
        for (g = 0; g < 4 * N; g = g + 1) begin : g_word
            localparam M = g % (2 * N);  // table entry: micro-rotation M + 1, or digit M - N
            localparam I = M < C ? M + 1 : 9;
            localparam LOW = M < C ? (M > 2 ? M - 2 : 0) : C > 2 ? C - 2 : 0;  // bits too fine for this step
            localparam TWO = M == N + 2 ? 1 : 0;
            if (M < C || M == N + 1 || M == N + 2) begin : g_some
                wire [Z+I-1:0] angle;
                wire           unused = &{1'b0, angle};
                cordic_angle #(.I(I), .Z(Z + I)) constant (.in_minus(1'b0), .out_sum(angle));
                assign terms[Z*g +: Z] = {angle[Z-1-TWO:LOW-TWO] ^ {(Z-LOW){g < 2 * N}}, {LOW{1'b0}}};
            end else begin : g_none
                assign terms[Z*g +: Z] = {Z{1'b0}};
            end
        end
    endgenerate

    reg  [Z-1:0] z;
    wire [Z-1:0] sum = z + terms[Z*{z[Z-1], in_digit, in_word[B-1:0]} +: Z];
    wire [Z-1:0] next = in_digit ? sum << 2 : sum << 1;
    wire [2:0]   top = next[Z-2 -: 3] ^ {3{next[Z-1]}};
    wire         unused = &{1'b0, in_word};
    assign out_minus = z[Z-1];
    assign out_two = top[2];
    assign out_one = !top[2] && top[1:0] != 2'd0;
    always @(posedge clk)
        if (in_load) z <= in_z;
        else if (in_turn) z <= next;
endmodule
`default_nettype wire
