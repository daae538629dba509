// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one joint by the parallel CORDIC: x = L1 cos j1, y = L1 sin j1, in one long clock.
// Formats: in_j1 uA, 2^A to the turn; out_x, out_y s(W-F).F, nearest, saturated;
//   cfg_c1 = floor(L1 * 0.607252935 * 2^4), L1 u(W-F).F. The arithmetic of classic_fk1_iter, bit for bit.
// Error: at most 1.6 LSB at the tip up to L1 = 2^(W-2), 2.01 at any length (page). Latency and II 1.
// Status: overflow. Paper: the parallel CORDIC of its tables III and IV. Model: classic.fk1
`default_nettype none
module classic_fk1_comb #(
    parameter W = 16,  // bits of a coordinate, 8 to 16; 16 is the library's word
    parameter F = 8,   // fraction bits of a coordinate, 0 to W - 1; 8: Q7.8, the paper's word
    parameter A = 16   // bits of an angle, 4 to W + 3, 2^A to the turn; 16, as sharp as the coordinates
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W+3:0] cfg_c1,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire        [A-1:0] in_j1,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output reg  signed [W-1:0] out_y,
    output wire        [3:0]   out_status
);
    localparam G = 4;
    localparam D = W + 1 + G;
    generate
        if (W < 8 || W > 16 || F < 0 || F >= W || A < 4 || A > W + 3) begin : g_illegal
            classic_fk1_comb_needs_W_from_8_to_16_and_F_below_W_and_A_from_4_to_W_plus_3 rule ();
        end
    endgenerate

    wire [W+3:0] z = {{2{!in_j1[A-3]}}, in_j1[A-4:0], {(W+3-A){1'b0}}, 2'b10};
    wire [D-1:0] x, y;
    wire [W-1:0] clamped_x, clamped_y;
    wire         over;
    reg          overflow;
    wire         unused = &{1'b0, x[G-1:0], y[G-1:0]};
    cordic_turn_array #(.W(W), .D(D), .R(8'd14), .CLOCKED(0)) turn (.clk(clk), .in_enable(1'b0),
        .in_x({1'b0, cfg_c1} ^ {D{in_j1[A-1] ^ in_j1[A-2]}}), .in_y({1'b0, cfg_c1} ^ {D{in_j1[A-1]}}), .in_z(z),
        .out_x(x), .out_y(y));
    cordic_clamp #(.W(W)) clamp (.in_x(x[D-1 -: W+1]), .in_y(y[D-1 -: W+1]),
        .out_x(clamped_x), .out_y(clamped_y), .out_overflow(over));

    assign in_ready = !out_valid || out_ready;
    assign out_status = {1'b0, overflow, 2'b00};
    always @(posedge clk) begin
        out_valid <= !rst && (in_valid || !in_ready);
        if (in_valid && in_ready) {out_x, out_y, overflow} <= {clamped_x, clamped_y, over};
    end
endmodule
`default_nettype wire
