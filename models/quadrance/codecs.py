"""Bit-true models of rtl/codec: codecs between turn-spread words and unit vectors (cos, sin)."""

from __future__ import annotations

from functools import cache
from math import isqrt

import numpy as np

from quadrance import fixed
from quadrance.fixed import Ints, ints

Params = dict[str, int]

@cache
def _knots(u: int, h: int) -> Ints:
    """``sqrt(a / 2^h)``, a = 0 ... 512, lifted by half the chord's sag (a >= 8), rounded up to a unit of 2^-(u+3)."""
    k, scale = u + 3, 2 * (u + 3) - h
    squares = [a << scale if a < 8 else ((32 * a * a + 1) << scale) // (32 * a) for a in range(1, 513)]
    return ints([0, *(min(isqrt(square) + 1, (1 << k) - 1) for square in squares)])


def spread_chords(p: Params, word: Ints) -> tuple[Ints, Ints]:
    """(cos, sin) of a turn-spread word as odd integers of 2^-(U+1), each within 0.83 / 2^U at U = 16.

    With f the fraction and v = min(f, 1 - f) the roots are those of v and 1 - v, on chords of 512 segments a
    range and of 256; 1 - f is the one's complement followed by ones.
    """
    s, u, d = p["S"], p["U"], 12
    word = ints(word)
    quadrant, f = word >> s, word & (1 << s) - 1
    fold = f >> s - 1
    v = ((f ^ -fold) & (1 << s - 1) - 1) << 54 - (s - 1) | -fold & (1 << 54 - (s - 1)) - 1  # 2 v, 54 bits
    minor = np.zeros_like(v)
    for shift in (0, 4, 9, 14, 20) if s > 24 else (0, 4, 9, 14):
        knots = _knots(u, 10 + shift)
        scaled = (v << shift | -fold & (1 << shift) - 1) & (1 << 54) - 1
        a, offset = scaled >> 45, scaled >> 45 - d & (1 << d) - 1
        root = knots[a] + ((knots[a + 1] - knots[a]) * offset >> d) >> 3
        minor = np.where(v < 1 << 54 - shift, root, minor)
    knots, a, offset = _knots(u, 9), v >> 46, v >> 46 - d & (1 << d) - 1
    major = knots[512 - a] + ((knots[511 - a] - knots[512 - a]) * offset >> d) >> 3
    minor_n = fold == quadrant & 1
    c, n = 2 * np.where(minor_n, major, minor) + 1, 2 * np.where(minor_n, minor, major) + 1
    return np.where((quadrant ^ quadrant >> 1) & 1, -c, c), np.where(quadrant >> 1, -n, n)


def spread_to_vector(p: Params, *, in_j: Ints) -> dict[str, Ints]:
    """Unit vector of a turn-spread word, each coordinate to nearest (ties outward): error <= 1/2 LSB of 2^-U.

    c = +-sqrt(1 - s), n = +-sqrt(s), signs by quadrant (paper Table I in the continuous reading).
    """
    s, u = p["S"], p["U"]
    j = ints(in_j)
    k, f = j >> s, j & (1 << s) - 1

    def root(spread: Ints) -> Ints:
        cut = spread << 2 * u + 2 - s if 2 * u + 2 >= s else spread >> s - 2 * u - 2
        return fixed.isqrt(cut) + 1 >> 1

    one = 1 << u
    near_f, near_g = root(f), np.where(f == 0, one, root((1 << s) - f))
    c, n = np.where(k & 1, near_f, near_g), np.where(k & 1, near_g, near_f)
    return {"out_c": np.where((k == 1) | (k == 2), -c, c), "out_n": np.where(k >= 2, -n, n)}


def vector_to_spread(p: Params, *, in_c: Ints, in_n: Ints) -> dict[str, Ints]:
    """Turn-spread word of a direction, ``s = n^2 / (c^2 + n^2)`` to nearest; c = n = 0 holds the last word.

    Quadrant by the signs. Ties go up in the even quadrants and down in the odd ones, where 1 - s is the fraction.
    Error <= 1/2 LSB of the word (paper eq. 9).
    """
    c, n = np.broadcast_arrays(ints(in_c), ints(in_n))
    q, qn = c * c + n * n, n * n
    k = np.where(n < 0, np.where(c < 0, 2, 3), np.where(c < 0, 1, 0))
    most = (2 << p["S"]) - 1
    twice = np.minimum(quotient(qn, np.where(q == 0, 1, q), p["S"] + 1), most)
    twice = np.where(k % 2 == 1, most - twice, twice)
    word = (k << p["S"]) + (twice + 1 >> 1) & (4 << p["S"]) - 1
    return {"out_j": fixed.hold_last(word, q != 0), "out_status": (q == 0) * 2}


def quotient(numerator: Ints, divisor: Ints, bits: int) -> Ints:
    """``floor(numerator * 2^bits / divisor)`` for numerator <= divisor < 2^62, in steps that stay inside int64."""
    result, rem = numerator // divisor, numerator % divisor
    while bits:
        step = min(bits, 62 - int(np.max(divisor, initial=1)).bit_length())
        result = result << step | (rem << step) // divisor
        rem = (rem << step) % divisor
        bits -= step
    return result
