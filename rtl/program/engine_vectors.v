// SPDX-License-Identifier: Apache-2.0
// The module converts six binary angles to unit vectors, with one table codec, and offers them together to a kernel.
// Formats: in_angles: joint 1 in the lowest A bits, a full turn is 2^A; out_vectors: c1 in the lowest bits, then n1 to
// n6, s2.U, rounded to nearest. Error: that of angle_to_vector.
// Latency: 13 + 2 PIPE, two clocks a joint and one, with PIPE = 1 three; out_valid is then high for one clock. in_ready
// is high only while the kernel is ready, which it stays until the vectors come.
`default_nettype none
module engine_vectors #(
    parameter A = 18,  // bits of an angle, 12 to 24 (default 18)
    parameter U = 16,  // fraction bits of a unit vector, 12 to 18 (default 16)
    parameter PIPE = 0 // registers of the codec, 0 or 1 (default 0: fewest clocks)
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             in_valid,
    output wire             in_ready,
    input  wire [6*A-1:0]   in_angles,
    output wire             out_valid,
    input  wire             out_ready,
    output wire [12*U+23:0] out_vectors
);
    generate
        if (A < 12 || A > 24 || U < 12 || U > 18 || PIPE < 0 || PIPE > 1) begin : g_illegal
            engine_vectors_needs_A_from_12_to_24_and_U_from_12_to_18_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    reg  [6*A-1:0]      angles;  // the joint being converted is in the lowest bits
    reg  [6:1]          left;    // one-hot: the joint that the codec gives next, 0 between samples
    reg                 feed;    // a joint is offered to the codec
    reg  [2:0]          fed;     // joints that the codec has accepted
    wire                take, ready, have;
    wire signed [U+1:0] c, n;
    wire                accept = in_valid && in_ready;
    assign              in_ready = left == 6'd0 && out_ready;
    assign              take = feed && ready;
    assign              out_valid = have && left[6];
    angle_to_vector #(.A(A), .U(U), .PIPE(PIPE)) codec (.clk(clk), .rst(rst), .in_valid(feed), .in_ready(ready),
        .in_j(angles[A-1:0]), .out_valid(have), .out_ready(1'b1), .out_c(c), .out_n(n));

    reg  [10*U+19:0] first;  // vectors of joints 1 to 5, the last one in the highest bits
    assign           out_vectors = {n, c, first};
    always @(posedge clk) begin
        if (accept)
            angles <= in_angles;
        else if (take)
            angles <= angles >> A;
        if (have)
            first <= {n, c, first[10*U+19:2*U+4]};
        fed <= accept ? 3'd0 : fed + {2'd0, take};
        feed <= !rst && (accept || feed && !(take && fed == 3'd5));
        left <= rst ? 6'd0 : accept ? 6'd1 : have ? left << 1 : left;
    end
endmodule
`default_nettype wire
