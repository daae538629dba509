"""Corners of rtl/program: programs that are sound, cut, wrong or any bits at all, in contexts that take turns."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from quadrance.cores import RTL, Core
from quadrance.kinematics_engine import ENDS, INFO, LINE, LOAD, READ, RUN, SEAL, WRITE
from quadrance.program import assembler, image, parser, product_engine

from tb.lib.stimulus import Vectors

Command = image.Command
UNIT = """# The direction of a point, held where it has none, and another point seen from there
in coordinate x y u v
out vector c n
out coordinate a b
norm x y <= 1.42
norm u v <= 0.7
c, n = unit (x, y) hold
a = u*c + v*n
b = v*c - u*n
"""
FACTOR = 64  # of operand B: what follows is the number of a factor, not of a register
SLOPE, POWER, FOUR, TWICE, PLUS = (FACTOR | number for number in (0, 1, 2, 3, 32))
REGISTERS = (0, 1, 2, 4, 8, 16, 32, 63)  # of wild lines, and their ports


def sealed(lines: list[int], version: int) -> dict:
    """The image of any lines, the last one marked."""
    lines = [*lines[:-1], lines[-1] | ENDS]
    check = image.binascii.crc_hqx(version.to_bytes(4, "big"), image.crc(lines))
    return {"start": 0, "header": f"{version << 16 | check:012x}", "lines": [f"{word:012x}" for word in lines]}


def line(source: int, a: int, b: int, c: int = 0, d: int = 0, add: int = 0, keep: int = 0, align: int = 0,
         dest: int = 0, act: int = 0) -> int:
    """The word of a line; `b`: a register, or FACTOR and its number; `add`: 2 with C D added, 3 with it subtracted."""
    word = source << 6 | a
    word = word << 7 | b
    word = word << 12 | c << 6 | d
    word = word << 5 | add << 3 | keep << 2 | align
    return word << 15 | dest << 9 | act


def copied(at: int, **fields: int) -> int:
    """The line of a port times 1."""
    return line(product_engine.PORT, at, PLUS, **fields)


def wild(rng: np.random.Generator, count: int) -> list[int]:
    """Lines of any fields, most of them legal alone; words of a kind follow one another, so that flags meet."""
    acts = [0, 0, 0, *(1 << i for i in range(9)), product_engine.FOLD | product_engine.WRIST,
            product_engine.FOLD | product_engine.ABOVE, product_engine.HOLD | product_engine.CHECK,
            product_engine.CHECK | product_engine.WRIST, product_engine.CHECK | product_engine.FAR]
    factors = [0, 1, 2, 3, 8, 16, 24, 4, 32, 36]
    found = []
    for _ in range(count):
        if rng.random() < 0.1:
            found.append(int(rng.integers(0, ENDS)))
            continue
        by, single = rng.random() < 0.6, rng.random() < 0.6
        align = 0 if not single else int(rng.integers(0, 3))
        a, b, c, d, dest = rng.choice(REGISTERS, 5).tolist()
        source, b = int(rng.integers(0, 4)), FACTOR | int(rng.choice(factors)) if by else b
        add = 0 if single else int(rng.integers(2, 4))
        keep = int(rng.random() < 0.15)
        found.append(line(source, a, b, c, d, add, keep, align, dest, int(rng.choice(acts))))
    return found


def words(rng: np.random.Generator, context: int) -> list[Command]:
    """Any words at the ports of wild lines, also short ones and 0."""
    values = rng.integers(-(1 << 26), 1 << 26, 8) >> rng.choice([0, 0, 1, 3, 12, 27], 8)
    return [(WRITE, context, at, int(value) & (1 << 27) - 1) for at, value in zip(REGISTERS, values)]


def fuzz(core: Core, rng: np.random.Generator, programs: int) -> list[Command]:
    """Programs of any lines, played in all contexts in turn, with every register read."""
    commands, contexts = [], core.params["CONTEXTS"]
    for number in range(programs):
        one = sealed(wild(rng, int(rng.integers(4, 25))), number)
        at = int(rng.integers(0, 1 << core.params["N"]))
        commands += image.load(one, at)
        for context in rng.permutation(contexts)[:2].tolist() * 2:
            commands += words(rng, context)
            commands.append((RUN, context, at, int(rng.integers(0, 16))))
            commands += [(READ, context, register, 0) for register in rng.permutation(REGISTERS).tolist()]
    return commands


def wrong(core: Core, rng: np.random.Generator) -> list[Command]:
    """Loads that must be refused, programs that meet one another, runs of nothing."""
    end = (1 << core.params["N"]) - 1
    one, two = sealed(wild(rng, 6), 7), sealed(wild(rng, 5), 9)
    whole, header = image.load(one, 20), int(one["header"], 16)
    look, play = (INFO, 0, 20, 0), (RUN, 1, 20, 0)
    cut = [whole[0], *whole[1:4], whole[-1]]                    # lines are missing
    short = [*whole[:-2], whole[-1]]                            # the last one is missing
    open_ended = [*image.load(sealed(wild(rng, 4), 1) | {"lines": one["lines"][:4]}, 20)]
    bent = [*whole[:2], (LINE, 0, 0, whole[2][3] ^ 1 << 30), *whole[3:]]  # a bit is wrong
    false = [*whole[:-1], (SEAL, 0, 20, header ^ 1)]            # the CRC is wrong
    between = [*whole[:4], (READ, 0, 3, 0), *whole[4:]]
    found = [play, look, (SEAL, 0, 20, header), (LINE, 0, 0, 5)]
    for load in (cut, short, open_ended, bent, false, between):
        found += [*whole, look, play, *load, look, play]
    found += [*whole, (SEAL, 0, 20, header), look, *whole, (RUN, 1, 21, 0), (RUN, 2 % core.params["CONTEXTS"], 20, 0)]
    found += [*whole, *image.load(two, 23), play, (RUN, 1, 23, 0), look]  # the second lies in the first one's lines
    for start in (end - 2, end - 4):  # around the end of memory
        found += [*image.load(two, start), *words(rng, 0), (RUN, 0, start, 0), (INFO, 0, start, 0)]
        found += [(READ, 0, register, 0) for register in REGISTERS]
    return found + [(7, 0, 0, ENDS), (LOAD, 0, 3, 0), (SEAL, 0, 3, 0), (RUN, 0, 3, 0)]


def real(core: Core, rng: np.random.Generator) -> list[Command]:
    """Programs of six axes that fit: runs that never had a direction in every context, then arms, in turn."""
    names = [name for name, bits in (("vector_fk6", 6), ("vector_ik6", 8), ("vector_ur_ik", 10))
             if core.params["N"] >= bits]
    at, commands, images = 0, [], []
    for name in names:
        one = image.image(assembler.assembled(RTL / "program" / f"{name}.kin", core.params["PIPE"]), at, at)
        commands += image.load(one)
        images.append(one)
        at += len(one["lines"]) + 1
    for context in range(core.params["CONTEXTS"]):
        none = {port["name"]: 0 for port in one["inputs"] if "word" not in port}
        commands += [*image.inputs(one, context, none), image.run(one, context, forget=True),
                     *image.outputs(one, context)]
    for turn in range(12):
        for one in images:
            context = int(rng.integers(0, core.params["CONTEXTS"]))
            size = 0.05 if turn % 4 == 2 else 0.5
            values = {port["name"]: int(rng.integers(-1, 2) * rng.uniform(0, size) * 2**25) for port in one["inputs"]
                      if "word" not in port}
            commands += [*image.inputs(one, context, values), image.run(one, context, turn % 8, turn % 4 == 3),
                         *image.outputs(one, context)]
    return commands


def unit(core: Core) -> dict:
    """The image of a program that divides by a length."""
    return image.image(assembler.assemble(parser.parse(UNIT, Path("unit.kin")), core.params["PIPE"]))


def filled(core: Core, rng: np.random.Generator) -> list[Command]:
    """A program that copies ports to registers, in every context: they hold something when a reset comes. Then a sum
    of two is beyond the word, and the next one is not: that is unreachable all the same."""
    lines = [copied(at, dest=at) for at in REGISTERS[1:]]
    lines += [copied(1, keep=1), *(copied(at, act=product_engine.FAR) for at in (2, 4))]
    commands = image.load(sealed(lines, 3), 30)
    for context in range(core.params["CONTEXTS"]):
        commands += [(WRITE, context, at, int(rng.integers(1 << 25, 1 << 26))) for at in REGISTERS]
        commands += [(RUN, context, 30, 0), *((READ, context, at, 0) for at in REGISTERS)]
    return commands


def first(core: Core, rng: np.random.Generator) -> list[Command]:
    """The first run of each context, without a direction: what other contexts have run is none of its own."""
    one = unit(core)
    commands, words = image.load(one), {"in_x": 0, "in_y": 0, "in_u": 1 << 24, "in_v": 1 << 23}
    for context in rng.permutation(core.params["CONTEXTS"]).tolist():
        commands += [*image.inputs(one, context, words), image.run(one, context), *image.outputs(one, context)]
    return commands


def segments(core: Core, rng: np.random.Generator) -> list[Command]:
    """A point for each segment of the table, some between them without a direction; two for each leading bit."""
    one = unit(core)
    commands = image.load(one)
    q = np.minimum((np.arange(128, 1025) + 0.5) / 512, 2)  # the sums of the squares
    x, y = np.sqrt(np.where(q < 1, q, q / 2)), -np.sqrt(np.where(q < 1, 0, q / 2))
    points = np.insert((np.stack([x, y], -1) * 2**25).astype(int), range(0, x.size, 16), 0, axis=0)
    points = [*points.tolist(), *(at for i in range(26) for at in ((1 << i, 0), (0, 1 << i)))]
    for x, y in points:
        u, v = rng.integers(-(1 << 24), 1 << 24, 2)
        words = {"in_x": x, "in_y": y, "in_u": u, "in_v": v}
        commands += [*image.inputs(one, 1, words), image.run(one, 1)]
        if x == y:  # a start behind a reset, where every register of any context is 0
            commands += [(READ, int(rng.integers(0, core.params["CONTEXTS"])), register, 0)
                         for register in rng.permutation(REGISTERS).tolist()]
        commands += image.outputs(one, 1)[2:]
    return commands


def looked(core: Core, rng: np.random.Generator) -> list[Command]:
    """Every segment below q = 1/4, where programs of arms look for a root once in a million; and for a word of each bit
    alone, and 0: how it and its root are shifted, what CHECK says of it, and a register that is held where it is 0,
    read as each of the four operands."""
    port, table, low = product_engine.PORT, product_engine.TABLE, product_engine.LOW
    rest, least, one, held = [0] * 8, 2, 3, 32
    lines = [copied(2, dest=least), copied(16, dest=one), *rest,
             line(port, 1, least, align=low, act=product_engine.ROOT), *rest,
             line(table, 0, PLUS, dest=4), line(port, 8, SLOPE, align=low, dest=5),
             copied(4, act=product_engine.FOLD), *rest,
             *(line(port, 8, factor, align=low, dest=at) for factor, at in ((POWER, 6), (FOUR, 7), (TWICE, 8))),
             copied(4, act=product_engine.CHECK), product_engine.ROOT, *rest,
             copied(32, dest=held, act=product_engine.HOLD), *rest,
             line(product_engine.REGISTER, held, PLUS, dest=9), line(port, 16, held, dest=10),
             line(product_engine.REGISTER, 0, 0, held, one, add=2, dest=11),
             line(product_engine.REGISTER, 0, 0, one, held, add=2, dest=12)]
    commands = [*image.load(sealed(lines, 5), 30), (WRITE, 0, 2, 1), (WRITE, 0, 16, 1 << 25)]
    for segment in range(128):
        q = (segment << 9) + int(rng.integers(0, 1 << 9))
        words = {1: q << 7, 4: 1 << segment % 27 & (1 << 26) - 1, 8: 3, 32: 0x2CCCCCC if segment % 2 else 0x5333333}
        commands += [(WRITE, 0, at, word) for at, word in words.items()]
        commands += [(RUN, 0, 30, 0), *((READ, 0, at, 0) for at in range(4, 13))]
    return commands


def clamped(core: Core, rng: np.random.Generator) -> list[Command]:
    """A clamp behind the second test of its word, beyond either end: the end is still the one of the first."""
    rest = [0] * 8
    lines = [copied(1, align=product_engine.LOW, act=product_engine.FAR), *rest,
             copied(2, act=product_engine.CHECK | product_engine.FAR), *rest,
             copied(4, dest=4, act=product_engine.CLAMP)]
    commands = image.load(sealed(lines, 6), 30)
    for beyond, more in ((-1, 1), (-1, -1), (1, -1), (1, 1)):
        commands += [(WRITE, 0, at, word << 20 & (1 << 27) - 1) for at, word in ((1, beyond), (2, more), (4, 5))]
        commands += [(RUN, 0, 30, 0), (READ, 0, 4, 0)]
    return commands


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Commands in an order that means something; status bits come with random lines."""
    rng = np.random.default_rng(1)
    return image.columns([*first(core, rng), *filled(core, rng), *fuzz(core, rng, 6), *real(core, rng),
                          *wrong(core, rng), *fuzz(core, rng, 18), *segments(core, rng), *looked(core, rng),
                          *clamped(core, rng)])
