// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one joint: x = L1 cos = +-L1 sqrt(1 - s), y = L1 sin = +-L1 sqrt(s).
// Formats: in_j1 turn-spread u2.S, cfg_l1 uQ(W-F).F, out_x and out_y sQ(W-F).F, nearest, saturated.
// Error of a coordinate: 1/2 + 1/16 + 0.52 L1 / 2^15 LSB with L1 in LSB: 0.83 LSB at 2^14 (64 units in Q7.8).
// Latency 2, II 2: one table and two products serve x, then y. root = slope * w, and L1 * w needs no table, so
//   before clock 0 (accept): n = +-L1 * w of x, read its slope | before 1: x = n * slope, n of y, read its slope
//   before 2: y = n * slope stands behind the table until it is taken
// Status: overflow (a coordinate was saturated).
// Source: rational trigonometry paper, eqs. 51 and 52 (as L1 * root: no quadrance Q1, half the bits) and Table I.
// Model: rational.fk1
`default_nettype none
module rational_fk1 #(
    parameter W = 16,
    parameter F = 8,
    parameter S = 24
) (
    input  wire         clk,
    input  wire         rst,
    input  wire [W-1:0] cfg_l1,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [S+1:0] in_j1,
    output reg          out_valid,
    input  wire         out_ready,
    output reg  [W-1:0] out_x,
    output wire [W-1:0] out_y,
    output wire [3:0]   out_status
);
    generate
        if (W < 4 || W > 18 || F < 0 || F >= W || S < 1 || S > 24) begin : g_illegal
            rational_fk1_needs_W_from_4_to_18_and_F_below_W_and_S_from_1_to_24 rule ();
        end
    endgenerate

    reg          busy;  // y is being read
    reg  [S+1:0] j1;
    wire         accept = in_valid && in_ready;
    assign       in_ready = !busy && (!out_valid || out_ready);

    // odd quadrants hold 1 - s: they swap the roles of the word and its complement
    wire [S+1:0] word = busy ? j1 : in_j1;
    wire [18:0]  w;
    wire [16:0]  slope;
    root_product #(.S(S)) chord (
        .clk(clk), .in_read(accept || busy), .in_s(word[S-1:0]), .in_not(busy == word[S]),
        .out_w(w), .out_slope(slope));

    // n = L1 * w cut 4 bits below the coordinate's LSB; a constant 1 behind the cut centres it, and makes
    // the one's complement an exact negation: -(2 n + 1) = 2 ~n + 1
    wire [13:0]   below_n;
    wire [W+4:0]  magnitude;
    wire          negative = word[S+1] ^ (!busy & word[S]);
    reg  [W+5:0]  n;
    assign {magnitude, below_n} = cfg_l1 * w;

    wire [19:0]   below;
    wire          half;
    wire [2:0]    above;  // copies of the sign: |root| < 1 + 2^-15
    wire [W:0]    floor;
    assign {above, floor, half, below} = $signed({n, 1'b1}) * $signed({1'b0, slope});
    wire [W:0]    nearest = floor + {{W{1'b0}}, half};
    wire          over = nearest[W] ^ nearest[W-1];
    wire [W-1:0]  coordinate = over ? {nearest[W], {(W-1){!nearest[W]}}} : nearest[W-1:0];
    wire          unused = &{1'b0, below_n, below, above};

    reg over_x;
    assign out_y = coordinate;
    assign out_status = {1'b0, over_x | over, 2'b00};
    always @(posedge clk) begin
        if (accept)
            j1 <= in_j1;
        if (accept || busy)
            n <= {1'b0, magnitude} ^ {(W+6){negative}};
        if (busy) begin
            out_x  <= coordinate;
            over_x <= over;
        end
        busy      <= accept;
        out_valid <= busy || (out_valid && !out_ready);
        if (rst) begin
            busy      <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
