"""Corners of engine_rus_fk: robots near and far from their pose, warm; words that are not there, or of any size."""

from __future__ import annotations

import numpy as np
from quadrance import engine_rus_fk as fk
from quadrance.cores import Core
from quadrance.parallel import geometry, position

from tb.lib.stimulus import Vectors, extremes, uniform

UNIT = {"rus_2x3": 512.0, "rotary_stewart": 128.0}  # mm


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """A short run first; a fine tolerance; tolerance 0; limit 0; any end converges; a limit of six
    bits that is reached.
    """
    return [{"cfg_tol": 2000, "cfg_limit": 2}, {"cfg_tol": 24, "cfg_limit": 12}, {"cfg_tol": 0, "cfg_limit": 3},
            {"cfg_tol": 300000, "cfg_limit": 0}, {"cfg_tol": (1 << 22) - 1, "cfg_limit": 63},
            {"cfg_tol": 0, "cfg_limit": 34}]


def poses(name: str, count: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Rotations, positions, link angles and crank angles of poses in reach."""
    low, high, degrees = {"rus_2x3": ((-150, -520, -150), (150, -100, 150), 20),
                          "rotary_stewart": ((-15, -15, 125), (15, 15, 150), 8)}[name]
    robot = geometry.load(name)
    turn = np.array([geometry.rotation(*zip("zyx", rng.uniform(-degrees, degrees, 3))) for _ in range(8 * count)])
    place, beta = rng.uniform(low, high, (8 * count, 3)), rng.uniform(-1, 1, 8 * count)
    found = position.inverse(robot, turn, place, beta)
    keep = np.flatnonzero(found.reachable.all(axis=-1))[:count]
    return turn[keep], place[keep], beta[keep], found.alpha[keep]


def assembled(p: dict[str, int], robot: geometry.Robot, right: bool) -> list[fk.Row]:
    """The paper's robot at the paper's pose: everything, with a start near it, or a start near its other assembly."""
    turn = geometry.rotation(("z", 5), ("y", -15), ("x", 10))
    beta = np.radians(-11.45)
    if not right:
        near = geometry.rotation(("z", 3.6), ("y", 6.4), ("x", 4.9)) @ turn
        return fk.start(p, robot, UNIT["rus_2x3"], near, [0.8, -350.5, 0.1])
    alpha = position.inverse(robot, turn, np.array([0, -350.0, 0]), beta).alpha
    near = geometry.rotation(("z", 0.2), ("x", 0.1)) @ turn
    return fk.loads(p, robot, UNIT["rus_2x3"], near, [0.1, -350.1, 0], alpha, beta)


def _solved(core: Core, name: str, count: int, rng: np.random.Generator, unit: float | None = None) -> list[fk.Row]:
    """A robot, a start near and far from each pose, then the cranks a little on, from the last pose; the last word that
    a solution writes is read at once."""
    p, robot, unit, rows = core.params, geometry.load(name), unit or UNIT[name], []
    for turn, place, beta, alpha in zip(*poses(name, count, rng)):
        spread = rng.choice([0, 1, 1, 10])
        near = geometry.rotation(*zip("zyx", rng.uniform(-spread, spread, 3))) @ turn
        at = place + rng.uniform(-2, 2, 3) * spread
        load = fk.loads(p, robot, unit, near, at, alpha, beta)
        rows += (rows and fk.start(p, robot, unit, near, at) + fk.link(p, beta) + fk.cranks(p, alpha)) or load
        rows += fk.solve() + fk.reads()[::3]
        rows += fk.cranks(p, alpha + rng.normal(size=6) * 0.01) + [{**fk.solve()[0], "in_k": 6}] + fk.reads()[1::4]
    return rows


def _alone(p: dict[str, int]) -> list[fk.Row]:
    """A robot that fits; one rod that does not, by one bit of the miss; one word at an end, and back; a quaternion next
    to length 1; legs nearly alike; a miss that is too large."""
    robot, place, top = geometry.load("rus_2x3"), np.array([0, -300.0, 0]), (1 << p["W"] - 1) - 1
    every = fk.loads(p, robot, 512.0, np.eye(3), place, position.inverse(robot, np.eye(3), place, 0.0).alpha)
    rows = every + fk.solve()
    rod = next(row for row in every if row["in_n"] == 1 and row["in_k"] == 10)
    for bit in range(22, 26):
        square = rod["in_word"] ** 2 + ((1 << bit) + 9) * 2.0 ** (2 * p["W"] - 29)
        rows += [{**rod, "in_word": round(square**0.5)}] + fk.solve() + [rod]
    for at in (*range(4, 9), *range(35, 48)):  # page 0; leg 3
        for end in (top, ~top):
            rows += [{**every[at], "in_word": end}] + fk.solve() + [every[at]]
    for more in (-33, -32, -17, -16, -15, 14, 15, 16, 17, 31, 32, 33):
        rows += [{**every[0], "in_word": (1 << p["W"] - 2) + more}] + fk.solve()
    rows += every[:1] + [{**row, "in_n": 2} for row in every if row["in_n"] == 1]
    for more in range(p["W"] - 10):
        rows += [{**every[4], "in_word": 1 << p["W"] - 12}, {**every[22], "in_word": every[9]["in_word"] + (1 << more)},
                 *fk.solve()]
    third = 13 << p["W"] - 2  # 1.3 units in each coordinate and no rod: of all words the miss alone overflows
    rows += [{**row, "in_word": 0} for row in every if row["in_n"] and row["in_k"] in (3, 4, 5, 8, 9, 10)]
    return rows + [{**row, "in_word": third // 10} for row in every[4:7]] + fk.solve()


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Nothing written, some of it; robots; a leg twice, so that rows depend; words at their ends, and wild ones."""
    rng, p = np.random.default_rng(1), core.params
    rows = fk.solve() + fk.reads()[2:4]
    first = _solved(core, "rus_2x3", 3 if cfg["cfg_limit"] < 40 else 1, rng)
    rows += first[:50] + fk.solve() + first[50:]
    for n, k in ((0, 9), (0, 15), (1, 13), (6, 15), (7, 0), (7, 3)):
        rows += [{"in_op": int(op), "in_n": n, "in_k": k, "in_word": 5} for op in range(3)]
    right, other = (assembled(p, geometry.load("rus_2x3"), side) for side in (True, False))
    rows += right + fk.solve() + other + fk.solve() + right[:7] + fk.solve() + fk.reads()
    rows += other + right[9:10] + fk.solve() + other + fk.solve() + right[:7] + fk.solve()  # of another robot
    rows += _alone(p)
    every = fk.loads(p, geometry.load("rus_2x3"), 512.0, np.eye(3), [0, -300, 0], np.zeros(6))
    twice = [{**row, "in_n": n} for n in (1, 2) for row in every if row["in_n"] == 1]
    rows += every + twice + fk.solve() + fk.reads()[:1]
    start = fk.start(p, geometry.load("rus_2x3"), 512.0, np.eye(3), [1, -300, 2])
    rows += start + fk.solve() + [{**start[1], "in_word": 1 << p["W"] - 3}] + fk.solve()
    rows += [{**row, "in_word": 0} for row in start[:4]] + fk.solve()
    stewart = fk.loads(p, geometry.load("rotary_stewart"), 128.0, np.eye(3), [0, 0, 140], np.zeros(6))
    rows += stewart + _solved(core, "rotary_stewart", 3 if cfg["cfg_limit"] < 40 else 1, rng)
    rows += _solved(core, "rotary_stewart", 2, rng, 100.0)  # rows longer than sqrt(2)
    for _ in range(8):
        rows += [{"in_op": fk.WRITE, "in_n": int(rng.integers(0, 7)), "in_k": int(rng.integers(0, 13)),
                  "in_word": int(rng.choice(extremes(core.inputs[3])))} for _ in range(2)] + fk.solve()
    every = fk.columns(rows)
    wild = uniform(core, rng, 60)
    wild["in_n"] %= 7
    wild["in_op"] = np.where(rng.random(60) < 0.7, fk.WRITE, wild["in_op"])
    return {name: np.concatenate([words, wild[name]]) for name, words in every.items()}
