"""Error bounds of the iterative solvers: of where they end, and of every iterate on the way."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from quadrance import codecs
from quadrance.fixed import Ints
from quadrance.iterative import fixed, gradient, newton, newton_fixed
from quadrance.truth import TURN, Floats, floats

Params = dict[str, int]


@cache
def _root(w: int) -> float:
    """Error of a sine or cosine: as `bounds.table_sine`, of the table of the engines."""
    k, t = w + 1, (w + 4) // 2
    knots, place = codecs.sine_knots(k, t), np.linspace(0, 1, 33)[:, None]
    exact = np.sin(TURN / 2**t * (np.arange(2**t) + place)) * 2**k
    error = knots[:-1] + np.diff(knots) * place - exact
    return float(max(error.max(), 1 - error.min())) / 2**k


def tip(p: Params, l1: float, l2: float, square: ArrayLike) -> Floats:
    """Distance in LSB of the tip of the answered joints from the target, where out_error is `square`, not coarse.

    Both squares are truncated by up to 1/256 LSB^2. Each axis of E lacks what two products lose, 1/64 LSB each, and
    errs by a root for each link.
    """
    return np.sqrt(16 * (floats(square) + 2)) / 64 + np.sqrt(2) * (2 / 64 + _root(p["W"]) * (l1 + l2))


def drift(p: Params, start: Ints, target: Ints, cfg: dict[str, int], steps: int) -> tuple[Floats, Floats]:
    """Float64 joints (steps + 1, 2) of the recursion, and how far the engine's can be from them, radians (steps + 1).

    Beyond the float step, alpha (E + dE) x (link + dL): dE is what `tip` counts on each axis, a unit of the range's
    word where that is coarse, and a unit of alpha E; dL is a root and half an LSB; a step is cut by up to two units of
    a joint word. An error d before a step is |1 - alpha H| d + M d^2 / 2 after it, H the Hessian of E^2 / 2 by
    differences of the float step, M a bound of its third derivatives. The start of the range is not known: coarse.
    """
    l1, l2 = cfg["cfg_l1"], cfg["cfg_l2"]
    reach, alpha = l1 + l2, fixed.alpha(p, cfg["cfg_alpha"], cfg["cfg_shift"])
    arm, goal = gradient.planar(l1, l2), floats(target)
    share, root = cfg["cfg_alpha"] / 2 ** (p["W"] + 1), _root(p["W"])
    path = gradient.path(arm, floats(start) * TURN / 2 ** p["A"], goal, alpha, steps)
    off = np.zeros(steps + 1)
    for h, theta in enumerate(path[:-1]):
        error = gradient.step(arm, theta, goal, alpha)[1]
        # the finer range is sure where the pass before it was, by this bound, in the finer range or below its border
        size = np.linalg.norm(error) + 2 * reach * off[h]
        unit = 1 / 64 if h and size < 2 ** (p["W"] - 7) else 1 / 4
        each = 2 / 64 + root * reach + unit * (1 + 1 / share)
        links = (l1 + l2, l2)
        made = [alpha * (2 * each * length + np.abs(error).sum() * (n / 2 + root * length)) + 2 * n * TURN / 2 ** p["A"]
                for length, n in zip(links, (2, 1))]
        small = 1e-6
        turn = np.stack([(gradient.step(arm, theta + small * way, goal, alpha)[0]
                          - gradient.step(arm, theta - small * way, goal, alpha)[0]) / (2 * small)
                         for way in np.eye(2)], axis=-1)
        third = alpha * 2 * np.sqrt(2) * reach * (3 * reach + np.linalg.norm(error))
        off[h + 1] = np.linalg.norm(np.eye(2) + turn, ord=2) * off[h] + third * off[h] ** 2 / 2 + np.linalg.norm(made)
    return path, off


def newton_tip(p: Params, lengths: tuple[float, ...], square: ArrayLike) -> Floats:
    """As `tip`, of engine_newton_3r with its three lengths, in LSB: as at W = 16, with lengths aligned to 16 bits."""
    unit = 2.0 ** (p["W"] - 16)
    return unit * (np.sqrt(16 * (floats(square) + 2)) / 64 + np.sqrt(2) * (3 / 64 + _root(16) * sum(lengths) / unit))


def newton_step(p: Params, theta: Floats, wrist: Floats, lengths: tuple[float, float, float]) -> float:
    """How far a Newton step of engine_newton_3r from `theta` is from the float step, radians in any joint.

    Lengths and wrist in units of 16 bits; no damping, no guard, no shift of the step, |sin theta2| from 1/2 on. E errs
    by `newton_tip`'s links and by its unit, E along a link also by two of these units and by roots, a numerator by
    2^-6 of one; relative are D and its square, the reciprocal's factors, its word and the rate; a word is cut.
    """
    exact, gap, sine = newton.wrist_step(theta, wrist, lengths)
    size, root = float(np.linalg.norm(gap)), _root(16)
    unit = 1 / 64 if np.abs(gap).max() < 2**11 - 1 else 1 / 4
    along = np.sqrt(2) * (3 / 64 + root * sum(lengths) + unit + root * size) + 2.25 * unit
    relative = 3 * (root + 2**-17) / abs(sine) + 2**-23 / sine**2 + 2**-13 + 2**-14
    off = [(along + unit / 32 / abs(sine) + size * (relative + 1.5 * length / newton_fixed.STEP)) * 1.01
           / (abs(sine) * length) for length in lengths[:2]]
    return float(sum(off)) + 3 * TURN / 2 ** p["A"]
