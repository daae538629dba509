"""Quaternion gradient descent in float64: theta(h) = theta(h-1) + alpha E J with E = target - tip (eqs. 18, 31).

O. A. Dominguez-Ramirez et al., "Cinematica inversa cuaternionica ...", doi 10.29057/icbi.v10iEspecial5.10205, with the
Jacobians as they must be: eqs. 23-24 miss the leading Q1 of their second term, and the printed Jacobian of the
Geomagic Touch has s23, c23 where theta3 is absolute. Descent with it stalls 0.17 m off the target 0 from the paper's
start, and from none of 2000 random ones does it come to rest within 1 mm.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from quadrance.iterative import Answer
from quadrance.truth import Floats, floats

Kinematics = Callable[[Floats], tuple[Floats, Floats]]  # theta (..., n) -> tip (..., d), Jacobian (..., d, n)


def planar(*lengths: float) -> Kinematics:
    """Revolute joints in the plane, each angle relative to the link before it: eqs. 23-25 for any number of links."""
    links = floats(lengths)
    if not links.size:
        raise ValueError("a chain without a link has no tip")

    def kinematics(theta: Floats) -> tuple[Floats, Floats]:
        turn = np.cumsum(theta, axis=-1)
        x, y = links * np.cos(turn), links * np.sin(turn)
        beyond = np.cumsum(np.stack([-y, x], axis=-2)[..., ::-1], axis=-1)[..., ::-1]  # column i: all links from i on
        return np.stack([x.sum(axis=-1), y.sum(axis=-1)], axis=-1), beyond

    return kinematics


def touch(l1: float, l2: float, origin: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Kinematics:
    """The Geomagic Touch: theta1 yaws about y, theta2 lifts link 1, theta3 is the absolute angle of link 2 (eq. 28).

    `origin` is the point between the axes; the paper's target frame puts it at (0, 0.025, -0.17) m.
    """
    def kinematics(theta: Floats) -> tuple[Floats, Floats]:
        (c1, c2, c3), (s1, s2, s3) = np.moveaxis(np.cos(theta), -1, 0), np.moveaxis(np.sin(theta), -1, 0)
        rho, zero = l1 * c2 + l2 * s3, np.zeros_like(c1)
        tip = np.stack([-s1 * rho, l1 * s2 - l2 * c3, c1 * rho], axis=-1) + origin
        rows = ((-c1 * rho, s1 * l1 * s2, -s1 * l2 * c3), (zero, l1 * c2, l2 * s3),
                (-s1 * rho, -c1 * l1 * s2, c1 * l2 * c3))
        return tip, np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

    return kinematics


@dataclass(frozen=True)
class Joint:
    """A revolute joint of a chain in space: its axis, and the link after it, both in its own frame at angle 0."""

    axis: tuple[float, float, float]
    link: tuple[float, float, float]


def product(a: Floats, b: Floats) -> Floats:
    """Quaternion product (..., 4), the scalar first."""
    s, u, t, v = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    return np.concatenate([s * t - (u * v).sum(axis=-1, keepdims=True), s * v + t * u + np.cross(u, v)], axis=-1)


def turned(q: Floats, vector: ArrayLike) -> Floats:
    """`vector` turned by the unit quaternion `q`: Q (x) v (x) Q~."""
    v = np.concatenate([np.zeros(q.shape[:-1] + (1,)), np.broadcast_to(floats(vector), q.shape[:-1] + (3,))], axis=-1)
    return product(product(q, v), q * [1, -1, -1, -1])[..., 1:]


def spatial(joints: list[Joint]) -> Kinematics:
    """Any number of revolute joints in space by unit quaternions: column i of J is axis_i x (tip - joint_i)."""
    if not joints:
        raise ValueError("a chain without a joint has no tip")
    axes = floats([joint.axis for joint in joints])
    if np.any(np.abs(np.linalg.norm(axes, axis=-1) - 1) > 1e-9):
        raise ValueError("the axis of a joint is not of length 1")

    def kinematics(theta: Floats) -> tuple[Floats, Floats]:
        q = np.zeros(theta.shape[:-1] + (4,))
        q[..., 0] = 1.0
        at, places, ways = np.zeros(theta.shape[:-1] + (3,)), [], []
        for i, joint in enumerate(joints):
            half = theta[..., i:i + 1] / 2
            places.append(at)
            ways.append(turned(q, joint.axis))
            q = product(q, np.concatenate([np.cos(half), np.sin(half) * axes[i]], axis=-1))
            at = at + turned(q, joint.link)
        return at, np.stack([np.cross(way, at - place) for way, place in zip(ways, places)], axis=-1)

    return kinematics


def step(kinematics: Kinematics, theta: ArrayLike, target: ArrayLike, alpha: float) -> tuple[Floats, Floats]:
    """alpha E J, what one iteration adds to `theta`, and E; with alpha / dt for alpha it is the velocity of eq. 22."""
    tip, jacobian = kinematics(floats(theta))
    error = floats(target) - tip
    return alpha * np.einsum("...d,...dn->...n", error, jacobian), error


def damped(kinematics: Kinematics, theta: ArrayLike, target: ArrayLike, damping: float) -> tuple[Floats, Floats]:
    """J^T (J J^T + damping I)^-1 E, a damped Gauss-Newton step, and E."""
    tip, jacobian = kinematics(floats(theta))
    error = floats(target) - tip
    square = jacobian @ np.swapaxes(jacobian, -1, -2) + damping * np.eye(error.shape[-1])
    solved = np.linalg.solve(square, error[..., None])
    return (np.swapaxes(jacobian, -1, -2) @ solved)[..., 0], error


def path(kinematics: Kinematics, start: ArrayLike, target: ArrayLike, alpha: float, iterations: int) -> Floats:
    """Joints of every iteration as the paper runs it, (iterations + 1, n), the start first."""
    thetas = [floats(start)]
    for _ in range(iterations):
        thetas.append(thetas[-1] + step(kinematics, thetas[-1], target, alpha)[0])
    return np.stack(thetas)


def vector_step(lengths: tuple[float, float], links: Floats, target: ArrayLike, alpha: float,
                most: float = 0.5) -> tuple[Floats, Floats]:
    """Directions (..., 2, 2), a row (c, n) a link, after one step of the planar arm of two joints, and E: no angle.

    A link turns by (c, n) <- (c - d n, n + d c) with d = alpha E J, at most `most`, and one Newton step brings it to
    length 1: by atan(d), and to 1 - 3/8 d^4 of its length.
    """
    l1, l2 = lengths
    error = floats(target) - l1 * links[..., 0, :] - l2 * links[..., 1, :]
    pull = alpha * floats(lengths) * (links[..., 0] * error[..., None, 1] - links[..., 1] * error[..., None, 0])
    d = np.clip(pull.sum(axis=-1, keepdims=True) + pull * [0, 1], -most, most)[..., None]
    moved = links + d * np.stack([-links[..., 1], links[..., 0]], axis=-1)
    return moved * (3 - (moved ** 2).sum(axis=-1, keepdims=True)) / 2, error


def vector_path(lengths: tuple[float, float], start: ArrayLike, target: ArrayLike, alpha: float,
                iterations: int) -> Floats:
    """Directions of every iteration of `vector_step`, (iterations + 1, 2, 2), the start first."""
    every = [floats(start)]
    for _ in range(iterations):
        every.append(vector_step(lengths, every[-1], target, alpha)[0])
    return np.stack(every)


def solve(kinematics: Kinematics, start: ArrayLike, target: ArrayLike, *, alpha: float = 0.0,
          damping: float | None = None, tolerance: float, limit: int) -> Answer:
    """Iterate until |E|^2 < `tolerance`, at most `limit` steps; by gradient descent, or damped least squares if given.

    All starts (..., n) and targets (..., d) at once. A joint that is no longer finite ends its sample unconverged.
    """
    if (alpha <= 0 if damping is None else damping <= 0) or tolerance < 0 or limit < 0:
        raise ValueError("alpha or damping is positive, tolerance and limit are not negative")
    theta, target = floats(start), floats(target)
    shape = np.broadcast_shapes(theta.shape[:-1], target.shape[:-1])
    theta = np.broadcast_to(theta, shape + theta.shape[-1:]).copy()
    target = np.broadcast_to(target, shape + target.shape[-1:])
    count, active = np.zeros(shape, dtype=np.int64), np.ones(shape, dtype=bool)
    error = np.zeros(shape)
    for h in range(limit + 1):
        move, gap = step(kinematics, theta, target, alpha) if damping is None \
            else damped(kinematics, theta, target, damping)
        error = np.where(active, (gap ** 2).sum(axis=-1), error)
        active = active & ~(error < tolerance) & np.isfinite(error)
        if h == limit or not active.any():
            break
        theta = np.where(active[..., None], theta + move, theta)
        count += active
    return Answer(theta, error, count, error < tolerance, np.zeros(shape, dtype=bool))


def stable_below(kinematics: Kinematics, theta: ArrayLike) -> Floats:
    """The greatest alpha at which the descent is stable about a solution: 2 / |J|^2, the spectral norm."""
    return 2 / np.linalg.norm(kinematics(floats(theta))[1], ord=2, axis=(-2, -1)) ** 2
