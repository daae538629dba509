"""Error bounds of rtl/vector.

Inverse cores compute with aligned words of 16 bits, whatever W is up to there; kernel_vector_wide with 20 or 24.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import kernel_vector_wide
from quadrance.kernel_vector_wide import FORMATS, Format, form
from quadrance.truth import Floats, floats
from quadrance.vector import GUARD

Params = dict[str, int]


def chain(joints: int, length: float = 1.0) -> float:
    """A coordinate of vector_fk2 and vector_fk3 against the vectors as they are given, none longer than `length`.

    In units of 2^-GUARD: A and B are each cut by less than 1, or B's complement is 1 low, together at most sqrt(2)
    across the vector that turns them; its two products are each cut by less than 1. The third joint turns what is off
    so far, and cuts once more. Rounding 1/2. 0.61 and 0.64 for unit vectors.
    """
    cut = 2 + math.sqrt(2) * length
    return 0.5 + (cut if joints == 2 else cut * max(length, 1.0) + 1) / 2**GUARD


def tip(p: Params, joints: int, l1: float, l2: float) -> float:
    """Tip of vector_fk1 to vector_fk3 from that of the vectors' directions.

    `chain`, or 1/2 for one joint, in every coordinate; and the length of a rounded vector, off by sqrt(1/2) 2^-U
    at most, of every joint that turns a link.
    """
    own, length = _parts(p, joints, l1, l2)
    return math.sqrt(max(joints, 2)) * own + length


def coordinate(p: Params, joints: int, l1: float, l2: float) -> float:
    """One coordinate of vector_fk1 to vector_fk3 from that of the vectors' directions."""
    return sum(_parts(p, joints, l1, l2))


def _parts(p: Params, joints: int, l1: float, l2: float) -> tuple[float, float]:
    """What a coordinate errs by itself, and what the lengths of rounded vectors move the tip."""
    off = math.sqrt(0.5) * 2.0 ** -p["U"]
    lengths = {1: l1, 2: l1 + 2 * l2, 3: 2 * l1 + 3 * l2}[joints]
    return 0.5 if joints == 1 else chain(joints, 1 + off), 1.01 * lengths * off


def length(f: Format = FORMATS[0]) -> float:
    """How far the length of (c1, n1) of vector_ik1 is from 1 before both are rounded; its direction is exact.

    The tangent, balanced: 3 / 16 b^2 at segment b = 2 a + 1; half a unit of its slope; the cut of the root to 2^-18;
    the squares' cut, one unit of 2^-18 in q either way. The greatest sum is 0.95 * 2^-16, at q = 2. Of longer words:
    `_reciprocal_root`; the squares' cut and that of a quarter of q, a unit each, where q is 1/4.
    """
    if f.coefficient:
        q = np.linspace(0.25, 1, 1 << 12)
        return float(np.max(_reciprocal_root(q, f))) + 2.0 ** (2 - f.fraction)
    b = np.arange(257, 2050, 2.0)
    q, slope = b / 2**10, 2.0**32 / b**1.5
    return float(np.max(3 / (16 * b * b) + 0.5 / slope + 2.0**-19 * np.sqrt(q) + 2.0**-19 / q))


def _moved(f: Format, t: Floats, tail: Floats, full: Floats, kind: float) -> Floats:
    """What a first factor of kernel_vector_curve is off. `full`: the part of the square at a border, in units of its
    coefficient, each of which is `kind`.

    Half a unit of the coefficient, and all that it lacks where it is cut to its bits; the square of the distance: half
    a step and the bits that are dropped; the cut of the product; the constant 1; `tail`, of third order, times t.
    """
    most = (1 << f.coefficient) - 1
    lacks = np.maximum(full - most, 0) + 0.5
    step = 2.0**-f.distance + 2.0 ** (f.dropped + 2 - 2 * f.distance)
    return kind * (lacks + np.minimum(full, most) * step) + 2 * 2.0**-f.fraction + tail * t


