"""These error bounds of rtl/arm are built on those of rtl/vector. Lengths and errors are in LSB of a coordinate."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import arm_velocity
from quadrance.bounds import vector
from quadrance.kernel_vector_wide import form
from quadrance.truth import Floats, floats
from quadrance.vector import GUARD

Params = dict[str, int]


def fk3() -> float:
    """A coordinate of arm_fk3 against the vectors as they are given, none longer than 1.

    In units of 2^-GUARD: A and B are each cut twice by less than 1, and A has the complement of e, 1 more: together at
    most sqrt(3^2 + 2^2) across the vector that turns them. rho is cut twice and has the complement of B, x once more
    the same of b. Rounding 1/2. 0.80.
    """
    return 0.5 + (math.sqrt(13) + 3 + 3) / 2**GUARD


def fk3_tip(p: Params, l1: float, l2: float, around: float) -> float:
    """Tip of arm_fk3 from that of the vectors' directions; `around`: offsets of shoulder and plane, together.

    `fk3` in three coordinates; the length of a rounded vector, off by sqrt(1/2) 2^-U at most, of every joint that
    turns a link or an offset.
    """
    return math.sqrt(3) * fk3() + math.sqrt(0.5) * 2.0 ** -p["U"] * (2 * l1 + 3 * l2 + around)


def radius(p: Params, rho: ArrayLike) -> Floats:
    """Error of rho = sqrt(x^2 + y^2 - b^2) in arm_ik3.

    x^2 + y^2 - b^2 is exact. 2/sqrt(q') errs as that of vector_ik3, its product is cut below 2^-21 of it. Without a
    lateral offset rho is that of vector_ik3, half a unit further off where the shoulder's offset takes the place of
    what rounds it. 4 fraction bits, and a half below them that is dropped: 3/32. Of longer words the cut of x^2 + y^2 -
    b^2, shifted by an even number of pairs, is not small beside that.
    """
    f = form(p)
    rho, unit = floats(rho) * 2.0 ** (f.bits - p["W"]), 2.0 ** (p["W"] - f.bits)
    cut = 2.0 ** (f.bits - f.fraction + 2) if f.coefficient and p["LATERAL"] else 0.0
    return (3 / 32 + cut + rho * (vector.yaw(rho, f)[0] + 2.0 ** -(f.bits + 2))) * unit


def _products(p: Params, rho: ArrayLike) -> Floats:
    """What the cut of its products turns the direction of joint 3 by, rad."""
    f = form(p)
    return vector.yaw(floats(rho) * 2.0 ** (f.bits - p["W"]), f)[1] if f.coefficient else floats(2.0**-18)


def turned(p: Params) -> float:
    """How far one turn of joint 2 moves (c2, n2), units of 2^-U: a coordinate is cut twice to a half and rounded by a
    half, 1 at most, and n replaces n + 1 in one of them."""
    return math.hypot(2, 1)


def ik3(p: Params, l1: int, l2: int, rho: ArrayLike, height: ArrayLike, far: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of the words' directions of arm_ik3 for a target in reach.

    Parameters
    ----------
    p, l1, l2
        Links in LSB.
    rho : float arrays
        Distance from the yaw axis in the arm's plane, without its sign.
    height, far : float arrays
        Of the target above and from the shoulder axis in that plane.
    n2 : float array
        |sin| of the elbow.

    Notes
    -----
    `vector_ik2` at either end of the error of rho, with the lengths of its words; that error, once for the arm that
    reaches it and once for the direction of (rho, b); half a unit of the words of joint 3, and its products;
    `turned` for every turn of joint 2. Nearer to the shoulder than 1 LSB and than the error of rho, all of it.
    """
    unit, off, far = 2.0 ** -p["U"], radius(p, rho), floats(far)
    seen = ((2 * far + off) * off) * 4.0 ** (form(p).bits - p["W"]) + 1 / 8
    plane = [vector.ik2(p, l1, l2, np.maximum(far + sign * off, 0), n2, seen) for sign in (-1, 1)]
    length = vector.ik2_length(p, l1, l2, np.maximum(far - off, 0.5), n2, seen) * unit
    words = np.minimum(length, 1) * far + l2 * 1.5 * unit
    yaw = (np.abs(rho) + l1 + l2) * (math.sqrt(0.5) * unit + _products(p, np.abs(rho)))
    return 1.001 * np.maximum(*plane) + words + 2 * off + yaw + (p["ELBOW"] + p["ABSOLUTE"]) * turned(p) * unit * l2


def ik3_nearest(p: Params, l1: int, l2: int, rho: ArrayLike, far: ArrayLike, axis: ArrayLike,
                    n2: ArrayLike) -> Floats:
    """Tip of the words' directions of arm_ik3 from `truth_arm.nearest`, for targets out of reach; as `ik3`.

    `axis` is the distance from the yaw axis. The error of rho turns the direction from the shoulder, and the arm ends
    where its border of reach is, (L1 + L2) / far of the target's distance at most; `VECTOR_NEAREST` and the lengths of
    its words; the direction of (x, y) as `vector_ik3` has it, at the distance of the answer. Where the plane of the arm
    is too far out alone, the arm reaches its own rho: `ik3`.
    """
    off, unit, far = radius(p, rho), 2.0 ** -p["U"], np.maximum(floats(far), 1)
    border = off * np.maximum((l1 + l2) / far, 1) + (vector.NEAREST + 2) * (l1 + l2) * unit
    yaw = (axis + l1 + l2) * (math.sqrt(0.5) * unit + 2.0 ** -form(p).bits)
    turns = (p["ELBOW"] + p["ABSOLUTE"]) * turned(p) * unit * l2
    return np.maximum(border + off + yaw + turns, ik3(p, l1, l2, rho, 0, far, n2))


# Velocity: rates in radians in a unit of time, velocities in LSB in that unit; cuts in units of 2^-GUARD, 1/16 LSB

CUT = 2.0 ** -arm_velocity.GUARD


def _across(s: ArrayLike, w2: ArrayLike) -> Floats:
    """Velocity in the plane: L1 + e and f are cut once, each term of v' once more and where it has a complement
    1 of its factor; two cuts and a complement of the turn by joint 1."""
    s, w2 = np.abs(s), np.abs(w2)
    return np.hypot(s + w2 + 2, 2 * s + 1) + 3


def velocity2(w1: ArrayLike, w2: ArrayLike) -> Floats:
    """A coordinate of arm_velocity2 against the vectors as they are given, none longer than 1; rounding 1/2."""
    return 0.5 + CUT * _across(floats(w1) + w2, w2)


def velocity3(w1: ArrayLike, w2: ArrayLike, w3: ArrayLike) -> Floats:
    """The same of arm_velocity3: rho is cut as v' is, and turned by joint 3 both are cut again."""
    yaw = np.abs(w3) * (math.sqrt(2) + 3) + 1
    return 0.5 + CUT * (np.hypot(_across(floats(w1) + w2, w2), yaw) + 3)


def rates2(p: Params, l1: float, l2: float, s: ArrayLike, speed: ArrayLike) -> Floats:
    """How far the velocity of the answered rates is from that asked for, not singular, rates below saturation.

    Half a unit of s turns link 2, half a unit of w1 link 1. v' is cut twice in both coordinates, with a complement; the
    numerator of s has another; f, e and e s are cut, by s and 1. Lengths of rounded vectors, twice of joint 1.
    """
    words = 0.5 * (l1 + l2) / 2 ** p["V"]
    return words + CUT * (3 * math.sqrt(2) + 2 + 3 * np.abs(s) + 2) + 3 * np.abs(speed) * 2.0 ** -p["U"]


def rates3(p: Params, l1: float, l2: float, s: ArrayLike, w3: ArrayLike, rho: ArrayLike, speed: ArrayLike) -> Floats:
    """The same of arm_rates3: v is turned by joint 3 first; half a unit of w3; rho is cut by 5 and its complement."""
    yaw = 0.5 * np.abs(rho) / 2 ** p["V"] + CUT * (2 + 6 * np.abs(w3)) + 2 * np.abs(speed) * 2.0 ** -p["U"]
    return rates2(p, l1, l2, s, speed) + 3 * math.sqrt(2) * CUT + yaw
