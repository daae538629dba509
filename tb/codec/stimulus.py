"""Corners of rtl/codec: extremes, the diagonals, the axes, no direction."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core

from tb.lib.stimulus import Vectors


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one codec; the vector without a direction stands between others, so that a hold shows."""
    top = 1 << core.params["W"] - 1
    sizes = sorted({0, 1, 2, top // 3, top // 2, top - 2, top - 1})
    words = np.array([*sizes, *(-v for v in sizes if v), -top])
    c, n = (grid.ravel() for grid in np.meshgrid(words, words))
    order = np.random.default_rng(1).permutation(c.size)
    blank = np.arange(c.size) % 11 == 3
    return {"in_c": np.where(blank, 0, c[order]), "in_n": np.where(blank, 0, n[order])}
