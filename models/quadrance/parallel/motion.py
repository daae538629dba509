"""Screws: Jacobians, velocity and acceleration of the platform and of the cranks.

A twist is (omega, v): v is the velocity of the platform's point that passes the origin O (the pole).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from quadrance.parallel.geometry import Floats, PoseError, Robot
from quadrance.parallel.position import NEAR, inverse, scaled


@dataclass(frozen=True)
class Jacobians:
    """Of the input-output equation ``platform twist = cranks alpha' + links beta'``.

    platform : (..., n, 6), rows (C x w, w), w the rods' unit vectors: J_x^T Delta of the paper.
    cranks, links : (..., n), the diagonals of J_q and of the corrected J'_q.
    """

    platform: Floats
    cranks: Floats
    links: Floats


def _rods(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike) -> tuple[Floats, ...]:
    """A, B, C and w (..., n, 3) at a pose; PoseError where a leg does not reach it."""
    found = inverse(robot, rotation, position, beta)
    if not np.all(found.reachable):
        raise PoseError(f"pose: leg {1 + int(np.argmin(found.reachable.reshape(-1, robot.legs).all(axis=0)))} "
                        "does not reach it")
    shoulders, elbows = robot.shoulders(beta), robot.elbows(found.alpha, beta)
    ends = robot.joints(rotation, position)
    return shoulders, elbows, ends, (ends - elbows) / robot.lb[:, None]


def _dot(a: Floats, b: Floats) -> Floats:
    return np.einsum("...i,...i->...", a, b)


def jacobians(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike = 0.0) -> Jacobians:
    """The three Jacobians of (22) at poses.

    Paper: alpha of (3) is absolute, but (18) to (33) treat it as relative to the reconfiguration link. With an
    absolute angle ``J'_q,i = {S^r; S^6} - {S^1; S^6} = w_i . (u_i x (A_i - F_i))``; the printed diagonal leaves 37.6 of
    75 mm/s. Legs 4 to 6 have no link: their entries are 0 and no virtual screw is needed.
    """
    shoulders, elbows, ends, w = _rods(robot, rotation, position, beta)
    cranks = _dot(w, np.cross(robot.axis, elbows - shoulders))
    links = _dot(w, np.cross(robot.axis, shoulders - robot.foot))
    return Jacobians(np.concatenate([np.cross(ends, w), w], axis=-1), cranks, links)


def twist(rotation: ArrayLike, position: ArrayLike, omega: ArrayLike, velocity: ArrayLike) -> Floats:
    """(..., 6) twist of a platform that turns with `omega` and whose own origin moves with `velocity`."""
    omega = np.asarray(omega, dtype=np.float64)
    return np.concatenate([omega, np.asarray(velocity) - np.cross(omega, position)], axis=-1)


def crank_rates(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike, platform: ArrayLike,
                link: ArrayLike = 0.0) -> Floats:
    """(..., n) alpha' in rad/s from the platform's twist (..., 6) and beta' (...)."""
    found = jacobians(robot, rotation, position, beta)
    _regular(robot, found.cranks)
    pull = np.einsum("...ni,...i->...n", found.platform, platform)
    return (pull - found.links * np.asarray(link)[..., None]) / found.cranks


def platform_twist(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike, cranks: ArrayLike,
                   link: ArrayLike = 0.0) -> Floats:
    """(..., 6) twist of the platform from alpha' (..., 6) and beta' (...), six legs."""
    found = jacobians(robot, rotation, position, beta)
    pull = found.cranks * np.asarray(cranks) + found.links * np.asarray(link)[..., None]
    if np.any(np.linalg.svd(scaled(found.platform), compute_uv=False)[..., -1] <= NEAR):
        raise PoseError("velocity: J_x is singular (type 2)")
    return np.linalg.solve(found.platform, pull[..., None])[..., 0]


def _regular(robot: Robot, cranks: Floats) -> None:
    if np.any(np.abs(cranks) <= NEAR * robot.la):
        raise PoseError("velocity: J_q is singular (type 1): a leg is stretched or folded")


# Acceleration


def _screw(direction: Floats, point: Floats) -> Floats:
    return np.concatenate([direction, np.cross(point, direction)], axis=-1)


