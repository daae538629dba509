// One digit keeps 0 <= rem <= 2 root and adds exactly what the square grows by:
//   4 rem + pair = out_rem + ((2 root + q)^2 - 4 root^2), q the new digit, the bracket being q (4 root + 1).
// So radicand = root^2 + rem follows for any number of digits: by induction, and by the identity asserted last.
// rtl: isqrt_digits
// proof digits_1_to_32 mode=prove depth=1 N=32
module isqrt_digits_props #(parameter N = 16) (input clk);
    genvar k;
    for (k = 1; k <= N; k = k + 1) begin : g_row
        (* anyseq *) reg [k:0] rem;
        (* anyseq *) reg [k-1:0] root;
        (* anyseq *) reg [1:0] pair;
        wire [k+1:0] out_rem;
        wire [k:0] out_root;
        wire q = out_root[0];
        isqrt_digits #(.K(k), .R(1)) dut (.in_rem(rem), .in_root(root), .in_pairs(pair), .out_rem(out_rem), .out_root(out_root));
        wire [k+3:0] grows = q ? {root, 2'b01} : 0;
        always @* begin
            assume (rem <= {root, 1'b0});
            assert (out_root[k:1] == root);
            assert ({1'b0, rem, pair} == {2'b0, out_rem} + grows);
            assert (out_rem <= {out_root, 1'b0});
        end
    end
    (* anyseq *) reg [7:0] r;
    (* anyseq *) reg q;
    wire [17:0] square = r * r;
    wire [17:0] grown = {r, q} * {r, q};
    always @* assert (grown == {square, 2'b00} + (q ? {r, 2'b01} : 0));
endmodule
