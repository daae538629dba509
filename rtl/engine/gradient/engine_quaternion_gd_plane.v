// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of any number of joints in the plane by quaternion gradient descent: theta <- theta + alpha E J.
// in_op: 0 solve for (in_x, in_y) with links 1 to in_n, from the joints as they are; 1 load link in_n: length in_x,
// joint in_j; 2 set joint in_n to in_j; 3 read it. Links are first loaded in order from 1 on; a reset forgets them.
// Formats: angles of A bits, each relative to the link before; coordinates sQ(W-F).F, lengths uQ(W-F).F; cfg_alpha,
// cfg_shift by iterative.plane.config; cfg_tol, out_error in 1/256 LSB^2, with out_coarse in LSB^2; out_j: joint in_n,
// of a solution joint 1. Error: a converged tip is within sqrt(out_error+2) / 16 + (n + 1) / 90 + 3 sum / 2^(W+1) LSB,
// sum the length of n links. Latency 3; of a solution 4 + (3 in_n + 6 + 4 PIPE) a pass; II the same. Passes: out_iters
// + 1, and those that only change the range.
// Status: unreachable (in_n is 0 or no loaded link: nothing is done, out_j is 0), not converged (the limit was
// reached).
// Source: quaternion gradient paper, eqs. 18, 25, 31. Model: iterative.plane.gd
`default_nettype none
module engine_quaternion_gd_plane #(
    parameter W = 16,  // bits of a coordinate and of a length, 14 to 20 (default 16)
    parameter F = 8,   // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 24,  // bits of a joint word, 16 to 24 (default 24, 0.006 LSB at 2^14 LSB); a full turn is 2^A
    parameter N = 8,   // most links, 1 to 128 (default 8); up to 63 cost nothing but a bit of the error
    parameter PIPE = 0 // registers behind the products, 0 or 1 (default 0: fewest clocks); 1: a faster clock
) (
    input  wire           clk,
    input  wire           rst,
    input  wire [W:0]     cfg_alpha,
    input  wire [1:0]     cfg_shift,
    input  wire [21:0]    cfg_tol,
    input  wire [9:0]     cfg_limit,
    input  wire           in_valid,
    output wire           in_ready,
    input  wire [1:0]     in_op,
    input  wire [7:0]     in_n,
    input  wire signed [W-1:0] in_x,
    input  wire signed [W-1:0] in_y,
    input  wire [A-1:0]   in_j,
    output reg            out_valid,
    input  wire           out_ready,
    output wire [A-1:0]   out_j,
    output wire [9:0]     out_iters,
    output wire [2*W-1:0] out_error,
    output wire           out_coarse,
    output wire [3:0]     out_status
);
    generate
        if (W < 14 || W > 20 || F < 0 || F >= W || A < 16 || A > 24 || N < 1 || N > 128 || PIPE < 0
            || PIPE > 1) begin : g_illegal
            engine_quaternion_gd_plane_needs_W_14_to_20_and_F_below_W_and_A_16_to_24_and_N_to_128_and_PIPE_0_1 rule ();
        end
    endgenerate

    // Samples: the number of a link is checked one clock after the sample is accepted
    localparam I = N < 64 ? 6 : 8;  // bits of a link's number; fewer would not be put in a memory block
    reg           busy, check, answer, no_link;
    reg  [1:0]    op;
    reg  [7:0]    n;
    reg  [I-1:0]  loaded, link;
    wire          accept = in_valid && in_ready;
    wire          load = op == 2'd1, solving = op == 2'd0;
    wire [8:0]    there = {{(9-I){1'b0}}, loaded};
    wire          more = {1'b0, n} == there + 9'd1 && loaded != N[I-1:0];
    wire          ok = n != 8'd0 && ({1'b0, n} <= there || (load && more));
    wire          begins = check && ok && solving;
    wire          last = link == n[I-1:0];
    assign        in_ready = !busy && (!out_valid || out_ready);

    // Program
    wire [8:0] path_op;
    wire       store, place, next, step, read, stop, go, fits, base, range, halt;
    engine_gd_plane_program #(.PIPE(PIPE)) program_ (.clk(clk), .rst(rst), .in_start(begins), .in_last(last),
        .in_halt(halt), .out_op(path_op), .out_link({store, place, next, step, read}),
        .out_tail({stop, go, fits, base, range}));

    // Joints and links
    localparam K = W + 1, T = (W + 4) / 2;  // fraction bits of a sine, address bits of its table
    wire [2*K-T+19:0] chord;
    wire [W-1:0]      length;
    wire [A-1:0]      move;
    reg  [W-1:0]      x, y;
    engine_gd_joints #(.W(W), .A(A), .K(K), .T(T), .I(I)) chain (.clk(clk), .in_take(accept), .in_j(in_j),
        .in_link(link), .in_length(x), .in_load(check && ok && load), .in_set(check && ok && ^op),
        .in_read(read || answer), .in_step(step), .in_next(next), .in_place(place), .in_base(base || check),
        .in_move(move), .out_j(out_j), .out_length(length), .out_chord(chord));

    // Error and steps
    reg            first, fine, big, still;
    wire           fit;
    wire [2*W-1:0] s;
    engine_gd_plane_path #(.W(W), .A(A), .N(N), .K(K), .T(T), .I(I), .PIPE(PIPE)) path (.clk(clk),
        .cfg_alpha(cfg_alpha), .in_shift(cfg_shift), .in_fine(fine), .in_still(still), .in_clear(accept),
        .in_op(path_op), .in_first(first), .in_read(PIPE == 0 ? next || go : !read), .in_link(link), .in_store(store),
        .in_begin(go || check), .in_chord(chord), .in_length(length), .in_x(x), .in_y(y), .out_fits(fit),
        .out_move(move), .out_square(s));

    // End of a solution
    reg  [9:0] iters;
    reg        failed;
    wire       done = fine && s[2*W-1:22] == 0 && s[21:0] < cfg_tol;
    assign     halt = stop && (done || (iters == cfg_limit && !still));
    assign     out_iters = iters;
    assign     out_error = s;
    assign     out_coarse = !fine;
    assign     out_status = {failed, 2'b00, no_link};
    always @(posedge clk) begin
        if (accept) begin
            op <= in_op;
            n  <= in_n;
            x  <= in_x;
            y  <= in_y;
        end
        if (accept)
            link <= in_op == 2'd0 ? {I{1'b0}} : in_n[I-1:0];
        else if (base || (check && !ok))
            link <= {I{1'b0}};
        else if (next || go || begins)
            link <= link + 1'b1;
        if (check && load && more)
            loaded <= loaded + 1'b1;
        if (check)
            no_link <= !ok;
        // The first pass begins in the fine range and moves nothing
        if (accept || range)
            fine <= accept || !big;
        if (accept || range || fits)
            big <= fits && (!fit || big);
        if (accept || fits)
            still <= accept || (fine && (!fit || big));
        first <= accept || go || (first && !store);
        if (accept)
            iters <= 10'd0;
        else if (stop && !halt && !still)
            iters <= iters + 10'd1;
        if (accept || halt)
            failed <= !accept && !done;
        check     <= accept && !rst;
        answer    <= check && !begins && !rst;
        busy      <= (accept || (busy && !answer && !halt)) && !rst;
        out_valid <= (answer || halt || (out_valid && !out_ready)) && !rst;
        if (rst)
            loaded <= {I{1'b0}};
    end
endmodule
`default_nettype wire
