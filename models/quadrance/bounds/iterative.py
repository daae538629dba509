"""These are the error bounds of the iterative solvers: of the point where they end, and of every iterate."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from quadrance.bounds import codec
from quadrance.fixed import Ints
from quadrance.iterative import fixed, gradient, newton, newton_fixed
from quadrance.truth import TURN, Floats, floats

Params = dict[str, int]


@cache
def _root(w: int) -> float:
    """Error of a sine or cosine of the engines' table."""
    return codec.sine(w + 1, (w + 4) // 2)


def tip(p: Params, *links: float, square: ArrayLike, cut: int | None = None) -> Floats:
    """Distance in LSB of the tip of the answered joints from the target, where out_error is `square`, not coarse.

    Both squares are truncated by up to 1/256 LSB^2. Each axis of E lacks what the products of `cut` links lose, 1/64
    LSB each, and errs by a root for each link. All links are cut the same way, but in engine_quaternion_gd_plane every
    other one: there `cut` is half of them, rounded up.
    """
    cut = len(links) if cut is None else cut
    return np.sqrt(16 * (floats(square) + 2)) / 64 + np.sqrt(2) * (cut / 64 + _root(p["W"]) * sum(links))


def tip_vector(square: ArrayLike) -> Floats:
    """As `tip`, from the tip of the answered directions as they are: a product of a word and a length is exact.

    `length` bounds how far they are from length 1.
    """
    return np.sqrt(16 * (floats(square) + 2)) / 64 + np.sqrt(2) * 2 / 64


def length(p: Params, step: ArrayLike) -> Floats:
    """How far the length of a direction is from 1 after a step of at most 1/2, in 1.

    The Newton step leaves 3/8 d^4 + d^6 / 4, and what it does not know: half a unit of each word under the squares,
    twice two truncations of a square, those of the products (a unit of 2^-(W+4) four times), and the answer's rounding.
    """
    d = np.abs(floats(step))
    unit = 2.0 ** -p["W"]
    return 0.375 * d**4 + d**6 / 4 + unit * (np.sqrt(2) * (1 / 2 + 1 / 2) + 6 / 16) * (1 + d)


def tip_touch(p: Params, l1: float, l2: float, target: ArrayLike, square: ArrayLike) -> Floats:
    """As `tip`, of the Geomagic Touch: v lacks what four products lose, u and w two; the yaw errs by two roots.

    `target` (..., 3) in LSB.
    """
    lost, root, goal = 1 / 64, _root(p["W"]), floats(target)
    flat = np.abs(goal[..., 0]) + np.abs(goal[..., 2])
    along, across, up = 4 * lost + root * (l1 + l2 + flat), 2 * lost + root * flat, 2 * lost + root * (l1 + l2)
    return np.sqrt(16 * (floats(square) + 3)) / 64 + np.sqrt(along**2 + across**2 + up**2)


def _each(p: Params, links: Sequence[float], word: int, unit: float) -> float:
    """What each axis of E errs by, LSB: as in `tip`, a unit of the range, and a unit of alpha E."""
    return len(links) / 64 + _root(p["W"]) * sum(links) + unit * (1 + 2 ** (p["W"] + 1) / word)


def drift(p: Params, start: Ints, target: Ints, cfg: dict[str, int], steps: int) -> tuple[Floats, Floats]:
    """Float64 joints (steps + 1, 2) of the recursion, and how far the engine's can be from them, radians (steps + 1).

    Beyond the float step, alpha (E + dE) x (link + dL): dE is what `tip` counts on each axis, a unit of the range's
    word where that is coarse, and a unit of alpha E; dL is a root and half an LSB; a step is cut by up to two units of
    a joint word.
    """
    l1, l2 = cfg["cfg_l1"], cfg["cfg_l2"]
    alpha, root = fixed.alpha(p, cfg["cfg_alpha"], cfg["cfg_shift"]), _root(p["W"])

    def made(error: Floats, unit: float) -> Floats:
        each = _each(p, (l1, l2), cfg["cfg_alpha"], unit)
        return floats([alpha * (2 * each * length + np.abs(error).sum() * (n / 2 + root * length))
                       + 2 * n * TURN / 2 ** p["A"] for length, n in ((l1 + l2, 2), (l2, 1))])

    return _drift(p, gradient.planar(l1, l2), l1 + l2, alpha, floats(start), floats(target), steps, made)


def touch_drift(p: Params, start: Ints, target: Ints, cfg: dict[str, int], steps: int) -> tuple[Floats, Floats]:
    """As `drift`, of the Geomagic Touch: dE is that of `tip_touch` with the unit of its range and of alpha E.

    Its axes are turned by the yaw. Joint 1 takes both links, the others one each, of two axes of E.
    """
    l1, l2, goal = cfg["cfg_l1"], cfg["cfg_l2"], floats(target)
    alpha, root = fixed.alpha(p, cfg["cfg_alpha"], cfg["cfg_shift"]), _root(p["W"])
    yaw = np.abs(goal[[0, 2]]).sum()

    def made(error: Floats, unit: float) -> Floats:
        each = 2 / 64 + root * yaw + _each(p, (l1, l2), cfg["cfg_alpha"], unit)
        size = np.sqrt(2) * np.linalg.norm(error)
        return floats([alpha * (2 * each * length + size * (n / 2 + root * length)) + 2 * n * TURN / 2 ** p["A"]
                       for length, n in ((l1 + l2, 2), (l1, 1), (l2, 1))])

    return _drift(p, gradient.touch(l1, l2), l1 + l2, alpha, floats(start), goal, steps, made)


def vector_drift(p: Params, start: Ints, target: Ints, cfg: dict[str, int], steps: int) -> tuple[Floats, Floats]:
    """As `drift`, of the engine of unit vectors: directions (steps + 1, 2, 2), and their distance as vectors of four.

    dE has no root; its words lose half a unit of 2^-W a coordinate, and so has the link. A step d is cut by a unit of
    2^-(W+4) for each link's share, a turn and a scaling by two each, and the scale knows the length to 2^-W. The
    matrix is that of the float step by differences, which a step cut at 1/2 follows too; of its second derivative we
    take twice the differences.
    """
    lengths = floats([cfg["cfg_l1"], cfg["cfg_l2"]])
    reach, alpha = lengths.sum(), fixed.alpha_vector(p, cfg["cfg_alpha"], cfg["cfg_shift"])
    share, word = cfg["cfg_alpha"] / 2 ** (p["W"] + 1), 2.0 ** -p["W"]
    path = gradient.vector_path(tuple(lengths), floats(start).reshape(2, 2) * word, target, alpha, steps)
    off = np.zeros(steps + 1)

    def map_of(links: Floats) -> Floats:
        return gradient.vector_step(tuple(lengths), links.reshape(-1, 2, 2), target, alpha)[0].reshape(links.shape)

    def matrix(links: Floats, small: float = 1e-6) -> Floats:
        ways = small * np.eye(4)
        return (map_of(links + ways) - map_of(links - ways)).T / (2 * small)

    for h, links in enumerate(path[:-1].reshape(-1, 4)):
        error = gradient.vector_step(tuple(lengths), links.reshape(2, 2), target, alpha)[1]
        size = np.linalg.norm(error) + 2 * reach * off[h]
        unit = 1 / 64 if h and size < 2 ** (p["W"] - 7) else 1 / 4
        each = 2 / 64 + word / 2 * reach + unit * (1 + 1 / share)
        # of d: link 1 turns by both shares, link 2 by its own once more
        made = [alpha * (2 * each * link + np.abs(error).sum() * (n / 2 + word / 2 * link)) + 2 * n * word / 16
                for link, n in ((reach, 2), (reach + lengths[1], 3))]
        here = matrix(links)
        bend = 2 * max(np.linalg.norm(matrix(links + 1e-3 * way) - here, ord=2) / 1e-3 for way in np.eye(4))
        grown = np.linalg.norm(here, ord=2) * off[h] + bend * off[h] ** 2
        off[h + 1] = grown + np.linalg.norm(made) + 2 * (word * np.sqrt(2) + 4 * word / 16)
    return path, off


def plane_step(p: Params, links: Sequence[float], cfg: dict[str, int], error: Floats, unit: float) -> Floats:
    """How far the step of each joint of engine_quaternion_gd_plane can be from alpha E J, radians; |E| is `error`, LSB.

    Joint i moves by (target - links before it) x (alpha E + d), which is the float step where both are exact, since
    E x alpha E is 0. Each axis of d is alpha times `_each`; the lever is that of the links from i on, and E long at
    most; it errs by half an LSB for the target and for every link before it, and by their roots. The product of the
    target and those of the links lose a unit of 2^-(2 cfg_shift, and 4 where the unit is fine) each way. The step loses
    half a unit of a joint word; where the unit is not fine a whole one, less the 8 that are there for the fine one.
    """
    alpha, longest = fixed.alpha(p, cfg["cfg_alpha"], cfg["cfg_shift"]), np.linalg.norm(error)
    count, links = np.arange(1, len(links) + 1), floats(links)
    behind = links[::-1].cumsum()[::-1]
    off = alpha * _each(p, links, cfg["cfg_alpha"], unit)
    lever = count / 2 + _root(p["W"]) * (links.sum() - behind)
    fine = unit < 1 / 4
    cut = (0.5 if fine else 8) + 2 * count / 4.0 ** (cfg["cfg_shift"] + 2 * fine)
    return np.sqrt(2) * (behind + longest) * off + lever * (np.sqrt(2) * alpha * longest + 2 * off) \
        + cut * TURN / 2 ** p["A"]


def plane_drift(p: Params, links: Sequence[float], start: Ints, target: Ints, cfg: dict[str, int],
                steps: int) -> tuple[Floats, Floats]:
    """As `drift`, of engine_quaternion_gd_plane: float64 joints (steps + 1, n), radians (steps + 1)."""
    alpha = fixed.alpha(p, cfg["cfg_alpha"], cfg["cfg_shift"])
    return _drift(p, gradient.planar(*links), sum(links), alpha, floats(start), floats(target), steps,
                  lambda error, unit: plane_step(p, links, cfg, error, unit))


UNIT = 2.0 ** -25  # of a word of engine_quaternion_gd_n
OFF = 8.2 * UNIT  # what a joint adds to the error of the quaternion Q of all joints before


def space_place(joints: Sequence[gradient.Joint]) -> float:
    """How far E of engine_quaternion_gd_n can be from target - tip at the joints that were answered, in its unit.

    A word is rounded by half a unit, and by an eighth for each of up to four products: by a unit. Where a pass counts,
    (c, s) was within 2^-13 of length 1; a Newton step leaves 3/8 of the square of twice that, 0.8 unit, and 3 of
    rounding, the axis 0.9. Q is off by that and by R and itself, two units each: 8.2 for each joint, with what their
    products add. A link l errs by 4 |l| times the error of Q, and by 4.5 units of t and itself; u adds exactly.
    """
    return sum(4 * float(np.linalg.norm(joint.link)) * OFF * i + 4.5 * UNIT for i, joint in enumerate(joints, 1))


def space_end(joints: Sequence[gradient.Joint], tol: int) -> float:
    """Distance of a converged tip from the target: each coordinate of E is below `tol` units."""
    return float(np.sqrt(3)) * tol * UNIT + space_place(joints)


def space_step(joints: Sequence[gradient.Joint], alpha: float, error: float, levers: Floats) -> Floats:
    """How far the move of each joint can be from `space.step`, radians; |E| is `error`, |target - joint| `levers`.

    Neither may reach the limits of a step, 1/4. d = 256 (alpha / 512) E . g: A = 16 (alpha / 512) E is truncated to
    2^-24, and has the error of E; g = w x u that of w (twice Q's, and 6 units), of u, and two units; d is truncated by
    three of 2^-24 more. A joint moves by twice the arc of d; (c, s) is rounded twice, 6 units of angle.
    """
    count, place = np.arange(1, len(joints) + 1), space_place(joints)
    pull, off = alpha / 32 * error, 2 * UNIT + alpha / 32 * place
    column = (2 * OFF * count + 6 * UNIT) * levers + place + 2 * UNIT
    return 2 * (16 * (np.sqrt(3) * off * levers + pull * column + off * column) + 6 * UNIT) + 6 * UNIT


def _drift(p: Params, arm: gradient.Kinematics, reach: float, alpha: float, start: Floats, goal: Floats, steps: int,
           made: Callable[[Floats, float], Floats]) -> tuple[Floats, Floats]:
    """The float64 recursion, and how far joints can be that err by made(E, unit of its range) in every step.

    An error d before a step is |1 - alpha H| d + M d^2 / 2 after it, H the Hessian of E^2 / 2 by differences of the
    float step, M a bound of its third derivatives. The start of the range is not known: coarse.
    """
    n = start.size
    path = gradient.path(arm, start * TURN / 2 ** p["A"], goal, alpha, steps)
    off = np.zeros(steps + 1)
    for h, theta in enumerate(path[:-1]):
        error = gradient.step(arm, theta, goal, alpha)[1]
        # the finer range is sure where the pass before it was, by this bound, in the finer range or below its border
        size = np.linalg.norm(error) + n * reach * off[h]
        unit = 1 / 64 if h and size < 2 ** (p["W"] - 7) else 1 / 4
        small = 1e-6
        turn = np.stack([(gradient.step(arm, theta + small * way, goal, alpha)[0]
                          - gradient.step(arm, theta - small * way, goal, alpha)[0]) / (2 * small)
                         for way in np.eye(n)], axis=-1)
        third = alpha * n ** 1.5 * reach * (3 * reach + np.linalg.norm(error))
        off[h + 1] = np.linalg.norm(np.eye(n) + turn, ord=2) * off[h] + third * off[h] ** 2 / 2 \
            + np.linalg.norm(made(error, unit))
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
