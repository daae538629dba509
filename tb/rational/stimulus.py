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
    lengths = [high, 0, 1, high >> 1, (high >> 1) + 1, min(64 << f, high), *rng.integers(0, high, 2, endpoint=True).tolist()]
    return [{port.name: length for port in core.cfg} for length in lengths] if core.cfg else [{}]


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core."""
    return {"in_j1": np.random.default_rng(1).permutation(turn_spreads(core.params["S"]))}
