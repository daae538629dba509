// SPDX-License-Identifier: Apache-2.0
// Results of engine_rus_ik: they are shifted in leg by leg, from leg 6 towards leg 1, and leave together. The results
// of one pose wait at the outputs, those of the next one in a second set of registers. in_last, with the last in_move,
// says that a pose is complete. in_ready of the core holds back a third pose: it requires free outputs. in_leg6 is a
// register that accepts the word of the next leg in the clock of in_move. Leg 1 is in the lowest bits.
// Formats: words of BITS bits and roots u18.4, moved unchanged. Model: engine_rus.ik
`default_nettype none
module engine_rus_results #(
    parameter BITS = 36  // bits of the word of a leg (default 36: a cosine and a sine); those of an angle
) (
    input  wire              clk,
    input  wire              rst,
    input  wire              in_flags,
    input  wire [21:0]       in_root,
    input  wire              in_far,
    input  wire              in_near,
    input  wire              in_over,
    input  wire              in_move,
    input  wire              in_last,
    input  wire [BITS-1:0]   in_leg6,
    output reg               out_valid,
    input  wire              out_ready,
    output reg  [6*BITS-1:0] out_words,
    output reg  [131:0]      out_s,
    output reg  [5:0]        out_far,
    output wire [3:0]        out_status
);
    reg  [5*BITS-1:0] words;
    reg  [131:0]      s;
    reg  [5:0]        far, near, over, out_near, out_over;
    reg               whole;
    assign out_status = {1'b0, out_over != 0, out_near != 0, out_far != 0};
    always @(posedge clk) begin
        if (in_flags) begin
            s    <= {in_root, s[131:22]};
            far  <= {in_far, far[5:1]};
            near <= {in_near, near[5:1]};
            over <= {in_over, over[5:1]};
        end
        if (in_move)
            words <= {in_leg6, words[5*BITS-1:BITS]};
        if (!out_valid || out_ready) begin
            {out_words, out_s, out_far, out_near, out_over} <= {in_leg6, words, s, far, near, over};
            out_valid <= whole;
            whole     <= 1'b0;
        end
        if (in_move && in_last)
            whole <= 1'b1;
        if (rst) begin
            out_valid <= 1'b0;
            whole     <= 1'b0;
        end
    end
endmodule
`default_nettype wire
