"""Error bounds of rtl/six: tip in LSB of a coordinate, orientation in radians; lengths in LSB.

Directions are those of the vectors, whatever their length; the arm is the exact one, whose lengths the configuration
rounds to 2^-4 LSB. A word has 25 fraction bits and 1.0 of a length is 2^W LSB, so an area (a product of lengths) has
units of 2^(2 W - 25) LSB^2, 128 at W = 16.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import six
from quadrance.product_engine import H
from quadrance.truth import Floats, floats
from quadrance.truth_six import Six

Params = dict[str, int]
# Relative error of the word 1 / (2 sqrt(q)), its argument truncated to 2^-18: over all arguments, by a test
ROOT = 0.7 * 2.0**-16
# The same where the slope's complement, a unit more, makes it negative: arguments below 1, as in roots; up to 2
MINUS, MINUS_TO_2 = 0.9 * 2.0**-16, 2.1 * 2.0**-16
ROUNDED = math.sqrt(0.5)  # both coordinates of a vector rounded to nearest turn or lengthen it by this, in 2^-U


def _config(arm: Six) -> float:
    """What the rounding of the lengths moves the tip by: half of 2^-4 LSB for each that is not 0, two for an elbow."""
    return sum(2.0 ** -(six.MORE + 1) for length in arm if length)


def forward_coordinate(p: Params, arm: Six) -> float:
    """A coordinate of vector_fk6: half an LSB; every length is multiplied by the lengths of the vectors that turn it.

    These are one for a1 and b, two for the upper arm, three for the forearm, five for the flange. Ten words on the way
    are rounded to 2^(W - 25) LSB or have products truncated to an eighth of that.
    """
    moved = abs(arm.a1) + abs(arm.b) + 2 * abs(arm.c2) + 3 * arm.k + 5 * abs(arm.c4)
    return 0.5 + ROUNDED * 2.0 ** -p["U"] * 1.001 * moved + _config(arm) + 20 * 2.0 ** (p["W"] - H)


def forward_matrix(p: Params) -> float:
    """A word of the matrix of vector_fk6, in units of 2^-U: half of one, and the lengths of its vectors.

    Column 1 has those of all six joints, column 3 of five; column 2, their cross product, has both.
    """
    return 0.5 + ROUNDED * 1.001 * 11 + 20 * 2.0 ** (p["U"] - H)


def orientation(p: Params, singular: ArrayLike = False) -> Floats:
    """Angle between the matrix words and the exact rotation of the joints that vector_ik6 answers.

    Six rounded vectors; the matrix words, each half a unit off, 1.5 units as a norm, which `turned` sees as 1.07; the
    lengths of the vectors of joints 1 and 2, off by ROOT each, of (ce, ne), off by MINUS, and of joint 4, off by
    MINUS_TO_2: one that is 1 + e long turns a vector of which it multiplies one coordinate by at most e / 2, and joint
    4's does so twice. A straight wrist neglects (M13, M23) of less than eight units in both coordinates.
    """
    unit = 2.0 ** -p["U"]
    roots = ROOT + MINUS / 2 + MINUS_TO_2
    return (6 * ROUNDED + 1.07 + floats(singular) * 8 * math.sqrt(2)) * unit * 1.001 + roots + 2.0**-20


ZONES = math.sqrt(2.6) * 1.01, math.sqrt(4.5) * 1.01
"""Radii about axes 1 and 2 beyond which joint 1 and joint 2 have a direction, in roots of the area unit A.

A direction is two words of area, and there is none where both are 0 or -1: each is below 1.5 A, the vector below
2.12 A. Its length is the product of the wrist's distance and of the one that the arm makes of it, whose square is off
by 0.875 A at axis 1 (three products and a rounding), by 3.5 A at axis 2 (the gap, 3 A, and the square of the elbow's
sine). So the square of the distance in A, t, has t (t - 0.875) <= 4.5, t <= 2.6, and t (t - 3.5) <= 4.5, t <= 4.5; the
words of the wrist's centre, 2^-9 LSB each, are within the 1 %.
"""


def zone(p: Params, joint: int, x1: ArrayLike) -> Floats:
    """Distance of the wrist's centre from axis 1 or 2 up to which joint 1 or 2 may be held, LSB.

    x1 : its distance forward of axis 1, whose error, where it is short, is one of the distance from axis 2.
    """
    unit = math.sqrt(_area(p))
    return ZONES[joint - 1] * unit + (joint == 2) * _shoulder(p, floats(x1))


def held(p: Params, joint: int) -> float:
    """What a held joint 1 or 2 adds to the distance of the tip, LSB: the wrist may be on the other side of the axis, at
    the distance that the arm makes of its own."""
    t = ZONES[joint - 1] ** 2
    return (math.sqrt(t) + math.sqrt(t + (0.875, 3.5)[joint - 1])) * math.sqrt(_area(p))


def _area(p: Params) -> float:
    return 2.0 ** (2 * p["W"] - H)


def _shoulder(p: Params, x1: Floats) -> Floats:
    """Error of x1: its square is off by A, its root by MINUS."""
    area = _area(p)
    return np.minimum(area / x1, math.sqrt(area)) + MINUS * x1


def _wrist(arm: Six, rotation: Floats, tip: Floats, back: ArrayLike) -> tuple[Floats, ...]:
    """(px, py, x1^2, forward of axis 2, above it) of the wrist's centre."""
    px, py, pz = np.moveaxis(tip - arm.c4 * rotation[..., 2], -1, 0)
    square = px * px + py * py - arm.b**2
    x1 = np.sqrt(np.maximum(square, 0))
    return px, py, square, np.where(back, -x1, x1) - arm.a1, pz - arm.c1