def _wide_root(v: Floats, f: Format) -> Floats:
    """`root` of kernel_vector_curve: twice the relative error of first factor and slope, times v.

    Segment b = 2 a + 1 of the range that v is in: t = b 2^-(segments + 1), x = 1/b at most. The third order is
    x^3 / 16, what follows x^4 / 8 at most. In the first segment of all, b = 1, the tangent alone is within t / 8 of v,
    and as much for the rest.
    """
    s, rank = f.segments, sum((v < 2.0**-start).astype(np.int64) for start in kernel_vector_wide.STARTS[1:])
    shift = np.asarray(kernel_vector_wide.SHIFTS)[rank]
    e = v * 2.0**shift
    b = np.maximum(2 * e * 2.0**s - 1, 1)  # of this segment or the one before: v may be a bit off
    t = b / 2.0 ** (s + 1)
    tail = (1 + 2 / b) / (16 * b**3)
    off = _moved(f, t, tail, 2.0 ** (f.coefficient - 5) / t, 2.0 ** (3 - 2 * s - 2 - f.coefficient) / 2)
    slope = 0.5 * 2.0 ** (2 - f.slope) / (0.5 * t**-0.5 * 2.0 ** (-shift / 2))
    # of w = e + t to about 2 e: both factors are relative to it
    relative = off / np.maximum(e, 2.0**-40) + slope
    return np.where(b > 1, 2 * v * relative * (1 + relative), 2.0 ** (-2 - s - shift))


def root(v: ArrayLike, f: Format = FORMATS[0]) -> Floats:
    """|n2^2 - v| of the root of v = 1 - c2^2 in kernel_vector_solve.

    Twice the relative half of what the tangent loses, 1/16 b^2, b = 2 v / h: h = 2^-9, and 2^-14 below 2^-5; half a
    unit of the slope, 2^-19 of 1/2 sqrt(v), or of 2^-5 of it; half a unit of the first factor; c2^2 to 2^-25. In the
    first segment of all, below 2^-14, the tangent is up to 2^-17 off.
    """
    v = np.maximum(floats(v), 2.0**-40)
    if f.coefficient:
        return _wide_root(v, f) + 2.0**-f.fraction
    high = 2.0**-23 / v + v**1.5 * 2**-17 + 2**-22
    low = 2.0**-33 / v + v**1.5 * 2**-12 + 2**-27
    return np.where(v >= 2**-5, high, np.where(v >= 2**-14, low, 2.0**-17)) + 2**-25


def inverse(q: ArrayLike, f: Format = FORMATS[0]) -> Floats:
    """Relative error of 1/q' in kernel_vector_solve, q' the quadrance times the power of 4 that takes it to [1/4, 1).

    Half of what the tangent loses at a border, 1/2 b^2, b = 2^10 q'; half a unit of the slope; of the first factor;
    the cut of the product.
    """
    q = np.maximum(floats(q), 1)
    q = q / 4.0 ** np.ceil(np.floor(np.log2(q) + 1) / 2)
    if f.coefficient:
        b = 2.0 ** (f.segments + 1) * q - 1
        off = _moved(f, q, 1.01 / b**3, 2.0 ** (f.coefficient - 2) / q, 2.0 ** (-2 * f.segments - f.coefficient))
        return 1.001 * (off / q + q**2 * 2.0 ** (3 - f.slope)) + 2.0 ** (1 - f.fraction)
    return 2**-21 / q**2 + q**2 * 2**-17 + 2**-22 / q + 2**-24


def gap(p: Params, l1: int, l2: int) -> float:
    """Error of the quadrance (LSB^2 of aligned words) that c2 of vector_ik2 stands for: the half that rounds the gap,
    twice, the rounding of cfg_r, the cut of c2 to 25 bits (29 of 24). 16 at L1 = L2 = 2^13 of 16."""
    words, f = kernel_vector_wide.config(p, cfg_l1=l1, cfg_l2=l2), form(p)
    l1, l2, drop = l1 << f.bits - p["W"], l2 << f.bits - p["W"], 2 * f.bits - f.fraction
    half = 2.0 ** (drop - 1 - 2 * words["cfg_e"]) if 2 * words["cfg_e"] < drop else 0
    return 2 * half + 2 * l1 * l2 * (1 / words["cfg_r"] + 2.0**-f.fraction)


