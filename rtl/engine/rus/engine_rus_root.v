// SPDX-License-Identifier: Apache-2.0
// Root and divisor of engine_rus_path: S^2 = q - G^2, or q = e^2 + f^2 out of reach; q; and the numerators. One
// normaliser serves all four: out_word is register n times 2^(2 shift - 19). Its spare bytes are counted when it is
// loaded (find), its spare pairs of bits one clock later (fine). Numerators use the shift of their divisor (kept).
// Formats: in_q u44, in_num, in_square s46, 8 fraction bits; out_w, out_slope: factors of a root or a reciprocal;
// in_product: that of a root, before it is shifted back; out_root u18.4.
// Error: root and reciprocal within 2^-18, and truncation. Model: engine_rus.leg
`default_nettype none
module engine_rus_root (
    input  wire               clk,
    input  wire [9:0]         in_op,
    input  wire [43:0]        in_q,
    input  wire signed [45:0] in_num,
    input  wire signed [45:0] in_square,
    input  wire               in_wide,
    input  wire [21:0]        in_product,
    output wire [26:0]        out_word,
    output reg  [21:0]        out_w,
    output wire [19:0]        out_slope,
    output reg                out_beyond,
    output reg                out_none,
    output reg  [21:0]        out_root
);
    wire num, divisor, to_s, copy, root, fine, find, gate, disc, to_q;
    assign {num, divisor, to_s, copy, root, fine, find, gate, disc, to_q} = in_op;

    reg  [43:0] q, q2, open_q;
    reg  [45:0] square_of_s, open_s, n;
    wire        beyond = square_of_s[45] || in_wide;
    wire [45:0] either = open_s | {2'b0, open_q};  // one of them is 0

    reg  [3:0]  shift, kept, shift_s;
    reg  [32:0] coarse;
    reg  [26:0] word;
    always @* begin
        case (shift[3:2])
            2'd0: coarse = n[45:13];
            2'd1: coarse = n[37:5];
            default: coarse = {n[29:0], 3'd0};
        endcase
        case (shift[1:0])
            2'd0: word = coarse[32:6];
            2'd1: word = coarse[30:4];
            2'd2: word = coarse[28:2];
            default: word = coarse[26:0];
        endcase
    end
    wire byte2 = either[43:36] != 0, byte1 = either[35:28] != 0;
    wire pair3 = coarse[30:29] != 0, pair2 = coarse[28:27] != 0, pair1 = coarse[26:25] != 0;

    // Tangents of a root or a reciprocal
    kernel_vector_slopes slopes (.clk(clk), .in_read(root || divisor), .in_range({divisor, 1'b0}),
        .in_segment(word[24:16]), .out_slope(out_slope));
    wire [21:0] bytes = shift_s[3] ? in_product >> 8 : shift_s[2] ? in_product >> 4 : in_product;

    assign out_word = word;
    always @(posedge clk) begin
        if (to_q)
            q <= in_q;
        if (disc) begin
            square_of_s <= {2'b0, q} - in_square;
            q2          <= q;
        end
        open_s <= gate && !beyond ? square_of_s : 46'd0;
        open_q <= gate && beyond || copy ? q2 : 44'd0;
        if (gate)
            out_beyond <= beyond;
        if (find || num)
            n <= num ? in_num : either;
        if (find)
            shift[3:2] <= {!byte2 && !byte1, !byte2 && byte1};
        if (fine)
            shift[1:0] <= {!pair3 && !pair2, !pair3 && (pair2 || !pair1)};
        if (num)
            shift <= kept;
        if (divisor) begin
            kept     <= shift;
            out_none <= word[24:23] == 0;
        end
        if (root)
            shift_s <= shift;
        if (root || divisor)
            out_w <= divisor ? {1'b0, word[24:16], ~word[15], ~word[14:4]} : {word[24:15], ~word[15], word[14:4]};
        if (to_s)
            out_root <= bytes >> shift_s[1:0];
    end
endmodule
`default_nettype wire
