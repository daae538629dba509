"""Float64 kinematics of six axes: ortho-parallel base with a spherical wrist, forward and all eight inverse branches.

The seven parameters are those of M. Brandstoetter, A. Angerer, M. Hofbaur, "An analytical solution of the inverse
kinematics problem of industrial serial manipulators with an ortho-parallel basis and a spherical wrist" (2014). Angles
are in radians, lengths share one unit; a robot's own zeros and signs are added outside. All functions are vectorised.
"""

from __future__ import annotations

import math
import tomllib
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from quadrance.fixed import ints
from quadrance.truth import Floats, floats

BACK, DOWN, FLIP = 1, 2, 4  # bits of a branch: shoulder, elbow, wrist


class Six(NamedTuple):
    """The seven parameters."""

    a1: float  # shoulder offset, along the upper arm's plane
    a2: float  # elbow offset; above the forearm's axis it is negative
    b: float  # lateral offset of the arm's plane from axis 1
    c1: float  # height of axis 2
    c2: float  # upper arm
    c3: float  # forearm, to the wrist's centre
    c4: float  # from the wrist's centre to the flange

    @property
    def k(self) -> float:
        """Distance from axis 3 to the wrist's centre."""
        return math.hypot(self.a2, self.c3)

    @property
    def psi(self) -> float:
        """Direction of the wrist's centre seen from axis 3 at q2 = q3 = 0, from the vertical."""
        return math.atan2(self.a2, self.c3)


@cache
def library() -> dict[str, dict]:
    """The arm files of the library by name, as they are: a truth does not follow from the checks of `quadrance.arms`.
    """
    files = sorted(Path(__file__).with_name("arms").glob("*.toml"))
    return {path.stem: {"constants": {}, "wrist": {}} | tomllib.loads(path.read_text()) for path in files}


def known() -> list[str]:
    """Names of the arms of the library that have a spherical wrist."""
    return [name for name, arm in library().items() if "flange" in arm["wrist"] and "parallel" not in arm["wrist"]
            and "upper" not in arm["limits"]]


def load(name: str) -> tuple[Six, float]:
    """The seven parameters (mm) of an arm with a spherical wrist, and the millimetres in one coordinate unit."""
    arm = library()[name]
    a1, e, b, c1 = (float(arm["constants"].get(key, 0)) for key in ("shoulder", "elbow", "lateral", "base"))
    return Six(a1, -e, b, c1, arm["links"]["l1"], arm["links"]["l2"], arm["wrist"]["flange"]), arm["mm_per_unit"]


def fk6(q: ArrayLike, arm: Six) -> tuple[Floats, Floats]:
    """Rotation matrix (..., 3, 3) and tip (..., 3) of the joints (..., 6)."""
    c1, c2, c3, c4, c5, c6 = np.moveaxis(np.cos(q), -1, 0)
    s1, s2, s3, s4, s5, s6 = np.moveaxis(np.sin(q), -1, 0)
    c23, s23 = c2 * c3 - s2 * s3, s2 * c3 + c2 * s3
    zero = 0 * c1
    base = np.array([[c1 * c23, -s1, c1 * s23], [s1 * c23, c1, s1 * s23], [-s23, zero, c23]])
    wrist = np.array([[c4 * c5 * c6 - s4 * s6, -c4 * c5 * s6 - s4 * c6, c4 * s5],
                      [s4 * c5 * c6 + c4 * s6, -s4 * c5 * s6 + c4 * c6, s4 * s5], [-s5 * c6, s5 * s6, c5]])
    rotation = np.einsum("ij...,jk...->...ik", base, wrist)
    x1 = arm.a1 + arm.c2 * s2 + arm.a2 * c23 + arm.c3 * s23
    z1 = arm.c1 + arm.c2 * c2 + arm.c3 * c23 - arm.a2 * s23
    centre = np.stack([x1 * c1 - arm.b * s1, x1 * s1 + arm.b * c1, z1], axis=-1)
    return rotation, centre + arm.c4 * rotation[..., 2]


def ik6(rotation: ArrayLike, tip: ArrayLike, arm: Six, branch: ArrayLike) -> tuple[Floats, np.ndarray]:
    """Joints (..., 6) of a pose on one branch, 0 to 7, and whether it is unreachable (the nearest answer is given).

    Bit 0 of the branch: the shoulder looks back; bit 1: sin(q3 + psi) < 0; bit 2: sin q5 < 0. Where the wrist is
    straight q4 is 0 and q6 takes the rest.
    """
    rotation, tip, branch = floats(rotation), floats(tip), ints(branch)
    back, down, flip = (np.where(branch & bit, -1.0, 1.0) for bit in (BACK, DOWN, FLIP))
    px, py, pz = np.moveaxis(tip - arm.c4 * rotation[..., 2], -1, 0)
    square = px * px + py * py - arm.b**2
    x1 = back * np.sqrt(np.maximum(square, 0))
    q1 = np.arctan2(x1 * py - arm.b * px, x1 * px + arm.b * py)
    x, z, k = x1 - arm.a1, pz - arm.c1, arm.k
    q = x * x + z * z
    cosine = (q - arm.c2**2 - k * k) / (2 * arm.c2 * k)
    sine = np.sqrt(np.maximum(((arm.c2 + k) ** 2 - q) * (q - (arm.c2 - k) ** 2), 0)) / (2 * arm.c2 * k)
    elbow = np.arctan2(down * sine, np.clip(cosine, -1, 1))
    k1, k2 = arm.c2 + k * np.cos(elbow), k * np.sin(elbow)
    q2 = np.arctan2(k1 * x - k2 * z, k1 * z + k2 * x)
    q3 = elbow - arm.psi
    c1, s1, c23, s23 = np.cos(q1), np.sin(q1), np.cos(q2 + q3), np.sin(q2 + q3)
    u = c1[..., None] * rotation[..., 0, :] + s1[..., None] * rotation[..., 1, :]
    m1 = c23[..., None] * u - s23[..., None] * rotation[..., 2, :]
    m2 = c1[..., None] * rotation[..., 1, :] - s1[..., None] * rotation[..., 0, :]
    m33 = s23 * u[..., 2] + c23 * rotation[..., 2, 2]
    straight = np.hypot(m1[..., 2], m2[..., 2]) < 1e-12
    q4 = np.where(straight, 0, np.arctan2(flip * m2[..., 2], flip * m1[..., 2]))
    c4, s4 = np.cos(q4), np.sin(q4)
    q5 = np.arctan2(c4 * m1[..., 2] + s4 * m2[..., 2], m33)
    q6 = np.arctan2(c4 * m2[..., 0] - s4 * m1[..., 0], c4 * m2[..., 1] - s4 * m1[..., 1])
    return np.stack([q1, q2, q3, q4, q5, q6], axis=-1), (square < 0) | (np.abs(cosine) > 1)


def turned(a: ArrayLike, b: ArrayLike) -> Floats:
    """Angle (radians) of the rotation between matrices (..., 3, 3): of the nearest rotation, exact for small angles."""
    return 2 * np.arcsin(np.minimum(np.linalg.norm(floats(a) - floats(b), axis=(-2, -1)) / math.sqrt(8), 1))
