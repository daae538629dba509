// SPDX-License-Identifier: Apache-2.0
// The module converts the joint vectors of an inverse core to binary angles, with one table codec, as they are formed.
//   in_word, in_dest: words of product_engine; the cosine of joint j has register 2j, its sine 2j + 1, in either order
// Formats: in_word s2.25, rounded to s2.U for the codec; angle j of out_angles A bits, a full turn is 2^A, at A(j - 1).
// Error: half a unit of 2^-U in each word of a vector, and that of vector_to_angle.
// Latency: out_valid is high 3 + 2 PIPE clocks after in_done, which comes with the last word. A joint without words,
// which is held, keeps its angle. The two words of a vector come one after the other, with no word of another joint
// between, and the last words of two vectors are at least three clocks apart.
`default_nettype none
module engine_angles #(
    parameter JOINTS = 6,  // joints, 2 to 7 (default 6)
    parameter LAST = 6,    // the joint that is formed last, 1 to JOINTS (default 6)
    parameter A = 18,      // bits of an angle, 10 to 24 (default 18)
    parameter U = 16,      // fraction bits of a unit vector, 8 to 18 (default 16)
    parameter PIPE = 0     // registers of the codec, 0 or 1 (default 0: fewest clocks)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire                in_start,
    input  wire                in_done,
    input  wire [26:0]         in_word,
    input  wire [5:0]          in_dest,
    output wire                out_idle,
    output reg                 out_valid,
    input  wire                out_ready,
    output wire [JOINTS*A-1:0] out_angles
);
    generate
        if (JOINTS < 2 || JOINTS > 7 || LAST < 1 || LAST > JOINTS || A < 10 || A > 24 || U < 8 || U > 18
            || PIPE < 0 || PIPE > 1) begin : g_illegal
            engine_angles_needs_JOINTS_2_to_7_and_LAST_of_them_and_A_10_to_24_and_U_8_to_18_and_PIPE_0_or_1 rule ();
        end
    endgenerate

    localparam          N = 2 + 2 * PIPE;  // clocks of the codec
    localparam [31:0]   TOP = JOINTS;
    wire                part = in_dest[5:1] != 5'd0 && in_dest[5:1] <= TOP[4:0];
    wire signed [U+1:0] c, n;
    wire [A-1:0]        angle;
    reg                 busy;        // a sample is being solved, or its result waits
    reg                 half, both;  // the first word of the vector is loaded; both words are
    reg  [2:0]          joint;
    wire [2:0]          given;       // the joint whose angle the codec gives
    wire                have;
    reg  [N-1:0]        last;        // the codec converts the last vector
    wire                late = last[N-1] || out_valid;  // no vector is accepted: a proof cannot see that none comes
    assign              out_idle = !busy || out_valid && out_ready;
    engine_results #(.COUNT(2), .U(U)) vector (.clk(clk), .in_word(in_word), .in_dest({4'd0, part, in_dest[0]}),
        .out_words({n, c}));
    /* verilator lint_off PINCONNECTEMPTY */
    vector_to_angle #(.U(U), .A(A), .PIPE(PIPE)) codec (.clk(clk), .rst(rst), .in_valid(both && !late),
        .in_ready(), .in_c(c), .in_n(n), .out_valid(have), .out_ready(1'b1), .out_j(angle), .out_status());
    /* verilator lint_on PINCONNECTEMPTY */
    genvar i;
    generate
        if (PIPE == 0) begin : g_soon
            assign given = joint;
        end else begin : g_later
            reg  [2:0] prior, due;
            assign     given = due;
            always @(posedge clk)
                {due, prior} <= {prior, joint};
        end
        for (i = 1; i <= JOINTS; i = i + 1) begin : g_joint
            localparam [31:0] J = i;
            if (i == LAST) begin : g_last
                assign out_angles[A*(i-1) +: A] = angle;
            end else begin : g_held
                reg [A-1:0] held;
                assign      out_angles[A*(i-1) +: A] = held;
                always @(posedge clk)
                    if (have && !late && given == J[2:0])
                        held <= angle;
            end
        end
    endgenerate

    always @(posedge clk) begin
        if (part && half)
            joint <= in_dest[3:1];
        half      <= !in_start && (half ^ part);
        both      <= !rst && part && half;
        last      <= rst ? {N{1'b0}} : {last[N-2:0], in_done};
        out_valid <= !rst && (last[N-1] || out_valid && !out_ready);
        busy      <= !rst && (in_start || busy && !(out_valid && out_ready));
    end
endmodule
`default_nettype wire
