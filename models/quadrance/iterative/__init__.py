"""This package solves inverse kinematics by iteration in float64, by the recursions of two papers and alternatives.

`gradient` is the quaternion gradient descent theta <- theta + alpha J^T E, `newton` the Newton-Raphson of the planar
arm of three joints. Both stop by rules that the papers lack: tolerance, limit, guard; an answer says how it ended.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import NDArray

from quadrance.truth import Floats


@dataclass(frozen=True)
class Answer:
    """Where an iteration ended.

    theta : (..., n) joints, radians. error : (...) what was compared with the tolerance, at theta.
    iterations : (...) steps taken. converged : (...) error below the tolerance. singular : (...) the guard has acted.
    """

    theta: Floats
    error: Floats
    iterations: NDArray
    converged: NDArray
    singular: NDArray
