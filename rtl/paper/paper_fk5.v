// SPDX-License-Identifier: Apache-2.0
// This core finds joints four and five of an industrial arm, which lie on the axis of the forearm.
//   P4 and P5 are paper_fk3 with L2 = cfg_d4 and L2 = cfg_d5, the distances of the joints from the elbow
// Formats: in_j1 to in_j3 are turn-spreads u2.S; cfg_l1, cfg_d4 and cfg_d5 are u(W-F).F below 2^I units, I = W-1-F; the
// outputs are s(W-F).F.
// Error: that of paper_fk3 with the same distance for L2.
// Latency and II: 16 + 2 ceil((S+1)/3). One circuit computes joint four, then joint five.
// Status: overflow (a length is 2^I units or more, or a joint is out of range: its coordinates read +-(2^(W-1) - 1)).
// Source: paper Fig. 11. Model: chain.paper_fk5
`default_nettype none
module paper_fk5 #(
    parameter W = 16,  // bits of a coordinate and of a length, F + 5 or more (default 16: Q7.8 is the paper's word)
    parameter F = 8,   // fraction bits of a coordinate, 1 or more (default 8)
    parameter S = 8    // fraction bits of a joint word, 4 to 24 with N and D of paper_chain_path at most Q (default 8)
) (
    input  wire                clk,
    input  wire                rst,
    input  wire        [W-1:0] cfg_l1,
    input  wire        [W-1:0] cfg_d4,
    input  wire        [W-1:0] cfg_d5,
    input  wire                in_valid,
    output wire                in_ready,
    input  wire        [S+1:0] in_j1,
    input  wire        [S+1:0] in_j2,
    input  wire        [S+1:0] in_j3,
    output wire                out_valid,
    input  wire                out_ready,
    output reg  signed [W-1:0] out_x4,
    output reg  signed [W-1:0] out_y4,
    output reg  signed [W-1:0] out_z4,
    output wire signed [W-1:0] out_x5,
    output wire signed [W-1:0] out_y5,
    output wire signed [W-1:0] out_z5,
    output wire        [3:0]   out_status
);
    // The kernel accepts the words with the first distance, and again with the second one when joint four is ready
    reg              again, over4;
    reg  [3*(S+2)-1:0] kept;
    wire [3*(S+2)-1:0] words = again ? kept : {in_j3, in_j2, in_j1};
    wire             ready, done, over5;
    assign in_ready = ready && !again;
    assign out_valid = done && !again;
    assign out_status = {1'b0, over4 || over5, 2'b00};
    paper_chain #(.W(W), .F(F), .S(S), .YAW(1)) chain (
        .clk(clk), .rst(rst), .cfg_l1(cfg_l1), .cfg_l2(again ? cfg_d5 : cfg_d4), .in_valid(again || in_valid),
        .in_ready(ready), .in_j1(words[S+1:0]), .in_j2(words[2*S+3:S+2]), .in_j3(words[3*S+5:2*S+4]),
        .out_valid(done), .out_ready(again || out_ready), .out_x(out_x5), .out_y(out_y5), .out_z(out_z5),
        .out_overflow(over5));

    always @(posedge clk) begin
        if (in_ready)
            kept <= {in_j3, in_j2, in_j1};
        if (again)
            {over4, out_x4, out_y4, out_z4} <= {over5, out_x5, out_y5, out_z5};
        again <= !rst && (again ? !ready : in_valid && ready);
    end
endmodule
`default_nettype wire
