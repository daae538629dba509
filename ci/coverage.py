"""`make coverage`: the lines and bits of every core that its cocotb bench and its bulk run reach under Verilator.

It prints a line for each parameter set, and writes into reports/checks.md every line and branch that no set reaches.
What one set leaves out (the third joint of a kernel, a table's last range) another must reach. ci/unreached.toml says
why nothing can reach a line. Constant functions, which run when a core is elaborated, and status bits that a core does
not have are not counted.
"""

from __future__ import annotations

import contextlib
import os
import re
import sys
import tomllib
from collections import Counter

from quadrance.cores import RTL, STATUS_BITS, Core, all_cores, find

from ci import checks, pool
from tb.lib import suite, tools
from tb.lib.simulate import simulate

WORK = tools.BUILD / "coverage"
POINT = re.compile(r"^C '(.*)' (\d+)$", re.M)
FIELD = re.compile("\x01([^\x02]+)\x02([^\x01']*)")
REASONS = tomllib.loads((tools.ROOT / "ci" / "unreached.toml").read_text())["line"]
Point = tuple[str, int, str, str]  # file below rtl/, line, "line" or "toggle", what of it


def points(text: str) -> Counter[Point]:
    """How often each point of one coverage.dat was reached, over all instances of its module."""
    found: Counter[Point] = Counter()
    for key, count in POINT.findall(text):
        fields = dict(FIELD.findall(key))
        file = fields["f"].rpartition("/rtl/")[2]
        kind, _, _ = fields["page"].removeprefix("v_").partition("/")
        found[file, int(fields["l"]), kind, fields["o"]] += int(count)
    return found


def measure(core_id: str) -> Counter[Point]:
    """The points of one core after its bench and its bulk run."""
    core = find(core_id)
    folder = WORK / core.id
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.dat"):
        old.unlink()
    os.environ["QUADRANCE_COVERAGE"] = str(folder)
    with open(os.devnull, "w") as sink, contextlib.redirect_stdout(sink), contextlib.redirect_stderr(sink):
        bench = simulate(core, "verilator", seed=suite.SEED)
    suite.bulk_run(core, suite.bulk_samples(core), suite.SEED)
    total = points((bench / "coverage.dat").read_text())
    for file in folder.glob("*.dat"):
        total.update(points(file.read_text()))
    return counted(core, total)


def _constant(total: Counter[Point]) -> set[tuple[str, int]]:
    """File and line of every function that no clock ever calls."""
    found = set()
    for file in {point[0] for point in total}:
        text = (RTL / file).read_text()
        for body in re.finditer(r"\bfunction\b.*?\bendfunction\b", text, re.S):
            first = text.count("\n", 0, body.start()) + 1
            lines = {(file, line) for line in range(first, first + body[0].count("\n") + 1)}
            if not any(count for point, count in total.items() if point[:2] in lines):
                found |= lines
    return found


def counted(core: Core, total: Counter[Point]) -> Counter[Point]:
    """Those of the points that a run can reach."""
    constant = _constant(total)
    absent = {f"out_status[{bit}]" for name, bit in STATUS_BITS.items() if name not in (core.status or ())}
    return Counter({point: count for point, count in total.items()
                    if point[:2] not in constant and point[3].partition(":")[0] not in absent})


def share(total: Counter[Point], *kinds: str) -> str:
    """Reached points of these kinds, of all."""
    counts = [count for point, count in total.items() if point[2] in kinds]
    return f"{sum(map(bool, counts))} of {len(counts)}"


def holes(total: Counter[Point], *kinds: str) -> list[str]:
    """What of these kinds is never reached, a line for each line of the source."""
    missed: dict[tuple[str, int], list[str]] = {}
    for (file, line, kind, what), count in sorted(total.items()):
        if not count and kind in kinds:
            missed.setdefault((file, line), []).append(what)
    return [f"{file}:{line} {', '.join(what)}" for (file, line), what in missed.items()]


def explained(hole: str) -> str:
    """A hole in lines or branches with the reason for it."""
    file, line = re.match(r"(\S+):(\d+) ", hole).groups()
    source = RTL / file
    text = source.read_text().splitlines()[int(line) - 1] if source.exists() else ""
    return f"- `{hole}`: " + next((one["why"] for one in REASONS if one["file"] == file and one["text"] in text),
                                  "**open**")


def table(found: dict[str, Counter[Point]]) -> list[str]:
    """A line for each parameter set: what it reaches of lines and branches, and of toggles."""
    return [f"{core}: {share(total, 'line', 'branch')} lines and branches, {share(total, 'toggle')} toggles"
            for core, total in found.items()]


def section(found: dict[str, Counter[Point]]) -> list[str]:
    """What is committed: a count, and what no set reaches."""
    every = sum(found.values(), Counter())
    every.update(dict.fromkeys((point for total in found.values() for point in total), 0))
    whole = sum(not holes(total, "line", "branch") for total in found.values())
    return ["`make coverage` counts the lines and branches that the bench and the bulk run of each set reach.",
            f"It ran {len(found)} sets; {whole} of them reach every line and branch of their Verilog.",
            "No set reaches these:", "", *map(explained, holes(every, "line", "branch"))]


def main() -> int:
    cores: list[Core] = checks.named("coverage", sys.argv[1:]) or list(all_cores())
    answers = pool.run(measure, [(core.id,) for core in cores], name="coverage")
    found = {core.id: answers[core.id,] for core in cores}
    for core, total in found.items():
        (WORK / core / "holes").write_text("\n".join(holes(total, "line", "branch", "toggle")) + "\n")
    print("\n".join(table(found)))
    if len(sys.argv) == 1:
        checks.put("Coverage", section(found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
