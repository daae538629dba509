// SPDX-License-Identifier: Apache-2.0
// This part gives the quadrant of the sum or difference of two turn-spreads: direction (k, a), base angle (0, b) or
// (1, 1 - b).
//   (k, a) - (k', b) = (k - k' - borrow, ...), borrow when sqrt(a (1-b)) < sqrt(b (1-a))
//   (k, a) + (k', b) = (k, a) - (-k' - 1, 1 - b): a sum is the difference from the complement, one quadrant on
// Exact, modulo 4; combinational. Source: this rule replaces the 16 cells of the paper's Table II.
// Model: the line of k in paper.chain, of k1 in paper.solve
`default_nettype none
module paper_quadrant (
    input  wire [1:0] in_k,       // quadrant of the direction
    input  wire       in_plus,    // direction plus base angle; 0: minus
    input  wire       in_obtuse,  // the base angle is in quadrant 1; 0: in quadrant 0
    input  wire       in_borrow,  // the difference of the two roots is negative
    output wire [1:0] out_k
);
    // turn is -obtuse - borrow, or 1 + obtuse - borrow; two bits are cheaper to add by gates than by a carry chain
    wire [1:0] turn = {in_plus ? in_obtuse && !in_borrow : in_obtuse || in_borrow, in_plus ^ in_obtuse ^ in_borrow};
    assign out_k = {in_k[1] ^ turn[1] ^ (in_k[0] & turn[0]), in_k[0] ^ turn[0]};
endmodule
`default_nettype wire
