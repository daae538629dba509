// SPDX-License-Identifier: Apache-2.0
// START, STATE and IRQ_ENABLE of a core behind registers, and which writes pass.
// Byte addresses: 0x008 START, 0x00C STATE, 0x010 IRQ_ENABLE, from 0x100 on cfg, from 0x200 on in. STATE: bit 0 busy,
// 1 done, 2 refused (START, cfg or in were written while busy), 3 outside (no such word, a word that can only be read,
// or less than a whole word was written). A write of 1 clears bits 1 to 3. A write that sets bit 2 or 3 does no more.
// Reset: all registers.
`default_nettype none
module register_control #(
    parameter CFG = 1,  // words of configuration, 0 to 2^K (default 1)
    parameter IN  = 1,  // words of a sample, 1 to 2^K (default 1)
    parameter K   = 3   // bits of an address that count the words of a block, 3 to 6 (default 3)
) (
    input  wire       clk,
    input  wire       rst,
    input  wire       write,
    input  wire       whole,
    input  wire [9:0] waddr,      // of a word
    input  wire [3:1] wdata,
    input  wire       enable,     // bit 0 of wdata
    input  wire       busy,       // a sample is inside
    input  wire       finished,   // its result is there
    output wire       start,
    output wire       put,        // the word at waddr[7:6], waddr[K-1:0] takes wdata, where it is one of cfg or in
    output reg        done,
    output reg        refused,
    output reg        outside,
    output reg        irq_enable,
    output wire       irq
);
    generate
        if (K < 3 || K > 6 || CFG < 0 || CFG > (1 << K) || IN < 1 || IN > (1 << K)) begin : g_illegal
            register_control_needs_K_from_3_to_6_and_up_to_2_to_the_K_words rule ();
        end
    endgenerate
    // The address is within the first 2^K words of its block, so waddr[7:6] selects the block and K bits the word.
    wire near = waddr[9:8] == 2'd0 && waddr[5:0] >> K == 6'd0;
    wire hit = write && whole && near;
    wire [K:0] at = {1'b0, waddr[K-1:0]};
    wire at_control = waddr[7:6] == 2'd0;
    wire at_words = (waddr[7:6] == 2'd1 && at < CFG[K:0]) || (waddr[7:6] == 2'd2 && at < IN[K:0]);
    wire at_start = at_control && at == 2;
    wire at_state = at_control && at == 3;
    wire at_irq = at_control && at == 4;
    wire clears = hit && at_state;
    wire enables = hit && at_irq;
    wire known = at_words || at_start || at_state || at_irq;
    assign put = hit && !busy;
    assign start = put && at_start;
    assign irq = done && irq_enable;
    always @(posedge clk)
        if (rst) begin
            done       <= 1'b0;
            refused    <= 1'b0;
            outside    <= 1'b0;
            irq_enable <= 1'b0;
        end else begin
            done    <= finished || (done && !start && !(clears && wdata[1]));
            refused <= (write && busy && !clears && !enables) || (refused && !(clears && wdata[2]));
            outside <= (write && !(hit && known)) || (outside && !(clears && wdata[3]));
            if (enables) irq_enable <= enable;
        end
endmodule
`default_nettype wire
