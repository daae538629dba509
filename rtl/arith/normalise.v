// SPDX-License-Identifier: Apache-2.0
// This part normalises several 16-bit words together: a count of their common redundant sign bits, and a shifter.
//   out_k = number of bits below the sign bit that repeat it in every word; out_x = in_x << in_k
// Formats: in_used is the OR over the words w of w[14:0] ^ w[15:1]; out_k is u4.0, 15 where every word is 0 or -1.
// in_x has B bits and any fraction; a word that was counted keeps its sign. Combinational; exact.
// The two halves are independent: the count may be registered, and one shifter may serve several words in turn.
// Model: rational.ik1
`default_nettype none
module normalise #(
    parameter B = 16  // bits of the shifted word, 16 or more (default 16)
) (
    input  wire [14:0]  in_used,
    output reg  [3:0]   out_k,
    input  wire [3:0]   in_k,
    input  wire [B-1:0] in_x,
    output wire [B-1:0] out_x
);
    integer i;
    always @* begin
        out_k = 4'd15;
        for (i = 0; i < 15; i = i + 1)
            if (in_used[i])
                out_k = 4'd14 - i[3:0];
    end

    reg [B-1:0] fine, scaled;
    assign out_x = scaled;
    always @* begin
        case (in_k[1:0])
            2'd0: fine = in_x;
            2'd1: fine = in_x << 1;
            2'd2: fine = in_x << 2;
            default: fine = in_x << 3;
        endcase
        case (in_k[3:2])
            2'd0: scaled = fine;
            2'd1: scaled = fine << 4;
            2'd2: scaled = fine << 8;
            default: scaled = fine << 12;
        endcase
    end
endmodule
`default_nettype wire
