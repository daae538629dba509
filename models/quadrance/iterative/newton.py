"""Newton-Raphson of the planar arm of three joints in float64, and the same problem in one pass.

Unknowns are three relative joints; the equations are the tip and the orientation (eq. 14): the last link points along
the ray to the target. That angle needs atan2; with the paper's atan the method fails for x < 0. The wrist, a link
short of the target on that ray, makes the inverse of the matrix closed: its determinant is l1 l2 sin theta2.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance import truth
from quadrance.iterative import Answer
from quadrance.truth import Floats, floats

CLAMP = 1.0  # the longest step of a joint, radians: all 8100 starts converge; of pi / 2 one in fifteen cycles for ever
GUARD = 2.0 ** -6  # |sin theta2| below which it is replaced by this, its sign kept


def wrapped(theta: ArrayLike) -> Floats:
    """Angles in [-pi, pi), as a binary angle of any width wraps them."""
    return (floats(theta) + np.pi) % truth.TURN - np.pi


def residual(theta: Floats, target: Floats, lengths: ArrayLike) -> Floats:
    """(x, y, orientation) of the target less those of the arm; the angle is wrapped."""
    turn = np.cumsum(theta, axis=-1)
    x, y = (lengths * np.cos(turn)).sum(axis=-1), (lengths * np.sin(turn)).sum(axis=-1)
    return np.stack([target[..., 0] - x, target[..., 1] - y,
                     wrapped(np.arctan2(target[..., 1], target[..., 0]) - turn[..., -1])], axis=-1)


def step(theta: Floats, target: Floats, lengths: ArrayLike, guard: float = 0.0) -> tuple[Floats, Floats, Floats]:
    """The Newton step, the residual, and sin theta2 before the guard: a closed inverse, no elimination."""
    l1, l2, l3 = lengths
    gap, turn = residual(theta, target, lengths), np.cumsum(theta, axis=-1)
    c1, n1, c12, n12 = np.cos(turn[..., 0]), np.sin(turn[..., 0]), np.cos(turn[..., 1]), np.sin(turn[..., 1])
    # the sum of the joints turns by gap[2] and takes the tip along: what is left is the wrist's
    ex = gap[..., 0] + l3 * np.sin(turn[..., 2]) * gap[..., 2]
    ey = gap[..., 1] - l3 * np.cos(turn[..., 2]) * gap[..., 2]
    n2 = np.sin(theta[..., 1])
    safe = np.where(np.abs(n2) < guard, np.where(n2 < 0, -guard, guard), n2)
    d1 = (c12 * ex + n12 * ey) / (l1 * safe)
    d12 = -(c1 * ex + n1 * ey) / (l2 * safe)
    return np.stack([d1, d12 - d1, gap[..., 2] - d12], axis=-1), gap, n2


def path(start: ArrayLike, target: ArrayLike, lengths: ArrayLike, iterations: int) -> Floats:
    """Joints of every iteration as the paper runs it, without clamp, guard and wrap, (iterations + 1, 3)."""
    thetas = [floats(start)]
    for _ in range(iterations):
        thetas.append(thetas[-1] + step(thetas[-1], floats(target), lengths)[0])
    return np.stack(thetas)


def solve(start: ArrayLike, target: ArrayLike, lengths: ArrayLike, *, tolerance: float, limit: int,
          clamp: float = CLAMP, guard: float = GUARD) -> Answer:
    """Iterate until the squared residual (tip, and angle times the reach) is below `tolerance`, at most `limit` steps.

    A step longer than `clamp` in any joint is shortened as a whole; angles wrap; a determinant below the guard is held
    off 0 and marks the sample singular if it has not recovered when it ends.
    """
    if tolerance < 0 or limit < 0 or clamp <= 0 or guard < 0 or min(lengths) <= 0:
        raise ValueError("lengths and clamp are positive, tolerance, limit and guard are not negative")
    theta, target = floats(start), floats(target)
    shape = np.broadcast_shapes(theta.shape[:-1], target.shape[:-1])
    theta = np.broadcast_to(theta, shape + (3,)).copy()
    target = np.broadcast_to(target, shape + (2,))
    weight = floats([1, 1, sum(lengths)])
    count, active = np.zeros(shape, dtype=np.int64), np.ones(shape, dtype=bool)
    error, singular = np.zeros(shape), np.zeros(shape, dtype=bool)
    for h in range(limit + 1):
        move, gap, n2 = step(theta, target, lengths, guard)
        error = np.where(active, ((gap * weight) ** 2).sum(axis=-1), error)
        active = active & ~(error < tolerance) & np.isfinite(error)
        singular = np.where(active, np.abs(n2) < guard, singular)
        if h == limit or not active.any():
            break
        longest = np.abs(move).max(axis=-1, keepdims=True)
        move = move * np.minimum(1, clamp / np.maximum(longest, clamp))
        theta = np.where(active[..., None], wrapped(theta + move), theta)
        count += active
    done = error < tolerance
    return Answer(theta, error, count, done, singular & ~done)


def closed(target: ArrayLike, lengths: ArrayLike, elbow: ArrayLike = 0) -> tuple[Floats, Floats]:
    """Joints in one pass, and how far the wrist is out of reach: the wrist point, then two joints, then the ray."""
    target = floats(target)
    l1, l2, l3 = lengths
    away = np.hypot(target[..., 0], target[..., 1])
    ray = np.arctan2(target[..., 1], target[..., 0])
    wrist = np.stack([(away - l3) * np.cos(ray), (away - l3) * np.sin(ray)], axis=-1)
    theta1, theta2 = truth.ik2(wrist[..., 0], wrist[..., 1], l1, l2, elbow)[:2]
    far = truth.reach(wrist[..., 0], wrist[..., 1], l1, l2)
    return wrapped(np.stack([theta1, theta2, ray - theta1 - theta2], axis=-1)), far


def wrist_step(theta: Floats, wrist: Floats, lengths: ArrayLike, damping: float = 0.0, guard: float = 0.0
               ) -> tuple[Floats, Floats, Floats]:
    """Step of joints 1 and 2, the wrist's error, and sin theta2: what is left when the third equation holds.

    (D adj(J) + lambda J^T) E / (D^2 + lambda (2 + lambda)) with D = sin theta2, J for the turns of link 1 and of both
    joints in units of their lengths: Gauss-Newton damped by lambda, Newton at 0. `guard` is added to a smaller D.
    """
    l1, l2 = floats(lengths)[:2]
    c1, n1, c12, n12 = (fn(angle) for angle in (theta[..., 0], theta.sum(axis=-1)) for fn in (np.cos, np.sin))
    ex, ey = wrist[..., 0] - l1 * c1 - l2 * c12, wrist[..., 1] - l1 * n1 - l2 * n12
    n2 = np.sin(theta[..., 1])
    safe = n2 + np.where(np.abs(n2) < guard, np.where(n2 < 0, -guard, guard), 0)
    det = safe**2 + damping * (2 + damping)
    d1 = (safe * (c12 * ex + n12 * ey) + damping * (c1 * ey - n1 * ex)) / (det * l1)
    d12 = (damping * (c12 * ey - n12 * ex) - safe * (c1 * ex + n1 * ey)) / (det * l2)
    return np.stack([d1, d12 - d1], axis=-1), np.stack([ex, ey], axis=-1), n2


def wrist_solve(start: ArrayLike, target: ArrayLike, phi: ArrayLike, lengths: ArrayLike, *, tolerance: float,
                limit: int, damping: float = 0.0, guard: float = 2.0**-4) -> Answer:
    """Iterate joints 1 and 2, as engine_newton_3r does, until the squared error of the tip is below `tolerance`.

    The third joint is phi less both. A step in which link 1, or both joints, turn by more than a quarter turn is
    divided by 4 as a whole until they do not. The guard is off with a damping of 2^-9 and more.
    """
    target, phi = floats(target), floats(phi)
    l3 = floats(lengths)[2]
    wrist = target - l3 * np.stack([np.cos(phi), np.sin(phi)], axis=-1)
    theta, wrist = (np.array(a) for a in np.broadcast_arrays(floats(start)[..., :2], wrist))
    count, active = np.zeros(theta.shape[:-1], dtype=np.int64), np.ones(theta.shape[:-1], dtype=bool)
    for h in range(limit + 1):
        move, gap, n2 = wrist_step(theta, wrist, lengths, damping, 0.0 if damping >= 2**-9 else guard)
        error = (gap**2).sum(axis=-1)
        active = active & ~(error < tolerance)
        if h == limit or not active.any():
            break
        size = np.maximum(np.abs(move[..., 0]), np.abs(move.sum(axis=-1))) / (np.pi / 2)
        move = move / 4.0 ** np.ceil(np.log(np.maximum(size, 1)) / np.log(4))[..., None]
        theta = np.where(active[..., None], wrapped(theta + move), theta)
        count += active
    third = wrapped(phi - theta.sum(axis=-1))[..., None]
    return Answer(np.concatenate([theta, third], axis=-1), error, count, error < tolerance,
                  (np.abs(n2) < guard) & ~(error < tolerance))
