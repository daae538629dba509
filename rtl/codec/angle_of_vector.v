// SPDX-License-Identifier: Apache-2.0
// Codec of binary angles after kernel_vector_solve: the cosine, then the sine of a joint make its word.
//   out_j = axis +- arcsin(m), m the cosine where that is in [-3/4, 3/4), else the sine; 512 segments of the arc sine.
//   With I above 20, after kernel_vector_wide, a coefficient changes the slope along a segment, which is a parabola
// Formats: in_cos, in_sin have a bit a joint: in_word s4.I is its cosine, its sine. in_flat: c2 is 1, or -1 with
// in_negative. in_none: joints 1 and 3 hold their words. out_j: angles of A bits modulo a turn, rounded to nearest,
// joint 1 lowest. Reset sets joints 1 and 3 to 0. Joint 2 is not reset: every sample writes it.
// Error: bounds.codec.angle_of_vector; a length of 1 + e turns by up to 1.14 e more.
// Latency 3 + 2 PIPE from the sine on, 4 + 3 PIPE with I above 20, and a joint in as many clocks. Source: arc sine
// table with linear interpolation. Models: codecs.angle_of_vector, codec_wide.angle_of_vector
`default_nettype none
module angle_of_vector #(
    parameter JOINTS = 2,  // joints of the kernel, 1 to 3 (default 2)
    parameter A = 18,      // bits of a word, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
    parameter I = 20,      // fraction bits of in_word, 20, 22 or 26 (default 20)
    parameter PIPE = 0     // registers behind table and product, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [2:0]          in_cos,
    input  wire [2:0]          in_sin,
    input  wire [I+3:0]        in_word,
    input  wire                in_flat,
    input  wire                in_negative,
    input  wire                in_none,
    output reg  [JOINTS*A-1:0] out_j
);
    localparam D = A + 3, P = I - 8;           // a unit is 2^-D turn; bits of the place in a segment
    localparam CURVE = I > 20, C = 8 * CURVE;  // bits of a coefficient
    localparam T = I == 26 ? 9 : 8;            // bits of the place that it is multiplied with
    localparam LATE = CURVE + 2 * PIPE + CURVE * PIPE;  // clocks from a chord to its word, less one

    // 2^44 (arcsin(i / 256) - half the sag), i from 0 to 224, then constant; a parabola is not off by its sag. A
    // difference, with b = 2 i + 1 and n = 2^18 - b^2, is 2/sqrt(n) (1 + (2^18 + 2 b^2) / 6 n^2). It is then scaled to
    // 2^-62 turn. On top is 2^26 times the coefficient, in turns: half the second derivative, 2 b / n^(3/2) rad.
    // ROUND is half a word of 8 units less half a unit, half of the two truncated units, of three for a parabola, and
    // half of the last bit of m.
    function [72*257-1:0] arcs(input integer unused);
        integer    i;
        reg [63:0] k, b, n, root, rise, arc, bend;
        begin
            arc = 0;
            root = 64'd1 << 31;
            for (i = 0; i < 257; i = i + 1) begin
                k = i < 224 ? {32'd0, i} : 64'd223;
                b = 2 * k + 1;
                n = 262144 - b * b;
                root = root + (n << 44) / root >> 1;
                root = root + (n << 44) / root >> 1;
                root = root + (n << 44) / root >> 1;
                rise = (64'd1 << 63) / root << 4;
                rise = rise + ((rise >> 8) * (262144 + 2 * b * b) / (6 * n) / n << 8);
                bend = ((b * 64'd683565276 << 18) / (n * root) + 1) >> 1;
                arcs[72*i+64 +: 8] = bend > 255 ? 8'd255 : bend[7:0];
                bend = CURVE ? 64'd0 : (k << 40) / ((65536 - k * k) * (root >> 23));
                arcs[72*i +: 64] = (arc - bend >> 14) * 64'd683565276;
                arc = i < 224 ? arc + rise : arc;
            end
        end
    endfunction
    localparam [72*257-1:0] ARCS = arcs(0);
    localparam [63:0]       ROUND = (64'd9 + CURVE << 61 - D) + (64'd683565276 << 29 - I);
    reg [C+2*D-11:0] chords[0:511];  // {coefficient, knot, step}
    reg [D-2:0]      here;
    reg [63:0]       next;
    /* verilator lint_off UNUSEDSIGNAL */
    reg [2*D-3:0]    row;
    /* verilator lint_on UNUSEDSIGNAL */
    integer          i;
    initial begin
        next = ROUND - ARCS[72*256 +: 64] >> 62 - D;
        for (i = -256; i < 256; i = i + 1) begin
            here = next[D-2:0];
            next = i < -1 ? -ARCS[72*(-i-1) +: 64] : ARCS[72*(i < 0 ? 0 : i+1) +: 64];
            next = ROUND + next >> 62 - D;
            row = {ARCS[72*(i < 0 ? -i-1 : i)+64 +: 8], here, next[D-10:0] - here[D-10:0]};
            chords[i & 511] = row[C+2*D-11:0];
        end
    end

    reg  [I:0]        m;
    reg               far, back, under;  // the cosine is outside [-3/4, 3/4); the cosine, the sine is negative
    reg  [2:0]        read, give;        // one bit a joint
    wire [3:0]        quarters = in_word[I+1:I-2];
    wire              fits = quarters[3] ? quarters[2] && quarters[1:0] != 0 : !quarters[2] && quarters[1:0] != 3;
    wire              minus = far ? back : !under;
    reg  [1:0]        axis;
    reg  [C+2*D-11:0] chord;
    reg  [P-1:0]      place;
    wire [C+2*D-11:0] found;  // the chord that is used
    wire [D-2:0]      knot = found[2*D-11:D-9];
    wire [D-10:0]     slope, bent, rise;
    wire [P-1:0]      cut;
    wire [2:0]        below;
    wire [A-1:0]      word;
    wire [2:0]        gives;
    generate
        if (CURVE) begin : g_curve  // less the coefficient times the rest of the segment; more where it is concave
            wire [T-1:0] ahead = {~place[P-1:P-T+1], 1'b1};
            reg  [T+7:0] part;
            integer      k;
            always @* begin
                part = 0;
                for (k = 0; k < 8; k = k + 1)
                    part = part + ({8'd0, ahead & {T{found[2*D-10+k]}}} << k);
            end
            /* verilator lint_off UNUSEDSIGNAL */
            wire [17:0]  all = {{(10-T){1'b0}}, part} >> 26 + T - D;
            /* verilator lint_on UNUSEDSIGNAL */
            reg          concave;
            reg [D-10:0] moved;
            always @(posedge clk) begin
                if (read != 0)
                    concave <= m[I] ^ minus;
                moved <= all[D-10:0];
            end
            assign bent = found[D-10:0] + (moved ^ {(D-9){!concave}});
        end else begin : g_straight
            assign bent = found[D-10:0];
        end
        if (PIPE == 0) begin : g_now
            assign found = chord;
            assign slope = bent;
            assign {rise, cut} = slope * place;
        end else begin : g_registered
            reg [C+2*D-11:0] held;
            reg [D+P-10:0]   product;
            assign found = held;
            assign {rise, cut} = product;
            always @(posedge clk) begin
                held    <= chord;
                product <= slope * place;
            end
            if (CURVE) begin : g_bent
                reg [D-10:0] bent_1;
                assign       slope = bent_1;
                always @(posedge clk)
                    bent_1 <= bent;
            end else begin : g_step
                assign slope = bent;
            end
        end
        if (LATE == 0) begin : g_soon
            assign gives = give;
        end else begin : g_later
            reg  [3*LATE-1:0] later;
            /* verilator lint_off UNUSEDSIGNAL */
            wire [3*LATE+2:0] queue = {give, later};
            /* verilator lint_on UNUSEDSIGNAL */
            assign            gives = later[2:0];
            always @(posedge clk)
                later <= rst ? {(3*LATE){1'b0}} : queue[3*LATE+2:3];
        end
    endgenerate
    assign          {word, below} = {axis[1] ^ (knot[D-2] && !axis[0]), axis[0] ^ knot[D-2], knot[D-3:0]}
                                  + {9'd0, rise};
    wire            unused = &{1'b0, below, cut, in_word[I+2], gives};

    always @(posedge clk) begin
        if (in_cos != 0 || in_sin != 0 && far)
            m <= in_word[I:0];
        if (in_cos != 0) begin
            far  <= !fits || in_cos[1] && in_flat;
            back <= in_cos[1] ? in_negative : in_word[I+3];
        end
        if (in_sin != 0)
            under <= in_word[I+3];
        if (read != 0) begin
            chord <= chords[m[I:P] ^ {9{minus}}];
            place <= m[P-1:0] ^ {P{minus}};
            axis  <= far ? {back, 1'b0} : {under, 1'b1};
        end
        read <= rst ? 3'd0 : in_sin;
        give <= rst ? 3'd0 : read;
    end

    genvar j;
    generate
        for (j = 0; j < JOINTS; j = j + 1) begin : g_joint
            always @(posedge clk)
                if (rst && j != 1 || gives[j] && !(in_none && j != 1))
                    out_j[A*j +: A] <= rst && j != 1 ? {A{1'b0}} : word;
        end
    endgenerate
endmodule
`default_nettype wire
