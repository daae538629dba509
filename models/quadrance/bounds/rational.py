"""Error bounds of rtl/rational, whose inverse cores compute with aligned words of 16, 20 or 24 bits."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance.bounds import codec, vector
from quadrance.kernel_vector_wide import Format, form
from quadrance.truth import Floats, floats

Params = dict[str, int]


def fk1(p: Params, l1: float) -> float:
    """A coordinate: rounding 1/2, the cut of L1 w to 2^-5 times a slope of at most 2, and the root.

    As a distance at most 1 up to L1 = 2^14 (found: 0.95 over all 2^24 spreads there).

    With W above 18 rounding 1/2, the cut of one product to 2^-5, and L1 times the error of a root of W fraction bits,
    the greater of the minor and the major one, since either may be the cosine.
    """
    if p["W"] > 18:
        return 0.5 + 1 / 32 + codec.spread_chord(p["W"]) / 2 ** p["W"] * l1
    return 0.5 + 1 / 16 + codec.root_product() * l1


def fk1_tip(p: Params, l1: float) -> float:
    """`fk1` as a distance, up to L1 = 2^(W - 2): 1 found; with W above 18 that of both roots, one minor, one major."""
    if p["W"] > 18:
        return math.sqrt(2) * (0.5 + 1 / 32) + turn(p["W"]) * l1
    return 1.0


DIRECTION = 0.48 * 2.0**-14
"""Angle (rad) from a target to the nearest direction that rounds to the word of rational_ik1, W up to 16.

s = m^2 r: d theta = (dr / r) t / 2, t = m / M <= 2, q = M^2 (1 + t^2), M >= 1/2. dr / r is the sum of

* sag of the tangent, raised by half of it: 2^-19 / q^2, alone at most 0.08 * 2^-14 rad;
* q, three units of 2^-17 about their middle, and the one's complement of w for -w, half a unit of 2^-16 about the
  quarter that is in the slope: 1.25 * 2^-16 / q, alone 0.31;
* half a unit of the slope: 2^-17 q^2, alone 0.25.

Together at most 0.466 * 2^-14, at M = 1/2, m = 1. The cuts of m w and m slope to 2^-24 turn the direction by at
most 2^-21 each, for beside an axis m is as small as they are.
"""


def spread_of_vector(p: Params) -> float:
    """Angle (rad) by which spread_of_vector is off before rounding to a word, of a unit vector.

    m is in [i, i + 1) of its last bit; sqrt(i (i + 1)) is within 0.59 of that but at i = 0, and its slope 1.52 at most.
    """
    return 2.0 ** -(form(p).bits + 2)


def direction(p: Params) -> float:
    """`DIRECTION`; with W above 16 that of spread_of_vector, whose vector is `vector.length` long."""
    if (f := form(p)).bits == 16:
        return DIRECTION
    return spread_of_vector(p) + vector.TANGENT * vector.length(f)


def turn(u: int) -> float:
    """Error of a turn, by the length turned: a joint's two roots err like a vector, the wide one without its sag."""
    if u > 18:
        return math.hypot(*codec.spread_roots(u)) / 2**u
    return math.hypot(codec.spread_chord(u), codec.spread_chord(u) - 0.16 * 2.0 ** (u - 16)) / 2**u


