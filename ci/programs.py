"""Reader of the programs: every instance of engine_program, and the machines that play a table of their own.

The words come from the elaborated design, the names of registers from the text of the table, and each line's names must
give its word. `quadrance.program.checker` then follows what a line reads, on every path. `MACHINES` says of each module
with a program how its words are to be understood; one that is not listed is an error.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from pyslang.driver import Driver
from quadrance.cores import ROOT, RTL, Core
from quadrance.program import checker, halves, product_engine, table
from quadrance.program.checker import Line, Program, Read, Write

PLAYERS = ("engine_program", "schedule", "schedule_counter")  # their TABLE is played
TABLE = re.compile(r"^[ \t]*localparam\s*\[[^\]]*\]\s*LINES\s*=\s*\{\s*\n((?:\s*/\*.*\n)+)", re.M)
NUMBER = re.compile(r"(\w+)\s*=\s*(\d+)'([bdh])([0-9a-fA-F]+)\s*(?=[,;])")
WAIT = re.compile(r"\{(?:(\d+) \* )?PIPE\{(\w+)\}\}")  # lines that are there for the registers of PIPE
ALIAS = re.compile(r"localparam\s*\[[^\]]*\]\s*(\w+)\s*=\s*(\{[\w\s,]+\});")
BASE = {"b": 2, "d": 10, "h": 16}


@dataclass(frozen=True)
class Played:
    """A table that an elaborated design plays: the module it stands in, the line of the instance, its words.

    pipe : PIPE of the design's product_engine, or of the module with the table.
    """

    module: str
    path: Path
    at: int
    player: str
    words: tuple[int, ...]
    pipe: int = 0

    def text(self) -> str:
        """What the module's file says of it: of a table for each PIPE, the one that is played, with its waits."""
        text = WAIT.sub(lambda wait: ", ".join([wait[2]] * int(wait[1] or 1) * self.pipe),
                        table.branch(self.path.read_text(), self.pipe))
        own = f" LINES_{self.pipe} = "
        return TABLE.sub("", text).replace(own, " LINES = ") if own in text else text


def elaborated(core: Core) -> tuple[object, list]:
    """slang's compilation of a core at its parameters, and every instance in it."""
    driver = Driver()
    driver.addStandardArgs()
    words = ["slang", "--std", "1364-2005", "--top", core.name, *(f"-G{k}={v}" for k, v in core.params.items()),
             *(f'"{source}"' for source in core.sources)]
    if not (driver.parseCommandLine(" ".join(words)) and driver.processOptions() and driver.parseAllSources()):
        return None, []
    compilation, found = driver.createCompilation(), []

    def visit(symbol: object) -> None:
        if type(symbol).__name__ == "InstanceSymbol":
            found.append(symbol)

    compilation.getRoot().visit(visit)
    return compilation, found


def _cut(values: int, lines: int, bits: int) -> tuple[int, ...]:
    return tuple(values >> bits * (lines - 1 - i) & (1 << bits) - 1 for i in range(lines))


def played(core: Core) -> list[Played]:
    """Every table that a core plays at its parameters."""
    compilation, instances = elaborated(core)
    sources = {source.stem: source for source in core.sources}
    pipe = next((int(one.body.find("PIPE").value.value) for one in instances
                 if one.definition.name == "product_engine"), 0)
    found = []
    for one in instances:
        name, body = one.definition.name, one.body
        if name in PLAYERS:
            lines, bits, values = (int(body.find(key).value.value) for key in ("LINES", "BITS", "TABLE"))
            path = Path(compilation.sourceManager.getFileName(one.location)).resolve()
            found.append(Played(path.stem, path, compilation.sourceManager.getLineNumber(one.location), name,
                                _cut(values, lines, bits), pipe))
        elif name.endswith("_program") and "reg " in re.sub(r"output\s+reg", "", sources[name].read_text()):
            own = int(body.find("PIPE").value.value) if body.find("PIPE") else 0
            values, bits = body.find(f"LINES_{own}") or body.find("LINES"), body.find("out_op").type.bitWidth
            lines = values.type.bitWidth // bits
            found.append(Played(name, sources[name], 0, name, _cut(int(values.value.value), lines, bits), own))
    return found


