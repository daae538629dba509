"""This module checks a program for two poses: runs whose marked lines end the pose that the run before has begun.

It writes out the runs of three poses, with the clocks between them, and hands them to the checker of one program, where
words have the names of their poses. It shares no code with what makes programs.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from quadrance.program import product_engine
from quadrance.program.product_engine import ABOVE, CHECK, CLAMP, FAR, HOLD, PORT, WRIST, fields

MARK = "< "  # begins the label of a line of the second half
POSES = 3
NOTHING = PORT << 45 | 1 << 38 | 4 << 32  # PORT * 0
EARLY, LATE = (8, 16), (24,)  # B with a sign: BACK and DOWN, FLIP
PLUS = 32


def _half(word: int, late: bool, results: Collection[int], pose: Collection[int]) -> str:
    """What a line does that the other half alone can do; "" for nothing."""
    at = fields(word)
    near = at["act"] & CHECK and at["act"] & WRIST
    sign = at["b"] if at["by"] and not at["b"] >> 5 and at["from"] == product_engine.TABLE else 0
    if late:
        if at["from"] == PORT and at["a"] in pose:
            return "the second half reads a port of the pose, which is the next one's"
        return "the first half's sign or flag in the second" if sign in EARLY or not near and at["act"] & (
            ABOVE | FAR | CLAMP | CHECK) else ""
    return "the second half's sign, flag or result in the first" if (
        sign in LATE or near or at["act"] & HOLD or at["dest"] in results) else ""


def check(words: Sequence[int], labels: Sequence[str], names: Sequence[dict[str, str]], results: Collection[int],
          pipe: int, pose: Collection[int], margins: bool = False) -> list[str]:
    """What is wrong with a program of two poses; empty for a sound one.

    Parameters
    ----------
    words, labels, names, results, pipe, margins : as for `product_engine.check`; labels of the second half begin with
        MARK.
    pose : numbers of the ports that are the pose's.
    """
    late = [label.startswith(MARK) for label in labels]
    wrong = [f"line {i + 1} '{labels[i]}': {text}" for i, word in enumerate(words)
             if (text := _half(word, late[i], results, pose))]
    first = fields(words[0])
    if (first["from"], first["by"], first["b"], first["add"], first["act"]) != (PORT, 1, PLUS, 0, 0) or late[0]:
        wrong.append(f"line 1 '{labels[0]}': it is played between runs too: a load of the first half is expected")
    drain = product_engine.clocks(pipe).register  # or more clocks are between two runs

    played: list[tuple[int, str, dict[str, str]]] = []
    for run in range(POSES + 1):
        for i, word in enumerate(words):
            of = run + 1 - late[i]
            label = f"{labels[i]}, pose {of}"
            played.append((word, label, {key: f"{name} of pose {of}" for key, name in names[i].items()})
                          if 1 <= of <= POSES else (NOTHING, label, {}))
        if run < POSES:
            played += [(NOTHING, "", {})] * drain
            played.append((words[0], "between runs", {key: f"{name} between runs" for key, name in names[0].items()}))
    found = product_engine.check(*zip(*played), frozenset(results), True, pipe, margins)
    clocks = len(words) + drain + 1
    return wrong + [re.sub(r"line (\d+)", lambda match: f"line {(int(match[1]) - 1) % clocks + 1}", text)
                    for text in found if not ("'between runs'" in text and "no line reads it" in text)]
