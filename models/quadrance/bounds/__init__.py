"""This package has the error bounds as functions of the parameters, each with its derivation. Tests show them, pages
and reports quote them.

`p` are the Verilog parameters of a core. Lengths and errors are in LSB of a coordinate, 2^-F units, where nothing else
is said. Errors of forward cores include half an LSB of rounding in each coordinate; errors of inverse cores are at the
tip, the float64 arm at the answered joints, beyond the rounding of the joint words themselves unless they say so.
Where a figure was found by search instead of derived, the docstring says "found".
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import classic, codecs, conversion, cordic, kernel_vector_solve, paper, table, truth, vector
from quadrance.cores import Core
from quadrance.fixed import ints, wrap
from quadrance.truth import Floats, floats

Params = dict[str, int]


# A core at the tip


def tip(core: Core, l1: int, l2: int) -> float:
    """Greatest tip error of a kinematic core, LSB.

    Parameters
    ----------
    core : Core
        Of one to three joints.
    l1, l2 : int
        Link lengths in LSB, together at most 2^(W-2) (64 units of Q7.8); one joint moves the first link.

    Returns
    -------
    float
        Forward: distance of the answered point, rounding included. Inverse: see the module. The inverse cores of two
        and three joints of `rational` and `classic` keep 2 LSB a unit and more from the shoulder and from the stretched
        and the folded arm (found; next to these see `rational_ik2` and `classic_ik`); forward, the coordinate's bound
        is cut at what was found over all links of the tests.
    """
    p, (family, function) = core.params, core.model_name.split(".")
    joints = int(function[-1])
    forward = function.startswith("fk")
    if family == "paper" and joints == 1:
        return math.sqrt(0.5) if forward else 0.0
    if family == "paper":
        return paper_forward(p, joints, l1, l2) if forward else paper_inverse(p, joints, l1, l2)
    if family == "table" and (forward or joints == 1):
        return math.sqrt(joints + (joints == 1)) * table_forward(p, joints, l1, l2) if forward else \
            table_direction(p) * l1
    if family == "vector":
        return vector_tip(p, joints, l1, l2) if forward else 1e-9 * l1 if joints == 1 else 2.0  # ik1: float64 alone
    if joints == 1:
        if forward:
            return 1.0 if family == "rational" else classic_fk1(p, l1)
        return RATIONAL_DIRECTION * l1 if family == "rational" else classic_ik1(p, l1)
    if not forward:
        return 2.0
    axis = min(rational_chain(p, joints, l1, l2), 1.0) if family == "rational" else \
        min(classic_chain(p, joints, l1, l2), {2: 2.0, 3: 2.8}[joints])
    return math.sqrt(joints) * axis


# Codecs and their parts


def vector_to_spread(s: int, u: int, theta: ArrayLike) -> Floats:
    """How far (LSB of 2^-S) the turn-spread of a unit vector rounded to `u` fraction bits is from that of `theta`.

    Half an LSB on both coordinates turns the vector by d <= sqrt(1/2) 2^-u, so sin^2 moves by at most
    |sin 2 theta| d + d^2; the word itself is the nearest, 1/2.
    """
    turn = math.sqrt(0.5) * 2.0**-u / (1 - 2.0**-u)
    return (np.abs(np.sin(2 * floats(theta))) * turn + turn * turn) * 2.0**s + 0.5


def root_product(bits: int = 17) -> float:
    """|sqrt(v) - w slope / 2^(B + 17)| of `root_product` with slopes of B = `bits` bits, v <= 1 with 24 bits.

    Half the sag of the tangent in the middle of a segment, the cut of the offset to 2^-9 of it, and at B = 17 half a
    unit of the slope, 2^-17, times w < 2. The sum is found over all words: 0.515 / 2^15 at B = 17, 0.305 / 2^15 above.
    """
    return (0.52 if bits == 17 else 0.31) / 2**15


def spread_chord(u: int) -> float:
    """Error of cos and sin of a turn-spread as `rational_fk2` reads them (odd integers of 2^-(U+1)), in units of 2^-U.

    Half the spacing of odd words 0.5, half the greatest sag (2^-18.5 of 1), one unit of knot and cut 1/8, the offset's
    cut 0.022 at U = 16. 0.824 at U = 16, 1.023 at U = 17.
    """
    return 0.5 + 2.0 ** (u - 18.5) + 0.125 + 0.022 * 2.0 ** (u - 16)


# Stream codecs


def _chords(knots: ArrayLike, exact: ArrayLike) -> float:
    """Greatest error of a root from chords, in units of the knots, its truncation by less than a unit included.

    `exact` are the values (..., chords, places) of the function at equally spaced places of each chord, ends included.
    """
    knots, place = floats(knots), np.linspace(0, 1, np.shape(exact)[-1])
    error = knots[..., :-1, None] + np.diff(knots)[..., None] * place - exact
    return float(max(error.max(), 1 - error.min()))


PLACES = np.linspace(0, 1, 33)
"""Of a chord, where its error is taken."""


def angle_to_vector(p: Params) -> float:
    """A coordinate, LSB of 2^-U, by every chord of the table.

    Half its sag, (2 pi / 2^T)^2 / 16, either way, 1.5 of that next to +-1; knots to an eighth of an LSB, as the
    truncation. Rounding 1/2.
    """
    k, t = conversion.sizes(p)
    exact = np.sin(2 * np.pi / 2**t * (np.arange(2**t)[:, None] + PLACES)) * 2**k
    return 0.5 + _chords(codecs.sine_knots(k, t, 3) - 4, exact) / 8


def spread_to_vector(p: Params) -> float:
    """A coordinate, LSB of 2^-U: `root_product` with slopes of 20 bits, and rounding 1/2."""
    return 0.5 + root_product(20) * 2 ** p["U"]


def half_tangent_to_vector(p: Params) -> float:
    """A coordinate, LSB of 2^-U, by every chord of both functions, knots and truncation to an eighth of an LSB.

    A negative t is taken 2^-20 nearer to 0, which moves the sine, whose slope is 2 at most. Rounding 1/2.
    """
    k = p["U"] + 3
    exact = np.stack(truth.half_tangent_to_unit((np.arange(256)[:, None] + PLACES) / 256))[:, None] * 2**k
    return 0.5 + (_chords(conversion.half_tangent_knots(k) - 4, exact * [[[[1]], [[-1]]]]) + 2.0 ** (k - 19)) / 8


def _minor() -> Floats:
    """Sines (chords, places) that a unit vector's minor coordinate reaches, and on to the end of a chord."""
    return (np.arange(-187, 187)[:, None] + PLACES) / 256


def _arc(knots: ArrayLike, exact: ArrayLike, slope: float) -> float:
    """LSB of a word of 4 units, whose half is in the knots, as are half of a truncation and of a rounding.

    Rounding 1/2, the chord, and the one's complement of the sine, 2^-20, times `slope`, LSB.
    """
    return 0.5 + _chords(ints(knots)[..., 256 - 187:256 + 188] - 2, exact) / 4 + slope * 2**-20


def vector_to_angle(p: Params) -> float:
    """LSB of 2^-A turn, for the angle whose sine from the nearer axis is the minor coordinate as it is given.

    Half the sag of a chord of the arc sine, 2^-20 sin / cos^3; knots and truncation a unit of 2^-(A+2) either way.
    The angle is that of a rounded unit vector within sqrt(1/2) 2^-U rad, since cos >= 0.687 and half an LSB of one
    coordinate is all that is seen; of a vector of length 1 + e within e tan.
    """
    turn = 2 ** p["A"] / (2 * math.pi)
    return _arc(conversion.arcsine_knots(p["A"] + 2), np.arcsin(_minor()) * 4 * turn, 1.46 * turn)


