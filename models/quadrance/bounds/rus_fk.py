"""Error bounds of engine_rus_fk, lengths in its unit."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance.truth import Floats, floats

WORD = 2.0**-25
UNEVEN = 32  # words that |q|^2 may be off 1


def line(products: int) -> float:
    """Of a word that is the sum of so many products, in words: half a word, and 1/8 that each of them truncates."""
    return 0.5 + products / 8


# The crank's end: e within line(2), and it counts by the azimuth, (x, z) = F + e (cos, sin); y is a sum of three
ELBOW = float(np.hypot(np.sqrt(2) * (line(2) + line(2) * np.sqrt(0.5)), line(3)))


def rod(tol: float, lb: ArrayLike, joint: ArrayLike, w: int = 27) -> Floats:
    """| |C - B| - LB | of a converged answer, the words of geometry and cranks given and its quaternion made unit.

    Parameters
    ----------
    tol : cfg_tol; lb, joint : arrays of LB and of the ball joint's distance |c| in the platform, in units.
    w : bits of the words that are read.

    Notes
    -----
    Each coordinate of d is within line(5), an entry of the matrix within line(4), so R c within 3 |c|. The miss
    |d|^2 - LB^2 is within line(4), and it was at most tol; it is that of a rod times |d| + LB. A quaternion whose
    square is 1 + e scales R c by as much. Words of less than 27 bits: half of one in each coordinate of the position
    and of the quaternion, which turns by twice its error.
    """
    lb, joint = floats(lb), floats(joint)
    off = ELBOW + np.sqrt(3) * line(5) + (3 * line(4) + UNEVEN + line(5)) * joint
    read = (np.sqrt(3) / 2 + 2 * joint) * 2.0 ** (2 - w) if w < 27 else 0.0
    return ((tol + line(4)) / (2 * lb) + off) * WORD * (1 + 1e-4) + read


def pose(rows: ArrayLike, rods: ArrayLike) -> tuple[Floats, Floats]:
    """(length, angle) that a pose is off at most by misses of its rods (..., 6), to the first order.

    rows : (..., 6, 6) of (C - p) x w and w, w the unit vectors of the rods: what a turn and a shift do to them.
    """
    gain = np.abs(np.linalg.inv(floats(rows))) @ floats(rods)[..., None]
    return np.linalg.norm(gain[..., 3:, 0], axis=-1), np.linalg.norm(gain[..., :3, 0], axis=-1)
