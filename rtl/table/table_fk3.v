// SPDX-License-Identifier: Apache-2.0
// Forward kinematics of three joints, the third turning the plane of the first two about the upright axis.
//   rho = L1 cos j1 + L2 cos(j1 + j2), z = L1 sin j1 + L2 sin(j1 + j2); x = rho cos j3, y = rho sin j3
// rho keeps its sign: an arm that leans back ends on the other side of the yaw axis.
// Formats: in_j1..3 angle of A bits; cfg_l1, cfg_l2 uQ(W-F).F; out_x..z sQ(W-F).F, rounded to nearest, saturated.
// Error at W = 16, lengths in LSB: z 0.57 + 1.06 (L1 + L2) / 2^16 LSB, x and y 0.63 + twice that: 1.16 at 2^14.
// Latency 7, II 6; at PIPE = 1 latency 10.
// Status: overflow (a coordinate was saturated).
// Source: angles of joints in a plane add, so a link needs one sine and one cosine. Model: table.fk3
`default_nettype none
module table_fk3 #(
    parameter W = 16,        // bits of a coordinate and of a length, 15 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,        // bits of a joint word, 10 to 24, W / 2 or more (default 18); a full turn is 2^A
    parameter PIPE = 0,      // registers behind table and products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire [W-1:0]        cfg_l2,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [A-1:0]        in_j1,
    input  wire [A-1:0]        in_j2,
    input  wire [A-1:0]        in_j3,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 15 || W > 24 || F < 0 || F >= W || A < 10 || 2 * A < W || A > 24 || PIPE < 0 || PIPE > 1
            || MULTIPLY < 18 || MULTIPLY > 27 || MULTIPLY % 9 != 0) begin : g_illegal
            table_fk3_needs_W_15_to_24_F_below_W_A_10_to_24_and_half_W_PIPE_0_or_1_and_MULTIPLY_18_or_27 rule ();
        end
    endgenerate

    localparam K = W + 1;  // fraction bits of a root
    localparam C = W > 20 ? (W - 1) / 2 : (W + 5) / 2, T = A < C + 1 ? A - 1 : C;  // address bits of the sine table

    reg  [A-1:0]      j1, j12, j3;
    wire [3:1]        want;
    wire              read, cosine, overflow;
    wire [2*K-T+19+15*(K>21):0] chord;
    wire [A-1:0]      word = want[1] ? j1 : want[2] ? j12 : want[3] ? j3 : in_j1;
    assign            out_status = {1'b0, overflow, 2'b00};
    always @(posedge clk)
        if (in_valid && in_ready) begin
            j1  <= in_j1;
            j12 <= in_j1 + in_j2;
            j3  <= in_j3;
        end
    angle_chord #(.A(A), .K(K), .T(T)) codec (.clk(clk), .in_read(read), .in_keep(1'b0), .in_cos(cosine), .in_j(word),
        .out_chord(chord));
    kernel_links #(.JOINTS(3), .W(W), .K(K), .T(T), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (.clk(clk), .rst(rst),
        .cfg_l1(cfg_l1), .cfg_l2(cfg_l2), .in_valid(in_valid), .in_ready(in_ready), .out_read(read), .out_cos(cosine),
        .out_want(want), .in_chord(chord),
        .out_valid(out_valid), .out_ready(out_ready), .out_x(out_x), .out_y(out_y), .out_z(out_z),
        .out_overflow(overflow));
endmodule
`default_nettype wire
