// SPDX-License-Identifier: Apache-2.0
// Normalisation and reciprocal root for product_engine.
//   in_first, in_more: the magnitude in_fold alone, or ORed with those before; in_wrist: only its bits from WRIST on;
//   in_clear: none
//   out_power = 2^s brings the leading one of them to bit 25; out_four = 2^(2 j) and out_twice = 2^(j + 1), with
//   j = (s - 1) / 2 toward 0, bring a word to [1/4, 1) and its root back; without any bit all are 0, out_empty 1
//   in_read: 1 / sqrt(in_q) = out_w out_slope / 2^36 one clock later, held; in_q u2.18 from 1/4 to 2
// Error of a root: 0.8 * 2^-16, relative. Latency of the powers: two clocks after in_fold.
// Models: product_engine.power_of, product_engine.reciprocal
`default_nettype none
module engine_roots #(
    parameter WRIST = 12  // lowest bit that counts with in_wrist, 0 to 25 (default 12, 8 units of 2^-16)
) (
    input  wire        clk,
    input  wire        in_first,
    input  wire        in_more,
    input  wire        in_wrist,
    input  wire        in_none,
    input  wire [25:0] in_fold,
    input  wire        in_read,
    input  wire        in_clear,
    input  wire [19:0] in_q,
    output reg  [20:0] out_w,
    output wire [19:0] out_slope,
    output wire [25:0] out_power,
    output reg  [25:0] out_four,
    output reg  [13:0] out_twice,
    output wire        out_empty
);
    // Magnitudes are bit-reversed, so that the leading one is the lowest, which x & -x isolates
    reg  [25:0] seen, turned;
    integer     i;
    always @*
        for (i = 0; i < 26; i = i + 1)
            turned[25-i] = in_fold[i] && (i >= WRIST || !in_wrist);
    always @(posedge clk) begin
        if (in_first || in_more || in_clear)
            seen <= in_none || in_clear ? 26'd0 : in_first ? turned : seen | turned;
    end
    assign out_power = seen & (~seen + 26'd1);
    assign out_empty = out_power == 26'd0;
    always @* begin
        out_four = 26'd0;
        out_twice = 14'd0;
        for (i = 0; i < 13; i = i + 1) begin
            out_four[2*i] = out_power[2*i+1] || i == 0 && out_power[0] || i < 12 && out_power[(2*i+2)%26];
            out_twice[i+1] = out_four[2*i];
        end
    end

    wire [20:0] w;
    reciprocal_root reciprocal (.clk(clk), .in_read(in_read), .in_q(in_q), .out_w(w), .out_slope(out_slope));
    always @(posedge clk)
        if (in_read)
            out_w <= w;
endmodule
`default_nettype wire
