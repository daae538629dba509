// SPDX-License-Identifier: Apache-2.0
// Operands of the two multipliers of kernel_vector_solve, and the sum of both products: squares, then a point seen from
// a turned axis. out_sum = k1 x + k2 y + in_addend, each product truncated to 2^-3
//   in_start: k1, k2 and x, y are in_x, in_y; in_rho: they are in_total and z
//   in_power: k1, k2 are 2^15 (2^16 where in_odd) and 0; in_k1: k1 is in_sum, or if in_clamp that power with its sign
//   in_k2: k2 is in_product; in_move: k1 is k2; in_turn: (k1, k2) is (-k2, k1)
// Formats: in_x, in_y, in_z s16.0; in_total s17.4; in_sum, in_product, k1, k2 s18.4; in_addend s34.0; out_sum s34.3. A
// constant 1 behind the last bit of k1 and k2 centres truncation and makes the one's complement an exact negation;
// coordinates have none.
// out_sum is combinational in the registers. Model: vector_solve._turn
`default_nettype none
module kernel_vector_turn #(
    parameter JOINTS = 2  // 2: in_z, in_rho, in_total, in_move and in_power are not used; 3. 2, the smaller one
) (
    input  wire               clk,
    input  wire               in_start,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire signed [15:0] in_z,
    input  wire               in_rho,
    input  wire [20:0]        in_total,
    input  wire               in_k1,
    input  wire               in_k2,
    input  wire               in_turn,
    input  wire               in_move,
    input  wire               in_power,
    input  wire               in_clamp,
    input  wire               in_odd,
    input  wire [21:0]        in_sum,
    input  wire [21:0]        in_product,
    input  wire [33:0]        in_addend,
    output wire [36:0]        out_sum
);
    localparam YAW = JOINTS == 3, X = YAW ? 4 : 0;  // X: fraction bits of x
    wire                  load = in_start || YAW && in_rho, power = YAW && in_power, move = YAW && in_move;
    wire signed [20:0]    first = !YAW || in_start ? {in_x[15], in_x, 4'd0} : in_total;
    reg  signed [15:0]    z;
    wire signed [15:0]    second = !YAW || in_start ? in_y : z;
    reg         [21:0]    k1, k2;
    reg                   odd;
    reg  signed [16+X:0]  x;
    reg  signed [15:0]    y;
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [39+X:0]  product1 = $signed({k1, odd}) * x;
    wire signed [38:0]    product2 = $signed({k2, odd}) * y;
    /* verilator lint_on UNUSEDSIGNAL */
    // The wider product is the later one, so it is added last. Upper bits alone, or Yosys merges both adders at a cost
    wire        [33:0]    upper = product2[38:5] + in_addend;
    assign                out_sum = product1[38+X:2+X] + {upper, product2[4:2]};

    always @(posedge clk) begin
        if (in_start)
            z <= in_z;
        if (load) begin
            x <= first[20:4-X];
            y <= second;
        end
        if (load || in_k1 || power)
            odd <= !load;
        if (load || in_k1 || in_turn || move)
            k1 <= load ? {first[20], first} : in_k1 ? in_sum : k2 ^ {22{in_turn}};
        if (in_k1 && in_clamp || power)
            k1 <= {in_sum[21] && !power, in_sum[21] && !power || in_odd, !in_odd, 19'd0};
        if (load || in_k2 || in_turn)
            k2 <= load ? {{2{second[15]}}, second, 4'd0} : in_k2 ? in_product : k1;
        if (power)
            k2 <= 22'd0;
    end
endmodule
`default_nettype wire
