// The square of a root as its digits arrive, without a multiplication: (2 root + q)^2 = 4 root^2 + q (4 root + 1).
module grow_square #(parameter N = 8, R = 1) (
    input [2*N-1:0] square, input [N-1:0] root, input [R-1:0] digits, output reg [2*N-1:0] grown
);
    reg [N-1:0] known;
    integer i;
    always @* begin
        grown = square;
        known = root;
        for (i = R - 1; i >= 0; i = i - 1) begin
            grown = 4 * grown + (digits[i] ? {known, 2'b01} : 0);
            known = {known, digits[i]};
        end
    end
endmodule
