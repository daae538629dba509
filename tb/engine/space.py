"""Corners of engine_quaternion_gd_n: chains in reach, beyond, that overflow; words that are not there."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core
from quadrance.iterative import gradient, space
from quadrance.iterative.gradient import Joint

from tb.lib.stimulus import Vectors, uniform


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """A short run first; a longer one with a fine tolerance; tolerance 0, limit 0; any end converges."""
    return [{"cfg_tol": 40000, "cfg_limit": 5}, {"cfg_tol": 2000, "cfg_limit": 30}, {"cfg_tol": 0, "cfg_limit": 3},
            {"cfg_tol": 300000, "cfg_limit": 0}, {"cfg_tol": (1 << 22) - 1, "cfg_limit": 7}]


def chain(n: int, rng: np.random.Generator, reach: float = 0.6) -> list[Joint]:
    """Axes along the coordinates or any way, links of any direction, of that length together."""
    axes = np.where(rng.random((n, 1)) < 0.5, np.eye(3)[rng.integers(0, 3, n)], rng.normal(size=(n, 3)))
    links = rng.normal(size=(n, 3))
    axes, links = (part / np.linalg.norm(part, axis=1, keepdims=True) for part in (axes, links))
    return [Joint(tuple(axis), tuple(link)) for axis, link in zip(axes, links * reach / n)]


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


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Nothing written; chains of one joint to all of them; words that are not there between; words of any size."""
    rng, limit = np.random.default_rng(1), cfg["cfg_limit"]
    most = min(core.params["N"], 128 if limit < 4 else 20 if limit < 6 else 3)
    rows = space.solve(1) + space.reads(1) + space.aim([1, 1.5, 0.3])[1:]
    last = 1
    for n in (1, 2, most, 3, most):
        n = min(n, most)
        rows += _solved(n, rng)
        last = max(last, n)
        for joint, k in ((0, 7), (0, 4), (last + 1, 1), (last + 2, 0), (core.params["N"] + 1, 0), (255, 0), (128, 7)):
            rows.append({"in_op": int(rng.integers(0, 4)), "in_n": joint, "in_k": k, "in_word": 5})
    every = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    if most == core.params["N"]:  # one joint too many, in order
        more = [{"in_op": space.WRITE, "in_n": most + 1, "in_k": k, "in_word": 7} for k in range(8)]
        more += space.solve(most + 1) + space.solve(most)
        every = {name: np.concatenate([words, [row[name] for row in more]]) for name, words in every.items()}
    wild = uniform(core, rng, 200)
    wild["in_n"] %= 3
    wild["in_op"] = np.where(rng.random(200) < 0.7, space.WRITE, wild["in_op"])
    return {name: np.concatenate([words, wild[name]]) for name, words in every.items()}
