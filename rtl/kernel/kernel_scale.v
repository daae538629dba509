// SPDX-License-Identifier: Apache-2.0
// A length times cosine, then sine, each given as a product: x = +-L1 * w * slope / 2^34 of the cosine, y of the sine.
// out_cos and out_sin name the value. in_w and in_negative belong to that clock, in_slope to the next one. L1 * w is
// formed while the table of slopes is read, so no path has two products after the memory. The kernel knows no joint
// word.
// Formats: cfg_l1 uW, in_w u19, in_slope u17; out_x, out_y sW, rounded to nearest (ties upward), saturated. L1 * w is
// truncated 4 bits below the LSB of the coordinate. A constant 1 below it centres that error and makes the one's
// complement an exact negation: -(2 n + 1) = 2 ~n + 1.
// Error of a coordinate: 1/2 + 1/16 LSB, and that of the value times the length (bounds.rational.fk1).
// Latency 2 + 3 PIPE, II 2: out_cos comes in the accepting clock, out_sin in the next; y stays at the memory until it
// is taken, with PIPE = 1 behind the second product, and all behind it wait.
// Overflow: a coordinate was saturated. Source: rational trigonometry paper, eqs. 51 and 52. Model: rational.fk1
`default_nettype none
module kernel_scale #(
    parameter W = 16,        // bits of the length and of a coordinate, 4 to 18 (default 16): a multiplier block's word
    parameter PIPE = 0,      // 0 or 1 (default 0: fewest clocks); 1: registers behind products and table
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [W-1:0]        cfg_l1,
    input  wire                in_valid,
    output wire                in_ready,
    output wire                out_cos,  // the codec reads the cosine of the word at the input
    output wire                out_sin,  // the codec reads the sine of that word
    input  wire                in_negative,
    input  wire [18:0]         in_w,
    input  wire [16:0]         in_slope,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire                out_overflow
);
    localparam LAST = 3 * PIPE;
    wire         move = PIPE == 0 || !out_valid || out_ready;
    reg  [LAST:0]   age;  // bit i: the cosine that was read i + 1 clocks ago is on its way; of bit 0 the sine is read
    wire [LAST+1:0] older = {age, out_cos};
    assign       in_ready = !age[0] && (!out_valid || out_ready);
    assign       out_cos = in_valid && in_ready;
    assign       out_sin = age[0] && move;

    wire [13:0]  below_n;
    wire [W+4:0] magnitude;
    reg  [W+5:0] n;
    wire         negative;

    wire [19:0]  below;
    wire         half;
    wire [2:0]   above;  // copies of the sign: |root| < 1 + 2^-15
    wire [W:0]   floor;
    generate
        if (PIPE == 0) begin : g_now
            assign negative = in_negative;
            assign {magnitude, below_n} = cfg_l1 * in_w;
            assign {above, floor, half, below} = $signed({n, 1'b1}) * $signed({1'b0, in_slope});
        end else begin : g_registered
            reg [18:0] w;
            reg [1:0]  below_zero;
            reg [33:0] slopes;
            wire [1:0] zeros;
            wire       unused_zeros = &{1'b0, zeros};
            assign     negative = below_zero[1];
            product_parts #(.A(W+1), .B(20), .MULTIPLY(MULTIPLY)) first (.clk(clk), .in_move(move),
                .in_a({1'b0, cfg_l1}), .in_b({1'b0, w}), .out_p({zeros, magnitude, below_n}));
            product_parts #(.A(W+7), .B(18), .MULTIPLY(MULTIPLY)) second (.clk(clk), .in_move(move),
                .in_a({n, 1'b1}), .in_b({1'b0, slopes[33:17]}), .out_p({above, floor, half, below}));
            always @(posedge clk)
                if (move) begin
                    w          <= in_w;
                    below_zero <= {below_zero[0], in_negative};
                    slopes     <= {slopes[16:0], in_slope};
                end
        end
    endgenerate
    wire [W:0]   nearest = floor + {{W{1'b0}}, half};
    wire         over = nearest[W] ^ nearest[W-1];
    wire         unused = &{1'b0, below_n, below, above, older[LAST+1]};

    reg over_x;
    assign out_y = over ? {nearest[W], {(W-1){!nearest[W]}}} : nearest[W-1:0];
    assign out_overflow = over_x || over;
    always @(posedge clk) begin
        if (PIPE == 0 ? out_cos || out_sin : move)
            n <= {1'b0, magnitude} ^ {(W+6){negative}};
        if (age[LAST] && move) begin
            out_x  <= out_y;
            over_x <= over;
        end
        if (move)
            age <= older[LAST:0];
        out_valid <= age[LAST] || (out_valid && !out_ready);
        if (rst) begin
            age       <= {(LAST+1){1'b0}};
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
