// SPDX-License-Identifier: Apache-2.0
// Square root of an unsigned word with F extra fraction bits, a result a clock, R digits a stage.
//   out_root = floor(sqrt(in_d * 4^F)), out_rem = in_d * 4^F - out_root^2 <= 2 out_root
// Formats: in_d uW.0, out_root u(ceil(W/2)).F, out_rem exact; in_d uW.2f gives out_root with f + F fraction bits.
// Error: truncation, 0 <= sqrt - out_root < 1 LSB; nearest is out_root + (out_rem > out_root).
// Latency: ceil(N / R), N = ceil(W/2) + F; II 1. All stages stall together while a result waits.
// Model: arith.isqrt
`default_nettype none
module isqrt_pipe #(
    parameter W = 16,  // bits of the radicand, 1 or more, W + 2 F to 62; 16 is the library's word
    parameter F = 0,   // further fraction bits of the root, 0 or more; 0: whole numbers
    parameter R = 1    // digits a stage, 1 to ceil(W/2) + F; 1, the fastest clock
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
    localparam M = R < 1 ? 0 : (N - 1) / R;  // stages behind the first
    localparam H = N - M * R;                // digits of the first stage, 1 .. R

    wire [2*N-1:0] d = {{(W%2){1'b0}}, in_d, {(2*F){1'b0}}};
    reg  [M:0]     valid;
    assign out_valid = valid[M];
    assign in_ready = !out_valid || out_ready;
    always @(posedge clk)
        if (rst) valid <= {(M+1){1'b0}};
        else if (in_ready) valid <= valid << 1 | {{M{1'b0}}, in_valid};

    genvar s;
    generate
        if (W < 1 || F < 0 || W + 2*F > 62 || R < 1 || R > N) begin : g_illegal
            isqrt_pipe_needs_W_plus_2F_to_62_and_R_from_1_to_the_root_bits rule ();
        end
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
                isqrt_comb #(.W(2*H)) digits (.in_d(d[2*N-1 -: 2*H]), .out_root(next_root), .out_rem(next_rem));
            end else begin : g_digits
                isqrt_digits #(.K(K-R), .R(R)) digits (
                    .in_rem(g_stage[s-1].rem), .in_root(g_stage[s-1].root),
                    .in_pairs(g_stage[s-1].g_todo.todo[2*(N-K+R)-1 -: 2*R]),
                    .out_rem(next_rem), .out_root(next_root));
            end

            if (s < M) begin : g_todo  // pairs to come
                reg [2*(N-K)-1:0] todo;
                if (s == 0) begin : g_load
                    always @(posedge clk) if (in_ready) todo <= d[2*(N-K)-1:0];
                end else begin : g_pass
                    always @(posedge clk) if (in_ready) todo <= g_stage[s-1].g_todo.todo[2*(N-K)-1:0];
                end
            end
        end
    endgenerate
    assign out_root = g_stage[M].root;
    assign out_rem = g_stage[M].rem;
endmodule
`default_nettype wire
