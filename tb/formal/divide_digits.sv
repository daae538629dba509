// One digit keeps 0 <= rem < d and takes exactly the divisor: 2 rem + bit = out_rem + (q ? d : 0), q the new digit.
// So n = quotient d + rem follows for any number of digits: by induction, and as (2 Q + q) d = 2 Q d + q d.
// d = 0 yields q = 1 and the low WD bits of 2 rem + bit.
// rtl: divide_digits
// proof 0_to_20_by_16 mode=prove depth=1 N=20 WD=16
// proof 0_to_38_by_36 mode=prove depth=1 N=38 WD=36
// proof 0_to_4_by_1 mode=prove depth=1 N=4 WD=1
// proof 0_to_8_by_6 mode=prove depth=1 N=8 WD=6
module divide_digits_props #(parameter N = 20, WD = 16) (input clk);
    genvar k;
    for (k = 0; k <= N; k = k + 1) begin : g_row
        localparam B = k < 1 ? 1 : k < WD ? k : WD, A = k + 1 < WD ? k + 1 : WD;
        (* anyseq *) reg [B-1:0] rem;
        (* anyseq *) reg [WD-1:0] d;
        (* anyseq *) reg next;
        wire [A-1:0] out_rem;
        wire q;
        divide_digits #(.K(k), .R(1), .WD(WD)) dut (.in_rem(rem), .in_d(d), .in_bits(next), .out_rem(out_rem), .out_q(q));
        wire [WD+1:0] partial = {rem, next};
        always @* begin
            if (k == 0) assume (rem == 0);
            assume (d == 0 || rem < d);
            if (d == 0) assert (q && out_rem == partial[A-1:0]);
            else assert (partial == out_rem + (q ? d : 0) && out_rem < d);
        end
    end
endmodule
