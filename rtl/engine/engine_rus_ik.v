// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of a parallel robot with six RUS legs (or three): pose and link angle to six crank vectors.
//   (cos, sin) = (e G -+ f S, f G +- e S) / (e^2 + f^2), G = (e^2 + f^2 + h^2 + LA^2 - LB^2) / 2 LA,
//   S = sqrt(e^2 + f^2 - G^2), (e, f, h) = R c + p - F - link (cos beta, sin beta, 0) in the frame of the leg
// Formats: rotation, vectors s2.16; p sW; platform lengths s18, 2^(W - 18) LSB of p; out_s 2^(W - 22), root of the leg.
// in_load: no pose but the geometry of leg in_leg (page); answered by (1, 0), S = 0. Legs not loaded since reset answer
// (1, 0) and count as unreachable. Error: page. Latency 79, II 48.
// Status: unreachable (out_far says which; nearest crank angle), singular (S below cfg_near), overflow (words wrap).
// Source: Sanchez-Alonso et al., RIAI 13 (2016) 247-257, (15)-(17) corrected. Model: engine_rus.ik
`default_nettype none
module engine_rus_ik #(
    parameter W = 18  // bits of a position, 14 to 18: 18 keep the arithmetic as the greatest error
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [26:0]  cfg_k,
    input  wire [25:0]         cfg_c,
    input  wire [11:0]         cfg_near,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire                in_load,
    input  wire [2:0]          in_leg,
    input  wire signed [17:0]  in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33,
    input  wire signed [W-1:0] in_px, in_py, in_pz,
    input  wire signed [17:0]  in_cb, in_nb,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [17:0]  out_c1, out_n1, out_c2, out_n2, out_c3, out_n3,
    output wire signed [17:0]  out_c4, out_n4, out_c5, out_n5, out_c6, out_n6,
    output wire [21:0]         out_s1, out_s2, out_s3, out_s4, out_s5, out_s6,
    output wire [5:0]          out_far,
    output wire [3:0]          out_status
);
    generate
        if (W < 14 || W > 18) begin : g_illegal
            engine_rus_ik_needs_W_from_14_to_18 rule ();
        end
    endgenerate
    // A leg begins every 8 clocks and takes 37. While legs are inside, the next pose begins such a time behind them too
    localparam [0:0]
        WAIT  = 1'b0,
        AGAIN = 1'b1;  // - <- -: the next leg begins, of this pose or of the next one
    localparam [8-1:0] EIGHT = {
        /* a leg */ {7{WAIT}},
        /* next  */ AGAIN};
    reg        busy;  // legs are inside
    wire       idle, again, more;
    wire       accept = in_valid && in_ready;
    wire       next = again && more;
    schedule #(.LINES(8), .BITS(1), .TABLE(EIGHT)) beat (
        .clk(clk), .rst(rst), .in_start(accept || again && (busy || more)), .out_idle(idle), .out_op(again));

    // The pose, and its rows as the legs want them: x, z, y
    reg                load, first;  // first: the first three clocks of the first leg, which read all rows
    reg  [2:0]         to, leg, tag;
    reg  [5:0]         known;
    reg  [71:0]        row1, row2, row3;
    reg  signed [17:0] cb, nb;
    wire               x_row, z_row, y_row, turn, read;
    wire [71:0]        row = x_row ? row1 : z_row ? row3 : row2;

    // Geometry, three words a leg: {c1, c2, c3, -Fx}, {st, -ct, elbow, -Fz}, {ct, st, -link, -Fy}
    reg  [71:0]        geometry[0:31];
    reg  [71:0]        words;
    wire [1:0]         part = {z_row || y_row || turn, x_row || read};
    always @(posedge clk) begin
        if (load && first)
            geometry[{to, y_row, z_row}] <= row;
        words <= geometry[{leg, part}];
    end

    wire signed [17:0] word;
    wire [21:0]        root;
    wire               flags, cosine, sine, far, none, near, over, last, dead, unreached;
    engine_rus_leg path (
        .clk(clk), .rst(rst), .cfg_k(cfg_k), .cfg_c(cfg_c), .cfg_near(cfg_near), .in_start(accept || next),
        .in_row(row), .in_words(words), .in_cb(cb), .in_nb(nb), .in_tag(tag), .out_x(x_row), .out_z(z_row),
        .out_y(y_row), .out_turn(turn), .out_last(read), .out_flags(flags), .out_cosine(cosine), .out_sine(sine),
        .out_word(word), .out_root(root), .out_far(far), .out_none(none), .out_near(near), .out_over(over),
        .out_tag({last, dead, unreached}));
    engine_rus_results results (
        .clk(clk), .rst(rst), .in_flags(flags), .in_cosine(cosine), .in_sine(sine), .in_last(last), .in_dead(dead),
        .in_none(none), .in_far(far), .in_unreached(unreached), .in_near(near), .in_over(over), .in_word(word),
        .in_root(root), .out_valid(out_valid), .out_ready(out_ready),
        .out_c({out_c6, out_c5, out_c4, out_c3, out_c2, out_c1}),
        .out_n({out_n6, out_n5, out_n4, out_n3, out_n2, out_n1}),
        .out_s({out_s6, out_s5, out_s4, out_s3, out_s2, out_s1}), .out_far(out_far), .out_status(out_status));

    assign more = leg != 3'd0;
    assign in_ready = (idle || again && !more) && (!out_valid || out_ready);
    localparam PAD = 18 - W;
    always @(posedge clk) begin
        if (accept) begin
            load <= in_load;
            to   <= in_leg;
            row1 <= {in_r11, in_r12, in_r13, in_px, {PAD{1'b0}}};
            row2 <= {in_r21, in_r22, in_r23, in_py, {PAD{1'b0}}};
            row3 <= {in_r31, in_r32, in_r33, in_pz, {PAD{1'b0}}};
            cb   <= in_cb;
            nb   <= in_nb;
        end
        first <= accept || (first && !y_row);
        if (read) begin  // the geometry has been read for the last time
            leg <= leg == 3'd5 ? 3'd0 : leg + 3'd1;
            tag <= {leg == 3'd5, load || !known[leg], !load && !known[leg]};
        end
        if (sine && last)
            busy <= 1'b0;
        if (read)
            busy <= 1'b1;
        if (load && first && x_row && to < 3'd6)
            known[to] <= 1'b1;
        if (rst) begin
            known <= 6'd0;
            leg   <= 3'd0;
            first <= 1'b0;
            busy <= 1'b0;
        end
    end
endmodule
`default_nettype wire
