// SPDX-License-Identifier: Apache-2.0
// Unsigned division with F extra fraction bits of the quotient, a result a clock, R digits a stage.
//   in_n * 2^F = out_q * in_d + out_r, 0 <= out_r < in_d
// Formats: in_n uWN.0, in_d uWD.0, out_q uWN.F, out_r exact. Error: truncation, 0 <= n/d - out_q < 1 LSB.
// in_d = 0: out_div_by_zero = 1, out_q all ones, out_r = in_n * 2^F mod 2^WD.
// Latency: ceil((WN + F) / R); II 1. All stages stall together while a result waits.
// Model: arith.divide
`default_nettype none
module divide_pipe #(
    parameter WN = 16,  // bits of the numerator, 1 or more, WN + F to 62; 16 is the library's word
    parameter WD = 16,  // bits of the divisor, 1 to 62; 16 is the library's word
    parameter F  = 0,   // further fraction bits of the quotient, 0 or more; 0: whole numbers
    parameter R  = 1    // digits a stage, 1 to WN + F; 1, the fastest clock
) (
    input  wire            clk,
    input  wire            rst,
    input  wire            in_valid,
    output wire            in_ready,
    input  wire [WN-1:0]   in_n,
    input  wire [WD-1:0]   in_d,
    output wire            out_valid,
    input  wire            out_ready,
    output wire [WN+F-1:0] out_q,
    output wire [WD-1:0]   out_r,
    output wire            out_div_by_zero
);
    localparam N = WN + F;                   // digits
    localparam M = R < 1 ? 0 : (N - 1) / R;  // stages behind the first
    localparam H = N - M * R;                // digits of the first stage, 1 .. R
    localparam B = N < WD ? N : WD;          // bits of the last remainder

    wire [N-1:0] n = {in_n, {F{1'b0}}};
    reg  [M:0]   valid;
    assign out_valid = valid[M];
    assign in_ready = !out_valid || out_ready;
    always @(posedge clk)
        if (rst) valid <= {(M+1){1'b0}};
        else if (in_ready) valid <= valid << 1 | {{M{1'b0}}, in_valid};

    genvar s;
    generate
        if (WN < 1 || WD < 1 || F < 0 || WN + F > 62 || WD > 62 || R < 1 || R > N) begin : g_illegal
            divide_pipe_needs_WN_plus_F_and_WD_to_62_and_R_from_1_to_the_quotient_bits rule ();
        end
        for (s = 0; s <= M; s = s + 1) begin : g_stage
            localparam K = H + s * R;        // digits known behind this stage
            localparam A = K < WD ? K : WD;  // bits of its remainder
            reg  [A-1:0]  rem;
            reg  [N-1:0]  both;              // quotient bits enter below as numerator bits leave on top
            reg           zero;
            wire [A-1:0]  next_rem;
            if (s == 0) begin : g_head
                wire [H-1:0] q;
                divide_digits #(.K(0), .R(H), .WD(WD)) digits (
                    .in_rem(1'b0), .in_d(in_d), .in_bits(n[N-1 -: H]), .out_rem(next_rem), .out_q(q));
                always @(posedge clk) if (in_ready) begin
                    zero <= ~|in_d;
                    both <= n << H | {{(N-H){1'b0}}, q};
                end
            end else begin : g_digits
                wire [R-1:0] q;
                divide_digits #(.K(K-R), .R(R), .WD(WD)) digits (
                    .in_rem(g_stage[s-1].rem), .in_d(g_stage[s-1].g_d.d), .in_bits(g_stage[s-1].both[N-1 -: R]),
                    .out_rem(next_rem), .out_q(q));
                always @(posedge clk) if (in_ready) begin
                    zero <= g_stage[s-1].zero;
                    both <= {g_stage[s-1].both[N-R-1:0], q};
                end
            end
            always @(posedge clk) if (in_ready) rem <= next_rem;

            if (s < M) begin : g_d
                reg [WD-1:0] d;
                if (s == 0) begin : g_load
                    always @(posedge clk) if (in_ready) d <= in_d;
                end else begin : g_pass
                    always @(posedge clk) if (in_ready) d <= g_stage[s-1].g_d.d;
                end
            end
        end
    endgenerate
    assign out_q = g_stage[M].both;
    assign out_r = {{(WD-B){1'b0}}, g_stage[M].rem};
    assign out_div_by_zero = g_stage[M].zero;
endmodule
`default_nettype wire
