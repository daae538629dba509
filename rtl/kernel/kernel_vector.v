// SPDX-License-Identifier: Apache-2.0
// Unit vectors of two or three joints by the kernel of these coordinates: kernel_vector_solve up to 16 bits,
// kernel_vector_wide with 20 or 24 above. Words of a coordinate are aligned to the left.
// Formats: in_*, cfg_l1, cfg_l2, cfg_margin are W-bit words, LSB of a coordinate; other words are those of the kernel,
// out_word has I fraction bits, 20 up to W = 16, then N + 2. Error, latency, II and status: those of the kernel.
// Models: kernel_vector_solve, kernel_vector_wide
`default_nettype none
module kernel_vector #(
    parameter W = 16,         // bits of a coordinate and of a length, 4 to 24 (default 16)
    parameter JOINTS = 2,     // joints, 2 or 3 (default 2): in the plane, where in_z is not used, or in space
    parameter PRODUCTS = 3,   // multipliers, 3, or up to 16 bits 2 with two joints and LAG = 0 (default 3)
    parameter LAG = 0,        // clocks of the codec after the last word, 0 to 6, up to 16 bits 0 or 2 (default 0)
    parameter MARGINS = 0,    // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
    parameter U = 16,         // fraction bits of a rounded word, 8 to N (default 16); N + 2: not rounded
    parameter PIPE = 0,       // 0 or 1 (default 0: fewest clocks); 1: registers behind the products
    parameter MULTIPLY = 18,  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter N = W > 20 ? 24 : W > 16 ? 20 : 16,  // bits of the kernel's coordinates, of one value (default 16)
    parameter I = N == 16 ? 20 : N + 2             // fraction bits of out_word, of one value (default 20)
) (
    input  wire                         clk,
    input  wire                         rst,
    input  wire [W-1:0]                 cfg_l1,
    input  wire [W-1:0]                 cfg_l2,
    input  wire signed [2*N+1:0]        cfg_q,
    input  wire [(N == 24 ? 29 : 25):0] cfg_r,
    input  wire [(N == 16 ? 3 : 4):0]   cfg_e,
    input  wire [W-2:0]                 cfg_margin,
    input  wire [N-4:0]                 cfg_slack,
    input  wire                         in_valid,
    output wire                         in_ready,
    input  wire signed [W-1:0]          in_x,
    input  wire signed [W-1:0]          in_y,
    input  wire signed [W-1:0]          in_z,
    input  wire                         in_elbow,
    output wire                         out_valid,
    input  wire                         out_ready,
    output wire [2:0]                   out_cos,
    output wire [2:0]                   out_sin,
    output wire [I+3:0]                 out_word,
    output wire                         out_flat,
    output wire                         out_negative,
    output wire                         out_none,
    output wire [3:0]                   out_status
);
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}}, z = {in_z, {(N-W){1'b0}}};
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}};
    wire [N-2:0]        margin = {cfg_margin, {(N-W){1'b0}}};
    generate
        if (N == 16) begin : g_narrow
            kernel_vector_solve #(.JOINTS(JOINTS), .PRODUCTS(PRODUCTS), .LAG(LAG), .MARGINS(MARGINS), .U(U),
                .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack), .in_valid(in_valid), .in_ready(in_ready), .in_x(x),
                .in_y(y), .in_z(z), .in_elbow(in_elbow), .out_valid(out_valid), .out_ready(out_ready),
                .out_cos(out_cos), .out_sin(out_sin), .out_word(out_word), .out_flat(out_flat),
                .out_negative(out_negative), .out_none(out_none), .out_status(out_status));
        end else begin : g_wide
            kernel_vector_wide #(.N(N), .JOINTS(JOINTS), .U(U), .LAG(LAG), .PIPE(PIPE), .MULTIPLY(MULTIPLY),
                .MARGINS(MARGINS)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_margin(margin), .cfg_slack(cfg_slack), .cfg_shoulder({(N-2){1'b0}}), .cfg_lateral({N{1'b0}}),
                .cfg_bb({(2*N){1'b0}}), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .in_z(z),
                .in_elbow(in_elbow), .in_back(1'b0), .out_valid(out_valid), .out_ready(out_ready), .out_cos(out_cos),
                .out_sin(out_sin), .out_word(out_word), .out_flat(out_flat), .out_negative(out_negative),
                .out_none(out_none), .out_status(out_status));
        end
    endgenerate
endmodule
`default_nettype wire
