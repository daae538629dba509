// Nearest with ties upward: -half <= x - y 2^SHIFT < half; clamped exactly when that y does not fit, and then to the
// end on its side.
// rtl: round_saturate
// proof 24to16by4 mode=prove depth=1 WI=24 WO=16 SHIFT=4
// proof 16to8by6 mode=prove depth=1 WI=16 WO=8 SHIFT=6
// proof 12to16by3 mode=prove depth=1 WI=12 WO=16 SHIFT=3
// proof 16to12by0 mode=prove depth=1 WI=16 WO=12 SHIFT=0
// proof 16to2by15 mode=prove depth=1 WI=16 WO=2 SHIFT=15
module round_saturate_props #(parameter WI = 24, WO = 16, SHIFT = 4) (input clk, input [WI-1:0] in_x);
    localparam WT = WI + WO + SHIFT + 2;
    wire [WO-1:0] out_x;
    wire out_overflow;
    round_saturate #(.WI(WI), .WO(WO), .SHIFT(SHIFT)) dut (.*);
    wire signed [WT-1:0] x = $signed(in_x);
    wire signed [WT-1:0] y = $signed(out_x);
    wire signed [WT-1:0] twice = 2 * (x - y * (1 << SHIFT));  // twice the error, in input LSB
    wire signed [WT-1:0] one = 1 << SHIFT;
    wire signed [WT-1:0] high = (1 << WO - 1) - 1, low = -(1 << WO - 1);
    always @* begin
        if (!out_overflow) assert (-one <= twice && twice < one);
        else begin
            assert (y == (x < 0 ? low : high));
            assert (x < 0 ? twice < -one : twice >= one);
        end
    end
endmodule
