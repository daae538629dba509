"""The shortest words with which a core, or a core with codecs at its joints, reaches an accuracy at the tip.

Coordinates have W - F bits before the point, sign included, as few as the arm's reach needs: one more where a core does
not reach the target so.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
from quadrance import cores
from quadrance.arms import Arm

from ci.report.designs import OUTSIDE, RULES, Design, Values, parts, rule, total, word_type
from tb.lib import legal


def limits(design: Design, arm: Arm) -> dict[str, float]:
    """Targets in LSB of Q7.8, by their names."""
    return {name: one["lsb"] if "lsb" in one else one["mm"] / arm.mm_per_unit * 256
            for name, one in design.rules["target"].items()}


def _lowest(error: Callable[[Values], float], values: Values, key: str, low: int, limit: float) -> Values:
    """`values` with `key` as low as the limit allows, by bisection: the error falls with every word's bits."""
    high = values[key]
    while low < high:
        middle = (low + high) // 2
        if error(values | {key: middle}) <= limit:
            high = middle
        else:
            low = middle + 1
    return values | {key: high}


def _longest(legal: Callable[[Values], bool], grid: dict[str, tuple[int, int]], start: Values) -> Values | None:
    """`start` with the longest joint words that are legal together."""
    words = [key for key in grid if key not in ("W", "F")]
    every = itertools.product(*(range(grid[key][1], grid[key][0] - 1, -1) for key in words))
    sets = (start | dict(zip(words, one)) for one in sorted(every, key=sum, reverse=True))
    return next((values for values in sets if legal(values)), None)


def _shortened(error: Callable[[Values], float], values: Values, lowest: dict[str, int], order: list[str],
               limit: float) -> Values:
    """`values` with words as low as the limit allows, in that order; then a bit more of one where that saves two."""
    for key in order:
        values = _lowest(error, values, key, lowest[key], limit)
    better: Values | None = values
    while better:
        values = better
        trades = (_lowest(error, values | {one: values[one] + 1}, other, lowest[other], limit)
                  for one, other in itertools.permutations(order, 2))
        better = next((trade for trade in trades if bits(trade) < bits(values)), None)
    return values


def bits(values: Values) -> int:
    """Bits of a coordinate and of every kind of joint word: what the area grows with."""
    return sum(value for key, value in values.items() if key != "F")


def shortest(error: Callable[[Values], float], legal: Callable[[Values], bool], grid: dict[str, tuple[int, int]],
             whole: int, limit: float) -> list[Values]:
    """Value sets with the fewest `bits` that keep to the limit.

    Parameters
    ----------
    error : of values, LSB of Q7.8; infinite for an illegal set.
    legal : whether there is a core of these values.
    grid : lowest and highest value of W, F and every joint word.
    whole : the fewest bits of a coordinate before its point, sign included.
    limit : LSB of Q7.8.

    Returns
    -------
    list of dict
        Of the coarsest F that keep to it, `RULES["finer"]` and one more of them.
    """
    words = [key for key in grid if key not in ("W", "F")]
    lowest = {key: grid[key][0] for key in words}
    found: list[Values] = []
    reached = 0
    for f in range(grid["F"][0], grid["F"][1] + 1):
        for w in dict.fromkeys(max(grid["W"][0], f + room) for room in (whole, whole + 1)):
            longest = _longest(legal, grid, {"W": w, "F": f}) if w <= grid["W"][1] else None
            if longest is None or error(longest) > limit:
                continue
            found += [_shortened(error, longest, lowest, order, limit) for order in (words, words[::-1])]
            reached += 1
            break
        if reached > RULES["finer"]:
            break
    least = min(map(bits, found), default=0)
    return [one for i, one in enumerate(found) if bits(one) == least and one not in found[:i]]


def grid_of(design: Design) -> dict[str, tuple[int, int]]:
    """Lowest and highest value of every parameter that is searched."""
    core = cores.find(design.core)
    ranges = legal.ranges(core)
    for key in () if rule(core.name) else core.params:  # a rule that a part has: what is listed as illegal
        wrong = [one[key] for one in core.illegal if list(one) == [key]]
        longest = RULES["longest"][word_type(core)]
        ranges[key] = (max((one + 1 for one in wrong if one < core.params[key]), default=1),
                       min((one - 1 for one in wrong if one > core.params[key]), default=longest))
    return {"W": ranges["W"], "F": tuple(design.rules["fraction"])} | {
        key: ranges[key] for key in RULES["words"] if key in ranges}


class _Errors:
    """The error of a design by its values, each worked out once: of some samples, and of all."""

    def __init__(self, design: Design, arm: Arm) -> None:
        self.design, self.arm = design, arm
        self.quick: dict[tuple, float] = {}
        self.full: dict[tuple, float] = {}

    def __call__(self, values: Values) -> float:
        key = tuple(values.items())
        if key not in self.quick:
            self.quick[key] = total(self.design, values, self.arm, RULES["quick"])
        return max(self.quick[key], self.full.get(key, 0.0))

    def exact(self, values: Values) -> float:
        key = tuple(values.items())
        if key not in self.full:
            self.full[key] = total(self.design, values, self.arm, RULES["samples"])
        return self.full[key]

    def legal(self, values: Values) -> bool:
        return parts(self.design, values) is not None

    def found(self, picks: dict[str, tuple | None]) -> dict:
        return {"best": min(self.quick.values(), default=float("inf")), "picks": picks}


def search(design: Design, arm: Arm) -> dict:
    """The shortest words of a core for every target.

    Returns
    -------
    dict
        ``best``: the least error seen; ``picks``: target -> (values, error over all samples), None out of reach. Of
        sets of as many bits the sharpest.
    """
    error, grid = _Errors(design, arm), grid_of(design)
    whole = int(np.floor(np.log2(sum(arm.links)))) + 2
    picks: dict[str, tuple | None] = {}
    for name, limit in limits(design, arm).items():
        found = shortest(error, error.legal, grid, whole, limit)
        while any([error.exact(one) > limit for one in found]):  # quick samples had missed the worst; now it is known
            found = shortest(error, error.legal, grid, whole, limit)
        picks[name] = min(((one, error.exact(one)) for one in found), key=lambda pair: pair[1], default=None)
    return error.found(picks)


def outside(design: Design, sets: list[Values], arm: Arm) -> dict:
    """The shortest word outside the codecs of a core, for the target of the scenarios; as `search` returns it.

    Parameters
    ----------
    sets : values that the core may have, those of its own `search`.
    """
    error, found = _Errors(design, arm), []
    limit, low = limits(design, arm)[RULES["scenario"]], RULES["shortest"]
    for inside in sets:
        values = _longest(error.legal, {OUTSIDE: (low, RULES["longest"][design.word])}, inside)
        if values is None or error(values) > limit:
            continue
        shorter = _lowest(error, values, OUTSIDE, low, limit)
        while error.exact(shorter) > limit and shorter != values:
            shorter = _lowest(error, values, OUTSIDE, low, limit)
        found.append(shorter)
    least = min(((one, error.exact(one)) for one in found if error.exact(one) <= limit), default=None,
                key=lambda pair: (bits(pair[0]), pair[1]))
    return error.found({RULES["scenario"]: least})
