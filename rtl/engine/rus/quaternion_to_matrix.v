// SPDX-License-Identifier: Apache-2.0
// Rotation matrix of a unit quaternion, for engine_rus_ik, by products only.
//   r_ii = 1 - 2 (q_j^2 + q_k^2), r_ij = 2 (q_i q_j - w q_k), r_ji = 2 (q_i q_j + w q_k), i, j, k cyclic
// Formats: in_w, in_x, in_y, in_z, out_r s2.U (1.0 is 2^U), rounded after products truncated to an eighth of an LSB.
// Error of an entry: 5/8 LSB for the given words; a length of 1 + e scales all but the 1 of the diagonal by 1 + 2 e.
// Latency and II 9; 10 at PIPE = 1.
// Status: singular (w^2 + x^2 + y^2 + z^2, which is formed to half a unit, is not within 2^-9 of 1, below U = 11 within
// 4 units of 2^-U: the last matrix is held, the unit matrix after reset).
// Source: the definition. Model: engine_rus.quaternion_to_matrix
`default_nettype none
module quaternion_to_matrix #(
    parameter U = 16,   // fraction bits, 8 to 16 (default 16, for engine_rus_ik)
    parameter PIPE = 0  // registers behind the products, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_w, in_x, in_y, in_z,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire signed [U+1:0] out_r11, out_r12, out_r13, out_r21, out_r22, out_r23, out_r31, out_r32, out_r33,
    output wire [3:0]          out_status
);
    generate
        if (U < 8 || U > 16 || PIPE < 0 || PIPE > 1) begin : g_illegal
            quaternion_to_matrix_needs_U_from_8_to_16_and_PIPE_0_or_1 rule ();
        end
    endgenerate
    // Schedule, a clock a line; at PIPE = 1 the sums of a line follow in the next clock, the last ones in an empty line
    localparam [4:0]
        FIRST = 5'b00001,  // w^2 + x^2
        UNIT  = 5'b00010,  // y^2 + z^2 besides
        PAIR  = 5'b00100,  // two entries, then x, y, z <- y, z, x
        DIAG  = 5'b01000,  // an entry of the diagonal
        LAST  = 5'b10000;  // all entries are valid in the next clock
    localparam [8*5-1:0] TURN = {
        /* length       */ FIRST,
        /* and its rest */ UNIT,
        /* r12, r21     */ PAIR,
        /* r22          */ DIAG,
        /* r23, r32     */ PAIR,
        /* r33          */ DIAG,
        /* r31, r13     */ PAIR,
        /* r11          */ DIAG | LAST};
    wire idle, diag, pair, rest, first;  // the factors of this clock
    wire last, diag_sum, pair_sum;       // its sums: at PIPE = 1 those of the factors of the clock before
    wire accept = in_valid && in_ready;

    // Two products with U + 4 fraction bits; their sum and difference, with half an LSB of an entry for rounding
    reg  signed [U+1:0]   w, x, y, z;
    wire                  squares;  // y^2 and z^2
    wire signed [U+1:0]   al = squares ? y : x, ar = first ? x : y, bl = squares ? z : w, br = first ? w : z;
    wire signed [2*U+3:0] a, b;
    wire signed [U+8:0]   plus = {a[2*U+3], a[2*U+3:U-4]} + {b[2*U+3], b[2*U+3:U-4]} + 4;
    wire signed [U+8:0]   minus = {a[2*U+3], a[2*U+3:U-4]} - {b[2*U+3], b[2*U+3:U-4]} + 4;
    reg  [U+8:0]          total;
    wire [U+8:0]          length = total + plus;
    // A unit quaternion rounded to words has |q|^2 within 2 + 2^-U units of 1, and the sum is up to half a unit more.
    localparam LOW = U > 11 ? U - 5 : 6;  // lowest bit that must agree: that of 2^-9 or, where greater, of 4 units
    wire [U+8-LOW:0]      high;
    wire                  is_one = high == {5'd1, {U+4-LOW{1'b0}}} || high == {5'd0, {U+4-LOW{1'b1}}};
    wire                  unit;
    wire                  unused = &{1'b0, a, b, plus, minus, length, total};
    generate
        if (PIPE == 0) begin : g_small
            reg    kept;
            assign unit = kept;
            assign high = length[U+8:LOW];
            assign a = al * ar, b = bl * br;
            assign squares = rest || diag;
            assign {diag_sum, pair_sum} = {diag, pair};
            always @(posedge clk) begin
                if (first)
                    total <= plus;
                if (rest)
                    kept <= is_one;
            end
            schedule #(.LINES(8), .BITS(5), .TABLE(TURN)) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op({last, diag, pair, rest, first}));
        end else begin : g_fast
            reg        swap;
            reg  [4:0] late;
            wire       ended, rest_sum, first_sum;
            assign     unit = is_one;  // total stays until the next sample is accepted
            assign     high = total[U+8:LOW];
            assign     squares = swap;
            assign     {last, diag_sum, pair_sum, rest_sum, first_sum} = late;
            always @(posedge clk) begin
                swap   <= first || pair;
                late   <= rst ? 5'd0 : {ended, diag, pair, rest, first};
                if (first_sum || rest_sum)
                    total <= length;
                if (accept)
                    total <= {U+9{1'b0}};
            end
            product_parts #(.A(U+2), .B(U+2)) product1 (.clk(clk), .in_move(1'b1), .in_a(al), .in_b(ar), .out_p(a));
            product_parts #(.A(U+2), .B(U+2)) product2 (.clk(clk), .in_move(1'b1), .in_a(bl), .in_b(br), .out_p(b));
            schedule #(.LINES(9), .BITS(5), .TABLE({TURN, 5'd0})) control (
                .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle), .out_op({ended, diag, pair, rest, first}));
        end
    endgenerate

    // Entries are shifted in: of the diagonal 2, 3, 1; beside it 12, 23, 31 and 21, 32, 13
    reg  [3*U+5:0] middle, upper, lower;
    assign {out_r11, out_r33, out_r22} = middle;
    assign {out_r31, out_r23, out_r12} = upper;
    assign {out_r13, out_r32, out_r21} = lower;
    assign in_ready = idle && (!out_valid || out_ready);
    assign out_status = {2'd0, !unit, 1'b0};
    localparam [U+1:0]   ONE = {2'b01, {U{1'b0}}};
    localparam [3*U+5:0] NONE = {3*U+6{1'b0}};
    always @(posedge clk) begin
        if (accept)
            {w, x, y, z} <= {in_w, in_x, in_y, in_z};
        if (pair)
            {x, y, z} <= {y, z, x};
        if (pair_sum && unit) begin
            upper <= {minus[U+4:3], upper[3*U+5:U+2]};
            lower <= {plus[U+4:3], lower[3*U+5:U+2]};
        end
        if (diag_sum && unit)
            middle <= {ONE - plus[U+4:3], middle[3*U+5:U+2]};
        out_valid <= last || (out_valid && !out_ready);
        if (rst) begin
            out_valid <= 1'b0;
            middle    <= {3{ONE}};
            upper     <= NONE;
            lower     <= NONE;
        end
    end
endmodule
`default_nettype wire