def quadrance(p: Params, l1: int, l2: int, n2: ArrayLike, seen: ArrayLike = 0) -> Floats:
    """By how much |k|^2 differs from q: the gap, and the root times L2^2; aligned words. `seen` is what q itself may be
    off; it moves n2, and where it is not 0, q has a fraction, whose cut and that of the gap are 5/8 at most."""
    v, seen, f = floats(n2) ** 2, floats(seen), form(p)
    missed = gap(p, l1, l2) + 0.625 * (seen > 0)
    l1, l2 = l1 << f.bits - p["W"], l2 << f.bits - p["W"]
    moved = (missed + seen) / max(l1 * l2, 1)
    return missed + l2 * l2 * np.max([root(v - moved, f), root(v, f), root(v + moved, f)], axis=0)


def ik2(p: Params, l1: int, l2: int, rho: ArrayLike, n2: ArrayLike, seen: ArrayLike = 0) -> Floats:
    """Tip of vector_ik2, the products of the answered words, for a target in reach; half a unit of each word included.

    Parameters
    ----------
    p, l1, l2
        Links in LSB.
    rho, n2 : float arrays
        Distance of the target from the shoulder, LSB; |sin theta2|.
    seen : float array
        How far the quadrance that n2 belongs to is from the core's, LSB^2 of aligned words: of the rho of vector_ik3.

    Notes
    -----
    The tip is p |k|^2 / q where k, the tip of the arm with joint 1 at 0, is that of which joint 1 was worked out:

    * `quadrance` / rho: the length of k. Next to the shoulder it is not small beside rho, and below
      rho^2 = 4 times it, joint 1 is no unit vector any more: there the tip is within 4 (rho + its root).
    * k1 and k2 have 4 fraction bits, about a half: 2^(1/2) / 32, twice for the length, once beside the words' k.
    * The words: L2 and rho times 2^(1/2) / 2 of a unit.
    * `inverse`, the cut of a and b to 1/8 LSB^2, of their shifted words to 2^-25 (2^-29 of 24 bits), 1/q' <= 4.
    """
    f = form(p)
    unit = 2.0 ** (f.bits - p["W"])  # the core computes with aligned words
    rho, length = floats(rho) * unit, l2 * unit
    wrong = quadrance(p, l1, l2, n2, seen)
    far = np.maximum(rho, 1e-9)
    word = math.sqrt(0.5) / 2 ** p["U"]
    stretch = 1 + wrong / far**2 + 0.05 / far
    known = wrong / far + 2**0.5 * 3 / 32 + word * (length + rho) + rho * inverse(rho**2, f)
    if f.coefficient:
        known = known + length * 2.0**-f.fraction  # n2 is cut before it is k2; of 16 bits 2^-10 at most
    known = stretch * (known + 2**0.5 * (0.25 / far + 2.0 ** (2 - f.fraction) * rho))
    return np.where(rho**2 < 4 * wrong + 4, 4 * (rho + np.sqrt(wrong) + 1), known) / unit


def ik2_length(p: Params, l1: int, l2: int, rho: ArrayLike, n2: ArrayLike, seen: ArrayLike = 0) -> Floats:
    """| |(c1, n1)| - 1 | of vector_ik2, units of 2^-U, for a target in reach with rho^2 > 4 `quadrance`.

    |k| / |p|: half the relative error of the quadrance, k's fraction bits; 1/q'; the word.
    """
    f = form(p)
    rho = floats(rho) * 2.0 ** (f.bits - p["W"])
    part = quadrance(p, l1, l2, n2, seen) / (2 * rho**2) + 2**0.5 / 32 / rho + inverse(rho**2, f)
    part = part + 2.0 ** (3 - f.fraction)
    return (part * (1 + part) + 2**0.5 * 0.25 / rho**2) * 2.0 ** p["U"] + math.sqrt(0.5)


NEAREST = 1.3
"""Tip of vector_ik2 from the nearest point of a target out of reach, by L1 + L2 in units of 2^-U.

Rounding of (c1, n1) 0.71; of 2/sqrt(q'): half of what the tangent loses 3/16 b^2, 0.19, half a unit of the slope 0.25
at q' = 1 (not both), its first factor 0.06; the half unit in place of k2 0.06.
"""


