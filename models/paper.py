"""Bit-true models of rtl/paper: spreads and quadrances all the way, as the paper computes, with its errors corrected.

R. Martinez et al., "Efficient FPGA Hardware Implementation for Robot Manipulator Kinematic Modeling Using
Rational Trigonometry". A joint word is a turn-spread: quadrant k above S fraction bits f, spread f in the even
quadrants and 1 - f in the odd ones. Every model takes the Verilog parameters and the input words by port name
and returns every output word by port name.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from quadrance.cores import STATUS_BITS
from quadrance.fixed import Ints, hold_last, ints, isqrt

Params = dict[str, int]
Bools = NDArray[np.bool_]


def signed_root(square: Ints, negative: Bools, width: int) -> tuple[Ints, Bools]:
    """``+-sqrt(square / 4)`` rounded to nearest (ties outward) in a signed word of `width` bits.

    `square` is the square of twice the result. Also returned: where the magnitude is 2^(width-1) or more,
    which saturates.
    """
    magnitude = (isqrt(square) + 1) >> 1
    over = magnitude >= 1 << width - 1
    clamped = np.minimum(magnitude, (1 << width - 1) - 1 + negative)
    return np.where(negative, -clamped, clamped), over


def status(**bits: Bools) -> Ints:
    """Status word of the named bits."""
    return sum(ints(bit) << STATUS_BITS[name] for name, bit in bits.items())


def fk1(p: Params, *, in_j1: Ints, cfg_l1: Ints) -> dict[str, Ints]:
    """``x = +-sqrt(Q1 (1 - s1))``, ``y = +-sqrt(Q1 s1)``, Q1 = L1^2 (eqs. 51-52, Table I)."""
    fraction, k = ints(in_j1) & (1 << p["S"]) - 1, ints(in_j1) >> p["S"]
    fall = (1 << p["S"]) - fraction
    odd = k % 2 == 1
    quadrance = ints(cfg_l1) * ints(cfg_l1)
    x, over_x = signed_root(quadrance * np.where(odd, fraction, fall) >> p["S"] - 2, (k == 1) | (k == 2), p["W"])
    y, over_y = signed_root(quadrance * np.where(odd, fall, fraction) >> p["S"] - 2, k >= 2, p["W"])
    return {"out_x": x, "out_y": y, "out_status": status(overflow=over_x | over_y)}


def ik1(p: Params, *, in_x: Ints, in_y: Ints) -> dict[str, Ints]:
    """``s1 = qy / (qx + qy)`` to nearest, quadrant by the signs (eq. 9, Table I); x = y = 0 holds the last word.

    Ties go up in the even quadrants and down in the odd ones, where 1 - s1 is the fraction.
    """
    x, y = np.broadcast_arrays(ints(in_x), ints(in_y))
    qx, qy = x * x, y * y
    singular = qx + qy == 0
    k = np.where(y < 0, np.where(x < 0, 2, 3), np.where(x < 0, 1, 0))
    twice = np.minimum((qy << p["S"] + 1) // np.where(singular, 1, qx + qy), (2 << p["S"]) - 1)
    twice = np.where(k % 2 == 1, (2 << p["S"]) - 1 - twice, twice)
    word = (k << p["S"]) + (twice + 1 >> 1) & (4 << p["S"]) - 1
    return {"out_j1": hold_last(word, ~singular), "out_status": status(singular=singular)}