def chain(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of rational_fk2 and rational_fk3.

    Rounding 1/2. The joint that carries the whole length errs twice, as it is turned by both joints: L1 + 2 L2. The
    cuts of A and B, then of two products, are 2^-5 each. The third joint: one root more, two more cuts.
    At L1 + L2 = 2^14 found: 0.85 with two joints, 1.0 with three, and 1.02 as a distance with two.
    """
    bound = 0.5 + turn(p["U"]) * (l1 + 2 * l2) + (2**0.5 + 2) / 32
    return bound if joints == 2 else bound + codec.spread_chord(p["U"]) / 2 ** p["U"] * (l1 + l2) + 2 / 32


def _aligned(p: Params, *lengths: ArrayLike) -> tuple[Floats, ...]:
    """Lengths in LSB of the kernel's coordinate, in which the inverse cores work."""
    return tuple(floats(length) * 2.0 ** (form(p).bits - p["W"]) for length in lengths)


def gap(p: Params, l1: int, l2: int) -> float:
    """Error of the quadrance (LSB^2 of a coordinate) that cos theta2 of rational_ik2 and rational_ik3 stands for.

    That of `vector.gap`, whose front end they share; in space the gap is that of the exact quadrance, with W up to 16.
    16 at L1 = L2 = 2^13.
    """
    return vector.gap(p, l1, l2) / 4.0 ** (form(p).bits - p["W"])


def _root(v: ArrayLike, f: Format) -> Floats:
    """|n2^2 - v| of the root of v = 1 - c2^2 in kernel_solve, in its three ranges: `vector.root` down to 2^-12; in
    kernel_vector_wide it is that everywhere.

    Below it h = 2^-19: 1/16 b^2 of twice v; half a unit of the slope, 2^-19 of 2^-10 of it; half a unit of the first
    factor. In the first segment, below 2^-19, the tangent is up to 2^-22 off. c2^2 to 2^-25.
    """
    if f.coefficient:
        return vector.root(v, f)
    v = np.maximum(floats(v), 2.0**-40)
    tiny = 2.0**-43 / v + v**1.5 * 2**-7 + 2**-32
    return np.where(v >= 2**-12, vector.root(v), np.where(v >= 2**-19, tiny, 2.0**-22) + 2**-25)


def _bend(p: Params, l1: int, l2: int, rho: Floats, seen: ArrayLike = 0) -> tuple[Floats, Floats, Floats]:
    """Of the elbow that the core computes for a tip in reach at `rho`, all about the kernel's words: error of the
    cosine, of the square of the sine beside it, and of the angle (rad). `seen` is what the quadrance itself may be off.

    The cosine is off by gap / (2 L1 L2). Joint 2 is c2, or n2 where that is less in magnitude: then the cosine of its
    word is off by root / (2 |c2|), c2^2 >= 1/2, besides, and where it is not, n2 by root / (2 |n2|).
    """
    f, double = form(p), max(2 * l1 * l2, 1e-9)
    off = (vector.gap(p | {"W": f.bits}, l1, l2) + floats(seen)) / double
    c2 = np.clip((rho * rho - l1 * l1 - l2 * l2) / double, -1, 1)
    v = 1 - c2 * c2
    root = np.max([_root(np.maximum(v + sign * 2 * off, 0), f) for sign in (-1, 0, 1)], axis=0)
    cosine = off + 0.75 * root
    theta = np.arccos(c2)
    most = np.maximum(*(np.abs(np.arccos(np.clip(c2 + sign * cosine, -1, 1)) - theta) for sign in (-1, 1)))
    return cosine, root, most


def _apart(p: Params, l2: Floats, rho: Floats, off: Floats) -> Floats:
    """What rounding both joints to words makes of an elbow's error `off` at the tip, LSB: see `ik2`. Lengths are those
    of aligned words."""
    half_word = math.asin(2.0 ** (-(p["S"] + 1) / 2))
    most = np.minimum(l2 * off * (1 + off), np.maximum(l2, 2 * rho) * half_word)
    return most * 2.0 ** (p["W"] - form(p).bits)


def _sine(l1: int, l2: int, rho: ArrayLike) -> Floats:
    """|sin theta2| of a tip at `rho`."""
    q, near, far = floats(rho) ** 2, (l1 - l2) ** 2.0, (l1 + l2) ** 2.0
    return np.sqrt(np.maximum((far - q) * (q - near), 0)) / max(2 * l1 * l2, 1)


def ik2(p: Params, l1: int, l2: int, rho: ArrayLike) -> Floats:
    """Tip of rational_ik2 for a target in reach.

    Parameters
    ----------
    p, l1, l2
        Links in LSB.
    rho : float array
        Distance of the target from the shoulder, LSB.

    Notes
    -----
    The core computes an elbow theta2' that is off, and joint 1 of the vector k that goes with it. Both together put
    the tip within e, t being `vector.TANGENT`:

    * The elbow's cosine is off by `_bend`: the arm is longer or shorter by 2 L1 L2 times that, over 2 rho.
    * k is not quite the tip of that elbow: the root is off by 3/4 of `_bend`'s at most in the coordinate that the word
      of joint 2 does not give, times L2, across.
    * The square of joint 1's sine takes the length of k for that of the tip: both, and the root along, over 2 rho,
      times t; and `vector.inverse`, rho t.
    * k1 and k2 have 4 fraction bits about a half: 2^(1/2) / 32, across, and t times that along; likewise the cut of a
      and b to 1/8 LSB^2, and of what is shifted to 2^-25 at q' >= 1/4.

    Below rho^2 = 4 times what the quadrance of k is off, near the shoulder, the direction is lost: the tip is within
    2 rho and the root of it.

    "Beyond the rounding of the words" takes from the cell of each word the angle nearest to the exact one, for each
    joint by itself. With a, b what joints 1 and 2 are off, and s, t in [0, 1] the shares of them that are left, the tip
    is off by s (J1 a + J2 b) + (t - s) J2 b: at most e, and as J1 a = -J2 b within e, |t - s| L2 |b|. So:

    * Near the circles, where b is large, L2 |b| more, and (1 + |b|) for what is not linear. But (1 - t) b is no more
      than one side of a cell, (1 - s) a no more than both sides, and a cell's side is at most
      h = asin 2^(-(S + 1) / 2): never more than max(L2, 2 rho) h.

    With W above 16 the first part is `vector.ik2_coded`.
    """
    l1a, l2a, r = _aligned(p, l1, l2, rho)
    far, t = np.maximum(r, 1e-9), vector.TANGENT
    cosine, root, off = _bend(p, int(l1a), int(l2a), r)
    if form(p).coefficient:
        turned = spread_of_vector(p)
        together = vector.ik2_coded(p, l1, l2, rho, _sine(l1, l2, rho), turned)
        return together + _apart(p, l2a, r, off + turned)
    seen = 2 * l1a * l2a * cosine  # quadrance of the elbow's word
    length = seen + l2a * l2a * root  # and of k
    cut = 2**0.5 * (1 + t) * (1 / 32 + 0.25 / far + 2**-23 * r)
    together = seen / (2 * far) + 0.75 * l2a * root + t * (length / (2 * far) + r * vector.inverse(r * r)) + cut
    together = together * (1 + length / far**2 + 0.05 / far)
    together = np.where(r * r < 4 * length + 4, 2 * r + np.sqrt(length), together)
    return together * 2.0 ** (p["W"] - 16) + _apart(p, l2a, r, off)


def _yaw(p: Params, rho: Floats) -> Floats:
    """Tip error by joint 3 at the distance `rho` from its axis."""
    length, turned = vector.yaw(floats(rho) * 2.0 ** (16 - p["W"]))
    return rho * (vector.TANGENT * length + turned)


def ik3(p: Params, l1: int, l2: int, target: ArrayLike) -> Floats:
    """Tip of rational_ik3 for targets (3, N) in reach: `ik2` in the plane of the arm, rho and the yaw.

    With W up to 16 the gap has no error of rho. Of joint 1 rho is a coordinate (`vector.radius`): it turns (rho, z),
    and stretches it beside k, `vector.TANGENT` times that. With W above 16: `vector.ik3_coded`.
    """
    x, y, z = floats(target)
    rho = np.hypot(x, y)
    if form(p).coefficient:
        length, turned = np.sqrt(rho * rho + z * z), spread_of_vector(p)
        together = vector.ik3_coded(p, l1, l2, target, _sine(l1, l2, length), turned)
        l1a, l2a, r = _aligned(p, l1, l2, length)
        off = _bend(p, int(l1a), int(l2a), r, vector.quadrance_seen(p, target))[2]
        return together + _apart(p, l2a, r, off + turned)
    off = (1 + vector.TANGENT) * vector.radius(p, target)
    return ik2(p, l1, l2, np.sqrt(rho * rho + z * z)) + off + _yaw(p, rho)


NEAREST = 0.6 * 2.0**-16
"""Angle (rad) of the direction of joint 1 of a target out of reach.

2 / sqrt(q'), times `vector.TANGENT`: half of what the tangent loses 3/16 b^2, 0.19 * 2^-16, half a unit of the slope
0.25 * 2^-16 at q' = 1 (not both), its first factor 0.06 * 2^-16; the half unit in place of k2 0.06 * 2^-16; the cut of
what is shifted to 2^-25, sqrt(q') >= 1/2, 0.02 * 2^-16, and of the sum to 1/8, 0.09 * 2^-16 of the shortest target.
"""


def nearest(p: Params, l1: int, l2: int, target: ArrayLike) -> Floats:
    """Tip of rational_ik2 or rational_ik3 from the nearest point, for targets (2 or 3, N) that are flagged unreachable.

    Both elbows are then stretched or folded exactly, and the tip has the radius R = L1 + L2 or |L1 - L2| exactly: the
    direction alone errs, `NEAREST`. In space the plane's point (rho, z) is off by the error d of rho, seen
    from the base at the distance r of the target: an angle asin(d / r), a chord 2 R sin(asin(d / r) / 2). In the hole
    this is the greater the shorter the target is, by R / r. The yaw's own error is that at R. With W above 16:
    `vector.nearest_coded`.
    """
    if form(p).coefficient:
        return vector.nearest_coded(p, l1, l2, target, spread_of_vector(p))
    target = floats(target)
    r = np.sqrt((target * target).sum(axis=0))
    radius = np.where(r > (l1 + l2 + abs(l1 - l2)) / 2, l1 + l2, abs(l1 - l2))
    if len(target) == 2:
        return radius * NEAREST
    turned = np.arcsin(np.minimum(vector.radius(p, target) / np.maximum(r, 1e-9), 1))
    yaw = _yaw(p, np.hypot(target[0], target[1])) * radius / np.maximum(r, 1e-9)
    return radius * NEAREST + 2 * radius * np.sin(turned / 2) + yaw
