// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of one joint: the unit vector (c1, n1) = (x, y) / |(x, y)|, by one multiplier.
// Formats: in_x, in_y s(W-F).F; out_c1, out_n1 s2.U, rounded to nearest (ties upward).
// Error: the coordinates of one vector exactly along (x, y), of length 1 within 0.95 * 2^-16 (bounds.vector.length with
// W above 16), each rounded to nearest.
// Latency and II: 8 + 7 PIPE, 9 + 8 PIPE with W above 16.
// Status: singular (x = y = 0: the last vector is held, (1, 0) after a reset).
// Source: rational trigonometry paper, eq. 9, which loses the quadrant. Model: vector.ik1
`default_nettype none
module vector_ik1 #(
    parameter W = 16,        // bits of a coordinate, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of a coordinate, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,        // fraction bits of cosine and sine, 4 to 16; 20, 24 with W above 16, 20 (default 16)
    parameter PIPE = 0,      // registers behind product and table, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_c1,
    output wire signed [U+1:0] out_n1,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || U < 4 || U > 16 + 4 * (W > 16) + 4 * (W > 20) || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            vector_ik1_needs_W_4_to_24_F_below_W_U_4_to_16_20_24_and_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    localparam          N = W > 20 ? 24 : W > 16 ? 20 : 16;  // bits of the kernel's coordinates
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}};
    generate
        if (N == 16) begin : g_narrow
            kernel_vector_aim #(.U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y),
                .out_valid(out_valid), .out_ready(out_ready), .out_c(out_c1), .out_n(out_n1), .out_status(out_status));
        end else begin : g_wide
            /* verilator lint_off PINCONNECTEMPTY */
            kernel_vector_wide_aim #(.N(N), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y),
                .out_valid(out_valid), .out_ready(out_ready), .out_c(out_c1), .out_n(out_n1), .out_cos(), .out_sin(),
                .out_word(), .out_none(), .out_status(out_status));
            /* verilator lint_on PINCONNECTEMPTY */
        end
    endgenerate
endmodule
`default_nettype wire
