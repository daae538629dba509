// SPDX-License-Identifier: Apache-2.0
// The third multiplier of kernel_solve and its operands: cosine, length and reciprocal, one after the other.
//   out_product = left * right, truncated to 24 fraction bits of its 44 (1.0 of left is 2^20) on its way into left
// Right words are aligned so that every product that becomes a left word is truncated at the same bit; the reciprocal,
// which becomes a right word, at another. So there is no multiplexer behind the product.
// in_left: left <- 0 product, 1 in_n, 2 in_w, 3 in_sum, 4 in_w_q, 8 hold; in_right: right <- 0 cfg_r, 1 cfg_l2, 2 left,
//   3 in_slope, 4 in_slope_q, 5 product, 6 (YAW) 2^21, 2^25 with in_big, 8 hold. in_keep_left, in_keep_right: hold.
// in_c2: the product is the cosine; out_outside: it does not fit [-1, 1), and left <- +-1.0 instead.
// Models: rational._elbow, rational._direction
`default_nettype none
module kernel_solve_scale #(
    parameter YAW = 0  // 1: three joints, whose reciprocal reaches 4 and which want a root of q; 0: two joints
) (
    input  wire               clk,
    input  wire [15:0]        cfg_l2,
    input  wire [25:0]        cfg_r,
    input  wire [3:0]         in_left,
    input  wire [3:0]         in_right,
    input  wire               in_keep_left,
    input  wire               in_keep_right,
    input  wire               in_c2,
    input  wire               in_beyond,    // in_n was not the gap
    input  wire               in_negative,  // the gap is
    input  wire signed [26:0] in_n,
    input  wire [18:0]        in_w,         // of the root, u1.18
    input  wire [19:0]        in_slope,     // u0.20
    input  wire [20:0]        in_w_q,       // of the reciprocal, u2.19
    input  wire [21+YAW:0]    in_slope_q,   // u4.18, u5.18 with YAW
    input  wire [22:0]        in_sum,       // s3.20
    input  wire               in_big,       // the root is that of q / 2^32, else of q / 2^24
    output reg  signed [26:0] out_left,
    output wire [53:0]        out_product,
    output wire               out_outside
);
    reg  signed [26:0] right;
    wire signed [53:0] product = out_left * right;
    assign out_product = product;
    assign out_outside = in_beyond || product[52:44] != {9{product[53]}};

    always @(posedge clk) begin
        if (!in_left[3] && !in_keep_left)
            case (in_left[2:0])
                3'd0: out_left <= product[50:24];
                3'd1: out_left <= in_n;
                3'd2: out_left <= {2'd0, in_w, 6'd0};
                3'd3: out_left <= {{4{in_sum[22]}}, in_sum};
                default: out_left <= {1'd0, in_w_q, 5'd0};
            endcase
        if (in_c2 && out_outside)
            out_left <= {{6{in_negative}}, 1'b1, 20'd0};
        if (!in_right[3] && !in_keep_right)
            case (in_right[2:0])
                3'd0: right <= {1'b0, cfg_r};
                3'd1: right <= {2'd0, cfg_l2, 9'd0};
                3'd2: right <= out_left;
                3'd3: right <= {5'd0, in_slope, 2'd0};
                3'd4: right <= {{(2-YAW){1'b0}}, in_slope_q, 3'd0};
                3'd5: right <= product[47:21];
                default: right <= YAW != 0 ? {1'b0, in_big, 3'd0, !in_big, 21'd0} : product[47:21];
            endcase
    end
endmodule
`default_nettype wire
