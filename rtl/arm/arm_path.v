// SPDX-License-Identifier: Apache-2.0
// Datapath of arm_solve, whose cycle table controls it: in_op is one line of that table, column by column. It is that
// of kernel_vector_solve with three additions: the base height is subtracted from z and the shoulder offset from rho, a
// lateral offset b has a root of x^2 + y^2 - b^2, and rho has the sign of the side of the shoulder. Ports, formats,
// error, status and models are those of arm_solve. in_start loads in_x ... in_back at the end of its clock. 1.0 is 2^25
// in left, 2^26 in right (2^24 in words from SLOPE) and 2^49 in a product of the two.
`default_nettype none
module arm_path #(
    parameter U = 16,        // fraction bits of a rounded word, 8 to 16 (default 16)
    parameter BASE = 1,      // 1 (default): cfg_base is subtracted from z; 0: not
    parameter SHOULDER = 1,  // 1 (default): cfg_shoulder is subtracted from rho; 0: not
    parameter LATERAL = 1    // 1 (default): cfg_lateral is the offset of the arm's plane; 0: there is none
) (
    input  wire               clk,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire signed [33:0] cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [3:0]         cfg_e,
    input  wire signed [15:0] cfg_base,
    input  wire signed [13:0] cfg_shoulder,
    input  wire signed [15:0] cfg_lateral,
    input  wire signed [31:0] cfg_bb,
    input  wire               in_start,
    input  wire [28:0]        in_op,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire signed [15:0] in_z,
    input  wire               in_elbow,
    input  wire               in_back,
    output wire [2:0]         out_cos,
    output wire [2:0]         out_sin,
    output wire [23:0]        out_word,
    output wire               out_flat,
    output wire               out_negative,
    output wire               out_none,
    output wire [3:0]         out_status
);
    wire [1:0] left_from;
    wire [2:0] right_from;
    wire       take, rho, power, move, turn, to_k2, to_k1, add_l1, add_half, test, plain;
    wire       sin3, cos3, sin1, cos1, halve, sin2, cos2, inverse, read, root, gap, pairs, bytes;
    assign {take, rho, power, move, turn, to_k2, to_k1, left_from, right_from, add_l1, add_half, plain, test,
            sin3, cos3, sin1, cos1, halve, sin2, cos2, inverse, read, root, gap, pairs, bytes} = in_op;

    // z - base, saturated
    wire signed [16:0] height = {in_z[15], in_z} - (BASE ? {cfg_base[15], cfg_base} : 17'd0);
    wire               beyond_z = BASE && height[16] != height[15];
    wire        [15:0] z = beyond_z ? {height[16], {15{!height[16]}}} : height[15:0];

    // minus_q turns a sum into a gap: q - b^2 first, q - Q1 - Q2 after rho. Without b it subtracts the shoulder offset
    reg                elbow, back, clamped, zero, zero3, beyond, short, near_axis, over_z, odd_root;
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
    wire        [21:0] length = (odd_root ? product[50:29] : product[51:30]) ^ {22{back}};
    arm_operands #(.LATERAL(LATERAL), .SHOULDER(SHOULDER)) operands (
        .clk(clk), .in_start(in_start), .in_x(in_x), .in_y(in_y), .in_z(z), .in_lateral(cfg_lateral),
        .in_shoulder(cfg_shoulder), .in_rho(rho), .in_total(total[33:13]), .in_take(take), .in_near(near_axis),
        .in_length(length), .in_k1(to_k1), .in_k2(to_k2), .in_turn(turn), .in_move(move), .in_power(power),
        .in_back(back), .in_clamp(clamped), .in_odd(s[0]), .in_sum(result), .in_product(product[52:31]),
        .in_addend(minus_q), .out_sum(total));
    kernel_vector_shift shift (.in_sum(total), .in_q(total[34:3]), .in_s(s), .out_word(word), .out_over(over),
        .out_coarse(coarse), .out_fine(fine), .out_zero(none));

    // The third multiplier. Its addend is registered, and is 0 when there is none
    reg  signed [26:0] left, right;
    reg  [15:0]        l1;
    reg                half;
    assign             product = left * right;
    assign             result = product[52:31] + ({2'd0, l1, 4'd0} | (half ? 22'd1 << 17 - U : 22'd0));
    wire               outside = beyond || product[53:49] != {5{product[53]}};

    // v = 1 - c2^2 has 26 fraction bits. The first factors of sqrt(v), 1/q', 2/sqrt(q') have 22 bits and a constant 1
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

    assign out_cos = {cos3, cos2, cos1};
    assign out_sin = {sin3, sin2, sin1};
    assign out_none = zero;
    assign out_word = {result, product[30:29]};
    assign out_flat = outside;
    assign out_negative = short;
    assign out_status = {1'b0, over_z, zero || zero3, clamped || LATERAL && near_axis};
    wire   unused = &{1'b0, cfg_base, cfg_shoulder, cfg_lateral, cfg_bb, test, plain, odd_root};
    always @(posedge clk) begin
        if (LATERAL == 0)
            minus_q <= sin3 ? (SHOULDER ? {{6{~cfg_shoulder[13]}}, ~cfg_shoulder, 14'h3fff} : 34'd512) : 34'd0;
        else if (in_start)
            minus_q <= {{2{cfg_bb[31]}}, cfg_bb};
        else if (plain || gap)
            minus_q <= 34'd0;
        if (rho)
            minus_q <= cfg_q;
        if (in_start) begin
            elbow  <= in_elbow;
            back   <= in_back;
            over_z <= beyond_z;
        end
        if (test)
            near_axis <= total[36];
        if (rho)
            zero3 <= zero;
        if (rho)
            s <= cfg_e;
        if (bytes)
            s[3:2] <= coarse;
        if (cos2 || in_start || plain)
            clamped <= in_start || cos2 && outside || plain && near_axis;
        if (pairs) begin
            s[1:0] <= fine;
            zero   <= none;
        end
        if (halve && clamped) begin
            s        <= s >> 1;
            odd_root <= s[0];
        end
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
