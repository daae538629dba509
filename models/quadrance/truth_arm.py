"""This module has the float64 kinematics of real arms, with which the models of rtl/arm are compared.

Angles in radians, lengths in one unit. (L1, L2) are the links as `truth` has them, L2 from the elbow to the wrist;
`Frame` holds the rest. Joint 2 of the machine is theta2 = elbow - turn, elbow being the angle from link 1 to the line
of L2; with `absolute` theta2 = theta1 + elbow - turn.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from quadrance import truth
from quadrance.fixed import ints
from quadrance.truth import Floats, floats

if TYPE_CHECKING:
    from quadrance.arms import Arm


@dataclass(frozen=True)
class Frame:
    """What a built arm adds to two links and a yaw; lengths in the unit of the links, `turn` in radians."""

    base: float = 0.0  # height of the shoulder axis
    shoulder: float = 0.0  # radial offset of the shoulder
    lateral: float = 0.0  # offset of the arm's plane from the yaw axis
    turn: float = 0.0  # angle between the forearm and the line of L2
    absolute: bool = False  # joint 2 is measured from the base


def frame(arm: Arm) -> Frame:
    """The frame of an arm file, in coordinate units."""
    base, shoulder, lateral = (one / arm.mm_per_unit for one in (arm.base, arm.shoulder, arm.lateral))
    return Frame(base, shoulder, lateral, math.radians(arm.elbow_angle), arm.absolute_elbow)


def fk3(theta1: ArrayLike, theta2: ArrayLike, theta3: ArrayLike, l1: float, l2: float,
        f: Frame) -> tuple[Floats, Floats, Floats]:
    """Tip (x, y, z) of the machine's joints."""
    second = floats(theta2) + f.turn + (0 if f.absolute else floats(theta1))
    rho = l1 * np.cos(theta1) + l2 * np.cos(second) + f.shoulder
    z = l1 * np.sin(theta1) + l2 * np.sin(second) + f.base
    c3, n3 = truth.unit(theta3)
    return rho * c3 - f.lateral * n3, rho * n3 + f.lateral * c3, z


def plane(x: ArrayLike, y: ArrayLike, z: ArrayLike, back: ArrayLike, f: Frame) -> tuple[Floats, Floats, Floats]:
    """(radius, height, yaw) of the target seen from the shoulder axis; back: the yaw is turned round.

    Nearer to the yaw axis than the lateral offset: the nearest that the plane of the arm comes to it. On the axis the
    yaw is NaN.
    """
    x, y = floats(x), floats(y)
    square = x * x + y * y - f.lateral * f.lateral
    rho = np.sqrt(np.maximum(square, 0)) * np.where(ints(back) != 0, -1.0, 1.0)
    yaw = truth.angle(x, y) - np.where(square < 0, math.copysign(math.pi / 2, f.lateral),
                                       np.arctan2(f.lateral, rho))
    return rho - f.shoulder, floats(z) - f.base, yaw


def ik3(x: ArrayLike, y: ArrayLike, z: ArrayLike, l1: float, l2: float, f: Frame, elbow: ArrayLike = 0,
        back: ArrayLike = 0) -> tuple[Floats, Floats, Floats]:
    """The machine's joints for a target, or for the nearest point of the arm's plane; NaN as `truth.ik3`."""
    radius, height, yaw = plane(x, y, z, back, f)
    theta1, theta2 = truth.ik2(radius, height, l1, l2, elbow)
    return theta1, theta2 - f.turn + (theta1 if f.absolute else 0), yaw + 0 * theta2


def nearest(target: ArrayLike, l1: float, l2: float, f: Frame, back: ArrayLike = 0) -> Floats:
    """The tip (..., 3) that `ik3` answers for each target (..., 3): nearest in the arm's plane; NaN on the axis."""
    x, y, z = np.moveaxis(floats(target), -1, 0)
    radius, height, yaw = plane(x, y, z, back, f)
    inside = truth.nearest(np.stack([radius, height], axis=-1), l1, l2)
    rho, z = inside[..., 0] + f.shoulder, inside[..., 1] + f.base
    c3, n3 = truth.unit(yaw)
    return np.stack([rho * c3 - f.lateral * n3, rho * n3 + f.lateral * c3, z], axis=-1)


def reachable(target: ArrayLike, l1: float, l2: float, f: Frame, back: ArrayLike = 0) -> Floats:
    """How far (a length) each target (..., 3) is inside what the arm reaches; negative: out of reach by so much."""
    x, y, z = np.moveaxis(floats(target), -1, 0)
    radius, height, _ = plane(x, y, z, back, f)
    far = np.hypot(radius, height)
    return np.minimum(np.minimum(l1 + l2 - far, far - abs(l1 - l2)), np.hypot(x, y) - abs(f.lateral))
