"""Corners of rtl/rational: quadrant borders, table ranges, saturation, undefined directions."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core

from tb.lib.stimulus import Vectors


def turn_spreads(s: int) -> np.ndarray:
    """Turn-spread words at each quadrant border, each power of two of the spread and of its complement, +-2."""
    steps = np.array(sorted({0, *(1 << i for i in range(s + 1))}))
    near = np.concatenate([steps, -steps])[:, None] + np.arange(-2, 3)
    words = np.arange(4)[:, None] * (1 << s) + near.ravel()
    return np.unique(words & (4 << s) - 1)


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Link lengths: longest, none, one LSB, the longest that never saturates, 64 units, and two at random."""
    high, f = (1 << core.params["W"]) - 1, core.params["F"]
    if len(core.cfg) == 2:
        half = min(32 << f, high)
        pairs = [(high, high), (0, 0), (half, half), (high, 1), (1, high), (0, half), (half, 0), (3 << f, 2 << f),
                 *rng.integers(0, high, (3, 2), endpoint=True).tolist(), *rng.integers(0, half, (3, 2)).tolist()]
        return [{"cfg_l1": l1, "cfg_l2": l2} for l1, l2 in pairs]
    lengths = [high, 0, 1, high >> 1, (high >> 1) + 1, min(64 << f, high),
               *rng.integers(0, high, 2, endpoint=True).tolist()]
    return [{port.name: length for port in core.cfg} for length in lengths] if core.cfg else [{}]


def points(w: int) -> tuple[np.ndarray, np.ndarray]:
    """Every pair of 0, powers of two of both signs and their neighbours; directions where the nearer axis changes."""
    high = 1 << w - 1
    near = {sign * (1 << i) + j for i in range(w) for j in (-1, 0, 1) for sign in (-1, 1)}
    edge = np.array(sorted(value for value in near if -high <= value < high))
    x, y = (grid.ravel() for grid in np.meshgrid(edge, edge, indexing="ij"))
    return x, y


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core; a singular sample follows and precedes a regular one."""
    rng = np.random.default_rng(1)
    if core.function.startswith("fk"):
        words = turn_spreads(core.params["S"])
        return {port.name: rng.permutation(words) for port in core.inputs}
    x, y = points(core.params["W"])
    order = np.append(rng.permutation(np.arange(x.size)), rng.integers(0, x.size, x.size // 8))
    x, y = x[order], y[order]
    zero = rng.random(x.size) < 0.05
    zero[:2] = True  # held word: 0 after reset
    return {"in_x": np.where(zero, 0, x), "in_y": np.where(zero, 0, y)}
