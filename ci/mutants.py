"""`make mutants`: break every core in many ways and see that its bench notices.

Each mutant (ci/mutate.py) goes through the bulk run of its core and, when it lives, through the cocotb bench, under
Verilator and then, its resets, under Icarus. A kill is a failed comparison or a failed test, nothing else. A survivor
is proved equivalent (no input sequence after a reset tells it from the core), or is killed by as many samples as the
long run has (`make exhaustive`; 20 million clocks at most), or lies in a memory word that no input reaches or in a bit
of a program's line that selects nothing (ci.programs.unread), or it counts against the bench; ci/survivors.toml has the
reasons. It ends well where 99 % of all are killed and each survivor has its argument. The seed is the day's, or SEED.

Writes reports/mutants.json and, from it, a section of reports/checks.md; a core whose sources, bench and tools are
still those of its verdict there is not broken again (--fresh: it is; --again: what proofs have learned since is tried
on its survivors). Where the text of the RTL has changed and the netlist has not, the verdict stands, with the names of
its day. Where the cocotb bench alone has changed, those that the bulk run killed and those proved equal stay so, and
the others go through it again. Verdicts that no longer follow from their sources stay in the file; the section names
them and counts none of their mutants (--page writes it as of today and breaks nothing).
"""

from __future__ import annotations

import argparse
import contextlib
import datetime
import functools
import json
import os
import re
import shutil
import sys
import tomllib
from collections import Counter
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from quadrance.cores import Core, all_cores, find
from rich.console import Console
from rich.table import Table

from ci import cache, checks, equivalence, mutate, pool, programs
from ci.mutate import Mutant, Mutants
from tb.lib import suite, tools
from tb.lib.simulate import UNKNOWN, simulate

MUTANTS = 100
THRESHOLD = 0.99
FEW = 2_000  # samples of a first bulk run, which kills most
LABEL = "-mutant"
AGAIN = 150  # seconds of a proof that is tried once more
LONG_CLOCKS = 20_000_000  # of the long run, for what nothing else kills
COLUMNS = ("core", "killed in bulk", "by the bench alone", "in the long run alone", "equivalent", "never read",
           "survived", "rate", "seed")
KNOWN = tomllib.loads((tools.ROOT / "ci" / "survivors.toml").read_text())
STORE = tools.ROOT / "reports" / "mutants.json"


@dataclass
class Verdict:
    """What became of the mutants of one core; those of the bench alone and survivors by the mutation that made them.

    digest, cocotb : of what the verdict follows from, and of the cocotb bench.
    circuit : as digest, of the netlist in place of the text of the RTL.
    """

    core: str
    digest: str = ""
    cocotb: str = ""
    seed: int = 0
    killed: int = 0
    equivalent: int = 0
    bench: list[str] = field(default_factory=list)
    long: list[str] = field(default_factory=list)
    survivors: list[str] = field(default_factory=list)
    circuit: str = ""

    @property
    def unread(self) -> list[str]:
        """Survivors in words that no input reaches, and in bits of a line that select nothing."""
        return [mutation for mutation in self.survivors if reason(mutation, self.core)]

    @property
    def alive(self) -> list[str]:
        """Survivors that count against the bench."""
        return [mutation for mutation in self.survivors if not reason(mutation, self.core)]

    @property
    def rate(self) -> float:
        """Share, killed by any test, of those that differ in function (or may: nothing proved them equal)."""
        differing = self.killed + len(self.bench) + len(self.long) + len(self.alive)
        return 1 - len(self.alive) / differing if differing else 1.0


def reason(mutation: str, core: str) -> str:
    """Why no input reaches the memory word of this mutation, or why nothing reads its bit; or nothing."""
    name, index = mutate.place(mutation)
    masks = programs.unread(find(core)).get(name) if name.endswith(".lines") else None
    if masks and masks[index] >> mutate.bit(mutation) & 1:
        return "a bit of a line that selects nothing, or a word behind the last line (ci.programs.unread)"
    return next((one["why"] for one in KNOWN["words"] if re.search(one["memory"], name)
                 and re.search(one.get("only", ""), core) and one["words"][0] <= index <= one["words"][1]), "")


def explained(core: str, mutation: str) -> str:
    """What ci/survivors.toml says of a survivor that counts, or nothing."""
    return next((one["why"] for one in KNOWN.get("explained", []) if re.search(one["core"], core)
                 and re.search(one["mutation"], mutation)), "")


def unexplained(verdict: Verdict) -> list[str]:
    """Survivors that no argument calls equal."""
    return [one for one in verdict.alive if not explained(verdict.core, one)]


