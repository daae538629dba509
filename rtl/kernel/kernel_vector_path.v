// SPDX-License-Identifier: Apache-2.0
// Datapath of kernel_vector_solve, whose table says what happens when: in_op is one line of it, column by column.
// Ports, formats and models as in kernel_vector_solve; in_start: in_x, in_y, in_z, in_elbow are taken at the end of the
// clock. 1.0 is 2^25 in left, 2^26 in right but for the words in SLOPE, 2^24, and 2^49 in the product of them.
`default_nettype none
module kernel_vector_path #(
    parameter JOINTS = 2,  // 2: in the plane, in_z is not used; 3: in space. 2, the smaller one
    parameter U = 16       // fraction bits that words are rounded to, 8 to 17, or 18: they are not; 16
) (
    input  wire               clk,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire signed [33:0] cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [3:0]         cfg_e,
    input  wire               in_start,
    input  wire [25:0]        in_op,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire signed [15:0] in_z,
    input  wire               in_elbow,
    output wire [2:0]         out_cos,
    output wire [2:0]         out_sin,
    output wire [23:0]        out_word,
    output wire               out_flat,
    output wire               out_negative,
    output wire               out_none,
    output wire [3:0]         out_status
);
    localparam YAW = JOINTS == 3;
    wire [1:0] left_from;
    wire [2:0] right_from;
    wire       to_rho, power, move, turn, to_k2, to_k1, add_l1, add_half;
    wire       sin3, cos3, sin1, cos1, halve, sin2, cos2, inverse, read, root, gap, pairs, bytes;
    assign {to_rho, power, move, turn, to_k2, to_k1, left_from, right_from, add_l1, add_half,
            sin3, cos3, sin1, cos1, halve, sin2, cos2, inverse, read, root, gap, pairs, bytes} = in_op;

    // At first minus_q makes q the gap; it rounds rho; where bytes and pairs are found it is 0
    reg                elbow, clamped, zero, beyond, short;
    reg         [33:0] minus_q;
    reg  [3:0]         s;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [53:0] product;
    /* verilator lint_on UNUSEDSIGNAL */
    wire        [21:0] result;
    wire [26:0]        word;
    wire [36:0]        total;
    wire [1:0]         coarse, fine;
    wire               over, none;
    wire               first = YAW ? to_rho : in_start;  // the next clock is that of the gap
    kernel_vector_turn #(.JOINTS(JOINTS)) operands (
        .clk(clk), .in_start(in_start), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_up(to_rho), .in_rho(to_rho),
        .in_total(total[33:13]), .in_k1(to_k1), .in_k2(to_k2), .in_turn(turn), .in_move(move), .in_power(power),
        .in_clamp(clamped), .in_odd(s[0]), .in_sum(result), .in_product(product[52:31]), .in_addend(minus_q),
        .out_sum(total));
    kernel_vector_shift shift (.in_sum(total), .in_q(total[34:3]), .in_s(s), .out_word(word), .out_over(over),
        .out_coarse(coarse), .out_fine(fine), .out_zero(none));

    // The third multiplier. An addend is a register of its own, cleared where there is none.
    reg  signed [26:0] left, right;
    reg  [15:0]        l1;
    reg                half;
    localparam [21:0]  ROUND = U > 17 ? 22'd0 : 22'd1 << (U > 17 ? 0 : 17 - U);
    assign             product = left * right;
    assign             result = product[52:31] + ({2'd0, l1, 4'd0} | (half ? ROUND : 22'd0));
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
    kernel_vector_slopes slopes (.clk(clk), .in_read(root || read), .in_range(read ? {1'b1, clamped} : {1'b0, low}),
        .in_segment(read ? factor[20:12] : e[20:12]), .out_slope(slope));

    reg    zero3;
    assign out_cos = {cos3, cos2, cos1};
    assign out_sin = {sin3, sin2, sin1};
    assign out_none = zero;
    assign out_word = {result, product[30:29]};
    assign out_flat = outside;
    assign out_negative = short;
    assign out_status = {2'd0, YAW ? zero3 : zero, clamped};
    always @(posedge clk) begin
        minus_q <= {24'd0, sin3, 9'd0};
        if (first)
            minus_q <= cfg_q;
        if (in_start)
            elbow <= in_elbow;
        if (to_rho)
            zero3 <= zero;
        if (first)
            s <= cfg_e;
        if (bytes)
            s[3:2] <= coarse;
        if (cos2 || YAW && in_start)
            clamped <= YAW && in_start || outside;
        if (pairs) begin
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
    end
endmodule
`default_nettype wire
