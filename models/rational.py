"""Bit-true models of rtl/rational: turn-spreads in and out, unit vectors inside."""

from __future__ import annotations

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
