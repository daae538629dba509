"""Bit-true model of engine_rus_fk: six crank vectors to the pose of a six-legged RUS robot, by Newton.

A word carries 1.0 as 2^25; the unit of length is the user's. The core's y is the axis that all cranks share at 90
degrees (`up` of the robot file), its x and z are the other two, as in `engine_rus`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quadrance.engine_rus import frame
from quadrance.fixed import Ints, ints, wrap
from quadrance.parallel.geometry import Floats, PoseError, Robot, check_pose
from quadrance.truth import floats

Params = dict[str, int]
Row = dict[str, int]
SOLVE, WRITE, READ = range(3)  # in_op
NO_WORD, SINGULAR, OVERFLOW, NOT_CONVERGED = 1, 2, 4, 8  # out_status
LEGS, POSE, LAST, CRANK = 6, 9, 13, 11  # words of page 0, of a leg, and where its crank vector begins
ONE, HALF, QUARTER, MOST = 1 << 25, 1 << 24, 1 << 23, (1 << 26) - 1
ROOT = (44809508, -55119815, 27490843)  # 1 / (2 sqrt(s)) = ROOT[0] + s ROOT[1] + s^2 ROOT[2] to 2.4 %, s from 1/4 to 1
SCALINGS = 7  # of a row, by 4; with more there is nothing left of it
UNEVEN = 5  # lowest bit of the square of the quaternion, less 1, that is an error


# Words


def word(p: Params, value: ArrayLike) -> Ints:
    """Words of W bits, nearest; PoseError where one does not fit."""
    found = ints(np.floor(floats(value) * 2.0 ** (p["W"] - 2) + 0.5))
    if np.any(found != wrap(found, p["W"])):
        raise PoseError("a word is from -2 to 2: take a coarser unit of length")
    return found


def _writes(p: Params, n: int, values: ArrayLike, first: int = 0) -> list[Row]:
    return [{"in_op": WRITE, "in_n": n, "in_k": k, "in_word": int(one)} for k, one in enumerate(word(p, values), first)]


def quaternion(rotation: ArrayLike) -> Floats:
    """(w, x, y, z) of a rotation matrix (3, 3), w >= 0."""
    r = floats(rotation)
    values, vectors = np.linalg.eigh(np.array([
        [r[0, 0] + r[1, 1] + r[2, 2], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
        [r[2, 1] - r[1, 2], r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
        [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1]],
        [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1]]]))
    return vectors[:, -1] * (1 if vectors[0, -1] >= 0 else -1)


def start(p: Params, robot: Robot, unit: float, rotation: ArrayLike, position: ArrayLike) -> list[Row]:
    """The samples that write a start; `unit` in mm, position in mm."""
    turn = frame(robot)
    rotation, position = check_pose(rotation, position)
    return _writes(p, 0, [*quaternion(turn @ rotation @ turn.T), *(turn @ position / unit)])


def link(p: Params, beta: float) -> list[Row]:
    """The samples that write the angle of the reconfiguration links, radians."""
    return _writes(p, 0, [np.cos(beta), np.sin(beta)], 7)


def cranks(p: Params, alpha: ArrayLike) -> list[Row]:
    """The samples that write the crank vectors of (6,) angles, radians."""
    return [row for n, one in enumerate(floats(alpha), 1)
            for row in _writes(p, n, [np.cos(one), np.sin(one)], CRANK)]


def loads(p: Params, robot: Robot, unit: float, rotation: ArrayLike, position: ArrayLike, alpha: ArrayLike,
          beta: float = 0.0) -> list[Row]:
    """The samples that write everything: start, link angle, geometry and cranks.

    Raises
    ------
    PoseError
        Where a word does not fit, or the robot has not six legs.
    """
    if robot.legs != LEGS:
        raise PoseError(f"{robot.id}: the core wants six legs; for a delta see parallel.delta.forward")
    turn, rows = frame(robot), start(p, robot, unit, rotation, position) + link(p, beta)
    for i, angle in enumerate(floats(alpha)):
        joint, foot, radial = (turn @ one[i] for one in (robot.joint, robot.foot, robot.radial))
        rows += _writes(p, i + 1, [*joint / unit, *foot / unit, radial[0], radial[2],
                                   *(floats([robot.link[i], robot.la[i], robot.lb[i]]) / unit),
                                   np.cos(angle), np.sin(angle)])
    return rows


def solve() -> list[Row]:
    """The sample that solves; its answer has w of the pose."""
    return [{"in_op": SOLVE, "in_n": 0, "in_k": 0, "in_word": 0}]


def reads() -> list[Row]:
    """The samples that read the pose: w, x, y, z and the position."""
    return [{"in_op": READ, "in_n": 0, "in_k": k, "in_word": 0} for k in range(7)]


def columns(rows: list[Row]) -> dict[str, Ints]:
    """Samples as columns by port name."""
    return {name: ints([row[name] for row in rows]) for name in rows[0]}


# The core


class _Sums:
    """The adder and its flag: `over`, a word did not fit."""

    def __init__(self) -> None:
        self.over = False

    def total(self, *factors: int) -> int:
        """a b +- c d + ... of (a, b, c, d, sign, ...), products truncated to 2^-28, s4.28; a minus is a complement."""
        total = 4
        for a, b, c, d, plus in zip(*[iter(factors)] * 5):
            product = c * d >> 22
            total += (a * b >> 22) + (product if plus else ~product)
        return (total + (1 << 31) & (1 << 32) - 1) - (1 << 31)

    def __call__(self, *factors: int) -> int:
        total = self.total(*factors)
        self.over |= not -(1 << 29) <= total < 1 << 29
        return _word(total)


def _word(total: int) -> int:
    return (total + (1 << 29) & (1 << 30) - 1) - (1 << 29) >> 3


def _elbow(line: _Sums, leg: list[int], cb: int, nb: int) -> tuple[int, int, int]:
    """End of the crank."""
    out = line(leg[9], leg[11], leg[8], cb, 1)
    return (line(ONE, leg[3], out, leg[6], 1), line(leg[9], leg[12], leg[8], nb, 1, ONE, leg[4], 0, 0, 1),
            line(ONE, leg[5], out, leg[7], 1))


def _matrix(line: _Sums, q: list[int]) -> list[list[int]]:
    w, x, y, z = q
    return [[line(w, w, y, y, 0, x, x, z, z, 0), line(*(x, y, w, z, 0) * 2), line(*(x, z, w, y, 1) * 2)],
            [line(*(x, y, w, z, 1) * 2), line(w, w, x, x, 0, y, y, z, z, 0), line(*(y, z, w, x, 0) * 2)],
            [line(*(x, z, w, y, 0) * 2), line(*(y, z, w, x, 1) * 2), line(w, w, x, x, 0, z, z, y, y, 0)]]


def _row(line: _Sums, matrix: list[list[int]], p: list[int], leg: list[int], elbow: tuple[int, int, int]) -> list[int]:
    """Row (d, R c x d) of a leg and its miss |d|^2 - LB^2."""
    arm, d = [], []
    for (r1, r2, r3), place, end in zip(matrix, p, elbow):
        turned = r1, leg[0], r2, leg[1], 1, r3, leg[2], 0, 0, 1
        arm.append(line(*turned))
        d.append(line(*turned, place, ONE, end, ONE, 0))
    moment = [line(arm[i - 2], d[i - 1], arm[i - 1], d[i - 2], 0) for i in range(3)]
    return d + moment + [line(d[0], d[0], d[1], d[1], 1, d[2], d[2], leg[10], leg[10], 0)]


def _along(line: _Sums, a: list[int], b: list[int]) -> int:
    """Scalar product of two rows; words that do not fit are let be."""
    return line.total(*(part for i in (0, 2, 4) for part in (a[i], b[i], a[i + 1], b[i + 1], 1)))


def _unit(line: _Sums, row: list[int]) -> bool:
    """Row and miss, in place, divided by the row's length; False where a word overflowed or the row is nothing."""
    count = 0
    while True:
        square = _along(line, row, row)
        high = square >> 24 & 0xFF  # sixteenths
        fits = 4 <= high < 16
        if line.over or (count == SCALINGS and not fits):
            return False
        if fits:
            break
        by = QUARTER if high >= 16 else ONE if high >= 1 else MOST
        row[:] = [line(one, by, one, by, 1) for one in row]
        count += 1
    s = _word(square)
    double = line(s, ONE, s, ONE, 1)
    g = line(line(ROOT[2], s, ROOT[1], ONE, 1), s, ROOT[0], ONE, 1)
    for _ in range(2):
        g = line(g, line(ONE + HALF, ONE, line(g, g, 0, 0, 1), double, 0), 0, 0, 1)
    row[:] = [line(one, g, one, g, 1) for one in row]
    return True


