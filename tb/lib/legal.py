"""Legal parameters of a core, by the rule in its Verilog: their ranges, random sets, and the list that covers them.

The rule is the condition of `g_illegal`, in the core's module or in one below it; Verilator has the last word
on every set.
"""

from __future__ import annotations

import itertools
import math
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from quadrance import arms
from quadrance.arm import switches
from quadrance.cores import Core, all_cores
from quadrance.rules import Params, rule_of

from tb.lib import tools

WIDEST = 60  # bits, of a word that no rule limits: the models count in 64
LIMITS = {"R": 8}  # as far as it is worth going where the rule names no number
UNLIMITED = 150  # no rule has a number as large
FAR = 64  # the most that a parameter is moved to make another one legal
GAP = 9  # from one legal value of a parameter to the next: MULTIPLY is 18 or 27
KINDS = ("MODE", "PIPE")  # of building a core: each value has a first set, and sets of its own
# Sets of a cover list with switches of its own: enough for each length of a word to 24 bits.
# A further PIPE whose registers follow no width has a third of them.
MOST = 36


def near(core: Core, fixed: Params) -> Params | None:
    """Legal parameters with those of `fixed`, the others moved from the core's own as little as the rule asks for."""
    fixed = fixed | {name: value for name, value in core.params.items() if name in KINDS}
    rule, params = rule_of(core), core.params | fixed
    wrong = rule.broken(params)
    while wrong:
        if any(set(re.findall(r"\b[A-Z]\w*", clause)) <= set(fixed) for clause in wrong):
            return None
        moves = (params | {name: params[name] + sign * step} for step in range(1, FAR + 1) for name in params
                 if name not in fixed for sign in (-1, 1))
        best = next(((one, left) for one in moves if len(left := rule.broken(one)) < len(wrong)), None)
        if best is None:
            return None
        params, wrong = best
    return params


def ranges(core: Core) -> dict[str, tuple[int, int]]:
    """Lowest and highest legal value of every parameter, the others being what they have to be."""
    def end(name: str, step: int) -> int:
        value = core.params[name]
        while -1 < value < UNLIMITED:
            steps = range(step, (GAP + 1) * step, step)
            if (found := next((one for one in steps if near(core, {name: value + one}) is not None), None)) is None:
                break
            value += found
        return 1 if value < 0 else value if value < UNLIMITED else max(core.params[name], LIMITS.get(name, WIDEST))

    return {name: (end(name, -1), end(name, 1)) if name not in KINDS else (value, value)
            for name, value in core.params.items()}


def _pairs(row: Params) -> set[tuple[tuple[str, int], ...]]:
    return set(itertools.combinations(sorted(row.items()), 2))


def _switched(core: Core, names: list[str]) -> Iterator[Params]:
    """Values of the switches `names`: those of every arm, then further ones until every pair has had all its values."""
    own = {name: core.params[name] for name in names}
    seen = _pairs(own)
    for name in arms.known():
        if (row := switches(arms.load(name))).keys() <= own.keys():
            row = own | row
            seen |= _pairs(row)
            yield row
    rows = [dict(zip(names, row)) for row in itertools.product((0, 1), repeat=len(names))]
    while best := max((len(_pairs(row) - seen) for row in rows), default=0):
        row = next(row for row in rows if len(_pairs(row) - seen) == best)
        seen |= _pairs(row)
        yield row


def cover(core: Core) -> list[Params]:
    """Legal sets other than those of cores.toml, the same ones whenever the rule is the same.

    At most `MOST` of these: one parameter at a time at both ends of its range; the switches of every arm, and all pairs
    of switches; the neighbours of the ends; then sets of values that none of these has, of all parameters at once: 2^k
    and one less first, odd ones before even ones, each as far from all before it as there is. Behind them both ends
    once more, with the switches of each set of cores.toml that has other switches than the core's own.
    """
    most = MOST // 3 if core.params.get("PIPE") and "MULTIPLY" not in core.params else MOST
    box = ranges(core)
    toggles = [name for name, ends in box.items() if ends == (0, 1)]
    words = {name: ends for name, ends in box.items() if name not in toggles}
    listed_sets = [one.params for one in sets(core)]
    found: list[Params] = []

    def add(fixed: Params, limit: float = most) -> None:
        params = near(core, fixed)
        if params is not None and params not in [*listed_sets, *found] and len(found) < limit:
            found.append(params)

    for name, ends in words.items():
        for value in ends:
            add({name: value})
    for name in toggles if len(toggles) == 1 else ():
        add({name: 1 - core.params[name]})
    for row in _switched(core, toggles) if len(toggles) > 1 else ():
        add(row)
    for name, (low, high) in words.items():
        for value in (low + 1, high - 1):
            if low < value < high:
                add({name: value})
    while len(found) < most:
        fixed: Params = {}
        for name, (low, high) in words.items():
            seen = {one[name] for one in [*listed_sets, *found]}
            left = [value for value in range(low, high + 1) if value not in seen]
            left.sort(key=lambda value, seen=seen: (min(value & value + 1, value & value - 1) > 0, value % 2 == 0,
                                                    -min(abs(value - one) for one in seen)))
            fixed |= next(({name: value} for value in left if near(core, fixed | {name: value})), {})
        if not fixed:
            break
        before = len(found)
        add(fixed)
        if len(found) == before:
            break
    for listed in listed_sets:
        row = {name: listed[name] for name in toggles}
        for name, ends in words.items() if row != {name: core.params[name] for name in toggles} else ():
            for value in ends:
                add(row | {name: value}, math.inf)
    return found


def verdict(core: Core, params: Params) -> str:
    """What Verilator says of these parameters: nothing, "illegal", or its warnings."""
    with tempfile.TemporaryDirectory() as scratch:
        log = Path(scratch, "log")
        try:
            tools.run("verilator", "--lint-only", "-Wall", "--quiet", "--language", "1364-2005", "--top-module",
                      core.name, *(f"-G{key}={value}" for key, value in params.items()), *core.sources, log=log)
        except tools.ToolError as error:
            return "illegal" if "_needs_" in log.read_text() else str(error)
    return ""


def legal(core: Core, count: int, seed: int, tries: int = 400) -> list[Params]:
    """`count` random legal parameter sets, other than those of cores.toml; all there are where these are fewer.

    AssertionError when a set that the rule accepts does not pass Verilator without a warning.
    """
    rng, box, rule = np.random.default_rng([seed, *core.name.encode()]), ranges(core), rule_of(core)
    found: list[Params] = []
    seen = {tuple(one.params.items()) for one in sets(core)}
    for _ in range(tries):
        params = {name: int(rng.integers(low, high, endpoint=True)) for name, (low, high) in box.items()}
        if tuple(params.items()) in seen or rule.broken(params):
            continue
        seen.add(tuple(params.items()))
        said = verdict(core, params)
        assert not said, f"{core.name} {params}: {said}"
        found.append(params)
        if len(found) == count:
            break
    return found


def sets(core: Core) -> list[Core]:
    """The listed sets of the core, of its own mode and PIPE."""
    return [one for one in all_cores() if (one.name, one.architecture) == (core.name, core.architecture)
            and one.params.get("PIPE") == core.params.get("PIPE")]


def daily(core: Core) -> bool:
    """Whether `make test` runs this set in bulk: each MODE's first one at PIPE = 0. `make cover` has the rest."""
    return core.first_set and not core.params.get("PIPE")
