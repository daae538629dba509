"""Float64 kinematics of six axes of which 2, 3 and 4 are parallel: forward, and all eight inverse branches.

Joints are those of the makers' Denavit-Hartenberg tables with twists of 90, 0, 0, 90, -90, 0 degrees; a2 and a3 are
negative there, and the links here are l2 = -a2 and l3 = -a3. Angles are in radians, lengths share one unit. The inverse
is that of K. P. Hawkins, "Analytic inverse kinematics for the Universal Robots UR-5/UR-10 arms" (2013). All functions
are vectorised.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from quadrance.fixed import ints
from quadrance.truth import Floats, floats
from quadrance.truth_six import library

BACK, DOWN, FLIP = 1, 2, 4  # bits of a branch: shoulder, elbow, wrist
STRAIGHT = 1e-12  # sine of joint 5 below which joint 6 is 0


class Ur(NamedTuple):
    """The six lengths."""

    d1: float  # height of axis 2
    d4: float  # of the arm's plane beside axis 1
    d5: float  # from axis 4 to axis 6
    d6: float  # from axis 5 to the flange
    l2: float  # upper arm
    l3: float  # forearm


def known() -> list[str]:
    """Names of the arms of the library whose axes 2, 3 and 4 are parallel."""
    return [name for name, arm in library().items() if "parallel" in arm["wrist"]]


def load(name: str) -> tuple[Ur, float]:
    """The six lengths (mm) of an arm, and the millimetres in one coordinate unit."""
    arm = library()[name]
    base, lateral = (arm["constants"].get(key, 0.0) for key in ("base", "lateral"))
    return Ur(base, lateral, arm["wrist"]["offset"], arm["wrist"]["flange"], arm["links"]["l1"], arm["links"]["l2"]), \
        arm["mm_per_unit"]


def _turned(axis: str, angle: Floats) -> Floats:
    """Rotations (..., 3, 3) about x or z."""
    c, s = np.cos(angle), np.sin(angle)
    zero, one = 0 * c, 0 * c + 1
    rows = ((one, zero, zero), (zero, c, -s), (zero, s, c)) if axis == "x" else ((c, -s, zero), (s, c, zero),
                                                                                  (zero, zero, one))
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def fk(q: ArrayLike, arm: Ur) -> tuple[Floats, Floats]:
    """Rotation matrix (..., 3, 3) and tip (..., 3) of the joints (..., 6)."""
    q = floats(q)
    rotation, tip = np.broadcast_to(np.eye(3), (*q.shape[:-1], 3, 3)), np.zeros((*q.shape[:-1], 3))
    for i, (a, d, twist) in enumerate(((0, arm.d1, 1), (-arm.l2, 0, 0), (-arm.l3, 0, 0), (0, arm.d4, 1),
                                       (0, arm.d5, -1), (0, arm.d6, 0))):
        rotation = rotation @ _turned("z", q[..., i])
        tip = tip + rotation @ np.array([a, 0, d])
        rotation = rotation @ _turned("x", floats(twist * np.pi / 2))
    return rotation, tip


def ik(rotation: ArrayLike, tip: ArrayLike, arm: Ur, branch: ArrayLike) -> tuple[Floats, np.ndarray]:
    """Joints (..., 6) of a pose on one branch, 0 to 7, and whether it is unreachable (the nearest answer is given).

    Bit 0 of the branch: the shoulder looks back; bit 1: sin q3 < 0; bit 2: sin q5 < 0.
    """
    rotation, tip, branch = floats(rotation), floats(tip), ints(branch)
    back, down, flip = (np.where(branch & bit, -1.0, 1.0) for bit in (BACK, DOWN, FLIP))
    px, py, pz = np.moveaxis(tip - arm.d6 * rotation[..., 2], -1, 0)
    square = px * px + py * py - arm.d4**2
    ahead = back * np.sqrt(np.maximum(square, 0))
    q1 = np.arctan2(py, px) + np.arctan2(arm.d4, ahead)
    seen = np.swapaxes(_turned("z", q1) @ _turned("x", floats(np.pi / 2)), -1, -2) @ rotation  # z is along axis 2
    straight = np.hypot(seen[..., 2, 0], seen[..., 2, 1]) < STRAIGHT
    q6 = np.where(straight, 0, np.arctan2(-flip * seen[..., 2, 1], flip * seen[..., 2, 0]))
    q5 = np.arctan2(flip * np.hypot(seen[..., 2, 0], seen[..., 2, 1]), seen[..., 2, 2])
    wrist = _turned("x", floats(np.pi / 2)) @ _turned("z", q5) @ _turned("x", floats(-np.pi / 2)) @ _turned("z", q6)
    rest = seen @ np.swapaxes(wrist, -1, -2)
    q234 = np.arctan2(rest[..., 1, 0], rest[..., 0, 0])
    x, y = -(ahead - arm.d5 * np.sin(q234)), -(pz - arm.d1 + arm.d5 * np.cos(q234))  # both links, turned round
    cosine = (x * x + y * y - arm.l2**2 - arm.l3**2) / (2 * arm.l2 * arm.l3)
    q3 = down * np.arccos(np.clip(cosine, -1, 1))
    q2 = np.arctan2(y, x) - np.arctan2(arm.l3 * np.sin(q3), arm.l2 + arm.l3 * np.cos(q3))
    return np.stack([q1, q2, q3, q234 - q2 - q3, q5, q6], axis=-1), (square < 0) | (np.abs(cosine) > 1)