def enough(verdicts: list[Verdict]) -> bool:
    """Whether at least `THRESHOLD` of all mutants that differ are killed, and each survivor has its argument."""
    alive = sum(len(v.alive) for v in verdicts)
    killed = sum(v.killed + len(v.bench) + len(v.long) for v in verdicts)
    return killed >= THRESHOLD * (killed + alive) and not any(map(unexplained, verdicts))


def killed_in_bulk(mutants: Mutants, mutant: Mutant | None, seed: int, samples: int | None = None) -> bool:
    """True when a comparison of the bulk run fails on the mutant; RuntimeError when it could not be run."""
    built = replace(mutants.core, sources=(mutants.netlist,), params={})
    plusargs = [mutant.plusarg] if mutant else []
    try:
        suite.bulk_run(mutants.core, samples or suite.bulk_samples(mutants.core), seed, built=built, label=LABEL,
                       plusargs=plusargs)
    except AssertionError:
        return True
    return False


def killed_by_bench(mutants: Mutants, mutant: Mutant | None, seed: int) -> bool:
    """True when a cocotb test fails on the mutant; RuntimeError when none could be run.

    All tests under Verilator, and under Icarus those that registers of unknown value can turn red, where it has some.
    """
    built = replace(mutants.core, sources=(mutants.netlist,))
    plusargs = [mutant.plusarg] if mutant else []
    with open(os.devnull, "w") as sink, contextlib.redirect_stdout(sink), contextlib.redirect_stderr(sink):
        try:
            for simulator, tests in [("verilator", None)] + [("icarus", UNKNOWN)] * built.clocked:
                simulate(built, simulator, tests=tests, seed=seed, parameters=False, label=LABEL, failures=1,
                         plusargs=plusargs)
        except SystemExit as error:
            if not str(error).startswith("FAILED"):  # a tool is missing: nothing was tried
                raise
            return True
    return False


def check_unmutated(mutants: Mutants, seed: int) -> None:
    """RuntimeError where the netlist fails that carries the mutants, none of them chosen."""
    if killed_in_bulk(mutants, None, seed) or killed_by_bench(mutants, None, seed):
        raise RuntimeError(f"{mutants.core.id}: the bench fails on the unmutated netlist too, so no kill would count")


def clear(core: Core) -> None:
    """Remove the builds of the mutants of one core: no other run can use them."""
    for folder in (tools.BUILD / "sim").glob(f"*/{core.id}{LABEL}-*"):
        shutil.rmtree(folder)