def _lie(a: Floats, b: Floats) -> Floats:
    """Lie product of screws: ``[s1; o1][s2; o2] = (s1 x s2; s1 x o2 + o1 x s2)``."""
    return np.concatenate([np.cross(a[..., :3], b[..., :3]),
                           np.cross(a[..., :3], b[..., 3:]) + np.cross(a[..., 3:], b[..., :3])], axis=-1)


def _klein(a: Floats, b: Floats) -> Floats:
    return _dot(a[..., :3], b[..., 3:]) + _dot(a[..., 3:], b[..., :3])


def coriolis(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike, platform: ArrayLike,
             link: ArrayLike = 0.0) -> Floats:
    """(..., n) {L_i; S^6}: what the velocities add to the acceleration, C of (33).

    L_i = sum over j < k of omega_j omega_k [S_j S_k] over the joints of the leg, base first.

    Paper: the first omega_1 of (18) is omega_r, that of the link, and its crank's rate is alpha' - beta'; "omega_r = 0
    and {S^r; S^6} = 1" belongs to omega_f and S^f, which are not needed here.
    """
    shoulders, elbows, ends, w = _rods(robot, rotation, position, beta)
    axis = np.broadcast_to(robot.axis, w.shape)
    v = np.cross(axis, w)
    v = v / np.linalg.norm(v, axis=-1, keepdims=True)
    rates = crank_rates(robot, rotation, position, beta, platform, link)
    link = np.broadcast_to(np.where(robot.link > 0, np.asarray(link)[..., None], 0.0), rates.shape)
    screws = [_screw(axis, np.broadcast_to(robot.foot, w.shape)), _screw(axis, shoulders), _screw(axis, elbows),
              _screw(v, elbows), _screw(axis, ends), _screw(v, ends), _screw(w, ends)]
    known = [link, rates - link]
    rest = np.asarray(platform)[..., None, :] - sum(rate[..., None] * one for rate, one in zip(known, screws))
    # five joints after the crank; their screws span all but {.; S^6} = 0, which `rest` fulfils
    columns = np.stack(screws[2:], axis=-1)
    scale = np.array([1, 1, 1, *[1 / 100] * 3])  # lengths in 100 mm
    passive = np.linalg.pinv(columns * scale[:, None]) @ (rest * scale)[..., None]
    rates = [*known, *np.moveaxis(passive[..., 0], -1, 0)]
    total = np.zeros_like(screws[0])
    for j, one in enumerate(screws):
        for k in range(j + 1, len(screws)):
            total += (rates[j] * rates[k])[..., None] * _lie(one, screws[k])
    return _klein(total, screws[-1])


def reduced(acceleration: ArrayLike, omega: ArrayLike, position: ArrayLike, velocity: ArrayLike,
            alpha: ArrayLike) -> Floats:
    """(..., 6) reduced acceleration state (26) at O: (omega', a_O - omega x v_O).

    `acceleration`, `velocity` are those of the platform's own origin, `alpha` is omega'.
    """
    omega, position = np.asarray(omega, dtype=np.float64), np.asarray(position, dtype=np.float64)
    pole = np.asarray(velocity) - np.cross(omega, position)
    at_pole = np.asarray(acceleration) - np.cross(alpha, position) - np.cross(omega, np.cross(omega, position))
    return np.concatenate([np.broadcast_to(alpha, at_pole.shape), at_pole - np.cross(omega, pole)], axis=-1)


def crank_accelerations(robot: Robot, rotation: ArrayLike, position: ArrayLike, beta: ArrayLike, platform: ArrayLike,
                        state: ArrayLike, link: ArrayLike = 0.0, link_acceleration: ArrayLike = 0.0) -> Floats:
    """(..., n) alpha'' in rad/s^2 from the platform's twist, its reduced acceleration `state`, beta' and beta''."""
    found = jacobians(robot, rotation, position, beta)
    _regular(robot, found.cranks)
    pull = np.einsum("...ni,...i->...n", found.platform, state)
    more = found.links * np.asarray(link_acceleration)[..., None]
    return (pull - more - coriolis(robot, rotation, position, beta, platform, link)) / found.cranks
