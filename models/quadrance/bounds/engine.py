"""Error bounds of rtl/engine."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance.truth import Floats, floats

FINE = 16  # G and S have 4 fraction bits below the LSB of 18 bits
JOINT = 256  # the ball joint has 8
ROOT = 2.0**-16  # relative, of a root whose radicand is at least 2^-5 after normalising; next to 0 it is greater
TURNED, OWN, ALONG = np.sqrt(2), 1.0, 2.0
"""LSB / JOINT, worst case each. Every word is truncated twice, by less than 1 a time, and 1 is added: within 1. So are
x and z, which reach (e, h) as a turned vector, and e and h themselves; f is y with a third truncation, from -2 to 1."""


def rus_joint() -> float:
    """Error of (e, f, h) of `engine_rus_ik`, the ball joint as its leg sees it, in LSB of 18 bits."""
    return float(np.hypot(TURNED + np.sqrt(2) * OWN, ALONG)) / JOINT


def rus_gain(la: float, flat: ArrayLike) -> Floats:
    """Error of G in LSB of 18 bits, (e, f, h) given; `la` the crank, `flat` sqrt(e^2 + f^2) >= |G| in the same.

    In units of 2^16 fine LSB^2, before the product with 1 / 2 LA: the sum of squares, truncated to 4 units, behind two
    truncations to 2^-8, with 2 of them made up for, and half a unit of cfg_k: 2.51. Behind it half a fine LSB about the
    mean, and half a unit of cfg_c = 2^38 / LA.
    """
    return (2.51 * 2.0**16 / (2 * la * FINE) + 0.5) / FINE + floats(flat) * la / 2.0**39


def rus_angle(la: float, lb: float, root: ArrayLike, flat: ArrayLike) -> Floats:
    """Crank angle of `engine_rus_ik` in radians beyond the rounding of its inputs, legs in reach.

    Parameters
    ----------
    la, lb : crank and rod, LSB of 18 bits.
    root, flat : arrays of S and sqrt(e^2 + f^2), in the same; S^2 above `rus_band`.

    Notes
    -----
    e cos + f sin = G and LA dG = e de + f df + h dh, so S da = (rod . (de, df, dh)) / LA + dG with
    rod = (e - LA cos, f - LA sin, h), of length LB: what errs is the joint along the rod, LB / LA times. That over S is
    the law 1/S of a leg that is nearly stretched. On the way to the erring words S^2 falls by `rus_band` at most. The
    root's own error, ROOT S and a fine LSB, turns the answer by at most that over flat; the word adds sqrt(1/2) 2^-16,
    and the truncated numerators 2^-19 and a fine LSB^2 over flat^2 each.
    """
    root, flat = floats(root), floats(flat)
    off = rus_joint() * lb / la + rus_gain(la, flat)
    least = np.sqrt(np.maximum(root**2 - rus_band(la + lb, la, flat), 1e-9))
    return (off / least + (ROOT * root + 1 / FINE) / flat + np.sqrt(0.5) * 2.0**-16 + 2.0**-19
            + np.sqrt(2) / (FINE * flat) ** 2)


def rus_worst(la: float, lb: float, share: float) -> float:
    """Greatest `rus_angle` of a root of `share` cranks and more, wherever the joint is: radians.

    Term by term: S is least; the errors of G and S^2 are those of the longest flat, LA + LB; the root's own turns the
    answer by ROOT S / flat <= ROOT and a fine LSB over the shortest flat, which is S itself.
    """
    root = share * la
    least = root * np.sqrt(1 - rus_band(la + lb, la, la + lb) / root**2)
    return float((rus_joint() * lb / la + rus_gain(la, la + lb)) / least + ROOT + 1 / (FINE * root)
                 + np.sqrt(0.5) * 2.0**-16 + 2.0**-19 + np.sqrt(2) / (FINE * root) ** 2)


def rus_band(distance: ArrayLike, la: float, flat: ArrayLike) -> Floats:
    """Error of S^2 = flat^2 - G^2 in LSB^2; `distance` |d|, of a leg in reach LA + LB at most.

    flat moves with the joint, G by |d| / LA times that and by its own error, and |G| <= flat where reach ends. The
    square of flat is truncated to a fine LSB^2.
    """
    move = rus_joint() * (1 + floats(distance) / la) + rus_gain(la, flat)
    return 2 * floats(flat) * move + move**2 + 1 / FINE**2
