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
        try:
            one = assembler.assembled(path, pipe, seconds)
        except Wrong:
            if not anew:
                raise
            one = assembler.assemble(program, pipe, None, seconds)
        text = table.verilog(one)
    except Wrong as error:
        raise Refused(str(error)) from None
    if wrong := assembler.problems(one):
        raise Refused(f"{path.name}: the checker refuses what was assembled: {wrong[0]}")
    return one, {"program": program.name, "lines": len(one.rows), "idle": sum(not label for label, _ in one.rows),
                 "clocks": one.clocks, "registers": len(set(one.registers.values())),
                 "ranges": {name: [round(end, 4) for end in interval] for name, interval in intervals.items()},
                 "argued": list(program.argued), "words": [f"{word:012x}" for word in one.words], "verilog": text}


def write(one: Assembled, text: str) -> list[Path]:
    """Write the order of the lines and the table beside the text."""
    program, pipe, every = one.program, one.pipe, {}
    for other in range(3):
        if other != pipe and (order := assembler.read_order(program, other)):
            every[other] = order
    paths = {assembler.order_path(program): assembler.order_text(dict(sorted({**every, pipe: one.order}.items())))}
    paths[table.table_path(program.path, pipe)] = text
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
