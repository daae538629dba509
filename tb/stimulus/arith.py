"""Corners of rtl/arith: where a digit recurrence, a rounding or a clamp can go wrong by one."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core

from tb.lib.stimulus import Vectors


def _clip(values: list[int], bits: int) -> np.ndarray:
    """The distinct values that fit an unsigned word of `bits`."""
    return np.array(sorted({value for value in values if 0 <= value < 1 << bits}), dtype=np.int64)


def _edges(bits: int) -> list[int]:
    """Each power of two, its neighbours and the alternating words."""
    near = [(1 << i) + j for i in range(bits + 1) for j in (-1, 0, 1)]
    return [*near, *((1 << bits) // 3 + j for j in (0, 1)), 2 * ((1 << bits) // 3)]


def _isqrt(core: Core) -> Vectors:
    """Squares and their neighbours (the root must step exactly there), long runs of equal root bits."""
    width = core.params["W"]
    top = 1 << (width + 1) // 2
    roots = [*range(17), *_edges(width // 2), *range(top - 9, top)]
    return {"in_d": _clip([*(root * root + j for root in roots for j in (-1, 0, 1)), *_edges(width)], width)}


def _divide(core: Core) -> Vectors:
    """Edges by edges; a zero quotient behind a full one; zero divisors between legal ones; exact multiples."""
    wn, wd = core.params["WN"], core.params["WD"]
    rng = np.random.default_rng(1)
    n, d = (grid.ravel() for grid in np.meshgrid(_clip(_edges(wn), wn), _clip(_edges(wd), wd), indexing="ij"))
    keep = rng.permutation(n.size)[:400]
    high_n, high_d = (1 << wn) - 1, (1 << wd) - 1
    pairs = [(high_n, 1), (0, high_d), (high_n, 1), (1, high_d), (high_n, 0), (0, 1), (0, 0), (1, 1), (high_n, high_d),
             (high_n, 0), (1, high_d), (high_n - 1, high_d), (high_d & high_n, high_d)]
    factors = rng.integers(1, max(2, 1 << min(wn, wd) // 2), (40, 2)).tolist()
    pairs += [((a * b + j) & high_n, b & high_d) for a, b in factors for j in (-1, 0)]
    return {"in_n": np.concatenate([[n for n, _ in pairs], n[keep]]),
            "in_d": np.concatenate([[d for _, d in pairs], d[keep]])}


def _round_saturate(core: Core) -> Vectors:
    """Ties and their neighbours around 0, around both clamps and at both ends of the input."""
    wi, wo, shift = (core.params[name] for name in ("WI", "WO", "SHIFT"))
    half = (1 << shift) >> 1
    centres = [0, 1 << shift, -(1 << shift), 1 << wo - 1 + shift, -(1 << wo - 1 + shift), 1 << wi - 1, -(1 << wi - 1)]
    values = {centre + sign * half + j for centre in centres for sign in (-1, 0, 1) for j in (-1, 0, 1)}
    return {"in_x": np.array(sorted(v for v in values if -(1 << wi - 1) <= v < 1 << wi - 1))}


def _skid_buffer(core: Core) -> Vectors:
    """Words that differ from their neighbours in every bit, so that no repeat or loss can hide."""
    width = core.params["W"]
    words = _clip(_edges(width), width)
    return {"in_d": np.where(np.arange(words.size) % 2, ~words & (1 << width) - 1, words)}


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one primitive."""
    return {"isqrt": _isqrt, "divide": _divide, "round_saturate": _round_saturate,
            "skid_buffer": _skid_buffer}[core.function](core)