def _steps(line: _Sums, rows: list[list[int]]) -> tuple[list[int], bool]:
    """Least x with row . x = -miss of every row: Gram-Schmidt on the rows; they become unit vectors at right angles."""
    x = [0] * 6
    for i, row in enumerate(rows):
        if not _unit(line, row):
            return x, False
        x = [line(one, ONE, row[6], part, 0) for one, part in zip(x, row)]
        for other in rows[i + 1:]:
            t = _word(_along(line, row, other))
            other[:] = [line(one, ONE, t, part, 0) for one, part in zip(other, row)]
    return x, True


def _moved(line: _Sums, q: list[int], p: list[int], x: list[int]) -> tuple[list[int], list[int]]:
    """The pose moved by x / 2, its quaternion normalised by one Newton step."""
    a, b, c = (line(0, 0, one, QUARTER, 0) for one in x[3:])
    p = [line(place, ONE, one, HALF, 1) for place, one in zip(p, x)]
    w, i, j, k = q
    q = [line(w, ONE, a, i, 1, b, j, c, k, 1), line(i, ONE, a, w, 0, c, j, b, k, 0),
         line(j, ONE, b, w, 0, a, k, c, i, 0), line(k, ONE, c, w, 0, b, i, a, j, 0)]
    w, i, j, k = q
    f = line(ONE + HALF, ONE, line(w, w, i, i, 1, j, j, k, k, 1), HALF, 0)
    return [line(one, f, 0, 0, 1) for one in q], p


