// SPDX-License-Identifier: Apache-2.0
// Simulation models of the Cyclone V cells that Yosys' own (share/intel_alm/common: alm_sim.v, dff_sim.v, mem_sim.v)
// do not simulate well. Equal to those where every input is defined, which ci/test/test_netlist.py proves; beyond that:
//   MISTRAL_ALUT*  theirs is `LUT >> inputs`, X as soon as one input is, so a LUT that holds `rst ? 0 : d` stays X in
//                  reset. Here a tree of multiplexers: X only where the two words it lies between differ.
//   MISTRAL_FF     theirs is 0 at power-up, as the device is. Here X, so that reset alone must define the state.
//   MISTRAL_M10K   theirs selects a part by variable bounds, which is no Verilog. Source: its text and the write
//                  polarity of bram_m10k_map.v (negative, but positive in words of 40 bits, where theirs is wrong).
`default_nettype none
module MISTRAL_ALUT6 #(parameter [63:0] LUT = 0) (input wire A, B, C, D, E, F, output wire Q);
    wire high, low;
    MISTRAL_ALUT5 #(.LUT(LUT[63:32])) upper (.A(A), .B(B), .C(C), .D(D), .E(E), .Q(high));
    MISTRAL_ALUT5 #(.LUT(LUT[31:0])) lower (.A(A), .B(B), .C(C), .D(D), .E(E), .Q(low));
    assign Q = F ? high : low;
endmodule

module MISTRAL_ALUT5 #(parameter [31:0] LUT = 0) (input wire A, B, C, D, E, output wire Q);
    wire [15:0] e = E ? LUT[31:16] : LUT[15:0];
    wire [7:0]  d = D ? e[15:8] : e[7:0];
    wire [3:0]  c = C ? d[7:4] : d[3:0];
    wire [1:0]  b = B ? c[3:2] : c[1:0];
    assign Q = A ? b[1] : b[0];
endmodule

module MISTRAL_ALUT4 #(parameter [15:0] LUT = 0) (input wire A, B, C, D, output wire Q);
    wire [7:0] d = D ? LUT[15:8] : LUT[7:0];
    wire [3:0] c = C ? d[7:4] : d[3:0];
    wire [1:0] b = B ? c[3:2] : c[1:0];
    assign Q = A ? b[1] : b[0];
endmodule

module MISTRAL_ALUT3 #(parameter [7:0] LUT = 0) (input wire A, B, C, output wire Q);
    wire [3:0] c = C ? LUT[7:4] : LUT[3:0];
    wire [1:0] b = B ? c[3:2] : c[1:0];
    assign Q = A ? b[1] : b[0];
endmodule

module MISTRAL_ALUT2 #(parameter [3:0] LUT = 0) (input wire A, B, output wire Q);
    wire [1:0] b = B ? LUT[3:2] : LUT[1:0];
    assign Q = A ? b[1] : b[0];
endmodule

module MISTRAL_NOT (input wire A, output wire Q);
    assign Q = ~A;
endmodule

module MISTRAL_ALUT_ARITH #(
    parameter [15:0] LUT0 = 0,
    parameter [15:0] LUT1 = 0
) (
    input wire A, B, C, D0, D1, CI, output wire SO, CO
);
    wire q0, q1;
    MISTRAL_ALUT4 #(.LUT(LUT0)) first (.A(A), .B(B), .C(C), .D(D0), .Q(q0));
    MISTRAL_ALUT4 #(.LUT(LUT1)) second (.A(A), .B(B), .C(C), .D(D1), .Q(q1));
    assign SO = q0 ^ ~q1 ^ CI;
    assign CO = (q0 & ~q1) | (CI & (q0 | ~q1));
endmodule

module MISTRAL_FF (input wire DATAIN, CLK, ACLR, ENA, SCLR, SLOAD, SDATA, output reg Q);
    always @(posedge CLK, negedge ACLR)
        if (!ACLR) Q <= 1'b0;
        else Q <= ENA ? (SCLR ? 1'b0 : SLOAD ? SDATA : DATAIN) : Q;  // X of a control bit goes on
endmodule

module MISTRAL_M10K #(
    parameter INIT = 0,
    parameter CFG_ABITS = 10,
    parameter CFG_DBITS = 10
) (
    input wire CLK1, A1EN, B1EN,
    input wire [CFG_ABITS-1:0] A1ADDR, B1ADDR,
    input wire [CFG_DBITS-1:0] A1DATA,
    output reg [CFG_DBITS-1:0] B1DATA
);
    reg [(CFG_DBITS << CFG_ABITS)-1:0] mem = INIT;
    always @(posedge CLK1) begin
        if (A1EN == (CFG_DBITS == 40)) mem[A1ADDR*CFG_DBITS +: CFG_DBITS] <= A1DATA;
        if (B1EN) B1DATA <= mem[B1ADDR*CFG_DBITS +: CFG_DBITS];
    end
endmodule
`default_nettype wire
