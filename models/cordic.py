"""Bit-true models of rtl/cordic: rotation and vectoring with micro-rotations, full circle, gain compensated."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from quadrance.fixed import Ints, ints, saturate, wrap

OVERFLOW = 4
GUARD = 5  # fraction bits below an output LSB
ROUND = 24  # half an output LSB, and 8 units for the shifts and minuses that round down (half a unit each)
GAIN_DIGITS = ((0, 0), (3, 1), (6, 1), (11, 1), (13, 1), (16, 0))  # (shift, minus) of 0.858785


def sizes(width: int) -> tuple[int, int]:
    """Micro-rotations and two-bit digits of a rotation for words of `width` bits."""
    rotations = (width + 1) // 2
    return rotations, (width - rotations + 1) // 2 + 1


@cache
def angle(i: int, bits: int, low: int) -> int:
    """``atan(2^-i)`` in turns, times 2^(i + bits), down to a multiple of 2^low (i > 9: the radian of i = 9)."""
    i = min(i, 9)
    return math.floor(math.atan(2.0**-i) / (2 * math.pi) * 2.0 ** (i + bits)) >> low << low


def turn(width: int, x: Ints, y: Ints, z: Ints, constant: int = ROUND) -> tuple[Ints, Ints]:
    """(x, y) rotated by z: the engine of every core here, its gain of 1.16443 left in.

    Parameters
    ----------
    width : word length the number of steps is made for
    x, y : int64 arrays, any fraction
    z : int64 array, signed, 2^(width + 5) to the turn, at most an eighth of a turn
    constant : added to both at the end; every minus is a one's complement, every shift rounds down

    Returns
    -------
    x, y : rotated vector; error: see rtl/cordic/README.md
    """
    rotations, digits = sizes(width)
    bits = width + 4
    for i in range(1, rotations + 1):
        low = max(i - 3, 0)
        minus = -(z >= 0).astype(np.int64)
        x, y = x + ((y >> i) ^ minus), y + ((x >> i) ^ ~minus)
        z = wrap(z + ((angle(i, bits, low) >> low ^ minus) << low) << 1, bits)
    low = max(rotations - 2, 0)
    radian = angle(9, bits, low)
    xf, yf = x, y
    for k in range(digits):
        minus = -(z >= 0).astype(np.int64)
        top = (z ^ ~minus) >> bits - 4
        two, some = top >= 4, top > 0
        shift = rotations + 1 + 2 * k - two
        x = x + np.where(some, (yf >> shift) ^ minus, 0)
        y = y + np.where(some, (xf >> shift) ^ ~minus, 0)
        z = wrap(z + np.where(some, ((np.where(two, radian << 1, radian) >> low) ^ minus) << low, 0) << 2, bits)
    return x + constant, y + constant


def rotate(p: dict[str, int], *, in_angle, in_x, in_y) -> dict[str, Ints]:
    """``(out_x, out_y) = (in_x, in_y)`` rotated by `in_angle`, 2^A to the turn; error below 1.5 LSB."""
    width, turn_bits = p["W"], p["A"]
    in_angle, in_x, in_y = np.broadcast_arrays(ints(in_angle), ints(in_x), ints(in_y))
    quarter = (in_angle >> turn_bits - 2) + (in_angle >> turn_bits - 3 & 1)
    odd, half = quarter & 1 == 1, quarter & 2 == 2
    vx = np.where(odd, in_y, in_x) << GUARD ^ -(half ^ odd).astype(np.int64)
    vy = np.where(odd, in_x, in_y) << GUARD ^ -half.astype(np.int64)
    digits = [(shift, -minus) for shift, minus in GAIN_DIGITS if shift < 10 or shift <= width]
    x = sum((vx >> shift) ^ minus for shift, minus in digits)
    y = sum((vy >> shift) ^ minus for shift, minus in digits)
    z = (wrap(in_angle, turn_bits - 2) << width + 5 - turn_bits) + 2
    x, y = turn(width, x, y, z)
    (out_x, over_x), (out_y, over_y) = (saturate(v >> GUARD, width) for v in (x, y))
    return {"out_x": out_x, "out_y": out_y, "out_status": OVERFLOW * (over_x | over_y)}