def _reciprocal_root(q: Floats, f: Format) -> Floats:
    """Relative error of 2/sqrt(q) of kernel_vector_curve, q from 1/4 to 1: `_moved`, whose third order is 5 / 16 b^3;
    half a unit of the slope, the root in it, which is cut to 26 bits; the cut of the product."""
    b = 2.0 ** (f.segments + 1) * q - 1
    off = _moved(f, q, 0.32 / b**3, 3 * 2.0 ** (f.coefficient - 5) / q, 2.0 ** (-2 * f.segments - f.coefficient))
    return 1.001 * (off / q + q**1.5 * 2.0 ** (2 - f.slope) + q**0.5 * 2.0**-26) + 2.0 ** (1 - f.fraction)


def yaw(rho: ArrayLike, f: Format = FORMATS[0]) -> tuple[Floats, Floats]:
    """(c3, n3) of vector_ik3 before both are rounded: how far the length is from 1, and the direction off (rad).

    Parameters
    ----------
    rho : float array
        LSB of aligned words.

    Notes
    -----
    2/sqrt(q'), q' as in `inverse`: half of what the tangent loses 3/16 b^2, half a unit of the slope and of the
    first factor, the cut of the product. Both: the half unit behind 2^15 and 0, 2^-20; the cut of the products with
    them to 1/8, two a coordinate, and of what is shifted to 2^-24, sqrt(q') >= 1/2. Of longer words:
    `_reciprocal_root`.
    """
    rho = np.maximum(floats(rho), 1)
    q = rho * rho / 4.0 ** np.ceil(np.floor(np.log2(rho * rho) + 1) / 2)
    turned = 2.0 ** -(f.bits + 4) + 2.0 ** (2.5 - f.fraction) + 2.0 ** (-0.5 - f.bits) / rho
    if f.coefficient:
        root = _reciprocal_root(q, f)
    else:
        root = 3 * 2**-24 / q**2 + q**1.5 * 2**-18 + 2**-22 / q + 2**-24
    return root + turned, turned


def _yaw(p: Params, target: ArrayLike) -> tuple[Floats, Floats]:
    """`yaw` of targets in LSB."""
    f = form(p)
    return yaw(np.hypot(*floats(target)[:2]) * 2.0 ** (f.bits - p["W"]), f)


def radius(p: Params, target: ArrayLike) -> Floats:
    """Error of rho of vector_ik3, LSB: half a unit of its 4 fraction bits, the cut of the two products to 2^-17, c3 and
    n3 to 18 fraction bits about a half, and their length. With aligned words of 20 or 24 bits 2^-21, 22; 2^-25, 26."""
    f = form(p)
    rho, unit = np.hypot(*floats(target)[:2]), 2.0 ** (p["W"] - f.bits)
    return (1 / 32 + 2.0**-f.bits) * unit + rho * (2**0.5 * 2.0 ** -(f.bits + 3) + _yaw(p, target)[0])


def quadrance_seen(p: Params, target: ArrayLike) -> Floats:
    """By how much the error of rho moves the quadrance of vector_ik3, LSB^2 of aligned words; its cut to 1/8 LSB^2."""
    off = radius(p, target)
    return (2 * np.hypot(*floats(target)[:2]) + off) * off * 4.0 ** (form(p).bits - p["W"]) + 1 / 8


def reach(p: Params, l1: int, l2: int, target: ArrayLike) -> tuple[Floats, Floats]:
    """Quadrance (LSB^2) by which vector_ik2 or vector_ik3 may miss, and by which it may mistake, a target out of reach.

    `gap` on one side of a border only; the error of rho and fractions of q on both.
    """
    scale = 4.0 ** (p["W"] - form(p).bits)
    seen = quadrance_seen(p, target) + 0.625 if len(target) == 3 else 0 * floats(target[0])
    return (gap(p, l1, l2) + seen) * scale, seen * scale


