// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of two joints, of three by rho = |(x, y)| and z for x and y: kernel of rational_ik2 and _ik3.
//   q = x^2 + y^2, c2 = (q - Q1 - Q2) / 2 L1 L2, k1 = L1 + L2 c2, k2 = +-L2 n2; a = k1 y - k2 x, b = k1 x + k2 y;
//   (b, a) / q is the direction of joint 1. x' = x << k and so on, k the sign bits that x, y (, z) can spare.
// Latency, II: 16, H = 0; three joints: 26, H = 10. cfg_q, cfg_r, cfg_e: rational.config. Models: rational.ik2, .ik3
//   Cycle       two multipliers: squares, turns      the third                             else
//   1..3        q = x^2 + y^2 (3)                                                          y, x
//  (4..9)       q' = x'^2 + y'^2 (6); a, b = y', x'  1/q' = w * slope (8)                  y', x'; m
//  (10..14)     q = q + z^2 (12)                     u = m/q', u * m (11), rho (12, 13)    out_j3; root of q; z, z'
//   H+3..H+5    q' = x'^2 + y'^2 (H+5)               c2 = n * cfg_r (H+5)                  y', x'; n = q - cfg_q
//   H+6..H+10                                        L2 c2, c2^2, L2 w, k2 = L2 w * slope  k1', k2' (H+10); out_j2
//   H+11..H+15  a, b                                 1/q', m/q' (H+13), (m/q')^2           m, the lesser; out_j1
`default_nettype none
module rational_solve #(
    parameter JOINTS = 2,
    parameter S = 24
) (
    input  wire           clk,
    input  wire           rst,
    input  wire [15:0]    cfg_l1,
    input  wire [15:0]    cfg_l2,
    input  wire [32:0]    cfg_q,
    input  wire [25:0]    cfg_r,
    input  wire [1:0]     cfg_e,
    input  wire           in_valid,
    output wire           in_ready,
    input  wire [15:0]    in_x,
    input  wire [15:0]    in_y,
    input  wire [15:0]    in_z,
    input  wire           in_elbow,
    output reg            out_valid,
    input  wire           out_ready,
    output reg  [S+1:0]   out_j1,
    output reg  [S+1:0]   out_j2,
    output reg  [S+1:0]   out_j3,
    output wire           out_unreachable,
    output wire           out_singular
);
    localparam YAW = JOINTS == 3, H = YAW ? 10 : 0, LAST = H + 14;
    localparam X = YAW ? 1 : 0;  // fraction bits of x' and y': only rho has some

    // One-hot: step[i] is cycle i + 1. `yaw` is the part of joint 3, `plane` that of the others
    reg  [LAST:0] step;
    /* verilator lint_off UNUSEDSIGNAL */
    wire [14:0]   plane = step[LAST:H];
    wire [11:0]   yaw = YAW ? step[11:0] : 12'd0;
    /* verilator lint_on UNUSEDSIGNAL */
    wire          accept = in_valid && in_ready;
    assign        in_ready = step == 0 && (!out_valid || out_ready);
    // Direction of (b, a): 1/q' is read, then multiplied beside a, then b is taken or not, then u = m / q'
    wire          read = yaw[6] || plane[9], first = yaw[7] || plane[10], second = yaw[8] || plane[11];
    wire          divide = yaw[9] || plane[12];

    reg  [15:0] x, y, z;
    reg  [3:0]  k;
    // One shifter for coordinates, rho, k1 and k2; a constant 1 behind the cut of those that were cut centres it
    reg  [26:0] left;   // n, c2, w, L2 w, k2, w of 1/q', a, the smaller of a and b (1.0 is 2^20), u
    reg  [20:0] reach;  // k1
    wire        take_x = step[1] || step[3 + YAW];
    wire        take_y = step[0] || step[2 + YAW] || !YAW && plane[10];
    wire        take_z = YAW && (plane[0] || plane[2] || plane[10]);
    wire        take_left = plane[9] || YAW && plane[3];
    /* verilator lint_off UNUSEDSIGNAL */
    reg  [20:0] raw, fine, scaled;  // 4 fraction bits
    /* verilator lint_on UNUSEDSIGNAL */
    always @* begin
        case ({take_x || take_y, take_x || take_left})
            2'd3: raw = {x[15], x, 4'd0};
            2'd2: raw = {y[15], y, 4'd0};
            2'd1: raw = {left[22:3], 1'b1};
            default: raw = take_z ? {z[15], z, 4'd0} : {reach[19:0], 1'b1};
        endcase
        case (k[1:0])
            2'd0: fine = raw;
            2'd1: fine = raw << 1;
            2'd2: fine = raw << 2;
            default: fine = raw << 3;
        endcase
        case (k[3:2])
            2'd0: scaled = fine;
            2'd1: scaled = fine << 4;
            2'd2: scaled = fine << 8;
            default: scaled = fine << 12;
        endcase
    end

    // k, the sign bits to spare: those of y and x, at last of z too
    reg  [14:0] used;
    wire [14:0] used_now = used | (raw[19:5] ^ raw[18:4]);
    reg  [3:0]  spare;
    integer     i;
    always @* begin
        spare = 4'd15;
        for (i = 0; i < 15; i = i + 1)
            if (YAW ? used[i] : used_now[i])
                spare = 4'd14 - i[3:0];
    end

    reg         elbow, zero, zero_xy;
    reg         clamped;        // out of reach: c2 = +-1, hence k2 = 0; k1 = +-1 will do, and m^2 / q' for (m / q')^2
    reg         flat;           // k2 = 0: the chord of 1 - c2^2 would read 1 for c2 = -1
    reg         beyond;         // n does not hold the gap
    reg         short;          // the gap is negative, cos of joint 2 too
    reg         a_left, b_left; // negative
    reg         long;           // the x axis is the nearer one: m is a
    reg  [16+X:0] xs, ys;       // y', x', at last x', y'
    reg  [31:0] q;              // x^2 + y^2 (+ z^2)
    reg  [20:0] k1, k2;         // k1', |k2'|, 4 fraction bits
    wire        minus = plane[10] && !elbow || plane[11] && elbow;
    wire [20:0] turned = k2 ^ {21{minus}};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [37+X:0] product1 = $signed(k1) * $signed(xs);
    wire signed [37+X:0] product2 = $signed(turned) * $signed(ys);
    wire [33:0] sum = product1[37+X:4+X] + product2[37+X:4+X];
    /* verilator lint_on UNUSEDSIGNAL */

    // 1/q' = w_q * slope_q; q' has 19 fraction bits
    wire [20:0] w_q;
    /* verilator lint_off UNUSEDSIGNAL */
    wire [20:0] q_near;
    /* verilator lint_on UNUSEDSIGNAL */
    wire [21+YAW:0] slope_q;
    reciprocal_product #(.TOP(YAW)) inverse (
        .clk(clk), .in_read(yaw[5] || plane[4]), .in_q(sum[31:11]), .out_q(q_near), .out_w(w_q), .out_slope(slope_q));

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

    // Right words are aligned so that every product to be used again is cut at the same place, but 1/q'
    wire        big = q[31:24] != 0;
    wire [19:0] slope;
    reg  [26:0] right;
    wire signed [53:0] product = $signed(left) * $signed(right);
    wire        outside = beyond || product[52:44] != {9{product[53]}};
    always @(posedge clk)
        if (!second && !(plane[13] && clamped))
            case ({read || first || yaw[10], plane[5] || plane[7] || divide || plane[13] || yaw[10] || yaw[11],
                   plane[4] || plane[6] || plane[7] || first || yaw[11]})
                3'd0: right <= {1'b0, cfg_r};
                3'd1: right <= {2'd0, cfg_l2, 9'd0};
                3'd2: right <= left;
                3'd3: right <= {5'd0, slope, 2'd0};
                3'd4: right <= {{(2-YAW){1'b0}}, slope_q, 3'd0};
                3'd5: right <= product[47:21];
                default: right <= YAW ? {1'b0, big, 3'd0, !big, 21'd0} : product[47:21];
            endcase

    // sqrt(1 - c2^2) = w * slope, and that of q / 2^32, of q / 2^24 where it is not big
    wire [18:0] w;
    root_product #(.S(24), .B(20)) chord (
        .clk(clk), .in_read(plane[6] || yaw[10]), .in_not(!yaw[10]),
        .in_v(yaw[10] ? big ? q[31:8] : q[23:0] : product[39:16]), .out_w(w), .out_slope(slope));

    // b is taken where |a| > q' / 2, roughly
    wire [7:0]  a_size = left[21:14] ^ {8{left[22]}};
    wire        steep = a_size > {1'b0, q_near[20:14]};

    // Spread about an axis, with one guard bit: nearest, ties away from the axis; -(s + g) = ~s + ~g
    wire        negative = plane[6] ? short == elbow : a_left ^ b_left ^ !long;
    wire [1:0]  axis = plane[6] ? {elbow, 1'b1} : {long ? b_left : a_left, !long};
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

    assign out_unreachable = clamped;
    assign out_singular = zero_xy;
    always @(posedge clk) begin
        step <= {step[LAST-1:0], accept};
        if (accept) begin
            x     <= in_x;
            y     <= in_y;
            z     <= in_z;
            elbow <= in_elbow;
            k     <= 4'd0;
            q     <= 32'd0;
            used  <= 15'd0;
        end
        if (step[0] || step[1] || yaw[10])
            used <= used_now;
        if (step[1 + YAW] || yaw[11])
            k <= spare;
        if (yaw[5])
            k <= 4'd0;
        if (step[2])
            zero_xy <= used == 0 && !x[15] && !y[15];
        if (step[3])
            zero <= zero_xy && !(YAW && z != 0);
        if (step[2] || yaw[11])
            q <= sum[31:0] + (YAW ? q : 32'd0);

        // Operands of the two multipliers
        if (take_x || take_y || take_z || YAW && plane[3])
            ys <= scaled[20:4-X];
        if (take_x || YAW && plane[3] || first)
            xs <= ys;
        if (step[0] || step[2 + YAW] || plane[2] || plane[6])
            k1 <= plane[6] && clamped ? {reach[20], 1'b1, 19'd0} : scaled;
        if (yaw[10])
            k1 <= 21'd0;
        if (yaw[5])
            k1 <= {2'b01, 19'd0};
        if (take_x || yaw[10] || YAW && plane[3] || plane[9])
            k2 <= plane[9] && flat ? 21'd0 : scaled;
        if (yaw[5])
            k2 <= 21'd0;

        // Elbow
        if (plane[3]) begin
            beyond <= far;
            short  <= gap[33];
        end
        if (plane[4])
            clamped <= outside;
        if (plane[5])
            reach <= {2'd0, cfg_l1, 3'd0} + product[46:26];
        if (plane[6]) begin
            out_j2 <= word;
            flat   <= product[40];
        end

        // The third multiplier
        if (!plane[5] && !(second && !steep) && !plane[13])
            case ({read, plane[6] || yaw[10] || first || second, plane[3] || first || second})
                3'd0: left <= product[50:24];
                3'd1: left <= n;
                3'd2: left <= {2'd0, w, 6'd0};
                3'd3: left <= {{4{sum[32]}}, sum[32:10]};
                default: left <= {1'd0, w_q, 5'd0};
            endcase
        if (plane[4] && outside)
            left <= {{6{short}}, 1'b1, 20'd0};
        if (first)
            a_left <= sum[32];
        if (second) begin
            b_left <= sum[32];
            long   <= !steep;
        end
        if (yaw[10] && !zero_xy)
            out_j3 <= word;
        if (plane[14] && !zero)
            out_j1 <= word;
        out_valid <= plane[14] || (out_valid && !out_ready);
        if (rst) begin
            step      <= {(LAST+1){1'b0}};
            out_valid <= 1'b0;
            out_j1    <= {(S+2){1'b0}};
            out_j3    <= {(S+2){1'b0}};
        end
    end
endmodule
`default_nettype wire
