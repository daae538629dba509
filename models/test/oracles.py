"""What status bits, ties and configuration words have to be: the table of oracles, and how a core's model is asked.

An oracle is a test that says from the page alone what a word is, in Python integers, fractions or mpmath. It imports
nothing of the model that it judges.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from quadrance.cores import Core, all_cores

Row = dict[str, int]
TABLE: dict[tuple[str, str], list[str]] = {}
"""(family.function, "status.<bit>" or "cfg.<word>") -> the tests that judge it."""


def sets_of(function: str, most: int = 2) -> list[Core]:
    """The first core of a function at its first parameter sets, and at the first with margin and slack: of words up to
    16 bits, of 20 and of 24.
    """
    cores = [core for core in all_cores() if f"{core.family}.{core.function}" == function]
    assert cores, f"cores.toml has no function {function}"
    found = [core for core in cores if core.name == cores[0].name]
    edged = {max(core.params["W"] + 3 >> 2, 4): core for core in reversed(found[most:]) if core.params.get("MARGINS")}
    return found[:most] + [edged[bits] for bits in sorted(edged)]


def keys(function: str) -> list[str]:
    """"status.<bit>" and "cfg.<word>" of a function in cores.toml."""
    core = sets_of(function)[0]
    return [*(f"status.{bit}" for bit in core.status or ()), *(f"cfg.{port.name[4:]}" for port in core.cfg)]


def oracle(*functions: str, status: Sequence[str] = (), cfg: Sequence[str] = ()) -> Callable:
    """The test judges these bits and words, of each function those that it has; it is run for its parameter sets."""
    def register(test: Callable) -> Callable:
        for function in functions:
            for key in set(keys(function)) & {*(f"status.{bit}" for bit in status), *(f"cfg.{word}" for word in cfg)}:
                TABLE.setdefault((function, key), []).append(test.__name__)
        cores = [core for function in functions for core in sets_of(function)]
        return pytest.mark.parametrize("core", cores, ids=lambda core: core.id)(test)
    return register


def ask(core: Core, rows: Sequence[Row], cfg: Row | None = None) -> list[Row]:
    """The model's answers to samples in their order, from a reset on; words and answers without in_ and out_."""
    columns = {f"in_{name}": np.array([row[name] for row in rows], dtype=np.int64) for name in rows[0]}
    words = {f"cfg_{name}": np.int64(word) for name, word in (cfg or {}).items()}
    answer = core.model(core.params, **columns, **words)
    found = {name[4:]: np.broadcast_to(column, len(rows)).tolist() for name, column in answer.items()}
    return [dict(zip(found, values)) for values in zip(*found.values())]


BITS = {"unreachable": 1, "singular": 2, "overflow": 4, "not_converged": 8, "no_rotation": 8}


def flags(core: Core, rows: Sequence[Row], cfg: Row | None = None, bit: str = "overflow") -> list[bool]:
    """A status bit of every sample."""
    return [bool(row["status"] & BITS[bit]) for row in ask(core, rows, cfg)]


def turned(core: Core, answer: Row, joint: int, end: str = "") -> float:
    """An answered joint, radians: a binary angle, or cosine and sine with `end` behind their names."""
    if f"j{joint}" in answer:
        return answer[f"j{joint}"] * 2 * math.pi / 2 ** core.params["A"]
    return math.atan2(answer[f"n{joint}{end}"], answer[f"c{joint}{end}"])


def near(core: Core, answer: Row, q: Sequence[float], end: str = "") -> bool:
    """The answered joints are these, to a hundredth of a radian."""
    return all(abs(math.remainder(turned(core, answer, i, end) - one, 2 * math.pi)) < 0.01
               for i, one in enumerate(q, 1))
