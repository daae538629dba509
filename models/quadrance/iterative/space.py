"""Bit-true model of engine_quaternion_gd_n: gradient descent of any number of revolute joints in space.

A joint is the unit vector of half its angle; see `step` for the recursion in float64.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance.fixed import Ints, ints, wrap
from quadrance.iterative import gradient
from quadrance.iterative.gradient import Joint
from quadrance.truth import Floats, floats

Params = dict[str, int]
SOLVE, WRITE, READ = range(3)  # in_op
NO_JOINT, OVERFLOW, NOT_CONVERGED = 1, 4, 8  # out_status
ONE = 1 << 25
LONGEST = 0.25  # of a step, d

Row = dict[str, int]


# Words


def word(value: ArrayLike) -> Ints:
    """s2.25, nearest; ValueError where it does not fit."""
    found = ints(np.floor(floats(value) * ONE + 0.5))
    if np.any(found != wrap(found, 27)):
        raise ValueError("a word is from -2 to 2: take a coarser unit of length, so that the reach is 1 or less")
    return found


def _writes(n: int, values: ArrayLike, first: int = 0) -> list[Row]:
    return [{"in_op": WRITE, "in_n": n, "in_k": k, "in_word": int(one)} for k, one in enumerate(word(values), first)]


def aim(target: ArrayLike) -> list[Row]:
    """The samples that write the target, in units of length."""
    return _writes(0, target)


def sets(theta: ArrayLike) -> list[Row]:
    """The samples that give the joints their angles, radians."""
    return [row for n, angle in enumerate(floats(theta), 1)
            for row in _writes(n, [np.cos(angle / 2), np.sin(angle / 2)], 6)]


def loads(joints: list[Joint], theta: ArrayLike, alpha: float, target: ArrayLike = (0.0, 0.0, 0.0)) -> list[Row]:
    """The samples that write all: target, step alpha in 1 / unit^2, and each joint with its angle in radians.

    The unit of length is the user's: the reach is to be 1 unit or less. Raises ValueError where a word does not fit.
    """
    rows = _writes(0, [*target, alpha / 512])
    for n, (joint, angle) in enumerate(zip(joints, floats(theta), strict=True), 1):
        if abs(np.linalg.norm(joint.axis) - 1) > 1e-6:
            raise ValueError("the axis of a joint is not of length 1")
        rows += _writes(n, [*joint.axis, *(2 * floats(joint.link)), np.cos(angle / 2), np.sin(angle / 2)])
    return rows


def solve(n: int) -> list[Row]:
    """The sample that solves with joints 1 to n; its answer has s of joint n."""
    return [{"in_op": SOLVE, "in_n": n, "in_k": 7, "in_word": 0}]


def reads(n: int) -> list[Row]:
    """The samples that read c and s of joints 1 to n."""
    return [{"in_op": READ, "in_n": i, "in_k": k, "in_word": 0} for i in range(1, n + 1) for k in (6, 7)]


# The recursion in float64


def step(joints: list[Joint], theta: ArrayLike, target: ArrayLike, alpha: float) -> tuple[Floats, Floats]:
    """What one iteration adds to `theta` (n,), and E: theta is twice the angle of (c, s), which d turns by arctan d."""
    move, error = gradient.step(gradient.spatial(joints), theta, target, alpha)
    return 2 * np.arctan(np.clip(move / 2, -LONGEST, LONGEST)), error


# The core


def _sum(a: int, b: int, c: int = 0, d: int = 0, e: int = 0, f: int = 0, g: int = 0, h: int = 0, half: int = 4) -> int:
    """a b + c d + e f - g h, each product truncated to 2^-28, s4.28."""
    total = (a * b >> 22) + (c * d >> 22) + (e * f >> 22) - (g * h >> 22) + half
    return (total + (1 << 31) & (1 << 32) - 1) - (1 << 31)


def _line(*factors: int) -> int:
    """The sum to nearest 2^-25; it wraps."""
    return (_sum(*factors) + (1 << 29) & (1 << 30) - 1) - (1 << 29) >> 3


def _short(*factors: int) -> int:
    """16 times the sum, from -1/4 to 1/4; half of what one to three products lose is in it."""
    return min(max(_sum(*factors, half=1) << 1, -(1 << 23)), (1 << 23) - 1)


def _turned(q: list[int], pair: list[int], axis: list[int], u: list[int],
            d: int) -> tuple[list[int], list[int], list[int], bool]:
    """Q, (c, s) and g of a joint that moves by d, and whether (c, s) was off length 1 by so much that it still is."""
    (x, y, z), (q0, q1, q2, q3), (c, s) = axis, q, pair
    r0 = _line(q1, x, q2, y, q3, z)
    r1, r2, r3 = (_line(q0, x, q2, z, 0, 0, q3, y), _line(q0, y, q3, x, 0, 0, q1, z), _line(q0, z, q1, y, 0, 0, q2, x))
    w = (_line(q0, r1, r0, q1, r3, q2, r2, q3), _line(q0, r2, r0, q2, r1, q3, r3, q1),
         _line(q0, r3, r0, q3, r2, q1, r1, q2))
    c, s = _line(ONE, c, 0, 0, 0, 0, d, s), _line(ONE, s, d, c)
    square = _line(c, c, s, s)
    newton = _line(ONE, 3 * ONE >> 1, 0, 0, 0, 0, ONE >> 1, square)
    c, s = _line(newton, c), _line(newton, s)
    turned = [_line(c, q0, 0, 0, 0, 0, s, r0), _line(c, q1, s, r1), _line(c, q2, s, r2), _line(c, q3, s, r3)]
    column = [_line(w[i - 2], u[i - 1], 0, 0, 0, 0, w[i - 1], u[i - 2]) for i in range(3)]
    return turned, [c, s], column, not -(1 << 13) <= square - ONE < 1 << 13


def _link(q: list[int], double: list[int]) -> list[int]:
    """The link in space."""
    (x, y, z), (q0, q1, q2, q3) = double, q
    t = _line(q2, z, 0, 0, 0, 0, q3, y), _line(q3, x, 0, 0, 0, 0, q1, z), _line(q1, y, 0, 0, 0, 0, q2, x)
    half = ONE >> 1
    return [_line(half, x, q0, t[0], q2, t[2], q3, t[1]), _line(half, y, q0, t[1], q3, t[0], q1, t[2]),
            _line(half, z, q0, t[2], q1, t[1], q2, t[0])]


def _descend(chain: list[list[int]], goal: list[int], alpha: int, tol: int,
             limit: int) -> tuple[int, list[int], int]:
    """One solution, (c, s) of `chain` in place: steps, E, status."""
    columns, pull, count = [[]] * len(chain), [0, 0, 0], 0
    while True:
        q, u, over, uneven = [ONE, 0, 0, 0], goal, False, False
        for i, joint in enumerate(chain):
            d = _short(*(factor for pair in zip(pull, columns[i]) for factor in pair)) if columns[i] else 0
            q, joint[6:], columns[i], off = _turned(q, joint[6:], joint[:3], u, d)
            uneven |= off
            link, place = _link(q, joint[3:6]), []
            for one, part in zip(u, link):
                total = _sum(ONE, one, 0, 0, 0, 0, ONE, part)
                over |= not -(1 << 29) <= total < 1 << 29
                place.append(_line(ONE, one, 0, 0, 0, 0, ONE, part))
            u = place
        done = not over and not uneven and all((e if e >= 0 else ~e) < tol for e in u)
        if done or count == limit:
            return count, u, OVERFLOW * over + NOT_CONVERGED * (not done)
        pull = [_short(alpha, e) for e in u]
        count += 1


def gd(p: Params, *, in_op: Ints, in_n: Ints, in_k: Ints, in_word: Ints, cfg_tol: Ints,
       cfg_limit: Ints) -> dict[str, Ints]:
    """The stream of writes, solutions and reads, in its order; nothing is written before it."""
    columns = np.broadcast_arrays(*map(ints, (in_op, in_n, in_k, in_word, cfg_tol, cfg_limit)))
    table: list[list[int]] = []
    answers = []
    for op, n, k, value, tol, limit in zip(*(np.atleast_1d(column).tolist() for column in columns)):
        filled = (len(table) - 1, len(table[-1])) if table else (0, 0)
        if table and filled[1] == (4 if filled[0] == 0 else 8):
            filled = filled[0] + 1, 0
        there = (n, 7 if op == SOLVE else k) < filled
        new = op == WRITE and (n, k) == filled and n <= p["N"]
        if not (there or new) or (n == 0 and (k > 3 or op == SOLVE)):
            answers.append((0, 0, 0, 0, 0, NO_JOINT))
            continue
        count, error, status = 0, [0, 0, 0], 0
        if new and k == 0:
            table.append([])
        if op == WRITE:
            table[n][k:k + 1] = [value]
        if op == SOLVE:
            count, error, status = _descend(table[1:n + 1], table[0][:3], table[0][3], tol, limit)
        answers.append((table[n][k], *error, count, status))
    rows = np.array(answers, dtype=np.int64).reshape(-1, 6).T
    return {f"out_{name}": row.reshape(columns[0].shape)
            for name, row in zip(("word", "x", "y", "z", "iters", "status"), rows)}
