// SPDX-License-Identifier: Apache-2.0
// This core finds the tip of one joint: x = L1 cos = +-L1 sqrt(1 - s), y = L1 sin = +-L1 sqrt(s).
// Formats: in_j1 is a turn-spread u2.S, cfg_l1 is u(W-F).F; out_x and out_y are s(W-F).F, nearest (ties up), saturated.
// Error: a coordinate is within 1/2 + 1/16 + 0.52 L1 / 2^15 LSB, L1 in LSB: 0.83 LSB at 2^14 (64 units of Q7.8);
// 1/2 + 1/32 + r L1 / 2^W with W above 18, r from bounds.rational.fk1.
// Latency 2 + 3 PIPE, II 2: one table and two multipliers compute x, then y. Latency and II 5 + 5 PIPE with W above 18,
// with the codec and the kernel of rational_fk2.
// Status: overflow (a coordinate was saturated).
// Source: rational-trigonometry paper, Table I and eqs. 51 and 52, with L1 outside the root, which saves half the bits.
// Model: rational_fk1.fk1
`default_nettype none
module rational_fk1 #(
    parameter W = 16,        // bits of a coordinate and of the length, 4 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); F changes no logic
    parameter S = 24,        // fraction bits of a turn-spread, 1 to 24, 10 to 40 with W above 18 (default 24)
    parameter PIPE = 0,      // registers behind products and table, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [S+1:0]        in_j1,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 24 || F < 0 || F >= W || S < 1 + 9 * (W > 18) || S > 24 + 16 * (W > 18) || PIPE < 0
            || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            rational_fk1_needs_W_4_to_24_F_below_W_S_1_to_24_above_W_18_10_to_40_PIPE_0_or_1_MULTIPLY_18_or_27
                rule ();
        end
    endgenerate

    wire   overflow;
    assign out_status = {1'b0, overflow, 2'b00};
    generate
        if (W <= 18) begin : g_narrow
            wire        cosine, sine, negative;
            wire [18:0] w;
            wire [16:0] slope;
            spread_product #(.S(S)) codec (.clk(clk), .in_cos(cosine), .in_sin(sine), .in_j(in_j1),
                .out_negative(negative), .out_w(w), .out_slope(slope));
            kernel_scale #(.W(W), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .in_valid(in_valid), .in_ready(in_ready),
                .out_cos(cosine), .out_sin(sine), .in_negative(negative), .in_w(w), .in_slope(slope),
                .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x), .out_y(out_y), .out_overflow(overflow));
        end else begin : g_wide
            wire [4*W+39:0] chords;
            wire [5:0]      signs;  // signs and range, in the clock of the knots
            spread_parabolas #(.S(S), .U(W), .PIPE(PIPE)) codec (.clk(clk), .in_j(in_j1), .out_chords(chords));
            if (PIPE == 0) begin : g_now
                assign signs = chords[4*W+39:4*W+34];
            end else begin : g_late
                reg [5:0] one, two;
                assign    signs = two;
                always @(posedge clk)
                    {one, two} <= {chords[4*W+39:4*W+34], one};
            end
            /* verilator lint_off PINCONNECTEMPTY */
            kernel_chain #(.JOINTS(1), .W(W), .U(W), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
                .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2({W{1'b0}}), .in_valid(in_valid), .in_ready(in_ready),
                .out_want(), .in_chords({signs, chords[4*W+33:0]}), .out_valid(out_valid), .out_ready(out_ready),
                .out_x(out_x), .out_y(out_y), .out_z(), .out_overflow(overflow));
            /* verilator lint_on PINCONNECTEMPTY */
        end
    endgenerate
endmodule
`default_nettype wire
