"""Bit-true models of rtl/arith: square root, division, reciprocal, rounding with saturation, skid buffer.

comb, iter and pipe of one function are the same function, so they share one model. Every model takes the
Verilog parameters and the input words by port name and returns every output word by port name.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import fixed
from quadrance.fixed import Ints, ints

Params = dict[str, int]

# root_product: ranges of the radicand v (24 bits): width of a segment in bits, and the segments of each
SEGMENT_BITS = (15, 11, 6, 0)
SEGMENTS = 512


def isqrt(p: Params, *, in_d: Ints) -> dict[str, Ints]:
    """``root = floor(sqrt(d * 4^F))`` and the exact ``rem = d * 4^F - root^2``, 0 <= rem <= 2 root.

    Needs W + 2 F <= 62.
    """
    radicand = ints(in_d) << 2 * p["F"]
    root = fixed.isqrt(radicand)
    return {"out_root": root, "out_rem": radicand - root * root}


def divide(p: Params, *, in_n: Ints, in_d: Ints) -> dict[str, Ints]:
    """``n * 2^F = q * d + r``, 0 <= r < d; d = 0 gives q all ones and ``r = n * 2^F mod 2^WD``.

    Needs WN + F <= 62.
    """
    n, d = np.broadcast_arrays(ints(in_n) << p["F"], ints(in_d))
    zero = d == 0
    q, r = np.divmod(n, np.where(zero, 1, d))
    return {"out_q": np.where(zero, (1 << p["WN"] + p["F"]) - 1, q),
            "out_r": np.where(zero, fixed.wrap(n, p["WD"], signed=False), r),
            "out_div_by_zero": zero.astype(np.int64)}


def round_saturate(p: Params, *, in_x: Ints) -> dict[str, Ints]:
    """``floor(x / 2^SHIFT + 1/2)`` clamped to WO signed bits, and whether it was clamped."""
    x, overflow = fixed.saturate(fixed.round_shift(in_x, p["SHIFT"]), p["WO"])
    return {"out_x": x, "out_overflow": overflow.astype(np.int64)}


def skid_buffer(p: Params, *, in_d: Ints) -> dict[str, Ints]:
    """The word itself: only the handshake is registered."""
    return {"out_d": ints(in_d)}


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


def root_product(p: Params, *, in_v: Ints, in_not: Ints) -> dict[str, Ints]:
    """Factors of the square root of v = in_v (or of its complement 1 - in_v): sqrt(v) ~ w * slope / 2^(B + 17).

    At B = 17 (default) |sqrt(v) - w * slope / 2^34| <= 0.52 / 2^15, and 0 at v = 0.
    """
    flip = -ints(in_not)  # every bit
    v = (ints(in_v) << 24 - p["S"] ^ flip) & 0xFFFFFF
    row = np.select([v >= 1 << 20, v >= 1 << 15, v >= 1 << 9], [0, 1, 2], 3)
    width = ints(SEGMENT_BITS)[row]
    segment = v >> width & SEGMENTS - 1
    offset = (v << 9 | flip & 0x1FF) >> width & 0x1FF  # 9 bits; more of the same kind follow the word
    middle = segment << 10 | (offset & 0x100) << 1 | (~offset & 0x100) | offset & 0xFF
    w = np.where(row == 3, segment << 10 | (flip & 1) << 9, middle)
    return {"out_w": w, "out_slope": chord_slopes(p.get("B", 17))[row, segment]}


@cache
def root_slopes() -> Ints:
    """2^32 / b^(3/2), b = 2 a + 1, raised as reciprocal_root.v says; entry 0 is that of q = 2."""
    slopes = []
    for b in [2049, *[0] * 127, *range(257, 2049, 2)]:
        square = (((256 * b * b + b + 96) << 33) // b**3 << 25) // (b * b) if b else 0
        root = 1 << (20 if b < 512 else 19 if b < 1024 else 17)
        for _ in range(6):
            root = root + square // root >> 1
        slopes.append(root + 1 >> 1 if b else 0)
    return ints(slopes)


def reciprocal_root(q: Ints) -> Ints:
    """``2^18 * 2 / sqrt(q)``, truncated, q / 2^18 from 1/4 to 2, as the tangent's product."""
    q = ints(q)
    w = (q >> 9 << 10) + 767 - (q & 0x1FF)
    return w * root_slopes()[q >> 9 & 0x3FF] >> 17