# What nothing reads


def _fields(*ends: tuple[int, int]) -> int:
    return sum((1 << high + 1) - (1 << low) for high, low in ends)


def _idle(word: int, roots: bool, margins: bool) -> int:
    """The bits of a line of product_engine that select nothing."""
    at, idle = product_engine.fields(word), 0
    if not at["add"]:  # a single product: C of a HOLD is its own register
        idle |= _fields((25, 20)) if margins and at["act"] & product_engine.HOLD else _fields((31, 20))
    if at["from"] in (product_engine.LAST, product_engine.TABLE):
        idle |= _fields((44, 39))
    if at["by"]:  # 1.0 has a sign, 0 has none; a power of two has its number, a slope its sign, too
        one, nought = at["b"] >> 5, at["b"] >> 2 & 1
        if one or nought or not roots:
            idle |= _fields((36, 35), (33, 32)) | (0 if one or roots else 1 << 34)
        elif at["b"] & 3:
            idle |= _fields((36, 35))
    if not at["act"] & (product_engine.FOLD | product_engine.MORE | product_engine.CHECK):
        idle |= product_engine.WRIST  # it says which bits of these count
    return idle


def _waiting(words: Sequence[int], pipe: int) -> list[bool]:
    """Of each line, whether nobody takes its word: register 0 has it, and no line near enough has LAST."""
    lines = [product_engine.fields(word) for word in words]
    return [not (at["dest"] or at["act"] or at["keep"])
            and all(near["from"] != product_engine.LAST for near in lines[number + 1:number + 2 + pipe])
            for number, at in enumerate(lines)]


@cache
def unread(core: Core) -> dict[str, tuple[int, ...]]:
    """For the memory of each program that product_engine plays, by its path in the core: bits that nothing reads.

    Behind the last line the words are 0. The first of them are read while the last line is computed: what they compute
    goes to register 0, which no line reads. So does the word of a line that waits: without a DEST, an act or KEEP, and
    none of the next lines takes it as LAST. The others behind the last line are never read.
    """
    _compilation, instances = elaborated(core)  # it owns them
    found = {}
    engine = next((one.body for one in instances if one.definition.name == "product_engine"), None)
    for one in instances if engine else ():
        if one.definition.name != "engine_program":
            continue
        lines, bits, drain, table_ = (int(one.body.find(key).value.value) for key in
                                      ("LINES", "BITS", "DRAIN", "TABLE"))
        roots, margins = (int(engine.find(key).value.value) for key in ("ROOTS", "MARGINS"))
        wide = bits == product_engine.BITS
        words = [word if wide else product_engine.widened(word) for word in _cut(table_, lines, bits)]
        waiting = _fields((46, 18), (16, 15)) | product_engine.WRIST
        masks = [waiting if waits else _idle(word, bool(roots), bool(margins))
                 for word, waits in zip(words, _waiting(words, int(engine.find("PIPE").value.value)))]
        masks += [waiting] * drain
        masks = [mask if wide else mask >> 17 << 6 for mask in masks]
        masks += [(1 << bits) - 1] * ((1 << (lines + drain - 1).bit_length()) - len(masks))
        found[f"{one.hierarchicalPath.removeprefix(f'{core.name}.')}.lines"] = tuple(masks)
    return found


# The text of a table


@dataclass(frozen=True)
class Row:
    """One line in the text of a table: its comment and its cells, names as they stand there."""

    label: str
    cells: tuple[str, ...]


@cache
def _numbers(text: str) -> dict[str, tuple[int, int]]:
    """Localparams: name -> value and bits."""
    found = {name: (int(value, BASE[base]), int(bits)) for name, bits, base, value in NUMBER.findall(text)}
    return found | {name: (int(value, 2), 1) for name, value in re.findall(r"(\w+) = 1'b([01])", text)}


