// SPDX-License-Identifier: Apache-2.0
// Every joint position of a chain of any number of links, streamed from the base: a link in, a position out.
//   (x, y) <- (x, y) + L (cos j, sin j) with j the sum of the joint words so far; in_last ends a chain
//   SPACE = 1: (x, y, z) <- (x, y, z) + L (cos j cos j0, cos j sin j0, sin j), j0, the yaw, the first word of the chain
// Formats: in_j1 angle of A bits; in_l uQ(W-F).F; out_x ... out_z sQ(W-F).F, rounded to nearest and saturated; the sums
// are not.
// Error of a coordinate after k links, R = L1 + ... + Lk LSB, W = 16: 0.57 + 1.63 R / 2^16 LSB; in space z 0.54 + 1.06
// R / 2^16, x and y 0.60 + 2.11 R / 2^16. Latency 3 and II 2 a link, in space 6 and 3; at PIPE = 1 latency 6
// and 10.
// Status: overflow (a coordinate was saturated, or the chain has more than N links; one beyond the N-th does not
// count).
// Source: rational trigonometry paper, section IV-D, from joint words. Model: chain.table_chain
`default_nettype none
module table_chain #(
    parameter SPACE = 0,     // 1: in space, the first word of a chain is its yaw; 0: planar, out_z is 0 (default 0)
    parameter W = 16,        // bits of a coordinate and of a length, 15 to 24 (default 16)
    parameter F = 8,         // fraction bits of both, 0 to W - 1 (default 8); they change no logic
    parameter A = 18,        // bits of a joint word, 10 to 24, W / 2 or more (default 18); a full turn is 2^A
    parameter N = 32,        // links of a chain without its yaw, 2 to 64 (default 32)
    parameter PIPE = 0,      // registers behind table and products, 0 or 1 (default 0: fewest clocks)
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire [A-1:0]        in_j1,
    input  wire [W-1:0]        in_l,
    input  wire                in_last,
    output wire                out_valid,
    input  wire                out_ready,
    output wire signed [W-1:0] out_x,
    output wire signed [W-1:0] out_y,
    output wire signed [W-1:0] out_z,
    output wire                out_last,
    output wire [3:0]          out_status
);
    generate
        if (SPACE < 0 || SPACE > 1 || W < 15 || W > 24 || F < 0 || F >= W || A < 10 || 2 * A < W || A > 24 || N < 2
            || N > 64 || PIPE < 0 || PIPE > 1 || MULTIPLY < 18 || MULTIPLY > 27
            || MULTIPLY % 9 != 0) begin : g_illegal
            table_chain_needs_W_15_to_24_F_below_W_A_10_to_24_half_W_N_2_to_64_SPACE_PIPE_0_1_MULTIPLY_18_27 rule ();
        end
    endgenerate

    localparam K = W + 1;  // fraction bits of a root
    localparam C = W > 20 ? (W - 1) / 2 : (W + 3) / 2 + (SPACE > 0 ? 1 : 0);
    localparam T = A < C + 1 ? A - 1 : C;  // address bits of the sine table

    wire [A-1:0]      word;  // sum of the joint words of the chain
    wire              read, kept, cosine, overflow;
    wire [2*K-T+19+15*(K>21):0] chord;
    assign            out_status = {1'b0, overflow, 2'b00};
    angle_chord #(.A(A), .K(K), .T(T)) codec (.clk(clk), .in_read(read), .in_keep(kept), .in_cos(cosine), .in_j(word),
        .out_chord(chord));
    reg  [A-1:0]      base;
    wire [A-1:0]      next = base + in_j1;
    generate
        if (SPACE == 0) begin : g_plane
            reg  [T-1:0] upper;
            assign       word = {kept ? upper : next[A-1:A-T], next[A-T-1:0]};
            assign       cosine = !kept;
            assign       out_z = {W{1'b0}};
            always @(posedge clk) begin
                if (!kept)
                    upper <= next[A-1:A-T];
                if (in_valid && in_ready)
                    base <= next;
                if (rst || (in_valid && in_ready && in_last))
                    base <= {A{1'b0}};
            end
            kernel_link_sum #(.W(W), .K(K), .T(T), .N(N), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (.clk(clk),
                .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_read(read), .out_kept(kept),
                .in_chord(chord), .in_l(in_l), .in_last(in_last), .out_valid(out_valid), .out_ready(out_ready),
                .out_x(out_x), .out_y(out_y), .out_last(out_last), .out_overflow(overflow));
        end else begin : g_space
            wire   restart;
            assign word = base;
            assign kept = 1'b0;
            always @(posedge clk) begin
                if (in_valid && in_ready)
                    base <= next;
                if (rst || restart)
                    base <= {A{1'b0}};
            end
            kernel_link_space #(.W(W), .K(K), .T(T), .N(N), .PIPE(PIPE), .MULTIPLY(MULTIPLY)) kernel (.clk(clk),
                .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_read(read), .out_cos(cosine),
                .out_end(restart), .in_chord(chord), .in_l(in_l), .in_last(in_last), .out_valid(out_valid),
                .out_ready(out_ready), .out_x(out_x), .out_y(out_y), .out_z(out_z), .out_last(out_last),
                .out_overflow(overflow));
        end
    endgenerate
endmodule
`default_nettype wire
