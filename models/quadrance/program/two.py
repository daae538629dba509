"""This module assembles a program for two poses at once: a run ends one pose and solves the first half of the next.

Between lines of one half the distances are those of any program; what the second half reads of the first is there since
the run before. So lines of one pose fill the clocks in which the other one waits. The order of the lines stands at the
end of the table. `halves` checks what comes out.
"""

from __future__ import annotations

import re
import textwrap
from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

from quadrance.program import assembler, halves, schedule, table
from quadrance.program.assembler import Assembled
from quadrance.program.language import ONE, Program, Wrong
from quadrance.program.lines import PORT, Line, added, lines
from quadrance.program.parser import load
from quadrance.program.ranges import proved
from quadrance.program.registers import COUNT, FIRST, near
from quadrance.program.schedule import Order, Rules
from quadrance.program.solver import solved

ORDER = "// Order of the lines of {}, for each PIPE"
SUFFIX = "_two"  # of the name of the table


def _second(program: Program, made: Sequence[Line]) -> set[int]:
    """The lines of the second half: results, held directions, their units and margins, and all that follows."""
    results = {port.name for port in program.results}
    groups: dict[tuple[str, int], set[int]] = defaultdict(set)
    for i, line in enumerate(made):
        for unit in ("fold", "root", "far"):
            groups[unit, getattr(line, unit)].add(i)
    units = [members for (_, group), members in groups.items() if group >= 0]
    found = {i for i, line in enumerate(made) if line.dest in results or max(line.hold, line.near) >= 0}
    while True:
        words = {made[i].dest for i in found} - {""}
        more = found | {i for i, line in enumerate(made) if words & set(line.registers) or line.after in found}
        more |= {made[i].after for i in found if made[i].after >= 0}
        more = more.union(*(members for members in units if members & found))
        if more == found:
            return found
        found = more


def _before(made: Sequence[Line], second: Collection[int]) -> set[int]:
    """The lines of the first half from which the second follows: all but the checks."""
    found: set[int] = set()
    while True:
        words = {name for i in (*second, *found) for name in made[i].registers}
        more = {i for i, line in enumerate(made) if line.dest in words and i not in second}
        more |= {made[i].after for i in more if made[i].after >= 0}
        if more <= found:
            return found
        found |= more


def halved(program: Program) -> tuple[list[Line], set[int]]:
    """The lines of a program, and which belong to the second half.

    An input of the pose that both halves read is loaded twice where the second half follows from the first one's word,
    so that the one may begin early and the other read late; a constant that only the second half reads is loaded there.
    """
    made = lines(program)
    second = _second(program, made)
    before = _before(made, second)
    for i, line in enumerate(list(made)):
        if line.source != PORT or line.dest != line.a or i in second:
            continue
        readers = {j for j, other in enumerate(made) if line.dest in other.registers}
        pose = line.a != ONE and program.inputs[line.a].port.startswith("in_")
        if pose and readers & second and readers & before:
            name = added(line.a, "s")
            made.append(replace(line, label=f"{name} = {line.a}", dest=name))
            for j in readers & second:
                made[j] = _renamed(made[j], line.dest, name)
        elif not pose and readers <= second:
            second.add(i)
    return made, second


def _renamed(line: Line, old: str, new: str) -> Line:
    """A line that reads another register."""
    a, b, *cd = (new if name == old else name for name in (line.a, line.b, *(line.cd or ())))
    return replace(line, a=line.a if line.source == PORT else a, b=b, cd=tuple(cd) if cd else None)


def rules(program: Program, made: Sequence[Line], second: Collection[int], at: schedule.Timing) -> Rules:
    """The rules of a run: those of each half, and those of the units, which both use in turn.

    A word of the first half is read by the second before that of the next pose takes its register. The first line is
    played while the program is idle: it is a load of the first half.
    """
    found = schedule.rules(program, made, at)
    writer = {line.dest: i for i, line in enumerate(made) if line.dest}
    same = {(i, j) for i, j, _ in found.edges if (i in second) == (j in second)}
    passed = [(j, writer[name], 1) for j in sorted(second) for name in dict.fromkeys(made[j].registers)
              if writer[name] not in second]
    loads = {i for i, line in enumerate(made) if i not in second and line.source == PORT
             and line.dest in (line.a, added(line.a, "s"))}
    return replace(found, edges=[edge for edge in found.edges if edge[:2] in same] + passed, last=found.last & same,
                   inner=set(range(len(made))) - loads)


