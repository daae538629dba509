// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one joint whose word is the unit vector itself: x = L1 c1, y = L1 n1.
// Formats: in_c1, in_n1 s2.U (1.0 is 2^U); cfg_l1 uQ(W-F).F; out_x, out_y sQ(W-F).F, rounded to nearest (ties upward)
// and saturated.
// Error of a coordinate: 1/2 LSB for the vector as it is given, of any length.
// Latency 2, II 2: x, then y through one rounding adder.
// Status: overflow (a coordinate was saturated).
// Source: rational trigonometry paper, eqs. 51 and 52, whose roots of spreads are the vector. Model: vector.fk1
`default_nettype none
module vector_fk1 #(
    parameter W = 16,  // bits of a coordinate and of the length, 4 to 24 (default 16)
    parameter F = 8,   // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter U = 16   // fraction bits of cosine and sine, 4 to 24 (default 16)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_c1,
    input  wire signed [U+1:0] in_n1,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || U < 4 || U > 24) begin : g_illegal
            vector_fk1_needs_W_from_4_to_24_and_F_below_W_and_U_from_4_to_24 rule ();
        end
    endgenerate

    reg    second;  // second clock of a sample: y is multiplied, x is rounded
    wire   accept = in_valid && in_ready;
    assign in_ready = !second && (!out_valid || out_ready);

    wire signed [W:0]     length = {1'b0, cfg_l1};
    reg  signed [U+1:0]   n;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [W+U+2:0] along = in_c1 * length, across = n * length;
    /* verilator lint_on UNUSEDSIGNAL */

    // x and y have one fraction bit. One of them is a product, the other is 1/2, which rounds it without a selector.
    localparam [W+2:0] HALF = 1;
    reg  [W+2:0] x, y;
    wire [W+2:0] sum = x + y;
    wire [W+1:0] nearest = sum[W+2:1];
    wire         over = nearest[W+1:W-1] != {3{nearest[W+1]}};
    reg          over_x;
    assign       out_y = over ? {nearest[W+1], {(W-1){!nearest[W+1]}}} : nearest[W-1:0];
    assign       out_status = {1'b0, over || over_x, 2'b00};
    wire         unused = &{1'b0, sum[0]};

    always @(posedge clk) begin
        n <= in_n1;
        if (accept || second) begin
            x <= second ? HALF : along[W+U+1:U-1];
            y <= second ? across[W+U+1:U-1] : HALF;
        end
        if (second) begin
            out_x  <= out_y;
            over_x <= over;
        end
        second    <= accept;
        out_valid <= second || (out_valid && !out_ready);
        if (rst) begin
            second    <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
