"""This module computes the manipulability and the angle of the reconfiguration links that maximises it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from quadrance.parallel.geometry import Floats, PoseError, Robot
from quadrance.parallel.position import inverse, scaled

GOLDEN = (5**0.5 - 1) / 2
MEASURES = ("rotation", "translation")
LIMIT = np.pi / 2  # the paper's interval of beta is -90 to 90 degrees
STEPS = 181  # of that interval, where the feasible part and the start of the search are looked for


def _jacobian(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike):
    """(J_x^T Delta, J_q, reachable) without an error where a leg does not reach: NaN there."""
    found = inverse(robot, rotation, position, beta)
    shoulders, elbows = robot.shoulders(beta), robot.elbows(found.alpha, beta)
    ends = robot.joints(rotation, position)
    w = (ends - elbows) / robot.lb[:, None]
    cranks = np.einsum("...i,...i->...", w, np.cross(robot.axis, elbows - shoulders))
    reachable = found.reachable.all(axis=-1)
    rows = np.concatenate([np.cross(ends, w), w], axis=-1)
    return np.where(reachable[..., None, None], rows, np.eye(6)), cranks, reachable


def manipulability(robot: Robot, rotation: ArrayLike, position: ArrayLike,
                   beta: ArrayLike = 0.0) -> tuple[Floats, Floats]:
    """(w_rot, w_tras) of (35), (36): J = (J_x^T Delta)^-1 J_q, rows 1-3 and 4-6; NaN where a leg does not reach.

    The pole is O and lengths are millimetres. w grows without limit towards a singular J_x: look at
    `singularity.condition` beside it.
    """
    rows, cranks, reachable = _jacobian(robot, rotation, position, beta)
    try:
        whole = np.linalg.inv(rows) * cranks[..., None, :]
    except np.linalg.LinAlgError:
        raise PoseError("manipulability: J_x is singular (type 2)") from None
    answer = []
    for part in (whole[..., :3, :], whole[..., 3:, :]):
        square = np.linalg.det(part @ np.swapaxes(part, -1, -2))
        answer.append(np.where(reachable, np.sqrt(np.maximum(square, 0)), np.nan))
    return answer[0], answer[1]


def _condition(robot: Robot, rotation: Floats, position: Floats, beta: Floats) -> Floats:
    rows, _, reachable = _jacobian(robot, rotation, position, beta)
    values = np.linalg.svd(scaled(rows), compute_uv=False)
    return np.where(reachable, values[..., 0] / np.maximum(values[..., -1], 1e-300), np.inf)


@dataclass(frozen=True)
class Optimum:
    """Of poses (...): the best beta in radians, the measure there, and cond of J_x there."""

    beta: Floats
    value: Floats
    condition: Floats


def _objective(robot: Robot, rotation: Floats, position: Floats, measure: str, greatest: float):
    which = MEASURES.index(measure)

    def value(beta: Floats) -> Floats:
        found = manipulability(robot, rotation, position, beta)[which]
        found = np.where(np.isnan(found), -np.inf, found)
        if np.isfinite(greatest):
            found = np.where(_condition(robot, rotation, position, beta) <= greatest, found, -np.inf)
        return found
    return value


def best(robot: Robot, rotation: ArrayLike, position: ArrayLike, measure: str = "rotation",
         greatest_condition: float = np.inf, tolerance: float = 1e-8) -> Optimum:
    """The beta of -90 to 90 degrees with the greatest manipulability, every pose (...) at once.

    A coarse look over the interval, then a golden-section search between the neighbours of its best step. At the
    paper's pose and on its spiral the measure has one maximum in beta. Elsewhere it may have poles, where J_x is
    singular, and the greatest value is then next to one: of 400 random poses (15 degrees, 40 mm off the axis) 111 have
    more than one maximum. `greatest_condition` keeps the search away: postures with a greater cond (lengths / 100 mm)
    do not count.

    Raises
    ------
    PoseError
        Where no beta reaches the pose, or none is conditioned well enough; or the robot has no links.
    """
    if measure not in MEASURES:
        raise PoseError(f"measure: must be one of {', '.join(MEASURES)}, not {measure!r}")
    if not robot.link.any() or robot.legs != 6:
        raise PoseError(f"beta: {robot.id} has no reconfiguration links")
    rotation, position = np.asarray(rotation, dtype=np.float64), np.asarray(position, dtype=np.float64)
    shape = np.broadcast_shapes(rotation.shape[:-2], position.shape[:-1])
    grid = np.linspace(-LIMIT, LIMIT, STEPS).reshape(-1, *[1] * len(shape))
    value = _objective(robot, rotation, position, measure, greatest_condition)
    coarse = value(np.broadcast_to(grid, (STEPS, *shape)))
    if np.any(np.all(np.isneginf(coarse), axis=0)):
        raise PoseError("beta: no angle of the links reaches the pose" +
                        (" with that condition" if np.isfinite(greatest_condition) else ""))
    at = np.argmax(coarse, axis=0)
    flat = grid.reshape(-1)
    low, high = flat[np.maximum(at - 1, 0)], flat[np.minimum(at + 1, STEPS - 1)]
    a, b = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    va, vb = value(a), value(b)
    while np.max(high - low) > tolerance:
        left = va > vb  # the maximum is left of b
        low, high = np.where(left, low, a), np.where(left, b, high)
        point = np.where(left, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        new = value(point)
        a, b, va, vb = (np.where(left, point, b), np.where(left, a, point),
                        np.where(left, new, vb), np.where(left, va, new))
    found = (low + high) / 2
    # a bound of the feasible set may lie between: the best of what was looked at counts
    options = np.stack([found, a, b, flat[at]])
    values = np.stack([value(one) for one in options])
    pick = np.argmax(values, axis=0)
    found = np.take_along_axis(options, pick[None], axis=0)[0]
    return Optimum(found, np.take_along_axis(values, pick[None], axis=0)[0],
                   _condition(robot, rotation, position, found))


def feasible(robot: Robot, rotation: ArrayLike, position: ArrayLike,
             tolerance: float = 1e-10) -> tuple[float, float]:
    """(lowest, highest) beta in radians that reaches one pose, of the stretch that holds most of -90 to 90 degrees.

    Raises
    ------
    PoseError
        Where no beta reaches it.
    """
    grid = np.linspace(-LIMIT, LIMIT, STEPS)

    def reaches(beta: ArrayLike) -> np.ndarray:
        return inverse(robot, rotation, position, beta).reachable.all(axis=-1)

    inside = reaches(grid)
    if not inside.any():
        raise PoseError("beta: no angle of the links reaches the pose")
    edges = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int)))
    first, last = max(edges.reshape(-1, 2).tolist(), key=lambda pair: pair[1] - pair[0])

    def border(inner: float, outer: float) -> float:
        while abs(outer - inner) > tolerance:
            middle = (inner + outer) / 2
            inner, outer = (middle, outer) if reaches(middle) else (inner, middle)
        return inner

    low = grid[first] if first == 0 else border(grid[first], grid[first - 1])
    high = grid[last - 1] if last == STEPS else border(grid[last - 1], grid[last])
    return float(low), float(high)
