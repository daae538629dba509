// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one joint by the iterative CORDIC: x = L1 cos j1, y = L1 sin j1.
// Formats: in_j1 uA, 2^A to the turn; out_x, out_y s(W-F).F, nearest, saturated;
//   cfg_c1 = floor(L1 * 0.607252935 * 2^4), L1 u(W-F).F: it takes out the gain.
// It starts in the middle of the quadrant, so that the signs of the start word replace the first micro-rotation.
// Error: at most 1.6 LSB at the tip up to L1 = 2^(W-2), 2.01 at any length (page). Latency and II 15 at W = 16.
// Status: overflow. Model: classic.fk1
`default_nettype none
module classic_fk1_iter #(
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
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire        [3:0]   out_status
);
    localparam G = 4;
    localparam D = W + 1 + G;
    generate
        if (W < 8 || W > 16 || F < 0 || F >= W || A < 4 || A > W + 3) begin : g_illegal
            classic_fk1_iter_needs_W_from_8_to_16_and_F_below_W_and_A_from_4_to_W_plus_3 rule ();
        end
    endgenerate

    wire [W+3:0] z = {{2{!in_j1[A-3]}}, in_j1[A-4:0], {(W+3-A){1'b0}}, 2'b10};
    wire [D-1:0] x0 = {1'b0, cfg_c1} ^ {D{in_j1[A-1] ^ in_j1[A-2]}};
    wire [D-1:0] y0 = {1'b0, cfg_c1} ^ {D{in_j1[A-1]}};
    wire [D-1:0] x, y;
    wire         busy, done;
    wire         unused = &{1'b0, x[G-1:0], y[G-1:0]};
    cordic_turn_iter #(.W(W), .D(D), .GAIN(0), .R(8'd14)) turn (
        .clk(clk), .rst(rst), .in_start(in_valid && in_ready), .in_x(x0), .in_y(y0), .in_fx(x0), .in_fy(y0),
        .in_minus_x(1'b0), .in_minus_y(1'b0), .in_z(z),
        .out_busy(busy), .out_done(done), .out_x(x), .out_y(y));

    assign in_ready = !busy && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (done || (out_valid && !out_ready));

    cordic_clamp #(.W(W)) clamp (.in_x(x[D-1 -: W+1]), .in_y(y[D-1 -: W+1]),
        .out_x(out_x), .out_y(out_y), .out_overflow(out_status[2]));
    assign {out_status[3], out_status[1:0]} = 3'b000;
endmodule
`default_nettype wire
