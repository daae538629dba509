// SPDX-License-Identifier: Apache-2.0
// Registers of the unit vectors that arm_solve gives coordinate by coordinate, as in unit_vectors. Joint 2 is also
// turned by a constant (elbow offset) and by joint 1 (elbow measured from the base).
//   in_kept, then in_turned: (c2, n2) is turned by (cfg_ce, cfg_ne), or with in_by1 by (c1, n1); in_sine chooses the
//   operands of the sine. With PIPE = 0 it is high with in_turned; with PIPE = 1 the operands come two clocks earlier.
//   With I above 20, too, one multiplier takes the product of c2 four clocks earlier, and with in_n2 that of n2 three
//   in_load: joints 1 and 3 are loaded from in_last_*, which they hold where they have no direction
// Formats: in_word s4.I, rounded to U fraction bits; cfg_ce, cfg_ne, out_c, out_n s2.U, joint 1 in the lowest bits.
// Error of a turn: less than 1 LSB of U by truncation, and 1 LSB times the sine, since ~n replaces -n. Reset sets
// joints 1 and 3 to (1, 0). Joint 2 is not reset: every sample writes it. Latency 1; of a turn 2, with PIPE = 1 4 or 7.
// Models: kernel_vector_solve.unit_word, arm.turn
`default_nettype none
module arm_vectors #(
    parameter U = 16,        // fraction bits of cosine and sine, 8 to 16, to I - 2 with I above 20 (default 16)
    parameter I = 20,        // fraction bits of in_word, 20, 22 or 26 (default 20)
    parameter ELBOW = 1,     // 1 (default): joint 2 is turned by the constant; 0: not
    parameter ABSOLUTE = 1,  // 1 (default): joint 2 is turned by joint 1; 0: not
    parameter PIPE = 0,      // 0 or 1 (default 0: fewest clocks); 1: registers in front of the products and behind them
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1, I above 20
) (
    input  wire                clk,
    input  wire                rst,
    input  wire signed [U+1:0] cfg_ce,
    input  wire signed [U+1:0] cfg_ne,
    input  wire [2:0]          in_cos,
    input  wire [2:0]          in_sin,
    input  wire [I+3:0]        in_word,
    input  wire                in_flat,
    input  wire                in_negative,
    input  wire                in_none,
    input  wire                in_sine,
    input  wire                in_n2,
    input  wire                in_by1,
    input  wire                in_kept,
    input  wire                in_turned,
    input  wire                in_load,
    input  wire [3*(U+2)-1:0]  in_last_c,
    input  wire [3*(U+2)-1:0]  in_last_n,
    output wire [3*(U+2)-1:0]  out_c,
    output wire [3*(U+2)-1:0]  out_n
);
    reg  signed [U+1:0] c1, n1, c2, n2, c3, n3;
    wire        [U+1:0] word = in_word[I+1:I-U];
    assign              out_c = {c3, c2, c1};
    assign              out_n = {n3, n2, n1};

    // The first clock computes c2 c - n2 n, which waits in kept; the second computes c2 n + n2 c
    localparam         BOTH = ELBOW && ABSOLUTE;
    wire               turn = ELBOW && !in_by1 || ABSOLUTE && in_by1;
    wire               by1 = BOTH ? in_by1 : ABSOLUTE != 0;
    wire signed [U+1:0] c = by1 ? c1 : cfg_ce, n = by1 ? n1 : cfg_ne;
    wire signed [U+1:0] right1 = in_sine ? n : c, right2 = in_sine ? c : ~n;
    wire signed [2*U+3:0] product1, product2;
    generate
        if (PIPE == 0) begin : g_now
            assign product1 = c2 * right1;
            assign product2 = n2 * right2;
        end else begin : g_registered
            reg signed [U+1:0] chosen1;
            if (I == 20) begin : g_short
                reg signed [U+1:0]   chosen2;
                reg signed [2*U+3:0] whole1, whole2;
                always @(posedge clk) begin
                    chosen1 <= right1;
                    chosen2 <= right2;
                    whole1 <= c2 * chosen1;
                    whole2 <= n2 * chosen2;
                end
                assign product1 = whole1;
                assign product2 = whole2;
            end else begin : g_in_turn
                reg  signed [U+1:0]   left;
                wire signed [2*U+3:0] whole;
                reg  signed [2*U+3:0] settled, settled_c2;
                product_parts #(.A(U+2), .B(U+2), .MULTIPLY(MULTIPLY)) multiplier (.clk(clk), .in_move(1'b1),
                    .in_a(left), .in_b(chosen1), .out_p(whole));
                always @(posedge clk) begin
                    left       <= in_n2 ? n2 : c2;
                    chosen1    <= in_n2 ? right2 : right1;
                    settled    <= whole;
                    settled_c2 <= settled;
                end
                assign product1 = settled_c2;
                assign product2 = settled;
            end
        end
    endgenerate
    wire        [U+2:0] sum = product1[2*U+1:U-1] + product2[2*U+1:U-1] + {{(U+2){1'b0}}, 1'b1};
    reg         [U+1:0] kept;
    wire               unused = &{1'b0, in_word, product1, product2, sum[0], in_by1, in_sine, in_n2, in_kept,
                                  in_turned, cfg_ce, cfg_ne, in_last_c, in_last_n};
    always @(posedge clk) begin
        if (in_load) begin
            {c3, c1} <= {in_last_c[2*(U+2) +: U+2], in_last_c[U+1:0]};
            {n3, n1} <= {in_last_n[2*(U+2) +: U+2], in_last_n[U+1:0]};
        end
        if (in_cos[0] && !in_none)
            c1 <= word;
        if (in_sin[0] && !in_none)
            n1 <= word;
        if (in_cos[2] && !in_none)
            c3 <= word;
        if (in_sin[2] && !in_none)
            n3 <= word;
        if (in_cos[1])
            c2 <= in_flat ? {in_negative, 1'b1, {U{1'b0}}} : word;
        if (in_sin[1])
            n2 <= word;
        if (turn && in_kept)
            kept <= sum[U+2:1];
        if (turn && in_turned) begin
            c2 <= kept;
            n2 <= sum[U+2:1];
        end
        if (rst) begin
            c1 <= {2'b01, {U{1'b0}}};
            n1 <= {(U+2){1'b0}};
            c3 <= {2'b01, {U{1'b0}}};
            n3 <= {(U+2){1'b0}};
        end
    end
endmodule
`default_nettype wire
