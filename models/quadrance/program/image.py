"""This module makes the image of an assembled program: what a user loads into kinematics_engine, and a map of words.

An image is a dictionary for a JSON file. `load`, `inputs`, `run` and `outputs` turn it and values into commands.
"""

from __future__ import annotations

import binascii
from collections.abc import Mapping, Sequence

import numpy as np

from quadrance.fixed import Ints, ints
from quadrance.kinematics_engine import ENDS, FORGET, LINE, LOAD, READ, RUN, SEAL, WRITE, N
from quadrance.product_engine import ONE as WORD_OF_ONE
from quadrance.program.assembler import Assembled
from quadrance.program.language import ONE, Wrong

Command = tuple[int, int, int, int]  # in_kind, in_context, in_at, in_data
VERSIONS = 1 << 32


def crc(words: Sequence[int]) -> int:
    """The CRC x^16 + x^12 + x^5 + 1 of words of 48 bits, the highest bit first, from 0."""
    return binascii.crc_hqx(b"".join(word.to_bytes(6, "big") for word in words), 0)


def image(one: Assembled, start: int = 0, version: int = 0) -> dict:
    """The image of a program.

    Parameters
    ----------
    start : address of its header; the lines follow it.
    version : any number below 2^32; the engine answers with it.

    Raises
    ------
    Wrong
        Where its results cannot be read from registers, or a number is out of range.
    """
    program = one.program
    if program.streamed:
        raise Wrong(f"{program.path.name}: its results are emitted, and kinematics_engine has them in registers: out, "
                    "not emit")
    if not 0 <= version < VERSIONS or start < 0:
        raise Wrong(f"{program.path.name}: version {version} and start {start}: a version is from 0 to 2^32 - 1, and a "
                    "start is from 0")
    lines = [*one.words[:-1], one.words[-1] | ENDS]
    check = binascii.crc_hqx(version.to_bytes(4, "big"), crc(lines))
    used = {name for line in one.lines for name in (line.a, line.b, *(line.cd or ()))}
    found = [{"name": port.port, "at": at, "format": port.format} for at, port in enumerate(program.inputs.values())]
    if ONE in used:
        found.append({"name": ONE, "at": len(program.inputs), "format": "constant", "word": WORD_OF_ONE})
    return {"program": program.name, "version": version, "crc": f"{check:04x}", "pipe": one.pipe, "start": start,
            "clocks": clocks(len(lines), one.pipe), "inputs": found, "signs": list(program.signs),
            "outputs": [{"name": port.port, "at": one.registers[port.name], "format": port.format}
                        for port in program.results],
            "header": f"{version << 16 | check:012x}", "lines": [f"{word:012x}" for word in lines]}


def clocks(lines: int, pipe: int) -> int:
    """Latency of RUN."""
    return lines + 6 + pipe


def load(image: Mapping, start: int | None = None) -> list[Command]:
    """Commands that load a program, at another address where one is given."""
    at, header = image["start"] if start is None else start, int(image["header"], 16)
    return [(LOAD, 0, at, header), *((LINE, 0, 0, int(word, 16)) for word in image["lines"]), (SEAL, 0, at, header)]


def inputs(image: Mapping, context: int, words: Mapping[str, int]) -> list[Command]:
    """Commands that write words s2.25 of inputs by their names, and the constants of the program."""
    constants = {port["name"]: port["word"] for port in image["inputs"] if "word" in port}
    at = {port["name"]: port["at"] for port in image["inputs"]}
    return [(WRITE, context, at[name], int(word) & (1 << N) - 1) for name, word in ({**constants, **words}).items()]


def run(image: Mapping, context: int, signs: int = 0, forget: bool = False, start: int | None = None) -> Command:
    """The command that plays the program in a context; `forget`: no direction of an earlier run is held."""
    return RUN, context, image["start"] if start is None else start, signs | FORGET * forget


def outputs(image: Mapping, context: int) -> list[Command]:
    """Commands that read the results, in the order of the image."""
    return [(READ, context, port["at"], 0) for port in image["outputs"]]


def columns(commands: Sequence[Command]) -> dict[str, Ints]:
    """Commands as the ports of kinematics_engine."""
    names = ("in_kind", "in_context", "in_at", "in_data")
    return {name: ints(np.array(column)) for name, column in zip(names, zip(*commands))}
