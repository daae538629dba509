"""Bit-true model of kernel_vector_wide: `kernel_vector_solve` for words of more than 16 bits.

A product of its words has at most 62 bits and int64 holds it; where a shift takes bits past the 63rd, `wrap` needs none
of them, or the result is out of range, which is found before the shift.
"""

from __future__ import annotations

from functools import cache
from math import isqrt
from typing import NamedTuple

import numpy as np

from quadrance import kernel_vector_solve
from quadrance.fixed import Ints, ints, wrap
from quadrance.kernel_vector_solve import GUARD, SUM, Limits, Params, turned

SHIFTS = (0, 5, 8, 11)  # left shift of v = 1 - c2^2 in each of the four ranges of its root
STARTS = (0, 5, 10, 13)  # leading zeros of v from which each range counts


class Format(NamedTuple):
    """Widths of a kernel."""

    bits: int  # of a coordinate and a length, which are aligned to the left
    fraction: int  # fraction bits of the words of the third multiplier
    segments: int = 9  # a range of the table has 2^segments
    slope: int = 20  # bits of a slope
    coefficient: int = 0  # bits of the coefficient of a square; 0: a segment is straight
    distance: int = 0  # bits of the distance from the middle of a segment
    dropped: int = 0  # low bits of half the square that are not multiplied
    scale: int = 0  # bits cut from that product


FORMATS = (Format(16, 25), Format(20, 25, 9, 25, 5, 5, 3, 3), Format(24, 29, 10, 28, 8, 8, 6, 7))


def form(p: Params) -> Format:
    """The narrowest kernel that takes these coordinates; the first one is kernel_vector_solve."""
    return next(one for one in FORMATS if p["W"] <= one.bits)


