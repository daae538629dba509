"""This module says what a 47-bit control word of rtl/program/product_engine.v does, and the rules of a program.

A word is {A 8, B 7, C 6, D 6, SUM 2, KEEP 1, ALIGN 2, DEST 6, ACT 9}. A line reads registers in its first clock (0),
chooses operands in the next (1) and computes in clock 2 + PIPE, in which its word is written: a register is not read in
that clock, but with PIPE 2, where the engine gives the new word.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from quadrance.program.checker import BEFORE, Line, Place, Program, Read, Write, soundness, straight

BITS = 47
REGISTER, PORT, LAST, TABLE = range(4)  # sources of A
HIGH, LOW, MID = range(3)  # ALIGN
FOLD, MORE, WRIST, ABOVE, ROOT, HOLD, FAR, CLAMP, CHECK = (1 << i for i in range(9))  # ACT

# Units beside the registers
WORD, POWER, NONE, LONG, RECIPROCAL = "the word before", "the power", "the root's flag", "FAR's flag", "the root"


@dataclass(frozen=True)
class Clocks:
    """When a line of the engine does what, its first clock being 0; a place shows its word from a clock on.

    Attributes
    ----------
    computes : the clock in which it computes, and in which its word can be chosen as LAST.
    register : first clock in which its register can be read.
    flags : first clock in which powers, outcomes of ROOT and of FAR can be used; `root`: the table's factors.
    """

    computes: int
    register: int
    flags: int
    root: int


def clocks(pipe: int) -> Clocks:
    """The clocks of an engine with that PIPE."""
    computes = 2 + pipe
    return Clocks(computes, computes + (pipe < 2), computes + 1, computes + (2 if pipe == 0 else 1))


def widened(word: int) -> int:
    """A word of 36 bits {A 8, B 7, C 6, D 6, SUM 2, KEEP 1, DEST 6}, for an engine without roots, as 47 bits."""
    return word >> 6 << 17 | (word & 63) << 9


def fields(word: int) -> dict[str, int]:
    """The fields of a word by their names; A and B are taken apart."""
    def bits(high: int, low: int) -> int:
        return word >> low & (1 << high - low + 1) - 1

    return {"from": bits(46, 45), "a": bits(44, 39), "by": bits(38, 38), "b": bits(37, 32), "c": bits(31, 26),
            "d": bits(25, 20), "add": bits(19, 19), "subtract": bits(18, 18), "keep": bits(17, 17),
            "align": bits(16, 15), "dest": bits(14, 9), "act": bits(8, 0)}


def decode(word: int, label: str = "", names: dict[str, str] | None = None, roots: bool = True, pipe: int = 0,
           margins: bool = True) -> Line:
    """What one word reads and writes.

    Parameters
    ----------
    names : names of the words in the registers of fields "a", "b", "c", "d" and "dest", where they are known.
    roots : whether the engine has its root unit (ROOTS).
    pipe : the engine's PIPE.
    margins : whether it has MARGINS, with which C of a HOLD is the register of its own word.
    """
    at, names, clock = fields(word), names or {}, clocks(pipe)
    act, reads, wrong = at["act"], [], []
    writes = [Write(WORD, clock.computes, port=False, needed=False)]

    def register(key: str) -> None:
        reads.append(Read(at[key], 0, names.get(key, "")))
        if at[key] == 0:
            wrong.append("register 0 is an operand, and lines without a DEST write it")

    if at["from"] == REGISTER:
        register("a")
    elif at["from"] == LAST:
        reads.append(Read(WORD, 1))
    elif at["from"] == TABLE:
        reads += [Read(RECIPROCAL, 1), Read(NONE, 1)]
    scaled = at["by"] and not at["b"] >> 5 and not at["b"] >> 2 & 1  # by the root's second factor or a power of two
    if not at["by"]:
        register("b")
    elif scaled:
        reads.append(Read(POWER if at["b"] & 3 else RECIPROCAL, 1))
    if (at["from"] == TABLE) != bool(scaled and not at["b"] & 3):
        wrong.append("the root's two factors are not multiplied with each other")
    if at["add"]:
        register("c")
        register("d")
    elif at["subtract"]:
        wrong.append("SUM subtracts a product that is not there")
    if at["align"] == 3:
        wrong.append("ALIGN is none of HIGH, LOW and MID")
    if at["align"] and (at["add"] or at["keep"]):
        wrong.append("LOW and MID take one product alone")
    if at["align"] and act & (ABOVE | CHECK) or at["align"] == MID and act & (ROOT | FAR):
        wrong.append("ABOVE and CHECK take a sum, ROOT and FAR a sum or a LOW word")
    if act & ROOT and act & HOLD or act & FOLD and act & MORE:
        wrong.append("two acts that exclude each other")
    if act & WRIST and not act & (FOLD | MORE | CHECK):
        wrong.append("WRIST without FOLD, MORE or CHECK")
    if act & CHECK and act & (WRIST | FAR):
        if not margins:
            wrong.append("NEAR or OVER, and the engine has no MARGINS")
        if act & ~(WRIST | FAR) != CHECK:
            wrong.append("NEAR or OVER with another act")
    if act & MORE:
        reads.append(Read(POWER, clock.computes))
    if act & (FOLD | MORE):
        writes.append(Write(POWER, clock.flags, port=False))
    if act & ROOT:
        reads.append(Read(POWER, clock.computes))
        writes += [Write(RECIPROCAL, clock.root, port=False), Write(NONE, clock.flags, port=False, needed=False)]
    if act & HOLD:
        reads += [Read(NONE, 1), Read(NONE, clock.computes)]
    if act & FAR:
        if at["align"] == LOW or act & CHECK:
            reads.append(Read(LONG, clock.computes))
        writes.append(Write(LONG, clock.flags, port=False, needed=False))
    if act & CLAMP:
        reads.append(Read(LONG, 1))
    if at["dest"]:
        writes.append(Write(at["dest"], clock.register, names.get("dest", ""), port=pipe < 2, also=WORD,
                            needed=not (act & CHECK and act & WRIST)))  # the word of NEAR is for none
        if at["keep"]:
            wrong.append("a part of a sum is written")
        if margins and act & HOLD and at["c"] not in (0, at["dest"]):
            wrong.append("HOLD writes another register's word")
    elif act & (HOLD | CLAMP) or act & CHECK and act & WRIST:
        wrong.append("HOLD, CLAMP or NEAR without a DEST")
    if not roots and (act or at["align"] or at["from"] == TABLE or scaled):
        wrong.append("the engine has no root unit")
    return Line(label, tuple(reads), tuple(writes), tuple(wrong))


def _neighbours(words: Sequence[int], then: Sequence[tuple[int, ...]], pipe: int) -> dict[int, list[str]]:
    """What is wrong between lines that follow one another: LAST and the sum of KEEP live for one clock."""
    wrong: dict[int, list[str]] = {}
    for number, word in enumerate(words):
        first = fields(word)
        if first["keep"] and not then[number]:
            wrong.setdefault(number, []).append("KEEP, and no line goes on with the sum")
        for behind in then[number]:
            if first["keep"] and fields(words[behind])["align"] != HIGH:
                wrong.setdefault(behind, []).append("the line before keeps its sum, and LOW and MID add none")
        behind = {number}
        for _ in range(clocks(pipe).computes - 1):
            behind = {line for one in behind for line in then[one]}
        for user in sorted(behind):
            if fields(words[user])["from"] == LAST and first["keep"]:
                wrong.setdefault(user, []).append("LAST is a part of a sum")
            if fields(words[user])["from"] == LAST and first["act"] & HOLD:
                wrong.setdefault(user, []).append("LAST is not the word that HOLD holds")
    return wrong


def program(words: Sequence[int], labels: Sequence[str] = (), names: Sequence[dict[str, str]] = (),
            results: frozenset[int] = frozenset(), roots: bool = True, pipe: int = 0, margins: bool = True) -> Program:
    """The program of a list of words that engine_program plays.

    Parameters
    ----------
    names : for each line the names of its registers' words, as `decode` takes them.
    results : registers whose words leave the engine.
    """
    lines = [decode(word, labels[i] if labels else "", names[i] if names else None, roots, pipe, margins)
             for i, word in enumerate(words)]
    then = straight(lines)
    first = fields(words[0])
    if first["keep"] or first["act"] & ~(FOLD | WRIST | ABOVE | ROOT) or first["dest"] in results:
        text = "it is played while the program is idle too: no KEEP, result, MORE, HOLD, FAR, CLAMP or CHECK in it"
        lines[0] = replace(lines[0], wrong=(*lines[0].wrong, text))
    for number, texts in _neighbours(words, then, pipe).items():
        lines[number] = replace(lines[number], wrong=(*lines[number].wrong, *texts))
    return Program(lines, then, results=results, titles={i: f"register {i}" for i in range(64)})


def _writers(made: Program, number: int, places: Iterable[Place]) -> set[int]:
    """The lines whose words a line finds in some of its places."""
    return {line for read, line in made.finds[number] if read.place in places and line is not None} - {BEFORE}


def _partial(words: Sequence[int], made: Program) -> list[str]:
    """A power is used when all words of its group, FOLD and each MORE after it, have gone into it."""
    changes = [number for number, word in enumerate(words) if fields(word)["act"] & (FOLD | MORE)]
    joined = {first: then for first, then in zip(changes, changes[1:]) if fields(words[then])["act"] & MORE}
    return [f"line {number + 1} '{line.label}': the power is used before line {joined[one] + 1} joins it"
            for number, line in enumerate(made.lines) if not fields(words[number])["act"] & MORE
            for one in sorted(_writers(made, number, (POWER,))) if one in joined]


def _held(words: Sequence[int], made: Program) -> list[str]:
    """HOLD asks whether the newest root was one of nothing: it must be the newest root that its word is made with."""
    depends = [_writers(made, number, {*range(64), WORD, RECIPROCAL}) for number in range(len(words))]
    roots = [{line for line in sources if fields(words[line])["act"] & ROOT} for sources in depends]
    changed = True
    while changed:
        changed = False
        for number, lines in enumerate(depends):
            more = roots[number].union(*(roots[line] for line in lines))
            if more != roots[number]:
                roots[number], changed = more, True
    wrong = []
    for number, word in enumerate(words):
        if not fields(word)["act"] & HOLD:
            continue
        newest = max(roots[number], key=lambda line: line if line <= number else line - len(words), default=None)
        asked = _writers(made, number, (NONE,))
        if asked != {newest}:
            wrong.append(f"line {number + 1} '{made.lines[number].label}': HOLD asks for another root than its word's")
    return wrong


def _whole(words: Sequence[int], made: Program) -> list[str]:
    """The engine turns the table's second factor where the newest root was one of 1.0: it must be the table's."""
    return [f"line {number + 1} '{line.label}': the root's second factor has the sign of another root"
            for number, line in enumerate(made.lines) if fields(words[number])["from"] == TABLE
            and _writers(made, number, (RECIPROCAL,)) != _writers(made, number, (NONE,))]


def _kept(words: Sequence[int], made: Program, pipe: int) -> list[str]:
    """A HOLD that writes its register's own word reads it like any other line."""
    kept = [(number, fields(word)["c"]) for number, word in enumerate(words) if fields(word)["act"] & HOLD]
    wrong = []
    for number, own in kept:
        late = [i for i, word in enumerate(words) if number - clocks(pipe).register < i < number
                and fields(word)["dest"] == own]
        wrong += [f"line {number + 1} '{made.lines[number].label}': its own word is on its way from line {i + 1}"
                  for i in late if own]
    return wrong


def _limited(words: Sequence[int], made: Program) -> list[str]:
    """CLAMP asks whether the newest FAR was beyond: it must be that of the word which the line limits."""
    return [f"line {number + 1} '{line.label}': CLAMP asks for another FAR than its word's"
            for number, line in enumerate(made.lines) if fields(words[number])["act"] & CLAMP
            and _writers(made, number, (LONG,)) != _writers(made, number, {*range(64), WORD})]


def check(words: Sequence[int], labels: Sequence[str] = (), names: Sequence[dict[str, str]] = (),
          results: frozenset[int] = frozenset(), roots: bool = True, pipe: int = 0, margins: bool = True) -> list[str]:
    """What is wrong with a program of control words; empty for a sound one. Parameters as for `program`."""
    made = program(words, labels, names, results, roots, pipe, margins)
    return (soundness(made) + _partial(words, made) + _held(words, made) + _whole(words, made)
            + margins * _kept(words, made, pipe) + _limited(words, made))
