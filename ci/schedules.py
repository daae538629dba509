"""Reader of the cycle tables: `python -m ci.schedules` checks them, `--write` fills the pages as well.

A table is a localparam whose source lines each start with a `/* label */` and hold the operations of one clock, or of
`{n{...}}` equal clocks. A comment `NAME = bits,  // W ... <- R ...: text` names an operation and the registers that it
writes and reads; `// Schedule. start: W ... <- R ...` names those that the accepting clock writes. A schedule instance
plays one table or several, one behind the other. A page holds `<!-- schedule:MODULE -->` ... `<!-- /schedule -->`.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from pyslang.driver import Driver
from quadrance.cores import ROOT, RTL, Core, all_cores

OPERATION = re.compile(r"^\s*(?:localparam\s*\[[^\]]*\]\s*)?(\w+)\s*=\s*\d+'[bdh]\w+[,;]"
                       r"(?:[ \t]*//[ \t]*([^:\n]*?)<-([^:\n]*):[ \t]*(.+))?$", re.M)
OPERATION_NAME = re.compile(r"^\s*(\w+)\s*=", re.M)
START = re.compile(r"//\s*Schedule\. start:\s*(.*?)<-")
GROUP = re.compile(r"^[ \t]*localparam\s*\[[^\]]*\][ \t]*(?://[ \t]*(.+))?\n((?:\s*\w+\s*=\s*\d+'[bdh].*\n)+)", re.M)
TABLE = re.compile(r"^[ \t]*localparam\s*\[[^\]]*\]\s*(\w+)\s*=\s*\{\s*\n"
                   r"((?:\s*/\*.*\n)+)", re.M)
LINE = re.compile(r"/\*\s*(.*?)\s*\*/\s*(.*?)\s*(?:\};?)?,?\s*$")
INSTANCE = re.compile(r"^\s*schedule\s*#\([^;]*?\.TABLE\(\s*\{?([\w\s,]+?)\}?\s*\)", re.M)
BLOCK = re.compile(r"(<!-- schedule:(\w+) -->\n)(.*?)(<!-- /schedule -->)", re.S)


@dataclass(frozen=True)
class Operation:
    """One named operation: registers written at the end of its clock, registers read in it, what it does."""

    writes: frozenset[str]
    reads: frozenset[str]
    text: str


@dataclass(frozen=True)
class Line:
    """One line of a table: its label, how often it is repeated ("1", or an expression), the names in each column."""

    label: str
    times: str
    columns: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(re.findall(r"[A-Za-z_]\w*", " ".join(self.columns)))


@dataclass(frozen=True)
class Table:
    """A table: its lines."""

    lines: tuple[Line, ...]


@dataclass(frozen=True)
class Schedules:
    """All that one Verilog file says about its schedules; `instances` are the tables that each instance plays."""

    start: frozenset[str]
    operations: dict[str, Operation]
    groups: dict[str, str]  # operation -> what the group of operations decides, the title of its column
    tables: dict[str, Table]
    instances: tuple[tuple[str, ...], ...]


def _registers(words: str) -> frozenset[str]:
    return frozenset(words.replace(",", " ").split()) - {"-"}


def _line(text: str) -> Line:
    label, body = LINE.search(text).groups()
    times = "1"
    if repeated := re.fullmatch(r"\{\s*([^{}]+?)\s*\{(.*)\}\s*\}?", body):
        times, body = repeated.groups()
    body = body.strip().removeprefix("{").removesuffix("}")
    return Line(label, times, tuple(column.strip(" {}") for column in body.split(",")))


def read(text: str) -> Schedules:
    """The schedules of a Verilog text."""
    operations = {name: Operation(_registers(writes), _registers(reads), what.strip())
                  for name, writes, reads, what in OPERATION.findall(text)}
    groups = {name: title for title, lines in GROUP.findall(text) for name in OPERATION_NAME.findall(lines)}
    tables = {name: Table(tuple(_line(line) for line in lines.splitlines() if line.strip()))
              for name, lines in TABLE.findall(text)}
    played = tuple(tuple(re.findall(r"\w+", names)) for names in INSTANCE.findall(text))
    start = frozenset().union(*(_registers(words) for words in START.findall(text)))
    return Schedules(start, operations, groups, tables, played)


def problems(schedules: Schedules, where: str) -> list[str]:
    """Unknown names, and registers that a line reads although no line before it has written them."""
    wrong = []
    for names in schedules.instances:
        if unknown := [name for name in names if name not in schedules.tables]:
            wrong.append(f"{where}: no table {unknown[0]}")
            continue
        written = set(schedules.start)
        for line in (line for name in names for line in schedules.tables[name].lines):
            if unknown := [name for name in line.names if name not in schedules.operations]:
                wrong.append(f"{where}: '{line.label}': no operation {unknown[0]}")
                continue
            operations = [schedules.operations[name] for name in line.names]
            for register in sorted(frozenset().union(*(one.reads for one in operations)) - written):
                wrong.append(f"{where}: '{line.label}': {register} is read, but no line before it has written it")
            written |= frozenset().union(*(one.writes for one in operations))
    return list(dict.fromkeys(wrong))


def _titles(schedules: Schedules) -> list[str]:
    """What each column decides: the comment of the group that most of its operations stand in."""
    lines = [line for table in schedules.tables.values() for line in table.lines]
    titles = []
    for column in range(max(len(line.columns) for line in lines)):
        cells = " ".join(cell for line in lines for cell in line.columns[column:column + 1])
        names = set(re.findall(r"\w+", cells))
        titles += Counter(schedules.groups.get(name) or "operations" for name in sorted(names)).most_common(1)
    return [title for title, _ in titles]


def markdown(schedules: Schedules) -> str:
    """The tables and their operations, for a page."""
    lines, titles = [], _titles(schedules)
    for name, table in schedules.tables.items():
        width = max(len(line.columns) for line in table.lines)
        lines += [f"| {name} | " + " | ".join(titles[:width]) + " |", "|---" * (width + 1) + "|"]
        for line in table.lines:
            times = "" if line.times == "1" else f" ({line.times} x)"
            cells = [" + ".join(re.findall(r"\w+", column)) for column in line.columns]
            lines.append(f"| {line.label}{times} | " + " | ".join(cells + [""] * (width - len(cells))) + " |")
        lines.append("")
    used = {name for table in schedules.tables.values() for line in table.lines for name in line.names}
    lines += ["| operation | writes | reads | what it does |", "|---|---|---|---|"]
    lines += [f"| {name} | {' '.join(sorted(one.writes)) or '–'} | {' '.join(sorted(one.reads)) or '–'} | {one.text} |"
              for name, one in schedules.operations.items() if name in used]
    return "\n".join(lines) + "\n"


def _module(name: str) -> Path:
    return next(RTL.rglob(f"{name}.v"))


def filled(page: str) -> str:
    """The page with its schedule blocks as the Verilog has them."""
    return BLOCK.sub(lambda block: block[1] + markdown(read(_module(block[2]).read_text())) + block[4], page)


def elaborated_lines(core: Core) -> set[int]:
    """LINES of every schedule instance below a core at its parameters, as pyslang elaborates them."""
    driver = Driver()
    driver.addStandardArgs()
    words = ["slang", "--std", "1364-2005", "--top", core.name, *(f"-G{k}={v}" for k, v in core.params.items()),
             *(f'"{source}"' for source in core.sources)]
    if not (driver.parseCommandLine(" ".join(words)) and driver.processOptions() and driver.parseAllSources()):
        return set()
    lines: set[int] = set()

    def visit(symbol: object) -> None:
        if type(symbol).__name__ == "InstanceSymbol" and symbol.definition.name == "schedule":
            lines.add(int(str(symbol.body.find("LINES").value)))

    driver.createCompilation().getRoot().visit(visit)
    return lines


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


def check(cores: tuple[Core, ...]) -> list[str]:
    """Everything wrong with the tables, with the pages that show them and with the latencies they give."""
    wrong = []
    for path in sorted(RTL.rglob("*.v")):
        text = path.read_text()
        if INSTANCE.search(text):
            wrong += problems(read(text), str(path.relative_to(ROOT)))
    for path in sorted(RTL.rglob("*.md")):
        page = path.read_text()
        if filled(page) != page:
            wrong.append(f"{path.relative_to(ROOT)}: stale schedule, fill it by `python -m ci.schedules --write`")
    for core in cores:
        if any(source.stem == "schedule" for source in core.sources):
            wrong += latency_problems(core, elaborated_lines(core))
    return wrong


def main() -> int:
    if "--write" in sys.argv[1:]:
        for path in sorted(RTL.rglob("*.md")):
            page = path.read_text()
            if filled(page) != page:
                path.write_text(filled(page))
                print(path.relative_to(ROOT))
    wrong = check(all_cores())
    print("\n".join(wrong) if wrong else "schedules: every table in order")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
