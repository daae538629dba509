"""Error bounds of rtl/srs: tip in LSB of a coordinate, orientation in radians; lengths in LSB.

Directions, area units and the errors of reciprocal roots are those of `bounds.six`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance import srs
from quadrance.bounds.six import MINUS, MINUS_TO_2, ROOT, ROUNDED, _area
from quadrance.product_engine import H
from quadrance.truth import Floats, floats
from quadrance.truth_srs import Srs

Params = dict[str, int]


def folded(p: Params) -> float:
    """Distance of the wrist's centre from the shoulder from which on the laws hold: eight roots of the area unit.

    Nearer, an arm with equal links is folded within rounding, and the upper arm has no direction.
    """
    return 8 * math.sqrt(_area(p))


def orientation(p: Params, singular: ArrayLike = False) -> Floats:
    """Angle between the matrix words and the exact rotation of the joints that vector_srs_ik answers.

    Seven rounded vectors; the matrix words as in `bounds.six.orientation`; the lengths of the vectors of joints 1 to 5,
    each of which multiplies one coordinate twice. These are products: of the lengths of (ca, na) and (ct, nt) for joint
    1; of (cb, nb), (ce, ne) and (ct, nt) for joint 2; of (cb, nb) once more for joint 3; joints 4 and 5 are a root and
    a unit vector. The swivel's length, half a unit of both its words, is in joints 2 and 3.
    """
    unit = 2.0 ** -p["U"]
    turn, two, three = ROOT + MINUS_TO_2, 2 * ROOT + MINUS_TO_2, 3 * ROOT + MINUS_TO_2
    return (9 * ROUNDED + 1.07 + floats(singular) * 8 * math.sqrt(2)) * unit * 1.001 + turn + two + three \
        + MINUS + MINUS_TO_2 + 2.0**-20


def position(p: Params, arm: Srs, rotation: ArrayLike, tip: ArrayLike, singular: ArrayLike = False) -> Floats:
    """Distance of the exact tip of the joints that vector_srs_ik answers from the tip asked for, in reach.

    With area units A, o the wrist's centre, rho its distance from axis 1, r from the shoulder:

    - words: a rounded vector moves o by ROUNDED units of its distance from that axis: rho, r, l2 and l2 for joints 1 to
      4. The flange has the orientation's error.
    - lengths of vectors: that of (ct, nt) is in one coordinate of the upper arm, that of (cb, nb) in two of three, that
      of (ca, na) in h; each turns the arm by at most half of it, and joint 3 by as much once more. The swivel's length,
      ROUNDED units, turns both by half of it.
    - gap: as in `bounds.six.position`; its square has five products.
    - words on the way: 12 of them are rounded to 2^(W - 25) LSB; joint 1's are divided by rho and turn o by rho, those
      of (k1, k2) by r and turn both links.
    """
    rotation, tip = floats(rotation), floats(tip)
    area, unit, word = _area(p), 2.0 ** -p["U"], 2.0 ** (p["W"] - H)
    px, py, pz = np.moveaxis(tip - arm.l4 * rotation[..., 2], -1, 0)
    rho = np.hypot(px, py)
    r, both = np.maximum(np.hypot(rho, pz - arm.d), 1e-9), arm.l1 + arm.l2
    words = ROUNDED * 1.001 * unit * (rho + r + 2 * arm.l2) + arm.l4 * orientation(p, singular)
    lengths = ((2 * ROOT + MINUS_TO_2) / 2 + ROUNDED * unit / 2) * (r + arm.l2)
    gap = (3.5 * area + 0.77 * arm.l1 * arm.l2 * MINUS) / (2 * r) + MINUS * arm.l2
    config = sum(2.0 ** -(srs.MORE + 1) for length in arm if length)
    return words + lengths + gap + 12 * word * (1 + both / r) + 2 * config
