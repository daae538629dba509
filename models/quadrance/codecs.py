"""Bit-true models of rtl/codec: codecs between turn-spread words and unit vectors (cos, sin)."""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import fixed
from quadrance.fixed import Ints, ints

Params = dict[str, int]

# root_product: ranges of the radicand v (24 bits): width of a segment in bits, and the segments of each
SEGMENT_BITS = (15, 11, 6, 0)
SEGMENTS = 512


@cache
def chord_slopes(bits: int = 17) -> Ints:
    """2^(bits + 8) sqrt(h) / (2 sqrt(t)) of segment a of each range, as root_product.v computes it, (4, 512).

    t = a + 1/2, h = 2^(SEGMENT_BITS - 24); the last range holds the exact roots of a h over 2 a instead.
    Segments below the start of their range, which are never read, are filled too.
    """
    table, extra = np.zeros((4, SEGMENTS), dtype=np.int64), bits - 17
    for row, width in enumerate(SEGMENT_BITS):
        root = 1 << (14 if row == 3 else 18) + extra
        for a in range(SEGMENTS):
            if row < 3:
                b = 2 * a + 1
                square = (((512 * b + 1) * (8 * b * b - 1) << 20) // b**4) << width - 5 + 2 * extra
            else:
                square = ((16 * a * a - 1) << 22 + 2 * extra) // a**3 if a else 1 << 28 + 2 * extra
            for _ in range(4):
                root = (root + square // root) >> 1
            table[row, a] = (root + 1) >> 1 & (1 << bits) - 1
    return table


def root_product(p: Params, *, in_s: Ints, in_not: Ints) -> dict[str, Ints]:
    """Factors of the square root of a spread (or of its complement): sqrt(v) ~ w * slope / 2^(B + 17).

    At B = 17 (default) |sqrt(v) - w * slope / 2^34| <= 0.52 / 2^15, and 0 at v = 0.
    """
    flip = -ints(in_not)  # every bit
    v = (ints(in_s) << 24 - p["S"] ^ flip) & 0xFFFFFF
    row = np.select([v >= 1 << 20, v >= 1 << 15, v >= 1 << 9], [0, 1, 2], 3)
    width = ints(SEGMENT_BITS)[row]
    segment = v >> width & SEGMENTS - 1
    offset = (v << 9 | flip & 0x1FF) >> width & 0x1FF  # 9 bits, behind the word come more of its kind
    middle = segment << 10 | (offset & 0x100) << 1 | (~offset & 0x100) | offset & 0xFF
    w = np.where(row == 3, segment << 10 | (flip & 1) << 9, middle)
    return {"out_w": w, "out_slope": chord_slopes(p.get("B", 17))[row, segment]}


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
