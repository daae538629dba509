"""This module makes the working day of an arm: a circle, a line and a pick-and-place, with smooth joint profiles.

It is deterministic, stays within the joint limits and on one side of the elbow. The report runs it through every core.
"""

from __future__ import annotations

import numpy as np

from quadrance import truth
from quadrance.arms import SEVEN, Arm, ArmError
from quadrance.truth import Floats

TURNTABLE = (-170.0, 170.0)  # degrees: yaw of an arm that has none (a SCARA's two links on a turntable)
CLEAR = 12.0  # degrees kept from the stretched and the folded elbow


def limits(arm: Arm) -> tuple[Floats, Floats]:
    """Lower and upper joint limits (3,) in radians: one turn, one side of the elbow, clear of the singular poses.

    The elbow is the side with more room (elbow up, theta2 > 0, when equal).
    """
    shoulder, elbow, yaw = (*arm.limits, TURNTABLE)[:3]
    sides = [(max(elbow[0], CLEAR), min(elbow[1], 180 - CLEAR)), (max(elbow[0], CLEAR - 180), min(elbow[1], -CLEAR))]
    side = max(sides, key=lambda pair: pair[1] - pair[0])
    if side[1] <= side[0]:
        raise ArmError(f"{arm.id}: limits.elbow: [{elbow[0]:g}, {elbow[1]:g}] leaves no room between {CLEAR:g} and "
                       f"{180 - CLEAR:g} degrees on either side")

    def one_turn(low: float, high: float) -> tuple[float, float]:
        return (low, high) if high - low <= 360 else (-180.0, 180.0)

    return tuple(np.radians(np.array([one_turn(*shoulder), side, one_turn(*yaw)]).T))


def smooth(u: Floats) -> Floats:
    """Quintic profile from 0 to 1 with speed and acceleration 0 at both ends."""
    return u**3 * (10 + u * (6 * u - 15))


def _inverse(arm: Arm, joints: int, tip: Floats, elbow: int, low: Floats, high: Floats) -> Floats | None:
    """Joint angles (N, 3) for tip points (N, 3), or None where one is out of reach or limits."""
    l1, l2 = arm.links
    x, y, z = tip.T
    radius = x if joints < 3 else np.hypot(x, y)
    plane = (x, y) if joints < 3 else (radius, z)
    theta1, theta2 = truth.ik2(*plane, l1, l2, elbow)
    theta3 = np.full_like(theta1, (low[2] + high[2]) / 2) if joints < 3 else truth.angle(x, y)
    angles = np.stack([theta1, theta2, theta3], axis=-1)
    angles = low + np.mod(angles - low, truth.TURN)  # the representative that may lie within the limits
    inside = np.all((angles >= low) & (angles <= high)) and np.all(truth.reach(*plane, l1, l2) == 0)
    return angles if inside else None


def _path(arm: Arm, joints: int, shape, elbow: int, low: Floats, high: Floats) -> Floats:
    """Joint angles along ``centre + size * shape``, at the largest size that fits limits and reach."""
    centre = truth.tip(((low + high) / 2)[:joints], *arm.links)
    for size in sum(arm.links) * 0.9 ** np.arange(60):
        angles = _inverse(arm, joints, centre + size * shape, elbow, low, high)
        if angles is not None:
            return angles
    raise ArmError(f"{arm.id}: limits: no room for a path around the middle of the joint ranges")


def trajectory(arm: Arm, joints: int = 3, samples: int = 1000) -> tuple[Floats, Floats]:
    """Circle, line and pick-and-place of `arm`.

    Parameters
    ----------
    arm : Arm
    joints : 1, 2 or 3
        1: the first link alone, driven as in the two-joint motion. 2: both links in the plane.
        3: with the yaw; an arm without one is put on a turntable.
    samples : int
        About a third of them for each of the three motions.

    Returns
    -------
    angles : float array (samples, joints)
        Radians, within the limits.
    tip : float array (samples, 3)
        Coordinate units; z = 0 for one and two joints.
    """
    if joints not in (1, 2, 3) or samples < 12:
        raise ValueError(f"trajectory: joints must be 1, 2 or 3 and samples at least 12, not {joints}, {samples}")
    if arm.upper_limit:
        raise ArmError(f"{arm.id}: {SEVEN}; its trajectory wants none")
    low, high = limits(arm)
    elbow, paths = int(high[1] <= 0), max(joints, 2)
    thirds = [smooth(np.linspace(0, 1, count)) for count in (samples // 3, samples // 3, samples - 2 * (samples // 3))]
    turn = truth.TURN * thirds[0]
    circle = np.stack([np.cos(turn), np.sin(turn), 0.4 * np.sin(turn) * (paths == 3)], axis=-1)
    line = np.outer(2 * thirds[1] - 1, [0.6, -0.7, 0.5 * (paths == 3)])
    pick, over, place = (low + (high - low) * np.array(part) for part in
                         ((0.02, 0.85, 0.05), (0.45, 0.3, 0.55), (0.98, 0.6, 0.97)))
    first, second = smooth(np.clip(2 * np.linspace(0, 1, len(thirds[2])), 0, 1)), \
        smooth(np.clip(2 * np.linspace(0, 1, len(thirds[2])) - 1, 0, 1))
    carry = pick + np.outer(first, over - pick) + np.outer(second, place - over)
    angles = np.concatenate([_path(arm, paths, circle, elbow, low, high),
                             _path(arm, paths, line, elbow, low, high), carry])
    angles = angles[:, :joints]
    return angles, truth.tip(angles, *arm.links)
