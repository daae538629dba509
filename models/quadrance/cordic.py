"""Bit-true models of rtl/cordic: rotation and vectoring with micro-rotations, full circle, gain compensated."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from quadrance.fixed import Ints, ints, saturate, wrap

SINGULAR, OVERFLOW = 2, 4
GUARD = 5  # fraction bits below an output LSB
ROUND = 24  # half an output LSB, and 8 units for the shifts and minuses that round down (half a unit each)
GAIN_DIGITS = ((0, 0), (3, 1), (6, 1), (11, 1), (13, 1), (16, 0))  # (shift, minus) of 0.858785


def sizes(width: int) -> tuple[int, int]:
    """Micro-rotations and two-bit digits of a rotation for words of `width` bits."""
    rotations = (width + 1) // 2
    return rotations, (width - rotations + 1) // 2 + 1


@cache
def angle(i: int, bits: int) -> int:
    """``atan(2^-i)`` in turns, times 2^(i + bits), rounded down; from i = 9 on it is the radian."""
    i = min(i, 9)
    return math.floor(math.atan(2.0**-i) / (2 * math.pi) * 2.0 ** (i + bits))


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
        z = wrap(z + ((angle(i, bits) >> low ^ minus) << low) << 1, bits)
    low = max(rotations - 2, 0)
    radian = angle(9, bits)
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
    """``(out_x, out_y) = (in_x, in_y)`` rotated by `in_angle`, 2^A to the turn; error at most 1.55 LSB."""
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


HORNER = ((3, 0), (2, 0), (2, 1), (3, 0), (3, 0), (3, 1), (2, 0))  # v = x +- (v >> shift): 1.214509 = 2 * 0.607254
AIM_GUARD = 4
ANGLE_GUARD = 5


def aim(width: int, turn_bits: int, guard: int, x: Ints, y: Ints, magnitude: bool) -> tuple[Ints, Ints]:
    """Length and direction of (x, y): the vectoring engine.

    Parameters
    ----------
    width, turn_bits : word lengths; guard : fraction bits below an LSB of x and y
    x, y : int64 arrays, signed words of `width` bits
    magnitude : with it the length is rounded and its gain is out; without it the length is 0

    Returns
    -------
    length : 0 .. 2^width - 1; angle : 0 .. 2^turn_bits - 1, a turn 2^turn_bits. Errors: rtl/cordic/README.md
    """
    half = (width + 1) // 2
    grows = half if magnitude else (width + 1) // 3
    last = half + 8 if magnitude else width
    mirror = -(x < 0).astype(np.int64)
    x = x << guard ^ mirror
    y = (y << guard) + 1
    z = (mirror & 1 << turn_bits + ANGLE_GUARD - 1) + 24
    for i in range(last + 1):
        minus = -(y < 0).astype(np.int64)
        low = 0 if i <= half else guard + half // 2
        grown = x + (y >> 2 * i ^ minus) if i <= grows else x
        y = y + ((x >> low ^ ~minus) << low) << 1
        x = grown
        z = z + (angle(i, turn_bits + ANGLE_GUARD) >> i ^ minus ^ mirror)
    v = x
    for shift, minus in HORNER:
        v = x + (v >> shift ^ -minus)
    return (v + 21 >> guard + 1) * magnitude, wrap(z, turn_bits + ANGLE_GUARD, signed=False) >> ANGLE_GUARD


def vector(p: dict[str, int], *, in_x, in_y) -> dict[str, Ints]:
    """Length and direction of (in_x, in_y), each to nearest; singular at the origin, where the angle means nothing."""
    in_x, in_y = np.broadcast_arrays(ints(in_x), ints(in_y))
    length, direction = aim(p["W"], p["A"], AIM_GUARD, in_x, in_y, True)
    return {"out_magnitude": length, "out_angle": direction,
            "out_status": SINGULAR * ((in_x == 0) & (in_y == 0)).astype(np.int64)}
