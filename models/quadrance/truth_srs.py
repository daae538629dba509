"""Float64 kinematics of seven axes with a spherical shoulder and wrist: forward, and the swivel of the elbow.

Joints are those of the Denavit-Hartenberg table with twists of -90, 90, 90, -90, -90, 90, 0 degrees and the distances
d, 0, l1, 0, l2, 0, l4 along the axes; nothing is offset. Angles are in radians, lengths share one unit. Source:
M. Shimizu et al., "Analytical inverse kinematic computation for 7-DOF redundant manipulators with joint limits" (2008).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from quadrance.truth import Floats, floats
from quadrance.truth_six import library

TWISTS = (-90, 90, 90, -90, -90, 90, 0)


class Srs(NamedTuple):
    """The four lengths."""

    d: float   # height of the shoulder
    l1: float  # upper arm
    l2: float  # forearm
    l4: float  # from the wrist's centre to the flange


def known() -> list[str]:
    """Names of the arms of the library that have seven axes."""
    return [name for name, arm in library().items() if "upper" in arm["limits"]]


def load(name: str) -> tuple[Srs, float]:
    """The four lengths (mm) of an arm, and the millimetres in one coordinate unit."""
    arm = library()[name]
    return Srs(arm["constants"].get("base", 0.0), arm["links"]["l1"], arm["links"]["l2"], arm["wrist"]["flange"]), \
        arm["mm_per_unit"]


def frames(q: ArrayLike, arm: Srs) -> list[Floats]:
    """Frames (..., 4, 4) behind each of the joints (..., 7)."""
    q = floats(q)
    frame, found = np.eye(4), []
    for i, (d, twist) in enumerate(zip((arm.d, 0, arm.l1, 0, arm.l2, 0, arm.l4), TWISTS)):
        c, s, cos, sin = np.cos(q[..., i]), np.sin(q[..., i]), round(np.cos(np.radians(twist))), twist / 90
        zero = 0 * c
        rows = ((c, -s * cos, s * sin, zero), (s, c * cos, -c * sin, zero), (zero, zero + sin, zero + cos, zero + d),
                (zero, zero, zero, zero + 1))
        frame = frame @ np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
        found.append(frame)
    return found


def fk(q: ArrayLike, arm: Srs) -> tuple[Floats, Floats]:
    """Rotation matrix (..., 3, 3) and tip (..., 3) of the joints (..., 7)."""
    last = frames(q, arm)[-1]
    return last[..., :3, :3], last[..., :3, 3]


def swivel(q: ArrayLike, arm: Srs) -> Floats:
    """The swivel that vector_srs_ik wants for these joints, radians; not where the centre of the wrist is on axis 1.

    It turns the elbow, right-handed about the line from the shoulder to the wrist's centre, from straight above that
    line where sin q4 < 0, and from straight below it where sin q4 > 0.
    """
    q = floats(q)
    every = frames(q, arm)
    elbow, line = (every[i][..., :3, 3] - np.array([0, 0, arm.d]) for i in (2, 4))
    line = line / np.linalg.norm(line, axis=-1, keepdims=True)
    left = np.cross([0.0, 0.0, 1.0], line)
    left = left / np.linalg.norm(left, axis=-1, keepdims=True)
    side = np.where(np.sin(q[..., 3]) > 0, -1, 1)
    return np.arctan2(-side * (elbow * left).sum(axis=-1), side * (elbow * np.cross(line, left)).sum(axis=-1))