def _side(line: _Sums, rows: list[list[int]]) -> bool:
    """Sign of the determinant of orthonormal rows: of one half of rows 1 to 3 by the other half of rows 4, 6, 5.

    The blocks of an orthogonal matrix [[A, B], [C, D]] obey det A = det D times the determinant.
    """
    side = False
    for (one, two, three), first in (((0, 1, 2), 0), ((3, 5, 4), 3)):
        a, b, c = (rows[i][first:first + 3] for i in (one, two, three))
        n = [line(a[i - 2], b[i - 1], a[i - 1], b[i - 2], 0) for i in range(3)]
        side ^= line.total(n[0], c[0], n[1], c[1], 1, n[2], c[2], 0, 0, 1) < 0
    return side


class _State:
    """What the core keeps: words, and the side of singularities on which the robot is, None if that is not known."""

    def __init__(self) -> None:
        self.words: list[list[int]] = [[]]
        self.side: bool | None = None


def _newton(state: _State, tol: int, limit: int) -> tuple[int, int]:
    """One solution, the pose in place: steps and status."""
    line = _Sums()
    start, legs = state.words[0], state.words[1:]
    elbows = [_elbow(line, leg, *start[7:9]) for leg in legs]
    q, p, count, wanted, crossed = start[:4], start[4:7], 0, state.side, False
    while True:
        uneven = line(q[0], q[0], q[1], q[1], 1, q[2], q[2], q[3], q[3], 1, 0, 0, ONE, ONE, 0)
        matrix = _matrix(line, q)
        rows = [_row(line, matrix, p, leg, elbow) for leg, elbow in zip(legs, elbows)]
        done = all((row[6] if row[6] >= 0 else ~row[6]) < tol for row in rows) \
            and (uneven ^ uneven >> 63) >> UNEVEN == 0
        if line.over or done or count == limit:
            break
        x, regular = _steps(line, rows)
        if not regular:
            return count, NOT_CONVERGED + OVERFLOW * line.over + SINGULAR * (not line.over)
        side = _side(line, rows)
        wanted = side if wanted is None else wanted
        crossed = side != wanted
        q, p = _moved(line, q, p, x)
        count += 1
    if done and not line.over and not crossed:
        state.words[0][:7], state.side = [*q, *p], wanted
        return count, 0
    return count, NOT_CONVERGED + OVERFLOW * line.over + SINGULAR * crossed


def fk(p: Params, *, in_op: Ints, in_n: Ints, in_k: Ints, in_word: Ints, cfg_tol: Ints,
       cfg_limit: Ints) -> dict[str, Ints]:
    """The stream of writes, solutions and reads, in its order; nothing is written before it."""
    every = np.broadcast_arrays(*map(ints, (in_op, in_n, in_k, in_word, cfg_tol, cfg_limit)))
    state, answers, pad = _State(), [], 27 - p["W"]
    for op, n, k, value, tol, limit in zip(*(np.atleast_1d(column).tolist() for column in every)):
        table = state.words
        filled = len(table) - 1, len(table[-1])
        there, new = (n, k) < filled and k < (LAST if n else POSE), op == WRITE and (n, k) == filled and n <= LEGS
        if not (there or new) or (op == SOLVE and filled != (LEGS + 1, 0)):
            answers.append((0, 0, NO_WORD))
            continue
        count, status = 0, 0
        if op == WRITE:
            table[n][k:k + 1] = [value << pad]
            if len(table[-1]) == (LAST if len(table) > 1 else POSE):
                table.append([])
            if (n, k) == (1, 0):
                state.side = None
        if op == SOLVE:
            table.pop()
            count, status = _newton(state, tol, limit)
            table.append([])
        answers.append((wrap(table[n][k] + (1 << pad >> 1) >> pad, p["W"]), count, status))
    rows = np.array(answers, dtype=np.int64).reshape(-1, 3).T
    return {f"out_{name}": row.reshape(every[0].shape) for name, row in zip(("word", "iters", "status"), rows)}
