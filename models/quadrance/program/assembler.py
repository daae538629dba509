"""This module assembles a program: its text and the order of its lines become control words and a Verilog table.

The order is committed as comments at the end of the text, so that a table follows from it whatever scheduler has found
it.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from quadrance.program import product_engine, schedule
from quadrance.program.language import ONE, Program, Wrong
from quadrance.program.lines import Line, lines
from quadrance.program.parser import load
from quadrance.program.registers import EMITTED, allocated, emitted
from quadrance.program.schedule import Order, Rules
from quadrance.program.solver import solved

# Fields of a word from the top, their bits, and the numbers of their names
FIELDS: tuple[tuple[str, int, dict[str, int]], ...] = (
    ("source", 2, {"REG": 0, "PORT": 1, "LAST": 2, "TABLE": 3}), ("a", 6, {}),
    ("by", 1, {"OF": 0, "BY": 1}),
    ("b", 6, {"PLUS": 0b100000, "MINUS": 0b100100, "SLOPE": 0, "BACK": 0b001000, "DOWN": 0b010000, "FLIP": 0b011000,
              "NOUGHT": 0b000100, "POWER": 1, "FOUR": 2, "TWICE": 3}),
    ("c", 6, {}), ("d", 6, {}), ("sum", 2, {"LONE": 0, "ADD": 2, "SUB": 3}), ("keep", 1, {"DONE": 0, "KEEP": 1}),
    ("align", 2, {"HIGH": 0, "LOW": 1, "MID": 2}), ("dest", 6, {}),
    ("act", 9, {"OTHER": 0, "FOLD": 1, "MORE": 2, "WRIST": 4, "ABOVE": 8, "ROOT": 16, "HOLD": 32, "FAR": 64,
                "CLAMP": 128, "CHECK": 256, "NEAR": 260, "OVER": 320}))
NIL = "NIL"
OUT = {"plain": "OUT", "both": "PAIR", "flags": "FLAG", "far": "REACH"}  # DEST of a word that is emitted alone
Cells = tuple[str, ...]  # names, in the order of FIELDS
IDLE: Cells = ("PORT", NIL, "BY", "NOUGHT", NIL, NIL, "LONE", "DONE", "HIGH", NIL, "OTHER")
SECONDS = 60.0  # for an order
ORDER = "# Order of these lines by `quadrance assemble`, for each number of registers after the products"


@dataclass(frozen=True)
class Assembled:
    """A program with its lines in their order.

    Attributes
    ----------
    pipe : the engine's PIPE that it is for.
    numbers : of the names of registers and ports in the cells.
    rows : the label and the cells of each clock.
    """

    program: Program
    pipe: int
    lines: list[Line]
    order: Order
    rules: Rules
    registers: dict[str, int]
    numbers: dict[str, int]
    rows: list[tuple[str, Cells]]

    @property
    def roots(self) -> bool:
        """The program needs the root unit of the engine."""
        return any(cells[8:9] != ("HIGH",) or cells[10] != "OTHER" or cells[0] == "TABLE" for _, cells in self.rows)

    @property
    def clocks(self) -> int:
        """Latency of a core that plays it: its lines, the engine's clocks after the last one, and its result's."""
        return len(self.rows) + self.rules.timing.drain + 1

    @property
    def words(self) -> list[int]:
        """The control words."""
        found = []
        for _, cells in self.rows:
            word = 0
            for (_, bits, names), cell in zip(FIELDS, cells):
                number = 0
                for name in cell.split(" | "):
                    number |= names[name] if name in names else self.numbers[name]
                word = word << bits | number
            found.append(word)
        return found

    @property
    def places(self) -> list[int]:
        """Position of each word that is emitted, in the order of the text; a negative has the one after its word."""
        given = ("plain", "both", "flags")
        writer = {line.dest or line.a: i for i, line in enumerate(self.lines) if line.emit in given}
        at, position = 0, {}
        for i in self.order:
            if i in writer.values():
                position[i] = at
                at += 1 + (self.lines[i].emit == "both")
        return [position[writer[term.a]] for one in self.program.statements if one.kind == "emit"
                for (term,) in one.sums]

    @property
    def results(self) -> frozenset[int]:
        """Registers whose words leave the engine."""
        return frozenset(range(EMITTED["plain"][0], 64) if self.program.streamed else
                         (self.registers[port.name] for port in self.program.results))


def _cell(name: str) -> str:
    """A word as a cell shows it: in capitals, but for the last letter of one that the assembler has added."""
    return name if name[:1].isupper() else name.upper()


def _rows(made: Sequence[Line], order: Order, rules: Rules) -> list[tuple[str, Cells]]:
    """Labels and cells, a word that comes from the line before as LAST."""
    at = {i: clock for clock, i in enumerate(order) if i is not None}
    writer = {line.dest: i for i, line in enumerate(made) if line.dest}
    first = {}
    for i in sorted(at, key=at.__getitem__):
        if "FOLD" in made[i].acts:
            first.setdefault(made[i].fold, i)
    rows = []
    for i in order:
        if i is None:
            rows.append(("", IDLE))
            continue
        line, source, a, b, cd = made[i], made[i].source, made[i].a, made[i].b, made[i].cd
        for name in line.registers:
            if (writer[name], i) in rules.last and at[i] - at[writer[name]] == rules.timing.last:
                if cd and name in cd:
                    (a, b), cd = cd, (a, b)
                source, a, b = "LAST", NIL, b if a == name else a
        acts = {"MORE" if act == "FOLD" and first[line.fold] != i else act for act in line.acts}
        named = {"REG": _cell(a), "PORT": f"I_{a.upper()}", "LAST": NIL, "TABLE": NIL}[source]
        dest = _cell(line.dest) or OUT.get(line.emit, NIL)
        cells = (dest, NIL) if line.own else map(_cell, cd or (NIL, NIL))
        rows.append((line.label, (
            source, named, "BY" if line.by else "OF", line.by or _cell(b),
            *cells,
            "LONE" if not cd else "SUB" if line.minus else "ADD", "KEEP" if line.keep else "DONE", line.align, dest,
            " | ".join(name for name in FIELDS[-1][2] if name in acts) or "OTHER")))
    return rows


def assemble(program: Program, pipe: int = 0, order: Order | None = None, seconds: float = SECONDS) -> Assembled:
    """A program as control words.

    Parameters
    ----------
    pipe : registers after the products of the engine.
    order : of its lines; where there is none, one is looked for, at most `seconds` long where OR-Tools is installed.

    Raises
    ------
    Wrong
        Where the order is none of this text, or the registers are too few.
    """
    made = lines(program)
    rules = schedule.rules(program, made, schedule.timing(pipe))
    if order is None:
        guide = read_order(program) if pipe else None
        order = schedule.listed(program, schedule.guided(rules, guide) if guide else rules, len(made))
        readers = {line.dest: [i for i, user in enumerate(made) if line.dest in user.registers] for line in made}
        pools = [(len(pool), [(i, readers[made[i].dest]) for i in words]) for pool, words in
                 emitted(program, made).values() if words]
        order = (solved(rules, len(made), order, seconds, pools) or (order, False))[0]
    if wrong := schedule.faults(rules, made, order):
        raise Wrong(f"{program.path.name}: order: {wrong[0]}")
    registers = allocated(program, made, order)
    numbers = {NIL: 0} | {_cell(name): number for name, number in registers.items()}
    numbers |= {f"I_{name.upper()}": i for i, name in enumerate((*program.inputs, ONE))}
    if program.streamed:
        numbers |= {name: EMITTED[how][0] for how, name in OUT.items()}
    return Assembled(program, pipe, made, order, rules, registers, numbers, _rows(made, order, rules))


def problems(one: Assembled) -> list[str]:
    """What the independent checker finds wrong with the words."""
    names = [dict(zip(("a", "b", "c", "d", "dest"), (cells[i] for i in (1, 3, 4, 5, 9)))) for _, cells in one.rows]
    return product_engine.check(one.words, [label for label, _ in one.rows], names, one.results, one.roots,
                                one.pipe)


# The order at the end of a text


def _parted(path: Path) -> tuple[str, list[list[str]]]:
    """A text without its order, and the words of the lines of this; of no file nothing."""
    text, _, order = (path.read_bytes().decode() if path.exists() else "").partition(ORDER)
    rows = [line for line in order.splitlines() if line.strip()]
    if wrong := [line for line in rows if not re.fullmatch(r"# pipe [0-2]:( (-|[0-9]{1,8}))+", line)]:
        raise Wrong(f"{path.name}: '{wrong[0][:40]}' stands behind the order of the lines: equations come before it, "
                    "and its lines are '# pipe N: ' and numbers of lines, - for none")
    return text, [line.split() for line in rows]


def read_order(program: Program, pipe: int = 0) -> Order | None:
    """The committed order; None where there is none."""
    rows = [row[3:] for row in _parted(program.path)[1] if row[2] == f"{pipe}:"]
    return [None if one == "-" else int(one) for row in rows for one in row] or None


def orders(program: Program) -> list[int]:
    """Every PIPE for which an order is committed."""
    return [pipe for pipe in range(3) if read_order(program, pipe)]


def with_orders(path: Path, every: dict[int, Order]) -> str:
    """The text of a program with its orders by `pipe`."""
    text = f"{_parted(path)[0].rstrip()}\n\n{ORDER}\n"
    for pipe, order in every.items():
        numbers = " ".join("-" if i is None else str(i) for i in order)
        text += "".join(f"# pipe {pipe}: {row}\n" for row in textwrap.wrap(numbers, 110, break_on_hyphens=False))
    return text


def assembled(path: Path, pipe: int = 0, seconds: float = SECONDS) -> Assembled:
    """The program of a file in its committed order, or in a new one."""
    program = load(path)
    return assemble(program, pipe, read_order(program, pipe), seconds)
