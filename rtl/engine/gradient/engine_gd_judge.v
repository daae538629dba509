// SPDX-License-Identifier: Apache-2.0
// End of a sample of a gradient engine: it holds the range of the error and counts the steps. A sample begins in the
// fine range. A pass whose square is too wide for it does not count and is repeated in the coarse range. Only the fine
// range can converge, so a saturated square is never called converged. out_halt, in the clock of in_stop, ends the
// sample: the square is below cfg_tol, or the limit is reached. out_failed: the limit came first. The answer waits in
// out_valid. Formats: cfg_tol and in_square in 1/256 LSB^2, in the coarse range in LSB^2. Exact. Model:
// iterative.fixed.gd
`default_nettype none
module engine_gd_judge #(
    parameter W = 16  // bits of a coordinate, 14 to 20 (default 16); a square has 2 W
) (
    input  wire           clk,
    input  wire           rst,
    input  wire [21:0]    cfg_tol,
    input  wire [9:0]     cfg_limit,
    input  wire           in_start,   // a sample is accepted
    input  wire           in_stop,    // the square is complete: decide
    input  wire           in_step,    // the pass ends here, unless out_halt
    input  wire [2*W-1:0] in_square,
    input  wire           out_ready,
    output reg            out_fine,   // the range is fine
    output wire           out_wide,   // the square may be saturated: the pass does not count
    output wire           out_halt,   // the answer is complete
    output reg            out_valid,
    output reg  [9:0]     out_iters,
    output reg            out_failed
);
    wire   done = out_fine && in_square[2*W-1:22] == 0 && in_square[21:0] < cfg_tol;
    assign out_wide = out_fine && in_square[2*W-1:2*W-3] != 0;
    assign out_halt = in_stop && (done || (out_iters == cfg_limit && !out_wide));
    always @(posedge clk) begin
        if (in_start) begin
            out_fine  <= 1'b1;
            out_iters <= 10'd0;
        end else if (in_step && !out_halt) begin
            out_fine  <= !out_wide && (out_fine || in_square[2*W-1:2*W-13] == 0);
            out_iters <= out_iters + {9'd0, !out_wide};
        end
        if (out_halt)
            out_failed <= !done;
        out_valid <= !rst && (out_halt || (out_valid && !out_ready));
    end
endmodule
`default_nettype wire
