"""Bit-true model of kernel_vector_solve and its parts: joint 2 of a target, and the axis that joint 1 is seen from."""

from __future__ import annotations

import math
from functools import cache
from math import isqrt
from typing import NamedTuple

import numpy as np

from quadrance import arith
from quadrance.fixed import Ints, ints, wrap

Params = dict[str, int]

GUARD = 4  # fraction bits of k1, k2 and rho below the coordinate's LSB; a constant 1 follows them
FACTOR = 22  # bits of the first factor of a root or a reciprocal; a constant 1 follows them
SUM = 3  # fraction bits of the sum of two products


def config(p: Params, *, cfg_l1: int, cfg_l2: int) -> dict[str, int]:
    """Words that the inverse cores want besides the lengths, all of lengths aligned to 16 bits.

    `cfg_e` shifts the gap q - Q1 - Q2 so that 2 L1 L2 takes 32 or 33 bits, 2 e - 7 to the left; `cfg_q` is -Q1 - Q2
    with the half that rounds this shift; `cfg_r` is 2^(56 - 2 e) / (2 L1 L2 + half), always less: a point in reach,
    borders included, never seems out of it.
    """
    l1, l2 = (length << 16 - p["W"] for length in (cfg_l1, cfg_l2))
    double = 2 * l1 * l2
    e = min((33 - double.bit_length()) // 2, 15)
    half = 1 << 6 - 2 * e if e < 4 else 0
    ratio = ((1 << 56 - 2 * e) - 1) // max(double + half, 1)
    # an arm of no length reaches no target but its shoulder: then the gap must not be 1
    return {"cfg_q": half - l1 * l1 - l2 * l2 + (l1 == l2 == 0), "cfg_r": ratio, "cfg_e": e}


def edge_words(p: Params, words: dict[str, int], *, cfg_l1: int, cfg_l2: int, margin: float,
               slack: float, bits: int = 16) -> dict[str, int]:
    """`cfg_margin` and `cfg_slack` from margin and slack in coordinate units, beside the `words` of the lengths.

    `cfg_slack` is what c2 is above 1 at full reach and the slack, rounded up, with two fraction bits fewer than the
    `bits` of the kernel's coordinates.

    Raises
    ------
    ValueError
        Where the core has none, or the slack is longer than its word and the gap's can say.
    """
    if (margin or slack) and not p.get("MARGINS"):
        raise ValueError("margin and slack need MARGINS = 1")
    double, more = 2 * int(cfg_l1) * int(cfg_l2), slack * 2.0 ** p["F"]
    above = more * (2 * (cfg_l1 + cfg_l2) + more)  # of the square of the reach
    word = math.ceil(above * 2.0 ** (bits - 2) / max(double, 1)) if more else 0
    if more and (word >> bits - 3 or (double + above) * 4.0 ** (words["cfg_e"] - p["W"]) >= 2):
        raise ValueError(f"a slack of {slack:g} is more than these links and words can say")
    return {"cfg_margin": round(margin * 2.0 ** p["F"]), "cfg_slack": word}


def aim(x: Ints, y: Ints) -> tuple[Ints, Ints]:
    """(x, y) / |(x, y)| of words of 16 bits, with 17 fraction bits: of kernel_vector_aim."""
    either = (x ^ x >> 63) | (y ^ y >> 63)
    spare = 15 - np.ceil(np.log2(either + 1)).astype(np.int64)
    x, y = x << spare, y << spare
    root = arith.reciprocal_root((x * x >> 12) + (y * y >> 12) + 1)
    return x * root >> 17, y * root >> 17


@cache
def slopes() -> Ints:
    """The words of kernel_vector_slopes.v: 4 ranges of 512 segments."""
    table = np.zeros((4, 512), dtype=np.int64)
    for a in range(512):
        b = 2 * a + 1
        for i in range(4 if a >= 128 else 3):
            if i == 2 and a >= 128:
                table[i, a] = (((((2 * b * b + 1) << 36) // (b * b)) << 4) // (b * b) >> 4) + 1 >> 1
            else:
                square = ((8 * b * b - 1 if i < 3 else 8 * b * b + 3) << 40) // b**3
                square = (square << 3, square >> 2, square >> 7, (square << 23) // (b * b))[i]
                table[i, a] = isqrt(square) + 1 >> 1
    return table.ravel() & 0xFFFFF


def factor_word(word: Ints) -> Ints:
    """The upper bits of a 26-bit first factor and the constant 1 below them, 1.0 is 2^25."""
    return (word >> 26 - FACTOR << 26 - FACTOR) + (1 << 25 - FACTOR)


def root_product(v: Ints, fine: bool) -> tuple[Ints, Ints]:
    """sqrt(v / 2^26) as a product with 49 fraction bits; `fine`: with a range of its own for v below 2^-12."""
    low, tiny = v >> 21 == 0, (v >> 14 == 0) & fine
    e = np.where(tiny, (v << 5) + 16 & 0x1FFFFF, np.where(low, v & 0x1FFFFF, v >> 5))
    w = (e >> 11 << 16) + ((~e >> 11 & 1) << 15) + ((e & 0x7FF) << 4)
    return factor_word(w), slopes()[np.where(tiny, 1024, 512 * low) + (e >> 12)]


def inverse_product(q: Ints, root: Ints) -> Ints:
    """A quarter of 1/q, or of 2 / sqrt(q), q' = q / 2^25 from 1/4 to 1, as a product with 49 fraction bits."""
    a, d = q >> 16, q & 0xFFFF
    w = (a << 16) + np.where(root, ((~d >> 15 & 1) << 15) + ((d >> 15) << 14) + (~d >> 1 & 0x3FFF), ~d & 0xFFFF)
    return factor_word(w) * (slopes()[1024 + 512 * ints(root) + (a & 511)] << 6)


def spare_pairs(q: Ints) -> Ints:
    """Pairs of upper bits that a 32-bit q > 0 can spare; 15 for 0."""
    bits = np.ceil(np.log2(np.maximum(q, 1) + 0.5)).astype(np.int64)
    return (32 - bits) // 2 - (q == 0)


def turned(k1: Ints, k2: Ints, x: Ints, y: Ints, more: int = 0) -> Ints:
    """k1 x + k2 y, k with GUARD + 1 fraction bits, x with `more` and y with none; the sum has SUM."""
    cut = GUARD + 1 - SUM
    return (k1 * x >> cut + more) + (k2 * y >> cut)


def shifted(total: Ints, s: Ints) -> Ints:
    """A sum with SUM fraction bits times 2^(2 s - 7), truncated, in 27 bits; it fits but next to the shoulder."""
    return wrap(wrap(total, 34 + SUM) << 2 * s >> SUM + 7, 27)


def seen(k1: Ints, k2: Ints, x: Ints, y: Ints, more: int, s: Ints) -> tuple[Ints, Ints]:
    """(x, y) seen from the axis (k1, k2): k1 x + k2 y and k1 y - k2 x, shifted."""
    return shifted(turned(k1, k2, x, y, more), s), shifted(turned(-k2, k1, x, y, more), s)


def reciprocal(inverse: Ints) -> Ints:
    """The word of 1/q' or of 2 / sqrt(q') from its product, 1.0 is 2^24."""
    return wrap(inverse >> 23, 27)


def direction_power(s: Ints) -> Ints:
    """The value that replaces k1 where q is the quadrance of a direction alone: 2^15, or 2^16 where s is odd."""
    return np.int64(1) << 15 + GUARD + (s & 1)


class Solved(NamedTuple):
    """What is known of the target (x, y) when the direction of joint 1 is still to come."""

    cosine: Ints  # c2 as a product with 49 fraction bits, where it is not out of reach
    sine: Ints  # n2, likewise
    k1: Ints  # the tip of the arm with joint 1 at 0, with the constant 1 below it
    k2: Ints
    s: Ints  # the shift of `seen`
    reciprocal: Ints
    clamped: Ints  # out of reach
    short: Ints  # c2 < 0
    zero: Ints  # x = y = 0
    flat: Ints  # n2 = 0
    beyond: Ints  # farther out of reach than c2 says


def solve(x: Ints, y: Ints, more: int, elbow: Ints, l1: Ints, l2: Ints, cfg_q: Ints, cfg_r: Ints, cfg_e: Ints,
          spread: bool = False, exact: Ints | None = None) -> Solved:
    """Joint 2 of the target (x, y), x with `more` fraction bits, and what joint 1 follows from.

    `spread`: as kernel_solve does it, whose root is finer near 0 and takes the elbow's sign when it has become k2. The
    gap is that of the quadrance of the word x where it is not given `exact`.
    """
    total = turned(x << GUARD + 1 - more, y << GUARD + 1, x, y, more)
    q, gap = total >> SUM, (total if exact is None else exact << SUM) + (cfg_q << SUM)
    up = 2 * cfg_e - 7 - SUM
    n = gap << np.maximum(up, 0) >> np.maximum(-up, 0)
    beyond = (n < -(1 << 26)) | (n >= 1 << 26)
    product = np.where(beyond, 0, n) * cfg_r
    clamped = beyond | (product < -(1 << 49)) | (product >= 1 << 49)
    short = gap < 0
    c2 = np.where(clamped, np.where(short, -1, 1) << 25, product >> 24)
    fine = np.where(clamped, 0, product >> 23)  # c2 with a bit more
    square = c2 * fine >> 25  # 2^26: the root of 1 - c2^2 would read 1
    w, slope = root_product(~square & 0x3FFFFFF, spread)
    w = np.where(clamped | (square >> 26 != 0), 1 << 25 - FACTOR, np.where((elbow == 1) & (not spread), -w, w))
    k1 = (c2 * l2 >> 25 - GUARD) + (l1 << GUARD)
    n2 = w * (slope << 6)
    k2 = (n2 >> 24) * l2 >> 25 - GUARD
    k2 = np.where((elbow == 1) & spread, ~k2, k2)
    s = spare_pairs(q)
    inverse = inverse_product(total << 2 * s >> 7 + SUM, clamped)
    k1 = np.where(clamped, np.where(k1 < 0, -1, 1) * direction_power(s), k1)
    s = np.where(clamped, s >> 1, s)
    flat = clamped | (square >> 26 != 0)
    return Solved(product, n2, 2 * k1 + 1, 2 * k2 + 1, s, reciprocal(inverse), clamped, short, q == 0, flat, beyond)


def edges(found: Solved, elbow: Ints, margin: Ints, slack: Ints) -> tuple[Ints, Ints]:
    """Out of reach by more than the slack, 2^-14 of c2; within the margin of a stretched or folded arm, L2 |n2| in LSB.

    Without L2 there is no elbow, and the answer for `elbow` 1 is not near anything.
    """
    far = found.clamped & (found.beyond | (found.cosine >> 50 != 0) | ((found.cosine >> 35) - slack >= 1 << 14))
    k2 = found.k2 >> 1
    moved = k2 + np.where((elbow == 1) & ~found.flat, margin, -margin) * (1 << GUARD)
    return far, (moved < 0) != (k2 < 0)


def elbow_plane(x: Ints, y: Ints, more: int, *words: Ints, limits: tuple[Ints, Ints] | None = None) -> tuple[Ints, ...]:
    """(c1, n1, c2, n2, unreachable, at the shoulder) of the target (x, y), x with `more` fraction bits.

    Cosines and sines are the products that they are, with 49 fraction bits. Last comes what `edges` calls near to
    singular; without `limits`, margin and slack, nothing is.
    """
    found = solve(x, y, more, *words)
    b, a = seen(found.k1, found.k2, x, y, more, found.s)
    c2 = np.where(found.clamped, np.where(found.short, -1, 1) << 49, found.cosine)
    far, near = edges(found, words[0], *limits) if limits else (found.clamped, np.False_)
    return b * found.reciprocal, a * found.reciprocal, c2, found.sine, far, found.zero, near


def yaw(x: Ints, y: Ints) -> tuple[Ints, Ints, Ints, Ints]:
    """(x, y) shifted and 2 / sqrt(q'), whose products are (c3, n3); its length c3 x + n3 y, GUARD fraction bits."""
    q = x * x + y * y
    s = spare_pairs(q)
    b, a = seen(2 * direction_power(s) + 1, ints(1), x, y, 0, s >> 1)
    r = reciprocal(inverse_product(q << 2 * s >> 7, np.True_))
    total = turned(2 * (b * r >> 31) + 1, 2 * (a * r >> 31) + 1, x, y)  # of cosines with 18 fraction bits: 17
    return b, a, r, total + (1 << 16 - GUARD) >> 17 - GUARD


Limits = tuple[Ints, Ints] | None  # margin and slack of a core with MARGINS = 1


def plane(p: Params, in_x: Ints, in_y: Ints, in_elbow: Ints, *words: Ints, limits: Limits = None) -> tuple[Ints, ...]:
    """`elbow_plane` of the ports of a core in the plane; `words`: `cfg_l1`, `cfg_l2` and the rest of `config`."""
    x, y, elbow, l1, l2, *rest = (ints(word) for word in np.broadcast_arrays(in_x, in_y, in_elbow, *words))
    x, y, l1, l2 = (word << 16 - p["W"] for word in (x, y, l1, l2))
    limits = limits and (ints(limits[0]) << 16 - p["W"], ints(limits[1]))
    return elbow_plane(x, y, 0, elbow, l1, l2, *rest, limits=limits)


def space(p: Params, in_x: Ints, in_y: Ints, in_z: Ints, in_elbow: Ints, *words: Ints,
          limits: Limits = None) -> tuple[Ints, ...]:
    """As `plane`, of a core in space; and the same of joint 3: (c3, n3, on its axis)."""
    x, y, z, elbow, l1, l2, *rest = (ints(word) for word in np.broadcast_arrays(in_x, in_y, in_z, in_elbow, *words))
    x, y, z, l1, l2 = (word << 16 - p["W"] for word in (x, y, z, l1, l2))
    b, a, r, rho = yaw(x, y)
    limits = limits and (ints(limits[0]) << 16 - p["W"], ints(limits[1]))
    found = elbow_plane(rho, z, GUARD, elbow, l1, l2, *rest, limits=limits)
    if limits:
        found = (*found[:-1], found[-1] | (rho >> GUARD < limits[0]))
    return *found, b * r, a * r, (x == 0) & (y == 0)
