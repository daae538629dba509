"""Corners of rtl/paper: quadrant borders and their neighbours, the axes, the origin, saturation."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core

from tb.lib.stimulus import Vectors


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Link lengths from the greatest to none: saturating, the longest that never saturates, common, short."""
    if not core.cfg:
        return [{}]
    half = 1 << core.params["W"] - 1
    some, long = int(rng.integers(half // 16, half)), int(rng.integers(half, 2 * half))
    return [{"cfg_l1": length} for length in (2 * half - 1, half, half - 1, some, long, 1, 0)]


def joint_words(core: Core) -> np.ndarray:
    """Every quadrant border with its neighbours, the middles, and spreads of one bit."""
    s = core.params["S"]
    near = [(k << s) + j for k in range(4) for j in (-2, -1, 0, 1, 2)]
    middle = [(2 * k + 1 << s - 1) + j for k in range(4) for j in (-1, 0, 1)]
    bits = [(k << s) + sign * (1 << i) for k in range(4) for i in range(s) for sign in (-1, 1)]
    return np.unique(np.array(near + middle + bits) % (4 << s))


def coordinates(core: Core) -> list[int]:
    """Extremes and powers of two of a coordinate word, both signs."""
    half = 1 << core.params["W"] - 1
    small = [0, 1, 2, 3, half // 3, half // 2, half - 2, half - 1, *(1 << i for i in range(4, core.params["W"] - 2, 3))]
    return [*small, *(-value for value in small if value), -half]


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core; inverse cores see the origin between other targets, so that a hold shows."""
    if core.function == "fk1":
        return {"in_j1": joint_words(core)}
    x, y = (grid.ravel() for grid in np.meshgrid(coordinates(core), coordinates(core)))
    order = np.random.default_rng(1).permutation(x.size)
    blank = np.arange(x.size) % 17 == 3
    return {"in_x": np.where(blank, 0, x[order]), "in_y": np.where(blank, 0, y[order])}