def vector_to_half_tangent(p: Params) -> float:
    """LSB of 2^-T, for the minor coordinate m as it is given; otherwise as `vector_to_angle`.

    Beside the x axis t = tan(asin(m) / 2), beside the y axis tan(pi / 4 + asin(m) / 2) up to 1, and from -1 on; slopes
    up to 1. Half a sag is 2^-20 times the curvature, up to 1.9.
    """
    half, axis = np.arcsin(_minor()) / 2, np.pi / 4
    beyond = np.where(half < 0, np.tan(half + axis) - 1, np.tan(half - axis) + 1)
    knots = np.stack([conversion.half_tangent_steps(p["T"] + 2, y) for y in (False, True)])
    return _arc(knots, np.stack([np.tan(half), beyond]) * 4 * 2 ** p["T"], 2 ** p["T"])


def unit_to_spread(p: Params) -> float:
    """LSB of 2^-S, for the square of the minor coordinate as it is given: rounding 1/2, and the one's complement of a
    factor, 2^-26, times the other one, 0.727."""
    return 0.5 + 0.727 * 2.0 ** (p["S"] - 26)


def angle_to_spread_turn(p: Params) -> float:
    """How far (rad) the angle whose spread is rounded is from the word of angle_to_spread.

    The sine by every chord, knots and truncation to 2^-18; the angle is off by that over cos 45 degrees.
    """
    exact = np.sin(2 * np.pi / 2048 * (np.arange(-256, 256)[:, None] + PLACES)) * 2**18
    return _chords(conversion.spread_sine_knots(), exact) * 2**-18 * math.sqrt(2)


def angle_to_spread(p: Params, theta: ArrayLike) -> Floats:
    """LSB of 2^-S at the angle of the word.

    `angle_to_spread_turn`, d, moves sin^2 by |sin 2 theta| d + d^2 at most; rounding and a one's complement as in
    `unit_to_spread`.
    """
    turn = angle_to_spread_turn(p)
    return (np.abs(np.sin(2 * floats(theta))) * turn + turn * turn) * 2.0 ** p["S"] + unit_to_spread(p)


def normalised(length: ArrayLike) -> Floats:
    """Length after one Newton step, y (3 - y^2) / 2: of 1 + e, 1 - 3/2 e^2 - 1/2 e^3."""
    y = floats(length)
    return y * (3 - y * y) / 2


def vector_normalise(length: ArrayLike) -> Floats:
    """A coordinate of vector_normalise, LSB of 2^-U, against c (3 - c^2 - n^2) / 2, for a vector of that length.

    Half a unit is put behind c, not behind the product, so rounding is 1/2 + |g - 1| / 2, g = (3 - c^2 - n^2) / 2. Both
    squares are cut to 2^-(U + 3), so g is off by half of that either way, times c.
    """
    y = floats(length)
    return 0.5 + np.abs(1 - y * y) / 4 + y / 16


# vector


def vector_chain(joints: int, length: float = 1.0) -> float:
    """A coordinate of vector_fk2 and vector_fk3 against the vectors as they are given, none longer than `length`.

    In units of 2^-GUARD: A and B are each cut by less than 1, or B's complement is 1 low, together at most sqrt(2)
    across the vector that turns them; its two products are each cut by less than 1. The third joint turns what is off
    so far, and cuts once more. Rounding 1/2. 0.61 and 0.64 for unit vectors.
    """
    cut = 2 + math.sqrt(2) * length
    return 0.5 + (cut if joints == 2 else cut * max(length, 1.0) + 1) / 2**vector.GUARD


def vector_tip(p: Params, joints: int, l1: float, l2: float) -> float:
    """Tip of vector_fk1 to vector_fk3 from that of the vectors' directions.

    `vector_chain`, or 1/2 for one joint, in every coordinate; and the length of a rounded vector, off by sqrt(1/2) 2^-U
    at most, of every joint that turns a link.
    """
    own, length = _vector_parts(p, joints, l1, l2)
    return math.sqrt(max(joints, 2)) * own + length


def vector_coordinate(p: Params, joints: int, l1: float, l2: float) -> float:
    """One coordinate of vector_fk1 to vector_fk3 from that of the vectors' directions."""
    return sum(_vector_parts(p, joints, l1, l2))


def _vector_parts(p: Params, joints: int, l1: float, l2: float) -> tuple[float, float]:
    """What a coordinate errs by itself, and what the lengths of rounded vectors move the tip."""
    off = math.sqrt(0.5) * 2.0 ** -p["U"]
    lengths = {1: l1, 2: l1 + 2 * l2, 3: 2 * l1 + 3 * l2}[joints]
    return 0.5 if joints == 1 else vector_chain(joints, 1 + off), 1.01 * lengths * off


def vector_length() -> float:
    """How far the length of (c1, n1) of vector_ik1 is from 1 before both are rounded; its direction is exact.

    The tangent, balanced: 3 / 16 b^2 at segment b = 2 a + 1; half a unit of its slope; the cut of the root to 2^-18;
    the squares' cut, one unit of 2^-18 in q either way. The greatest sum is 0.95 * 2^-16, at q = 2.
    """
    b = np.arange(257, 2050, 2.0)
    q, slope = b / 2**10, 2.0**32 / b**1.5
    return float(np.max(3 / (16 * b * b) + 0.5 / slope + 2.0**-19 * np.sqrt(q) + 2.0**-19 / q))


# rational: one joint


def rational_fk1(l1: float) -> float:
    """A coordinate: rounding 1/2, the cut of L1 w to 2^-5 times a slope of at most 2, and the root.

    As a distance at most 1 up to L1 = 2^14 (found: 0.95 over all 2^24 spreads there).
    """
    return 0.5 + 1 / 16 + root_product() * l1


RATIONAL_DIRECTION = 0.48 * 2.0**-14
"""Angle (rad) from a target to the nearest direction that rounds to the word of rational_ik1.

s = m^2 r: d theta = (dr / r) t / 2, t = m / M <= 2, q = M^2 (1 + t^2), M >= 1/2. dr / r is the sum of

* sag of the tangent, raised by half of it: 2^-19 / q^2, alone at most 0.08 * 2^-14 rad;
* q, three units of 2^-17 about their middle, and the one's complement of w for -w, half a unit of 2^-16 about the
  quarter that is in the slope: 1.25 * 2^-16 / q, alone 0.31;
* half a unit of the slope: 2^-17 q^2, alone 0.25.

Together at most 0.466 * 2^-14, at M = 1/2, m = 1. The cuts of m w and m slope to 2^-24 turn the direction by at
most 2^-21 each, for beside an axis m is as small as they are.
"""


# rational: two and three joints


def rational_turn(u: int) -> float:
    """Error of a turn, by the length turned: a joint's two roots err like a vector, the wide one without its sag."""
    return math.hypot(spread_chord(u), spread_chord(u) - 0.16 * 2.0 ** (u - 16)) / 2**u


