// SPDX-License-Identifier: Apache-2.0
// Every joint position of a chain of any number of links, streamed from the base: a link in, a position out.
//   (C, N) <- (C c - N n, C n + N c), from (1, 0) on; (x, y) <- (x, y) + L (C, N), from (0, 0) on; in_last ends a chain
//   SPACE = 1: (x, y, z) <- (x, y, z) + L (C c3, C n3, N), where (c3, n3), the yaw, is the first word of the chain
// Formats: in_c1, in_n1 s2.U (1.0 is 2^U); in_l uQ(W-F).F; out_x ... out_z sQ(W-F).F, rounded to nearest and saturated;
// the sums are not. Range: the product of the lengths of the vectors is below 2; beyond it this chain wraps.
// Error of a coordinate after k links: 0.57 LSB (in space x, y 0.60) + sum over links i of sqrt(5) i L_i / 2^(U+G) LSB,
// G = log2 N + 3. Latency 4, in space 6, at PIPE = 1 7 and 9; II 3 a link.
// Status: overflow (a coordinate was saturated, or the chain has more than N links; one beyond the N-th does not
// count).
// Source: rational trigonometry paper, section IV-D, from joint words. Model: chain.vector_chain
`default_nettype none
module vector_chain #(
    parameter SPACE = 0,     // 1: in space, the first word of a chain is its yaw; 0: planar, out_z is 0 (default 0)
    parameter W = 16,        // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter U = 16,        // fraction bits of cosine and sine, 4 to 24 (default 16)
    parameter N = 32,        // links of a chain without its yaw, 2 to 64 (default 32)
    parameter PIPE = 0,      // registers behind the products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    input  wire [W-1:0]        in_l,
    input  wire                in_last,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire                out_last,
    output wire [3:0]          out_status
);
    generate
        if (SPACE < 0 || SPACE > 1 || W < 4 || W > 24 || F < 0 || F >= W || U < 4 || U > 24 || N < 2
            || N > 64 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0) begin : g_illegal
            vector_chain_needs_W_and_U_4_to_24_F_below_W_N_2_to_64_SPACE_PIPE_0_or_1_and_MULTIPLY_18_27 rule ();
        end
    endgenerate

    wire   overflow;
    assign out_status = {1'b0, overflow, 2'b00};
    generate
        if (SPACE == 0) begin : g_plane
            assign out_z = {W{1'b0}};
            kernel_vector_sum #(.W(W), .U(U), .N(N), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (.clk(clk), .rst(rst),
                .in_valid(in_valid), .in_ready(in_ready), .in_c1(in_c1), .in_n1(in_n1), .in_l(in_l),
                .in_last(in_last), .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x), .out_y(out_y),
                .out_last(out_last), .out_overflow(overflow));
        end else begin : g_space
            kernel_vector_space #(.W(W), .U(U), .N(N), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (.clk(clk), .rst(rst),
                .in_valid(in_valid), .in_ready(in_ready), .in_c1(in_c1), .in_n1(in_n1), .in_l(in_l),
                .in_last(in_last), .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x), .out_y(out_y),
                .out_z(out_z), .out_last(out_last), .out_overflow(overflow));
        end
    endgenerate
endmodule
`default_nettype wire
