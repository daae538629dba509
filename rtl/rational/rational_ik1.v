// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of one joint: the turn-spread of the direction of (x, y); no length is needed.
//   s = m^2 / q, q = x^2 + y^2, m the coordinate across the nearer axis; out_j1 = that axis (a quarter turn each) +- s
// Formats: in_x, in_y s(W-F).F, out_j1 turn-spread u2.S modulo 4, nearest.
// Error: direction within 0.6 * 2^-14 rad of those that round to the word: 0.6 LSB at a tip 2^14 LSB (64 units) away.
// Latency 4, II 4. Both coordinates are shifted left by the same k, so that 1/4 <= q <= 2.
//   before clock 0 (accept): x^2 | 1: y^2, q, read the chord of 1/q | 2: 1/q = knot - step * d | 3: s = m^2 * (1/q)
// Status: singular (x = y = 0: the last word is held).
// Source: rational trigonometry paper, eq. 9, which does not recover the quadrant.
// Model: rational.ik1
`default_nettype none
module rational_ik1 #(
    parameter W = 16,
    parameter F = 8,
    parameter S = 24
) (
    input  wire         clk,
    input  wire         rst,
    input  wire         in_valid,
    output wire         in_ready,
    input  wire [W-1:0] in_x,
    input  wire [W-1:0] in_y,
    output reg          out_valid,
    input  wire         out_ready,
    output reg  [S+1:0] out_j1,
    output wire [3:0]   out_status
);
    generate
        if (W < 4 || W > 16 || F < 0 || F >= W || S < 2 || S > 24) begin : g_illegal
            rational_ik1_needs_W_from_4_to_16_and_F_below_W_and_S_from_2_to_24 rule ();
        end
    endgenerate

    // {step, knot} of the chord of 2^16 / q from q = a / 256; a knot is lowered by half the sag, and moved by half
    // of what the cut of q loses. q = 2 wraps to a = 0, where 1/q does not matter.
    function [29:0] chord_from(input integer a);
        reg [63:0] here, next;
        begin
            here = {32'd0, a};
            next = here + 1;
            if (a < 64)
                here = 0;  // never: q >= 1/4
            else begin
                here = (((8 * here * here - 1) << 30) / (here * here * (256 * here + 1)) + 1) >> 1;
                next = (((8 * next * next - 1) << 30) / (next * next * (256 * next + 1)) + 1) >> 1;
                next = here - next;
            end
            chord_from = {next[11:0], here[17:0]};
        end
    endfunction
    reg [29:0] chords[0:511];
    integer    a;
    initial
        for (a = 0; a < 512; a = a + 1)
            chords[a] = chord_from(a);

    reg         p1, p2, p3;  // the clock before edge 1, 2, 3
    wire        accept = in_valid && in_ready;
    assign      in_ready = !p1 && !p2 && !p3 && (!out_valid || out_ready);

    // k, the sign bits to spare of the longer coordinate
    wire [15:0] x = {in_x, {(16-W){1'b0}}}, y = {in_y, {(16-W){1'b0}}};
    wire [14:0] used = (x[14:0] ^ x[15:1]) | (y[14:0] ^ y[15:1]);
    reg  [3:0]  spare, spare_kept;
    integer     i;
    always @* begin
        spare = 4'd15;
        for (i = 0; i < 15; i = i + 1)
            if (used[i])
                spare = 4'd14 - i[3:0];
    end

    // coarse steps first: the last bits of k are the last to be known
    reg  [15:0] y_kept;
    wire [15:0] raw = p1 ? y_kept : x;
    wire [3:0]  k = p1 ? spare_kept : spare;
    wire [15:0] scaled = (((raw << {k[3], 3'd0}) << {k[2], 2'd0}) << {k[1], 1'd0}) << k[0];

    // one multiplier squares both coordinates, then interpolates
    reg  [29:0] chord;
    reg  [7:0]  d;
    wire [15:0] left = p2 ? {8'd0, d} : scaled;
    wire [15:0] right = p2 ? {4'd0, chord[29:18]} : scaled;
    wire [31:0] product = $signed(left) * $signed(right);
    wire [27:0] square = product[30:3];

    reg  [27:0] m2;  // x^2, then the smaller square; 1.0 is 2^27
    wire [17:0] q = {1'b0, m2[27:11]} + {1'b0, square[27:11]};
    reg  [17:0] reciprocal;
    reg         x_left, y_left;  // negative
    reg         x_long;          // the x axis is the nearer one: |x| >= 1/2 and y is not -1
    reg         both_one;        // x = y = -1 (scaled): the one case where m^2 is 1.0
    reg         zero;

    // s = m^2 / q, with one guard bit. Nearest, ties away from the axis, and sign share one increment, since
    // -(s + g) = ~s + ~g; its carry is cheaper as gates than as a chain.
    wire [1:0]   above;  // m^2 / q < 1
    wire [S-1:0] s;
    wire         guard;
    wire [42-S:0] below;
    assign {above, s, guard, below} = m2[26:0] * {reciprocal, 1'b1};

    wire         unused = &{1'b0, product[31], product[2:0], above, below};

    wire         negative = x_left ^ y_left ^ !x_long;
    wire [1:0]   axis = {x_long ? x_left : y_left, !x_long};
    wire [1:0]   quarter = axis - {1'b0, negative};
    wire [S+1:0] floor = {quarter, {S{negative}} ^ s ^ {both_one, {(S-1){1'b0}}}};
    reg  [S+1:0] word;
    reg          carry;
    always @* begin
        carry = guard ^ negative;
        for (i = 0; i < S + 2; i = i + 1) begin
            word[i] = floor[i] ^ carry;
            carry = floor[i] & carry;
        end
    end

    assign out_status = {2'd0, zero, 1'b0};
    always @(posedge clk) begin
        y_kept     <= y;
        spare_kept <= spare;
        chord      <= chords[q[16:8]];
        d          <= q[7:0];
        reciprocal <= chord[17:0] + {6'h3f, ~product[19:8]};
        if (accept) begin
            x_left <= x[15];
            y_left <= y[15];
            zero   <= used == 0 && !x[15] && !y[15];
        end
        if (accept || p1)
            x_long <= p1 ? x_long && !square[27] : scaled[15] ^ scaled[14];
        if (accept || (p1 && x_long && !square[27]))
            m2 <= square;
        if (p1)
            both_one <= q[17];
        if (p3 && !zero)
            out_j1 <= word;
        p1        <= accept;
        p2        <= p1;
        p3        <= p2;
        out_valid <= p3 || (out_valid && !out_ready);
        if (rst) begin
            p1        <= 1'b0;
            p2        <= 1'b0;
            p3        <= 1'b0;
            out_valid <= 1'b0;
            out_j1    <= {(S+2){1'b0}};
        end
    end
endmodule
`default_nettype wire
