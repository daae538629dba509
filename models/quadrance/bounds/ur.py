"""Error bounds of rtl/ur: tip in LSB of a coordinate, orientation in radians; lengths in LSB.

Directions, area units and the errors of reciprocal roots are those of `bounds.six`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import ur
from quadrance.bounds.six import MINUS, MINUS_TO_2, ROOT, ROUNDED, _area, forward_matrix
from quadrance.product_engine import H
from quadrance.truth import Floats, floats
from quadrance.truth_ur import Ur

__all__ = ["forward_coordinate", "forward_matrix", "orientation", "position"]
Params = dict[str, int]


def _config(arm: Ur) -> float:
    """What the rounding of the lengths moves the tip by: half of 2^-4 LSB for each that is not 0."""
    return sum(2.0 ** -(ur.MORE + 1) for length in arm if length)


def forward_coordinate(p: Params, arm: Ur) -> float:
    """A coordinate of vector_ur_fk: half an LSB; every length is multiplied by the lengths of the vectors that turn it.

    These are none for d1, one for d4, two for l2, three for l3, four for d5, five for d6. Ten words on the way are
    rounded to 2^(W - 25) LSB or have products truncated to an eighth of that.
    """
    moved = abs(arm.d4) + 2 * abs(arm.l2) + 3 * abs(arm.l3) + 4 * abs(arm.d5) + 5 * abs(arm.d6)
    return 0.5 + ROUNDED * 2.0 ** -p["U"] * 1.001 * moved + _config(arm) + 20 * 2.0 ** (p["W"] - H)


def orientation(p: Params, singular: ArrayLike = False) -> Floats:
    """Angle between the matrix words and the exact rotation of the joints that vector_ur_ik answers.

    Six rounded vectors. Seen from the answered joint 1, and turned back by the answered joint 6, the matrix gives joint
    5 by its second row and joints 2 to 4 together by its second column. Each of these has three words half a unit off,
    0.87 units as a norm, and the matrix is off by 1.5 units, which `turned` sees as 1.07. The length of the vector of
    joint 1, off by ROOT, turns that of joints 2 to 4 by half of it; that of joint 6, off by MINUS_TO_2, so turns joint
    5. Where joint 6 is held, less than eight units of two words are neglected.
    """
    unit = 2.0 ** -p["U"]
    roots = (ROOT + MINUS_TO_2) / 2
    return (6 * ROUNDED + 1.07 + math.sqrt(3) + floats(singular) * 8 * math.sqrt(2)) * unit * 1.001 + roots + 2.0**-20


def position(p: Params, arm: Ur, rotation: ArrayLike, tip: ArrayLike, joints: ArrayLike) -> Floats:
    """Distance of the exact tip of the joints that vector_ur_ik answers from the tip asked for, in reach.

    joints : (..., 6) of the exact answer. Joints 1 and 2 are not held.

    With area units A, o the point where axes 5 and 6 meet, rho its distance from axis 1, x1 its part in the arm's
    plane (x1^2 = rho^2 - d4^2), r the distance of axis 4 from axis 2:

    - words: a rounded vector moves the tip by ROUNDED units of its distance from that axis: the tip's from axis 1,
      r and the wrist from axis 2, l3 and the wrist from axis 3, the wrist from axis 4, d6 from axis 5.
    - the orientation moves d5 and d6; joints 2 to 4 come from a vector whose length is off by ROOT + MINUS_TO_2.
    - x1: its square is off by A, its root by MINUS, together e. The answered o lies on the line from axis 1 to the one
      asked for, at a square of the distance that differs by 2 x1 e + e^2.
    - joint 1: two sums, off by 3/4 A each, of a vector of length rho^2.
    - gap: as in `bounds.six.position`. Joint 2: two sums of a vector of length r^2, off by 7/4 A each, since the words
      k1 and k2 are off by half a unit each and multiply u and v, which are at most 1.
    """
    rotation, tip, joints = floats(rotation), floats(tip), floats(joints)
    area, unit = _area(p), 2.0 ** -p["U"]
    px, py, _ = np.moveaxis(tip - arm.d6 * rotation[..., 2], -1, 0)
    rho = np.maximum(np.hypot(px, py), 1e-9)
    x1 = np.sqrt(np.maximum(rho * rho - arm.d4**2, 1e-9))
    r = np.sqrt(np.maximum(arm.l2**2 + arm.l3**2 + 2 * arm.l2 * arm.l3 * np.cos(joints[..., 2]), 1e-9))
    far, wrist = np.hypot(tip[..., 0], tip[..., 1]), abs(arm.d5) + abs(arm.d6)
    words = ROUNDED * 1.001 * unit * (far + r + arm.l3 + 3 * wrist + abs(arm.d6)) + wrist * orientation(p)
    words = words + (ROOT + MINUS_TO_2) * abs(arm.d5)
    error = np.minimum(area / x1, math.sqrt(area)) + MINUS * x1
    shoulder = (x1 * error + error**2 / 2) / rho
    turn1 = far * 0.75 * math.sqrt(2) * area / rho**2
    elbow = (3 * area + 0.77 * arm.l2 * arm.l3 * MINUS) / (2 * r) + MINUS * arm.l3
    turn2 = (r + wrist) * 1.75 * math.sqrt(2) * area / r**2
    return words + shoulder + turn1 + elbow + turn2 + 2 * _config(arm)