def rational_chain(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of rational_fk2 and rational_fk3.

    Rounding 1/2. The joint that carries the whole length errs twice, as it is turned by both joints: L1 + 2 L2. The
    cuts of A and B, then of two products, are 2^-5 each. The third joint: one root more, two more cuts.
    At L1 + L2 = 2^14 found: 0.85 with two joints, 1.0 with three, and 1.02 as a distance with two.
    """
    bound = 0.5 + rational_turn(p["U"]) * (l1 + 2 * l2) + (2**0.5 + 2) / 32
    return bound if joints == 2 else bound + spread_chord(p["U"]) / 2 ** p["U"] * (l1 + l2) + 2 / 32


def _aligned(p: Params, *lengths: ArrayLike) -> tuple[Floats, ...]:
    """Lengths in LSB of a 16-bit coordinate, in which the inverse cores work."""
    return tuple(floats(length) * 2.0 ** (16 - p["W"]) for length in lengths)


def rational_gap(p: Params, l1: int, l2: int) -> float:
    """Error of the quadrance (LSB^2 of a coordinate) that cos theta2 of rational_ik2 and rational_ik3 stands for.

    That of `vector_gap`, whose front end they share; in space the gap is that of the exact quadrance. 16 at
    L1 = L2 = 2^13.
    """
    return vector_gap(p, l1, l2) / 4.0 ** (16 - p["W"])


def _rational_root(v: ArrayLike) -> Floats:
    """|n2^2 - v| of the root of v = 1 - c2^2 in kernel_solve, in its three ranges: `_vector_root` down to 2^-12.

    Below it h = 2^-19: 1/16 b^2 of twice v; half a unit of the slope, 2^-19 of 2^-10 of it; half a unit of the first
    factor. In the first segment, below 2^-19, the tangent is up to 2^-22 off. c2^2 to 2^-25.
    """
    v = np.maximum(floats(v), 2.0**-40)
    tiny = 2.0**-43 / v + v**1.5 * 2**-7 + 2**-32
    return np.where(v >= 2**-12, _vector_root(v), np.where(v >= 2**-19, tiny, 2.0**-22) + 2**-25)


def _bend(p: Params, l1: int, l2: int, rho: Floats) -> tuple[Floats, Floats, Floats]:
    """Of the elbow that the core computes for a tip in reach at `rho`, all about 16-bit words: error of the cosine, of
    the square of the sine beside it, and of the angle (rad).

    The cosine is off by gap / (2 L1 L2). Joint 2 is c2, or n2 where that is less in magnitude: then the cosine of its
    word is off by root / (2 |c2|), c2^2 >= 1/2, besides, and where it is not, n2 by root / (2 |n2|).
    """
    double = max(2 * l1 * l2, 1e-9)
    off = vector_gap(p, l1, l2) / double
    c2 = np.clip((rho * rho - l1 * l1 - l2 * l2) / double, -1, 1)
    v = 1 - c2 * c2
    root = np.max([_rational_root(np.maximum(v + sign * 2 * off, 0)) for sign in (-1, 0, 1)], axis=0)
    cosine = off + 0.75 * root
    theta = np.arccos(c2)
    most = np.maximum(*(np.abs(np.arccos(np.clip(c2 + sign * cosine, -1, 1)) - theta) for sign in (-1, 1)))
    return cosine, root, most


RATIONAL_TANGENT = 1.14
"""Tangent of a direction from the axis about which kernel_solve gives it: its sine is below 3/4 or its cosine not."""


def rational_ik2(p: Params, l1: int, l2: int, rho: ArrayLike) -> Floats:
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
    the tip within e, t being `RATIONAL_TANGENT`:

    * The elbow's cosine is off by `_bend`: the arm is longer or shorter by 2 L1 L2 times that, over 2 rho.
    * k is not quite the tip of that elbow: the root is off by 3/4 of `_bend`'s at most in the coordinate that the word
      of joint 2 does not give, times L2, across.
    * The square of joint 1's sine takes the length of k for that of the tip: both, and the root along, over 2 rho,
      times t; and `_vector_inverse`, rho t.
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
    """
    (l1a, l2a, r), half_word = _aligned(p, l1, l2, rho), math.asin(2.0 ** (-(p["S"] + 1) / 2))
    far, t = np.maximum(r, 1e-9), RATIONAL_TANGENT
    cosine, root, off = _bend(p | {"W": 16}, int(l1a), int(l2a), r)
    seen = 2 * l1a * l2a * cosine  # quadrance of the elbow's word
    length = seen + l2a * l2a * root  # and of k
    cut = 2**0.5 * (1 + t) * (1 / 32 + 0.25 / far + 2**-23 * r)
    together = seen / (2 * far) + 0.75 * l2a * root + t * (length / (2 * far) + r * _vector_inverse(r * r)) + cut
    together = together * (1 + length / far**2 + 0.05 / far)
    together = np.where(r * r < 4 * length + 4, 2 * r + np.sqrt(length), together)
    apart = np.minimum(l2a * off * (1 + off), np.maximum(l2a, 2 * r) * half_word)
    return (together + apart) * 2.0 ** (p["W"] - 16)


def _rational_yaw(p: Params, rho: Floats) -> Floats:
    """Tip error by joint 3 at the distance `rho` from its axis."""
    length, turned = _vector_yaw(floats(rho) * 2.0 ** (16 - p["W"]))
    return rho * (RATIONAL_TANGENT * length + turned)


def rational_ik3(p: Params, l1: int, l2: int, target: ArrayLike) -> Floats:
    """Tip of rational_ik3 for targets (3, N) in reach: `rational_ik2` in the plane of the arm, rho and the yaw.

    The gap has no error of rho. Of joint 1 rho is a coordinate (`vector_rho`): it turns (rho, z), and stretches it
    beside k, `RATIONAL_TANGENT` times that.
    """
    x, y, z = floats(target)
    rho = np.hypot(x, y)
    off = (1 + RATIONAL_TANGENT) * vector_rho(p, target)
    return rational_ik2(p, l1, l2, np.sqrt(rho * rho + z * z)) + off + _rational_yaw(p, rho)


RATIONAL_NEAREST = 0.6 * 2.0**-16
"""Angle (rad) of the direction of joint 1 of a target out of reach.

2 / sqrt(q'), times `RATIONAL_TANGENT`: half of what the tangent loses 3/16 b^2, 0.19 * 2^-16, half a unit of the slope
0.25 * 2^-16 at q' = 1 (not both), its first factor 0.06 * 2^-16; the half unit in place of k2 0.06 * 2^-16; the cut of
what is shifted to 2^-25, sqrt(q') >= 1/2, 0.02 * 2^-16, and of the sum to 1/8, 0.09 * 2^-16 of the shortest target.
"""


def rational_nearest(p: Params, l1: int, l2: int, target: ArrayLike) -> Floats:
    """Tip of rational_ik2 or rational_ik3 from the nearest point, for targets (2 or 3, N) that are flagged unreachable.

    Both elbows are then stretched or folded exactly, and the tip has the radius R = L1 + L2 or |L1 - L2| exactly: the
    direction alone errs, `RATIONAL_NEAREST`. In space the plane's point (rho, z) is off by the error d of rho, seen
    from the base at the distance r of the target: an angle asin(d / r), a chord 2 R sin(asin(d / r) / 2). In the hole
    this is the greater the shorter the target is, by R / r. The yaw's own error is that at R.
    """
    target = floats(target)
    r = np.sqrt((target * target).sum(axis=0))
    radius = np.where(r > (l1 + l2 + abs(l1 - l2)) / 2, l1 + l2, abs(l1 - l2))
    if len(target) == 2:
        return radius * RATIONAL_NEAREST
    turned = np.arcsin(np.minimum(vector_rho(p, target) / np.maximum(r, 1e-9), 1))
    yaw = _rational_yaw(p, np.hypot(target[0], target[1])) * radius / np.maximum(r, 1e-9)
    return radius * RATIONAL_NEAREST + 2 * radius * np.sin(turned / 2) + yaw


# vector: two and three joints, inverse


def _vector_root(v: ArrayLike) -> Floats:
    """|n2^2 - v| of the root of v = 1 - c2^2 in kernel_vector_solve.

    Twice the relative half of what the tangent loses, 1/16 b^2, b = 2 v / h: h = 2^-9, and 2^-14 below 2^-5; half a
    unit of the slope, 2^-19 of 1/2 sqrt(v), or of 2^-5 of it; half a unit of the first factor; c2^2 to 2^-25. In the
    first segment of all, below 2^-14, the tangent is up to 2^-17 off.
    """
    v = np.maximum(floats(v), 2.0**-40)
    high = 2.0**-23 / v + v**1.5 * 2**-17 + 2**-22
    low = 2.0**-33 / v + v**1.5 * 2**-12 + 2**-27
    return np.where(v >= 2**-5, high, np.where(v >= 2**-14, low, 2.0**-17)) + 2**-25


def _vector_inverse(q: ArrayLike) -> Floats:
    """Relative error of 1/q' in kernel_vector_solve, q' the quadrance times the power of 4 that takes it to [1/4, 1).

    Half of what the tangent loses at a border, 1/2 b^2, b = 2^10 q'; half a unit of the slope; of the first factor;
    the cut of the product.
    """
    q = np.maximum(floats(q), 1)
    q = q / 4.0 ** np.ceil(np.floor(np.log2(q) + 1) / 2)
    return 2**-21 / q**2 + q**2 * 2**-17 + 2**-22 / q + 2**-24


def vector_gap(p: Params, l1: int, l2: int) -> float:
    """Error of the quadrance (LSB^2 of 16-bit words) that c2 of vector_ik2 stands for: the half that rounds the gap,
    twice, the rounding of cfg_r, the cut of c2 to 25 bits. 16 at L1 = L2 = 2^13."""
    words = kernel_vector_solve.config(p, cfg_l1=l1, cfg_l2=l2)
    l1, l2 = (length << 16 - p["W"] for length in (l1, l2))
    half = 2.0 ** (6 - 2 * words["cfg_e"]) if words["cfg_e"] < 4 else 0
    return 2 * half + 2 * l1 * l2 * (1 / words["cfg_r"] + 2**-25)


def _vector_quadrance(p: Params, l1: int, l2: int, n2: ArrayLike, seen: ArrayLike = 0) -> Floats:
    """By how much |k|^2 differs from q: the gap, and the root times L2^2; 16-bit words. `seen` is what q itself may be
    off; it moves n2, and where it is not 0, q has a fraction, whose cut and that of the gap are 5/8 at most."""
    v, seen = floats(n2) ** 2, floats(seen)
    gap = vector_gap(p, l1, l2) + 0.625 * (seen > 0)
    l1, l2 = (length << 16 - p["W"] for length in (l1, l2))
    moved = (gap + seen) / max(l1 * l2, 1)
    root = np.max([_vector_root(v - moved), _vector_root(v), _vector_root(v + moved)], axis=0)
    return gap + l2 * l2 * root


def vector_ik2(p: Params, l1: int, l2: int, rho: ArrayLike, n2: ArrayLike, seen: ArrayLike = 0) -> Floats:
    """Tip of vector_ik2, the products of the answered words, for a target in reach; half a unit of each word included.

    Parameters
    ----------
    p, l1, l2
        Links in LSB.
    rho, n2 : float arrays
        Distance of the target from the shoulder, LSB; |sin theta2|.
    seen : float array
        How far the quadrance that n2 belongs to is from the core's, LSB^2 of 16-bit words: of the rho of vector_ik3.

    Notes
    -----
    The tip is p |k|^2 / q where k, the tip of the arm with joint 1 at 0, is that of which joint 1 was worked out:

    * `_vector_quadrance` / rho: the length of k. Next to the shoulder it is not small beside rho, and below
      rho^2 = 4 times it, joint 1 is no unit vector any more: there the tip is within 4 (rho + its root).
    * k1 and k2 have 4 fraction bits, about a half: 2^(1/2) / 32, twice for the length, once beside the words' k.
    * The words: L2 and rho times 2^(1/2) / 2 of a unit.
    * `_vector_inverse`, the cut of a and b to 1/8 LSB^2, of their shifted words to 2^-25, 1/q' <= 4.
    """
    unit = 2.0 ** (16 - p["W"])  # the core computes with words of 16 bits
    rho, length = floats(rho) * unit, l2 * unit
    wrong = _vector_quadrance(p, l1, l2, n2, seen)
    far = np.maximum(rho, 1e-9)
    word = math.sqrt(0.5) / 2 ** p["U"]
    stretch = 1 + wrong / far**2 + 0.05 / far
    known = wrong / far + 2**0.5 * 3 / 32 + word * (length + rho) + rho * _vector_inverse(rho**2)
    known = stretch * (known + 2**0.5 * (0.25 / far + 2**-23 * rho))
    return np.where(rho**2 < 4 * wrong + 4, 4 * (rho + np.sqrt(wrong) + 1), known) / unit


def vector_ik2_length(p: Params, l1: int, l2: int, rho: ArrayLike, n2: ArrayLike, seen: ArrayLike = 0) -> Floats:
    """| |(c1, n1)| - 1 | of vector_ik2, units of 2^-U, for a target in reach with rho^2 > 4 `_vector_quadrance`.

    |k| / |p|: half the relative error of the quadrance, k's fraction bits; 1/q'; the word.
    """
    rho = floats(rho) * 2.0 ** (16 - p["W"])
    part = _vector_quadrance(p, l1, l2, n2, seen) / (2 * rho**2) + 2**0.5 / 32 / rho + _vector_inverse(rho**2) + 2**-22
    return (part * (1 + part) + 2**0.5 * 0.25 / rho**2) * 2.0 ** p["U"] + math.sqrt(0.5)


VECTOR_NEAREST = 1.3
"""Tip of vector_ik2 from the nearest point of a target out of reach, by L1 + L2 in units of 2^-U.

Rounding of (c1, n1) 0.71; of 2/sqrt(q'): half of what the tangent loses 3/16 b^2, 0.19, half a unit of the slope 0.25
at q' = 1 (not both), its first factor 0.06; the half unit in place of k2 0.06.
"""


def _vector_yaw(rho: ArrayLike) -> tuple[Floats, Floats]:
    """(c3, n3) of vector_ik3 before both are rounded: how far the length is from 1, and the direction off (rad).

    2/sqrt(q'), q' as in `_vector_inverse`: half of what the tangent loses 3/16 b^2, half a unit of the slope and of the
    first factor, the cut of the product. Both: the half unit behind 2^15 and 0, 2^-20; the cut of the products with
    them to 1/8, two a coordinate, and of what is shifted to 2^-24, sqrt(q') >= 1/2.
    """
    rho = np.maximum(floats(rho), 1)
    q = rho * rho / 4.0 ** np.ceil(np.floor(np.log2(rho * rho) + 1) / 2)
    turned = 2**-20 + 2**-22.5 + 2**-16.5 / rho
    return 3 * 2**-24 / q**2 + q**1.5 * 2**-18 + 2**-22 / q + 2**-24 + turned, turned


def vector_rho(p: Params, target: ArrayLike) -> Floats:
    """Error of rho of vector_ik3, LSB: half a unit of its 4 fraction bits, the cut of the two products to 2^-17, c3 and
    n3 to 18 fraction bits about a half, and their length."""
    rho = np.hypot(*floats(target)[:2]) * 2.0 ** (16 - p["W"])
    return (1 / 32 + 2**-16 + rho * (2**0.5 * 2**-19 + _vector_yaw(rho)[0])) * 2.0 ** (p["W"] - 16)


def _vector_seen(p: Params, target: ArrayLike) -> Floats:
    """By how much the error of rho moves the quadrance of vector_ik3, LSB^2 of 16-bit words; its cut to 1/8 LSB^2."""
    off = vector_rho(p, target)
    return (2 * np.hypot(*floats(target)[:2]) + off) * off * 4.0 ** (16 - p["W"]) + 1 / 8


def vector_reach(p: Params, l1: int, l2: int, target: ArrayLike) -> tuple[Floats, Floats]:
    """Quadrance (LSB^2) by which vector_ik2 or vector_ik3 may miss, and by which it may mistake, a target out of reach.

    `vector_gap` on one side of a border only; the error of rho and fractions of q on both.
    """
    gap, scale = vector_gap(p, l1, l2), 4.0 ** (p["W"] - 16)
    seen = _vector_seen(p, target) + 0.625 if len(target) == 3 else 0 * floats(target[0])
    return (gap + seen) * scale, seen * scale


def vector_ik3(p: Params, l1: int, l2: int, target: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of vector_ik3, the products of the answered words, for targets (3, N) in reach.

    `vector_ik2` of (rho, z), either end of the error of rho; that error, for the arm reaches it; and what (c3, n3)
    makes of it: its length once more, half a unit of both words, the direction.
    """
    x, y, z = floats(target)
    rho = np.hypot(x, y)
    off, seen, long = vector_rho(p, target), _vector_seen(p, target), np.hypot(rho, z)
    plane = [vector_ik2(p, l1, l2, np.maximum(long + sign * off, 0), n2, seen) for sign in (-1, 1)]
    yaw = sum(_vector_yaw(rho * 2.0 ** (16 - p["W"]))) + math.sqrt(0.5) * 2.0 ** -p["U"]
    return 1.001 * np.maximum(*plane) + off + rho * yaw


def vector_ik3_length(p: Params, l1: int, l2: int, target: ArrayLike, n2: ArrayLike) -> Floats:
    """| |(c1, n1)| - 1 | and | |(c3, n3)| - 1 | of vector_ik3 together, units of 2^-U; as `vector_ik2_length`."""
    x, y, z = floats(target)
    rho = np.hypot(x, y)
    nearer = np.maximum(np.hypot(rho, z) - vector_rho(p, target), 0.5)
    yaw = _vector_yaw(rho * 2.0 ** (16 - p["W"]))[0] * 2.0 ** p["U"] + math.sqrt(0.5)
    return vector_ik2_length(p, l1, l2, nearer, n2, _vector_seen(p, target)) + yaw


def vector_ik3_nearest(p: Params, l1: int, l2: int, target: ArrayLike) -> Floats:
    """Tip of vector_ik3 from the nearest point of targets (3, N) out of reach.

    `VECTOR_NEAREST`; the yaw as in `vector_ik3`; and (rho, z) seen from the shoulder turned by the error of rho.
    """
    target = floats(target)
    length, rho = np.sqrt((target * target).sum(axis=0)), np.hypot(*target[:2]) * 2.0 ** (16 - p["W"])
    radius = np.where(length > (l1 + l2 + abs(l1 - l2)) / 2, l1 + l2, abs(l1 - l2))
    turned = np.arcsin(np.minimum(vector_rho(p, target) / np.maximum(length, 1e-9), 1))
    yaw = sum(_vector_yaw(rho)) + math.sqrt(0.5) * 2.0 ** -p["U"]
    return VECTOR_NEAREST * (l1 + l2) / 2 ** p["U"] + radius * yaw + 2 * radius * np.sin(turned / 2)


# cordic


def _micro_rotations(p: Params) -> tuple[Floats, Floats, Floats]:
    """`cordic.turn` at every residual angle: angle (rad), what it multiplies with, radix-4 digits that are not 0.

    The second has the shape (rotations + 1, words), complex: the product of all that is still to come before each
    micro-rotation, and after the last.
    """
    rotations, digits = cordic.sizes(p["W"])
    bits, low = p["W"] + 4, max(rotations - 2, 0)
    words = np.arange(-1 << p["A"] - 3, 1 << p["A"] - 3)
    z = (words << p["W"] + 5 - p["A"]) + 2
    steps = []
    for i in range(1, rotations + 1):
        d, cut = np.where(z >= 0, 1, -1), max(i - 3, 0)
        steps.append(1 + 1j * d * 2.0**-i)
        z = wrap(z + ((cordic.angle(i, bits) >> cut ^ -(d > 0).astype(np.int64)) << cut) << 1, bits)
    tangent, rows = np.zeros(words.shape), np.zeros(words.shape)
    for k in range(digits):
        d = np.where(z >= 0, 1, -1)
        size = np.digitize((z ^ -(d < 0).astype(np.int64)) >> bits - 4, [1, 4])
        tangent, rows = tangent + d * size * 2.0 ** -(rotations + 1 + 2 * k), rows + (size > 0)
        term = cordic.angle(9, bits) << (size == 2) >> low ^ -(d > 0).astype(np.int64)
        z = wrap(z + np.where(size > 0, term << low, 0) << 2, bits)
    rest = np.stack([*np.cumprod(steps[::-1], axis=0)[::-1], np.ones(words.shape)]) * (1 + 1j * tangent)
    return 2 * math.pi * words / 2 ** p["A"], rest, rows


def cordic_rotate(p: Params) -> float:
    """A coordinate of cordic_rotate, the greatest over every angle word and every input: 1.55 at every W and A.

    For each word the digits are found, and with them the factor it really multiplies with; its distance from
    exp(j theta), along and across, times a full-scale output is the first part. The second: every shift and every
    minus is between 0 and 1 unit low (a unit is 2^-GUARD LSB), times the rotations that follow it. Rounding is 1/2.
    """
    theta, rest, rows = _micro_rotations(p)
    shifts = [shift for shift, _ in cordic.GAIN_DIGITS if shift < 10 or shift <= p["W"]]
    gain = sum((-1.0) ** minus * 2.0**-shift for shift, minus in cordic.GAIN_DIGITS if shift in shifts)
    sources = [gain * rest[0], *[rest[0]] * (len(shifts) - 1), *rest[1:]]  # complement, inexact digits, steps
    low_x = sum(-0.5 * (1 + 1j) * source for source in sources) - 0.5 * (1 + 1j) * rows  # the mean of all that is low
    spread = sum(0.5 * (np.abs(source.real) + np.abs(source.imag)) for source in sources) + 0.5 * rows
    drift = np.maximum(np.abs(low_x.real + cordic.ROUND - 16), np.abs(low_x.imag + cordic.ROUND - 16))
    off = gain * rest[0] / np.exp(1j * theta) - 1
    linear = 2.0 ** (p["W"] - 1) * (np.abs(off.real) + np.abs(off.imag))
    return float(np.max(0.5 + (spread + drift) / 2**cordic.GUARD + linear))


def cordic_magnitude(p: Params) -> float:
    """Length by cordic_vector; 0.97 LSB at W = 16, 1.13 at every W.

    Rounding 1/2. The constant 1.214509 against the growth of C + 1 micro-rotations, k, less the growth of the residual
    angle 2^-C, which is not made. In units of 2^-5 LSB: C shifts and the mirror are 0 to 1 low, times the constant, and
    the shifts of the constant's digits 1.36 together; 5 units make up for them.
    """
    half = (p["W"] + 1) // 2
    v = 1.0
    for shift, minus in cordic.HORNER:
        v = 1 + (-1) ** minus * v * 2.0**-shift
    k = v / 2 * math.prod(math.sqrt(1 + 4.0**-i) for i in range(half + 1)) - 1
    growth = max(abs(k), abs(k - 2.0 ** -(2 * half + 1))) * math.sqrt(2) * 2 ** (p["W"] - 1)
    low = (half + 1) * v + 1.36
    return 0.5 + growth + max(5, low - 5) / 32


def cordic_angle(p: Params, guard: int, magnitude: bool) -> tuple[float, float]:
    """Angle of a vectoring engine: (LSB of 2^-A turn, LSB times length); the bound at a length is a + b / length.

    Rounding 1/2; the residual atan 2^-last; the constants' rounding; the complements, 1/2 a step, of which 8 units are
    centred; where x stops growing early (no magnitude), what is left to turn times its relative lack. Times 1/length:
    x mirrored 1 unit high or low, y's minus 1/2 unit a step (halved each step), x rounded down 1/2 unit a step (weighed
    with the angle left), the bits the division drops.
    """
    turn = 2 ** p["A"] / (2 * math.pi)
    half = (p["W"] + 1) // 2
    last = half + 8 if magnitude else p["W"]
    unit = 2.0**-cordic.ANGLE_GUARD
    bits = p["A"] + cordic.ANGLE_GUARD
    constants = sum(abs((cordic.angle(i, bits) >> i) + 0.5 - math.atan(2.0**-i) * turn / unit) for i in range(last + 1))
    grows = half if magnitude else (p["W"] + 1) // 3
    early = sum(2.0**-i * 4.0**-i for i in range(grows + 1, last + 1)) * turn
    fixed = 0.5 + 2.0**-last * turn + (constants + abs(8 - (last + 1) / 2)) * unit + early
    dropped = 2.0 ** (half // 2 - half)  # of the division: two words cut at 2^(half / 2) LSB, scaled by 2^half
    return fixed, turn * (2.5 * 2.0**-guard + 2 * dropped / 1.6468)


# classic


def classic_fk1(p: Params, l1: float) -> float:
    """Distance of the tip of classic_fk1, and so a coordinate; at every W and A 1.6 up to L1 = 2^(W-2), 2.01 at most.

    Half an LSB of rounding in both coordinates; for each angle word the relative error of its rotation, of L1, and what
    rounds down off the constant that makes up for its mean, in any direction: the start word, shifts and complements,
    times the micro-rotations that follow.
    """
    theta, rest, rows = _micro_rotations(p)
    mean = -0.5 * (1 + 1j) * (rest.sum(axis=0) + rows)
    spread = math.sqrt(0.5) * (np.abs(rest).sum(axis=0) + rows)
    off = np.abs(rest[0] * math.sqrt(2) * classic.SHRINK / np.exp(1j * theta) - 1)
    units = spread + np.abs(mean + (classic.ROUND - 8) * (1 + 1j))
    return float(math.sqrt(0.5) + np.max(off * l1 + units / 2**classic.GUARD))


def classic_ik1(p: Params, l1: float) -> float:
    """Tip of classic_ik1 on a link of `l1`: the law of `cordic_angle` without its half LSB of rounding to the word."""
    turn = 2 ** p["A"] / (2 * math.pi)
    fixed, slope = cordic_angle(p, classic.AIM_GUARD, False)
    return (fixed - 0.5) / turn * l1 + slope / turn


def _rotation(p: Params, factors: int = 0) -> tuple[float, Floats, float]:
    """Of `cordic.turn` from a start word, over every residual angle: relative error, mean and spread of the rounding.

    A start word, `factors` shifts of it, every micro-rotation and every digit leave x and y 0 to 1 unit low, times what
    still follows: the mean of that (complex, in units) and the most it may be off its mean in any direction.
    """
    theta, rest, rows = _micro_rotations(p)
    sources = rest[[0] * (1 + factors) + list(range(1, len(rest)))]
    mean = -0.5 * (1 + 1j) * (sources.sum(axis=0) + rows)
    spread = math.sqrt(0.5) * float(np.max(np.abs(sources).sum(axis=0) + rows))
    true = np.exp(1j * theta) / (math.sqrt(2) * classic.SHRINK)
    return np.abs(rest[0] / true - 1).max(), mean, spread


def classic_chain(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of classic_fk2 or classic_fk3.

    A half for rounding; the relative errors of the rotations a link goes through; the roundings of all of them, those
    of the first turned by the second, off the mean that the constants take out; a unit for each start word.
    At most 2 (two joints) and 2.9 (three) up to L1 + L2 = 2^(W-2).
    """
    unit, gain = 2.0**-classic.CHAIN_GUARD, 1.1645
    off, mean, spread = _rotation(p)
    centre = mean.mean()
    turned = centre * gain * np.exp(2j * math.pi * np.linspace(-1, 1, mean.size) / 8) + mean
    drift = np.abs(turned + classic.CHAIN_ROUND[0] * (1 + 1j))
    drift = max(np.abs(drift.real).max(), np.abs(drift.imag).max()) + gain * np.abs(mean - centre).max()
    plane = off * (l1 + 2 * l2) + unit * (gain * spread + spread + drift + 4)
    if joints == 2:
        return float(plane + 0.5)
    off, mean, spread = _rotation(p, len(classic.YAW_FACTORS) + 1)
    flat = np.abs(mean + classic.CHAIN_ROUND[1] * (1 + 1j))
    return float(plane + off * (l1 + l2) + unit * (spread + flat.max()) + 0.5)


CORDIC_GAIN = 1.646760
"""What vectoring lengthens a vector by."""


def _classic_pass(p: Params, grows: int) -> tuple[float, float]:
    """Angle of one pass of the solver: (rad, rad LSB), the error being the first + the second / length of the vector.

    The first: residual angle, the constants' rounding, the early end of the growth. The second as of `cordic_angle`.
    """
    turn = 2 ** p["A"] / (2 * math.pi)
    last, half, unit = p["W"] + 1, (p["W"] + 1) // 2, 2.0**-classic.SOLVE_ANGLE_GUARD
    bits = p["A"] + classic.SOLVE_ANGLE_GUARD
    angle = sum(abs((cordic.angle(i, bits) >> i) + 0.5 - math.atan(2.0**-i) * turn / unit) for i in range(last + 1))
    fixed = 2.0**-last + (angle + 1) * unit / turn + sum(8.0**-i for i in range(grows + 1, last + 1))
    return fixed, 2.5 * 2.0**-classic.SOLVE_GUARD + 2 * 2.0 ** (half // 2 - half) / CORDIC_GAIN


def _classic_grows(p: Params, joints: int) -> int:
    return (p["W"] + 1) // 3 + 1 if joints == 2 else (p["W"] + 1) // 2


def classic_elbow(p: Params, joints: int, l1: int, l2: int) -> float:
    """Joint 2 of classic_ik2 or classic_ik3, LSB of its word; links in LSB, neither 0.

    It is 2 h, h the direction of the legs (b, a), whose length is 2 sqrt(L1 L2) LSB whatever the target: a pass on this
    length, the roots' unit each low, sqrt(2) 2^-4 across, and half an LSB. So the word may be this much on the wrong
    side of the stretched or the folded arm, and is on the side of the elbow asked for where it is farther from both.
    At W = A = 16 this is 1.3 for links of 32 units each, 76 for 50 and 40 LSB, 3344 for 1 and 1 (found: 0, 16, 505).
    """
    fixed, slope = _classic_pass(p, _classic_grows(p, joints))
    legs = slope + math.sqrt(2) * 2.0**-classic.SOLVE_GUARD
    return 0.5 + 2 ** p["A"] / (2 * math.pi) * 2 * (fixed + legs / (2 * math.sqrt(l1 * l2)))


def classic_ik(p: Params, joints: int, l1: int, l2: int, r: ArrayLike) -> Floats:
    """Tip of classic_ik2 or classic_ik3 from the nearest point in reach, half an LSB of rounding in each word included.

    Parameters
    ----------
    p, joints, l1, l2
        2 or 3 joints; links in LSB, neither 0.
    r : float array
        Distance of the target, > 0, reachable or not, LSB; the nearest point has the distance R.

    Notes
    -----
    Every pass: residual angle, constants, early end of the growth, and rounding weighed by 1 / length, as in ik1. Half
    an LSB of a word acts at the tip by the distance (j1) and L2 (j2). phi has the length of the target, so that in the
    hole its rounding is magnified by R / r; h has 2 sqrt(L1 L2), d that times R / (L1 + L2) or more: with
    s = (L1 + L2) / (2 sqrt(L1 L2)), which is 64 for links of 1 and 16383 LSB, both are magnified by it. The roots are 1
    unit low, which acts as a rounding does.

    Three joints: the yaw is a pass on rho and a word at no more than R. phi is that of (K rho, K z):

    * K rho is low by a unit of 2^-4 LSB for the mirror and for each of the growing steps, and follows y, whose minuses
      are 4 units at most; K z is low by 1. A point that is off by this over K turns the arm by asin of it over r.
    * x stops growing early: 2/3 4^-grows of rho; K is cut to W + 2 bits. Of what rho and z differ in, half turns.
    """
    r, grows = floats(r), _classic_grows(p, joints)
    turn = 2 ** p["A"] / (2 * math.pi)
    fixed, slope = _classic_pass(p, grows)
    legs = slope + 2.0**-classic.SOLVE_GUARD
    at = np.clip(r, abs(l1 - l2), l1 + l2)
    stretch = (l1 + l2) / (2 * math.sqrt(l1 * l2))
    plane = (0.5 / turn) * (at + l2) + fixed * (3 * at + 2 * l2) + slope * at / r
    plane = plane + legs * (stretch + (at + 2 * l2) / (l1 + l2) * stretch)
    if joints == 2:
        return plane
    yaw = (0.5 / turn + fixed) * at + slope * at / r
    off = math.hypot(grows + 6, 1) * 2.0**-classic.SOLVE_GUARD / CORDIC_GAIN
    lack = 2 / 3 * 4.0**-grows + 2.0 ** -(p["W"] + 2) / CORDIC_GAIN
    return plane + yaw + at * (2 * np.sin(np.arcsin(np.minimum(off / r, 1)) / 2) + lack / 2)


# table


def table_sine(p: Params, joints: int) -> float:
    """Error of a sine or cosine of table_fk1 to table_fk3, by every chord of their table.

    A chord errs by half its sag, (2 pi / 2^T)^2 / 16, either way; next to +-1, where no knot can lie outside the curve,
    by 1.5 of that. Knots are rounded up by less than a unit of 2^-K, and the completed root is truncated by less than
    one. Taken at 33 places of each chord.
    """
    k, t = table.sizes(p, joints)
    knots, place = codecs.sine_knots(k, t), np.linspace(0, 1, 33)[:, None]
    exact = np.sin(2 * np.pi / 2**t * (np.arange(2**t) + place)) * 2**k
    error = knots[:-1] + np.diff(knots) * place - exact
    return float(max(error.max(), 1 - error.min())) / 2**k


def table_forward(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of table_fk1, table_fk2 and table_fk3; one joint moves the first link.

    Rounding 1/2 and a root for each link. Two joints: two products, each truncated by up to 2^-GUARD, and a constant
    2^-GUARD. Three: the same of rho, then a root of the yaw and one more product.
    """
    root = table_sine(p, joints)
    if joints == 1:
        return 0.5 + root * l1
    return 0.5 + (joints - 1) * (root * (l1 + l2) + 2.0 ** -table.GUARD)


def table_direction(p: Params) -> float:
    """Angle (rad) from a target to the nearest direction that rounds to the word of table_ik1.

    0.42 / 2^14 at A = 18. t = m / M errs by dt, the angle by dt / (1 + t^2):

    * half of what the tangent of 1/M loses at a border, t 2^-17: 2^-18;
    * half a unit of the slope s, 1 to 4: t 2^-16 / s / (1 + t^2), at most 2^-17 / s; the cut of m w to 19 bits,
      2^-19 s: together at most 1.25 * 2^-17, at either end of s;
    * half the sag of a chord of the arc tangent, 0.65 * 2^-18; the cut of its place, 2^-18;
    * rounding of a knot and the cut of the rise, a unit of 2^-(A+2) turn either way.
    """
    return 2.0**-18 * (1 + 2.5 + 0.65 + 1) + 2 * math.pi / 2.0 ** (p["A"] + 2)


def angle_of_vector(a: int, length: ArrayLike = 0.0) -> Floats:
    """Angle (rad) by which `codecs.angle_of_vector` is off before rounding to a word, `length` what the vector's length
    is off 1.

    The greatest error of the chords, each taken at 17 places where |m| <= 3/4, half a sag of 2^-18 at most; the last
    bit of m about a half, 2^-21, times the slope 1.52; knot and rise, each truncated by less than a unit of 2^-(a + 3)
    turn: half a unit either way, for their sum is whole. The arc sine takes the length for 1: tan <= 1.14 times it.
    """
    i = np.arange(-192, 192)[:, None]
    knots, place = codecs.arcsine_knots(40), np.linspace(0, 1, 17)
    arc = (knots[i + 256] + (knots[i + 257] - knots[i + 256]) * place) * 2 * math.pi / 2.0**40
    sag = float(np.abs(arc - np.arcsin((i + place) / 256)).max())
    return sag + 1.52 * 2**-21 + math.pi / 2.0 ** (a + 3) + 1.14 * floats(length)


def table_ik2(p: Params, l1: int, l2: int, rho: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of table_ik2 at the answered words, for a target in reach.

    `vector_ik2` without its rounding; the lengths of both vectors, for the words have none; both codecs and half a
    word of both, over the distance and the second link.
    """
    fine = p | {"U": 40}
    unit = 2.0 ** -fine["U"]
    length = vector_ik2_length(fine, l1, l2, rho, n2) * unit
    return vector_ik2(fine, l1, l2, rho, n2) + _coded(p, l2, rho, n2, length)


def _coded(p: Params, l2: int, rho: ArrayLike, n2: ArrayLike, length: Floats) -> Floats:
    """What the lengths of (c1, n1) and (c2, n2), their angles and the rounding of these move the tip."""
    rho, elbow = floats(rho), _vector_root(floats(n2) ** 2) / 2 + 2**-24
    near = np.minimum((1 + 1.14) * length * rho, 4 * (rho + 1))  # next to the shoulder joint 1 moves it no more
    turned = angle_of_vector(p["A"]) + math.pi / 2 ** p["A"]
    return near + turned * (rho + l2) + (1 + 1.14) * elbow * l2


def table_ik3(p: Params, l1: int, l2: int, target: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of table_ik3 at the answered words, for targets (3, N) in reach: as `table_ik2`, and joint 3."""
    fine, rho = p | {"U": 40}, np.hypot(*floats(target)[:2])
    distance = np.sqrt((floats(target) ** 2).sum(axis=0))
    length = vector_ik3_length(fine, l1, l2, target, n2) * 2.0 ** -fine["U"]
    yaw = angle_of_vector(p["A"], _vector_yaw(rho * 2.0 ** (16 - p["W"]))[0]) + math.pi / 2 ** p["A"]
    return vector_ik3(fine, l1, l2, target, n2) + _coded(p, l2, distance, n2, length) + yaw * rho


def table_ik3r(p: Params, l1: int, l2: int, l3: int, rho: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of table_ik3r at the answered words, LSB, `rho` the distance of its wrist, in reach.

    `table_ik2` of a wrist of 16 bits; that wrist is rounded, and its link errs by a root. The sum of the joints is
    phi, so the last link errs no more.
    """
    wide, more = p | {"W": 16}, 1 << 16 - p["W"]
    wrist = math.sqrt(2) * (0.5 + table_sine(wide, 2) * l3 * more)
    return (table_ik2(wide, l1 * more, l2 * more, floats(rho) * more, n2) + wrist) / more


def table_nearest(p: Params, l1: int, l2: int, target: ArrayLike) -> Floats:
    """Tip of table_ik2 and table_ik3 at the answered words from the nearest point of a target out of reach.

    `VECTOR_NEAREST`, whose lengths, two words of 2^-16, turn a joint once more; codec and half a word of each joint.
    """
    joints, reach = len(target), l1 + l2
    turned = angle_of_vector(p["A"]) + math.pi / 2 ** p["A"]
    words = (2 * reach / 2**16 + turned * reach) * joints
    if joints == 2:
        return VECTOR_NEAREST * reach / 2**16 + words + 0 * floats(target[0])
    return vector_ik3_nearest(p | {"U": 16}, l1, l2, target) + words


# paper


def paper_reach(p: Params) -> float:
    """Distance of the tip of paper_fk2 and paper_fk3 where it is near 2^I units, LSB, by which overflow is told.

    b is truncated by 2^(I-N) units and the sign of its term is a one's complement, half of that; Q2 and acc^2 and the
    two products by 2^-G each, of a quadrance: over twice the distance.
    """
    i = p["W"] - 1 - p["F"]
    n = max(p["S"] + 1, p["W"] - 1)
    g = min(p["S"], 27 - 2 * i, 2 * (n + 1 - i))
    return 2.0 ** p["F"] * (1.5 * 2.0 ** (i - n) + 4 * 2.0**-g / 2 ** (i + 1))


def paper_forward(p: Params, joints: int, l1: float, l2: float) -> float:
    """Tip of paper_fk2 and paper_fk3, as a distance; shown at S = 8 and 24 of Q7.8.

    A spread that is off by e is an angle off by at most asin sqrt(e) (sin(a-b) sin(a+b) = e, and sin(a+b) >= sin(a-b)).
    s' is truncated by 2^-D; the complement 1 - s' by 2^-Q; d by less than 2^-N, so d^2 with its own truncation by
    3 * 2^-N. The quadrances Q2, acc^2 and (three joints) qa are each truncated by 2^-G, which moves a side by at most
    2^(-G/2) units; b is truncated by 2^(I-N) units. sqrt(n) for the coordinates' own truncation.
    """
    i = p["W"] - 1 - p["F"]
    n = max(p["S"] + 1, p["W"] - 1)
    g = min(p["S"], 27 - 2 * i, 2 * (n + 1 - i))
    d, q = paper.DIGITS * -(-(p["S"] + 1) // paper.DIGITS), 2 * i + g
    share = 2.0 ** (-d / 2) + math.sqrt(3 * 2.0**-n) + 2.0 ** (-q / 2)
    units = (joints + 1) * 2.0 ** (-g / 2) + 2.0 ** (i - n)
    return (l1 + l2) * share + 2.0 ** p["F"] * units + math.sqrt(joints)


def paper_share(p: Params) -> int:
    """Digits D of a share (a quotient) in paper_ik2 and paper_ik3."""
    return p["R"] * -(-(p["S"] + 3) // p["R"])


def _turned(spread: ArrayLike) -> Floats:
    """How far a spread that is off by `spread` moves the end of a unit length: the chord of asin sqrt(spread)."""
    return 2 * np.sin(np.arcsin(np.sqrt(np.minimum(spread, 1))) / 2)


def _paper_words(p: Params) -> tuple[int, int, int, int, float]:
    """D, N, the digits of a base angle's spread and of a tip's, and u, LSB, by which a quadrance moves a side."""
    i, d = p["W"] - 1 - p["F"], paper_share(p)
    g = min(p["S"], 2 * p["F"])
    unit = 0.0 if g == 2 * p["F"] else 2.0 ** (p["F"] - g / 2)
    return d, min(d, 26), min(2 * i + g, 27), max(d, p["W"]), unit


def paper_inverse(p: Params, joints: int, l1: float, l2: float) -> float:
    """Tip of paper_ik2 and paper_ik3 for a target in reach whose direction is defined, LSB; any W, F, S, R.

    By the rule of `paper_forward`, r = L1 + L2:

    * sa and s' are truncated by 2^-D, at the distance of the target: 2 r 2^(-D/2).
    * cos theta2 is truncated by 2^-D, or by 2^-26 where D is 27, so s2 by 2^(1-N); the square of it by 2^-right more.
      Either turns joint 2 and, as s' = s2 Q2 / q3, beta at the distance sqrt(q3): L2 each.
    * d is the difference of two roots, each cut by less than 2^-N; d^2 is off by 2^(1-N) (1 + 2^-N): r.
    * Q2 is cut to one DSP factor of `left` bits, 4^I 2^-left, and its product with s2 by 2^-G: over q3 and at sqrt(q3)
      the root of their sum. (The chord of a spread e of 1 is sqrt(2 e): the factor for a target no longer than that.)
    * Where G < 2F every quadrance is cut by u^2. A target of n coordinates is seen off by sqrt(n) u, which turns sa,
      and as much by q3 below s'; c and 2 L1 L2 are off by (n + 1) u^2 together, so s2 by that over L1 L2, which turns
      joint 2 and beta at L2; and which side of 90 degrees beta is on is known to (n + 1) u^2 / L1 across. No tip is
      farther off than 2 r.
    * Three joints: the yaw is a share too, r 2^(-D/2), of two coordinates, sqrt(2) sqrt(2) u.
    """
    i = p["W"] - 1 - p["F"]
    d, n, left, right, u = _paper_words(p)
    reach, lost = l1 + l2, 2.0 ** (1 - n)
    spreads = reach * (2 * _turned(2.0**-d) + _turned(lost * (1 + 2.0**-n))) \
        + l2 * (_turned(lost) + _turned(lost + 2.0**-right))
    sides = 2.0 ** p["F"] * math.sqrt(2 * (4.0**i * 2.0**-left + 2.0 ** -min(p["S"], 2 * p["F"])))
    if u and l1:
        sides += 2 * u * (math.sqrt(2 * joints) + math.sqrt(2 * (joints + 1) * l2 / l1)) + (joints + 1) * u * u / l1
    if joints == 3:
        spreads, sides = spreads + reach * _turned(2.0**-d), sides + 2 * u
    return 2 * reach if u and not l1 else min(float(spreads + sides), 2 * reach)


def paper_nearest(p: Params, joints: int, r: ArrayLike) -> Floats:
    """Angle (rad) of joint 1 from the nearest point's, of a target out of reach at distance r (LSB).

    s' is 0, or its complement, off by 2^-left; sa is off by 2^-D and d^2 by 2^(1-N), as in `paper_inverse`; and where
    G < 2F the target is seen off by sqrt(n) u, which turns it by asin of that over r.
    """
    d, n, left, _, u = _paper_words(p)
    shares = sum(math.asin(math.sqrt(spread)) for spread in (2.0**-d, 2.0**-left, 2.0 ** (1 - n) * (1 + 2.0**-n)))
    return shares + np.arcsin(np.minimum(math.sqrt(joints) * u / np.maximum(r, 1e-9), 1))
