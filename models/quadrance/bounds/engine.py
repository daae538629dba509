"""Error bounds of rtl/engine."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance.bounds.six import MINUS
from quadrance.bounds.six import ROOT as RECIPROCAL
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


def quaternion_length(p: dict[str, int]) -> tuple[float, float]:
    """How far |q|^2 of a unit quaternion rounded to words is from 1, and from where on `quaternion_to_matrix` flags it.

    The words are u + d, d half a unit each and of length 1 unit: 2 u.d + d.d is within 2 units + 2^-U units. The core's
    sum is a quarter to half a unit more, by its rounding constants and the truncation of four squares. The limit is
    2^-9, and 4 units where they are more: the power of two above what rounding needs.
    """
    unit = 2.0 ** -p["U"]
    return 2 * unit + unit**2, max(2.0**-9, 4 * unit)


def rotation_apart(p: dict[str, int]) -> float:
    """Distance (Frobenius) from the nearest rotation that a matrix without `rotation_check`'s status can have.

    Its columns a, b, c against the rotation that a and b span, (a / |a|, b' / |b'|, their cross product), b' what of b
    is across a. A length is off by half the slack, b along a by the slack, c by the slack and the one's complement,
    b_i units, in every word, and by a x b, whose length is |a| |b'|.
    """
    unit = 2.0 ** -p["U"]
    slack = 16 * unit
    least = np.sqrt(1 - slack)
    along = slack / least
    across = np.sqrt(1 - slack - along**2)
    third = np.sqrt(3) * (slack + unit * np.sqrt(1 + slack)) + 1 - least * across
    return float(np.sqrt((1 - least) ** 2 + along**2 + (1 - across) ** 2 + third**2))


def _middle(a: Floats, b: Floats) -> tuple[Floats, ...]:
    """The longer one's square, |N|, |V|, and the errors of N and V (see `delta_tip`) of the sides a and b."""
    one, two = np.linalg.norm(a, axis=-1), np.linalg.norm(b, axis=-1)
    area, e = np.maximum(one, two) ** 2, 2.0**-25
    return (area, np.linalg.norm(np.cross(a, b), axis=-1), one * two * np.linalg.norm(a - b, axis=-1),
            0.75 * np.sqrt(3) * e, 0.875 * e * (one + two) + 0.75 * np.sqrt(3) * e * area)


def delta_nearest(p: dict[str, int], elbows: ArrayLike, lb: float) -> Floats:
    """Distance of the tip of `engine_delta_fk` from elbow 1 + LB V x N / |V x N|, where the spheres do not meet, LSB.

    As of `delta_tip`, without the root. The direction is off by the errors of V and N, each over its length, and by
    those of their words' product; the elbows, each off by 2 e on an axis, move a and b by twice that and so V by
    (3 |a| + |b|)(|a| + |b|), N by |a| + |b| times that at most.
    """
    unit, e = 2.0 ** (p["W"] + 2), 2.0**-25
    elbows, lb = floats(elbows) / unit, lb / unit
    a, b = elbows[..., 1, :] - elbows[..., 0, :], elbows[..., 2, :] - elbows[..., 0, :]
    area, n, v, off_n, off_v = _middle(a, b)
    move, sides = 4 * np.sqrt(3) * e, np.linalg.norm(a, axis=-1) + np.linalg.norm(b, axis=-1)
    off_n, off_v = off_n + move * sides, off_v + move * 3 * sides**2
    n, v = np.maximum(n, 1e-300), np.maximum(v, 1e-300)
    turned = off_v / v + off_n / n + 1.5 * np.sqrt(3) * e * area**2 / (v * n)
    length = RECIPROCAL + 0.5 * 0.875 * e * area**4 / (v * n) ** 2
    return (lb * (turned + length) + 4 * np.sqrt(3) * e) * unit


def delta_tip(p: dict[str, int], elbows: ArrayLike, tip: ArrayLike, lb: float) -> tuple[Floats, Floats]:
    """Distance of the tip of `engine_delta_fk` before its rounding from the exact one, and the band of its `gap`.

    Parameters
    ----------
    elbows, tip, lb : arrays (N, 3, 3) and (N, 3), and a length, LSB, of `engine_delta.exact`; the spheres meet.

    Returns
    -------
    tuple of arrays (N): LSB, and LSB^6.

    Notes
    -----
    In words of 2^-25 (e below). A word of k products is off by (1/2 + k / 8) e. Terms:

    - elbows: each is off by 2 e (radius and products 3/4 e each), which moves the tip by the inverse of the rods'
      directions.
    - N by 0.75 e a word; V by 0.875 e of each square and 0.75 e of its words, which are scaled up by 1 / A^2 at least,
      A the longer of |a|, |b|, as are all that follow; so is the gap, D: its words 2 LB N by 5/8 e, their squares by
      1.25 e.
    - sqrt(D) by the gap's error over it, by `MINUS` of the table, and 5/8 e.
    - Q = V x N -+ N sqrt(D) by all of them and twice 0.75 e a word, LB of that over |Q| = 2 LB N^2.
    - the length LB by `RECIPROCAL`, by half the error of |Q|^2, 0.875 e, and two words.
    """
    unit, e = 2.0 ** (p["W"] + 2), 2.0**-25
    elbows, tip, lb = floats(elbows) / unit, floats(tip) / unit, lb / unit
    a, b = elbows[..., 1, :] - elbows[..., 0, :], elbows[..., 2, :] - elbows[..., 0, :]
    area, n, v, off_n, off_v = _middle(a, b)
    d = 4 * lb**2 * n**2 - v**2
    word = np.sqrt(3) * e
    off_d = 2 * 2 * lb * n * (0.625 * word * area + 2 * lb * off_n) + 2 * v * off_v + 1.25 * e * area**2
    h = np.sqrt(np.maximum(d, 1e-300))
    off_h = off_d / h + MINUS * h + 0.625 * e * area
    off_q = off_v * n + (v + h) * off_n + n * off_h + 1.5 * word * area**2
    rods = (tip[..., None, :] - elbows) / lb
    moved = np.linalg.norm(np.linalg.pinv(rods), ord=2, axis=(-2, -1)) * np.sqrt(3) * 2 * e
    q = 2 * lb * n**2
    length = lb * (RECIPROCAL + 0.5 * 0.875 * e * area**4 / q**2) + 2 * word
    return (moved + off_q / (2 * n**2) + length) * unit, off_d * unit**6
