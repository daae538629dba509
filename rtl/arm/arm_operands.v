// SPDX-License-Identifier: Apache-2.0
// Operands of the two multipliers of arm_solve and the sum of both products. It extends kernel_vector_turn.
//   out_sum = k1 x + k2 y + in_addend, each product truncated to 2^-3
//   in_start: k1, x are in_x and k2, y are in_y. in_rho: k1, x are rho less the shoulder offset and k2, y are z
//   LATERAL = 0: rho is in_total. in_power: k1 is +-2^15 (+-2^16 with in_odd), negative with in_back, and k2 is 0
//   LATERAL = 1: rho is k2. in_take: k1, k2 are in_length, in_lateral; with in_near 0 and that power, signed
//   in_k1: k1 is in_sum, or with in_clamp that power, signed. in_k2: k2 is in_product. in_move: k1 is k2. in_turn:
//   (k1, k2) is (-k2, k1). out_axis, in the clock after in_rho: |rho| is less than in_margin
// Formats: in_x, in_y, in_z, in_lateral s16.0; in_shoulder s14.0; in_total s17.4; in_sum, in_product, in_length s18.4;
// in_addend s34.0; out_sum s34.3. A constant 1 below the last bit of k1 and k2, 0 where they are coordinates, centres
// truncation. out_sum is combinational in the registers; with PIPE = 1 it is a register three clocks later, and
// in_addend belongs to the clock before its last. Models: kernel_vector_solve.turned, arm.ik3
`default_nettype none
module arm_operands #(
    parameter LATERAL = 1,  // 1 (default): the arm's plane passes beside the yaw axis; 0: through it
    parameter SHOULDER = 1, // 1 (default): in_shoulder is subtracted from rho; 0: not. Used with LATERAL = 1 only
    parameter PIPE = 0,     // 0 or 1 (default 0); 1: registers behind the products and the sum
    parameter MULTIPLY = 18 // bits of the chip's multiplier, 18 or 27 (default 18); used with PIPE = 1
) (
    input  wire               clk,
    input  wire               in_start,
    input  wire signed [15:0] in_x,
    input  wire signed [15:0] in_y,
    input  wire signed [15:0] in_z,
    input  wire signed [15:0] in_lateral,
    input  wire signed [13:0] in_shoulder,
    input  wire [14:0]        in_margin,
    input  wire               in_rho,
    input  wire [20:0]        in_total,
    input  wire               in_take,
    input  wire               in_near,
    input  wire [21:0]        in_length,
    input  wire               in_k1,
    input  wire               in_k2,
    input  wire               in_turn,
    input  wire               in_move,
    input  wire               in_power,
    input  wire               in_back,
    input  wire               in_clamp,
    input  wire               in_odd,
    input  wire [21:0]        in_sum,
    input  wire [21:0]        in_product,
    input  wire [33:0]        in_addend,
    output wire               out_axis,
    output wire [36:0]        out_sum
);
    reg         [21:0]    k1, k2;
    reg                   odd;
    reg  signed [20:0]    x;
    reg  signed [15:0]    y, z;
    wire                  load = in_start || in_rho, power = LATERAL == 0 && in_power, take = LATERAL && in_take;
    wire                  move = LATERAL == 0 && in_move;
    wire signed [16:0]    offset = SHOULDER ? {{3{in_shoulder[13]}}, in_shoulder} : 17'd0;
    wire        [16:0]    radius = k2[20:4] - offset;
    wire signed [20:0]    rho = LATERAL ? {radius, k2[3:0]} : in_total;
    wire signed [20:0]    first = in_start ? {in_x[15], in_x, 4'd0} : rho;
    wire signed [15:0]    second = in_start ? in_y : z;
    wire                  minus = power ? in_back : in_sum[21];
    generate
        /* verilator lint_off UNUSEDSIGNAL */
        if (PIPE == 0) begin : g_now
            wire signed [43:0] product1 = $signed({k1, odd}) * x;
            wire signed [38:0] product2 = $signed({k2, odd}) * y;
            // The wider product is ready last, so it is added last. The low bits stay out: Yosys would merge the adders
            wire        [33:0] upper = product2[38:5] + in_addend;
            assign             out_sum = product1[42:6] + {upper, product2[4:2]};
        end else begin : g_registered
            wire signed [43:0] product1;
            wire signed [38:0] product2;
            reg         [36:0] part1, part2, sum;
            product_parts #(.A(23), .B(21), .MULTIPLY(MULTIPLY)) first_parts (.clk(clk), .in_move(1'b1),
                .in_a({k1, odd}), .in_b(x), .out_p(product1));
            product_parts #(.A(23), .B(16), .MULTIPLY(MULTIPLY)) second_parts (.clk(clk), .in_move(1'b1),
                .in_a({k2, odd}), .in_b(y), .out_p(product2));
            always @(posedge clk) begin
                part1 <= product1[42:6];
                part2 <= {product2[38:5] + in_addend, product2[4:2]};
                sum   <= part1 + part2;
            end
            assign out_sum = sum;
        end
        /* verilator lint_on UNUSEDSIGNAL */
    endgenerate
    wire                  unused = &{1'b0, in_total, in_take, in_near, in_length, in_lateral, in_shoulder, in_move,
                                     in_power, in_back, k2[21]};

    wire           [16:0] distance = (x[20:4] + offset) ^ {17{in_back}};  // of the yaw axis, where x is rho less a
    assign                out_axis = distance < {2'd0, in_margin};
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
            k1 <= load ? {first[20], first} : in_k1 ? in_sum : k2 ^ {22{in_turn}};
        if (take)
            k1 <= in_length;
        if (take && in_near)
            k1 <= 22'd0;
        if (in_k1 && in_clamp || power)
            k1 <= {minus, minus || in_odd, !in_odd, 19'd0};
        if (load || in_k2 || in_turn)
            k2 <= load ? {{2{second[15]}}, second, 4'd0} : in_k2 ? in_product : k1;
        if (take)
            k2 <= in_near ? {in_lateral[15], in_lateral[15] || in_odd, !in_odd, 19'd0}
                          : {{2{in_lateral[15]}}, in_lateral, 4'd0};
        if (power)
            k2 <= 22'd0;
    end
endmodule
`default_nettype wire
