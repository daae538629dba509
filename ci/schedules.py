"""Check of everything that plays a table of control words: `python -m ci.schedules`.

- A program of an engine: `ci.programs` reads its words and follows each of them to the lines that read it.
- A schedule of a kernel: `ci.dataflow` plays the elaborated core, so that no comment has to say what a line does.
- Each instance in rtl/ is one that some core plays, and so is read.
- The latency that `cores.toml` gives a core with one schedule is that of its table.
"""

from __future__ import annotations

import functools
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from quadrance.cores import ROOT, RTL, Core, all_cores, expand, listed

from ci import dataflow, programs
from ci.programs import Played
from tb.lib import legal

SCHEDULES = ("schedule", "schedule_counter")
INSTANCE = re.compile(rf"^[ \t]*(?:{'|'.join(programs.PLAYERS)})\s*#\(", re.M)

_listed = functools.cache(listed)  # one parse for all cores
TABLE = re.compile(r"=\s*\{\s*\n\s*/\*.*?\*/")  # lines that begin with a label

Place = tuple[Path, int]  # the file and the line of an instance


def instances() -> set[Place]:
    """Every instance of a player in rtl/."""
    return {(path, text.count("\n", 0, match.end()) + 1) for path in RTL.rglob("*.v") for text in [path.read_text()]
            for match in INSTANCE.finditer(text)}


def unread(tables: dict[Core, list[Played]], placed: set[Place]) -> list[str]:
    """Instances that no core plays."""
    read = {(one.path, one.at) for every in tables.values() for one in every}
    return [f"{path.relative_to(ROOT)}:{line}: no core of cores.toml plays this table, so nothing reads it"
            for path, line in sorted(placed - read)]


def loose(texts: dict[Path, str]) -> list[str]:
    """Tables that no player plays and that are none of `ci.programs.MACHINES`: nothing would read them."""
    return [f"{path.relative_to(ROOT)}: it has a table of control words, and nothing says what plays it"
            for path, text in sorted(texts.items()) if TABLE.search(text) and not INSTANCE.search(text)
            and path.stem not in programs.MACHINES]


def turned(core: Core) -> list[Core]:
    """A core with one of its switches, parameters of 0 or 1, the other way, where that is legal."""
    family, function, shared, name, own = next(
        entry for entry in _listed((RTL / "cores.toml").read_text()) if entry[3] == core.name)
    own = {key: value for key, value in own.items() if key != "checks"}
    return [one for key, value in core.params.items() if value in (0, 1)
            and not legal.rule_of(core).broken(core.params | {key: 1 - value}) for one in expand(
        family, function, shared, name, own | {"sets": {f"{key}{1 - value}": core.params | {key: 1 - value}}},
        core.sources)]


def chosen(tables: dict[Core, list[Played]]) -> list[Core]:
    """Few cores that play every schedule between them, the first parameter sets before others.

    A table that parameters make in one place is another schedule for each of its words.
    """
    plays = {core: {(one.path, one.at, one.words) for one in every if one.player in SCHEDULES}
             for core, every in tables.items()}
    wanted, found = set().union(*plays.values()), []
    while wanted:
        best = max(plays, key=lambda core: (len(plays[core] & wanted), core.first_set))
        found.append(best)
        wanted -= plays[best]
    return found


def latency_problems(core: Core, lines: set[int]) -> list[str]:
    """The latency of a core whose only schedule ends at its out_valid is that of the table, once or some times over.

    Clocks that it shares with the sample before it (II below latency) are none of the table's lines.
    """
    if core.latency is None:
        return []
    gives = min(lines, default=0) + 1 + core.latency - core.ii
    if len(lines) == 1 and core.latency % gives:
        return [f"{core.id}: cores.toml says latency {core.latency}, its table of {min(lines)} lines gives {gives}"]
    return []


def played(cores: tuple[Core, ...]) -> dict[Core, list[Played]]:
    """The tables that each core plays; cores without any are left out."""
    tables = {core: programs.played(core) for core in cores
              if any(source.stem in programs.PLAYERS or source.stem in programs.MACHINES for source in core.sources)}
    return {core: every for core, every in tables.items() if every}


def all_tables(cores: tuple[Core, ...]) -> dict[Core, list[Played]]:
    """The tables that each core plays, with those of `turned`."""
    tables = played(cores)
    return tables | played(tuple(one for core in tables if core.first_set for one in turned(core)))


def check(tables: dict[Core, list[Played]]) -> list[str]:
    """What is wrong with the tables and the latencies that they give; `ci.dataflow` plays the schedules."""
    wrong = unread(tables, instances()) + loose({path: path.read_text() for path in RTL.rglob("*.v")})
    by_place: dict[Place, Played] = {}
    for core, every in tables.items():
        by_place |= {(one.path, one.at): one for one in every if one.player not in SCHEDULES}
        wrong += latency_problems(core, {len(one.words) for one in every if one.player == "schedule"})
    return wrong + [text for _, one in sorted(by_place.items()) for text in programs.problems(one)]


def main() -> int:
    tables = all_tables(all_cores())
    wrong = check(tables)
    with ThreadPoolExecutor(2) as pool:
        wrong += [text for texts in pool.map(dataflow.problems, chosen(tables)) for text in texts]
    print("\n".join(wrong) if wrong else "schedules: every table in order")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
