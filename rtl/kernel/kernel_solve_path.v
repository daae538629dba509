// SPDX-License-Identifier: Apache-2.0
// Datapath of kernel_solve, whose table says what happens in each clock: in_op is one line of it, column by column.
// Ports, formats, error, status and models are those of kernel_solve. in_start: in_x, in_y, in_z and in_elbow are
// loaded. 1.0 is 2^25 in left, 2^26 in right (2^24 in words from SLOPE), 2^49 in a product of the two and 2^51 in a
// square.
`default_nettype none
module kernel_solve_path #(
    parameter JOINTS = 2  // joints, 2 or 3 (default 2): in the plane, where in_z is not used, or in space
) (
    input  wire               clk,
    input  wire [15:0]        cfg_l1,
    input  wire [15:0]        cfg_l2,
    input  wire signed [33:0] cfg_q,
    input  wire [25:0]        cfg_r,
    input  wire [3:0]         cfg_e,
    input  wire               in_start,
    input  wire [26:0]        in_op,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire signed [15:0] in_z,
    input  wire               in_elbow,
    output wire [JOINTS-1:0]  out_take,
    output wire [1:0]         out_axis,
    output wire               out_below,
    output wire [40:0]        out_square,
    output wire [3:0]         out_status
);
    localparam YAW = JOINTS == 3;
    wire [1:0] left_from;
    wire [2:0] right_from;
    wire       rho_to, up, power, move, turn, to_k2, to_k1, add_l1;
    wire       j1, j3, half, base, side, halve, sin2, cos2, inverse, read, root, gap, pairs, bytes;
    assign {rho_to, up, power, move, turn, to_k2, to_k1, left_from, right_from, add_l1,
            j1, j3, half, base, side, halve, sin2, cos2, inverse, read, root, gap, pairs, bytes} = in_op;

    // minus_q first turns q into the gap, later it rounds rho; it is 0 where bytes and pairs are counted
    reg                elbow, clamped, zero, beyond, short;
    reg                bent;            // c2^2 >= 1/2, so joint 2 is given by n2^2
    reg                a_left, b_left;  // a < 0, b < 0
    reg                x_near;          // the x axis is the nearer one, and m is a
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
    wire               first = YAW ? up : in_start;  // the next clock is that of the gap
    reg         [33:0] gap_xy;                       // x^2 + y^2 - Q1 - Q2
    reg         [20:0] rho;
    kernel_vector_turn #(.JOINTS(JOINTS)) operands (
        .clk(clk), .in_start(in_start), .in_x(in_x), .in_y(in_y), .in_z(in_z), .in_up(up), .in_rho(rho_to),
        .in_total(rho), .in_k1(to_k1), .in_k2(to_k2), .in_turn(turn), .in_move(move), .in_power(power),
        .in_clamp(clamped), .in_odd(s[0]), .in_sum(result), .in_product(product[52:31] ^ {22{halve && elbow}}),
        .in_addend(minus_q), .out_sum(total));
    kernel_vector_shift shift (.in_sum(total), .in_q(total[34:3]), .in_s(s), .out_word(word), .out_over(over),
        .out_coarse(coarse), .out_fine(fine), .out_zero(none));

    // The third multiplier. Its addend is a register that is 0 where nothing is added.
    reg  signed [26:0] left, right;
    reg  [15:0]        l1;
    assign             product = left * right;
    assign             result = product[52:31] + {2'd0, l1, 4'd0};
    wire               outside = beyond || product[53:49] != {5{product[53]}};

    // v = 1 - c2^2 has 26 fraction bits. First factors of sqrt(v), 1/q', 2/sqrt(q') have 22 bits and a constant 1.
    wire [25:0] v = ~product[50:25];
    wire        low = v[25:21] == 0, tiny = v[25:14] == 0;
    wire [20:0] e = tiny ? {2'd0, v[13:0], 5'd16} : low ? v[20:0] : v[25:5];
    wire [21:0] root_w = {e[20:11], ~e[11], e[10:0]};
    wire [21:0] inverse_w = {1'b0, word[24:16], ~word[15], clamped ? {word[15], ~word[14:5]} : ~word[14:4]};
    reg  [21:0] factor;
    wire [19:0] slope;
    kernel_vector_slopes slopes (.clk(clk), .in_read(root || read),
        .in_range(read ? {1'b1, clamped} : {tiny, low && !tiny}), .in_segment(read ? factor[20:12] : e[20:12]),
        .out_slope(slope));

    // m is b where |b| / q < 3/4, else a
    wire [2:0] size = product[49:47] ^ {3{product[53]}};
    wire       far = size[2] || size[1] && size[0];

    // The axis of joint 2 is a quarter turn for c2^2, and 0 or half a turn for n2^2
    reg         zero3;
    /* verilator lint_off UNUSEDSIGNAL */
    wire [2:0]  take = {j3 && !zero, root || sin2 && bent, j1 && !zero};
    /* verilator lint_on UNUSEDSIGNAL */
    assign      out_take = take[JOINTS-1:0];
    assign      out_axis = root ? {elbow, 1'b1} : sin2 ? {short, 1'b0} : {x_near ? b_left : a_left, !x_near};
    assign      out_below = root ? short == elbow : sin2 ? short ^ elbow : a_left ^ b_left ^ !x_near;
    assign      out_square = product[51:11];
    assign      out_status = {2'd0, YAW ? zero3 : zero, clamped};
    always @(posedge clk) begin
        minus_q <= {24'd0, half, 9'd0};
        if (in_start || first)
            minus_q <= in_start ? cfg_q : gap_xy;
        if (base)
            gap_xy <= total[36:3];
        if (up)
            rho <= total[33:13];
        if (in_start)
            elbow <= in_elbow;
        if (up)
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

        if (root)
            bent <= clamped || product[51] || product[50];
        if (side) begin
            b_left <= product[53];
            a_left <= word[26];
            x_near <= far;
        end

        l1 <= cfg_l1;
        if (!add_l1)
            l1 <= 16'd0;
        if (root || inverse) begin
            factor   <= inverse ? inverse_w : root_w;
        end
        if (root && (clamped || product[51])) begin  // for c2 = -1 the root would read 1
            factor   <= 22'd0;
        end
        if (left_from != 2'd3 && !(side && !far))
            case (left_from)
                2'd2: left <= product[50:24];
                2'd1: left <= {1'b0, factor, 4'd8};
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
