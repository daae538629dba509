// n * 2^F = q d + r, 0 <= r < d, by multiplication, nothing assumed; d = 0 as documented.
// rtl: divide_comb divide_digits
// proof 8by8 mode=prove depth=1 WN=8 WD=8 F=0
// proof 6by4F2 mode=prove depth=1 WN=6 WD=4 F=2
module divide_comb_props #(parameter WN = 8, WD = 8, F = 0) (input clk, input [WN-1:0] in_n, input [WD-1:0] in_d);
    wire [WN+F-1:0] q;
    wire [WD-1:0] r;
    wire zero;
    divide_comb #(.WN(WN), .WD(WD), .F(F)) dut (
        .in_n(in_n), .in_d(in_d), .out_q(q), .out_r(r), .out_div_by_zero(zero));
    wire [WN+WD+F-1:0] n = in_n << F;
    wire [WN+WD+F-1:0] product = q * in_d;
    always @* begin
        assert (zero == (in_d == 0));
        if (zero) assert (&q && r == n[WD-1:0]);
        else assert (r < in_d && product <= n && n - product == r);
    end
endmodule
