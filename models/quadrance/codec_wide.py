"""Bit-true models of the table codecs of long words, whose segments are parabolas.

angle_of_vector behind kernel_vector_wide, and angle_chord with more than 21 fraction bits. `codecs` has both with
straight segments.
"""

from __future__ import annotations

from functools import cache
from math import isqrt

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


RANGES = (0, 4, 8, 12, 18, 24, 30)  # left shift of 2 v in each of the ranges of its root
PLACE = 17  # bits of the place in a segment of a root


@cache
def root_segments(u: int, h: int) -> tuple[Ints, Ints]:
    """``sqrt(a 2^-h)``, a = 0 ... 512, in 2^-(u + 3), rounded up, since a root is truncated; and the bends of the
    segments behind, half the sag, of those below 32 a sixteenth, below 8 none.

    The integers of spread_parabolas.v, operation by operation.
    """
    k = u + 3
    knots = [0, *(min(isqrt(a << 2 * k - h) + 1, (1 << k) - 1) for a in range(1, 513))]
    bends = [isqrt((1 << 2 * k - h - (7 if a >= 32 else 13)) // (2 * a + 1) ** 3) + 1 >> 1 for a in range(512)]
    return ints(knots), ints([0] * 8 + bends[8:])


def root(knots: Ints, bends: Ints, a: Ints, step: int, place: Ints) -> Ints:
    """The root at a place behind segment a, or before it where `step` is -1: two truncations."""
    at = place >> PLACE - 9
    fold = np.minimum(at, 511 - at)
    hump = (2 * fold + 1) * (1023 - 2 * fold) >> 9
    b = np.minimum(a, a + step)
    moved = bends[b] * hump >> np.where(b >= 32, 8, 5)
    return knots[a] + moved + ((knots[a + step] - knots[a]) * place >> PLACE)


def spread_roots(s: int, u: int, word: Ints) -> tuple[Ints, Ints]:
    """`codecs.spread_chords` of more than 18 fraction bits, on parabolas."""
    word = ints(word)
    quadrant, f = word >> s, word & (1 << s) - 1
    fold = f >> s - 1
    v = ((f ^ -fold) & (1 << s - 1) - 1) << 60 - (s - 1) | -fold & (1 << 60 - (s - 1)) - 1  # 2 v, 60 bits
    minor, segments = np.zeros_like(v), root_segments(u, 10)
    for shift in RANGES:
        scaled = (v << shift | -fold & (1 << shift) - 1) & (1 << 60) - 1
        part = root(*segments, scaled >> 51, 1, scaled >> 51 - PLACE & (1 << PLACE) - 1)
        minor = np.where(v < 1 << 60 - shift, part >> 3 + shift // 2, minor)
    major = root(*root_segments(u, 9), 512 - (v >> 52), -1, v >> 52 - PLACE & (1 << PLACE) - 1) >> 3
    minor_n = fold == quadrant & 1
    c, n = 2 * np.where(minor_n, major, minor) + 1, 2 * np.where(minor_n, minor, major) + 1
    return np.where((quadrant ^ quadrant >> 1) & 1, -c, c), np.where(quadrant >> 1, -n, n)
