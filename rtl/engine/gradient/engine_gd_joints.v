// SPDX-License-Identifier: Apache-2.0
// Joints and link lengths of a planar chain, in memory blocks, and the sine and cosine segments of the angle of each
// link. That angle is the sum of the joints from the base on. Number 0 is a joint that stays 0. in_take loads in_j; in
// the next clock in_set writes it to joint in_link, and in_load writes in_length to its length. in_read reads joint
// in_link to out_j, and its length. In the next clock in_step adds in_move to the joint. In the clock after that
// in_next stores it and reads the sine's segment; the clock after reads the cosine's. in_place copies the length that
// was read to out_length; in_base sets the angle of the chain to 0.
// Formats: angles of A bits; lengths of W bits; segments {knot, step, offset} of angle_chord. Exact. Latency: one clock
// for each operation. Model: iterative.plane.gd
`default_nettype none
module engine_gd_joints #(
    parameter W = 16,  // bits of a length, 14 to 20 (default 16)
    parameter A = 24,  // bits of a joint word, 16 to 24 (default 24)
    parameter K = 17,  // fraction bits of a sine or cosine: W + 1
    parameter T = 10,  // address bits of the sine table; a segment's step has K - T + 4 bits
    parameter I = 6    // bits of a link's number, 6 to 8 (default 6)
) (
    input  wire              clk,
    input  wire              in_take,
    input  wire [A-1:0]      in_j,
    input  wire [I-1:0]      in_link,
    input  wire [W-1:0]      in_length,
    input  wire              in_load,
    input  wire              in_set,
    input  wire              in_read,
    input  wire              in_step,
    input  wire              in_next,
    input  wire              in_place,    // copies the length to out_length
    input  wire              in_base,     // sets the angle of the chain to that of the base, 0
    input  wire [A-1:0]      in_move,
    output reg  [A-1:0]      out_j,
    output reg  [W-1:0]      out_length,  // held until the next in_place
    output wire [2*K-T+19:0] out_chord
);
    reg  [A-1:0] joints[0:(1<<I)-1];
    reg  [W-1:0] lengths[0:(1<<I)-1];
    initial
        joints[0] = {A{1'b0}};

    reg  [W-1:0] length;
    reg  [A-1:0] moved, turn;           // moved joint, 0 except one clock after in_step or in_take; angle of the link
    wire [A-1:0] angle = turn + moved;
    angle_chord #(.A(A), .K(K), .T(T)) codec (.clk(clk), .in_read(1'b1), .in_keep(1'b0), .in_cos(!in_next),
        .in_j(angle), .out_chord(out_chord));
    always @(posedge clk) begin
        if (in_read) begin
            out_j  <= joints[in_link];
            length <= lengths[in_link];
        end
        if (in_next || in_set)
            joints[in_link] <= moved;
        if (in_load)
            lengths[in_link] <= in_length;
        if (in_place)
            out_length <= length;
        moved <= in_take ? in_j : out_j + in_move;
        if (!in_take && !in_step)
            moved <= {A{1'b0}};
        turn <= in_base ? {A{1'b0}} : angle;
    end
endmodule
`default_nettype wire
