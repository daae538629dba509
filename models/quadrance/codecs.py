"""Joint words: what a word of each port type means, and the bit-true models of rtl/codec.

A joint port has a type (`rtl/cores.toml`). Encoding, decoding and the error of rounding to a word follow the type, here
and nowhere else: a new type is one more pair of functions in `CODINGS`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from quadrance import fixed, truth
from quadrance.cores import Port
from quadrance.fixed import Ints, ints
from quadrance.truth import Floats, floats

Params = dict[str, int]

# Joint words by port type: what a word stands for, in float64

Coding = tuple[Callable[[Floats, int], Floats], Callable[[Floats, int], Floats]]
# type: (word of an angle as a real number of LSB, angle of such a number); both take the width of the port
CODINGS: dict[str, Coding] = {
    "spread": (lambda theta, width: truth.angle_to_spread(theta, width - 2),
               lambda word, width: truth.spread_word_to_angle(word, width - 2)),
    "angle": (lambda theta, width: theta * (2.0**width / truth.TURN), truth.binary_word_to_angle),
}


def _coding(port: Port) -> Coding:
    if port.type not in CODINGS:
        raise ValueError(f"{port.name}: a port of type {port.type} is no joint word; types are {', '.join(CODINGS)}")
    return CODINGS[port.type]


def exact(port: Port, theta: ArrayLike) -> Floats:
    """Joint words of angles (radians) before rounding: real numbers of LSB, modulo a full turn."""
    word, _ = _coding(port)
    return word(floats(theta), port.width)


def encode(port: Port, theta: ArrayLike) -> Ints:
    """Joint words nearest to angles.

    Parameters
    ----------
    port : Port
        Of a joint type; a full turn is 2^width words in every type, a quadrant border every 2^(width - 2).
    theta : float array
        Radians, any turn.

    Returns
    -------
    int64 array of that shape
        Words of the port, signed where it is; error at most `half_step` radians.
    """
    return fixed.wrap(np.floor(exact(port, theta) + 0.5), port.width, port.signed)


def decode(port: Port, word: ArrayLike) -> Floats:
    """Angles (radians, in [0, 2 pi)) of joint words, or of real numbers of their LSB; the shape is kept."""
    _, angle = _coding(port)
    return angle(floats(word), port.width)


def within_cell(port: Port, word: ArrayLike, theta: ArrayLike) -> Floats:
    """The angle nearest to `theta` (in words) among those that round to `word`: what of an answer is not rounding."""
    turn = 2.0**port.width
    off = np.mod(exact(port, theta) - word + turn / 2, turn) - turn / 2
    return decode(port, word + np.clip(off, -0.5, 0.5))


def half_step(port: Port) -> float:
    """The most that rounding to a word of this port turns a joint, in radians.

    Half an LSB beside a quadrant border, where each type is as coarse as it gets: asin 2^(-(S + 1) / 2) of a
    turn-spread, whose sin^2 is flat there (0.0099 degrees at S = 24), pi / 2^A of a binary angle, everywhere.
    """
    return float(decode(port, 0.5))


def border_words(port: Port) -> Ints:
    """Words at every quadrant border, every power of two before and behind it, and two neighbours either way."""
    steps = np.array([0, *(1 << i for i in range(port.width - 1))])
    near = np.concatenate([steps, -steps])[:, None] + np.arange(-2, 3)
    words = (np.arange(4)[:, None] << port.width - 2) + near.ravel()
    return np.unique(fixed.wrap(words, port.width, port.signed))


# Bit-true models of rtl/codec

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
