// SPDX-License-Identifier: Apache-2.0
// Results of engine_rus_ik: they move in leg by leg, at leg 6 and on towards leg 1, and wait as one.
// The results of one pose wait at the outputs, those of the next one behind them; in_last, with the last sine, says that
// a pose is complete. in_ready of the core keeps a third one out: it wants the outputs free when a pose is taken.
// Formats: engine_rus_ik, lowest leg 1. in_dead: the leg has no answer, (1, 0) and 0 stand for it.
// Model: engine_rus.ik
`default_nettype none
module engine_rus_results (
    input  wire               clk,
    input  wire               rst,
    input  wire               in_flags,
    input  wire               in_cosine,
    input  wire               in_sine,
    input  wire               in_last,
    input  wire               in_dead,
    input  wire               in_none,
    input  wire               in_far,
    input  wire               in_unreached,
    input  wire               in_near,
    input  wire               in_over,
    input  wire signed [17:0] in_word,
    input  wire [21:0]        in_root,
    output reg                out_valid,
    input  wire               out_ready,
    output reg  [107:0]       out_c,
    output reg  [107:0]       out_n,
    output reg  [131:0]       out_s,
    output reg  [5:0]         out_far,
    output wire [3:0]         out_status
);
    reg  [107:0] c, n;
    reg  [131:0] s;
    reg  [5:0]   far, near, over, out_near, out_over;
    reg          whole;
    assign out_status = {1'b0, out_over != 0, out_near != 0, out_far != 0};
    always @(posedge clk) begin
        if (in_flags) begin
            s    <= {in_dead || in_far ? 22'd0 : in_root, s[131:22]};
            far  <= {in_unreached || !in_dead && in_far, far[5:1]};
            near <= {!in_dead && in_near, near[5:1]};
            over <= {!in_dead && in_over, over[5:1]};
        end
        if (in_cosine)
            c <= {in_dead || in_none ? 18'h10000 : in_word, c[107:18]};
        if (in_sine)
            n <= {in_dead || in_none ? 18'd0 : in_word, n[107:18]};
        if (!out_valid || out_ready) begin
            {out_c, out_n, out_s, out_far, out_near, out_over} <= {c, n, s, far, near, over};
            out_valid <= whole;
            whole     <= 1'b0;
        end
        if (in_sine && in_last)
            whole <= 1'b1;
        if (rst) begin
            out_valid <= 1'b0;
            whole     <= 1'b0;
        end
    end
endmodule
`default_nettype wire