def rows(text: str) -> list[Row]:
    """The lines of the table LINES of a module."""
    aliases = {name: cells for name, cells in ALIAS.findall(text)}
    found = []
    for label, body in re.findall(r"/\*\s*(.*?)\s*\*/\s*(.*?)\s*(?:\};)?\n", TABLE.search(text)[1]):
        items = re.findall(r"\{[^{}]*\}|\w+", body)
        found += [Row(label, tuple(re.sub(r"\s", "", one) for one in aliases.get(item, item).strip("{}").split(",")))
                  for item in items]
    return found


def value(text: str, row: Row) -> int:
    """The word that a row's names give."""
    numbers, word = _numbers(text), 0
    for cell in row.cells:
        parts = [numbers[name] for name in cell.split("|")]
        word = word << parts[0][1]
        for number, _ in parts:
            word |= number
    return word


def misread(text: str, words: Sequence[int]) -> list[str]:
    """Where the text of a table, as it is read here, is not what the design plays."""
    found = rows(text)
    if len(found) != len(words):
        return [f"{len(found)} lines are read, the design plays {len(words)}"]
    return [f"line {i + 1} '{row.label}': its names do not give its word" for i, (row, word) in
            enumerate(zip(found, words)) if value(text, row) != word]


def mislabelled(text: str, dests: Iterable[tuple[Row, str]], names: Iterable[str]) -> list[str]:
    """Lines whose comment is the name of a word, or its equation, and not of the one that the line writes."""
    known = {name.lower(): name for name in names}
    return [f"line {i + 1} '{row.label}': it writes {dest}" for i, (row, dest) in enumerate(dests)
            if known.get(row.label.split("=")[0].replace(" ", "").lower(), dest) != dest]


# The machines


ENGINE_CELLS = {11: dict(zip(("a", "b", "c", "d", "dest"), (1, 3, 4, 5, 9))),  # cells of a line of product_engine
                9: dict(zip(("a", "b", "c", "d", "dest"), (1, 3, 4, 5, 8)))}


def assembled(text: str, word: int) -> int:
    """The engine's word that a module makes of one of its table: `assign out_op = {op[35:6], 2'b00, ...}` or itself."""
    match = re.search(r"assign out_op = \{([^}]*)\};", text)
    if not match:
        return word
    made = 0
    for part in match[1].split(","):
        if cut := re.fullmatch(r"\s*op\[(\d+):(\d+)\]\s*", part):
            high, low = map(int, cut.groups())
            made = made << high - low + 1 | word >> low & (1 << high - low + 1) - 1
        else:
            bits, base, digits = re.fullmatch(r"\s*(\d+)'([bd])(\d+)\s*", part).groups()
            made = made << int(bits) | int(digits, BASE[base])
    return made


def _registers(text: str) -> set[str]:
    """Names of registers: those of the list of localparams that has no I_ of a port and ends a table's DEST."""
    cells = ENGINE_CELLS[len(rows(text)[0].cells)]
    return {row.cells[cells["dest"]] for row in rows(text)} - {"NIL"}


def product(results: Iterable[int], roots: bool = True, margins: bool = False) -> Callable[[Played, str], list[str]]:
    """The reading of a program of product_engine whose results are those registers."""
    def read(one: Played, text: str) -> list[str]:
        lines = rows(text)
        cells = ENGINE_CELLS[len(lines[0].cells)]
        names = [{key: row.cells[at] for key, at in cells.items()} for row in lines]
        words = [assembled(text, word) for word in one.words]
        return [*mislabelled(text, ((row, row.cells[cells["dest"]]) for row in lines), _registers(text)),
                *product_engine.check(words, [row.label for row in lines], names, frozenset(results), roots, one.pipe,
                                       margins)]

    return read


