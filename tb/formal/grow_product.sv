// The product of a quotient and d as the quotient's digits arrive: (2 quotient + q) d = 2 (quotient d) + q d.
module grow_product #(parameter N = 8, WD = 8, R = 1) (
    input [N+WD-1:0] product, input [WD-1:0] d, input [R-1:0] digits, output reg [N+WD-1:0] grown
);
    integer i;
    always @* begin
        grown = product;
        for (i = R - 1; i >= 0; i = i - 1) grown = 2 * grown + (digits[i] ? d : 0);
    end
endmodule
