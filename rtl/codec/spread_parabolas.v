// SPDX-License-Identifier: Apache-2.0
// Table codec of turn-spreads for long words: as spread_chords, but its segments are parabolas.
//   root = knot + moved + floor(step * offset / 2^17), moved = floor(bend * hump / 2^8), 2^5 in segments below 32
// The sag is what a straight segment lacks at its middle. bend is half the sag, in segments below 32 a sixteenth of it.
// hump tells how much of the sag belongs to the offset, times 512; it is one value for each 512th of a segment.
// Formats: in_j turn-spread u2.S; out_chords is the port of the table codecs (rtl/codec/README.md). Its knots include
// moved, and its offsets have 17 bits. The minor root has ranges of v with tops 2^-1, 2^-5, 2^-9, 2^-13, 2^-19, 2^-25
// and 2^-31. In the last range every word is a knot.
// Error of a completed root: bounds.codec.spread_roots. Latency 2 + PIPE, of the knots 2 + 3 PIPE; II 1. Source: paper,
// eqs. 51 and 52; tables with quadratic interpolation. Model: codec_wide.spread_roots
`default_nettype none
module spread_parabolas #(
    parameter S = 40,   // fraction bits of the word, 10 to 40 (default 40, 0.00005 degrees at a quadrant border)
    parameter U = 24,   // fraction bits of a root, 19 to 24 (default 24)
    parameter PIPE = 0  // 0 (default: fewest clocks); 1: registers before the memories and about bend * hump
) (
    input  wire            clk,
    input  wire [S+1:0]    in_j,
    output wire [4*U+39:0] out_chords
);
    localparam D = 17;     // bits of an offset
    localparam K = U + 3;  // fraction bits of a knot

    // Entry a, 0 to 511, is {bend, knot} of sqrt(a d), d = 2^-h. A knot is rounded up, since the root is truncated; a
    // bend is 2^(K-1) (d / 2)^2 / (32 sqrt(d) (a + 1/2)^(3/2)), nearest. Roots by Newton's rule.
    function [513*(K+9)-1:0] segments(input integer h);
        integer    a, i;
        reg [63:0] b, square, root, part;
        begin
            segments = 0;
            root = 64'd1 << K - h / 2;
            for (a = 1; a <= 512; a = a + 1) begin
                b = {32'd0, a};
                square = b << 2*K - h;
                for (i = a < 16 ? 0 : 5; i < 8; i = i + 1)
                    root = (root + square / root) >> 1;
                part = root + (root * root <= square ? 64'd1 : 64'd0);  // Newton ends at the floor or one above
                segments[(K+9)*a +: K] = part[K] ? {K{1'b1}} : part[K-1:0];
            end
            part = 64'd1 << 12;
            for (a = 8; a < 512; a = a + 1) begin
                b = {31'd0, a, 1'b1};
                square = (64'd1 << 2*K - h - (a < 32 ? 13 : 7)) / (b * b * b);
                if (a == 32)
                    part = 64'd1 << 12;
                for (i = a == 8 || a == 32 ? 0 : 12; i < 16; i = i + 1) begin
                    part = (part + square / part) >> 1;
                    if (part == 64'd0)
                        part = 64'd1;
                end
                if (part * part > square)
                    part = part - 64'd1;
                part = (part + 64'd1) >> 1;
                segments[(K+9)*a+K +: 9] = part[8:0];
                part = (part << 1) + 64'd1;
            end
        end
    endfunction
    localparam [513*(K+9)-1:0] MAJOR = segments(9), MINOR = segments(10);
    reg [2*U+10:0] minor [0:511];  // {bend, step, knot}
    reg [2*U+2:0]  major [0:255];  // of a segment that is read from its end: {bend, -step, knot}
    integer        i;
    initial begin
        for (i = 0; i < 512; i = i + 1)
            minor[i] = {MINOR[(K+9)*i+K +: 9], MINOR[(K+9)*(i+1) +: U-1] - MINOR[(K+9)*i +: U-1], MINOR[(K+9)*i +: K]};
        for (i = 0; i < 256; i = i + 1)
            major[i] = {MAJOR[(K+9)*(511-i)+K +: 5], MAJOR[(K+9)*(511-i) +: U-5] - MAJOR[(K+9)*(512-i) +: U-5],
                        MAJOR[(K+9)*(512-i) +: K]};
    end

    localparam T = 48;  // 2 v left-aligned in a word that holds every S and the offset of every range
    wire         fold = in_j[S-1];
    wire [T-1:0] v = {in_j[S-2:0] ^ {(S-1){fold}}, {(T-S+1){fold}}};
    wire [2:0]   range = v[T-1:T-12] != 0 ? (v[T-1:T-4] != 0 ? 3'd0 : v[T-5:T-8] != 0 ? 3'd1 : 3'd2) :
                         v[T-13:T-18] != 0 ? 3'd3 : v[T-19:T-24] != 0 ? 3'd4 : v[T-25:T-30] != 0 ? 3'd5 : 3'd6;
    reg  [8+D:0] segment;
    always @*
        case (range)
            3'd0: segment = v[T-1 -: 9+D];
            3'd1: segment = v[T-5 -: 9+D];
            3'd2: segment = v[T-9 -: 9+D];
            3'd3: segment = v[T-13 -: 9+D];
            3'd4: segment = v[T-19 -: 9+D];
            3'd5: segment = {v[T-25:0], {(D+33-T){fold}}};
            default: segment = {v[T-31:0], {(D+39-T){fold}}};
        endcase
    function [8:0] hump(input [8:0] place);
        reg [17:0] share;
        begin
            share = {9'd0, place ^ {9{place[8]}}};
            share = {share[16:0], 1'b1} * (18'd1023 - {share[16:0], 1'b0});
            hump = share[17:9];
        end
    endfunction
    (* rom_style = "logic" *)
    reg [8:0] humps [0:255];  // in logic: a block memory is read too late for the product
    integer   f;
    initial
        for (f = 0; f < 256; f = f + 1)
            humps[f] = hump(f[8:0]);

    // Addresses and places; with PIPE = 1 a clock later
    wire [5:0]     found_signs = {fold == in_j[S], in_j[S+1] ^ in_j[S], in_j[S+1], range};
    wire [5:0]     at_signs;
    wire [D+7:0]   at_first;
    wire [D+8:0]   at_second;
    generate
        if (PIPE == 0) begin : g_found
            assign {at_signs, at_first, at_second} = {found_signs, v[T-1 -: D+8], segment};
        end else begin : g_at
            reg [2*D+22:0] at;
            assign         {at_signs, at_first, at_second} = at;
            always @(posedge clk)
                at <= {found_signs, v[T-1 -: D+8], segment};
        end
    endgenerate

    // Behind the memories
    reg  [5:0]     signs;  // {minor_n, neg_c, neg_n, range}
    reg  [2*U+10:0] second;
    reg  [2*U+2:0] first;
    reg  [D-1:0]   first_place, place;
    reg            steep;
    wire [7:0]     fold1 = first_place[D-2 -: 8] ^ {8{first_place[D-1]}}, fold2 = place[D-2 -: 8] ^ {8{place[D-1]}};
    wire [8:0]     hump1 = humps[fold1], hump2 = humps[fold2];
    wire [8:0]     bend2;
    wire [4:0]     bend1;
    wire [U-6:0]   step1;
    wire [U-2:0]   step2;
    wire [K-1:0]   knot1, knot2;
    assign         {bend1, step1, knot1} = first;
    assign         {bend2, step2, knot2} = second;
    always @(posedge clk) begin
        signs       <= at_signs;
        first       <= major[at_first[D +: 8]];
        first_place <= at_first[D-1:0];
        second      <= minor[at_second[D +: 9]];
        place       <= at_second[D-1:0];
        steep       <= at_second[D+5 +: 4] == 4'd0;
    end
    wire [13:0]    moved1;
    wire [17:0]    moved2;
    wire [K-1:0]   base1, base2;
    wire           shifted;
    wire [K-1:0]   lifted1 = base1 + {{(K-6){1'b0}}, moved1[13:8]};
    wire [K-1:0]   lifted2 = base2 + (shifted ? {{(K-13){1'b0}}, moved2[17:5]} : {{(K-10){1'b0}}, moved2[17:8]});
    reg  [5:0]     last_signs;
    reg  [U-6:0]   last_step1;
    reg  [U-2:0]   last_step2;
    reg  [D-1:0]   last_place1, last_place2;
    reg  [K-1:0]   last_knot1, last_knot2;
    assign         out_chords = {last_signs, last_step1, last_knot1, last_place1, last_step2, last_knot2, last_place2};
    wire           unused = &{1'b0, moved1[7:0], moved2[4:0]};
    always @(posedge clk) begin
        last_signs  <= signs;
        last_step1  <= step1;
        last_step2  <= step2;
        last_place1 <= first_place;
        last_place2 <= place;
        last_knot1  <= lifted1;
        last_knot2  <= lifted2;
    end
    generate
        if (PIPE == 0) begin : g_now
            assign moved1 = bend1 * hump1;
            assign moved2 = bend2 * hump2;
            assign {base1, base2, shifted} = {knot1, knot2, steep};
        end else begin : g_late
            reg [4:0]   b1;
            reg [8:0]   b2, h1, h2;
            reg [K-1:0] k1, k2, k1_2, k2_2;
            reg [13:0]  m1;
            reg [17:0]  m2;
            reg [1:0]   s;
            assign      {moved1, moved2, base1, base2, shifted} = {m1, m2, k1_2, k2_2, s[1]};
            always @(posedge clk) begin
                {b1, b2, h1, h2}         <= {bend1, bend2, hump1, hump2};
                {k1, k2, k1_2, k2_2}     <= {knot1, knot2, k1, k2};
                m1 <= b1 * h1;
                m2 <= b2 * h2;
                s  <= {s[0], steep};
            end
        end
    endgenerate
endmodule
`default_nettype wire
