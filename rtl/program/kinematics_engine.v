// SPDX-License-Identifier: Apache-2.0
// Kinematics coprocessor: it plays programs of equations that its user loads, on words of up to eight contexts.
//   in_kind 0 WRITE a word, 1 READ a register, 2 RUN, 3 INFO, 4 LOAD, 5 SEAL, 6 LINE: rtl/program/README.md
// Formats: words s2.25; a line is {last, in_op of product_engine}; a program is a header and lines. Every command has
// one result. out_word: register in_at of in_context, 0 before its first run (RUN, INFO, LINE: any). out_version,
// out_crc: of the header at in_at; for INFO. out_refused: nothing was done. Latency: 2; LOAD, LINE, SEAL 67; RUN 6 +
// PIPE more than lines are played, or 3. After a reset no program is loaded and no context has run; that takes 2^N
// clocks. Status of RUN: unreachable, singular, no rotation (bit 3: a check of the program failed).
// Model: kinematics_engine.kinematics_engine
`default_nettype none
module kinematics_engine #(
    parameter N = 10,        // bits of a line's address, 6 to 12 (default 10: 1024 lines)
    parameter CONTEXTS = 4,  // contexts: 2, 4 or 8 (default 4: blocks of 256 words)
    parameter U = 16,        // fraction bits of a unit vector outside, 8 to 18 (default 16): what WRIST and CHECK pass
    parameter PIPE = 0       // registers behind the engine's products, 0 to 2 (default 0: fewest clocks)
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        in_valid,
    output wire                        in_ready,
    input  wire [2:0]                  in_kind,
    input  wire [$clog2(CONTEXTS)-1:0] in_context,
    input  wire [N-1:0]                in_at,
    input  wire [47:0]                 in_data,
    output reg                         out_valid,
    input  wire                        out_ready,
    output wire signed [26:0]          out_word,
    output wire [31:0]                 out_version,
    output wire [15:0]                 out_crc,
    output wire                        out_refused,
    output wire [3:0]                  out_status
);
    generate
        if (N < 6 || N > 12 || CONTEXTS < 2 || CONTEXTS > 8 || 1 << $clog2(CONTEXTS) != CONTEXTS || U < 8 || U > 18
            || PIPE < 0 || PIPE > 2) begin : g_illegal
            kinematics_engine_needs_N_from_6_to_12_and_CONTEXTS_of_2_4_or_8_and_U_from_8_to_18_and_PIPE_from_0_to_2
                rule ();
        end
    endgenerate

    localparam B = $clog2(CONTEXTS);
    localparam [2:0] WRITE = 0, RUN = 2, INFO = 3, LOAD = 4, SEAL = 5;  // 1 READ, 6 and 7 LINE
    reg  [2:0]          kind;     // of the command inside, or of the last one
    reg  [B-1:0]        bank;
    reg  [N-1:0]        at;       // address of a line, or of a word
    reg  [47:0]         data;
    reg                 sweep;    // after a reset: every line becomes one that is no header
    reg                 busy, begun;  // a command is inside; it has come in the clock before
    reg                 bad;      // it is refused
    wire                take = in_valid && in_ready;
    wire                done;
    assign              in_ready = !sweep && !busy && (!out_valid || out_ready);

    reg                 loading;
    reg  [15:0]         crc;
    reg  [5:0]          count;
    reg                 match;        // the last 16 bits were those of the CRC
    reg                 lap, stored;  // the CRC is complete; one clock later

    // Program memory: {sealed, header, 48 bits}. A program is played from a sealed header to its last line; a run that
    // meets another header ends there
    wire [49:0]         line;
    wire                head = line[48], sealed = line[49];
    wire                begins = kind[2:1] == 2'd2;  // LOAD or SEAL
    wire                good = lap && kind == SEAL && !bad && match;
    engine_lines #(.N(N)) memory (.clk(clk), .in_at(at), .in_store(sweep || begun && kind[2] && !bad || good),
        .in_line({lap, begins, data}), .out_line(line));
    assign {out_version, out_crc} = line[47:0];

    // A load: LOAD, LINE ..., SEAL, without another command between them. The CRC, x^16 + x^12 + x^5 + 1, is of lines
    // and header as they stand in memory, the highest bit first; the last 16 bits of the header are that of all before.
    // Two steps select a bit: one bit of each four goes into a register, and the next clock takes one of these twelve
    wire [1:0]          place = ~(count[1:0] + 2'd1);  // of the next count's bit in its four
    reg  [11:0]         one;
    wire [15:0]         ones = {4'd0, one};
    wire                odd = crc[15] ^ ones[~count[5:2]];
    genvar              i;
    generate
        for (i = 0; i < 12; i = i + 1) begin : g_four
            wire [3:0] four = line[4*i +: 4];
            always @(posedge clk) one[i] <= four[place];
        end
    endgenerate
    wire                next = in_kind[2:1] == 2'd3;  // LINE
    wire                last = loading && kind[1] && data[47];  // the command before was the last line of a load
    always @(posedge clk) begin
        lap    <= !rst && count == 6'd63;
        stored <= !rst && lap;
        if (rst || !busy || !kind[2])
            count <= 6'd0;
        else
            count <= count + 6'd1;
        if (kind == LOAD)
            crc <= 16'd0;
        else if (count[5:4] != 2'd0)
            crc <= {crc[14:0], 1'b0} ^ ({16{odd}} & 16'h1021);
        match <= count[5:4] != 2'd3 || match && !odd;
        if (rst)
            loading <= 1'b0;
        else if (take)
            loading <= in_kind == LOAD || next && loading;
    end

    // A run: header, lines, and the engine's clocks after the last one
    reg                   entered, live;  // `line` is the header, or a line to play
    reg  [2+PIPE:0]       tail;           // the clocks behind the last line
    reg  [CONTEXTS-1:0]   ran;            // contexts whose registers a run has written
    wire                  known = ran[bank];
    wire                  ends = line[47] || head;
    wire                  fault = entered && !sealed || live && head;
    wire                  start = entered && sealed;
    always @(posedge clk) begin
        entered <= !rst && begun && kind == RUN;
        live    <= !rst && (start || live && !ends);
        tail    <= rst ? {3+PIPE{1'b0}} : {tail[1+PIPE:0], live && ends};
        if (rst)
            ran <= {CONTEXTS{1'b0}};
        else if (tail[0])  // its last HOLD has asked
            ran[bank] <= 1'b1;
    end

    wire [N-1:0] carry;  // as an adder it takes a cell more a bit, for the multiplexer before it
    generate
        for (i = 0; i < N; i = i + 1) begin : g_carry
            assign carry[i] = i == 0 || &(at | {N{1'b1}} << i);
        end
    endgenerate
    assign done = begun && !kind[2] && kind != RUN || stored || entered && !sealed || tail[2+PIPE];
    always @(posedge clk) begin
        sweep     <= rst || sweep && at != {N{1'b1}};
        busy      <= !rst && (take || busy && !done);
        begun     <= !rst && take;
        out_valid <= !rst && (done || out_valid && !out_ready);
        if (rst)
            at <= {N{1'b0}};
        else if (take || sweep || begun && kind == RUN || start || live)
            at <= take && !next ? in_at : at ^ carry;
        if (rst)
            data <= 48'd0;
        else if (take)
            data <= in_data;
        if (rst)
            kind <= 3'd0;
        else if (take)
            kind <= in_kind;
        bank <= take ? in_context : sweep ? at[B-1:0] : bank;  // of each context register 0 becomes 0
        if (take) begin
            bad     <= next && !loading || in_kind == SEAL && !last;
        end else if (fault || lap && kind == SEAL && !good)
            bad     <= 1'b1;
    end

    // Words that a line finds at a port, and the engine
    wire [26:0]         port;
    wire [5:0]          a = live ? line[44:39] : {at[5:1], at[0] || kind[1]} & {6{known}};  // not 0 while lines end
    engine_words #(.N(6+B)) words (.clk(clk), .in_read({bank, a}), .in_at({bank, at[5:0]}),
        .in_store(begun && kind == WRITE), .in_word(data[26:0]), .out_word(port));
    /* verilator lint_off PINCONNECTEMPTY */
    engine_datapath #(.PIPE(PIPE), .WRIST(28-U), .SLACK(29-U), .MARGINS(1), .CONTEXTS(CONTEXTS), .B(B)) engine (
        .clk(clk), .rst(rst), .in_start(begun), .in_run(1'b1), .in_live(live && !head), .in_context(bank),
        .in_forget(data[3] || !known), .in_op({line[46:45], a, line[38:0]}), .in_port(port), .in_signs(data[2:0]),
        .out_read(out_word), .out_word(), .out_dest(), .out_status(out_status));
    /* verilator lint_on PINCONNECTEMPTY */
    assign out_refused = bad || kind == INFO && !sealed;
endmodule
`default_nettype wire
