"""Bit-true model of product_engine: sums of products of 27-bit words, reciprocal roots, lengths of vectors.

A word carries 1.0 as 2^25.
"""

from __future__ import annotations

import numpy as np

from quadrance import arith
from quadrance.fixed import Ints, ints, wrap

N, H, G = 27, 25, 3  # bits of a word, its fraction bits, fraction bits of a sum below them
ONE = 1 << H


def term(a: Ints, b: Ints) -> Ints:
    return ints(a) * ints(b) >> H - G


def sum_of(*terms: Ints) -> Ints:
    """The adder: 32 bits, from half a unit on."""
    found = ints(1 << G - 1)
    for one in terms:
        found = found + one
    return wrap(found, 2 * N - H + G)


def rounded(added: Ints) -> Ints:
    return wrap(added >> G, N)


def dot(*pairs: tuple[Ints, Ints]) -> Ints:
    """A word: the sum of products; of a negative one, (a, b, -1), the one's complement is added."""
    return rounded(sum_of(*(~term(*pair[:2]) if len(pair) == 3 else term(*pair) for pair in pairs)))


def fold(word: Ints) -> Ints:
    return word ^ word >> 63


def power_of(seen: Ints) -> Ints:
    """2^s that brings the leading one of the OR of magnitudes to bit 25, 0 for nothing."""
    bits = np.ceil(np.log2(np.maximum(seen, 1) + 0.5)).astype(np.int64)
    return np.where(seen > 0, np.int64(1) << 26 - np.minimum(bits, 26), 0)


def low(a: Ints, b: Ints) -> Ints:
    return wrap(ints(a) * ints(b), N)


def reciprocal(q: Ints, minus: Ints | bool = False) -> Ints:
    """The word 1 / (2 sqrt(q)) of a table argument u2.18; where `minus`, that of the slope's complement."""
    q = ints(q) & 0xFFFFF
    w = (q >> 9 << 10) + 767 - (q & 0x1FF)
    return wrap(w * (arith.root_slopes()[q >> 9 & 0x3FF] ^ -ints(minus)) >> 12, N)


def root(y: Ints, minus: Ints) -> Ints:
    """+-sqrt(y) of a word 0 <= y <= 1: y 4^j in [1/4, 1], its reciprocal root, times y 2^(j + 1).

    At y = 1 this factor wraps to -2, and the reciprocal root changes its sign too.
    """
    power = power_of(fold(y))
    s = np.ceil(np.log2(np.maximum(power, 1) + 0.5)).astype(np.int64) - 1
    shift = np.maximum(s - 1, 0) // 2
    four, two = np.where(power > 0, np.int64(1) << 2 * shift, 0), np.where(power > 0, np.int64(2) << shift, 0)
    return dot((low(y, two), reciprocal(low(y, four) >> 7, ints(minus) ^ (power == 1))))


def inverse(x: Ints) -> tuple[Ints, Ints]:
    """The word 1 / x 2^s, from 1/2 to 1 or below 0, and 2^s, which brings x to [1, 2); both are 0 where x is 0."""
    power = power_of(fold(x))
    x = low(x, power)
    g = reciprocal(sum_of(term(x, x)) >> 12)
    return dot((dot((g, x)), g)), power


def unit(a: Ints, b: Ints, floor: int = 0, minus: Ints | bool = False) -> tuple[Ints, Ints, Ints, Ints]:
    """(a, b, g, none): the vector scaled up, the reciprocal of its length, and where nothing of it lies above bit
    `floor`: there it has no direction."""
    seen = (fold(a) | fold(b)) >> floor << floor & ONE * 2 - 1
    power = power_of(seen)
    a, b = low(a, power), low(b, power)
    q = sum_of(term(a, a), term(b, b))
    return a, b, reciprocal(q >> 12, minus), seen == 0
