"""Error bounds of rtl/paper."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from quadrance.paper import DIGITS
from quadrance.truth import Floats

Params = dict[str, int]


def reach(p: Params) -> float:
    """Distance of the tip of paper_fk2 and paper_fk3 where it is near 2^I units, LSB, by which overflow is told.

    b is truncated by 2^(I-N) units and the sign of its term is a one's complement, half of that; Q2 and acc^2 and the
    two products by 2^-G each, of a quadrance: over twice the distance.
    """
    i = p["W"] - 1 - p["F"]
    n = max(p["S"] + 1, p["W"] - 1)
    g = min(p["S"], 27 - 2 * i, 2 * (n + 1 - i))
    return 2.0 ** p["F"] * (1.5 * 2.0 ** (i - n) + 4 * 2.0**-g / 2 ** (i + 1))


def forward(p: Params, joints: int, l1: float, l2: float) -> float:
    """Tip of paper_fk2 and paper_fk3, as a distance; shown at S = 8 and 24 of Q7.8.

    A spread that is off by e is an angle off by at most asin sqrt(e) (sin(a-b) sin(a+b) = e, and sin(a+b) >= sin(a-b)).
    s' is truncated by 2^-D; the complement 1 - s' by 2^-Q; d by less than 2^-N, so d^2 with its own truncation by
    3 * 2^-N. The quadrances Q2, acc^2 and (three joints) qa are each truncated by 2^-G, which moves a side by at most
    2^(-G/2) units; b is truncated by 2^(I-N) units. sqrt(n) for the coordinates' own truncation.
    """
    i = p["W"] - 1 - p["F"]
    n = max(p["S"] + 1, p["W"] - 1)
    g = min(p["S"], 27 - 2 * i, 2 * (n + 1 - i))
    d, q = DIGITS * -(-(p["S"] + 1) // DIGITS), 2 * i + g
    share = 2.0 ** (-d / 2) + math.sqrt(3 * 2.0**-n) + 2.0 ** (-q / 2)
    units = (joints + 1) * 2.0 ** (-g / 2) + 2.0 ** (i - n)
    return (l1 + l2) * share + 2.0 ** p["F"] * units + math.sqrt(joints)


def share(p: Params) -> int:
    """Digits D of a share (a quotient) in paper_ik2 and paper_ik3."""
    return p["R"] * -(-(p["S"] + 3) // p["R"])


def turned(spread: ArrayLike) -> Floats:
    """How far a spread that is off by `spread` moves the end of a unit length: the chord of asin sqrt(spread)."""
    return 2 * np.sin(np.arcsin(np.sqrt(np.minimum(spread, 1))) / 2)


def _words(p: Params) -> tuple[int, int, int, int, float]:
    """D, N, the digits of a base angle's spread and of a tip's, and u, LSB, by which a quadrance moves a side."""
    i, d = p["W"] - 1 - p["F"], share(p)
    g = min(p["S"], 2 * p["F"])
    unit = 0.0 if g == 2 * p["F"] else 2.0 ** (p["F"] - g / 2)
    return d, min(d, 26), min(2 * i + g, 27), max(d, p["W"]), unit


def inverse(p: Params, joints: int, l1: float, l2: float) -> float:
    """Tip of paper_ik2 and paper_ik3 for a target in reach whose direction is defined, LSB; any W, F, S, R.

    By the rule of `forward`, r = L1 + L2:

    * sa and s' are truncated by 2^-D, at the distance of the target: 2 r 2^(-D/2).
    * cos theta2 is truncated by 2^-D, or by 2^-26 where D is 27, so s2 by 2^(1-N); the square of it by 2^-right more.
      Either turns joint 2 and, as s' = s2 Q2 / q3, beta at the distance sqrt(q3): L2 each.
    * d is the difference of two roots, each cut by less than 2^-N; d^2 is off by 2^(1-N) (1 + 2^-N): r.
    * Q2 is cut to one DSP factor of `left` bits, 4^I 2^-left, and its product with s2 by 2^-G: over q3 and at sqrt(q3)
      the root of their sum. (The chord of a spread e of 1 is sqrt(2 e): the factor for a target no longer than that.)
    * Where G < 2F every quadrance is cut by u^2. A target of n coordinates is seen off by sqrt(n) u, which turns sa,
      and as much by q3 below s'; c and 2 L1 L2 are off by (n + 1) u^2 together, so s2 by that over L1 L2, which turns
      joint 2 and beta at L2; and which side of 90 degrees beta is on is known to (n + 1) u^2 / L1 across. No tip is
      farther off than 2 r.
    * Three joints: the yaw is a share too, r 2^(-D/2), of two coordinates, sqrt(2) sqrt(2) u.
    """
    i = p["W"] - 1 - p["F"]
    d, n, left, right, u = _words(p)
    reach, lost = l1 + l2, 2.0 ** (1 - n)
    spreads = reach * (2 * turned(2.0**-d) + turned(lost * (1 + 2.0**-n))) \
        + l2 * (turned(lost) + turned(lost + 2.0**-right))
    sides = 2.0 ** p["F"] * math.sqrt(2 * (4.0**i * 2.0**-left + 2.0 ** -min(p["S"], 2 * p["F"])))
    if u and l1:
        sides += 2 * u * (math.sqrt(2 * joints) + math.sqrt(2 * (joints + 1) * l2 / l1)) + (joints + 1) * u * u / l1
    if joints == 3:
        spreads, sides = spreads + reach * turned(2.0**-d), sides + 2 * u
    return 2 * reach if u and not l1 else min(float(spreads + sides), 2 * reach)


def nearest(p: Params, joints: int, r: ArrayLike) -> Floats:
    """Angle (rad) of joint 1 from the nearest point's, of a target out of reach at distance r (LSB).

    s' is 0, or its complement, off by 2^-left; sa is off by 2^-D and d^2 by 2^(1-N), as in `inverse`; and where
    G < 2F the target is seen off by sqrt(n) u, which turns it by asin of that over r.
    """
    d, n, left, _, u = _words(p)
    shares = sum(math.asin(math.sqrt(spread)) for spread in (2.0**-d, 2.0**-left, 2.0 ** (1 - n) * (1 + 2.0**-n)))
    return shares + np.arcsin(np.minimum(math.sqrt(joints) * u / np.maximum(r, 1e-9), 1))
