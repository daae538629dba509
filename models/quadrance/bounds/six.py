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
    return 0.5 + ROUNDED * 2.0 ** -p["U"] * 1.001 * moved + _config(arm) + 20 * 2.0 ** (p["W"] - six.H)


def forward_matrix(p: Params) -> float:
    """A word of the matrix of vector_fk6, in units of 2^-U: half of one, and the lengths of its vectors.

    Column 1 has those of all six joints, column 3 of five; column 2, their cross product, has both.
    """
    return 0.5 + ROUNDED * 1.001 * 11 + 20 * 2.0 ** (p["U"] - six.H)


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


def position(p: Params, arm: Six, rotation: ArrayLike, tip: ArrayLike, back: ArrayLike) -> Floats:
    """Distance of the exact tip of the joints that vector_ik6 answers from the tip asked for, in reach.

    With area units A, p the wrist's centre, x1 its distance forward of axis 1 (x1^2 = px^2 + py^2 - b^2), r its
    distance from axis 2, each of which has its singularity at 0:

    - words: a rounded vector moves the tip by ROUNDED units of its distance from that axis: the tip from axes 1 and 2,
      k + c4 from axis 3, c4 from axes 4 and 5; the orientation moves the flange.
    - x1: its square is off by A, its root by MINUS; that moves the wrist along the direction of p.
    - joint 1: two sums, off by 3/4 A each, of a vector of px^2 + py^2; joint 2: the same, of r^2.
    - gap: off by A, by A when it has been multiplied, and by 1/cfg_r, A at most; it is a change of r^2. The sine of the
      elbow is off by MINUS: that changes r^2 by 2 c2 k MINUS sin^2 cos, at most 0.77 c2 k MINUS, and the direction
      of the forearm's end by MINUS of k.
    """
    rotation, tip = floats(rotation), floats(tip)
    area, unit = 2.0 ** (2 * p["W"] - six.H), 2.0 ** -p["U"]
    px, py, pz = np.moveaxis(tip - arm.c4 * rotation[..., 2], -1, 0)
    plane = px * px + py * py
    x1 = np.sqrt(np.maximum(plane - arm.b**2, 1e-9))
    r = np.maximum(np.hypot(np.where(back, -x1, x1) - arm.a1, pz - arm.c1), 1e-9)
    far, flange = np.hypot(tip[..., 0], tip[..., 1]), abs(arm.c4)
    words = ROUNDED * 1.001 * unit * (far + r + arm.k + 4 * flange) + flange * orientation(p)
    shoulder = np.minimum(area / x1, np.sqrt(area)) + MINUS * x1
    turn1 = far * 0.75 * math.sqrt(2) * area / np.maximum(plane, 1e-9)
    elbow = (3 * area + 0.77 * arm.c2 * arm.k * MINUS) / (2 * r) + MINUS * arm.k
    turn2 = (r + flange) * 0.75 * math.sqrt(2) * area / r**2
    return words + shoulder + turn1 + elbow + turn2 + 2 * _config(arm)
