"""Bit-true models of rtl/rational: turn-spreads in and out, unit vectors inside."""

from __future__ import annotations

from functools import cache

import numpy as np
from quadrance import joint
from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate

Params = dict[str, int]


# One joint


def fk1(p: Params, *, in_j1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = L1 cos, y = L1 sin``, nearest (ties upward) and saturated.

    Each coordinate is within 1/2 + 1/16 + 0.56 L1 / 2^15 LSB, L1 in LSB.
    """
    s, spread = p["S"], ints(in_j1) & (1 << p["S"]) - 1
    odd, lower = ints(in_j1) >> s & 1, ints(in_j1) >> s + 1 & 1

    def coordinate(complement: Ints, negative: Ints) -> tuple[Ints, Ints]:
        root = joint.spread_chord(p, in_s=spread, in_not=complement)
        n = (ints(cfg_l1) * root["out_w"] >> 13) * 2 + 1
        value, over = saturate(round_shift(np.where(negative, -n, n) * root["out_slope"], 21), p["W"])
        return value, over

    x, over_x = coordinate(1 - odd, odd ^ lower)
    y, over_y = coordinate(odd, lower)
    return {"out_x": x, "out_y": y, "out_status": 4 * ints(over_x | over_y)}


@cache
def _reciprocal_knots() -> Ints:
    """2^16 / q at q = a / 256, lowered by half the sag of the chord to the next, as rational_ik1.v computes it."""
    return ints([0] * 64 + [(((8 * a * a - 1) << 30) // (a * a * (256 * a + 1)) + 1) >> 1 for a in range(64, 513)])


def ik1(p: Params, *, in_x: Ints, in_y: Ints) -> dict[str, Ints]:
    """Turn-spread of the direction of (x, y), nearest; the last one where x = y = 0.

    Direction within 0.6 / 2^14 rad of those that round to the word.
    """
    s = p["S"]
    x, y = (ints(word) << 16 - p["W"] for word in np.broadcast_arrays(in_x, in_y))
    either = (x ^ x >> 63) | (y ^ y >> 63)
    zeros = 15 - np.ceil(np.log2(either + 1)).astype(np.int64)
    x, y = x << zeros, y << zeros
    x2, y2 = x * x >> 3, y * y >> 3
    long = ((x < -(1 << 14)) | (x >= 1 << 14)) & (y2 < 1 << 27)  # the nearer axis is that of x
    q = (x2 >> 11) + (y2 >> 11)
    knot, a = _reciprocal_knots(), q >> 8 & 0x1FF  # q = 2 wraps to 0
    reciprocal = 2 * (knot[a] - ((knot[a] - knot[a + 1]) * (q & 0xFF) >> 8)) - 1
    spread = (np.where(long, y2, x2) & 0x7FFFFFF) * reciprocal
    spread = np.where(q >> 17, 1 << 43, spread)  # x = y = -1
    spread = spread + (1 << 43 - s) >> 44 - s
    axis = np.where(long, 2 * (x < 0), 1 + 2 * (y < 0))
    word = (axis << s) + np.where((x < 0) ^ (y < 0) ^ ~long, -spread, spread) & (4 << s) - 1
    zero = (x == 0) & (y == 0)
    return {"out_j1": hold_last(word, ~zero), "out_status": 2 * ints(zero)}