def config(p: Params, *, cfg_l1: int, cfg_l2: int) -> dict[str, int]:
    """As `kernel_vector_solve.config`, of lengths aligned to the N = 16, 20 or 24 bits of `form`; with F fraction bits
    of the kernel's words, and D = 2 N - F.

    `cfg_e` shifts the gap q - Q1 - Q2 so that 2 L1 L2 takes 2 N or 2 N + 1 bits, 2 e - D to the left; `cfg_q` is -Q1 -
    Q2 with the half that rounds this shift; `cfg_r` is 2^(2 F - 1 + D - 2 e) / (2 L1 L2 + half), always less: a point
    in reach, borders included, never seems out of it.
    """
    bits, fraction = form(p)[:2]
    if bits == 16:
        return kernel_vector_solve.config(p, cfg_l1=cfg_l1, cfg_l2=cfg_l2)
    l1, l2 = (int(length) << bits - p["W"] for length in (cfg_l1, cfg_l2))
    double, drop = 2 * l1 * l2, 2 * bits - fraction
    e = min((2 * bits + 1 - double.bit_length()) // 2, bits - 1)
    half = 1 << drop - 1 - 2 * e if 2 * e < drop else 0
    ratio = ((1 << 2 * fraction - 1 + drop - 2 * e) - 1) // max(double + half, 1)
    # an arm of no length reaches no target but its shoulder: then the gap must not be 1
    return {"cfg_q": half - l1 * l1 - l2 * l2 + (l1 == l2 == 0), "cfg_r": ratio, "cfg_e": e}


@cache
def tables(f: Format) -> tuple[Ints, Ints]:
    """Slopes and coefficients of kernel_vector_curve.v, 4 ranges of 2^segments: three roots, 1/q and 2/sqrt(q).

    In ranges 2 and 3 the first quarter is a root of small v, the rest a function of q, which is at least 1/4.
    """
    count, power = 1 << f.segments, f.segments + 2 * f.slope
    slope, square = np.zeros((4, count), dtype=np.int64), np.zeros((4, count), dtype=np.int64)
    for a in range(count):
        b = 2 * a + 1
        for i in range(4):
            if i < 2 or 4 * a < count:
                twice, part = isqrt((1 << power - 3 - SHIFTS[i]) // b), (1 << f.coefficient + f.segments - 3) // b
            elif i == 2:
                twice, part = (1 << 2 * f.segments - 1 + f.slope) // b**2, (1 << f.coefficient + f.segments) // b
            else:
                even = 63 - f.segments % 2
                twice = (isqrt((1 << even) // b) << (2 * f.segments - 1 + power - even) // 2) // b
                part = (3 << f.coefficient + f.segments - 3) // b
            slope[i, a] = twice + 1 >> 1 & (1 << f.slope) - 1
            square[i, a] = min(part + 1 >> 1, (1 << f.coefficient) - 1)
    return slope.ravel(), square.ravel()


def _moved(f: Format, row: Ints, distance: Ints, high: Ints, more: int) -> Ints:
    """What the square of the distance from the middle of a segment moves a first factor by.

    `distance`: its bits below the first, `high`: that bit, 1 beyond the middle.
    """
    u = np.where(high == 1, distance, ~distance) & (1 << f.distance) - 1
    return tables(f)[1][row] * (u * (u + 1) // 2 >> f.dropped) >> f.scale + more


def root_product(f: Format, v: Ints) -> tuple[Ints, Ints]:
    """First factor, 1.0 is 2^fraction, and slope of sqrt(v / 2^(fraction + 1))."""
    bits, top = f.fraction + 1, f.fraction + 1 - f.segments
    which = sum((v >> bits - start == 0).astype(np.int64) for start in STARTS[1:])
    shift = ints(SHIFTS)[which]
    e = (v << shift) + np.where(which > 0, 1 << np.maximum(shift - 1, 0), 0)
    row = (which << f.segments) + (e >> top)
    w = e + (e >> top << top) + (1 << top - 1)
    moved = _moved(f, row, e >> top - 1 - f.distance, e >> top - 1 & 1, 0)
    return (w >> 2 << 1) + 1 - moved, tables(f)[0][row]


def inverse_product(f: Format, q: Ints, root: Ints) -> Ints:
    """A quarter of 1/q', or of 2 / sqrt(q'), q' = q / 2^fraction from 1/4 to 1, 2 fraction - 1 fraction bits."""
    top = f.fraction - f.segments
    a, d, high = q >> top & (1 << f.segments) - 1, q & (1 << top) - 1, q >> top - 1 & 1
    inverse = (a << top) + (~d & (1 << top) - 1)
    halved = (a << top) + (1 - high << top - 1) + (high << top - 2) + (~d >> 1 & (1 << top - 2) - 1)
    row = (2 + ints(root) << f.segments) + a
    moved = _moved(f, row, d >> top - 1 - f.distance, high, 1)
    return ((np.where(root, halved, inverse) | 1) + moved) * (tables(f)[0][row] << f.fraction + 1 - f.slope)


def unit_word(p: Params, product: Ints) -> Ints:
    """A coordinate of a unit vector, nearest (ties upward), of a product of the third multiplier."""
    return wrap((product >> 2 * form(p).fraction - 2 - p["U"]) + 1 >> 1, p["U"] + 2)


def _spare_pairs(f: Format, q: Ints) -> Ints:
    """Pairs of upper bits that a q of as many pairs as a coordinate has bits can spare."""
    return f.bits - (np.ceil(np.log2(np.maximum(q, 1) + 0.5)).astype(np.int64) + 1) // 2 - (q == 0)


def _shifted(f: Format, total: Ints, s: Ints) -> Ints:
    """The word of a sum with SUM fraction bits: times 2^(2 s - 2 bits + fraction), truncated."""
    return wrap(total << 2 * s >> 2 * f.bits - f.fraction + SUM, f.fraction + 2)


def _reciprocal(f: Format, q: Ints, s: Ints, root: Ints) -> Ints:
    """The word of 1/q' or of 2 / sqrt(q'), of a sum q with SUM fraction bits."""
    return wrap(inverse_product(f, _shifted(f, q, s), root) >> f.fraction - 2, f.fraction + 2)


def _direction_power(f: Format, s: Ints) -> Ints:
    """The value that replaces k1 where q is the quadrance of a direction alone."""
    return np.int64(1) << f.bits - 1 + GUARD + (s & 1)


def aim(f: Format, x: Ints, y: Ints) -> tuple[Ints, Ints]:
    """(x, y) / |(x, y)| of aligned words, products with 2 fraction - 1 fraction bits.

    Both are brought to [1/2, 1], and halved where the sum of their squares is 1 or more.
    """
    used = (x ^ x >> 63) | (y ^ y >> 63)
    spare = f.bits - 1 - np.ceil(np.log2(used + 1)).astype(np.int64)
    x, y = (word << spare + f.fraction - f.bits for word in (x, y))
    q = (x * x >> f.fraction - 2) + (y * y >> f.fraction - 2) + 1
    over = ints(q >> f.fraction != 0)
    r = wrap(inverse_product(f, q >> 2 * over, np.True_) >> f.fraction - 2, f.fraction + 2)
    return (x >> over) * r, (y >> over) * r


def elbow_plane(f: Format, x: Ints, y: Ints, more: int, elbow: Ints, l1: Ints, l2: Ints, cfg_q: Ints, cfg_r: Ints,
                cfg_e: Ints, limits: Limits) -> tuple[Ints, ...]:
    """(c1, n1, c2, n2, unreachable, at the shoulder, near to singular) of aligned words, x with `more` fraction bits.

    Cosines and sines are products with 2 fraction - 1 fraction bits. Last is what `kernel_vector_solve.edges` calls
    near; the slack in `limits` has bits - 2 fraction bits of c2.
    """
    one, drop = 2 * f.fraction - 1, 2 * f.bits - f.fraction + SUM
    total = turned(x << GUARD + 1 - more, y << GUARD + 1, x, y, more)
    q, gap = total >> SUM, total + (cfg_q << SUM)
    up = 2 * cfg_e - drop
    beyond = np.abs(gap + (gap < 0)) >> np.clip(f.fraction + 1 - up, 0, 63) != 0
    n = np.where(beyond, 0, gap) << np.maximum(up, 0) >> np.maximum(-up, 0)
    product = n * cfg_r
    clamped = beyond | (product < -(1 << one)) | (product >= 1 << one)
    short = gap < 0
    c2 = np.where(clamped, np.where(short, -1, 1) << f.fraction, product >> f.fraction - 1)
    fine = np.where(clamped, 0, product >> f.fraction - 2)  # c2 with a bit more
    square = c2 * fine >> f.fraction  # 2^(fraction + 1): the root of 1 - c2^2 would read 1
    w, slope = root_product(f, ~square & (1 << f.fraction + 1) - 1)
    w = np.where(clamped | (square >> f.fraction + 1 != 0), 1, np.where(elbow == 1, -w, w))
    n2 = w * (slope << f.fraction + 1 - f.slope)
    k1 = (c2 * l2 >> f.fraction - GUARD) + (l1 << GUARD)
    k2 = (n2 >> f.fraction - 1) * l2 >> f.fraction - GUARD
    s = _spare_pairs(f, q)
    r = _reciprocal(f, total, s, clamped)
    k1 = 2 * np.where(clamped, np.where(k1 < 0, -1, 1) * _direction_power(f, s), k1) + 1
    far, near = clamped, np.False_
    if limits:
        margin, slack = limits[0] << GUARD, limits[1]
        less = (product >> one + 2 - f.bits) - slack
        far = clamped & (beyond | (product >> one + 1 != 0) | (less >> f.bits - 2 > 0))
        bent = (elbow == 1) & ~clamped & (square >> f.fraction + 1 == 0)
        near = (k2 + np.where(bent, margin, -margin) < 0) != (k2 < 0)
    k2, s = 2 * k2 + 1, np.where(clamped, s >> 1, s)
    b, a = (_shifted(f, turned(*k, x, y, more), s) for k in ((k1, k2), (-k2, k1)))
    return b * r, a * r, np.where(clamped, np.where(short, -1, 1) << one, product), n2, far, q == 0, near


def aligned_limits(f: Format, p: Params, limits: Limits) -> Limits:
    """Margin and slack, the margin of aligned words."""
    return limits and (ints(limits[0]) << f.bits - p["W"], ints(limits[1]))


def plane(p: Params, in_x: Ints, in_y: Ints, in_elbow: Ints, *words: Ints, limits: Limits = None) -> tuple[Ints, ...]:
    """`elbow_plane` of the ports of a core in the plane; `words`: `cfg_l1`, `cfg_l2` and the rest of `config`."""
    f = form(p)
    x, y, elbow, l1, l2, *rest = (ints(word) for word in np.broadcast_arrays(in_x, in_y, in_elbow, *words))
    x, y, l1, l2 = (word << f.bits - p["W"] for word in (x, y, l1, l2))
    return elbow_plane(f, x, y, 0, elbow, l1, l2, *rest, aligned_limits(f, p, limits))


def yaw(f: Format, x: Ints, y: Ints, shoulder: Ints | None = None, back: Ints = 0) -> tuple[Ints, Ints, Ints]:
    """(c3, n3) of aligned words, products as in `elbow_plane`, and the length c3 x + n3 y, GUARD fraction bits.

    `back`: both are negative. The `shoulder` offset, where there is one, is subtracted from the length and takes the
    place of what rounds it.
    """
    q = x * x + y * y
    s = _spare_pairs(f, q)
    power, one = 2 * _direction_power(f, s) * np.where(back != 0, -1, 1) + 1, ints(1)
    r = _reciprocal(f, q << SUM, s, np.True_)
    c, n = (_shifted(f, turned(*k, x, y), s >> 1) * r for k in ((power, one), (-one, power)))
    cut = 2 * f.fraction - 3 - f.bits  # cosines keep bits + 2 fraction bits, the sum has bits + 1
    total = turned(2 * (c >> cut) + 1, 2 * (n >> cut) + 1, x, y)
    more = 1 << f.bits - GUARD if shoulder is None else -(shoulder << f.bits + 1) - (1 << SUM)
    return c, n, total + more >> f.bits + 1 - GUARD


def _radius(f: Format, q: Ints, back: Ints) -> Ints:
    """The root of q with the sign of the shoulder's side, GUARD fraction bits; 0 where q is negative."""
    q = np.maximum(q, 0)
    s = _spare_pairs(f, q)
    product = _shifted(f, q << SUM, s >> 1) * _reciprocal(f, q << SUM, s, np.True_)
    return wrap(product >> 2 * f.fraction - f.bits - GUARD - (s & 1), f.bits + 6) ^ -ints(back != 0)


def beside(f: Format, x: Ints, y: Ints, lateral: Ints, square: Ints, back: Ints) -> tuple[Ints, ...]:
    """`yaw` of an arm whose plane passes beside the axis, and whether the point is nearer to it than that.

    Joint 3 is the point seen from (rho, b), whose length is the point's own. Nearer than b rho is 0, and a direction is
    all that matters: a power of two replaces b, and the products are with 2 / sqrt(q') instead of 1/q'.
    """
    q = x * x + y * y
    near, s = q < square, _spare_pairs(f, q)
    k1 = 2 * np.where(near, 0, _radius(f, q - square, back)) + 1
    k2 = 2 * np.where(near, _direction_power(f, s) * np.where(lateral < 0, -1, 1), lateral << GUARD) + 1
    r = _reciprocal(f, q << SUM, s, near)
    c, n = (_shifted(f, turned(*k, x, y), np.where(near, s >> 1, s)) * r for k in ((k1, k2), (-k2, k1)))
    return c, n, k1 >> 1, near


def space(p: Params, in_x: Ints, in_y: Ints, in_z: Ints, in_elbow: Ints, *words: Ints,
          limits: Limits = None) -> tuple[Ints, ...]:
    """As `plane`, of a core in space; and the same of joint 3: (c3, n3, on its axis)."""
    f = form(p)
    x, y, z, elbow, l1, l2, *rest = (ints(word) for word in np.broadcast_arrays(in_x, in_y, in_z, in_elbow, *words))
    x, y, z, l1, l2 = (word << f.bits - p["W"] for word in (x, y, z, l1, l2))
    c3, n3, rho = yaw(f, x, y)
    limits = aligned_limits(f, p, limits)
    found = elbow_plane(f, rho, z, GUARD, elbow, l1, l2, *rest, limits)
    if limits:
        found = (*found[:-1], found[-1] | (rho >> GUARD < limits[0]))
    return *found, c3, n3, (x == 0) & (y == 0)
