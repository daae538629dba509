"""Bit-true models of the table codecs of long words, whose segments are parabolas.

angle_of_vector behind kernel_vector_wide, and angle_chord with more than 21 fraction bits. `codecs` has both with
straight segments.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import fixed
from quadrance.fixed import Ints, ints

AHEAD = {22: 8, 26: 9}  # fraction bits of m: of the place that a coefficient is multiplied with, the last one 1


@cache
def sine_segments(k: int, t: int) -> tuple[Ints, Ints]:
    """``sin(2 pi i / 2^t)``, i = 0 ... 2^t, nearest in units of 2^-k and one more for what is truncated twice, held
    within 1 and -1; and the bends of the segments behind, 16 times the sag over 2^(k - 2 t).

    The integers of angle_chord.v, operation by operation.
    """
    one, quarter, most = 1 << 30, [], 1 << k
    for i in range((1 << t - 1) + 1):  # every half a segment
        x = i * 3373259426 >> t
        square = x * x >> 30
        s = one
        for divisor in (156, 110, 72, 42, 20, 6):
            s = one - (square * s >> 30) // divisor
        quarter.append(x * s >> 30)
    half = quarter + quarter[-2:0:-1]
    turn = [*half, *(-s for s in half), 0]
    knots = [min(max(s + (3 << 29 - k) >> 30 - k, 2 - most), most - 1) for s in turn[::2]]
    bends = [(abs(s) * 20213 + (1 << 37) >> 38) * (1 if s > 0 else -1) for s in turn[1::2]]
    return ints(knots), ints(bends)


def sine(k: int, t: int, a: int, word: Ints, cosine: bool) -> Ints:
    """`codecs.angle_chord` on the 2^t parabolas of a turn: the sag at the middle of each 128th of a segment."""
    b, place = a - t, ints(word) + (cosine << a - 2) & (1 << a) - 1
    (knots, bends), i, offset = sine_segments(k, t), place >> b, place & (1 << b) - 1
    at = offset >> b - 7 if b > 7 else offset << 7 - b
    fold = np.minimum(at, 127 - at)
    hump = (2 * fold + 1) * (255 - 2 * fold) >> 7
    return knots[i] + ((knots[i + 1] - knots[i]) * offset >> b) + (bends[i] * hump >> 11 - k + 2 * t)


@cache
def segments(d: int, fraction: int) -> tuple[Ints, Ints]:
    """``arcsin(i / 256)`` in 2^-d turn, i = -256 ... 256, held beyond 224; and the coefficients of the segments behind,
    2^26 times half the second derivative, in turns.

    Knots have half a word of 8 units less half a unit, half of the three units that are truncated, half of the last bit
    of m. The integers of angle_of_vector.v, operation by operation.
    """
    arc, root, found, bends = 0, 1 << 31, [], []
    for i in range(257):
        b = 2 * min(i, 223) + 1
        n = (1 << 18) - b * b
        for _ in range(3):
            root = root + (n << 44) // root >> 1
        rise = (1 << 63) // root << 4
        rise += (rise >> 8) * ((1 << 18) + 2 * b * b) // (6 * n) // n << 8
        found.append((arc >> 14) * 683565276)
        bends.append(min((b * 683565276 << 18) // (n * root) + 1 >> 1, 255))
        arc += rise if i < 224 else 0
    half = (10 << 61 - d) + (683565276 << 29 - fraction)
    return (ints([half + s >> 62 - d for s in [-s for s in found[:0:-1]] + found]),
            ints(bends[255::-1] + bends[:256]))


def arcsine(d: int, m: Ints, fraction: int) -> Ints:
    """Arc sine of m / 2^fraction in 2^-d turn, with what `segments` has in its knots."""
    bits, t = fraction - 8, AHEAD[fraction]
    (knots, bends), i, place = segments(d, fraction), (m >> bits) + 256, m & (1 << bits) - 1
    moved = bends[i] * ((1 << t) - 1 - 2 * (place >> bits + 1 - t)) >> 26 + t - d
    slope = knots[i + 1] - knots[i] + (moved ^ -ints(m >= 0)) & (1 << d - 9) - 1
    return knots[i] + (slope * place >> bits)


def angle_of_vector(a: int, cosine: Ints, sine: Ints, fraction: int) -> Ints:
    """Binary angle of a bits of a unit vector: of its sine, or of its cosine in [-3/4, 3/4)."""
    quarters = fixed.wrap(cosine >> fraction - 2, 4)
    far, back, under = (quarters < -3) | (quarters > 2), cosine < 0, sine < 0
    m = fixed.wrap(np.where(far, sine, cosine), fraction + 1)
    arc = arcsine(a + 3, m ^ -ints(np.where(far, back, ~under)), fraction)
    return (np.where(far, 2 * back, 1 + 2 * under) << a + 1) + arc >> 3 & (1 << a) - 1
