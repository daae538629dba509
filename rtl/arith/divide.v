// SPDX-License-Identifier: Apache-2.0
// Unsigned division with F extra fraction bits of the quotient; MODE 0 reuses R digit rows, MODE 1 pipelines them all.
//   in_n * 2^F = out_q * in_d + out_r, 0 <= out_r < in_d
// Formats: in_n uWN.0, in_d uWD.0, out_q uWN.F, out_r exact. Error: truncation, 0 <= n/d - out_q < 1 LSB.
// in_d = 0: out_div_by_zero = 1, out_q all ones, out_r = in_n * 2^F mod 2^WD.
// Latency: ceil((WN + F) / R). The first H digits come from the ports, in the accepting clock.
// II: the latency in MODE 0, 1 in MODE 1, whose stages stall together while a result waits.
// Model: arith.divide
`default_nettype none
module divide #(
    parameter MODE = 0,   // 0: iterative, 1: pipelined (default 0)
    parameter WN   = 16,  // bits of the numerator, 1 or more, WN + F to 62 (default 16)
    parameter WD   = 16,  // bits of the divisor, 1 to 62 (default 16)
    parameter F    = 0,   // further fraction bits of the quotient, 0 or more (default 0)
    parameter R    = 1    // digits a clock or a stage, 1 to WN + F, below that in MODE 0 (default 1, the fastest clock)
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
    localparam M = R < 1 ? 0 : (N - 1) / R;  // steps or stages after the first
    localparam H = N - M * R;                // digits of the first, 1 .. R
    localparam B = N < WD ? N : WD;          // bits of the remainder: of the last,
    localparam L = N-R < WD ? N-R : WD;      // before the last step
    localparam A = H < WD ? H : WD;          // and after the first

    wire [N-1:0] n = {in_n, {F{1'b0}}};
    wire [A-1:0] head_rem;
    wire [H-1:0] head_q;
    divide_digits #(.K(0), .R(H), .WD(WD)) head (
        .in_rem(1'b0), .in_d(in_d), .in_bits(n[N-1 -: H]), .out_rem(head_rem), .out_q(head_q));

    genvar s;
    generate
        if (MODE < 0 || MODE > 1 || WN < 1 || WD < 1 || F < 0 || WN + F > 62 || WD > 62 || R < 1 || R >= N + MODE)
        begin : g_illegal
            divide_needs_MODE_0_or_1_and_WN_plus_F_and_WD_to_62_and_R_from_1_to_the_digits_less_1_in_MODE_0 rule ();
        end
        if (MODE == 0) begin : g_iterative
            reg  [WD-1:0]  d;
            reg  [B-1:0]   rem;
            reg  [N-1:0]   quotient;
            reg            zero;
            reg  [R*M-1:0] todo;  // bits to come: the next R on top, below them the others, which stay where they are
            reg  [M-1:0]   step;  // one-hot, M-1 down to 0
            reg            busy, valid;
            wire           accept = in_valid && in_ready;
            wire [B-1:0]   next_rem;
            wire [R-1:0]   next_q;

            divide_digits #(.K(N-R), .R(R), .WD(WD)) digits (
                .in_rem(rem[L-1:0]), .in_d(d), .in_bits(todo[R*M-1 -: R]), .out_rem(next_rem), .out_q(next_q));

            // selecting from words that stay costs far fewer cells than a load multiplexer on each bit of a shift
            // register
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
                step  <= {accept, {(M-1){1'b0}}} | step >> 1;
                busy  <= accept || (busy && !step[0]);
                valid <= step[0] || (valid && !out_ready);
                if (rst) begin
                    step  <= {M{1'b0}};
                    busy  <= 1'b0;
                    valid <= 1'b0;
                end
            end
            assign in_ready = !busy && (!valid || out_ready);
            assign out_valid = valid;
            assign out_q = quotient;
            assign out_r = {{(WD-B){1'b0}}, rem};
            assign out_div_by_zero = zero;
        end else begin : g_pipelined
            reg [M:0] valid;
            assign out_valid = valid[M];
            assign in_ready = !out_valid || out_ready;
            always @(posedge clk)
                if (rst) valid <= {(M+1){1'b0}};
                else if (in_ready) valid <= valid << 1 | {{M{1'b0}}, in_valid};

            for (s = 0; s <= M; s = s + 1) begin : g_stage
                localparam K = H + s * R;        // digits known behind this stage
                localparam C = K < WD ? K : WD;  // bits of its remainder
                reg  [C-1:0]  rem;
                reg  [N-1:0]  both;              // quotient bits enter below as numerator bits leave on top
                reg           zero;
                wire [C-1:0]  next_rem;
                if (s == 0) begin : g_head
                    assign next_rem = head_rem;
                    always @(posedge clk) if (in_ready) begin
                        zero <= ~|in_d;
                        both <= n << H | {{(N-H){1'b0}}, head_q};
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
            assign out_q = g_stage[M].both;
            assign out_r = {{(WD-B){1'b0}}, g_stage[M].rem};
            assign out_div_by_zero = g_stage[M].zero;
        end
    endgenerate
endmodule
`default_nettype wire
