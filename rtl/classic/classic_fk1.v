// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one joint by CORDIC: x = L1 cos j1, y = L1 sin j1. MODE 0: a micro-rotation a clock;
//   MODE 1, the paper's parallel CORDIC: all of them in one long clock.
// Formats: in_j1 uA, 2^A to the turn; out_x, out_y s(W-F).F, nearest, saturated;
//   cfg_c1 = floor(L1 * 0.607252935 * 2^4), L1 u(W-F).F: it takes out the gain.
// It starts in the middle of the quadrant, so that the signs of the start word replace the first micro-rotation.
// Error: the tip is within 1.6 LSB up to L1 = 2^(W-2), within 2.01 at any length; above W = 16 within 1.89 and 2.31
//   (bounds.classic.fk1).
// Latency and II: 15 at W = 16 in MODE 0, 1 in MODE 1.
// Status: overflow. Paper: the parallel CORDIC of its tables III and IV. Model: classic.fk1
`default_nettype none
module classic_fk1 #(
    parameter MODE = 0,  // 0: iterative, 1: combinational between its registers (default 0)
    parameter W    = 16, // bits of a coordinate, 8 to 24 (default 16)
    parameter F    = 8,  // fraction bits of a coordinate, 0 to W - 1 (default 8: Q7.8, the paper's word)
    parameter A    = 16  // bits of an angle, 4 to W + 3, at most 24, 2^A to the turn (default 16)
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
    localparam [31:0] ROUND = W > 16 ? 14 + 3 * (W - 16) / 8 : 14;  // half an LSB, and the mean of what rounds down
    wire [W+3:0] z = {{2{!in_j1[A-3]}}, in_j1[A-4:0], {(W+3-A){1'b0}}, 2'b10};
    wire [D-1:0] x0 = {1'b0, cfg_c1} ^ {D{in_j1[A-1] ^ in_j1[A-2]}};
    wire [D-1:0] y0 = {1'b0, cfg_c1} ^ {D{in_j1[A-1]}};
    wire [D-1:0] x, y;
    wire [W-1:0] clamped_x, clamped_y;
    wire         over, busy, done;
    wire         start = in_valid && in_ready;
    wire         unused = &{1'b0, x[G-1:0], y[G-1:0]};
    cordic_clamp #(.W(W)) clamp (.in_x(x[D-1 -: W+1]), .in_y(y[D-1 -: W+1]),
        .out_x(clamped_x), .out_y(clamped_y), .out_overflow(over));
    assign in_ready = !busy && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (done || (out_valid && !out_ready));

    generate
        if (MODE < 0 || MODE > 1 || W < 8 || W > 24 || F < 0 || F >= W || A < 4 || A > W + 3 ||
            A > 24) begin : g_illegal
            classic_fk1_needs_MODE_0_or_1_and_W_from_8_to_24_and_F_below_W_and_A_from_4_to_W_plus_3_and_to_24 rule ();
        end
        if (MODE == 0) begin : g_iterative
            cordic_turn_iter #(.W(W), .D(D), .GAIN(0), .R(ROUND[7:0])) turn (
                .clk(clk), .rst(rst), .in_start(start), .in_x(x0), .in_y(y0), .in_fx(x0), .in_fy(y0),
                .in_minus_x(1'b0), .in_minus_y(1'b0), .in_z(z),
                .out_busy(busy), .out_done(done), .out_x(x), .out_y(y));
            assign {out_x, out_y} = {clamped_x, clamped_y};
            assign out_status = {1'b0, over, 2'b00};
        end else begin : g_combinational
            reg [2*W:0] result;
            cordic_turn_array #(.W(W), .D(D), .R(ROUND[7:0]), .CLOCKED(0)) turn (.clk(clk), .in_enable(1'b0),
                .in_x(x0), .in_y(y0), .in_z(z), .out_x(x), .out_y(y));
            assign busy = 1'b0;
            assign done = start;
            assign out_x = result[2*W -: W];
            assign out_y = result[W -: W];
            assign out_status = {1'b0, result[0], 2'b00};
            always @(posedge clk)
                if (start) result <= {clamped_x, clamped_y, over};
        end
    endgenerate
endmodule
`default_nettype wire
