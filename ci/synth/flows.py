"""What is measured: the scripts of every synthesis flow, and the ports that are timed."""

from __future__ import annotations

from collections.abc import Sequence

from quadrance.cores import Core, Port

# ABC's default scripts take minutes for multipliers in logic. A short one maps them for Cyclone V, and `abc -lut 4`,
# which leaves out the &fraig that -dress brings, for iCE40; the same for every core. Against the default, one-joint
# cores came 8 % above at most in the first flow (the smallest primitive 18 %), within 20 % either way in the second.
SYNTH = {
    "cyclonev": "synth_intel_alm -family cyclonev -noiopad -noclkbuf -top {top}",
    "cyclonev_nodsp": "scratchpad -set abc9.script +&sweep;&if,{{W}},{{D}},{{R}},-v; "
                      "synth_intel_alm -family cyclonev -noiopad -noclkbuf -nodsp -top {top}",
    "ice40": "synth_ice40 -top {top} -run begin:map_luts; techmap -map +/ice40/latches_map.v; abc -lut 4; "
             "ice40_wrapcarry -unwrap; techmap -map +/ice40/ff_map.v; clean; opt_lut -tech ice40; "
             "synth_ice40 -top {top} -run map_cells:",
    "ecp5": "synth_ecp5 -top {top}",
}
PLACE = ("--25k", "--speed", "6", "--package", "CABGA381", "--freq", "200", "--lpf-allow-unconstrained",
         "--timing-allow-fail")  # nextpnr-ecp5
SEEDS = (1, 2, 3)
AGREE = 0.03  # the median of three lies between the first two: where these differ by less, the third is not placed


def timed_ports(core: Core) -> tuple[list[Port], list[Port]]:
    """Inputs and outputs that the wrapper registers: all but the clock."""
    inputs, outputs = [*core.cfg, *core.inputs], list(core.outputs)
    if core.clocked:
        inputs += [Port(name, 1, False) for name in ("rst", "in_valid", "out_ready")]
        outputs += [Port(name, 1, False) for name in ("in_ready", "out_valid")]
    return inputs, outputs


def wrapper(top: str, inputs: Sequence[Port], outputs: Sequence[Port], clocked: bool) -> str:
    """A module `wrap` with every port of `top` registered, so that nextpnr times the port paths.

    Four pins whatever the width: a shift register feeds the inputs, and a second rank behind the
    output registers shifts the results out (the load is outside the timed path of the core).
    """
    n_in, n_out = sum(p.width for p in inputs), sum(p.width for p in outputs)
    ports = [".clk(clk)"] if clocked else []
    for vector, group in (("ins", inputs), ("outs", outputs)):
        low = 0
        for port in group:
            ports.append(f".{port.name}({vector}[{low}+:{port.width}])")
            low += port.width
    return f"""module wrap(input wire clk, input wire si, input wire load, output wire so);
  reg [{n_in}-1:0] ins; wire [{n_out}-1:0] outs; reg [{n_out}-1:0] first, second;
  always @(posedge clk) begin
    ins <= {{ins, si}}; first <= outs; second <= load ? first : second >> 1;
  end
  assign so = second[0];
  {top} dut ({', '.join(ports)});
endmodule
"""
