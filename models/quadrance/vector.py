"""Bit-true models of rtl/vector: joint words are unit vectors (c, n), 1.0 is 2^U; products only, no angle anywhere."""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate, wrap

Params = dict[str, int]
GUARD = 5  # bits of A, B and rho below the LSB of a coordinate


# Forward


def _coordinates(p: Params, axes: str, words: tuple[Ints, ...], guard: int) -> dict[str, Ints]:
    """Coordinates to nearest, ties upward, saturated, and the overflow of any; beyond 2^(W + 1) LSB they wrap."""
    answer, overflow = {}, ints(0)
    for axis, word in zip(axes, words):
        answer[f"out_{axis}"], over = saturate(wrap(round_shift(word, guard), p["W"] + 2), p["W"])
        overflow = overflow | over
    return answer | {"out_status": 4 * overflow}


def fk1(p: Params, *, in_c1: Ints, in_n1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = L1 c1, y = L1 n1``, nearest (ties upward) and saturated: within 1/2 LSB of the vector as it is given."""
    l1 = ints(cfg_l1)
    return _coordinates(p, "xy", (l1 * ints(in_c1), l1 * ints(in_n1)), p["U"])


def _plane(p: Params, c1: Ints, n1: Ints, c2: Ints, n2: Ints, l1: Ints, l2: Ints) -> tuple[Ints, Ints]:
    """(x, y) of two joints with GUARD bits: every product is truncated, and -B is the one's complement."""
    bits = p["W"] + 2 + GUARD

    def cut(word: Ints, factor: Ints) -> Ints:
        return wrap(word * ints(factor) >> p["U"], bits)

    l1, l2 = ints(l1) << GUARD, ints(l2) << GUARD
    a, b = wrap(cut(l2, c2) + l1, bits), cut(l2, n2)
    return wrap(cut(a, c1) + cut(~b, n1), bits), wrap(cut(a, n1) + cut(b, c1), bits)


def fk2(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, cfg_l1: Ints,
        cfg_l2: Ints) -> dict[str, Ints]:
    """``x = A c1 - B n1, y = A n1 + B c1`` with ``A = L1 + L2 c2, B = L2 n2``."""
    return _coordinates(p, "xy", _plane(p, in_c1, in_n1, in_c2, in_n2, cfg_l1, cfg_l2), GUARD)


def fk3(p: Params, *, in_c1: Ints, in_n1: Ints, in_c2: Ints, in_n2: Ints, in_c3: Ints, in_n3: Ints, cfg_l1: Ints,
        cfg_l2: Ints) -> dict[str, Ints]:
    """`fk2` in the plane of the arm, (rho, z), then ``x = rho c3, y = rho n3``; rho keeps its sign and its fraction."""
    rho, z = _plane(p, in_c1, in_n1, in_c2, in_n2, cfg_l1, cfg_l2)
    x, y = (wrap(rho * ints(factor) >> p["U"], p["W"] + 2 + GUARD) for factor in (in_c3, in_n3))
    return _coordinates(p, "xyz", (x, y, z), GUARD)


# Inverse


@cache
def _root_slopes() -> Ints:
    """2^32 / b^(3/2), b = 2 a + 1, raised as reciprocal_root.v says; entry 0 is that of q = 2."""
    slopes = []
    for b in [2049, *[0] * 127, *range(257, 2049, 2)]:
        square = (((256 * b * b + b + 96) << 33) // b**3 << 25) // (b * b) if b else 0
        root = 1 << (20 if b < 512 else 19 if b < 1024 else 17)
        for _ in range(6):
            root = root + square // root >> 1
        slopes.append(root + 1 >> 1 if b else 0)
    return ints(slopes)


def reciprocal_root(q: Ints) -> Ints:
    """``2^18 * 2 / sqrt(q)``, truncated, q / 2^18 from 1/4 to 2, as the tangent's product."""
    q = ints(q)
    w = (q >> 9 << 10) + 767 - (q & 0x1FF)
    return w * _root_slopes()[q >> 9 & 0x3FF] >> 17


def ik1(p: Params, *, in_x: Ints, in_y: Ints) -> dict[str, Ints]:
    """``(x, y) / sqrt(x^2 + y^2)``, each coordinate nearest (ties upward); the last vector where x = y = 0."""
    x, y = (ints(word) << 16 - p["W"] for word in np.broadcast_arrays(in_x, in_y))
    zero = (x == 0) & (y == 0)
    either = (x ^ x >> 63) | (y ^ y >> 63)
    spare = 15 - np.ceil(np.log2(either + 1)).astype(np.int64)
    x, y = x << spare, y << spare
    half = 1 << 16 - p["U"]
    root = reciprocal_root((x * x >> 12) + (y * y >> 12) + 1)
    c, n = ((part * root >> 17) + half >> 17 - p["U"] for part in (x, y))
    return {"out_c1": hold_last(c, ~zero, 1 << p["U"]), "out_n1": hold_last(n, ~zero), "out_status": 2 * ints(zero)}
