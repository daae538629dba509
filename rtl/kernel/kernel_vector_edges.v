// SPDX-License-Identifier: Apache-2.0
// What the third multiplier of a solver adds to its product, and the two status bits that margin and slack decide.
// Two lines of the schedule do not use their sum, so it makes the comparisons:
//   The slack is subtracted from c2. The target is out of reach where 1 or more is left: out_far.
//   The margin is added to k2 = L2 n2 against its sign. The elbow is near to singular where the sign changes: out_near.
// The first sum is that of c2 - 2, a word that has wrapped, or with PIPE = 1 that of c2.
// in_length: L1 is added next. in_edge: with in_cos2 the slack is subtracted next, otherwise the margin is added.
// in_root: n2 is read; in_flat: it is 0. in_load: a sample begins; in_axis, one clock later: it is within the margin
// of the axis of joint 3.
// Formats: cfg_margin LSB of a coordinate, cfg_slack 2^-14 of c2; out_addend and in_sum s18.4, out_minus is added too.
// Models: kernel_vector_solve.edges, rational.ik2
`default_nettype none
module kernel_vector_edges #(
    parameter MARGINS = 1,  // 0 or 1 (default 1); 0: out_far is in_clamped and out_near 0
    parameter PIPE = 0      // 0 or 1 (default 0), that of the kernel
) (
    input  wire        clk,
    input  wire        rst,
    input  wire [15:0] cfg_l1,
    input  wire [14:0] cfg_margin,
    input  wire [12:0] cfg_slack,
    input  wire        in_length,
    input  wire        in_edge,
    input  wire        in_cos2,
    input  wire        in_root,
    input  wire        in_elbow,
    input  wire        in_flat,
    input  wire        in_load,
    input  wire        in_axis,
    input  wire        in_beyond,
    input  wire        in_clamped,
    input  wire [21:0] in_sum,
    input  wire [3:0]  in_product,
    output wire [21:0] out_addend,
    output wire        out_minus,
    output wire        out_near,
    output wire        out_far
);
    reg [15:0] l1;
    generate
        if (MARGINS == 1) begin : g_margins
            reg         minus, side, load, slack, margin, much, far, near;
            wire        invert = in_cos2 || !side;
            wire [15:0] taken = !in_cos2 ? {1'b0, cfg_margin} : PIPE == 1 ? {3'd0, cfg_slack} : {1'b0, cfg_slack, 2'd0};
            wire        unused = &{1'b0, in_sum};
            assign      out_addend = {{2{minus}}, l1, {4{minus}}};
            assign      out_minus = minus;
            assign      out_near = near;
            assign      out_far = far;
            always @(posedge clk) begin
                l1     <= in_edge ? taken ^ {16{invert}} : cfg_l1;
                if (!in_length && !in_edge)
                    l1 <= 16'd0;
                minus  <= in_edge && invert;
                slack  <= in_edge && in_cos2;
                margin <= in_edge && !in_cos2;
                if (in_root)
                    side <= in_elbow && !in_flat;
                if (in_cos2)
                    much <= in_beyond || in_product != 4'd0;
                if (slack)
                    far <= in_clamped && (much || in_sum[PIPE == 1 ? 18 : 20]);
                if (margin && in_sum[21] != in_product[3])
                    near <= 1'b1;
                load <= !rst && in_load;
                if (load)
                    near <= in_axis;
            end
        end else begin : g_none
            wire   unused = &{1'b0, rst, cfg_margin, cfg_slack, in_cos2, in_root, in_elbow, in_flat, in_load, in_axis,
                              in_beyond, in_sum, in_product};
            assign out_addend = {2'd0, l1, 4'd0};
            assign {out_minus, out_near} = 2'b00;
            assign out_far = in_clamped;
            always @(posedge clk) begin
                l1 <= cfg_l1;
                if (!in_length || in_edge)
                    l1 <= 16'd0;
            end
        end
    endgenerate
endmodule
`default_nettype wire
