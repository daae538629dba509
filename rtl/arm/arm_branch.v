// SPDX-License-Identifier: Apache-2.0
// One branch of the inverse of a real arm, arm_ik3 without its rule: the solver of these coordinates, arm_solve up to
// 16 bits and arm_solve_wide with 20 or 24 above, and arm_vectors. Words of a coordinate are aligned to the left.
//   in_load: joints 1 and 3 are loaded from in_last_*, which they hold where they have no direction
// Formats: in_*, cfg_* and out_status are those of arm_ik3; in_last_*, out_c, out_n s2.U, joint 1 in the lowest bits.
// Error of the tip, latency, II and status: those of arm_ik3. Model: arm.branch
`default_nettype none
module arm_branch #(
    parameter W = 16,        // bits of a coordinate and of a length, 8 to 24 (default 16)
    parameter U = 16,        // fraction bits of cosine and sine, 8 to 16; 20, 24 with W above 16, 20 (default 16)
    parameter BASE = 1,      // 1 (default): with base height; 0: without
    parameter SHOULDER = 1,  // 1 (default): with shoulder offset; 0: without
    parameter LATERAL = 1,   // 1 (default): with lateral offset; 0: without
    parameter ELBOW = 1,     // 1 (default): with elbow offset; 0: without
    parameter ABSOLUTE = 1,  // 1 (default): joint 2 is measured from the base; 0: from link 1
    parameter MARGINS = 0,   // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
    parameter PIPE = 0,      // 0 or 1 (default 0: fewest clocks); 1: registers behind the products
    parameter MULTIPLY = 18, // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
    parameter N = W > 20 ? 24 : W > 16 ? 20 : 16  // bits of the solver's coordinates, of one value (default 16)
) (
    input  wire                         clk,
    input  wire                         rst,
    input  wire [W-1:0]                 cfg_l1,
    input  wire [W-1:0]                 cfg_l2,
    input  wire signed [2*N+1:0]        cfg_q,
    input  wire [(N == 24 ? 29 : 25):0] cfg_r,
    input  wire [(N == 16 ? 3 : 4):0]   cfg_e,
    input  wire signed [W-1:0]          cfg_base,
    input  wire signed [W-3:0]          cfg_shoulder,
    input  wire signed [W-1:0]          cfg_lateral,
    input  wire signed [2*N-1:0]        cfg_bb,
    input  wire signed [U+1:0]          cfg_ce,
    input  wire signed [U+1:0]          cfg_ne,
    input  wire [W-2:0]                 cfg_margin,
    input  wire [N-4:0]                 cfg_slack,
    input  wire                         in_valid,
    output wire                         in_ready,
    input  wire signed [W-1:0]          in_x,
    input  wire signed [W-1:0]          in_y,
    input  wire signed [W-1:0]          in_z,
    input  wire                         in_elbow,
    input  wire                         in_back,
    input  wire                         in_load,
    input  wire [3*(U+2)-1:0]           in_last_c,
    input  wire [3*(U+2)-1:0]           in_last_n,
    output wire                         out_valid,
    input  wire                         out_ready,
    output wire [3*(U+2)-1:0]           out_c,
    output wire [3*(U+2)-1:0]           out_n,
    output wire [3:0]                   out_status
);
    localparam          I = N == 16 ? 20 : N + 2;
    wire signed [N-1:0] x = {in_x, {(N-W){1'b0}}}, y = {in_y, {(N-W){1'b0}}}, z = {in_z, {(N-W){1'b0}}};
    wire [N-1:0]        l1 = {cfg_l1, {(N-W){1'b0}}}, l2 = {cfg_l2, {(N-W){1'b0}}};
    wire signed [N-1:0] base = {cfg_base, {(N-W){1'b0}}}, lateral = {cfg_lateral, {(N-W){1'b0}}};
    wire signed [N-3:0] shoulder = {cfg_shoulder, {(N-W){1'b0}}};
    wire [N-2:0]        margin = {cfg_margin, {(N-W){1'b0}}};
    wire [2:0]          cosine, sine;
    wire [I+3:0]        word;
    wire                flat, negative, none, sin2, by1, kept, turned;
    generate
        if (N == 16) begin : g_narrow
            arm_solve #(.U(U), .BASE(BASE), .SHOULDER(SHOULDER), .LATERAL(LATERAL), .ABSOLUTE(ABSOLUTE),
                .MARGINS(MARGINS), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_base(base), .cfg_shoulder(shoulder), .cfg_lateral(lateral), .cfg_bb(cfg_bb), .cfg_margin(margin),
                .cfg_slack(cfg_slack), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .in_z(z),
                .in_elbow(in_elbow), .in_back(in_back), .out_valid(out_valid), .out_ready(out_ready),
                .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat), .out_negative(negative),
                .out_none(none), .out_sine(sin2), .out_by1(by1), .out_kept(kept), .out_turned(turned),
                .out_status(out_status));
        end else begin : g_wide
            arm_solve_wide #(.N(N), .U(U), .BASE(BASE), .SHOULDER(SHOULDER), .LATERAL(LATERAL), .ABSOLUTE(ABSOLUTE),
                .MARGINS(MARGINS), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(l1), .cfg_l2(l2), .cfg_q(cfg_q), .cfg_r(cfg_r), .cfg_e(cfg_e),
                .cfg_base(base), .cfg_shoulder(shoulder), .cfg_lateral(lateral), .cfg_bb(cfg_bb), .cfg_margin(margin),
                .cfg_slack(cfg_slack), .in_valid(in_valid), .in_ready(in_ready), .in_x(x), .in_y(y), .in_z(z),
                .in_elbow(in_elbow), .in_back(in_back), .out_valid(out_valid), .out_ready(out_ready),
                .out_cos(cosine), .out_sin(sine), .out_word(word), .out_flat(flat), .out_negative(negative),
                .out_none(none), .out_sine(sin2), .out_by1(by1), .out_kept(kept), .out_turned(turned),
                .out_status(out_status));
        end
    endgenerate
    arm_vectors #(.U(U), .I(I), .ELBOW(ELBOW), .ABSOLUTE(ABSOLUTE), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) codec (
        .clk(clk), .rst(rst), .cfg_ce(cfg_ce), .cfg_ne(cfg_ne), .in_cos(cosine), .in_sin(sine), .in_word(word),
        .in_flat(flat), .in_negative(negative), .in_none(none), .in_sine(sin2), .in_by1(by1), .in_kept(kept),
        .in_turned(turned), .in_load(in_load), .in_last_c(in_last_c), .in_last_n(in_last_n), .out_c(out_c),
        .out_n(out_n));
endmodule
`default_nettype wire
