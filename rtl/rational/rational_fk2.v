// SPDX-License-Identifier: Apache-2.0
// This core finds the tip of two joints in the plane: x = A c1 - B n1, y = A n1 + B c1, A = L1 + L2 c2, B = L2 n2.
// Formats: in_j1 and in_j2 are turn-spreads u2.S, cfg_l1 and cfg_l2 are u(W-F).F; out_x and out_y are s(W-F).F, nearest
// (ties up), saturated.
// Error at U = 16: a coordinate is within 0.61 + 1.06 (L1 + 2 L2) / 2^16 LSB, lengths in LSB: 1.01 at L1 = L2 = 2^13.
// Latency and II: 7 + 6 PIPE, 7 + 7 PIPE with U above 18. The cycle table is in kernel_chain.v.
// Status: overflow (a coordinate was saturated).
// Source: rational-trigonometry paper, eqs. 84 and 96, which replace eqs. 11-17 and the quadrants of Table II.
// Model: rational.fk2
`default_nettype none
module rational_fk2 #(
    parameter W = 16,        // bits of a coordinate and of a length, 15 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); F changes no logic
    parameter S = 24,        // fraction bits of a turn-spread, 10 to 30, to 40 with U above 18 (default 24)
    parameter U = 16,        // fraction bits of a unit vector, 13 to 24, at most W + 4 (default 16)
    parameter PIPE = 0,      // registers before and behind products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [S+1:0]        in_j1,
    input  wire [S+1:0]        in_j2,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire [3:0]          out_status
);
    generate
        if (W < 15 || W > 24 || F < 0 || F >= W || S < 10 || S > 30 + 10 * (U > 18) || U < 13 || U > 24 || U > W + 4
            || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            rational_fk2_needs_W_15_to_24_F_below_W_U_13_to_24_and_W_4_S_10_to_30_above_U_18_40_PIPE_0_1_MULTIPLY_18_27
                rule ();
        end
    endgenerate

    reg  [S+1:0]    j1;
    wire [2:1]      want;
    wire [S+1:0]    j2;
    wire [S+1:0]    word = want[1] ? j1 : j2;
    localparam      D = U > 18 ? 17 : 12;  // bits of an offset
    wire [4*U+2*D+5:0] chords;
    wire            overflow;
    assign          out_status = {1'b0, overflow, 2'b00};
    generate
        if (PIPE == 0) begin : g_input
            assign j2 = in_j2;
        end else begin : g_held
            reg [S+1:0] held;
            reg         hold;  // from the accepting clock until joint 1 is read
            assign      j2 = hold ? held : in_j2;
            always @(posedge clk) begin
                hold <= !rst && (want[2] || (hold && !want[1]));
                if (!hold) held <= in_j2;
            end
        end
    endgenerate
    always @(posedge clk) if (want[2]) j1 <= in_j1;
    generate
        if (U > 18) begin : g_parabolas
            spread_parabolas #(.S(S), .U(U), .PIPE(PIPE)) codec (.clk(clk), .in_j(word), .out_chords(chords));
        end else begin : g_chords
            spread_chords #(.S(S), .U(U)) codec (.clk(clk), .in_j(word), .out_chords(chords));
        end
    endgenerate
    /* verilator lint_off PINCONNECTEMPTY */
    kernel_chain #(.JOINTS(2), .W(W), .U(U), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid),
        .in_ready(in_ready), .out_want(want), .in_chords(chords), .out_valid(out_valid), .out_ready(out_ready),
        .out_x(out_x), .out_y(out_y), .out_z(), .out_overflow(overflow));
    /* verilator lint_on PINCONNECTEMPTY */
endmodule
`default_nettype wire