def nearest(arm: Six, rotation: ArrayLike, tip: ArrayLike, back: ArrayLike) -> Floats:
    """(N, 3) the nearest tip in the plane of the arm of one that is out of reach, the matrix kept."""
    rotation, tip = floats(rotation), floats(tip)
    px, py, square, x, z = _wrist(arm, rotation, tip, back)
    x1 = np.where(back, -1, 1) * np.sqrt(np.maximum(square, 0))
    r = np.maximum(np.hypot(x, z), 1e-9)
    share = np.clip(r, abs(arm.c2 - arm.k), arm.c2 + arm.k) / r
    turn = np.arctan2(py, px) - np.arctan2(arm.b, x1)
    forward = arm.a1 + x * share
    centre = np.stack([forward * np.cos(turn) - arm.b * np.sin(turn), forward * np.sin(turn) + arm.b * np.cos(turn),
                       arm.c1 + z * share], axis=-1)
    return centre + arm.c4 * rotation[..., 2]


def beyond(p: Params, arm: Six, rotation: ArrayLike, tip: ArrayLike, back: ArrayLike) -> Floats:
    """Distance of the exact tip of the joints from `nearest`, out of reach of axis 2, at any distance from axis 1.

    The terms of `position` without those of the elbow, which is stretched or folded exactly. The error of x1 turns the
    arm, which is R / r as long as the line to the target. That of joint 1 turns the tip or the wrist's centre.
    """
    rotation, tip = floats(rotation), floats(tip)
    px, py, square, x, z = _wrist(arm, rotation, tip, back)
    area, unit = _area(p), 2.0 ** -p["U"]
    rho, x1 = np.maximum(np.hypot(px, py), 1e-9), np.sqrt(np.maximum(square, 1e-9))
    r = np.maximum(np.hypot(x, z), 1e-9)
    long = np.clip(r, abs(arm.c2 - arm.k), arm.c2 + arm.k)
    there, flange = nearest(arm, rotation, tip, back), abs(arm.c4)
    far = np.hypot(there[..., 0], there[..., 1])
    words = ROUNDED * 1.001 * unit * (far + long + arm.k + 4 * flange) + flange * orientation(p)
    centre = there - arm.c4 * rotation[..., 2]
    around = np.maximum(far, np.hypot(centre[..., 0], centre[..., 1]))
    turn1 = around * 0.75 * math.sqrt(2) * area / (rho * np.maximum(np.hypot(x1, arm.b), 1e-9))
    turn2 = (1 + flange / np.maximum(long, 1e-9)) * 0.75 * math.sqrt(2) * area / r
    return words + _shoulder(p, x1) * (1 + long / r) + turn1 + turn2 + 2 * _config(arm)


def position(p: Params, arm: Six, rotation: ArrayLike, tip: ArrayLike, back: ArrayLike,
             none: ArrayLike = 0) -> Floats:
    """Distance of the exact tip of the joints that vector_ik6 answers from the tip asked for, in reach.

    none : bit 0, bit 1: joint 1, joint 2 has no direction there and is held.

    With area units A, p the wrist's centre, x1 its distance forward of axis 1 (x1^2 = px^2 + py^2 - b^2), r its
    distance from axis 2, each of which has its singularity at 0:

    - words: a rounded vector moves the tip by ROUNDED units of its distance from that axis: the tip from axes 1 and 2,
      k + c4 from axis 3, c4 from axes 4 and 5; the orientation moves the flange.
    - x1: its square is off by A, its root by MINUS; that moves the wrist along the direction of p.
    - joint 1: two sums, off by 3/4 A each, of a vector of px^2 + py^2; that turns the tip or, where the wrist keeps the
      matrix, its centre: whichever is farther from the axis. Joint 2: the same, of r^2.
    - gap: off by A, by A when it has been multiplied, and by 1/cfg_r, A at most; it is a change of r^2. The sine of the
      elbow is off by MINUS: that changes r^2 by 2 c2 k MINUS sin^2 cos, at most 0.77 c2 k MINUS, and the direction
      of the forearm's end by MINUS of k.
    """
    rotation, tip, none = floats(rotation), floats(tip), np.asarray(none)
    area, unit = _area(p), 2.0 ** -p["U"]
    px, py, square, x, z = _wrist(arm, rotation, tip, back)
    plane, x1, r = px * px + py * py, np.sqrt(np.maximum(square, 1e-9)), np.maximum(np.hypot(x, z), 1e-9)
    far, flange = np.hypot(tip[..., 0], tip[..., 1]), abs(arm.c4)
    words = ROUNDED * 1.001 * unit * (far + r + arm.k + 4 * flange) + flange * orientation(p)
    shoulder = _shoulder(p, x1)
    around = np.maximum(far, np.sqrt(plane))
    turn1 = np.where(none & 1 > 0, held(p, 1), around * 0.75 * math.sqrt(2) * area / np.maximum(plane, 1e-9))
    elbow = (3 * area + 0.77 * arm.c2 * arm.k * MINUS) / (2 * r) + MINUS * arm.k
    turn2 = np.where(none & 2 > 0, held(p, 2), (r + flange) * 0.75 * math.sqrt(2) * area / r**2)
    return words + shoulder + turn1 + elbow + turn2 + 2 * _config(arm)


