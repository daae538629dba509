// SPDX-License-Identifier: Apache-2.0
// Margin and slack of arm_solve_wide, as kernel_vector_edges has them for shorter words: the target is out of reach
// where c2 less the slack is 1 or more, and the elbow is near to singular where k2 less the margin has another sign.
//   in_root, in_bent: n2 is negative where the root of 1 - c2^2 is read. in_load: in_k2 is new in the next clock
//   in_cos2: c2 is in_above, and negative, 2 or more, or farther out of reach with in_much
//   in_axis: near to the axis of joint 3. in_clamped: out of reach without the slack
// Formats: cfg_margin u(N-1).0; cfg_slack u0.(N-2); in_k2 s(N+2).0; in_above u0.(N-2). With MARGINS = 0 out_near is 0
// and out_far is in_clamped. Error: none. Latency 1 after in_load and in_cos2. Model: arm.ik3
`default_nettype none
module arm_edges_wide #(
    parameter N = 20,      // bits of a coordinate, 20 or 24 (default 20)
    parameter MARGINS = 0  // 0 or 1 (default 0); 1: cfg_margin and cfg_slack are used
) (
    input  wire         clk,
    input  wire [N-2:0] cfg_margin,
    input  wire [N-4:0] cfg_slack,
    input  wire         in_root,
    input  wire         in_bent,
    input  wire         in_axis,
    input  wire         in_load,
    input  wire [N+1:0] in_k2,
    input  wire         in_cos2,
    input  wire [N-3:0] in_above,
    input  wire         in_much,
    input  wire         in_clamped,
    output wire         out_near,
    output wire         out_far
);
    generate
        if (MARGINS == 1) begin : g_margins
            reg          side;   // n2 is negative
            reg          loaded; // k2 is new
            reg          much;   // as in_much
            reg  [N-3:0] above;  // as in_above
            reg          close, away;
            wire [N+1:0] left_over = in_k2 + ({3'd0, cfg_margin} ^ {(N+2){!side}}) + {{(N+1){1'b0}}, !side};
            assign       out_near = close;
            assign       out_far = away;
            always @(posedge clk) begin
                if (in_root)
                    side <= in_bent;
                loaded <= in_load;
                if (loaded)
                    close <= in_axis || left_over[N+1] != in_k2[N+1];
                if (in_cos2) begin
                    above <= in_above;
                    much  <= in_much;
                end
                away <= in_clamped && (much || above >= {1'b0, cfg_slack});
            end
        end else begin : g_none
            wire   unused = &{1'b0, clk, cfg_margin, cfg_slack, in_root, in_bent, in_axis, in_load, in_k2, in_cos2,
                              in_above, in_much};
            assign out_near = 1'b0;
            assign out_far = in_clamped;
        end
    endgenerate
endmodule
`default_nettype wire
