// SPDX-License-Identifier: Apache-2.0
// What engine_rus_ik and engine_rus_ik_angle share: poses and geometry in, the answers of the legs out, one leg after
// the other. in_free: the outputs are free in the next clock, so a pose may be accepted. Root and flags are valid with
// out_flags. With out_sine, out_c is the cosine and out_word the sine, of leg 6 with out_last; out_none: the sine is 0.
// in_place and in_step are the operands of the free product out_rise.
// Formats: rotation s2.16; p sW; geometry s18; out_c, out_word s2.16; out_root u18.4. Error: bounds.engine.rus_angle.
// Latency of leg 1: 32 to its flags, 37 to its sine; II 48; with PIPE = 1 46, 51 and 72. Model: engine_rus.ik
`default_nettype none
module engine_rus_poses #(
    parameter W = 18,        // bits of a position, 14 to 18 (default 18)
    parameter PIPE = 0,      // registers behind products and sums, 0 or 1 (default 0)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [26:0]  cfg_k,
    input  wire [25:0]         cfg_c,
    input  wire [11:0]         cfg_near,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire                in_free,
    input  wire                in_load,
    input  wire [2:0]          in_leg,
    input  wire signed [17:0]  in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33,
    input  wire signed [W-1:0] in_px, in_py, in_pz,
    input  wire signed [17:0]  in_cb, in_nb,
    input  wire [11:0]         in_place,
    input  wire [16:0]         in_step,
    output wire [28:0]         out_rise,
    output wire                out_flags,
    output wire                out_sine,
    output wire                out_last,
    output reg  signed [17:0]  out_c,
    output wire signed [17:0]  out_word,
    output wire [21:0]         out_root,
    output wire                out_none,
    output wire                out_far,
    output wire                out_near,
    output wire                out_over
);
    // A leg begins every 8 clocks and takes 37, or with PIPE = 1 every 12 and takes 51. While legs are inside, the next
    // pose keeps the same distance
    localparam [0:0]
        WAIT  = 1'b0,
        AGAIN = 1'b1;  // the next leg begins, of this pose or of the next one
    localparam [8-1:0] EIGHT = {
        /* a leg */ {7{WAIT}},
        /* next  */ AGAIN};
    localparam [12-1:0] TWELVE = {
        /* a leg */ {11{WAIT}},
        /* next  */ AGAIN};
    reg        busy;  // legs are inside that the next one could meet; of a pose behind them `more` keeps the beat
    wire       idle, again, more;
    wire       accept = in_valid && in_ready;
    wire       next = again && more;
    wire       start = accept || again && (busy || more);
    generate
        if (PIPE == 0) begin : g_table
            schedule #(.LINES(8), .BITS(1), .TABLE(EIGHT)) beat (
                .clk(clk), .rst(rst), .in_start(start), .out_idle(idle), .out_op(again));
        end else begin : g_table
            schedule #(.LINES(12), .BITS(1), .TABLE(TWELVE)) beat (
                .clk(clk), .rst(rst), .in_start(start), .out_idle(idle), .out_op(again));
        end
    endgenerate

    // The pose; its rows are read in the order x, z, y
    reg                load, first;  // first: the three clocks in which the first leg reads all rows
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

    wire               cosine, far, near, over, dead, unreached;
    engine_rus_leg #(.PIPE(PIPE), .MULTIPLY(MULTIPLY)) path (
        .clk(clk), .rst(rst), .cfg_k(cfg_k), .cfg_c(cfg_c), .cfg_near(cfg_near), .in_start(accept || next),
        .in_row(row), .in_words(words), .in_cb(cb), .in_nb(nb), .in_tag(tag),
        .in_place(in_place), .in_step(in_step), .out_rise(out_rise), .out_x(x_row), .out_z(z_row),
        .out_y(y_row), .out_turn(turn), .out_last(read), .out_flags(out_flags), .out_cosine(cosine),
        .out_sine(out_sine), .out_word(out_word), .out_root(out_root), .out_far(far), .out_none(out_none),
        .out_near(near), .out_over(over), .out_tag({out_last, dead, unreached}));
    assign out_far = unreached || !dead && far;
    assign out_near = !dead && near;
    assign out_over = !dead && over;

    assign more = leg != 3'd0;
    assign in_ready = (idle || again && !more) && in_free;
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
        if (read) begin  // last read of the geometry
            leg <= leg == 3'd5 ? 3'd0 : leg + 3'd1;
            tag <= {leg == 3'd5, load || !known[leg], !load && !known[leg]};
        end
        if (cosine)
            out_c <= out_none ? 18'h10000 : out_word;
        if ((PIPE == 0 ? out_sine : out_flags) && out_last)
            busy  <= 1'b0;
        if (read)
            busy <= 1'b1;
        if (load && first && x_row && to < 3'd6)
            known[to] <= 1'b1;
        if (rst) begin
            known <= 6'd0;
            leg   <= 3'd0;
            first <= 1'b0;
            busy  <= 1'b0;
        end
    end
endmodule
`default_nettype wire
