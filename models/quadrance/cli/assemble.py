"""`quadrance assemble`: a program of equations as control words, ranges and a Verilog table."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

from quadrance import arms
from quadrance.cli.catalogue import Refused
from quadrance.program import assembler, ranges, table, two
from quadrance.program import image as images
from quadrance.program.assembler import Assembled
from quadrance.program.language import Program, Wrong
from quadrance.program.parser import load

MARK = "`quadrance assemble`"  # stands at the head of what it writes


def _order(program: Program) -> str:
    """What is wrong with the order of a text, "" where there is none or it is one of PIPE 0, which guides others."""
    guide, count = assembler.read_order(program), len(assembler.lines(program))
    fits = guide is None or sorted(i for i in guide if i is not None) == list(range(count))
    return "" if fits else f"{program.path.name}: the order is not one of these {count} lines"


def _made(path: Path, pipe: int, seconds: float, anew: bool) -> Assembled:
    """A program in its committed order; `anew`: in a new one where that is none of the text."""
    program = load(path)
    wrong = _order(program)
    try:
        if wrong:
            raise Wrong(wrong)
        return assembler.assembled(path, pipe, seconds)
    except Wrong:
        if not anew:
            raise
        free = replace(program, path=path / path.name)  # where there is no order
        return replace(assembler.assemble(free, pipe, None, seconds), program=program)


def assemble(path: Path, pipe: int = 0, seconds: float = assembler.SECONDS,
             anew: bool = False) -> tuple[Assembled, dict[str, object]]:
    """A program, and what is to be said of it; `anew`: an order that is none of the text is looked for again.

    Raises
    ------
    Refused
        One line: file, line and reason.
    """
    try:
        arms.read(path)
    except arms.ArmError as error:
        raise Refused(str(error)) from None
    try:
        program = load(path)
        intervals = ranges.proved(program)
        one = _made(path, pipe, seconds, anew)
        text = table.verilog([one])
    except (Wrong, arms.ArmError) as error:
        raise Refused(str(error)) from None
    if wrong := assembler.problems(one):
        raise Refused(f"{path.name}: the checker refuses what was assembled: {wrong[0]}")
    return one, {"program": program.name, "lines": len(one.rows), "idle": sum(not label for label, _ in one.rows),
                 "clocks": one.clocks, "registers": len(set(one.registers.values())),
                 "ranges": {name: [round(end, 4) for end in interval] for name, interval in intervals.items()},
                 "argued": list(program.argued), "words": [f"{word:012x}" for word in one.words], "verilog": text}


def write(one: Assembled, seconds: float = assembler.SECONDS) -> list[Path]:
    """Write the orders of the lines into the text, and the table of every PIPE that has an order beside it.

    The table replaces what this command has written before, and no other file.

    Raises
    ------
    Refused
        One line: file and reason.
    """
    program, path = one.program, one.program.path
    try:
        others = [_made(path, pipe, seconds, True) for pipe in assembler.orders(program) if pipe != one.pipe]
        every = sorted([one, *others], key=lambda other: other.pipe)
        paths = {path: assembler.with_orders(path, {other.pipe: other.order for other in every}),
                 table.table_path(path): table.verilog(every)}
    except Wrong as error:
        raise Refused(str(error)) from None
    if not _ours(made := table.table_path(path), f"by {MARK}"):
        raise Refused(f"{made} is not of `quadrance assemble`, and is not overwritten")
    for path, content in paths.items():
        try:
            _replace(path, content)
        except OSError as error:
            raise Refused(f"{path} cannot be written: {error.strerror}") from None
    return list(paths)


def two_poses(path: Path, pipe: int, seconds: float = assembler.SECONDS, anew: bool = False) -> str:
    """The table of a program for two poses, of every PIPE that it is committed for and this one.

    `anew`: written beside the text, an order that is none of the text looked for again.

    Raises
    ------
    Refused
        One line: file, line and reason.
    """
    at = two.table_path(path)
    try:
        arms.read(path)
        known = two.orders(path)
        try:
            text = two.verilog(path, {pipe: None} | known, seconds)
        except Wrong:
            if not anew or not known:
                raise
            text = two.verilog(path, dict.fromkeys({pipe, *known}), seconds)
        if anew and not _ours(at, f"by {MARK}"):
            raise Refused(f"{at} is not of `quadrance assemble`, and is not overwritten")
        if anew:
            _replace(at, text)
    except (Wrong, arms.ArmError) as error:
        raise Refused(str(error)) from None
    except OSError as error:
        raise Refused(f"{at} cannot be written: {error.strerror}") from None
    return text


def _replace(path: Path, content: str) -> None:
    """Write a file as a whole or not at all: one of them is the user's own text."""
    partial = path.with_name(f"{path.name}.partial")
    try:
        partial.write_bytes(content.encode())
        if path.exists():
            shutil.copymode(path, partial)
        partial.replace(path.resolve())
    finally:
        partial.unlink(missing_ok=True)


def _ours(path: Path, mark: str = "") -> bool:
    """Whether a file may be replaced: there is none, or it has the mark; without one, it is an image in JSON."""
    try:
        text = arms.read(path).decode()
        return mark in text if mark else {"program", "header", "lines"} <= json.loads(text).keys()
    except (UnicodeDecodeError, json.JSONDecodeError, AttributeError, RecursionError):
        return False
    except arms.ArmError:  # nothing that can be read: what is no file is refused when it is written
        return not path.exists()


def image(one: Assembled, path: Path, start: int, version: int) -> dict:
    """Write the image of a program for kinematics_engine: a header of C where the file is one, else JSON.

    Raises
    ------
    Refused
        Where it can have none, or the file cannot be written.
    """
    if not _ours(path, f"; generated by {MARK}, do not edit. */" if path.suffix == ".h" else ""):
        raise Refused(f"{path} is no image, and is not overwritten")
    try:
        made = images.image(one, start, version)
        path.write_text(images.header(made) if path.suffix == ".h" else json.dumps(made, indent=1) + "\n")
    except Wrong as error:
        raise Refused(str(error)) from None
    except OSError as error:
        raise Refused(f"{path} cannot be written: {error.strerror}") from None
    return made
