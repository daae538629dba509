"""Error bounds of rtl/table."""

from __future__ import annotations

import math

from numpy.typing import ArrayLike

from quadrance import table as model
from quadrance.bounds import codec, vector
from quadrance.kernel_vector_wide import form
from quadrance.truth import Floats, floats

Params = dict[str, int]


def sine(p: Params, joints: int) -> float:
    """Error of a sine or cosine of table_fk1 to table_fk3, by every chord of their table: `codec.sine`."""
    return codec.sine(*model.sizes(p, joints))


def forward(p: Params, joints: int, l1: float, l2: float) -> float:
    """A coordinate of table_fk1, table_fk2 and table_fk3; one joint moves the first link.

    Rounding 1/2 and a root for each link. Two joints: two products, each truncated by up to 2^-GUARD, and a constant
    2^-GUARD. Three: the same of rho, then a root of the yaw and one more product.
    """
    root = sine(p, joints)
    if joints == 1:
        return 0.5 + root * l1
    return 0.5 + (joints - 1) * (root * (l1 + l2) + 2.0 ** -model.GUARD)


def direction(p: Params) -> float:
    """Angle (rad) from a target to the nearest direction that rounds to the word of table_ik1.

    0.42 / 2^14 at A = 18. t = m / M errs by dt, the angle by dt / (1 + t^2):

    * half of what the tangent of 1/M loses at a border, t 2^-17: 2^-18;
    * half a unit of the slope s, 1 to 4: t 2^-16 / s / (1 + t^2), at most 2^-17 / s; the cut of m w to 19 bits,
      2^-19 s: together at most 1.25 * 2^-17, at either end of s;
    * half the sag of a chord of the arc tangent, 0.65 * 2^-18; the cut of its place, 2^-18;
    * rounding of a knot and the cut of the rise, a unit of 2^-(A+2) turn either way.

    With W above 16 that of the arc sine, of a vector within `vector.length`, which is rounded to whole bits.
    """
    if (f := form(p)).bits > 16:
        return float(codec.angle_of_vector(p["A"], vector.length(f), model.fraction(p)))
    return 2.0**-18 * (1 + 2.5 + 0.65 + 1) + 2 * math.pi / 2.0 ** (p["A"] + 2)


def _word(p: Params) -> float:
    """How far (rad) the word of a joint of table_ik2 and table_ik3 is from its vector, whose length is 1."""
    return float(codec.angle_of_vector(p["A"], fraction=model.fraction(p))) + math.pi / 2 ** p["A"]


def ik2(p: Params, l1: int, l2: int, rho: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of table_ik2 at the answered words, for a target in reach: `vector.ik2_coded`, half a word of each joint."""
    return vector.ik2_coded(p, l1, l2, rho, n2, _word(p))


def ik3(p: Params, l1: int, l2: int, target: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of table_ik3 at the answered words, for targets (3, N) in reach: as `ik2`, and joint 3."""
    return vector.ik3_coded(p, l1, l2, target, n2, _word(p))


def ik3r(p: Params, l1: int, l2: int, l3: int, rho: ArrayLike, n2: ArrayLike) -> Floats:
    """Tip of table_ik3r at the answered words, LSB, `rho` the distance of its wrist, in reach.

    `ik2` of a wrist of aligned words; that wrist is rounded, and its link errs by a root. The sum of the joints is
    phi, so the last link errs no more.
    """
    wide, more = p | {"W": form(p).bits}, 1 << form(p).bits - p["W"]
    wrist = math.sqrt(2) * (0.5 + sine(wide, 2) * l3 * more)
    return (ik2(wide, l1 * more, l2 * more, floats(rho) * more, n2) + wrist) / more


def nearest(p: Params, l1: int, l2: int, target: ArrayLike) -> Floats:
    """Tip of table_ik2 and table_ik3 at the answered words from the nearest point of a target out of reach."""
    return vector.nearest_coded(p, l1, l2, target, _word(p))
