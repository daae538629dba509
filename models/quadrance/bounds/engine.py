"""Error bounds of rtl/engine."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance.truth import Floats, floats

FINE = 16  # a length inside has 4 fraction bits below the LSB of 18 bits
ROOT = 2.0**-16  # relative, of a root whose radicand is at least 2^-5 after normalising; next to 0 it is greater
COORDINATE = 1 + np.sqrt(2)
"""Of e and h in fine LSB: x and z within 1 each (two truncations of a quarter, rounding 1/2), turned, and 1 of its
own."""
HEIGHT = 2.0
"""Of f: y within 1, and the link's share truncated."""


def rus_vector(distance: ArrayLike, la: float) -> tuple[Floats, float]:
    """(error of G, error of (e, f)) of `engine_rus_ik` in LSB of 18 bits; `distance` |d| and `la` in the same.

    G = (|d|^2 + LA^2 - LB^2) / 2 LA: d is within sqrt(2 COORDINATE^2 + HEIGHT^2) and weighs |d| / LA; the squares lose
    up to 2^18 + 2^17 fine LSB^2 before the product with 1 / 2 LA and cfg_k half of 2^16, the product up to 1 and half a
    unit of cfg_c, 2^-27 of 3 |d|^2 / 2 LA and more.
    """
    off = np.hypot(np.sqrt(2) * COORDINATE, HEIGHT)
    distance = floats(distance)
    lost = (2.0**18 + 2.0**17 + 2.0**15) / (2 * la * FINE)
    gain = (distance**2 + 2.0**33) * FINE / (2 * la) * la * FINE / 2.0**43
    return (distance / la * off + lost + gain + 1) / FINE, float(np.hypot(COORDINATE, HEIGHT)) / FINE


def rus_angle(distance: ArrayLike, la: float, root: ArrayLike, flat: ArrayLike) -> Floats:
    """Crank angle of `engine_rus_ik` in radians beyond the rounding of its inputs, legs in reach.

    Parameters
    ----------
    distance, root, flat : arrays of |d|, S and sqrt(e^2 + f^2), LSB of 18 bits.
    la : crank, in the same.

    Notes
    -----
    e cos + f sin = G, so the angle moves by (dG - de cos - df sin) / S: the law 1/S of a leg that is nearly stretched.
    Twice that, for S itself moves; the bound is for S of eight times the numerator and more. The root's own error,
    ROOT S and a fine LSB, turns the answer by at most that over sqrt(e^2 + f^2); the word adds sqrt(1/2) 2^-16, and the
    truncated numerators 2^-19.
    """
    g, plane = rus_vector(distance, la)
    root, flat = floats(root), floats(flat)
    return 2 * (g + plane) / root + (ROOT * root + 1 / FINE) / flat + np.sqrt(0.5) * 2.0**-16 + 2.0**-19