def two(results: Iterable[int], pose: int, margins: bool = False) -> Callable[[Played, str], list[str]]:
    """The reading of a program for two poses, whose ports from 0 to `pose` are the pose's."""
    def read(one: Played, text: str) -> list[str]:
        lines = rows(text)
        cells = ENGINE_CELLS[len(lines[0].cells)]
        names = [{key: row.cells[at] for key, at in cells.items()} for row in lines]
        dests = ((replace(row, label=row.label.removeprefix(halves.MARK)), row.cells[cells["dest"]]) for row in lines)
        return [*mislabelled(text, dests, _registers(text)),
                *halves.check(one.words, [row.label for row in lines], names, frozenset(results), one.pipe,
                              range(pose), margins)]

    return read


def _sums(text: str, at: Sequence[int], dest: int, ready: int) -> list[Line]:
    """Lines of a machine that reads its operands in one clock and writes their sum, ready some clocks later; `nil` is a
    word that no line has to read.
    """
    numbers = _numbers(text)
    return [Line(row.label, tuple(Read(numbers[row.cells[i]][0], 0, row.cells[i]) for i in at),
                 (Write(numbers[row.cells[dest]][0], ready, row.cells[dest], needed=row.cells[dest] != "nil"),))
            for row in rows(text)]


def space(one: Played, text: str) -> list[str]:
    """The reading of engine_gd_n_program: eight factors a line, read from the third line behind its writer on, with
    PIPE from the seventh.

    The lines of a joint follow those that begin a pass, or another joint, and a pass may follow them. Constants, the
    target, the words of a joint's page and of the next joint's are there before; so is u of the pass before, whose
    step is 0 in the first pass.
    """
    ready, joint = ((3, 11), (7, 42))[one.pipe]
    numbers, lines = _numbers(text), _sums(text, range(8), 8, ready)
    last = len(lines) - 1
    places = {place: name for name, (place, bits) in numbers.items() if bits == 6}
    given = {place for place, name in places.items() if place in (3, 4, 5, 6, 7) or name[0] in "tjlhku" or name in "cs"}
    results = {place for place, name in places.items() if name[0] in "gu" or name in "cs"}
    then = [(n + 1,) for n in range(last)] + [(joint, 0)]
    return checker.soundness(Program(lines, then, frozenset(given), frozenset(results), places))


def _steps(pipe: int) -> dict[str, int]:
    text = (RTL / "engine" / "rus" / "engine_rus_fk_steps.v").read_text()
    found = re.findall(r"([A-Z]+) = (?:PIPE == 0 \? )?8'd(\d+)(?: : 8'd(\d+))?[,;]", text)
    return {name: int(piped if pipe and piped else value) for name, value, piped in found}


def _after(line: int, i: int, j: int, jump: bool, at: dict[str, int]) -> list[tuple[int, int, int]]:
    """Lines that engine_rus_fk_steps may play behind one, with the legs i and j that they are played for."""
    over = {name: line == at[then] - 1 for name, then in (
        ("elbow", "COPY"), ("leg", "JUDGE"), ("judge", "NORM"), ("norm", "DOT"), ("pair", "SCALE"), ("scale", "SIDE"),
        ("move", "DONE"), ("done", "END"))}
    last_i, last_j = i == 6, j == 6
    to = [line + 1]
    if over["elbow"] and not last_i:
        to = [at["ELBOW"]]
    if over["leg"] and not last_i:
        to = [at["LEG"]]
    if over["judge"]:
        to = [line + 1, at["DONE"]]
    if line == at["SIZE"]:
        to = [line + 1, at["SCALE"]]
    if over["norm"] and last_i:
        to = [at["SIDE"]]
    if over["pair"]:
        to = [at["NORM"] if last_j else at["PAIR"]]
    if over["scale"]:
        to = [at["NORM"]]
    if over["move"]:
        to = [at["TURN"]]
    if over["done"]:
        to = []
    next_i, next_j = i, j
    if over["elbow"] or over["leg"] or over["pair"] and last_j or over["move"]:
        next_i = 1 if last_i else i + 1
    if over["norm"] or over["pair"] or jump:
        next_j = (0 if over["norm"] and last_i else i if over["norm"] else j) + 1
    return [(one, next_i, next_j) for one in to]


