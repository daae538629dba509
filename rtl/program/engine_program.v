// SPDX-License-Identifier: Apache-2.0
// Control of a long program: it plays a table of LINES control words, one a clock, from a memory block. Use it for
// tables of about sixty lines and more whose lines differ in most bits; as logic (schedule, schedule_counter) they cost
// hundreds of cells.
//   out_op = line i of TABLE in the i-th clock after the one with in_start; line 1 while idle, 0 after the last one.
// With REGISTER it comes one clock later, from flip-flops: the output of a memory block takes half of a clock of 10 ns.
// out_done: the DRAIN-th clock after that of the last line without REGISTER; the program is idle in the next clock.
// in_start in a clock with rst is ignored; start it only with out_idle.
// Latency of a user that raises its out_valid after out_done: LINES + DRAIN + 1.
`default_nettype none
module engine_program #(
    parameter LINES = 2,                  // lines of the table, 2 or more (default 2); one clock each
    parameter BITS = 1,                   // control bits of a line, 1 or more (default 1)
    parameter DRAIN = 3,                  // clocks until the last line is done, 1 or more (default 3: product_engine)
    parameter REGISTER = 0,               // 0 or 1 (default 0); 1: out_op comes from flip-flops
    parameter [LINES*BITS-1:0] TABLE = 0  // control words, the first line in the top BITS bits (default 0)
) (
    input  wire            clk,
    input  wire            rst,
    input  wire            in_start,
    output wire            out_idle,
    output wire            out_done,
    output wire [BITS-1:0] out_op
);
    generate
        if (LINES < 2 || BITS < 1 || DRAIN < 1 || REGISTER < 0 || REGISTER > 1) begin : g_illegal
            engine_program_needs_LINES_from_2_and_BITS_and_DRAIN_from_1_and_REGISTER_0_or_1 rule ();
        end
    endgenerate

    localparam N = $clog2(LINES + DRAIN);
    localparam [31:0] LAST = LINES + DRAIN - 1;
    reg [BITS-1:0] read;
    (* rom_style = "block" *)  // Yosys makes gates of a short table for ECP5
    reg [BITS-1:0] lines[0:(1<<N)-1];
    integer        i;
    initial
        for (i = 0; i < 1 << N; i = i + 1)
            lines[i] = i < LINES ? TABLE[BITS*(LINES-1-i) +: BITS] : {BITS{1'b0}};

    reg          busy;
    reg  [N-1:0] line;  // number of the line in read
    wire [N-1:0] next = !busy || out_done || rst ? {N{1'b0}} : line + 1'b1;
    assign       out_idle = !busy;
    assign       out_done = busy && line == LAST[N-1:0];
    always @(posedge clk) begin
        busy <= !rst && (in_start || busy && !out_done);
        line <= next;
        read <= lines[next];
    end
    generate
        if (REGISTER != 0) begin : g_register
            reg [BITS-1:0] op;
            assign         out_op = op;
            always @(posedge clk)
                op <= rst ? {BITS{1'b0}} : read;
        end else begin : g_memory
            assign out_op = read;
        end
    endgenerate
endmodule
`default_nettype wire
