// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of three joints: joint 3 is the direction of (x, y), rho its length; rational_ik2 on (rho, z).
// Formats: in_x, in_y, in_z s(W-F).F, out_j1..3 turn-spread u2.S modulo 4, nearest; cfg_*: rational.config. Latency 26,
// II 26. x', y', z', k' are shifted by the sign bits all three can spare, x3, y3 by those x and y can: delta more.
// Cycle  quadrances, turn                        joints                             else
//  1.. 6 x^2, y^2, z^2 (2-4), x3^2, y3^2 (5, 6)                                     q, q3; read 1/q3, sqrt(q3 / 2)
//  7.. 9 1/q3 (7)                                rho' = w * sqrt2 / 2^delta * slope m, the smaller of x3 and y3
// 10..13 x'^2, y'^2, z'^2 (11-13)                u = m / q3 (11), u * m (13)        out_j3; read 1/q'
// 14..19 1/q' (14)                               c2, k1, c2^2 (16), k2 (17, 18)     out_j2; shifts of k1, k2
// 20..25 b (20), a (21), with the third          u = m / q' (23), u^2 (25)          out_j1
// Status: unreachable, singular (x = y = 0: out_j3 held, z = 0 too: out_j1). Error: README.md. Model: rational.ik3
`default_nettype none
module rational_ik3 #(
    parameter W = 16,
    parameter F = 8,
    parameter S = 24
) (
    input  wire           clk,
    input  wire           rst,
    input  wire [W-1:0]   cfg_l1,
    input  wire [W-1:0]   cfg_l2,
    input  wire [32:0]    cfg_q,
    input  wire [25:0]    cfg_r,
    input  wire [1:0]     cfg_e,
    input  wire           in_valid,
    output wire           in_ready,
    input  wire [W-1:0]   in_x,
    input  wire [W-1:0]   in_y,
    input  wire [W-1:0]   in_z,
    input  wire           in_elbow,
    output reg            out_valid,
    input  wire           out_ready,
    output reg  [S+1:0]   out_j1,
    output reg  [S+1:0]   out_j2,
    output reg  [S+1:0]   out_j3,
    output wire [3:0]     out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || S < 2 || S > 24) begin : g_illegal
            rational_ik3_needs_W_from_4_to_16_and_F_below_W_and_S_from_2_to_24 rule ();
        end
    endgenerate

    // One-hot: step[i] is cycle i + 1
    reg  [24:0] step;
    wire        accept = in_valid && in_ready;
    assign      in_ready = step == 0 && (!out_valid || out_ready);

    // k, the sign bits to spare: none before the squares of x, y and z, then those of x and y, then of all three
    reg  [15:0] x, y, z;
    wire [14:0] used_xy = (x[14:0] ^ x[15:1]) | (y[14:0] ^ y[15:1]);
    wire [14:0] used = used_xy | (z[14:0] ^ z[15:1]) & {15{step[4]}};
    reg  [3:0]  spare, k, delta;
    integer     i;
    always @* begin
        spare = 4'd15;
        for (i = 0; i < 15; i = i + 1)
            if (used[i])
                spare = 4'd14 - i[3:0];
    end
    reg  [22:0] reach;  // k1, then k2, with 5 fraction bits
    wire        take_x = step[0] || step[3] || step[9], take_y = step[1] || step[4] || step[10];
    wire        take_z = step[2] || step[11], take = take_x || take_y || take_z;
    wire [21:0] raw = {take_x ? {x[15], x} : take_y ? {y[15], y} : take_z ? {z[15], z} : reach[21:5],
                       reach[4:0] & {5{!take}}};
    /* verilator lint_off UNUSEDSIGNAL */
    wire [21:0] scaled = (((raw << {k[3], 3'd0}) << {k[2], 2'd0}) << {k[1], 1'd0}) << k[0];
    /* verilator lint_on UNUSEDSIGNAL */

    // {step, knot} of the chord of 2^18 / q' from q' = a / 256; a knot is lowered by half the sag, and moved by half
    // of what the cut of q' loses
    function [33:0] chord_from(input integer a);
        reg [63:0] here, next;
        begin
            here = a < 64 ? 64'd64 : {32'd0, a};
            next = here + 1;
            here = (((8 * here * here - 1) << 36) / (here * here * (4096 * here + 1)) + 1) >> 1;
            next = (((8 * next * next - 1) << 36) / (next * next * (4096 * next + 1)) + 1) >> 1;
            next = here - next;
            chord_from = {next[13:0], here[19:0]};
        end
    endfunction
    reg [33:0] chords[0:1023];
    integer    a;
    initial
        for (a = 0; a < 1024; a = a + 1)
            chords[a] = chord_from(a);

    reg         elbow, zero, zero_xy, clamped;
    reg         flat;           // k2 = 0: the chord of 1 - c2^2 would read 1 for c2 = -1
    reg         beyond;         // n does not hold the gap
    reg         short;          // the gap is negative, cos of joint 2 too
    reg         a_left, b_left; // negative
    reg         long;           // the x axis is the nearer one: m is a
    reg  [16:0] xs, ys;         // x3, y3; rho', z'; z', rho'
    reg  [16:0] rho;
    reg  [31:0] q;              // x^2 + y^2 + z^2, 0 before
    reg  [20:0] qs;             // q3, then q', 1.0 is 2^19
    reg  [33:0] chord;
    reg  [10:0] d;
    reg  [19:0] reciprocal;     // 1.0 is 2^18
    reg  [26:0] left;           // n, c2, w, L2 w, m, u
    reg  [22:0] m;              // b, then the smaller of b and a; 1.0 is 2^20
    reg  [19:0] k1, k2;         // k1', |k2'|, 3 fraction bits

    wire        minus = step[19] && elbow || step[20] && !elbow;
    wire [19:0] left2 = step[6] || step[13] ? {6'd0, chord[33:20]} : k2 ^ {20{minus}};
    wire [16:0] right2 = step[6] || step[13] ? {6'd0, d} : ys;
    // Right words are aligned so that every product to be used again is cut at the same place
    wire [16:0] slope;
    wire [15:0] l2 = {cfg_l2, {(16-W){1'b0}}};
    reg  [26:0] right;
    always @(posedge clk)
        case ({step[6] || step[9] || step[11] || step[21] || step[23] && clamped,
               step[7] || step[11] || step[13] || step[15] || step[16] || step[23] && clamped,
               step[7] || step[9] || step[14] || step[16] || step[21] || step[23] && !clamped})
            3'd0: right <= {1'b0, cfg_r};
            3'd1: right <= left;
            3'd2: right <= {1'b0, l2, 10'd0};
            3'd3: right <= {5'd0, slope, 5'd0};
            3'd4: right <= 27'd1482910 >> delta;
            3'd5: right <= {1'b0, reciprocal, 6'd0};
            default: right <= {{4{m[22]}}, m};
        endcase
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [36:0] product1 = $signed(k1) * $signed(xs);
    wire signed [36:0] product2 = $signed(left2) * $signed(right2);
    wire signed [53:0] product = $signed(left) * $signed(right);
    /* verilator lint_on UNUSEDSIGNAL */
    wire [20:0] next_q = product2[34:14] + qs;
    wire [22:0] sum = product1[35:13] + product2[35:13];

    // n, and c2 = n / 2 L1 L2 to 20 fraction bits; beyond +-1 it is +-1
    wire [33:0] gap = {2'd0, q} - {1'b0, cfg_q};
    wire        over8 = gap[33:26] != {8{gap[25]}}, over16 = gap[25:18] != {8{gap[17]}},
                over24 = gap[17:10] != {8{gap[9]}};
    wire        far = cfg_e != 0 && over8 || cfg_e[1] && (over16 || cfg_e[0] && over24);
    reg  [26:0] n;
    always @*
        case (cfg_e)
            2'd0: n = gap[33:7];
            2'd1: n = {gap[25:0], 1'b0};
            2'd2: n = {gap[17:0], 9'd0};
            default: n = {gap[9:0], 17'd0};
        endcase
    wire        outside = beyond || product[52:44] != {9{product[53]}};

    // sqrt(1 - c2^2) = w * slope
    wire [18:0] w;
    spread_chord #(.S(24)) chord2 (
        .clk(clk), .in_read(step[6] || step[15]), .in_not(!step[6]),
        .in_s(step[6] ? {qs[19:0], 4'd0} | {24{qs[20]}} : product[39:16]), .out_w(w), .out_slope(slope));

    // a is taken where |b| > q' / 2, roughly
    wire [7:0]  b_size = m[21:14] ^ {8{m[22]}};
    wire        sine = b_size > {1'b0, qs[20:14]};

    // Spread about an axis, with one guard bit: nearest, ties away from the axis; -(s + g) = ~s + ~g
    wire        negative = step[15] ? short == elbow : a_left ^ b_left ^ !long;
    wire [1:0]  axis = step[15] ? {elbow, 1'b1} : {long ? b_left : a_left, !long};
    wire [1:0]  quarter = axis + {negative, negative ^ product[40]};
    wire [S+1:0] floor = {quarter, product[39 -: S] ^ {S{negative}}};
    reg  [S+1:0] word;
    reg          carry;
    always @* begin
        carry = product[39-S] ^ negative;
        for (i = 0; i < S + 2; i = i + 1) begin
            word[i] = floor[i] ^ carry;
            carry = floor[i] & carry;
        end
    end

    assign out_status = {2'd0, zero_xy, clamped};
    always @(posedge clk) begin
        step  <= {step[23:0], accept};
        chord <= chords[next_q[20:11]];
        d     <= next_q[10:0];
        if (accept) begin
            x     <= {in_x, {(16-W){1'b0}}};
            y     <= {in_y, {(16-W){1'b0}}};
            z     <= {in_z, {(16-W){1'b0}}};
            k     <= 4'd0;
            elbow <= in_elbow;
        end
        if (step[0])
            zero_xy <= used == 0 && !x[15] && !y[15];
        if (step[1])
            zero <= zero_xy && z == 0;
        if (step[2] || step[4])
            k <= spare;
        if (step[4])
            delta <= k - spare;
        if (take || step[19])
            ys <= take ? scaled[21:5] : rho;
        if (step[4] || step[7] || step[18] || step[19])
            xs <= step[18] ? rho : ys;
        if (step[8])
            rho <= product[41:25];
        if (step[1] || step[2] || step[3])
            q <= product2[34:3] + q;
        if (step[0])
            q <= 32'd0;
        if (step[4] || step[5] || step[10] || step[11] || step[12])
            qs <= next_q;
        if (step[0] || step[9])
            qs <= 21'd0;
        if (step[12]) begin
            beyond <= far;
            short  <= gap[33];
        end
        if (step[13])
            clamped <= outside;
        if (!step[11] && !step[14] && !step[23])
            case ({step[6] || step[15] || step[9] || step[21], step[6] || step[15] || step[12]})
                2'd0: left <= product[50:24];
                2'd1: left <= n;
                2'd2: left <= {{4{m[22]}}, m};
                default: left <= {3'd0, w, 5'd0};
            endcase
        if (step[13] && outside)
            left <= {{6{short}}, 1'b1, 20'd0};
        if (step[6] || step[13])
            reciprocal <= chord[19:0] - {6'd0, product2[24:11]};
        if (step[14] || step[17])
            reach <= ({2'd0, cfg_l1, {(16-W){1'b0}}, 5'd0} & {23{step[14]}}) + product[47:25];
        if (step[0])
            k1 <= {2'b01, 18'd0};
        if (step[15]) begin
            out_j2 <= word;
            flat   <= product[40];
            k1     <= clamped ? {reach[22], 1'b1, 18'd0} : scaled[21:2];
        end
        if (take || step[18])
            k2 <= scaled[21:2];
        if (step[6] || step[18] && flat)
            k2 <= 20'd0;
        if (step[7] || step[19] || (step[8] || step[20]) && sine)
            m <= sum;
        if (step[7] || step[19])
            b_left <= sum[22];
        if (step[8] || step[20]) begin
            a_left <= sum[22];
            long   <= sine;
        end
        if (step[12] && !zero_xy)
            out_j3 <= word;
        if (step[24] && !zero)
            out_j1 <= word;
        out_valid <= step[24] || (out_valid && !out_ready);
        if (rst) begin
            step      <= 25'd0;
            out_valid <= 1'b0;
            out_j1    <= {(S+2){1'b0}};
            out_j3    <= {(S+2){1'b0}};
        end
    end
endmodule
`default_nettype wire
