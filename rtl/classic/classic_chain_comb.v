// SPDX-License-Identifier: Apache-2.0
// This engine has the arithmetic of classic_chain_iter, bit for bit, on a combinational CORDIC: one rotation a clock.
// It has no handshake.
// out_x and out_y are not registered. With out_lifted out_y is the height; with out_done both are the result.
// The first rotation is computed in the clock of in_start. The factors of the gain precede the third rotation.
// Formats: in_s1, in_s2, out_x and out_y have 5 guard bits.
// Error of a coordinate at W = A = 16, rounded: 2 LSB with two joints, 2.9 with three, up to L1 + L2 = 2^(W-2).
// Model: classic.fk2, classic.fk3
`default_nettype none
module classic_chain_comb #(
    parameter W      = 16,  // bits of a coordinate, 8 to 24 (default 16)
    parameter A      = 16,  // bits of an angle, a turn is 2^A, 5 to W + 3, at most 24 (default 16)
    parameter JOINTS = 2    // 2 (default): in the plane; 3: in space
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_start,
    input  wire        [A-1:0] in_j1,
    input  wire        [A-1:0] in_j2,
    input  wire        [A-1:0] in_j3,
    input  wire        [W+4:0] in_s1,
    input  wire        [W+4:0] in_s2,
    output wire                out_busy,
    output wire                out_done,
    output wire                out_lifted,
    output wire signed [W+6:0] out_x,
    output wire signed [W+6:0] out_y
);
    localparam D = W + 7;
    localparam FACTORS = W > 16 ? 6 : 5;
    localparam [5:0] HALF_LSB = 16;
    localparam [31:0] IN_XY = W > 16 ? 13 + 3 * (W - 16) / 4 : 13;  // mean of what the shifts round down in the plane
    localparam [31:0] YAW = W > 15 ? 6 + (W - 15) / 3 : 6;          // and in the third rotation
    reg  [1:0]   pass;
    reg  [A-1:0] j1, j3;
    reg  [D-1:0] x, y;
    assign out_busy = pass != 2'd0;
    assign out_lifted = pass == 2'd1;
    assign out_done = pass == JOINTS[1:0] - 2'd1;
    always @(posedge clk) begin
        pass <= rst || out_done || !(in_start || out_busy) ? 2'd0 : pass + 2'd1;
        if (in_start) {j1, j3} <= {in_j1, in_j3};
        {x, y} <= {out_x, out_y};
    end

    // start of a rotation: the middle of the quadrant of j1 + j2; then the tip so far; then rho
    wire         first = pass == 2'd0;
    wire         yawing = JOINTS == 3 && pass == 2'd2;
    wire [A-1:0] j = first ? in_j2 : yawing ? j3 : j1;
    wire [1:0]   quarter2 = in_j1[A-1:A-2] + in_j2[A-1:A-2] + {1'b0, in_j2[A-3]};
    wire [D-1:0] start = {2'b00, in_s2};
    wire [D-1:0] yaw_x, yaw_y, turned_x, turned_y;
    wire [D-1:0] x0 = first ? start ^ {D{quarter2[1] ^ quarter2[0]}} : yawing ? yaw_x : x;
    wire [D-1:0] y0 = first ? start ^ {D{quarter2[1]}} : yawing ? yaw_y : y;
    cordic_turn_array #(.W(W), .D(D), .R(8'd0), .CLOCKED(0)) turn (.clk(clk), .in_enable(1'b0), .in_x(x0), .in_y(y0),
        .in_z({{2{j[A-3] ^ !first}}, j[A-4:0], {(W+3-A){1'b0}}, 2'b10}), .out_x(turned_x), .out_y(turned_y));

    // end of a rotation: adds the first link, or half an LSB and the mean of what was rounded down
    wire [D-1:0] link = {2'b00, in_s1};
    wire [5:0]   round_x = yawing ? YAW[5:0] + HALF_LSB : JOINTS == 3 ? IN_XY[5:0] : IN_XY[5:0] + HALF_LSB;
    wire [5:0]   round_y = yawing ? YAW[5:0] + HALF_LSB : IN_XY[5:0] + HALF_LSB;
    assign out_x = turned_x + (first ? link ^ {D{in_j1[A-1] ^ in_j1[A-2]}} : {{(D-6){1'b0}}, round_x});
    assign out_y = turned_y + (first ? link ^ {D{in_j1[A-1]}} : {{(D-6){1'b0}}, round_y});

    generate
        if (JOINTS == 2) begin : g_plane
            assign {yaw_x, yaw_y} = {2*D{1'b0}};
            wire unused = &{1'b0, j3};
        end else begin : g_yaw
            genvar i;
            for (i = 0; i <= FACTORS; i = i + 1) begin : g_factor
                localparam SHIFT = i == 1 ? 2 : i == 2 ? 5 : i == 3 ? 9 : i == 4 ? 10 : i == 5 ? 16 : 23;
                wire signed [D-1:0] rho;
                if (i == 0) begin : g_first
                    assign rho = {x[D-1], x[D-1:1]};
                end else begin : g_next
                    wire signed [D-1:0] less = g_factor[i-1].rho;
                    wire signed [D-1:0] part = less >>> SHIFT;
                    assign rho = less + (part ^ {D{i == 2 || i == 6}});
                end
            end
            assign yaw_x = g_factor[FACTORS].rho ^ {D{j3[A-1] ^ j3[A-2]}};
            assign yaw_y = g_factor[FACTORS].rho ^ {D{j3[A-1]}};
        end
    endgenerate
endmodule
`default_nettype wire
