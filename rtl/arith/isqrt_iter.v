// SPDX-License-Identifier: Apache-2.0
// Square root of an unsigned word with F extra fraction bits, R digits a clock.
//   out_root = floor(sqrt(in_d * 4^F)), out_rem = in_d * 4^F - out_root^2 <= 2 out_root
// Formats: in_d uW.0, out_root u(ceil(W/2)).F, out_rem exact; in_d uW.2f gives out_root with f + F fraction bits.
// Error: truncation, 0 <= sqrt - out_root < 1 LSB; nearest is out_root + (out_rem > out_root).
// Latency and II: ceil(N / R), N = ceil(W/2) + F. The accepting clock does the first H digits from the port.
// Model: arith.isqrt
`default_nettype none
module isqrt_iter #(
    parameter W = 16,  // bits of the radicand, 1 or more, W + 2 F to 62; 16 is the library's word
    parameter F = 0,   // further fraction bits of the root, 0 or more; 0: whole numbers
    parameter R = 1    // digits a clock, 1 to ceil(W/2) + F - 1; 1, the smallest and the fastest clock
) (
    input  wire                 clk,
    input  wire                 rst,
    input  wire                 in_valid,
    output wire                 in_ready,
    input  wire [W-1:0]         in_d,
    output reg                  out_valid,
    input  wire                 out_ready,
    output wire [(W+1)/2+F-1:0] out_root,
    output wire [(W+1)/2+F:0]   out_rem
);
    localparam N = (W + 1) / 2 + F;          // digits
    localparam M = R < 1 ? 0 : (N - 1) / R;  // steps after the accepting clock
    localparam H = N - M * R;                // digits of the accepting clock, 1 .. R

    generate
        if (W < 1 || F < 0 || W + 2*F > 62 || R < 1 || R >= N) begin : g_illegal
            isqrt_iter_needs_W_plus_2F_to_62_and_R_from_1_to_below_the_root_bits rule ();
        end
    endgenerate

    wire [2*N-1:0] d = {{(W%2){1'b0}}, in_d, {(2*F){1'b0}}};
    reg  [N:0]     rem;
    reg  [N-1:0]   root;
    reg  [2*R*M-1:0] todo;  // pairs to come: the next R on top, below it the others, which stay where they are
    reg  [M-1:0]   step;    // one-hot, M-1 down to 0
    reg            busy;

    wire           accept = in_valid && in_ready;
    wire [H:0]     head_rem;
    wire [H-1:0]   head_root;
    wire [N:0]     next_rem;
    wire [N-1:0]   next_root;

    isqrt_comb #(.W(2*H)) head (.in_d(d[2*N-1 -: 2*H]), .out_root(head_root), .out_rem(head_rem));
    isqrt_digits #(.K(N-R), .R(R)) digits (
        .in_rem(rem[N-R:0]), .in_root(root[N-R-1:0]), .in_pairs(todo[2*R*M-1 -: 2*R]),
        .out_rem(next_rem), .out_root(next_root));

    // selecting from words that stay costs far fewer cells than a load multiplexer on each bit of a shift register
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
            todo <= d[2*R*M-1:0];
        end else if (busy) begin
            rem  <= next_rem;
            root <= next_root;
            todo[2*R*M-1 -: 2*R] <= select;
        end
    end

    assign in_ready = !busy && (!out_valid || out_ready);
    assign out_root = root;
    assign out_rem = rem;
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
