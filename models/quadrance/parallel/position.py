"""This module solves positions: the inverse in closed form, the forward problem by Newton."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from quadrance.parallel.geometry import Floats, PoseError, Robot, check_pose

UNIT = 100.0  # mm: lengths in J_x are measured in it, so that turns and shifts weigh alike
NEAR = 1e-6  # a smallest singular value of J_x, or a J_q in cranks, that counts as 0


@dataclass(frozen=True)
class Inverse:
    """Answer of `inverse`; arrays (..., n), n legs.

    alpha : crank angles on the robot's branch, radians in (-pi, pi]; of an unreachable leg that of its nearest point.
    cosine, sine : their unit vectors.
    root : S / 2 in mm, 0 and more: half the paper's root; |J_q| = LA S / 2 LB. It is 0 where the leg is stretched.
    reachable : whether the leg reaches its ball joint.
    """

    alpha: Floats
    cosine: Floats
    sine: Floats
    root: Floats
    reachable: np.ndarray


def inverse(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike = 0.0,
            branch: ArrayLike | None = None) -> Inverse:
    """Crank angles at a pose.

    Parameters
    ----------
    rotation, position : (..., 3, 3), (..., 3)
    beta : (...), angle of the reconfiguration links, radians.
    branch : (..., n) of +1 and -1, the robot's own where nothing is said.

    Notes
    -----
    One root and one division a leg, no half-angle tangent and so no singular angle: with (e, f) = d = C - A in the
    plane of the crank, ``G = (|d|^2 + LA^2 - LB^2) / 2 LA``, ``S = sqrt(e^2 + f^2 - G^2)``,
    ``(cos, sin) = (e G - f S, f G + e S) / (e^2 + f^2)`` on the branch '+'. A leg out of reach, too far or too near,
    is one with e^2 + f^2 < G^2; S = 0 and a G of that length give the crank that comes nearest.

    Paper: (15) prints 4(D - 2 C_y)^2, the correct form is 4(D - C_y)^2; (17) prints cos twice, the second is a sine.
    As printed the rod's length is missed by up to 332 mm and 106 mm.
    """
    rotation, position = check_pose(rotation, position)
    beta = np.asarray(beta, dtype=np.float64)
    if not np.all(np.isfinite(beta)):
        raise PoseError("beta: a number is not finite")
    d = robot.joints(rotation, position) - robot.shoulders(beta)
    e, f = np.einsum("...ni,ni->...n", d, robot.radial), d @ robot.up
    square = e * e + f * f
    wanted = (np.einsum("...ni,...ni->...n", d, d) + robot.la**2 - robot.lb**2) / (2 * robot.la)
    gap = square - wanted * wanted
    reachable = gap >= 0
    length = np.sqrt(square)
    g = np.where(reachable, wanted, np.copysign(length, wanted))
    root = np.sqrt(np.maximum(gap, 0))
    s = root * (robot.branch if branch is None else np.asarray(branch, dtype=np.float64))
    safe = np.where(square > 0, square, 1)
    cosine = np.where(square > 0, (e * g - f * s) / safe, 1.0)
    sine = np.where(square > 0, (f * g + e * s) / safe, 0.0)
    return Inverse(np.arctan2(sine, cosine), cosine, sine, root, reachable & (square > 0))


def rods(robot: Robot, rotation: ArrayLike, position: ArrayLike, alpha: ArrayLike, beta: ArrayLike = 0.0) -> Floats:
    """(..., n) |C - B| - LB in mm: how far the rods are from fitting."""
    d = robot.joints(rotation, position) - robot.elbows(alpha, beta)
    return np.linalg.norm(d, axis=-1) - robot.lb


def all_branches(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: float = 0.0) -> tuple[Floats, Floats]:
    """((2^n, n) branches, (2^n, n) crank angles): every posture of the legs at one pose."""
    signs = 1 - 2 * (np.arange(2**robot.legs)[:, None] >> np.arange(robot.legs) & 1)
    found = inverse(robot, rotation, position, beta, signs)
    if not np.all(found.reachable):
        raise PoseError(f"pose: leg {1 + int(np.argmin(found.reachable))} does not reach it")
    return signs.astype(np.float64), found.alpha


# Forward


@dataclass(frozen=True)
class Forward:
    """Answer of `forward`: a pose, how many steps it took, the greatest misfit of a rod (mm), the legs' branches."""

    rotation: Floats
    position: Floats
    steps: int
    misfit: float
    branch: Floats


def _turned(rotation: Floats, turn: Floats) -> Floats:
    """`rotation` turned by the vector `turn` (Rodrigues), exactly a rotation again."""
    angle = float(np.linalg.norm(turn))
    if angle == 0:
        return rotation
    x, y, z = turn / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return (np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross) @ rotation


