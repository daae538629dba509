// SPDX-License-Identifier: Apache-2.0
// A small system: PicoRV32 (RV32IM), memory, a serial line, lamps, and three cores behind Wishbone registers.
//   0x0000_0000 memory   0x1000_0000 serial line   0x1000_0004 lamps
//   0x8000_0000 table_ik2, interrupt 3   0x8000_1000 table_fk2, interrupt 4   0x8000_2000 kinematics_engine, interrupt 5
// Formats: a write to the serial line sends 32 bits as four bytes, the lowest first; it reads 1 while they are sent.
// Latency: a register of a core answers in the clock after its request, and so does the memory.
// Reset: all but the memory, which holds the program; a program that ends or fails stops with trap.
`default_nettype none
module soc #(
    parameter FIRMWARE = "firmware.hex",  // the program, words in hexadecimal
    parameter WORDS    = 16384,           // of memory, a power of two (default 64 KB)
    parameter DIVIDE   = 217,             // clocks of a bit on the serial line (default 25 MHz / 115200 baud)
    parameter CORES    = 1                // 0 leaves the cores out
) (
    input  wire       clk,
    input  wire       rst,
    output wire       tx,
    output reg  [7:0] led,
    output wire       trap
);
    wire        valid;
    wire [31:0] addr, wdata;
    wire [3:0]  wstrb;
    wire        at_memory = valid && addr[31:28] == 4'h0;
    wire        at_io     = valid && addr[31:28] == 4'h1;
    wire        at_core   = valid && addr[31:28] == 4'h8;
    reg         answered;  // memory and io, a clock after the request
    wire [2:0]  ack, irq;
    wire [31:0] word0, word1, word2;
    reg  [31:0] rdata, word;

    /* verilator lint_off PINMISSING */
    picorv32 #(.ENABLE_COUNTERS64(0), .BARREL_SHIFTER(1), .ENABLE_FAST_MUL(1), .ENABLE_DIV(1), .ENABLE_IRQ(1),
               .ENABLE_IRQ_TIMER(0), .LATCHED_IRQ(32'h0000_0007), .STACKADDR(WORDS * 4)) cpu (
        .clk(clk), .resetn(!rst), .trap(trap), .mem_valid(valid), .mem_ready(answered || ack != 3'd0),
        .mem_addr(addr), .mem_wdata(wdata), .mem_wstrb(wstrb), .mem_rdata(rdata), .pcpi_wr(1'b0), .pcpi_rd(32'd0),
        .pcpi_wait(1'b0), .pcpi_ready(1'b0), .irq({26'd0, irq, 3'd0}));
    /* verilator lint_on PINMISSING */

    // Memory
    localparam A = $clog2(WORDS);
    reg  [31:0] memory [0:WORDS-1];
    wire [A-1:0] at = addr[A+1:2];
    initial $readmemh(FIRMWARE, memory);
    always @(posedge clk) begin
        if (at_memory && wstrb[0]) memory[at][7:0]   <= wdata[7:0];
        if (at_memory && wstrb[1]) memory[at][15:8]  <= wdata[15:8];
        if (at_memory && wstrb[2]) memory[at][23:16] <= wdata[23:16];
        if (at_memory && wstrb[3]) memory[at][31:24] <= wdata[31:24];
        word <= memory[at];
    end

    // Serial line and lamps
    reg  [39:0] shift;  // start, eight bits, stop, four times
    reg  [5:0]  bits;
    reg  [15:0] timer;
    wire        sending = bits != 6'd0;
    wire        put = at_io && !answered && wstrb[0];
    assign tx = shift[0] || !sending;
    always @(posedge clk) begin
        answered <= !rst && (at_memory || at_io) && !answered;
        if (rst) begin
            bits <= 6'd0;
            led  <= 8'hff;
        end else begin
            if (put && !addr[2] && !sending) begin
                shift <= {1'b1, wdata[31:24], 2'b01, wdata[23:16], 2'b01, wdata[15:8], 2'b01, wdata[7:0], 1'b0};
                bits  <= 6'd40;
                timer <= DIVIDE[15:0] - 16'd1;
            end else if (timer != 16'd0)
                timer <= timer - 16'd1;
            else if (sending) begin
                shift <= {1'b1, shift[39:1]};
                bits  <= bits - 6'd1;
                timer <= DIVIDE[15:0] - 16'd1;
            end
            if (put && addr[2]) led <= wdata[7:0];
        end
    end

    // Cores
    wire [2:0] pick = {3{at_core}} & 3'b1 << addr[13:12];
    generate
        if (CORES != 0) begin : g_cores
            wire [2:0] unused_stall;
            wishbone_table_ik2 inverse (.clk_i(clk), .rst_i(rst), .cyc_i(pick[0]), .stb_i(pick[0]), .we_i(wstrb != 4'd0),
                .adr_i(addr[11:2]), .dat_i(wdata), .sel_i(wstrb), .ack_o(ack[0]), .stall_o(unused_stall[0]),
                .dat_o(word0), .irq(irq[0]));
            wishbone_table_fk2 forward (.clk_i(clk), .rst_i(rst), .cyc_i(pick[1]), .stb_i(pick[1]), .we_i(wstrb != 4'd0),
                .adr_i(addr[11:2]), .dat_i(wdata), .sel_i(wstrb), .ack_o(ack[1]), .stall_o(unused_stall[1]),
                .dat_o(word1), .irq(irq[1]));
            wishbone_kinematics_engine engine (.clk_i(clk), .rst_i(rst), .cyc_i(pick[2]), .stb_i(pick[2]),
                .we_i(wstrb != 4'd0), .adr_i(addr[11:2]), .dat_i(wdata), .sel_i(wstrb), .ack_o(ack[2]),
                .stall_o(unused_stall[2]), .dat_o(word2), .irq(irq[2]));
        end else begin : g_none
            assign ack = 3'd0;
            assign irq = 3'd0;
            assign {word0, word1, word2} = 96'd0;
        end
    endgenerate
    always @*
        case ({addr[31], addr[28], addr[13:12]})
            4'b1000: rdata = word0;
            4'b1001: rdata = word1;
            4'b1010, 4'b1011: rdata = word2;
            4'b0100, 4'b0101, 4'b0110, 4'b0111: rdata = {31'd0, sending};
            default: rdata = word;
        endcase
    wire unused = &{1'b0, addr};
endmodule
`default_nettype wire
