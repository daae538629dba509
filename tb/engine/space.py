"""Corners of engine_quaternion_gd_n: chains in reach, beyond, that overflow; words that are not there."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core
from quadrance.iterative import gradient, space
from quadrance.iterative.gradient import Joint

from tb.lib.stimulus import Vectors, joined, uniform


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """A short run first; a longer one with a fine tolerance; tolerance 0; limit 0, each bit of the tolerance at 0 and
    at 1; any end converges; nothing does, each bit of the limit at 0 and at 1.
    """
    return [{"cfg_tol": 40000, "cfg_limit": 5}, {"cfg_tol": 2000, "cfg_limit": 30}, {"cfg_tol": 0, "cfg_limit": 3},
            {"cfg_tol": 0x155555, "cfg_limit": 0}, {"cfg_tol": 0x2AAAAA, "cfg_limit": 0},
            {"cfg_tol": (1 << 22) - 1, "cfg_limit": 7}, {"cfg_tol": 0, "cfg_limit": 0x155},
            {"cfg_tol": 0, "cfg_limit": 0x2AA}]


def chain(n: int, rng: np.random.Generator, reach: float = 0.6) -> list[Joint]:
    """Axes along the coordinates or any way, links of any direction, of that length together."""
    axes = np.where(rng.random((n, 1)) < 0.5, np.eye(3)[rng.integers(0, 3, n)], rng.normal(size=(n, 3)))
    links = rng.normal(size=(n, 3))
    axes, links = (part / np.linalg.norm(part, axis=1, keepdims=True) for part in (axes, links))
    return [Joint(tuple(axis), tuple(link)) for axis, link in zip(axes, links * reach / n)]


def columns(rows: list[dict[str, int]]) -> Vectors:
    """Samples as the columns of their words."""
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _solved(n: int, rng: np.random.Generator) -> list[dict[str, int]]:
    """A chain, and targets of joints near the start and far from it, and beyond its reach."""
    joints, theta = chain(n, rng), rng.uniform(-3, 3, n)
    kinematics = gradient.spatial(joints)
    alpha = 1 / np.linalg.norm(kinematics(theta)[1], ord=2) ** 2
    rows = space.loads(joints, theta, min(alpha, 1000.0))
    for spread in (1e-3, 0.1, 1.0):
        goal = kinematics(theta + rng.normal(size=n) * spread)[0]
        rows += space.aim(goal) + space.solve(n) + space.reads(n)[-2:]
    rows += space.aim(rng.choice([-1.9, 0, 0.9], 3)) + space.solve(n)
    return rows + space.sets(rng.uniform(-3, 3, n)) + space.solve(max(n - 1, 1))


def _border(core: Core, tol: int, rng: np.random.Generator) -> list[dict[str, int]]:
    """A joint that stands still, and targets whose error is next to the tolerance, to each of its bits alone."""
    joints, theta = chain(1, rng), rng.uniform(-3, 3, 1)
    rows = space.loads(joints, theta, 1.0) + space.solve(1)
    answer = space.gd(core.params, **columns(rows), cfg_tol=tol, cfg_limit=0)
    place = [rows[k]["in_word"] - int(answer[f"out_{axis}"][-1]) for k, axis in enumerate("xyz")]
    sizes = {tol, tol - 1, *(1 << bit for bit in range(22, 25))}
    for bit in (1 << bit for bit in range(22)):  # the last size below with a 0 there, the first from it on with a 1
        low = 2 * bit - 1
        sizes |= {(tol - 1 & ~low) + bit - 1} if tol - 1 & bit else set()
        sizes |= {(tol & ~low) + bit} if not tol & bit else set()
    for size in sorted(sizes):
        error = np.where(np.arange(3) == rng.integers(3), size if rng.integers(2) else ~size, 0)
        rows += [{"in_op": space.WRITE, "in_n": 0, "in_k": k, "in_word": at + int(one)}
                 for k, (at, one) in enumerate(zip(place, error))] + space.solve(1)
    return rows


def _not_yet(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Tips on their targets that count for nothing yet: a joint's (c, s) is too long, a link ends beyond 2 from it."""
    joints, theta = chain(1, rng), rng.uniform(-3, 3, 1)
    rows = space.loads(joints, theta, 1.0)
    turned = [row | {"in_word": row["in_word"] + (row["in_word"] >> 9)} for row in rows[-2:]]
    answer = space.gd(core.params, **columns([*rows, *turned, *space.solve(1)]), cfg_tol=0, cfg_limit=0)
    place = [row | {"in_word": row["in_word"] - int(answer[f"out_{axis}"][-1])} for row, axis in zip(rows, "xyz")]
    rows += [*place, *turned, *space.solve(1)]
    if core.params["N"] < 6:
        return rows
    there = [Joint((0, 0, 1), (x, 0, 0)) for x in (0.9, 0.9, 0.9, -0.9, -0.9, -0.9)]
    return rows + space.loads(there, np.zeros(6), 0.1) + space.solve(6)


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Nothing written; chains of one joint to all of them; words that are not there between; words of any size."""
    rng, limit = np.random.default_rng(1), cfg["cfg_limit"]
    if limit > 255:  # a joint, and what it does not reach
        return columns(space.loads(chain(1, rng), [1], 1.0, (0.9, 0.9, 0.9)) + space.solve(1))
    most = min(core.params["N"], 128 if limit < 4 else 20 if limit < 6 else 3)
    rows = space.solve(1) + space.reads(1) + space.aim([1, 1.5, 0.3])[1:]
    last = 1
    for n in (1, 2, most, 3, most):
        n = min(n, most)
        rows += _solved(n, rng)
        last = max(last, n)
        for joint, k in ((0, 7), (0, 4), (last + 1, 1), (last + 2, 0), (core.params["N"] + 1, 0), (255, 0), (128, 7)):
            rows.append({"in_op": int(rng.integers(0, 4)), "in_n": joint, "in_k": k, "in_word": 5})
    if limit > 3:
        rows += _not_yet(core, rng)
    every = columns(rows)
    if most == core.params["N"]:  # one joint too many, in order
        more = [{"in_op": space.WRITE, "in_n": most + 1, "in_k": k, "in_word": 7} for k in range(8)]
        more += space.solve(most + 1) + space.solve(most)
        every = joined(every, columns(more))
    if limit == 0:
        every = joined(every, columns(_border(core, cfg["cfg_tol"], rng)))
    wild = uniform(core, rng, 200)
    wild["in_n"] %= 3
    wild["in_op"] = np.where(rng.random(200) < 0.7, space.WRITE, wild["in_op"])
    return joined(every, wild)
