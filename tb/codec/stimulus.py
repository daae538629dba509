"""Corners of rtl/codec: every quadrant border with its neighbours, the diagonals, the axes, no direction."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core

from tb.lib.stimulus import Vectors


def joint_words(spread_bits: int) -> np.ndarray:
    """Borders and middles of the quadrants with their neighbours, and spreads of one bit from either end."""
    s = spread_bits
    near = [(k << s) + j for k in range(4) for j in range(-4, 5)]
    middle = [(2 * k + 1 << s) // 2 + j for k in range(4) for j in (-1, 0, 1)]
    bits = [(k << s) + sign * (1 << i) for k in range(4) for i in range(s) for sign in (-1, 1)]
    return np.unique(np.array(near + middle + bits) % (4 << s))


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one codec; the vector without a direction stands between others, so that a hold shows."""
    if core.function == "spread_to_vector":
        return {"in_j": joint_words(core.params["S"])}
    top = 1 << core.params["W"] - 1
    sizes = sorted({0, 1, 2, top // 3, top // 2, top - 2, top - 1})
    words = np.array([*sizes, *(-v for v in sizes if v), -top])
    c, n = (grid.ravel() for grid in np.meshgrid(words, words))
    order = np.random.default_rng(1).permutation(c.size)
    blank = np.arange(c.size) % 11 == 3
    return {"in_c": np.where(blank, 0, c[order]), "in_n": np.where(blank, 0, n[order])}
