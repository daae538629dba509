// SPDX-License-Identifier: Apache-2.0
// Axes x, y, z of a machine tool with five axes, from a point of the workpiece and the directions of its two rotary
// axes: a table that turns by C about z, on one that tilts by B about y.
//   t = cc (x - xr) - nc (y - yr) - d, h = z - zs: x' = cb t + nb h + d + xr, y' = nc (x - xr) + cc (y - yr) + yr,
//   z' = cb h - nb t + zs
// Formats: in_cb, in_nb, in_cc, in_nc cosine and sine of B and C, s2.U; coordinates and cfg_* s(W-F).F, cfg_* by
// tool.config; results rounded to nearest (ties upward), saturated.
// Error of a coordinate, in LSB: bounds.tool.coordinate, 1/2 + 4 2^(W-25) and what the lengths of the vectors do.
// Latency and II: 21. Status: overflow (a coordinate was saturated).
// Source: LinuxCNC, kinematics xyzbc-trt. Model: tool.xyzbc
`default_nettype none
module vector_xyzbc #(
    parameter W = 20,   // bits of a coordinate, 4 to 22 (default 20)
    parameter F = 10,   // fraction bits of a coordinate, 0 to W - 1 (default 10); they change no logic
    parameter U = 20,   // fraction bits of a unit vector, 8 to 24 (default 20)
    parameter PIPE = 0  // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [W-1:0] cfg_xr,
    input  wire signed [W-1:0] cfg_yr,
    input  wire signed [W-1:0] cfg_d,
    input  wire signed [W-1:0] cfg_zs,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_cb,
    input  wire signed [U+1:0] in_nb,
    input  wire signed [U+1:0] in_cc,
    input  wire signed [U+1:0] in_nc,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire signed [W-1:0] in_z,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire [3:0]          out_status
);
    generate
        if (W < 4 || W > 22 || F < 0 || F >= W || U < 8 || U > 24 || PIPE < 0 || PIPE > 2) begin : g_illegal
            vector_xyzbc_needs_W_from_4_to_22_and_F_below_W_and_U_from_8_to_24_and_PIPE_from_0_to_2 rule ();
        end
    endgenerate

    wire        idle, done, over;
    wire        accept = in_valid && in_ready;
    wire [46:0] op;
    wire [26:0] port, word;
    wire [5:0]  dest;
    assign      in_ready = idle && (!out_valid || out_ready);
    vector_xyzbc_program #(.PIPE(PIPE)) control (.clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_done(done), .out_op(op));

    // The ports as 27-bit words of the product engine
    reg  [4*U+7:0]   vectors;
    reg  [3*W-1:0]   point;
    wire [7*W-1:0]   places = {cfg_zs, cfg_d, cfg_yr, cfg_xr, point};
    wire [12*27-1:0] words;
    assign           words[11*27 +: 27] = 27'h2000000;
    genvar i;
    generate
        for (i = 0; i < 4; i = i + 1) begin : g_vector
            assign words[27*i +: 27] = {vectors[(U+2)*i +: U+2], {(25-U){1'b0}}};
        end
        for (i = 0; i < 7; i = i + 1) begin : g_place
            assign words[27*(4+i) +: 27] = {{2{places[W*i+W-1]}}, places[W*i +: W], {(25-W){1'b0}}};
        end
    endgenerate
    engine_ports #(.COUNT(12)) operands (.clk(clk), .in_words(words), .in_select(op[43:39]), .out_word(port));
    /* verilator lint_off PINCONNECTEMPTY */
    product_engine #(.PIPE(PIPE), .ROOTS(0)) engine (.clk(clk), .rst(rst), .in_start(accept), .in_run(!idle),
        .in_op(op), .in_port(port), .in_signs(3'd0), .out_word(word), .out_dest(dest), .out_status());
    /* verilator lint_on PINCONNECTEMPTY */
    engine_saturated #(.COUNT(3), .FIRST(2), .W(W), .FINE(0)) axes (.clk(clk), .in_start(accept), .in_word(word),
        .in_dest(dest), .out_words({out_z, out_y, out_x}), .out_over(over));
    assign out_status = {1'b0, over, 2'd0};
    always @(posedge clk) begin
        if (accept) begin
            vectors <= {in_nc, in_cc, in_nb, in_cb};
            point   <= {in_z, in_y, in_x};
        end
        out_valid <= !rst && (done || out_valid && !out_ready);
    end
endmodule
`default_nettype wire