def registers(program: Program, made: Sequence[Line], order: Order, second: Collection[int]) -> dict[str, int]:
    """Name of each word -> its register, in a run that follows another one.

    Raises
    ------
    Wrong
        Where 62 registers are too few.
    """
    place, run = {i: clock for clock, i in enumerate(order) if i is not None}, len(order)
    found = {port.name: FIRST + i for i, port in enumerate(program.results)}
    found |= near(program, made, found)
    spans = {}
    for i, line in enumerate(made):
        if line.dest and line.dest not in found:
            start = place[i] or -1  # the first line is played before the run too
            reads = [place[j] + run * (j in second and i not in second) for j, other in enumerate(made)
                     if line.dest in other.registers]
            spans[line.dest] = start, max([start + 1, *reads])
    free: dict[int, list[tuple[int, int]]] = {r: [] for r in range(FIRST, COUNT) if r not in found.values()}
    for name, (start, end) in sorted(spans.items(), key=lambda one: (0 <= one[1][0] and one[1][1] <= run, one[1])):
        register = next((r for r, taken in free.items() if all(
            end + shift <= first or last <= start + shift for first, last in taken for shift in (-run, 0, run))), None)
        if register is None:
            raise Wrong(f"{program.path.name}: two poses: too many registers: none of {len(free)} is free for {name}")
        free[register].append((start, end))
        found[name] = register
    return found


def assemble(program: Program, pipe: int, order: Order | None = None, seconds: float = assembler.SECONDS) -> Assembled:
    """A program of two poses as control words; its labels mark the second half. As `assembler.assemble` otherwise."""
    made, second = halved(program)
    found = rules(program, made, second, schedule.timing(pipe))
    if order is None:
        order = schedule.listed(program, found, len(made))
        if len(order) > len(made):
            order = (solved(found, len(made), order, seconds) or (order, False))[0]
    if wrong := schedule.faults(found, made, order):
        raise Wrong(f"{program.path.name}: order of two poses: {wrong[0]}")
    given = registers(program, made, order, second)
    numbers = {assembler.NIL: 0} | {assembler._cell(name): number for name, number in given.items()}
    numbers |= {f"I_{name.upper()}": i for i, name in enumerate((*program.inputs, ONE))}
    shown = [replace(line, label=halves.MARK * (i in second) + line.label) for i, line in enumerate(made)]
    two = replace(program, path=program.path.with_name(f"{program.name}{SUFFIX}.kin"))
    return Assembled(two, pipe, made, order, found, given, numbers, assembler._rows(shown, order, found))


def problems(one: Assembled) -> list[str]:
    """What the independent checker finds wrong with the words."""
    names = [dict(zip(("a", "b", "c", "d", "dest"), (cells[i] for i in (1, 3, 4, 5, 9)))) for _, cells in one.rows]
    pose = sum(port.port.startswith("in_") for port in one.program.inputs.values())
    margins = any(statement.kind in ("near", "far") for statement in one.program.statements)
    return halves.check(one.words, [label for label, _ in one.rows], names, one.results, one.pipe, range(pose), margins)


def table_path(path: Path) -> Path:
    """The file of the table of a program for two poses."""
    return path.with_name(f"{path.stem}{SUFFIX}_program.v")


def orders(path: Path) -> dict[int, Order]:
    """The committed orders by PIPE, of the table of a program."""
    at, found = table_path(path), defaultdict(list)
    _, _, text = (at.read_text() if at.exists() else "").partition(ORDER.format(path.name))
    for pipe, row in re.findall(r"^// pipe ([0-2]):((?: (?:-|\d+))+)$", text, re.M):
        found[int(pipe)] += [None if one == "-" else int(one) for one in row.split()]
    return dict(found)


def verilog(path: Path, every: dict[int, Order | None], seconds: float = assembler.SECONDS) -> str:
    """The table of a program for two poses, with its orders.

    Raises
    ------
    Wrong
        Where an order is none, or the checker finds a fault.
    """
    program = load(path)
    proved(program)
    made = [assemble(program, pipe, order, seconds) for pipe, order in sorted(every.items())]
    for one in made:
        if wrong := problems(one):
            raise Wrong(f"{path.name}: two poses: the checker refuses what was assembled: {wrong[0]}")
    text = table.verilog(made, f"{path.name} by `quadrance assemble` for two poses",
                         "Marked lines end the pose before. Clocks of a run")
    text += f"\n{ORDER.format(path.name)}\n"
    for one in made:
        numbers = " ".join("-" if i is None else str(i) for i in one.order)
        text += "".join(f"// pipe {one.pipe}: {row}\n" for row in textwrap.wrap(numbers, 105, break_on_hyphens=False))
    return text


def stale(folder: Path) -> list[str]:
    """A line for each table of two poses in a folder that is not what its text gives."""
    wrong = []
    for at in sorted(folder.glob(f"*{SUFFIX}_program.v")):
        path = at.with_name(at.name.replace(f"{SUFFIX}_program.v", ".kin"))
        try:
            if at.read_text() != verilog(path, orders(path)):
                wrong.append(f"{at.name}: stale: quadrance assemble {path.name} --poses 2 --write")
        except (Wrong, OSError) as error:
            wrong.append(f"{at.name}: {error}")
    return wrong