def forward(robot: Robot, alpha: ArrayLike, beta: float, rotation: ArrayLike, position: ArrayLike,
            steps: int = 30, tolerance: float = 1e-9, same_branch: bool = True) -> Forward:
    """Pose at crank angles, from a start nearby: Newton in six variables, a turn and a shift of the platform.

    Parameters
    ----------
    alpha : (6,); beta : radians; rotation, position : the start, as a rule the last pose (warm start).
    tolerance : greatest misfit of a rod, mm.
    same_branch : whether an assembly on other branches than the robot's is refused.

    Notes
    -----
    Row i of the Jacobian of |d|^2, d = C - B, is 2 [(R c x d), d]. From 2 degrees and 5 mm away about nine starts in
    ten succeed, from the home pose two in three: start from the last pose.

    Paper: with (4) the equations (6) of legs 4 to 6 are cubic, not quadratic, and there are two real assemblies within
    millimetres of each other: see `assemblies`.

    Raises
    ------
    PoseError
        When it does not converge or ends in another assembly's branches.
    """
    if robot.legs != 6:
        raise PoseError(f"forward: needs six legs, {robot.id} has {robot.legs}; for a delta see delta.forward")
    rotation, position = check_pose(rotation, position)
    if np.shape(alpha) != (6,) or not np.all(np.isfinite(alpha)):
        raise PoseError("forward: alpha must be six finite angles")
    elbows = robot.elbows(alpha, beta)
    # the nearest rotation: the start may have four digits
    u, _, vt = np.linalg.svd(rotation)
    rotation = u @ vt
    for step in range(steps + 1):
        arm = robot.joint @ rotation.T
        d = arm + position - elbows
        miss = np.linalg.norm(d, axis=1) - robot.lb
        if not np.all(np.isfinite(miss)) or np.abs(miss).max() < tolerance:
            break
        rows = 2 * np.hstack([np.cross(arm, d), d])
        if np.linalg.svd(scaled(rows / (2 * robot.lb[:, None])), compute_uv=False)[-1] <= NEAR:
            raise PoseError(f"forward: the Jacobian is singular after {step} steps")
        move = np.linalg.solve(rows, robot.lb**2 - np.sum(d * d, axis=1))
        rotation, position = _turned(rotation, move[:3]), position + move[3:]
    worst = float(np.abs(miss).max())
    if not worst < tolerance:
        raise PoseError(f"forward: no convergence in {steps} steps: a rod is off by {worst:.3g} mm; start nearer")
    found = branches(robot, rotation, position, alpha, beta)
    if same_branch and np.any(found != robot.branch):
        raise PoseError(f"forward: ended in another assembly: leg {1 + int(np.argmax(found != robot.branch))} "
                        "is on its other branch; start nearer")
    return Forward(rotation, position, step, worst, found)


def scaled(rows: Floats) -> Floats:
    """Rows (..., n, 6) of J_x with lengths in units of 100 mm."""
    return rows / np.array([UNIT] * 3 + [1.0] * 3)


def branches(robot: Robot, rotation: ArrayLike, position: ArrayLike, alpha: ArrayLike, beta: ArrayLike) -> Floats:
    """(..., n) +1 or -1: the branch of each leg."""
    d = robot.joints(rotation, position) - robot.shoulders(beta)
    e, f = np.einsum("...ni,ni->...n", d, robot.radial), d @ robot.up
    return np.where(e * np.sin(alpha) - f * np.cos(alpha) >= 0, 1.0, -1.0)


def assemblies(robot: Robot, alpha: ArrayLike, beta: float, rotation: ArrayLike, position: ArrayLike,
               tries: int = 60, degrees: float = 6.0, millimetres: float = 15.0, seed: int = 0) -> list[Forward]:
    """Assemblies found by Newton from `tries` starts about a pose, nearest first; there may be more."""
    rng = np.random.default_rng(seed)
    found: list[Forward] = []
    for number in range(tries):
        size = number > 0
        turn = np.radians(degrees) * rng.uniform(-1, 1, 3) * size
        shift = millimetres * rng.uniform(-1, 1, 3) * size
        try:
            one = forward(robot, alpha, beta, _turned(np.asarray(rotation, dtype=np.float64), turn),
                          np.asarray(position) + shift, same_branch=False)
        except PoseError:
            continue
        if all(np.linalg.norm(one.position - other.position) > 1e-5 for other in found):
            found.append(one)
    return sorted(found, key=lambda one: float(np.linalg.norm(one.position - position)))
