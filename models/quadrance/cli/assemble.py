"""`quadrance assemble`: a program of equations as control words, ranges and a Verilog table."""

from __future__ import annotations

import json
from pathlib import Path

from quadrance.cli.catalogue import Refused
from quadrance.program import assembler, ranges, table
from quadrance.program import image as images
from quadrance.program.assembler import Assembled
from quadrance.program.language import Wrong
from quadrance.program.parser import load


def _made(path: Path, pipe: int, seconds: float, anew: bool) -> Assembled:
    """A program in its committed order; `anew`: in a new one where that is none of the text."""
    try:
        return assembler.assembled(path, pipe, seconds)
    except Wrong:
        if not anew:
            raise
        return assembler.assemble(load(path), pipe, None, seconds)


def assemble(path: Path, pipe: int = 0, seconds: float = assembler.SECONDS,
             anew: bool = False) -> tuple[Assembled, dict[str, object]]:
    """A program, and what is to be said of it; `anew`: an order that is none of the text is looked for again.

    Raises
    ------
    Refused
        One line: file, line and reason.
    """
    try:
        program = load(path)
        intervals = ranges.proved(program)
        one = _made(path, pipe, seconds, anew)
        text = table.verilog([one])
    except Wrong as error:
        raise Refused(str(error)) from None
    if wrong := assembler.problems(one):
        raise Refused(f"{path.name}: the checker refuses what was assembled: {wrong[0]}")
    return one, {"program": program.name, "lines": len(one.rows), "idle": sum(not label for label, _ in one.rows),
                 "clocks": one.clocks, "registers": len(set(one.registers.values())),
                 "ranges": {name: [round(end, 4) for end in interval] for name, interval in intervals.items()},
                 "argued": list(program.argued), "words": [f"{word:012x}" for word in one.words], "verilog": text}


def write(one: Assembled, seconds: float = assembler.SECONDS) -> list[Path]:
    """Write the orders of the lines, and the table of every PIPE that has an order, beside the text.

    Raises
    ------
    Refused
        One line: file and reason.
    """
    program, path = one.program, one.program.path
    try:
        others = [_made(path, pipe, seconds, True) for pipe in assembler.orders(program) if pipe != one.pipe]
        every = sorted([one, *others], key=lambda other: other.pipe)
        paths = {assembler.order_path(program): assembler.order_text({other.pipe: other.order for other in every}),
                 table.table_path(path): table.verilog(every)}
    except Wrong as error:
        raise Refused(str(error)) from None
    for path, content in paths.items():
        try:
            path.write_text(content)
        except OSError as error:
            raise Refused(f"{path} cannot be written: {error.strerror}") from None
    return list(paths)


def image(one: Assembled, path: Path, start: int, version: int) -> dict:
    """Write the image of a program for kinematics_engine: a header of C where the file is one, else JSON.

    Raises
    ------
    Refused
        Where it can have none, or the file cannot be written.
    """
    try:
        made = images.image(one, start, version)
        path.write_text(images.header(made) if path.suffix == ".h" else json.dumps(made, indent=1) + "\n")
    except Wrong as error:
        raise Refused(str(error)) from None
    except OSError as error:
        raise Refused(f"{path} cannot be written: {error.strerror}") from None
    return made
