// SPDX-License-Identifier: Apache-2.0
// This part controls a long sequential kernel: it plays the table that `schedule` plays, by a line counter and a ROM.
//   out_op = line i of TABLE in the i-th clock after the one with in_start, 0 in all others
// A ROM in logic of at most 64 lines costs one 6-input cell a control bit, whatever the lines are; the OR of one-hot
// steps grows with the number of lines. So this module suits tables of about thirty lines and more, most of them loops.
// out_op is registered. out_ahead is the out_op of the next clock if a line is played then: it serves registers
// that are prepared one clock ahead. out_last is high in the last line.
// in_start in a clock with rst is ignored. The user starts the table again only when out_idle is high.
// A kernel that raises its out_valid after the last line has a latency of LINES + 1.
`default_nettype none
module schedule_counter #(
    parameter LINES = 2,                  // lines of the table, one clock each, 2 or more (default 2)
    parameter BITS = 1,                   // control bits of a line, 1 or more (default 1)
    parameter [LINES*BITS-1:0] TABLE = 0  // the control words, the first line in the top BITS bits
) (
    input  wire            clk,
    input  wire            rst,
    input  wire            in_start,
    output wire            out_idle,
    output reg             out_last,
    output wire [BITS-1:0] out_ahead,
    output reg  [BITS-1:0] out_op
);
    generate
        if (LINES < 2 || BITS < 1) begin : g_illegal
            schedule_counter_needs_LINES_from_2_and_BITS_from_1 rule ();
        end
    endgenerate

    localparam N = LINES > 2 ? $clog2(LINES) : 1;
    localparam [31:0] LAST = LINES - 1;
    reg  [N-1:0] line;  // number of lines that were started, which is the index of the next one
    reg          busy;
    wire         run = !rst && (in_start || (busy && !out_last));
    assign out_idle = !busy;
    always @(posedge clk) begin
        busy     <= run;
        out_last <= run && line == LAST[N-1:0];
        line     <= run ? line + 1'b1 : {N{1'b0}};
        out_op   <= run ? out_ahead : {BITS{1'b0}};
    end

    genvar b, i;
    generate
        for (b = 0; b < BITS; b = b + 1) begin : g_bit
            wire [(1<<N)-1:0] column;
            for (i = 0; i < 1 << N; i = i + 1) begin : g_line
                if (i < LINES) begin : g_some
                    assign column[i] = TABLE[BITS*(LINES-1-i) + b];
                end else begin : g_none
                    assign column[i] = 1'b0;
                end
            end
            assign out_ahead[b] = column[line];
        end
    endgenerate
endmodule
`default_nettype wire
