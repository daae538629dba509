"""Bit-true models of rtl/joint: codecs between turn-spread words and unit vectors (cos, sin)."""

from __future__ import annotations

from functools import cache

import numpy as np
from quadrance import fixed
from quadrance.fixed import Ints, ints

Params = dict[str, int]

# spread_chord: ranges of the radicand v (24 bits): width of a segment in bits, and the segments of each
SEGMENT_BITS = (15, 11, 6, 0)
SEGMENTS = 512


@cache
def chord_slopes() -> Ints:
    """2^25 sqrt(h) / (2 sqrt(t)) of segment a of each range, as spread_chord.v computes it, (4, 512).

    t = a + 1/2, h = 2^(SEGMENT_BITS - 24); the last range holds the exact roots of a h over 2 a instead.
    Segments below the start of their range, which are never read, are filled too.
    """
    table = np.zeros((4, SEGMENTS), dtype=np.int64)
    for row, width in enumerate(SEGMENT_BITS):
        root = 1 << (14 if row == 3 else 18)
        for a in range(SEGMENTS):
            if row < 3:
                b = 2 * a + 1
                square = (((256 * b + 1) * (8 * b * b - 1) << 20) // b**4) << width - 4
            else:
                square = ((16 * a * a - 1) << 22) // a**3 if a else 1 << 28
            for _ in range(4):
                root = (root + square // root) >> 1
            table[row, a] = (root + 1) >> 1 & 0x1FFFF
    return table


def spread_chord(p: Params, *, in_s: Ints, in_not: Ints) -> dict[str, Ints]:
    """Factors of the square root of a spread (or of its complement): sqrt(v) ~ w * slope / 2^33.

    |sqrt(v) - w * slope / 2^33| <= 0.56 / 2^15, and 0 at v = 0.
    """
    flip = -ints(in_not)  # every bit
    v = (ints(in_s) << 24 - p["S"] ^ flip) & 0xFFFFFF
    row = np.select([v >= 1 << 20, v >= 1 << 15, v >= 1 << 9], [0, 1, 2], 3)
    width = ints(SEGMENT_BITS)[row]
    segment = v >> width & SEGMENTS - 1
    offset = (v << 8 | flip & 0xFF) >> width & 0xFF  # 8 bits, behind the word come more of its kind
    middle = segment << 9 | (offset & 0x80) << 1 | (~offset & 0x80) | offset & 0x7F
    w = np.where(row == 3, segment << 9 | (flip & 1) << 8, middle)
    return {"out_w": w, "out_slope": chord_slopes()[row, segment]}
