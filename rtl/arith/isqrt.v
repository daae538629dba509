// SPDX-License-Identifier: Apache-2.0
// Square root of an unsigned word with F extra fraction bits; MODE 0 reuses R digit rows, MODE 1 pipelines them all.
//   out_root = floor(sqrt(in_d * 4^F)), out_rem = in_d * 4^F - out_root^2 <= 2 out_root
// Formats: in_d uW.0, out_root u(ceil(W/2)).F, out_rem exact; in_d uW.2f gives out_root with f + F fraction bits.
// Error: truncation, 0 <= sqrt - out_root < 1 LSB; nearest is out_root + (out_rem > out_root).
// Latency: ceil(N / R), N = ceil(W/2) + F. The first H digits come from the port, in the accepting clock.
// II: the latency in MODE 0, 1 in MODE 1, whose stages stall together while a result waits.
// Model: arith.isqrt
`default_nettype none
module isqrt #(
    parameter MODE = 0,  // 0: iterative, 1: pipelined (default 0)
    parameter W    = 16, // bits of the radicand, 1 or more, W + 2 F to 62 (default 16)
    parameter F    = 0,  // further fraction bits of the root, 0 or more (default 0)
    parameter R    = 1   // digits a clock or a stage, 1 to N, below N in MODE 0 (default 1, the fastest clock)
) (
    input  wire                 clk,
    input  wire                 rst,
    input  wire                 in_valid,
    output wire                 in_ready,
    input  wire [W-1:0]         in_d,
    output wire                 out_valid,
    input  wire                 out_ready,
    output wire [(W+1)/2+F-1:0] out_root,
    output wire [(W+1)/2+F:0]   out_rem
);
    localparam N = (W + 1) / 2 + F;          // digits
    localparam M = R < 1 ? 0 : (N - 1) / R;  // steps or stages after the first
    localparam H = N - M * R;                // digits of the first, 1 .. R

    wire [2*N-1:0] d = {{(W%2){1'b0}}, in_d, {(2*F){1'b0}}};
    wire [H:0]     head_rem;
    wire [H-1:0]   head_root;
    isqrt_comb #(.W(2*H)) head (.in_d(d[2*N-1 -: 2*H]), .out_root(head_root), .out_rem(head_rem));

    genvar s;
    generate
        if (MODE < 0 || MODE > 1 || W < 1 || F < 0 || W + 2*F > 62 || R < 1 || R >= N + MODE) begin : g_illegal
            isqrt_needs_MODE_0_or_1_and_W_plus_2F_to_62_and_R_from_1_to_the_root_bits_and_below_them_in_MODE_0 rule ();
        end
        if (MODE == 0) begin : g_iterative
            reg  [N:0]       rem;
            reg  [N-1:0]     root;
            reg  [2*R*M-1:0] todo;  // pairs to come, lower bits inverted: the next R on top, the others stay below
            reg  [M-1:0]     step;  // one-hot, M-1 down to 0
            reg              busy, valid;
            wire             accept = in_valid && in_ready;
            wire [N:0]       next_rem;
            wire [N-1:0]     next_root;

            isqrt_digits #(.K(N-R), .R(R)) digits (
                .in_rem(rem[N-R:0]), .in_root(root[N-R-1:0]), .in_pairs(todo[2*R*M-1 -: 2*R]),
                .out_rem(next_rem), .out_root(next_root));

            // selecting from words that stay costs far fewer cells than a load multiplexer on each bit of a shift
            // register
            reg [2*R-1:0] select;
            integer g;
            always @* begin
                select = {2*R{1'b0}};
                for (g = 0; g < M - 1; g = g + 1)
                    select = select | ({2*R{step[g+1]}} & todo[2*R*g +: 2*R]);
            end

            always @(posedge clk) begin
                if (accept) begin
                    rem  <= {{(N-H){1'b0}}, head_rem};
                    root <= {{(N-H){1'b0}}, head_root};
                    todo <= d[2*R*M-1:0] ^ {(R*M){2'b01}};
                end else if (busy) begin
                    rem  <= next_rem;
                    root <= next_root;
                    todo[2*R*M-1 -: 2*R] <= select;
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
            assign out_root = root;
            assign out_rem = rem;
        end else begin : g_pipelined
            reg [M:0] valid;
            assign out_valid = valid[M];
            assign in_ready = !out_valid || out_ready;
            always @(posedge clk)
                if (rst) valid <= {(M+1){1'b0}};
                else if (in_ready) valid <= valid << 1 | {{M{1'b0}}, in_valid};

            for (s = 0; s <= M; s = s + 1) begin : g_stage
                localparam K = H + s * R;  // digits known behind this stage
                wire [K:0]   next_rem;
                wire [K-1:0] next_root;
                reg  [K:0]   rem;
                reg  [K-1:0] root;
                always @(posedge clk) if (in_ready) begin
                    rem  <= next_rem;
                    root <= next_root;
                end

                if (s == 0) begin : g_head
                    assign next_rem = head_rem;
                    assign next_root = head_root;
                end else begin : g_digits
                    isqrt_digits #(.K(K-R), .R(R)) digits (
                        .in_rem(g_stage[s-1].rem), .in_root(g_stage[s-1].root),
                        .in_pairs(g_stage[s-1].g_todo.todo[2*(N-K+R)-1 -: 2*R]),
                        .out_rem(next_rem), .out_root(next_root));
                end

                if (s < M) begin : g_todo  // pairs to come
                    reg [2*(N-K)-1:0] todo;
                    if (s == 0) begin : g_load
                        always @(posedge clk) if (in_ready) todo <= d[2*(N-K)-1:0] ^ {(N-K){2'b01}};
                    end else begin : g_pass
                        always @(posedge clk) if (in_ready) todo <= g_stage[s-1].g_todo.todo[2*(N-K)-1:0];
                    end
                end
            end
            assign out_root = g_stage[M].root;
            assign out_rem = g_stage[M].rem;
        end
    endgenerate
endmodule
`default_nettype wire
