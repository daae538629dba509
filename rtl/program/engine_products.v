// SPDX-License-Identifier: Apache-2.0
// The two products of engine_datapath, with registers.
//   out_ab = in_a in_b, out_cd = in_c in_d, one clock later with PIPE; the second clock of PIPE 2 lies behind them
// Formats: factors s2.25, products s4.50. Exact. Latency 0 or 1. Model: product_engine.dot
`default_nettype none
module engine_products #(
    parameter PIPE = 0  // 0 to 2 (default 0); 1: registers behind products, 2: behind products of 27 x 17 bits too
) (
    input  wire               clk,
    input  wire signed [26:0] in_a,
    input  wire signed [26:0] in_b,
    input  wire signed [26:0] in_c,
    input  wire signed [26:0] in_d,
    output wire signed [53:0] out_ab,
    output wire signed [53:0] out_cd
);
    generate
        case (PIPE)
            0: begin : g_product
                assign out_ab = in_a * in_b;
                assign out_cd = in_c * in_d;
            end
            1: begin : g_registered
                reg signed [53:0] p1, p2;
                assign {out_ab, out_cd} = {p1, p2};
                always @(posedge clk) begin
                    p1 <= in_a * in_b;
                    p2 <= in_c * in_d;
                end
            end
            default: begin : g_partial
                reg signed [44:0] low1, low2;
                reg signed [36:0] high1, high2;
                wire       [36:0] top1 = high1 + {{9{low1[44]}}, low1[44:17]};
                wire       [36:0] top2 = high2 + {{9{low2[44]}}, low2[44:17]};
                assign out_ab = {top1, low1[16:0]};
                assign out_cd = {top2, low2[16:0]};
                always @(posedge clk) begin
                    low1  <= in_a * $signed({1'b0, in_b[16:0]});
                    high1 <= in_a * $signed(in_b[26:17]);
                    low2  <= in_c * $signed({1'b0, in_d[16:0]});
                    high2 <= in_c * $signed(in_d[26:17]);
                end
            end
        endcase
    endgenerate
    wire unused = &{1'b0, clk};
endmodule
`default_nettype wire
