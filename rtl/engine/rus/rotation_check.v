// SPDX-License-Identifier: Apache-2.0
// Tests whether a matrix is a rotation and passes its nine words on, for engine_rus_ik, which accepts any matrix.
//   |a|^2 = |b|^2 = 1, a . b = 0, a x b = c of the columns a, b, c, each to 16 units of 2^-U
// Formats: in_r, out_r s2.U (1.0 is 2^U), unchanged. Sums are exact, but the i-th of a x b - c, i, j, k cyclic, is less
// by b_j 2^-U, because the one's complement of a_k is multiplied where a_k b_j is subtracted.
// Error: a matrix that passes is within bounds.engine.rotation_apart of a rotation. Latency 27, II 27.
// Status: no rotation (one of the six sums is off by 16 units or more; the words pass all the same).
// Source: the definition. Model: engine_rus.rotation_check
`default_nettype none
module rotation_check #(
    parameter U = 16  // fraction bits, 8 to 16 (default 16, for engine_rus_ik)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire signed [U+1:0] in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33,
    output reg                 out_valid,
    input  wire                out_ready,
    output reg  signed [U+1:0] out_r11, out_r12, out_r13, out_r21, out_r22, out_r23, out_r31, out_r32, out_r33,
    output wire [3:0]          out_status
);
    generate
        if (U < 8 || U > 16) begin : g_illegal
            rotation_check_needs_U_from_8_to_16 rule ();
        end
    endgenerate
    // Schedule, a clock a line
    localparam [1:0]          // row of columns a and c
        A1    = 2'd0,         // the first
        A2    = 2'd1,         // the second sum
        A3    = 2'd2;         // the third
    localparam [1:0]          // row of column b
        B1    = 2'd0,         // the first
        B2    = 2'd1,         // the second sum
        B3    = 2'd2;         // the third
    localparam [4:0]          // factors of the next clock's product
        AA    = 5'b00010,     // a a
        AB    = 5'b00001,     // a b
        BB    = 5'b10001,     // b b
        LESS  = 5'b01001,     // -a b, by the one's complement of a
        C     = 5'b00100;     // -c
    localparam [3:0]          // sum
        START = 4'b0000,      // nothing yet
        ADD   = 4'b0000,      // products, two clocks behind their factors
        CLEAR = 4'b0001,      // the first sum begins with the next clock
        ONE   = 4'b0111,      // must be 1; the next sum begins
        ZERO  = 4'b0011,      // must be 0; the next sum begins
        LAST  = 4'b1011;      // must be 0; the answer is valid in the next clock
    localparam [26*13-1:0] CHECK = {
        /* length of a   */ {A1, B1, AA, START},
        /*               */ {A2, B1, AA, CLEAR},
        /*               */ {A3, B1, AA, ADD},
        /* -             */ {A1, B1, AA, ADD},
        /* length of b   */ {A1, B1, BB, ADD},
        /* a             */ {A1, B2, BB, ONE},
        /*               */ {A1, B3, BB, ADD},
        /* -             */ {A1, B1, AA, ADD},
        /* right angle   */ {A1, B1, AB, ADD},
        /* b             */ {A2, B2, AB, ONE},
        /*               */ {A3, B3, AB, ADD},
        /* -             */ {A1, B1, AA, ADD},
        /* c3            */ {A1, B2, AB, ADD},
        /* angle         */ {A2, B1, LESS, ZERO},
        /*               */ {A3, B1, C, ADD},
        /* -             */ {A1, B1, AA, ADD},
        /* c1            */ {A2, B3, AB, ADD},
        /* c3            */ {A3, B2, LESS, ZERO},
        /*               */ {A1, B1, C, ADD},
        /* -             */ {A1, B1, AA, ADD},
        /* c2            */ {A3, B1, AB, ADD},
        /* c1            */ {A1, B3, LESS, ZERO},
        /*               */ {A2, B1, C, ADD},
        /* -             */ {A1, B1, AA, ADD},
        /* -             */ {A1, B1, AA, ADD},
        /* c2            */ {A1, B1, AA, LAST}};
    wire       idle, left_b, less, by_c, right_a, right_b, last, to_one, test, clear;
    wire [1:0] i, j;
    wire       accept = in_valid && in_ready;
    schedule #(.LINES(26), .BITS(13), .TABLE(CHECK)) control (
        .clk(clk), .rst(rst), .in_start(accept), .out_idle(idle),
        .out_op({i, j, left_b, less, by_c, right_a, right_b, last, to_one, test, clear}));

    wire [U+1:0]          a = i[1] ? out_r31 : i[0] ? out_r21 : out_r11;
    wire [U+1:0]          b = j[1] ? out_r32 : j[0] ? out_r22 : out_r12;
    wire [U+1:0]          c = i[1] ? out_r33 : i[0] ? out_r23 : out_r13;
    reg  signed [U+1:0]   left, right;
    reg  signed [2*U+3:0] product;
    reg  signed [2*U+4:0] sum;  // of three products below 4; in a difference one is -c, below 2
    wire [U:0]            high = sum[2*U+4:U+4];  // bits that 16 units do not reach
    wire                  off = to_one ? high != {5'd1, {U-4{1'b0}}} && high != {5'd0, {U-4{1'b1}}}
                                       : high != 0 && high != {U+1{1'b1}};
    reg                   wrong;
    assign in_ready = idle && (!out_valid || out_ready);
    assign out_status = {wrong, 3'd0};
    always @(posedge clk) begin
        if (accept)
            {out_r11, out_r12, out_r13, out_r21, out_r22, out_r23, out_r31, out_r32, out_r33}
                <= {in_r11, in_r12, in_r13, in_r21, in_r22, in_r23, in_r31, in_r32, in_r33};
        left    <= left_b ? b : by_c ? c : a ^ {U+2{less}};
        right   <= (a & {U+2{right_a}}) | (b & {U+2{right_b}}) | {{2{by_c}}, {U{1'b0}}};
        product <= left * right;
        sum     <= clear ? {2*U+5{1'b0}} : sum + {product[2*U+3], product};
        if (clear)
            wrong <= test && (off || wrong);
        out_valid <= last || (out_valid && !out_ready);
        if (rst)
            out_valid <= 1'b0;
    end
endmodule
`default_nettype wire
