"""Bit-true model of engine_quaternion_gd_plane: gradient descent of any number of joints in the plane."""

from __future__ import annotations

from functools import cache

import numpy as np

from quadrance import codecs
from quadrance.fixed import Ints, ints, wrap
from quadrance.iterative import fixed

Params = dict[str, int]
SOLVE, LOAD, SET, READ = range(4)  # in_op
NO_LINK, NOT_CONVERGED = 1, 8  # out_status


def config(p: Params, alpha: float) -> dict[str, int]:
    """Words of the step `alpha` in 1 / LSB^2, as fine as they go.

    Stable in reach below 2 / sum of the squares of (the length from link i on), at full stretch.
    Raises ValueError where alpha has no word: its links are too short for W bits, or so long that it is below them.
    """
    return fixed.step_words(p, alpha, shifts=4)


def loads(p: Params, lengths: Ints, joints: Ints, first: int = 1) -> list[dict[str, int]]:
    """The samples that load links with their joints."""
    return [{"in_op": LOAD, "in_n": i, "in_x": int(wrap(length, p["W"])), "in_y": 0, "in_j": int(joint)}
            for i, (length, joint) in enumerate(zip(lengths, joints, strict=True), first)]


def sets(joints: Ints) -> list[dict[str, int]]:
    """The samples that give the joints a new start."""
    return [{"in_op": SET, "in_n": i, "in_x": 0, "in_y": 0, "in_j": int(joint)} for i, joint in enumerate(joints, 1)]


def solve(n: int, x: int, y: int) -> list[dict[str, int]]:
    """The sample that solves for a target, and those after it that read the joints."""
    return [{"in_op": SOLVE, "in_n": n, "in_x": int(x), "in_y": int(y), "in_j": 0},
            *({"in_op": READ, "in_n": i, "in_x": 0, "in_y": 0, "in_j": 0} for i in range(1, n + 1))]


@cache
def _knots(k: int, t: int) -> list[int]:
    return codecs.sine_knots(k, t).tolist()


def _places(p: Params, joints: list[int], lengths: list[int]) -> list[tuple[int, int]]:
    """Links as vectors, (x, y) in 2^-(W+1) LSB."""
    w, a = p["W"], p["A"]
    t = (w + 4) // 2
    knots, low, mask, quarter = _knots(w + 1, t), a - t, (1 << a) - 1, 1 << a - 2
    turn, found = 0, []
    for joint, length in zip(joints, lengths):
        turn += joint
        pair = []
        for place in (turn + quarter & mask, turn & mask):
            knot = knots[place >> low]
            step = knots[(place >> low) + 1] - knot
            pair.append((knot + (step * (place & (1 << low) - 1) >> low)) * length)
        found.append((pair[0], pair[1]))
    return found


def _moves(p: Params, links: list[tuple[int, int]], goal: tuple[int, int], ax: int, ay: int, shift: int,
           fine: bool) -> list[int]:
    """What the joints move by: (target - links before it) x alpha E, nearest in the fine range."""
    cut, bits = 2 * p["W"] - p["A"], p["A"] + 6
    half = 1 << bits - 1
    lever, moves = 8 << 2 * shift, []
    for x, y in [(~(2 * goal[0]), ~(2 * goal[1])), *((x >> p["W"], y >> p["W"]) for x, y in links[:-1])]:
        lever += (y * ax >> cut) - (x * ay >> cut)
        lever = (lever + half & 2 * half - 1) - half
        moves.append(lever >> 2 * shift + 4 * fine)
    return moves


def descend(p: Params, joints: list[int], lengths: list[int], goal: tuple[int, int], *, alpha: int, shift: int,
            tol: int, limit: int) -> tuple[int, int, int, int]:
    """One solution, `joints` in place: steps, squared error, whether it is in the coarse range, status."""
    w = p["W"]
    top, mask = 1 << w + 1, (1 << p["A"]) - 1
    fine, count = True, 0
    while True:
        links = _places(p, joints, lengths)
        # every other link is truncated towards its next unit, so that what they lose is nothing on average
        error = [(end << 6) - sum((link[axis] >> w - 5) + i % 2 for i, link in enumerate(links))
                 for axis, end in enumerate(goal)]
        seen = [min(max(e if fine else e >> 4, -top), top - 1) for e in error]
        square = sum(e * e >> 4 for e in seen)
        fits = all(-top <= e < top for e in error)
        done, wide = fine and square < tol, fine and not fits
        if done or (count == limit and not wide):
            return count, square, int(not fine), 0 if done else NOT_CONVERGED
        if not wide:
            moves = _moves(p, links, goal, *(alpha * e >> w + 1 for e in seen), shift, fine)
            joints[:] = [joint + move & mask for joint, move in zip(joints, moves)]
            count += 1
        fine = fits


def gd(p: Params, *, in_op: Ints, in_n: Ints, in_x: Ints, in_y: Ints, in_j: Ints, cfg_alpha: Ints, cfg_shift: Ints,
       cfg_tol: Ints, cfg_limit: Ints) -> dict[str, Ints]:
    """The stream of loads, starts, solutions and reads, in its order; nothing is loaded before it."""
    columns = np.broadcast_arrays(*map(ints, (in_op, in_n, in_x, in_y, in_j, cfg_alpha, cfg_shift, cfg_tol, cfg_limit)))
    joints, lengths, answers = [], [], []
    for op, n, x, y, j, alpha, shift, tol, limit in zip(*(np.atleast_1d(column).tolist() for column in columns)):
        answer = (0, 0, 0, 0)
        if not 1 <= n <= min(len(joints) + (op == LOAD), p["N"]):
            answers.append((0, 0, 0, 0, NO_LINK))
            continue
        if op == LOAD:
            lengths[n - 1:n] = [x & (1 << p["W"]) - 1]
        if op in (LOAD, SET):
            joints[n - 1:n] = [j]
        if op == SOLVE:
            chain = joints[:n]
            answer = descend(p, chain, lengths[:n], (x, y), alpha=alpha, shift=shift, tol=tol, limit=limit)
            joints[:n] = chain
        answers.append((joints[0 if op == SOLVE else n - 1], *answer))
    rows = np.array(answers, dtype=np.int64).reshape(-1, 5).T
    return {f"out_{name}": row.reshape(columns[0].shape)
            for name, row in zip(("j", "iters", "error", "coarse", "status"), rows)}
