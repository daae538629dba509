// root^2 <= d * 4^F < (root + 1)^2 and the remainder is exact, by multiplication, nothing assumed.
// rtl: isqrt_comb isqrt_digits
// proof W16 mode=prove depth=1 W=16 F=0
// proof W15F1 mode=prove depth=1 W=15 F=1
module isqrt_comb_props #(parameter W = 16, F = 0) (input clk, input [W-1:0] in_d);
    localparam N = (W + 1) / 2 + F;
    wire [N-1:0] root;
    wire [N:0] rem;
    isqrt_comb #(.W(W), .F(F)) dut (.in_d(in_d), .out_root(root), .out_rem(rem));
    wire [2*N+1:0] d = in_d << 2 * F;
    wire [2*N+1:0] square = root * root;
    always @* begin
        assert (square <= d);
        assert (d - square == rem);
        assert (rem <= {root, 1'b0});  // the same as d < (root + 1)^2
    end
endmodule
