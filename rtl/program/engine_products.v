// SPDX-License-Identifier: Apache-2.0
// The two products of engine_datapath, with registers.
//   out_ab = in_a in_b, out_cd = in_c in_d, one clock later with PIPE; the second clock of PIPE 2 lies behind them.
//   With PIPE 2 in_invert, which comes in the clock of out_cd, inverts every bit of it.
// PIPE 2 cuts each factor into 10 upper bits and 17 lower ones. Each of the four partial products has a register.
// Formats: factors s2.25, products s4.50. Exact. Latency 0 or 1. Model: product_engine.dot
`default_nettype none
module engine_products #(
    parameter PIPE = 0  // 0 to 2 (default 0); 1: registers behind products, 2: behind products of 18 x 18 bits too
) (
    input  wire               clk,
    input  wire signed [26:0] in_a,
    input  wire signed [26:0] in_b,
    input  wire signed [26:0] in_c,
    input  wire signed [26:0] in_d,
    input  wire               in_invert,
    output wire signed [53:0] out_ab,
    output wire signed [53:0] out_cd
);
    genvar i;
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
            default: begin : g_parts
                wire [107:0] both;
                assign {out_cd, out_ab} = both;
                for (i = 0; i < 2; i = i + 1) begin : g_each
                    wire signed [26:0] x = i == 0 ? in_a : in_c, y = i == 0 ? in_b : in_d;
                    reg  signed [19:0] high;   // of the ten upper bits of both
                    reg  signed [26:0] left;   // of the upper bits of x and the 17 lower ones of y
                    reg  signed [26:0] right;  // of the lower bits of x and the upper ones of y
                    reg         [33:0] low;    // of the lower bits of both
                    wire        [36:0] whole = {high, low[33:17]}, l = {{10{left[26]}}, left};
                    wire        [36:0] r = {{10{right[26]}}, right};
                    // Three words are added by one adder: `odd` is their sum without carries, `two` the carries.
                    // Both are inverted before it, so that the adder of engine_datapath has no gate in front
                    wire               invert = i == 1 && in_invert;
                    wire        [36:0] odd = whole ^ l ^ r ^ {37{invert}};
                    wire        [35:0] two = (whole[35:0] & l[35:0] | (whole[35:0] | l[35:0]) & r[35:0]) ^ {36{invert}};
                    /* verilator lint_off UNUSEDSIGNAL */
                    wire        [37:0] top = {odd, invert} + {two, {2{invert}}};  // ~(s + t) is ~s + ~t + 1, a carry
                    /* verilator lint_on UNUSEDSIGNAL */
                    assign             both[54*i +: 54] = {top[37:1], low[16:0] ^ {17{invert}}};
                    always @(posedge clk) begin
                        high  <= $signed(x[26:17]) * $signed(y[26:17]);
                        left  <= $signed(x[26:17]) * $signed({1'b0, y[16:0]});
                        right <= $signed({1'b0, x[16:0]}) * $signed(y[26:17]);
                        low   <= x[16:0] * y[16:0];
                    end
                end
            end
        endcase
    endgenerate
    wire unused = &{1'b0, clk, in_invert};
endmodule
`default_nettype wire