def parallel(one: Played, text: str) -> list[str]:
    """The reading of engine_rus_fk_program: four factors a line, read from the fourth line behind its writer on, and
    with PIPE from the fifth.

    Along every jump of engine_rus_fk_steps, for each leg i and row j. Start, link angle, legs and constants are there
    before. `t` is read by two lines of PAIR as it was before the next row's, which is on its way.
    """
    at, numbers, source = _steps(one.pipe), _numbers(text), rows(text)

    def place(name: str, i: int, j: int) -> tuple[int, int, int]:
        number = numbers[name][0]
        b4, b5, b6 = (number >> b & 1 for b in (4, 5, 6))
        row = (min(j + 1, 7) if b4 else j) if b5 else i
        return int(b5 or b6 and b4), row if b6 else 7 * b4, number & 15

    nodes, lines, then, index = [(at["ELBOW"], 1, 1)], [], [], {}
    for node in nodes:  # grows on the way
        line, i, j = node
        index[node] = len(lines)
        row = source[line]
        old = line - at["PAIR"] in (8, 9)
        lines.append(Line(row.label or f"{line + 1}", tuple(
            Read(place(name, i, j), 0, "" if name[0] in "RJK" else name, old and name == "t")
            for name in row.cells[:4]), () if row.cells[4] == "nil" else (
                Write(place(row.cells[4], i, j), 4 + one.pipe, "" if row.cells[4][0] in "RJK" else row.cells[4]),)))
        after = _after(line, i, j, row.cells[6] == "JUMP", at)
        nodes += [one for one in dict.fromkeys(after) if one not in index and one not in nodes]
        then.append(after)
    given = {place(name, i, 1) for name in numbers for i in range(1, 7) if numbers[name][1] == 7 and (
        numbers[name][0] < 9 or 32 <= numbers[name][0] < 41 or 64 <= numbers[name][0] < 77)}
    results = {place(name, 1, 1) for name, (number, bits) in numbers.items() if bits == 7 and number < 7}
    titles = {place(name, i, j): name for name in numbers if numbers[name][1] == 7
              for i in range(1, 7) for j in range(1, 7)}
    return checker.soundness(Program(lines, [tuple(index[one] for one in after) for after in then], frozenset(given),
                                     frozenset(results), titles, tuple(line for line, _, _ in nodes)))


MACHINES: dict[str, Callable[[Played, str], list[str]]] = {
    "engine_delta_program": product((3, 7, 11)), "engine_gd_n_program": space, "engine_rus_fk_program": parallel,
    "vector_ik6_program": product(range(2, 14)), "vector_ik6_two_program": two(range(2, 14), 12),
    "vector_ik6_near_program": product(range(2, 14), margins=True),
    "vector_ik6_near_two_program": two(range(2, 14), 12, margins=True),
    "vector_ik6_all_program": product(range(48, 64), margins=True),
    "vector_fk6_program": product(range(2, 14), roots=False),
    "vector_velocity6_program": product(range(2, 8), roots=False), "vector_rates6_program": product(range(2, 11)),
    "vector_ur_fk_program": product(range(2, 14), roots=False),
    "vector_ur_ik_program": product(range(2, 14), margins=True),
    "vector_ur_ik_all_program": product(range(48, 64), margins=True),
    "vector_srs_ik_program": product(range(2, 16), margins=True),
    "vector_xyzac_program": product(range(2, 5), roots=False),
    "vector_xyzbc_program": product(range(2, 5), roots=False)}


def problems(one: Played, text: str | None = None) -> list[str]:
    """What is wrong with a program; `text` instead of the module's."""
    text = one.text() if text is None else text
    where = one.path.relative_to(ROOT)
    if one.module not in MACHINES:
        return [f"{where}: nothing says what the words of this program do: ci.programs.MACHINES"]
    wrong = misread(text, one.words) or MACHINES[one.module](one, text)
    return [f"{where}: {line}" for line in wrong]
