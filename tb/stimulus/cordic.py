"""Corners of rtl/cordic: quadrant borders, the axes, the longest vectors, saturation on either side, single bits."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core

from tb.lib.stimulus import Vectors


def _near(centres: list[int], low: int, high: int) -> np.ndarray:
    """Each centre and its neighbours, those within the word."""
    return np.array(sorted({c + j for c in centres for j in (-1, 0, 1) if low <= c + j <= high}))


def _words(width: int) -> np.ndarray:
    """Extremes, zero and powers of two of a signed word."""
    top = 1 << width - 1
    return _near([-top, 0, top, top // 2, -top // 3, round(top * 0.7071), -round(top * 0.7071)], -top, top - 1)


def alone(width: int, axes: int) -> np.ndarray:
    """Points (n, axes) that are not the origin by one bit of one coordinate of `width` bits."""
    return np.concatenate([np.eye(axes, dtype=np.int64) << bit for bit in range(width - 1)])


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one primitive."""
    rng = np.random.default_rng(1)
    words = _words(core.params["W"])
    if core.function == "rotate":
        full = 1 << core.params["A"]
        angles = _near([full * i // 8 for i in range(9)], 0, full - 1)
        grid = np.meshgrid(angles, words, words, indexing="ij")
        keep = rng.permutation(grid[0].size)[:1500]
        return {name: axis.ravel()[keep] for name, axis in zip(("in_angle", "in_x", "in_y"), grid, strict=True)}
    grid = np.meshgrid(words, words, indexing="ij")
    bits = alone(core.params["W"], 2)
    return {name: np.concatenate([axis.ravel(), bit])
            for name, axis, bit in zip(("in_x", "in_y"), grid, bits.T, strict=True)}
