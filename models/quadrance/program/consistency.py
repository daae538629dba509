"""This module checks what a program says as a whole: its names, and what the engine has once alone."""

from __future__ import annotations

from quadrance.program.language import ONE, Program, Statement

TABLE = set("""reg port last table of by nil plus minus slope back down flip nought power four twice lone add sub done
    keep high low mid other fold more above far near over out pair flag reach""".split())  # names of the printed table


def _given(program: Program) -> dict[str, int]:
    """Every name and the line that gives it, 0 for an input; each is given once, before it is read."""
    given: dict[str, int] = {ONE: 0} | dict.fromkeys(program.inputs, 0)
    for one in program.statements:
        for name in one.reads:
            if name not in given:
                raise program.wrong(one.line, f"{name} is not defined")
            if name in program.inputs and program.inputs[name].format == "power" and one.kind != "clamp":
                raise program.wrong(one.line, f"{name} is a power of two, which clamp alone multiplies by")
            if one.kind == "emit" and not given[name]:
                raise program.wrong(one.line, f"{name} is an input, and a word of a statement is emitted")
        for name in one.names:
            if name in program.signs or name in given:
                raise program.wrong(one.line, f"{name} is given twice")
            given[name] = one.line
    for name, line in given.items():
        if name in TABLE:
            raise program.wrong(line or 1, f"{name} is a name of the printed table: choose another")
    return given


def _last(program: Program) -> int:
    return program.statements[-1].line if program.statements else 1


def _results(program: Program, given: dict[str, int]) -> None:
    """Results, argued words and groups in time are words of statements; every word is used."""
    for port in program.results:
        if not given.get(port.name):
            raise program.wrong(_last(program), f"{port.name} is a result, and no statement gives it")
    for name in (*program.argued, *(name for group in program.order for name in group)):
        if not given.get(name):
            raise program.wrong(_last(program), f"{name} is argued or in an order, and no statement gives it")
    used = {port.name for port in program.results}.union(*(one.reads for one in program.statements))
    for name, line in given.items():
        if name not in used and name != ONE:
            raise program.wrong(line or 1, f"{name} is never used")
    if not program.results and not program.streamed:
        raise program.wrong(_last(program), "there is no out: the program has no result")
    if program.results and program.streamed:
        raise program.wrong(_last(program), "out and emit: results are held in registers or given one after the other")


def _once(program: Program, kept: list[Statement], what: str) -> None:
    if len(kept) > 1 and not program.streamed:
        raise program.wrong(kept[1].line, f"a second {what}: the status bit of the first would be lost")


def _margins(program: Program) -> None:
    """`near` speaks of a held direction, `far` of a clamped word that stands before it."""
    holds = {one.hold for one in program.statements} - {""}
    clamped = {name: one.line for one in program.statements if one.kind == "clamp" for name in one.names}
    said: set[tuple[str, str]] = set()
    for one in program.statements:
        if one.kind == "near" and one.of not in holds:
            raise program.wrong(one.line, f"{one.of} is no direction that is held")
        if one.kind == "far" and not clamped.get(one.of, one.line) < one.line:
            raise program.wrong(one.line, f"{one.of} is no word of clamp above this line")
        if one.of and (one.kind, one.of) in said and not (program.streamed and one.kind == "near"):
            raise program.wrong(one.line, f"a second {one.kind} of {one.of}")
        said.add((one.kind, one.of))


def _units(program: Program) -> None:
    """The engine has one flag for a reach and one for a clamp, a flag for each held direction, and three signs."""
    for kind in ("reach", "clamp"):
        _once(program, [one for one in program.statements if one.kind == kind], kind)
    for hold in dict.fromkeys(one.hold for one in program.statements if one.hold):
        _once(program, [one for one in program.statements if one.hold == hold], f"direction of {hold}")
    results = {port.name for port in program.results}
    for one in program.statements:
        if one.kind == "quotient" and any(other.kind in ("reach", "clamp") for other in program.statements):
            raise program.wrong(one.line, "a quotient beside reach or clamp: it changes the status bit of those")
        if "-" in one.signs and program.signs:
            raise program.wrong(one.line, "a minus beside sign inputs: the engine has it as one of them")
        if one.kind == "reach":
            readers = [other for other in program.statements if one.names[0] in other.reads]
            if len(readers) != 1 or readers[0].kind != "root" or one.names[0] in results:
                raise program.wrong(one.line, f"{one.names[0]} is of reach: one root reads it, and nothing else")


def check(program: Program) -> None:
    """Refuse a program that is none as a whole.

    Raises
    ------
    Wrong
        One line: file, line and reason.
    """
    _results(program, _given(program))
    _margins(program)
    _units(program)