def ik3(p: Params, l1: int, l2: int, target: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of vector_ik3, the products of the answered words, for targets (3, N) in reach.

    `ik2` of (rho, z), either end of the error of rho; that error, for the arm reaches it; and what (c3, n3)
    makes of it: its length once more, half a unit of both words, the direction.
    """
    x, y, z = floats(target)
    rho = np.hypot(x, y)
    off, seen, long = radius(p, target), quadrance_seen(p, target), np.hypot(rho, z)
    plane = [ik2(p, l1, l2, np.maximum(long + sign * off, 0), n2, seen) for sign in (-1, 1)]
    third = sum(_yaw(p, target)) + math.sqrt(0.5) * 2.0 ** -p["U"]
    return 1.001 * np.maximum(*plane) + off + rho * third


def ik3_length(p: Params, l1: int, l2: int, target: ArrayLike, n2: ArrayLike) -> Floats:
    """| |(c1, n1)| - 1 | and | |(c3, n3)| - 1 | of vector_ik3 together, units of 2^-U; as `ik2_length`."""
    x, y, z = floats(target)
    rho = np.hypot(x, y)
    nearer = np.maximum(np.hypot(rho, z) - radius(p, target), 0.5)
    third = _yaw(p, target)[0] * 2.0 ** p["U"] + math.sqrt(0.5)
    return ik2_length(p, l1, l2, nearer, n2, quadrance_seen(p, target)) + third


def ik3_nearest(p: Params, l1: int, l2: int, target: ArrayLike) -> Floats:
    """Tip of vector_ik3 from the nearest point of targets (3, N) out of reach.

    `NEAREST`; the yaw as in `ik3`; and (rho, z) seen from the shoulder turned by the error of rho.
    """
    target = floats(target)
    length = np.sqrt((target * target).sum(axis=0))
    at = np.where(length > (l1 + l2 + abs(l1 - l2)) / 2, l1 + l2, abs(l1 - l2))
    turned = np.arcsin(np.minimum(radius(p, target) / np.maximum(length, 1e-9), 1))
    third = sum(_yaw(p, target)) + math.sqrt(0.5) * 2.0 ** -p["U"]
    return NEAREST * (l1 + l2) / 2 ** p["U"] + at * third + 2 * at * np.sin(turned / 2)


# The codecs behind the kernel, whose joint words have no length

TANGENT = 1.14
"""Tangent of a direction from the axis about which its word is given: its sine is below 3/4 or its cosine not."""

FINE = 40  # fraction bits of a vector that is not rounded


def ik2_coded(p: Params, l1: int, l2: int, rho: ArrayLike, n2: ArrayLike, turned: float) -> Floats:
    """Tip of the joints that a codec makes of both vectors, each of which it turns by `turned` rad at most.

    `ik2` without its rounding; the lengths of both vectors, for the words have none, and what they turn; `turned`, over
    the distance and the second link.
    """
    fine = p | {"U": FINE}
    length = ik2_length(fine, l1, l2, rho, n2) * 2.0**-FINE
    return ik2(fine, l1, l2, rho, n2) + _coded(p, l2, rho, n2, length, turned)


def _coded(p: Params, l2: int, rho: ArrayLike, n2: ArrayLike, length: Floats, turned: float) -> Floats:
    """What the lengths of (c1, n1) and (c2, n2) and a codec move the tip."""
    f = form(p)
    rho, elbow = floats(rho), root(floats(n2) ** 2, f) / 2 + 2.0 ** (1 - f.fraction)
    near = np.minimum((1 + TANGENT) * length * rho, 4 * (rho + 1))  # next to the shoulder joint 1 moves it no more
    return near + turned * (rho + l2) + (1 + TANGENT) * elbow * l2


def ik3_coded(p: Params, l1: int, l2: int, target: ArrayLike, n2: ArrayLike, turned: float) -> Floats:
    """As `ik2_coded`, for targets (3, N) in reach, and joint 3."""
    fine, rho = p | {"U": FINE}, np.hypot(*floats(target)[:2])
    distance = np.sqrt((floats(target) ** 2).sum(axis=0))
    length = ik3_length(fine, l1, l2, target, n2) * 2.0**-FINE
    third = turned + TANGENT * _yaw(p, target)[0]
    return ik3(fine, l1, l2, target, n2) + _coded(p, l2, distance, n2, length, turned) + third * rho


def nearest_coded(p: Params, l1: int, l2: int, target: ArrayLike, turned: float) -> Floats:
    """Tip of the joints of a codec from the nearest point of a target out of reach: `NEAREST` of words as long as the
    kernel's, whose lengths, two such words, turn a joint once more; and `turned`."""
    joints, reach, bits = len(target), l1 + l2, form(p).bits
    words = (2 * reach / 2**bits + turned * reach) * joints
    if joints == 2:
        return NEAREST * reach / 2**bits + words + 0 * floats(target[0])
    return ik3_nearest(p | {"U": bits}, l1, l2, target) + words
