// SPDX-License-Identifier: Apache-2.0
// Unsigned division with F extra fraction bits of the quotient, R digits a clock.
//   in_n * 2^F = out_q * in_d + out_r, 0 <= out_r < in_d
// Formats: in_n uWN.0, in_d uWD.0, out_q uWN.F, out_r exact. Error: truncation, 0 <= n/d - out_q < 1 LSB.
// in_d = 0: out_div_by_zero = 1, out_q all ones, out_r = in_n * 2^F mod 2^WD.
// Latency and II: ceil((WN + F) / R). The accepting clock does the first H digits from the ports.
// Model: arith.divide
`default_nettype none
module divide_iter #(
    parameter WN = 16,  // bits of the numerator, 1 or more, WN + F to 62; 16 is the library's word
    parameter WD = 16,  // bits of the divisor, 1 to 62; 16 is the library's word
    parameter F  = 0,   // further fraction bits of the quotient, 0 or more; 0: whole numbers
    parameter R  = 1    // digits a clock, 1 to WN + F - 1; 1, the smallest and the fastest clock
) (
    input  wire            clk,
    input  wire            rst,
    input  wire            in_valid,
    output wire            in_ready,
    input  wire [WN-1:0]   in_n,
    input  wire [WD-1:0]   in_d,
    output reg             out_valid,
    input  wire            out_ready,
    output wire [WN+F-1:0] out_q,
    output wire [WD-1:0]   out_r,
    output wire            out_div_by_zero
);
    localparam N = WN + F;                   // digits
    localparam M = R < 1 ? 0 : (N - 1) / R;  // steps after the accepting clock
    localparam H = N - M * R;                // digits of the accepting clock, 1 .. R
    localparam B = N < WD ? N : WD;          // bits of the remainder: of the last,
    localparam L = N-R < WD ? N-R : WD;      // before the last step
    localparam A = H < WD ? H : WD;          // and after the accepting clock

    generate
        if (WN < 1 || WD < 1 || F < 0 || WN + F > 62 || WD > 62 || R < 1 || R >= N) begin : g_illegal
            divide_iter_needs_WN_plus_F_and_WD_to_62_and_R_from_1_to_below_the_quotient_bits rule ();
        end
    endgenerate

    wire [N-1:0]   n = {in_n, {F{1'b0}}};
    reg  [WD-1:0]  d;
    reg  [B-1:0]   rem;
    reg  [N-1:0]   quotient;
    reg            zero;
    reg  [R*M-1:0] todo;  // bits to come: the next R on top, below them the others, which stay where they are
    reg  [M-1:0]   step;  // one-hot, M-1 down to 0
    reg            busy;

    wire           accept = in_valid && in_ready;
    wire [A-1:0]   head_rem;
    wire [H-1:0]   head_q;
    wire [B-1:0]   next_rem;
    wire [R-1:0]   next_q;

    divide_digits #(.K(0), .R(H), .WD(WD)) head (
        .in_rem(1'b0), .in_d(in_d), .in_bits(n[N-1 -: H]), .out_rem(head_rem), .out_q(head_q));
    divide_digits #(.K(N-R), .R(R), .WD(WD)) digits (
        .in_rem(rem[L-1:0]), .in_d(d), .in_bits(todo[R*M-1 -: R]), .out_rem(next_rem), .out_q(next_q));

    // selecting from words that stay costs far fewer cells than a load multiplexer on each bit of a shift register
    reg [R-1:0] select;
    integer g;
    always @* begin
        select = {R{1'b0}};
        for (g = 0; g < M - 1; g = g + 1)
            select = select | ({R{step[g+1]}} & todo[R*g +: R]);
    end

    always @(posedge clk) begin
        if (accept) begin
            d        <= in_d;
            zero     <= ~|in_d;
            rem      <= {{(B-A){1'b0}}, head_rem};
            quotient <= {{(N-H){1'b0}}, head_q};
            todo     <= n[R*M-1:0];
        end else if (busy) begin
            rem      <= next_rem;
            quotient <= {quotient[N-R-1:0], next_q};
            todo[R*M-1 -: R] <= select;
        end
    end

    assign in_ready = !busy && (!out_valid || out_ready);
    assign out_q = quotient;
    assign out_r = {{(WD-B){1'b0}}, rem};
    assign out_div_by_zero = zero;
    always @(posedge clk) begin
        step      <= {accept, {(M-1){1'b0}}} | step >> 1;
        busy      <= accept || (busy && !step[0]);
        out_valid <= step[0] || (out_valid && !out_ready);
        if (rst) begin
            step      <= {M{1'b0}};
            busy      <= 1'b0;
            out_valid <= 1'b0;
        end
    end
endmodule
`default_nettype wire
