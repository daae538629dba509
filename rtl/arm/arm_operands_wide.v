// SPDX-License-Identifier: Apache-2.0
// Operands of the first two multipliers of arm_solve_wide and the sum of both products: arm_operands for N bits.
//   out_sum = k1 x + k2 y + in_addend, each product truncated to 2^-3
//   in_start: k1, x are in_x and k2, y are in_y. in_rho: k1, x are rho less the shoulder offset and k2, y are z
//   LATERAL = 0: rho is in_total. in_power: k1 is 2^(N-1), 2^N with in_odd, negative with in_back, and k2 is 0
//   LATERAL = 1: rho is k2. in_take: k1, k2 are in_length, in_lateral; with in_near 0 and that power, signed
//   in_k1: k1 is in_sum, or with in_clamp that power, signed. in_k2: k2 is in_product. in_move: k1 is k2. in_turn:
//   (k1, k2) is (-k2, k1). out_axis, from the clock after in_rho: |rho| is less than in_margin
// Formats: in_x, in_y, in_z, in_lateral sN.0; in_shoulder s(N-2).0; in_total s(N+1).4; in_sum, in_product, in_length
// s(N+2).4; in_addend s(2N+2).0; out_sum s(2N+2).3. The constant 1 below k1 and k2 is that of arm_operands. out_sum is
// combinational; with PIPE = 1 it is three clocks later, and in_addend belongs to the clock before. Model: arm.ik3
`default_nettype none
module arm_operands_wide #(
    parameter N = 20,        // bits of a coordinate, 20 or 24 (default 20)
    parameter LATERAL = 1,   // 1 (default): the arm's plane passes beside the yaw axis; 0: through it
    parameter SHOULDER = 1,  // 1 (default): in_shoulder is subtracted from rho; 0: not. Used with LATERAL = 1 only
    parameter PIPE = 0,      // 0 or 1 (default 0); 1: registers behind partial products, products and the sum
    parameter MULTIPLY = 18  // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire                clk,
    input  wire                in_start,
    input  wire signed [N-1:0] in_x,
    input  wire signed [N-1:0] in_y,
    input  wire signed [N-1:0] in_z,
    input  wire                in_rho,
    input  wire [N+4:0]        in_total,
    input  wire                in_k1,
    input  wire                in_k2,
    input  wire                in_turn,
    input  wire                in_move,
    input  wire                in_power,
    input  wire                in_clamp,
    input  wire                in_odd,
    input  wire                in_take,
    input  wire                in_near,
    input  wire                in_back,
    input  wire [N+5:0]        in_length,
    input  wire signed [N-1:0] in_lateral,
    input  wire signed [N-3:0] in_shoulder,
    input  wire [N+5:0]        in_sum,
    input  wire [N+5:0]        in_product,
    input  wire [2*N+1:0]      in_addend,
    input  wire [N-2:0]        in_margin,
    output wire                out_axis,
    output wire [N+1:0]        out_k2,  // without its fraction
    output wire [2*N+4:0]      out_sum
);
    reg         [N+5:0]   k1, k2;
    reg                   odd;
    reg  signed [N+4:0]   x;
    reg  signed [N-1:0]   y, z;
    wire                  load = in_start || in_rho, take = LATERAL != 0 && in_take;
    wire                  move = LATERAL == 0 && in_move, power = LATERAL == 0 && in_power;
    wire        [N:0]     offset = SHOULDER ? {{3{in_shoulder[N-3]}}, in_shoulder} : {(N+1){1'b0}};
    wire        [N:0]     radius = k2[N+4:4] - offset;
    wire signed [N+4:0]   first = in_start ? {in_x[N-1], in_x, 4'd0} : LATERAL ? {radius, k2[3:0]} : in_total;
    wire signed [N-1:0]   second = in_start ? in_y : z;
    wire                  minus = power ? in_back : in_sum[N+5];
    wire        [N:0]     distance = (x[N+4:4] + offset) ^ {(N+1){in_back}};  // of the yaw axis, x is rho less a
    assign                out_axis = distance < {2'd0, in_margin};
    /* verilator lint_off UNUSEDSIGNAL */
    wire signed [2*N+11:0] product1;
    wire signed [2*N+6:0]   product2;
    /* verilator lint_on UNUSEDSIGNAL */
    wire        [2*N+1:0]   upper = product2[2*N+6:5] + in_addend;
    wire        [2*N+4:0]   sum = product1[2*N+10:6] + {upper, product2[4:2]};
    generate
        if (PIPE == 0) begin : g_now
            assign product1 = $signed({k1, odd}) * x;
            assign product2 = $signed({k2, odd}) * y;
            assign out_sum = sum;
        end else begin : g_registers
            wire signed [2*N+11:0] parts1;
            wire signed [2*N+6:0]   parts2;
            reg  signed [2*N+11:0] whole1;
            reg  signed [2*N+6:0]   whole2;
            reg         [2*N+4:0]   total;
            product_parts #(.A(N+7), .B(N+5), .MULTIPLY(MULTIPLY)) multiplier1 (.clk(clk), .in_move(1'b1),
                .in_a({k1, odd}), .in_b(x), .out_p(parts1));
            product_parts #(.A(N+7), .B(N), .MULTIPLY(MULTIPLY)) multiplier2 (.clk(clk), .in_move(1'b1),
                .in_a({k2, odd}), .in_b(y), .out_p(parts2));
            always @(posedge clk) begin
                whole1 <= parts1;
                whole2 <= parts2;
                total  <= sum;
            end
            assign product1 = whole1;
            assign product2 = whole2;
            assign out_sum = total;
        end
    endgenerate

    wire   unused = &{1'b0, in_total, in_take, in_near, in_length, in_lateral, in_shoulder, in_move, in_power, radius};
    assign out_k2 = k2[N+5:4];
    always @(posedge clk) begin
        if (in_start)
            z <= in_z;
        if (load) begin
            x <= first;
            y <= second;
        end
        if (load || in_k1 || power || take)
            odd <= !load;
        if (load || in_k1 || in_turn || move)
            k1 <= load ? {first[N+4], first} : in_k1 ? in_sum : k2 ^ {(N+6){!move}};
        if (take)
            k1 <= in_near ? {(N+6){1'b0}} : in_length;
        if (in_k1 && in_clamp || power)
            k1 <= {minus, minus || in_odd, !in_odd, {(N+3){1'b0}}};
        if (load || in_k2 || in_turn)
            k2 <= load ? {{2{second[N-1]}}, second, 4'd0} : in_k2 ? in_product : k1;
        if (take)
            k2 <= in_near ? {in_lateral[N-1], in_lateral[N-1] || in_odd, !in_odd, {(N+3){1'b0}}}
                          : {{2{in_lateral[N-1]}}, in_lateral, 4'd0};
        if (power)
            k2 <= {(N+6){1'b0}};
    end
endmodule
`default_nettype wire