def fate(mutants: Mutants, mutant: Mutant, prover: equivalence.Prover, seed: int) -> str:
    """What becomes of a mutant: the name of the field of `Verdict` that counts it."""
    core = mutants.core
    if killed_in_bulk(mutants, mutant, seed, FEW) or killed_in_bulk(mutants, mutant, seed):
        return "killed"
    if killed_by_bench(mutants, mutant, seed):  # seconds; a proof of what is not equal takes minutes
        return "bench"
    if reason(str(mutant), core.id):
        return "survivors"
    if prover.equivalent(mutant):
        return "equivalent"
    samples = min(suite.LONG_SAMPLES, LONG_CLOCKS // (core.ii or 1))
    return "long" if killed_in_bulk(mutants, mutant, seed + 1, samples) else "survivors"


def entered(verdict: Verdict, mutant: Mutant, field: str) -> None:
    """Count a mutant in its field of `verdict`, or name it there."""
    if field in ("killed", "equivalent"):
        setattr(verdict, field, getattr(verdict, field) + 1)
    else:
        getattr(verdict, field).append(str(mutant))


def judge(core: Core, count: int, seed: int) -> Verdict:
    """Make, run and judge the mutants of one core."""
    mutants = mutate.make(core, count, seed)
    check_unmutated(mutants, seed)
    verdict = Verdict(core.id, digest(core, count), cocotb(), seed, circuit=circuit(core, count))
    prover = equivalence.Prover(mutants)
    for mutant in mutants.every:
        entered(verdict, mutant, fate(mutants, mutant, prover, seed))
    clear(core)
    return verdict


def benched(core: Core, count: int, standing: Verdict) -> Verdict:
    """A verdict under a cocotb bench that has changed since: what the bulk run and the proofs left goes through it.

    A mutation has the line of its source in its name. Where a comment has moved that line, the core is judged anew.
    """
    verdict = replace(standing, cocotb=cocotb(), bench=[], long=[], survivors=[])
    left = {one: name for name in ("bench", "long", "survivors") for one in getattr(standing, name)}
    if not left:
        return verdict
    mutants = mutate.make(core, count, standing.seed)
    if left.keys() - set(map(str, mutants.every)):
        return judge(core, count, standing.seed)
    check_unmutated(mutants, standing.seed)
    prover = equivalence.Prover(mutants)
    for mutant in mutants.every:
        name = left.get(str(mutant))
        if name and killed_by_bench(mutants, mutant, standing.seed):
            name = "bench"
        elif name == "bench":  # no longer
            name = fate(mutants, mutant, prover, standing.seed)
        if name:
            entered(verdict, mutant, name)
    clear(core)
    return verdict


def proved(core: Core, count: int, standing: Verdict) -> Verdict:
    """A verdict that stands, without those survivors that can be proved equal now."""
    mutants = mutate.make(core, count, standing.seed)
    if set(standing.alive) - set(map(str, mutants.every)):
        return judge(core, count, standing.seed)
    prover = equivalence.Prover(mutants, AGAIN)
    equal = {str(one) for one in mutants.every if str(one) in standing.alive and prover.equivalent(one, whole=False)}
    return replace(standing, equivalent=standing.equivalent + len(equal),
                   survivors=[one for one in standing.survivors if one not in equal])


def renewed(core: Core, count: int, standing: Verdict, seed: int) -> Verdict:
    """The verdict of a core whose sources have changed: `standing`, where its netlist is the same, or a new one."""
    if standing.circuit != circuit(core, count):
        return Verdict(**judged(core.id, count, seed))
    same = replace(standing, digest=digest(core, count))
    return same if same.cocotb == cocotb() else benched(core, count, same)


def _beside(core: Core, count: int) -> list:
    """What a verdict follows from beside the core and its bench."""
    return [equivalence.GRAPH, equivalence.MERGE[core.clocked], tools.versions(), core.params, count]


def digest(core: Core, count: int) -> str:
    """Digest of all that a verdict follows from but the seed and the cocotb bench."""
    return cache.digest([cache.of_bulk(core), mutate.preparation(core), *_beside(core, count)])


def circuit(core: Core, count: int) -> str:
    """`digest` with the netlist that is mutated, without its names, in place of the RTL and the way from it."""
    return cache.digest([mutate.circuit(core), cache.of_samples(core), *_beside(core, count)])


def cocotb() -> str:
    """Digest of the cocotb bench."""
    return cache.digest(cache.of_cocotb())


def judged(core: str, count: int, seed: int, step: str = "") -> dict:
    """The verdict on one core as a dict, kept in build/cache: what is done stays done when the run is cut.

    `step`: "renewed", of a verdict whose sources have changed; "benched" or "proved", of one that stands.
    """
    one = find(core)
    if not step:
        return cache.cached([digest(one, count), cocotb(), seed], lambda: asdict(judge(one, count, seed)))
    standing = known()[core]
    work = {"renewed": functools.partial(renewed, seed=seed), "benched": benched, "proved": proved}[step]
    return cache.cached([step, asdict(standing), digest(one, count), cocotb(), seed,
                         cache.meaning(Path(equivalence.__file__))],
                        lambda: asdict(work(one, count, standing)))


def known() -> dict[str, Verdict]:
    """The committed verdicts by core."""
    return {one["core"]: Verdict(**one) for one in (json.loads(STORE.read_text()) if STORE.exists() else [])}


def today() -> int:
    """The seed of the day, so that each day's mutants are others."""
    return int(datetime.datetime.now(datetime.UTC).strftime("%Y%m%d"))


def row(v: Verdict) -> list[str]:
    """One line of `COLUMNS`."""
    return [v.core, *map(str, (v.killed, len(v.bench), len(v.long), v.equivalent, len(v.unread), len(v.alive))),
            f"{v.rate:.1%}", str(v.seed)]


def stale(verdicts: dict[str, Verdict], every: list[Core], count: int = MUTANTS) -> set[str]:
    """Cores that have a verdict which no longer follows from their sources, bench and tools."""
    return {core.id for core in every if core.id in verdicts and verdicts[core.id].digest != digest(core, count)}


def survived(verdicts: list[Verdict]) -> str:
    """Where the arguments of the survivors that count stand, and the cores with some that have none."""
    without = Counter(verdict.core for verdict in verdicts for _ in unexplained(verdict))
    left = f"none yet for {without.total()}, in {', '.join(together(list(without)))}" if without else "each has one"
    return f"Arguments why a survivor changes nothing stand in `ci/survivors.toml`: {left}."


def together(ids: list[str]) -> list[str]:
    """Names of cores with all their sets among `ids`: core-A/B."""
    sets: dict[str, list[str]] = {}
    for one in ids:
        core, _, rest = one.partition("-")
        sets.setdefault(core, []).append(rest)
    return [f"{core}-{'/'.join(rest)}" for core, rest in sets.items()]


def section(committed: list[Verdict], every: list[Core], old: set[str]) -> list[str]:
    """What is committed: counts, and whether each survivor has its argument.

    It names the cores of `every` that have no verdict, and those whose verdict is `old` and counts for nothing.
    """
    verdicts = [one for one in committed if one.core not in old]
    count = {name: sum(len(getattr(v, name)) for v in verdicts) for name in ("bench", "long", "unread", "alive")}
    bulk, equal = (sum(getattr(v, name) for v in verdicts) for name in ("killed", "equivalent"))
    killed = bulk + count["bench"] + count["long"]
    lines = [f"`make mutants` breaks each core at its first parameter set, and at that of each of its modes, {MUTANTS}",
             "times. The rate is over the mutants that differ in function; a survivor that nothing proved equal counts",
             "against the bench. `mutants.json` names survivors, and mutants that the bulk run did not kill.", ""]
    if verdicts:
        lines += [
            f"{len(verdicts)} of {len(every)} cores: {bulk} killed by the bulk run, {count['bench']} by the cocotb "
            f"bench alone, {count['long']} in the long run alone; {equal} proved equal, {count['unread']} in memory "
            f"words or bits that nothing reads; {count['alive']} survived.",
            f"{killed / max(killed + count['alive'], 1):.2%} of those that differ are killed; in "
            f"{sum(not v.alive for v in verdicts)} cores all of them are."]
    else:
        lines += ["No verdict follows from the sources of today."]
    if count["alive"]:
        lines += ["", survived(verdicts)]
    changed = sum(one.cocotb != cocotb() for one in verdicts)
    lines += ["", f"The cocotb bench has changed since {changed} of these verdicts."] if changed else []
    out = [core.id for core in every if core.id in old or core.id not in {one.core for one in committed}]
    lines += ["", f"Never broken, or changed since and left out above: {', '.join(together(out))}."] if out else []
    return lines


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("core", nargs="*", help="cores to break; all by default")
    parser.add_argument("--count", type=int, default=MUTANTS)
    parser.add_argument("--fresh", action="store_true", help="break those again whose verdict still stands")
    parser.add_argument("--page", action="store_true", help="break nothing; write the section as of today")
    parser.add_argument("--again", action="store_true", help="try proofs on the survivors of verdicts that stand")
    args = parser.parse_args()
    seed = int(os.environ.get("SEED") or today())
    every = [core for core in all_cores() if core.first_set]
    cores = checks.named("mutants", args.core) or every
    verdicts = known()
    old = stale(verdicts, every, args.count)
    if args.page:
        checks.put("Mutants", section([verdicts[core.id] for core in every if core.id in verdicts], every, old))
        return 0
    jobs = []
    for core in cores:
        if args.fresh or core.id not in verdicts:
            jobs.append((core.id, args.count, seed))
        elif core.id in old:
            jobs.append((core.id, args.count, seed, "renewed"))
        elif verdicts[core.id].cocotb != cocotb():
            jobs.append((core.id, args.count, seed, "benched"))
        elif args.again and verdicts[core.id].alive:
            jobs.append((core.id, args.count, seed, "proved"))
    failure = None
    try:
        found = pool.run(judged, jobs, name="mutants")
    except RuntimeError as error:  # those that were judged stand in the cache
        found, failure = {}, error
    if failure is None:
        verdicts |= {core: Verdict(**one) for (core, *_), one in found.items()}
        kept = [verdicts[core.id] for core in every if core.id in verdicts]
        STORE.write_text(json.dumps([asdict(one) for one in kept], indent=1) + "\n")
        checks.put("Mutants", section(kept, every, stale(verdicts, every, args.count)))
    shown = [verdicts[core.id] for core in cores if core.id in verdicts]
    table = Table(*COLUMNS)
    for v in shown:
        table.add_row(*row(v), style="red" if v.rate < THRESHOLD or unexplained(v) else "")
    Console().print(table)
    for v in shown:
        for mutation in v.alive:
            print(f"survivor: {v.core}: {mutation}: {explained(v.core, mutation) or 'no argument'}")
    if failure is not None:
        print(failure, file=sys.stderr)
    return failure is not None or not enough(shown)


if __name__ == "__main__":
    sys.exit(main())
