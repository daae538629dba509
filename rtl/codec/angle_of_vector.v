// SPDX-License-Identifier: Apache-2.0
// Codec of binary angles after kernel_vector_solve: the cosine, then the sine of a joint make its word.
//   out_j = axis +- arcsin(m), m the cosine where that is in [-3/4, 3/4), else the sine; 512 segments of the arc sine
// Formats: in_cos, in_sin have a bit a joint: in_word s4.20 is its cosine, its sine. in_flat: c2 is 1, or -1 with
// in_negative. in_none: joints 1 and 3 hold their words. out_j: angles of A bits modulo a turn, rounded to nearest,
// joint 1 lowest. Reset sets joints 1 and 3 to 0. Joint 2 is not reset: every sample writes it.
// Error: half the sag 2^-18.4 rad, m 2^-20.4 rad, knot and step 2^-(A+4) turn; a length of 1 + e turns by up to 1.14 e.
// Latency 3 + 2 PIPE from the sine on; a joint every 2 clocks. Source: arc sine table with linear interpolation. Model:
// codecs.angle_of_vector
`default_nettype none
module angle_of_vector #(
    parameter JOINTS = 2,  // joints of the kernel, 2 or 3 (default 2)
    parameter A = 18,      // bits of a word, 10 to 24 (default 18, 0.0014 degrees); a full turn is 2^A
    parameter PIPE = 0     // registers behind table and product, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire [2:0]          in_cos,
    input  wire [2:0]          in_sin,
    input  wire [23:0]         in_word,
    input  wire                in_flat,
    input  wire                in_negative,
    input  wire                in_none,
    output reg  [JOINTS*A-1:0] out_j
);
    localparam D = A + 3;

    // 2^44 (arcsin(i / 256) - half the sag), i from 0 to 224, then constant. A difference, with b = 2 i + 1 and
    // n = 2^18 - b^2, is 2/sqrt(n) (1 + (2^18 + 2 b^2) / 6 n^2). It is then scaled to 2^-62 turn. ROUND is half a word
    // of 8 units less half a unit, half of the two truncated units, and half of the last bit of m.
    function [64*257-1:0] arcs(input integer unused);
        integer    i;
        reg [63:0] k, b, n, root, rise, arc;
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
                arcs[64*i +: 64] = (arc - (k << 40) / ((65536 - k * k) * (root >> 23)) >> 14) * 64'd683565276;
                arc = i < 224 ? arc + rise : arc;
            end
        end
    endfunction
    localparam [64*257-1:0] ARCS = arcs(0);
    localparam [63:0]       ROUND = (64'd9 << 61 - D) + (64'd683565276 << 9);
    reg [2*D-11:0] chords[0:511];  // {knot, step}
    reg [D-2:0]    here;
    reg [63:0]     next;
    integer        i;
    initial begin
        next = ROUND - ARCS[64*256 +: 64] >> 62 - D;
        for (i = -256; i < 256; i = i + 1) begin
            here = next[D-2:0];
            next = i < -1 ? -ARCS[64*(-i-1) +: 64] : ARCS[64*(i < 0 ? 0 : i+1) +: 64];
            next = ROUND + next >> 62 - D;
            chords[i & 511] = {here, next[D-10:0] - here[D-10:0]};
        end
    end

    reg  [20:0]     m;
    reg             far, back, under;  // the cosine is outside [-3/4, 3/4); the cosine, the sine is negative
    reg  [2:0]      read, give;        // one bit a joint
    wire            fits = in_word[21] ? in_word[20] && in_word[19:18] != 0 : !in_word[20] && in_word[19:18] != 3;
    wire            minus = far ? back : !under;
    reg  [1:0]      axis;
    reg  [2*D-11:0] chord;
    reg  [11:0]     place;
    wire [D-2:0]    knot;
    wire [D-10:0]   step, rise;
    wire [11:0]     cut;
    wire [2:0]      below;
    wire [A-1:0]    word;
    wire [2:0]      gives;
    generate
        if (PIPE == 0) begin : g_now
            assign {knot, step} = chord;
            assign {rise, cut} = step * place;
            assign gives = give;
        end else begin : g_registered
            reg [2*D-11:0] held;
            reg [D+2:0]    product;
            reg [5:0]      later;
            assign {knot, step} = held;
            assign {rise, cut} = product;
            assign gives = later[2:0];
            always @(posedge clk) begin
                held    <= chord;
                product <= step * place;
                later   <= rst ? 6'd0 : {give, later[5:3]};
            end
        end
    endgenerate
    assign          {word, below} = {axis[1] ^ (knot[D-2] && !axis[0]), axis[0] ^ knot[D-2], knot[D-3:0]}
                                  + {9'd0, rise};
    wire            unused = &{1'b0, below, cut, in_word[22], gives};

    always @(posedge clk) begin
        if (in_cos != 0 || in_sin != 0 && far)
            m <= in_word[20:0];
        if (in_cos != 0) begin
            far  <= !fits || in_cos[1] && in_flat;
            back <= in_cos[1] ? in_negative : in_word[23];
        end
        if (in_sin != 0)
            under <= in_word[23];
        if (read != 0) begin
            chord <= chords[m[20:12] ^ {9{minus}}];
            place <= m[11:0] ^ {12{minus}};
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
