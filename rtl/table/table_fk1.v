// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of one joint: x = L1 cos j1, y = L1 sin j1.
// Formats: in_j1 angle of A bits; cfg_l1 uQ(W-F).F; out_x, out_y sQ(W-F).F, rounded to nearest and saturated.
// Error of a coordinate at W = 16: 0.50 + 1.63 L1 / 2^16 LSB, L1 in LSB: 0.91 at 2^14.
// Latency 3, II 2: one table and two products serve x, then y. At PIPE = 1 latency 6.
// Status: overflow (a coordinate was saturated).
// Source: the definition; sine table with linear interpolation. Model: table.fk1
`default_nettype none
module table_fk1 #(
    parameter W = 16,        // bits of a coordinate and of the length, 15 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,        // bits of a joint word, 10 to 24, W / 2 or more (default 18); a full turn is 2^A
    parameter PIPE = 0,      // registers behind table and products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [A-1:0]        in_j1,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire [3:0]          out_status
);
    generate
        if (W < 15 || W > 24 || F < 0 || F >= W || A < 10 || 2 * A < W || A > 24 || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            table_fk1_needs_W_15_to_24_F_below_W_A_10_to_24_and_half_W_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    localparam K = W + 1;  // fraction bits of a root
    localparam C = W > 20 ? (W - 1) / 2 : (W + 3) / 2, T = A < C + 1 ? A - 1 : C;  // address bits of the sine table

    reg  [T-1:0]      upper;
    wire              read, kept, overflow;
    wire [2*K-T+19+15*(K>21):0] chord;
    assign            out_status = {1'b0, overflow, 2'b00};
    always @(posedge clk)
        if (!kept)
            upper <= in_j1[A-1:A-T];
    angle_chord #(.A(A), .K(K), .T(T)) codec (.clk(clk), .in_read(read), .in_keep(kept), .in_cos(!kept),
        .in_j({kept ? upper : in_j1[A-1:A-T], in_j1[A-T-1:0]}), .out_chord(chord));
    kernel_link #(.W(W), .K(K), .T(T), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (.clk(clk), .rst(rst),
        .cfg_l1(cfg_l1), .in_valid(in_valid), .in_ready(in_ready), .out_read(read), .out_kept(kept),
        .in_chord(chord), .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x), .out_y(out_y),
        .out_overflow(overflow));
endmodule
`default_nettype wire
