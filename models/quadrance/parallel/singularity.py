"""This module finds the type of a singularity and how near a posture is to one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from quadrance.parallel.geometry import Floats, Robot
from quadrance.parallel.motion import jacobians
from quadrance.parallel.position import NEAR, scaled


@dataclass(frozen=True)
class Singularity:
    """Of postures (...).

    inverse : (..., n) type 1, leg by leg: |J_q,i| <= `near` LA, the leg is stretched or folded.
    forward : (...) type 2: the smallest singular value of J_x (lengths / 100 mm) is at most `near`.
    combined : (...) type 3: both at once.
    link : (..., n) |J'_q,i| <= `near` times the link; False without link.
    """

    inverse: np.ndarray
    forward: np.ndarray
    combined: np.ndarray
    link: np.ndarray


def condition(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike = 0.0) -> tuple[Floats, Floats]:
    """(cond, sigma_min) of J_x with lengths in units of 100 mm, six legs."""
    values = np.linalg.svd(scaled(jacobians(robot, rotation, position, beta).platform), compute_uv=False)
    low = values[..., -1]
    return np.divide(values[..., 0], low, out=np.full_like(low, np.inf), where=low > 0), low


def types(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike = 0.0,
          near: float = NEAR) -> Singularity:
    """Which singularities a posture is within `near` of.

    Paper: it states that det J'_q = 0 only where det J_q = 0 and leaves J'_q out for that reason. That is false: the
    rod may be at right angles to u x (A - F), along the link, while the leg is bent.
    """
    found = jacobians(robot, rotation, position, beta)
    inverse = np.abs(found.cranks) <= near * robot.la
    forward = np.linalg.svd(scaled(found.platform), compute_uv=False)[..., -1] <= near
    link = (robot.link > 0) & (np.abs(found.links) <= near * robot.link)
    return Singularity(inverse, forward, inverse.any(axis=-1) & forward, link)
