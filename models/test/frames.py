"""Arms as products of 4 x 4 matrices, written from their sources; nothing of the models under test is imported.

A frame is an array (..., 4, 4); a chain takes joint angles (..., n), radians, and lengths in any unit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def turn(axis: str, angle: Floats) -> Floats:
    """A rotation about an axis of the frame."""
    angle = np.asarray(angle, dtype=float)
    frame = np.zeros((*angle.shape, 4, 4)) + np.eye(4)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    frame[..., i, i] = frame[..., j, j] = np.cos(angle)
    frame[..., j, i] = np.sin(angle)
    frame[..., i, j] = -np.sin(angle)
    return frame


def shift(x: float | Floats = 0.0, y: float | Floats = 0.0, z: float | Floats = 0.0) -> Floats:
    """A translation along the axes of the frame."""
    x, y, z = np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in (x, y, z)))
    frame = np.zeros((*x.shape, 4, 4)) + np.eye(4)
    frame[..., :3, 3] = np.stack([x, y, z], axis=-1)
    return frame


def wrist_arm(q: Floats, a1: float, a2: float, b: float, c1: float, c2: float, c3: float, c4: float) -> Floats:
    """Ortho-parallel base with a spherical wrist: M. Brandstoetter, A. Angerer, M. Hofbaur, "An analytical solution of
    the inverse kinematics problem of industrial serial manipulators with an ortho-parallel basis and a spherical wrist"
    (2014), fig. 1."""
    one = np.moveaxis(q, -1, 0)
    return (shift(z=c1) @ turn("z", one[0]) @ shift(x=a1, y=b) @ turn("y", one[1]) @ shift(z=c2) @ turn("y", one[2])
            @ shift(x=a2, z=c3) @ turn("z", one[3]) @ turn("y", one[4]) @ turn("z", one[5]) @ shift(z=c4))


def jacobian(chain, q: Floats, step: float = 1e-5) -> Floats:
    """(..., 6, n) velocity and turn of the end for a rate of each joint, in the base's frame, by central differences.

    The turn is read from the skew part of dR R'.
    """
    columns, here = [], chain(q)
    for i in range(q.shape[-1]):
        off = step * np.eye(q.shape[-1])[i]
        ahead, behind = chain(q + off), chain(q - off)
        change = (ahead - behind) / (2 * step)
        spin = change[..., :3, :3] @ np.swapaxes(here[..., :3, :3], -1, -2)
        turned = np.stack([spin[..., 2, 1] - spin[..., 1, 2], spin[..., 0, 2] - spin[..., 2, 0],
                           spin[..., 1, 0] - spin[..., 0, 1]], axis=-1) / 2
        columns.append(np.concatenate([change[..., :3, 3], turned], axis=-1))
    return np.stack(columns, axis=-1)
