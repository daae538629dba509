// SPDX-License-Identifier: Apache-2.0
// A product of engine_gd_n_products with PIPE: its factors, then its four parts of 17 and 10 bits, in registers.
//   out_ab = in_a in_b, two clocks later
// Formats: factors s2.25, product s4.50. Exact. Latency 2. Model: iterative.space.gd
`default_nettype none
module engine_gd_n_product (
    input  wire        clk,
    input  wire [26:0] in_a,
    input  wire [26:0] in_b,
    output wire [53:0] out_ab
);
    reg  [26:0]        a, b;
    reg  signed [26:0] first, second;  // upper bits of one factor, lower bits of the other
    reg  [33:0]        low;
    reg  [19:0]        high;
    wire signed [27:0] mixed = first + second;
    assign             out_ab = {high, low} + {{9{mixed[27]}}, mixed, 17'd0};
    always @(posedge clk) begin
        {a, b} <= {in_a, in_b};
        low    <= a[16:0] * b[16:0];
        first  <= $signed(a[26:17]) * $signed({1'b0, b[16:0]});
        second <= $signed({1'b0, a[16:0]}) * $signed(b[26:17]);
        high   <= $signed(a[26:17]) * $signed(b[26:17]);
    end
endmodule
`default_nettype wire
