// SPDX-License-Identifier: Apache-2.0
// Datapath of kernel_vector_solve, whose table says what happens when: in_op is one line of it, column by column.
// Ports, formats and model as in kernel_vector_solve; in_start: in_x, in_y, in_elbow are taken at the end of the clock.
// Inside: k1, k2 s18.5, in which a constant 1 behind the last bit centres truncation; 1.0 is 2^25 in left, 2^26 in
// right but for the words in SLOPE, 2^24, and 2^49 in the product of them.
`default_nettype none
module kernel_vector_path #(
    parameter U = 16  // fraction bits of a unit vector's coordinates, 8 to 16: 16, what the products carry
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire signed [33:0] cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [3:0]         cfg_e,
    input  wire               in_start,
    input  wire [17:0]        in_op,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire               in_elbow,
    output reg  [U+1:0]       out_c1,
    output reg  [U+1:0]       out_n1,
    output reg  [U+1:0]       out_c2,
    output reg  [U+1:0]       out_n2,
    output wire [3:0]         out_status
);
    wire [1:0] left_from;
    wire [2:0] right_from;
    wire       turn, to_k2, to_k1, add_l1, add_half, sin1, cos1, halve, sin2, inverse, root, cos2, gap;
    assign {turn, to_k2, to_k1, left_from, right_from, add_l1, add_half,
            sin1, cos1, halve, sin2, inverse, root, cos2, gap} = in_op;

    // The two multipliers: squares, then a point seen from a turned axis. At first minus_q makes q the gap. in_q comes
    // from in front of it, which also keeps the two adders apart (Yosys merges them at a cost).
    reg                elbow, clamped, zero, beyond, short;
    reg         [21:0] k1, k2;
    reg                odd;  // constant 1 behind the last bit of k1 and k2; coordinates have none
    reg  signed [15:0] x, y;
    reg         [33:0] minus_q;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [38:0] product1 = $signed({k1, odd}) * x, product2 = $signed({k2, odd}) * y;
    wire [36:0]        sum = product1[38:2] + product2[38:2];
    wire signed [53:0] product;
    /* verilator lint_on UNUSEDSIGNAL */
    reg  [3:0]         s;
    wire [26:0]        word;
    wire [36:0]        total = sum + {minus_q, 3'd0};
    wire [1:0]         coarse, fine;
    wire               over, none;
    kernel_vector_shift shift (.in_sum(total), .in_q(sum[34:3]), .in_s(s), .out_word(word), .out_over(over),
        .out_coarse(coarse), .out_fine(fine), .out_zero(none));

    // The third multiplier. An addend is a register of its own, cleared where there is none.
    reg  signed [26:0] left, right;
    reg  [15:0]        l1;
    reg                half;
    assign             product = left * right;
    wire [21:0]        result = product[52:31] + ({2'd0, l1, 4'd0} | {21'd0, half} << 17 - U);
    wire [U+1:0]       unit = result[19:18-U];
    wire               outside = beyond || product[53:49] != {5{product[53]}};

    // v = 1 - c2^2 with 26 fraction bits; first factors of sqrt(v), 1/q', 2/sqrt(q'), 22 bits and a constant 1
    wire [25:0] v = ~product[50:25];
    wire        low = v[25:21] == 0;
    wire [20:0] e = low ? v[20:0] : v[25:5];
    wire [21:0] root_w = {e[20:11], ~e[11], e[10:0]};
    wire [21:0] inverse_w = {1'b0, word[24:16], ~word[15], clamped ? {word[15], ~word[14:5]} : ~word[14:4]};
    reg  [21:0] factor;
    reg         negative;
    wire [19:0] slope;
    kernel_vector_slopes slopes (.clk(clk), .in_read(root || sin2), .in_range(sin2 ? {1'b1, clamped} : {1'b0, low}),
        .in_segment(sin2 ? factor[20:12] : e[20:12]), .out_slope(slope));

    assign out_status = {2'd0, zero, clamped};
    always @(posedge clk) begin
        minus_q <= cfg_q;
        if (!in_start)
            minus_q <= 34'd0;
        if (in_start) begin
            x     <= in_x;
            y     <= in_y;
            elbow <= in_elbow;
        end
        if (in_start || to_k1)
            odd <= !in_start;
        if (in_start || to_k1 || turn)
            k1 <= in_start ? {{2{in_x[15]}}, in_x, 4'd0} : to_k1 ? result : ~k2;
        if (to_k1 && clamped)  // its sign and 2^15, or 2^16 where s is odd
            k1 <= {result[21], result[21] || s[0], !s[0], 19'd0};
        if (in_start || to_k2 || turn)
            k2 <= in_start ? {{2{in_y[15]}}, in_y, 4'd0} : to_k2 ? result : k1;

        if (in_start)
            s <= cfg_e;
        if (cos2) begin
            s[3:2]  <= coarse;
            clamped <= outside;
        end
        if (root) begin
            s[1:0] <= fine;
            zero   <= none;
        end
        if (halve && clamped)
            s <= s >> 1;
        if (gap) begin
            beyond <= over;
            short  <= total[36];
        end

        l1   <= cfg_l1;
        half <= add_half;
        if (!add_l1)
            l1 <= 16'd0;
        if (root || inverse) begin
            factor   <= inverse ? inverse_w : {22{elbow}} ^ root_w;
            negative <= root && elbow;
        end
        if (root && (clamped || product[51])) begin  // the root of 1 - (-1)^2 would read 1
            factor   <= 22'd0;
            negative <= 1'b0;
        end
        if (left_from != 2'd3)
            case (left_from)
                2'd2: left <= product[50:24];
                2'd1: left <= {negative, factor, 4'd8};
                default: left <= word;
            endcase
        if (!right_from[2])
            case (right_from[1:0])
                2'd0: right <= {1'b0, cfg_r};
                2'd1: right <= {1'b0, cfg_l2, 10'd0};
                2'd2: right <= {1'b0, slope, 6'd0};
                default: right <= product[49:23];
            endcase
        if (cos2 && outside)
            left <= {short, 1'b1, 25'd0};

        if (cos2)
            out_c2 <= outside ? {short, 1'b1, {U{1'b0}}} : unit;
        if (sin2)
            out_n2 <= unit;
        if (rst || cos1 && !zero)
            out_c1 <= rst ? {2'b01, {U{1'b0}}} : unit;
        if (rst || sin1 && !zero)
            out_n1 <= rst ? {(U+2){1'b0}} : unit;
    end
endmodule
`default_nettype wire
