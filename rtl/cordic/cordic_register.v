// SPDX-License-Identifier: Apache-2.0
// This part is a pipeline register if CLOCKED, else a wire: one array serves the combinational and the pipelined form.
`default_nettype none
module cordic_register #(
    parameter WIDTH   = 16,  // bits, 1 or more (default 16; every instance sets it)
    parameter CLOCKED = 1    // 1 (default): a register; 0: a wire
) (
    input  wire             clk,
    input  wire             in_enable,
    input  wire [WIDTH-1:0] in_d,
    output wire [WIDTH-1:0] out_q
);
    generate
        if (CLOCKED) begin : g_register
            reg [WIDTH-1:0] q;
            always @(posedge clk) if (in_enable) q <= in_d;
            assign out_q = q;
        end else begin : g_wire
            wire unused = &{1'b0, clk, in_enable};
            assign out_q = in_d;
        end
    endgenerate
endmodule
`default_nettype wire