# Velocities; rates in radians in a unit of time, velocities in LSB in that unit, lengths in LSB


def velocity(p: Params, arm: Six, rates: ArrayLike) -> tuple[Floats, Floats]:
    """Coordinate of the velocity and of the turn of vector_velocity6, in LSB of each, for rates (..., 6).

    Half an LSB; 6 words of a turn, 12 of a velocity on the way, each off by 2^-25, where the turn's LSB is 2^-W and the
    velocity's is 2^(V-2W); every rate turned by five vectors at most, a velocity by one more and off by the lengths.
    """
    speed = np.abs(floats(rates)).sum(axis=-1)
    size = abs(arm.a1) + abs(arm.b) + abs(arm.c2) + arm.k + abs(arm.c4)
    longer = ROUNDED * 1.001 * 2.0 ** -p["U"]
    turn = 0.5 + 6 * 2.0 ** (p["W"] - H) + 5 * longer * speed * 2.0 ** p["V"]
    return 0.5 + 12 * 2.0 ** (2 * p["W"] - p["V"] - H) + (6 * longer * size + _config(arm)) * speed, turn


def rates(p: Params, arm: Six, q: ArrayLike, motion: ArrayLike, found: ArrayLike) -> Floats:
    """(..., 6) errors of the rates of vector_rates6, in LSB, where no quotient is limited.

    Parameters
    ----------
    q : joints (..., 6), radians.
    motion : (..., 6) velocity of the tip in LSB, turn in radians.
    found : (..., 6) the exact rates.

    Notes
    -----
    In words, 1.0 a length of 2^W LSB and a rate of 2^(W-V). A sum is off by `unit`, and by as much for its products; a
    vector that is e long turns a word by e of it. Then errors follow the equations of the program: those of the wrist's
    velocity, of its distances from the axes and of the determinant's factors are divided by these, and joints 4 to 6
    have those of joints 1 to 3. A reciprocal is off by ROOT twice. A length is off by half of 2^-4 LSB.
    """
    full, longer, unit = 2.0 ** p["W"], ROUNDED * 1.001 * 2.0 ** -p["U"], 2.0**-H
    slow = 2.0 ** (p["V"] - p["W"])
    q, motion, w = floats(q), floats(motion), np.abs(floats(found)) * slow
    b, c2, k, c4 = (abs(one) / full for one in (arm.b, arm.c2, arm.k, arm.c4))
    short = 2.0 ** -(six.MORE + 1) / full
    fast, turn = np.linalg.norm(motion[..., :3], axis=-1) / full * slow, np.linalg.norm(motion[..., 3:], axis=-1) * slow
    d1 = np.abs(arm.a1 + arm.c2 * np.sin(q[..., 1]) + arm.k * np.sin(q[..., 1] + q[..., 2] + arm.psi)) / full
    d3, d5 = np.abs(arm.k * np.sin(q[..., 2] + arm.psi)) / full, np.abs(np.sin(q[..., 4]))
    wrist = 3 * unit + longer * (fast + 6 * c4 * turn) + 2 * short * turn
    place = 4 * unit + longer * (c2 + 3 * k) + 4 * short
    w1 = (wrist + place * w[..., 0]) / d1 + 2 * ROOT * w[..., 0] + unit
    across = wrist + b * w1 + short * w[..., 0]
    through = fast + c4 * turn + b * w[..., 0]  # of the wrist's centre in the plane of the arm
    det = 2 * unit + longer * c2 * d3 + short * (2 * d3 + 2 * c2)
    w2, w3 = (((across + wrist) * reach + 2 * through * place + 2 * unit + det * one) / (c2 * d3) + 2 * ROOT * one
              + unit for reach, one in ((k, w[..., 1]), (c2 + k, w[..., 2])))
    spin = 2 * unit + longer * turn
    ww, mm = spin + w1, spin + w2 + w3
    large = turn + w[..., :3].sum(axis=-1)
    m13 = ww + spin + unit + 2 * longer * large
    w5 = mm + m13 + unit + longer * large
    w6 = (w5 + longer * w[..., 5]) / d5 + 2 * ROOT * w[..., 5] + unit
    w4 = m13 + w6 + longer * w[..., 5] + unit
    return 0.5 + np.stack([w1, w2, w3, w4, w5, w6], axis=-1) * full
