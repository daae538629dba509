// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of three joints by CORDIC: x = rho cos j3, y = rho sin j3,
//   rho = L1 cos j1 + L2 cos(j1 + j2), z = L1 sin j1 + L2 sin(j1 + j2).
// Three rotations, which is the fewest: L2 by j2, plus L1, by j1, and rho by j3. MODE 0 takes a micro-rotation a clock
// (classic_chain_iter), MODE 1, the paper's parallel CORDIC, a rotation a clock (classic_chain_comb).
// Formats: in_j1, in_j2, in_j3 uA, 2^A to the turn; out_x, out_y, out_z s(W-F).F, nearest, saturated;
//   cfg_s1 = floor(L1 * 0.607252935 * 2^5), cfg_s2 = floor(L2 * 0.521499916 * 2^5), L1, L2 u(W-F).F.
// Error: at most 2.9 LSB each up to L1 + L2 = 2^(W-2), 3.49 above W = 16 (bounds.classic.chain).
// Latency and II: 53 at W = 16 in MODE 0, 3 in MODE 1.
// Status: overflow. Paper: the parallel CORDIC of its tables III and IV. Model: classic.fk3
`default_nettype none
module classic_fk3 #(
    parameter MODE = 0,  // 0: iterative, 1: combinational between its registers (default 0)
    parameter W    = 16, // bits of a coordinate, 8 to 24 (default 16)
    parameter F    = 8,  // fraction bits of a coordinate, 0 to W - 1 (default 8: Q7.8, the paper's word)
    parameter A    = 16  // bits of an angle, 5 to W + 3, at most 24, 2^A to the turn (default 16)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W+4:0] cfg_s1,
    input  wire        [W+4:0] cfg_s2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire        [A-1:0] in_j1,
    input  wire        [A-1:0] in_j2,
    input  wire        [A-1:0] in_j3,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output reg  signed [W-1:0] out_z,
    output wire        [3:0]   out_status
);
    localparam G = 5;
    localparam D = W + 2 + G;
    wire [D-1:0] x, y;
    wire [W-1:0] clamped_x, clamped_y;
    wire         busy, done, lifted, over_x, over_y;
    wire         start = in_valid && in_ready;
    wire         unused = &{1'b0, x[G-1:0], y[G-1:0]};
    round_saturate #(.WI(W + 2), .WO(W), .SHIFT(0)) clamp_x (.in_x(x[D-1:G]), .out_x(clamped_x), .out_overflow(over_x));
    round_saturate #(.WI(W + 2), .WO(W), .SHIFT(0)) clamp_y (.in_x(y[D-1:G]), .out_x(clamped_y), .out_overflow(over_y));
    assign in_ready = !busy && (!out_valid || out_ready);
    always @(posedge clk)
        out_valid <= !rst && (done || (out_valid && !out_ready));
    reg over_z;
    always @(posedge clk)
        if (lifted) {out_z, over_z} <= {clamped_y, over_y};  // between the rotations y is the height

    generate
        if (MODE < 0 || MODE > 1 || W < 8 || W > 24 || F < 0 || F >= W || A < 5 || A > W + 3 ||
            A > 24) begin : g_illegal
            classic_fk3_needs_MODE_0_or_1_and_W_from_8_to_24_and_F_below_W_and_A_from_5_to_W_plus_3_and_to_24 rule ();
        end
        if (MODE == 0) begin : g_iterative
            classic_chain_iter #(.W(W), .A(A), .JOINTS(3)) chain (.clk(clk), .rst(rst), .in_start(start),
                .in_j1(in_j1), .in_j2(in_j2), .in_j3(in_j3), .in_s1(cfg_s1), .in_s2(cfg_s2),
                .out_busy(busy), .out_done(done), .out_lifted(lifted), .out_x(x), .out_y(y));
            assign {out_x, out_y} = {clamped_x, clamped_y};
            assign out_status = {1'b0, over_x || over_y || over_z, 2'b00};
        end else begin : g_combinational
            reg [2*W:0] result;
            classic_chain_comb #(.W(W), .A(A), .JOINTS(3)) chain (.clk(clk), .rst(rst), .in_start(start),
                .in_j1(in_j1), .in_j2(in_j2), .in_j3(in_j3), .in_s1(cfg_s1), .in_s2(cfg_s2),
                .out_busy(busy), .out_done(done), .out_lifted(lifted), .out_x(x), .out_y(y));
            assign out_x = result[2*W -: W];
            assign out_y = result[W -: W];
            assign out_status = {1'b0, result[0], 2'b00};
            always @(posedge clk)
                if (done) result <= {clamped_x, clamped_y, over_x || over_y || over_z};
        end
    endgenerate
endmodule
`default_nettype wire
