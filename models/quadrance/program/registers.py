"""This module gives the words of a program their registers, once its lines have their places in time.

Results have the registers 2, 3, ... in their order. A direction that is held keeps an even register and the next one;
bits 2 and 3 of their number say which of the engine's three flags is the direction's. Emitted words have the registers
from 48 on, those with their negatives 56 to 62, those with flags 63. All other words share the rest.
"""

from __future__ import annotations

from collections.abc import Sequence

from quadrance.program.language import Program, Wrong
from quadrance.program.lines import Line
from quadrance.program.schedule import Order

COUNT = 64
FIRST = 2  # register of the first result
EMITTED = {"plain": range(48, 56), "both": range(56, 62), "far": range(62, 63), "flags": range(63, 64)}
SLOTS = {"": (16, 20, 24), "plain": (50, 54), "both": (58,)}  # of held directions that are no results, emitted or not


def _flag(register: int) -> int:
    """Which of the engine's flags a HOLD with that register sets."""
    return 3 if register & 8 else 2 if register & 4 else 1


def _held(program: Program, lines: Sequence[Line], fixed: dict[str, int]) -> dict[str, int]:
    """Registers of the directions that are held."""
    found: dict[str, int] = {}
    pairs: dict[int, list[str]] = {}
    for line in lines:
        if line.hold >= 0:
            pairs.setdefault(line.hold, []).append(line.dest)
    flags: dict[int, str] = {}
    for names in sorted(pairs.values(), key=lambda names: names[0] not in fixed):  # results first: theirs are given
        c, n = names[:2]
        if (c in fixed) != (n in fixed) or c in fixed and (fixed[c] % 2 or fixed[n] != fixed[c] + 1):
            raise Wrong(f"{program.path.name}: {c} and {n} are held: both are results, one after the other, the first "
                        "an odd one in the order, or neither is")
        emit = next(line.emit for line in lines if line.dest == c)
        free = [slot for slot in SLOTS[emit] if _flag(slot) not in flags and slot not in fixed.values()]
        if c not in fixed and not free:
            raise Wrong(f"{program.path.name}: {c} is one direction too many to be held, three can be")
        register = fixed[c] if c in fixed else free[0]
        if _flag(register) in flags:
            raise Wrong(f"{program.path.name}: {c} and {flags[_flag(register)]} are held and share a flag of the "
                        "engine: of the results' numbers from 2 on, bit 3 or else bit 2 has to tell them apart")
        flags[_flag(register)] = c
        for at, name in enumerate(names):
            found[name] = register + at % 2
    return found


def emitted(program: Program, lines: Sequence[Line]) -> dict[str, tuple[list[int], list[int]]]:
    """Of words that are emitted and read by lines, by how: their registers, and the lines that write them."""
    held = set(_held(program, lines, {}).values()) if program.streamed else set()
    read = {name for line in lines for name in line.registers}
    return {how: ([r for r in EMITTED[how][1:] if r not in held],
                  [i for i, line in enumerate(lines) if line.emit == how and line.dest in read and line.hold < 0])
            for how in EMITTED}


def near(program: Program, lines: Sequence[Line], found: dict[str, int]) -> dict[str, int]:
    """Registers of the words of `near` beside those of `found`: no line reads them, their numbers tell of the flag.

    Raises
    ------
    Wrong
        Where none is left.
    """
    given: dict[str, int] = {}
    for line in lines:
        if line.near >= 0 and line.dest not in given:
            flag = next(_flag(found[other.dest]) for other in lines if other.hold == line.near)
            taken = (*found.values(), *given.values())
            free = [r for r in range(47, FIRST, -1) if r not in taken and _flag(r) == flag]
            if not free:
                raise Wrong(f"{program.path.name}: too many registers: none is free for '{line.label}'")
            given[line.dest] = free[0]
    return given


def allocated(program: Program, lines: Sequence[Line], order: Order) -> dict[str, int]:
    """Name of each word -> its register.

    A register is free from the line on that reads it last: no word is read while another is on its way there.

    Raises
    ------
    Wrong
        Where 63 registers are too few.
    """
    place = {i: clock for clock, i in enumerate(order) if i is not None}
    fixed = {port.name: FIRST + i for i, port in enumerate(program.results)}
    found = fixed | _held(program, lines, fixed)
    if max(found.values(), default=0) >= COUNT:
        raise Wrong(f"{program.path.name}: {len(fixed)} results, and there are {COUNT - FIRST} registers for them")
    read = {name for line in lines for name in line.registers}
    last = {line.dest: place[i] for i, line in enumerate(lines) if line.dest}
    for i, line in enumerate(lines):
        for name in line.registers:
            last[name] = max(last[name], place[i])
    found |= near(program, lines, found)
    pools = emitted(program, lines)
    shared = [r for r in range(FIRST, 48 if program.streamed else COUNT) if r not in found.values()]
    free = dict.fromkeys(range(COUNT), -1)
    for i in sorted(range(len(lines)), key=place.__getitem__):
        line = lines[i]
        if not line.dest or line.dest in found:
            continue
        if line.emit and line.dest not in read:  # no line needs it, and it may be overwritten at once
            found[line.dest] = EMITTED[line.emit][0]
            continue
        pool = pools[line.emit][0] if line.emit else shared
        register = next((r for r in pool if place[i] >= free[r]), None)
        if register is None:
            raise Wrong(f"{program.path.name}: too many registers: none of {len(pool)} is free for {line.dest}")
        found[line.dest] = register
        free[register] = max(last[line.dest], place[i] + 1)
    return found
