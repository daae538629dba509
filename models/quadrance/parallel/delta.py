"""Forward kinematics of a rotary delta in closed form: the tip lies on three spheres about the shifted elbows."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance.parallel.geometry import Floats, PoseError, Robot


def forward(robot: Robot, alpha: ArrayLike, below: bool = True) -> Floats:
    """(..., 3) position of the platform at crank angles (..., 3).

    The platform does not turn, so its joints move with it: P lies LB from every B_i - c_i. Of the two points where the
    spheres meet, `below` takes the lower one, the other is the mirror image in the plane of the centres.

    Raises
    ------
    PoseError
        Where the spheres do not meet (the rods cannot be assembled) or their centres lie in a line.
    """
    if robot.legs != 3:
        raise PoseError(f"delta: needs three legs, {robot.id} has {robot.legs}")
    alpha = np.asarray(alpha, dtype=np.float64)
    if alpha.shape[-1:] != (3,) or not np.all(np.isfinite(alpha)):
        raise PoseError("delta: alpha must be three finite angles")
    first, second, third = np.moveaxis(robot.elbows(alpha) - robot.joint, -2, 0)
    lb = robot.lb
    a, b = second - first, third - first
    x = a / np.linalg.norm(a, axis=-1, keepdims=True)
    i = np.einsum("...i,...i->...", x, b)
    across = b - i[..., None] * x
    j = np.linalg.norm(across, axis=-1)
    if not np.all(j > 1e-9 * lb[0]):
        raise PoseError("delta: the elbows lie in a line")
    y = across / j[..., None]
    d = np.linalg.norm(a, axis=-1)
    px = (lb[0] ** 2 - lb[1] ** 2 + d * d) / (2 * d)
    py = (lb[0] ** 2 - lb[2] ** 2 + i * i + j * j) / (2 * j) - i / j * px
    square = lb[0] ** 2 - px * px - py * py
    if np.any(square < 0):
        raise PoseError("delta: the rods do not meet at these crank angles")
    z = np.cross(x, y)
    z = z * np.where(z[..., 2:] < 0, 1, -1) * (1 if below else -1)
    return first + px[..., None] * x + py[..., None] * y + np.sqrt(square)[..., None] * z
