"""This module checks programs: no line may read a word that was not written, was overwritten, or is not ready.

A program is lines with successors, so that loops and jumps are followed on every path. A line reads and writes places
(registers, the root unit, the power that normalises) at known clocks; the checker finds out which line's word each read
gets. It is independent of the engine: `product_engine.decode` and its like say what a control word does.

The checker shares no code with what makes programs: neither with an assembler nor with the bit-true models.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

Place = Hashable
# The writes to a place on one path, the newest first: (line, clocks since it was read). Those that no read can find any
# more are left out.
History = tuple[tuple[int, int], ...]
BEFORE = -1  # the line of a word that was there before the first line
OLD = 99  # clocks: of a word that every read finds


@dataclass(frozen=True)
class Read:
    """A place that a line reads.

    Attributes
    ----------
    at : clock of the line, 0 the one in which its word is read, in which the place must hold the word.
    name : name of the word that the line means, empty where it says none.
    old : the line wants the word that was there before one that is on its way.
    """

    place: Place
    at: int = 0
    name: str = ""
    old: bool = False


@dataclass(frozen=True)
class Write:
    """A place that a line writes.

    Attributes
    ----------
    ready : first clock, counted as `Read.at` is, in which the place can be read.
    port : a memory: it cannot be read in the clock before `ready` either, in which it is written.
    needed : some line has to read it.
    also : another place in which the same word is found; where it is read there, it is read.
    """

    place: Place
    ready: int
    name: str = ""
    port: bool = True
    needed: bool = True
    also: Place | None = None


@dataclass(frozen=True)
class Line:
    """What one control word does; `wrong` are faults of the word itself."""

    label: str
    reads: tuple[Read, ...] = ()
    writes: tuple[Write, ...] = ()
    wrong: tuple[str, ...] = ()

    def write(self, place: Place) -> Write:
        """How it writes a place."""
        return next(one for one in self.writes if one.place == place)


@dataclass(frozen=True)
class Program:
    """Lines and how they follow one another; the first one begins.

    Attributes
    ----------
    then : for each line the lines that may be played in the next clock; none after the last.
    given : places that hold a word before the first line.
    results : places whose words are taken as results, so that no line has to read them.
    titles : how a message calls a place.
    table : the number in the table of each line, where a line occurs in several places; the line's own by default.
    """

    lines: Sequence[Line]
    then: Sequence[tuple[int, ...]]
    given: frozenset[Place] = frozenset()
    results: frozenset[Place] = frozenset()
    titles: dict[Place, str] = field(default_factory=dict)
    table: Sequence[int] | None = None

    def at(self, number: int) -> str:
        """How a message calls a line."""
        return f"line {(self.table or range(len(self.lines)))[number] + 1} '{self.lines[number].label}'"

    @cached_property
    def histories(self) -> list[dict[Place, frozenset[History]] | None]:
        """Before each line, the histories of the places on all paths to it; None for a line that no path leads to."""
        states: list[dict[Place, frozenset[History]] | None] = [None] * len(self.lines)
        states[0], work = {place: frozenset({((BEFORE, OLD),)}) for place in self.given}, [0]
        while work:
            number = work.pop()
            after = self._after(number, states[number])
            for then in self.then[number]:
                before = states[then]
                merged = after if before is None else {place: after.get(place, NEVER) | before.get(place, NEVER)
                                                       for place in after.keys() | before}
                if merged != before:
                    states[then] = merged
                    work.append(then)
        return states

    def _after(self, number: int, state: dict[Place, frozenset[History]]) -> dict[Place, frozenset[History]]:
        after = dict(state)
        for write in self.lines[number].writes:
            after[write.place] = frozenset(((number, 0), *one) for one in after.get(write.place, NEVER))
        for place, histories in after.items():
            if any(one and one[0][1] < OLD for one in histories):
                after[place] = frozenset(self._older(one, place) for one in histories)
        return after

    def _older(self, history: History, place: Place) -> History:
        kept = []
        for line, age in history:
            if line == BEFORE or age + 1 >= self.lines[line].write(place).ready:
                return (*kept, (line, OLD))
            kept.append((line, age + 1))
        return tuple(kept)

    def seen(self, read: Read, history: History) -> tuple[int | None, list[int]]:
        """The line whose word a read finds, None for none, and the lines whose words are on their way."""
        flying = []
        for line, age in history:
            if line == BEFORE or age + read.at >= self.lines[line].write(read.place).ready:
                return line, flying
            flying.append(line)
        return None, flying

    @cached_property
    def finds(self) -> list[set[tuple[Read, int | None]]]:
        """For each line its reads and the lines whose words they find."""
        return [{(read, self.seen(read, history)[0]) for read in line.reads
                 for history in (state or {}).get(read.place, NEVER)}
                for line, state in zip(self.lines, self.histories)]


NEVER = frozenset({()})


def straight(lines: Sequence[Line]) -> list[tuple[int, ...]]:
    """Successors of a table that is played downwards."""
    return [*((n + 1,) for n in range(len(lines) - 1)), ()]


def _fault(program: Program, read: Read, history: History) -> str:
    """What is wrong with a read after that history; empty where nothing is."""
    what = read.name or program.titles.get(read.place, str(read.place))
    writer, flying = program.seen(read, history)
    ports = [line for line in flying if program.lines[line].write(read.place).port]
    written = any(age + read.at == program.lines[line].write(read.place).ready - 1
                  for line, age in history if line in ports)
    if ports and (written or not read.old):
        return f"{what} is read while the word of {program.at(ports[0])} is on its way"
    if writer is None:
        return f"{what} is read, but no line before it has written it"
    if read.old and not flying:
        return f"{what} is to be read before it changes, and nothing changes it"
    name = "" if writer == BEFORE else program.lines[writer].write(read.place).name
    if read.name and name and read.name != name:
        return f"{what} is read, but {program.at(writer)} has put {name} in its place"
    return ""


def soundness(program: Program) -> list[str]:
    """What is wrong with a program, in the order of its lines; empty for a sound one."""
    wrong = []
    for number, (line, state) in enumerate(zip(program.lines, program.histories)):
        faults = list(line.wrong)
        if state is None:
            faults.append("no line leads to it")
        else:
            faults += [_fault(program, read, history) for read in line.reads
                       for history in sorted(state.get(read.place, NEVER))]
        wrong += [f"{program.at(number)}: {text}" for text in faults if text]
    table = program.table or range(len(program.lines))
    used = {(table[writer], read.place) for finds in program.finds for read, writer in finds
            if writer not in (None, BEFORE)}
    wrong += [f"{program.at(number)}: {write.name or program.titles.get(write.place, write.place)} is written, and no "
              "line reads it" for number, line in enumerate(program.lines) for write in line.writes
              if write.needed and write.place not in program.results
              and not used & {(table[number], place) for place in (write.place, write.also)}]
    return list(dict.fromkeys(wrong))
