// SPDX-License-Identifier: Apache-2.0
// Rotates a vector by a binary angle, full circle, gain compensated: a rotation a clock.
//   out_x + j out_y = (in_x + j in_y) * exp(2 pi j in_angle / 2^A), rounded to nearest, saturated
// Formats: in_angle uA, 2^A to the turn; in_x, in_y, out_x, out_y sW, any fraction.
// Error: at most 1.55 LSB each at every W and A (derivation on the family's page; 1.1 found at W = 16).
// Latency 20 at W = 16, II 1; the pipeline moves as a whole.
// Status: overflow. Model: cordic.rotate
`default_nettype none
module cordic_rotate_pipe #(
    parameter W = 16,  // bits of a coordinate, 8 to 16; 16 is the library's word
    parameter A = 16   // bits of an angle, 5 to W + 3, 2^A to the turn; 16, as sharp as the coordinates
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire        [A-1:0] in_angle,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire        [3:0]   out_status
);
    localparam C = (W + 1) / 2;
    localparam T = (W - C + 1) / 2 + 1;
    localparam STAGES = 4 + C + T + (T + 1) / 2;
    generate
        if (W < 8 || W > 16 || A < 5 || A > W + 3) begin : g_illegal
            cordic_rotate_pipe_needs_W_from_8_to_16_and_A_from_5_to_W_plus_3 rule ();
        end
    endgenerate
    reg [STAGES-1:0] valid;
    wire             move = out_ready || !out_valid;
    always @(posedge clk)
        if (rst) valid <= {STAGES{1'b0}};
        else if (move) valid <= {valid[STAGES-2:0], in_valid};
    assign in_ready = move;
    assign out_valid = valid[STAGES-1];
    cordic_rotate_array #(.W(W), .A(A), .CLOCKED(1)) array (.clk(clk), .in_enable(move),
        .in_angle(in_angle), .in_x(in_x), .in_y(in_y), .out_x(out_x), .out_y(out_y), .out_status(out_status));
endmodule
`default_nettype wire
