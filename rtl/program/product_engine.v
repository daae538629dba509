// SPDX-License-Identifier: Apache-2.0
// Sums of two products, one line a clock, on a register file of 64 words, for programs that engine_program plays.
//   word = A B [+- C D] [+ the sum before] rounded to 2^-25, written to DEST; a single product may be shifted
// When a word can be used: rtl/program/README.md, as in_op {A 8, B 7, C 6, D 6, SUM 2, KEEP 1, ALIGN 2, DEST 6, ACT 9}.
// Formats: words s2.25; sum s4.28, it wraps; products truncated to 2^-28. in_port: word of a PORT operand, one clock
// after its line. in_signs: BACK, DOWN, FLIP use the complement of SLOPE. in_run: the program is not idle; without it
// only registers are written. out_word, out_dest: word of the line before, and its register, 0 for none. out_status:
// unreachable and singular as the last ABOVE, FAR and HOLD lines found them; bit 3 a failed CHECK since in_start.
// Models: product_engine.dot, .unit, .root
`default_nettype none
module product_engine #(
    parameter PIPE = 0,      // 0 to 2 (default 0); 1: registers behind products, 2: behind products of 18 x 18 bits too
    parameter ROOTS = 1,     // 0 or 1 (default 1); 0: sums only, without ACT, ALIGN and root tables
    parameter WRIST = 12,    // lowest bit that counts with act WRIST, 0 to 25 (default 12, 8 units of 2^-16)
    parameter SLACK = 13,    // lowest bit that is an error with act CHECK, 0 to 25 (default 13, 16 units of 2^-16)
    parameter MARGINS = 0,   // 0 or 1 (default 0); 1: with NEAR (CHECK | WRIST), OVER (CHECK | FAR), C of HOLD
    parameter QUOTIENTS = 0  // 0 or 1 (default 0); 1: in_start clears the outcome of FAR
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        in_start,
    input  wire        in_run,
    input  wire [46:0] in_op,
    input  wire [26:0] in_port,
    input  wire [2:0]  in_signs,
    output wire [26:0] out_word,
    output wire [5:0]  out_dest,
    output wire [3:0]  out_status
);
    generate
        if (PIPE < 0 || PIPE > 2) begin : g_illegal
            product_engine_needs_PIPE_from_0_to_2 rule ();
        end
    endgenerate

    /* verilator lint_off PINCONNECTEMPTY */
    engine_datapath #(.PIPE(PIPE), .ROOTS(ROOTS), .WRIST(WRIST), .SLACK(SLACK), .MARGINS(MARGINS),
        .QUOTIENTS(QUOTIENTS)) datapath (.clk(clk), .rst(rst), .in_start(in_start), .in_run(in_run), .in_live(1'b1),
        .in_context(1'b0), .in_forget(1'b0), .in_op(in_op), .in_port(in_port), .in_signs(in_signs), .out_read(),
        .out_word(out_word), .out_dest(out_dest), .out_status(out_status));
    /* verilator lint_on PINCONNECTEMPTY */
endmodule
`default_nettype wire
