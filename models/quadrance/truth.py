"""This module has the float64 kinematics and joint codings with which every model is compared.

Angles are in radians, counter-clockwise; lengths share one unit, the same for links and coordinates.
Every function is vectorised: its arguments broadcast, its results have the broadcast shape.

Joint 1 is the shoulder, joint 2 the elbow (relative to link 1), joint 3 the yaw of the plane they move in.
The source of the equations is R. Martinez et al., "Efficient FPGA Hardware Implementation for Robot
Manipulator Kinematic Modeling Using Rational Trigonometry", in the vector form of this library.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quadrance.fixed import Ints, ints

Floats = NDArray[np.float64]
TURN = 2 * np.pi


def floats(value: ArrayLike) -> Floats:
    """`value` as a float64 array (shape kept)."""
    return np.asarray(value, dtype=np.float64)


# Forward kinematics


def fk1(theta1: ArrayLike, l1: ArrayLike) -> tuple[Floats, Floats]:
    """Tip (x, y) of one link: eqs. 51-52 with the signs of Table I."""
    c1, n1 = unit(theta1)
    return l1 * c1, l1 * n1


def fk2(theta1: ArrayLike, theta2: ArrayLike, l1: ArrayLike, l2: ArrayLike) -> tuple[Floats, Floats]:
    """Tip (x, y) of two links in the plane: eqs. 84 and 96, what eqs. 11-17 and Table II mean."""
    c12, n12 = unit(floats(theta1) + theta2)
    x1, y1 = fk1(theta1, l1)
    return x1 + l2 * c12, y1 + l2 * n12


def fk3(theta1: ArrayLike, theta2: ArrayLike, theta3: ArrayLike, l1: ArrayLike,
        l2: ArrayLike) -> tuple[Floats, Floats, Floats]:
    """Tip (x, y, z) of two links in a vertical plane that yaws by `theta3`: eqs. 24-31.

    rho keeps its sign (the paper squares it away), so a link that leans backwards past the yaw axis
    lands beyond it.
    """
    rho, z = fk2(theta1, theta2, l1, l2)
    c3, n3 = unit(theta3)
    return rho * c3, rho * n3, z


def tip(angles: ArrayLike, l1: ArrayLike, l2: ArrayLike) -> Floats:
    """Tip (..., 3) of one, two or three joints (..., joints), by `fk1`, `fk2`, `fk3`; one joint moves the first link.

    z = 0 with one and two joints, whose plane is (x, y).
    """
    theta = np.moveaxis(floats(angles), -1, 0)
    axes = fk1(*theta, l1) if len(theta) == 1 else (fk2 if len(theta) == 2 else fk3)(*theta, l1, l2)
    return np.stack([*axes, *[np.zeros_like(axes[0])] * (3 - len(axes))], axis=-1)


def mff(s_theta: ArrayLike, s_phi: ArrayLike, octant: ArrayLike, quadrance: ArrayLike) -> Floats:
    """Joint positions of a chain of links given in the fixed frame (Section IV-D, method MFF).

    Parameters
    ----------
    s_theta, s_phi : float arrays (..., links), in [0, 1]
        Spread of the azimuth, measured from the y axis, and of the inclination, measured from +z.
    octant : int array (..., links), 1 to 8
        Row of the sign matrix; the paper prints row V twice, the rows here are I...VIII as they must be.
    quadrance : float array (..., links)
        Squared length of each link.

    Returns
    -------
    float array (..., links, 3)
        (x, y, z) of the end of each link: the running sum of the links' vectors.
    """
    s_theta, s_phi, quadrance = floats(s_theta), floats(s_phi), floats(quadrance)
    links = np.stack([np.sqrt(s_theta * s_phi * quadrance), np.sqrt((1 - s_theta) * s_phi * quadrance),
                      np.sqrt((1 - s_phi) * quadrance)], axis=-1)
    return np.cumsum(OCTANT_SIGNS[ints(octant) - 1] * links, axis=-2)


OCTANT_SIGNS = np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1],
                         [1, 1, -1], [-1, 1, -1], [-1, -1, -1], [1, -1, -1]], dtype=np.float64)


# Inverse kinematics


def ik1(x: ArrayLike, y: ArrayLike) -> Floats:
    """Direction of (x, y) in (-pi, pi], NaN at the origin: eq. 9 with the quadrant of Table I."""
    return angle(x, y)


def ik2(x: ArrayLike, y: ArrayLike, l1: ArrayLike, l2: ArrayLike,
        elbow: ArrayLike = 0) -> tuple[Floats, Floats]:
    """Joints (theta1, theta2) that put the tip of two links at (x, y), or at the nearest point in reach.

    The vector form of eqs. 18-23, which as printed lose the elbow and the quadrant of theta1.

    Parameters
    ----------
    x, y : float arrays
        Target.
    l1, l2 : float arrays
        Link lengths, both positive.
    elbow : int array
        0: theta2 in [0, pi]; 1: theta2 in [-pi, 0].

    Returns
    -------
    theta1, theta2 : float arrays
        theta1 is NaN where the target is the shoulder itself: every direction is then as good.
    """
    x, y, l1, l2 = floats(x), floats(y), floats(l1), floats(l2)
    q3 = x * x + y * y
    c2 = np.clip((q3 - l1 * l1 - l2 * l2) / (2 * l1 * l2), -1, 1)
    # 1 - c2^2 from the sides of the triangle: exact at the edges of the reachable annulus, where it cancels
    n2 = np.sqrt(np.maximum(((l1 + l2) ** 2 - q3) * (q3 - (l1 - l2) ** 2), 0)) / (2 * l1 * l2)
    n2 = np.where(ints(elbow) != 0, -n2, n2)
    k1, k2 = l1 + l2 * c2, l2 * n2
    theta1 = np.where(q3 > 0, np.arctan2(k1 * y - k2 * x, k1 * x + k2 * y), np.nan)
    return theta1, np.arctan2(n2, c2)


def ik3(x: ArrayLike, y: ArrayLike, z: ArrayLike, l1: ArrayLike, l2: ArrayLike, elbow: ArrayLike = 0,
        back: ArrayLike = 0) -> tuple[Floats, Floats, Floats]:
    """Joints (theta1, theta2, theta3) for the target (x, y, z): eqs. 32-40 in vector form.

    `elbow` as in `ik2`. `back` = 1 turns the yaw round and reaches over the shoulder (rho < 0), so that the
    four (elbow, back) give every solution. theta3 is NaN on the yaw axis (x = y = 0); there theta1 and
    theta2 are those of rho = 0.
    """
    x, y = floats(x), floats(y)
    sign = np.where(ints(back) != 0, -1.0, 1.0)
    theta1, theta2 = ik2(sign * np.hypot(x, y), z, l1, l2, elbow)
    return theta1, theta2, angle(sign * x, sign * y) + 0 * theta2


def reach(x: ArrayLike, y: ArrayLike, l1: ArrayLike, l2: ArrayLike) -> Floats:
    """Distance from (x, y) to the annulus that two links reach: 0 inside, positive too far, negative too near."""
    radius, far, near = np.hypot(x, y), floats(l1) + l2, np.abs(floats(l1) - l2)
    return np.where(radius > far, radius - far, np.minimum(radius - near, 0.0))


def nearest(target: ArrayLike, l1: ArrayLike, l2: ArrayLike) -> Floats:
    """The point of the reachable annulus (or shell) nearest to each target (..., 3); the base has none, and stays."""
    target = floats(target)
    radius = np.linalg.norm(target, axis=-1, keepdims=True)
    reachable = np.clip(radius, np.abs(floats(l1) - l2), floats(l1) + l2)
    return target * np.where(radius > 0, reachable / np.where(radius > 0, radius, 1), 1)


# Directions and their codings


def unit(theta: ArrayLike) -> tuple[Floats, Floats]:
    """Unit vector (cos, sin) of an angle."""
    return np.cos(theta), np.sin(theta)


def angle(c: ArrayLike, n: ArrayLike) -> Floats:
    """Angle of the vector (c, n) of any length in (-pi, pi], NaN for the null vector."""
    return np.where((floats(c) == 0) & (floats(n) == 0), np.nan, np.arctan2(n, c))


def difference(a: ArrayLike, b: ArrayLike) -> Floats:
    """a - b the short way round, in [-pi, pi)."""
    return np.mod(floats(a) - b + np.pi, TURN) - np.pi


def spread_word_to_angle(word: ArrayLike, s: int) -> Floats:
    """Angle of a turn-spread word (2 + s bits, or any real number of its LSB), in [0, 2 pi).

    Quadrant k = word >> s, fraction f. The spread is f in quadrants 1 and 3, 1 - f in 2 and 4 (Table I read
    so that the motion is continuous), which is sin^2 of the angle past the quadrant's start in all four.
    """
    word = np.mod(floats(word), 2.0 ** (s + 2))
    quadrant = np.floor(word * 2.0**-s)
    fraction = word * 2.0**-s - quadrant
    return quadrant * (np.pi / 2) + np.arctan2(np.sqrt(fraction), np.sqrt(1 - fraction))


def angle_to_spread(theta: ArrayLike, s: int) -> Floats:
    """Turn-spread of an angle as a real number of LSB in [0, 4 * 2^s)."""
    quarters = np.mod(floats(theta), TURN) / (np.pi / 2)
    quadrant = np.floor(quarters)
    fraction = np.sin((quarters - quadrant) * (np.pi / 2)) ** 2
    return np.mod((quadrant + fraction) * 2.0**s, 2.0 ** (s + 2))


def angle_to_spread_word(theta: ArrayLike, s: int) -> Ints:
    """Turn-spread word whose spread is nearest to that of an angle, in [0, 4 * 2^s)."""
    return np.floor(angle_to_spread(theta, s) + 0.5).astype(np.int64) & ((4 << s) - 1)


def binary_word_to_angle(word: ArrayLike, a: int) -> Floats:
    """Angle of a binary angle word, a full turn is 2^a; signed and unsigned words alike. In [0, 2 pi)."""
    return np.mod(floats(word), 2.0**a) * (TURN * 2.0**-a)


def angle_to_binary_word(theta: ArrayLike, a: int) -> Ints:
    """Binary angle word nearest to an angle, in [0, 2^a)."""
    return np.floor(floats(theta) * (2.0**a / TURN) + 0.5).astype(np.int64) & ((1 << a) - 1)


def half_tangent(theta: ArrayLike) -> Floats:
    """t = tan(theta / 2); infinite at half a turn."""
    c, n = unit(theta)
    with np.errstate(divide="ignore", over="ignore"):
        return np.where(c > 0, n / (1 + np.abs(c)), np.divide(1 + np.abs(c), n))


def half_tangent_to_unit(t: ArrayLike) -> tuple[Floats, Floats]:
    """Unit vector ((1 - t^2) / (1 + t^2), 2 t / (1 + t^2)): rational in t."""
    t = floats(t)
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
