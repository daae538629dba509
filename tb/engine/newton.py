"""Corners of engine_newton_3r, and of engine_quaternion_dls, which has no third link.

Starts and targets in reach, beyond, at its borders and stretched; warm samples.
"""

from __future__ import annotations

import numpy as np
from quadrance import truth
from quadrance.cores import Core
from quadrance.iterative import newton_fixed

from tb.lib.stimulus import Vectors, joined


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """A short run first; then links that are none, longest, shortest; damping; words at their ends; limit 0 with
    each bit of the tolerance at 0 and at 1."""
    p, high = core.params, (1 << core.params["W"]) - 1
    third = high // 6

    def words(l1: int, l2: int, l3: int, tol: int, limit: int, damping: float = 0.0) -> dict[str, int]:
        return {"cfg_l1": l1, "cfg_l2": l2, "cfg_l3": l3, "cfg_tol": tol, "cfg_limit": limit} \
            | newton_fixed.config(p, cfg_l1=l1, cfg_l2=l2, damping=damping)

    wild = {"cfg_r1": 65535, "cfg_r2": 65535, "cfg_lambda": 65535, "cfg_mu": (1 << 17) - 1}
    every = [words(third, third, third, 6400, 6), words(third, third, third, 64, 40),
            words(third, third * 2 // 3, third // 2, 256, 25, 2**-6), words(high, high, high, 64, 6),
            words(third, third, third, 0, 4), words(third, third, third, 0x155555, 0),
             words(third, third, third, 0x2AAAAA, 0), words(0, third, 0, 256, 4),
            words(third, 0, third, 256, 4, 0.25), words(high, third, 9, 4096, 9), words(1, 1, high, 256, 3),
            words(third, third, third, (1 << 22) - 1, 9) | wild,
            words(third, high, third, 256, 7, 0.41) | {"cfg_lambda": 65535, "cfg_mu": 0},
            *[words(high // 2, high // 2, high // 2, 256, 0x3C5)] * core.first_set,
            words(high, high, high, 64, 5) | wild | {"cfg_mu": 511, "cfg_lambda": 0}]
    return [{port.name: cfg[port.name] for port in core.cfg} for cfg in every]


def _border(core: Core, cfg: dict[str, int], rng: np.random.Generator) -> Vectors:
    """Cold starts whose error is next to the tolerance, to each of its bits alone, and the least beyond 22 bits."""
    a, tol, lsb = core.params["A"], cfg["cfg_tol"], 256 << 2 * (16 - core.params["W"])  # an error of one LSB
    lengths = np.array([cfg["cfg_l1"], cfg["cfg_l2"], cfg.get("cfg_l3", 0)])
    side = np.arange(-int((tol / lsb) ** 0.5) - 2, int((tol / lsb) ** 0.5) + 3)
    off = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    off = off[np.abs((off**2).sum(axis=-1) * lsb - tol) < max(1 << 15, 2 * lsb)]
    turn, size = rng.uniform(0, truth.TURN, 40), np.sqrt(((1 << np.arange(40) // 4 + 22) + tol // 2) / lsb)
    off = np.concatenate([*[off] * 8, np.rint(np.stack(truth.unit(turn), axis=-1) * size[:, None]).astype(np.int64)])
    theta = rng.uniform(-np.pi, np.pi, (len(off), 3))
    theta[:-40] = theta[:8].repeat((len(off) - 40) // 8, axis=0)
    word = np.rint(theta / truth.TURN * (1 << a)).astype(np.int64) & (1 << a) - 1
    theta = np.cumsum(word * truth.TURN / (1 << a), axis=1)
    goal = np.rint(np.stack([np.cos(theta) @ lengths, np.sin(theta) @ lengths], axis=-1)).astype(np.int64) + off
    every = {"in_x": goal[:, 0], "in_y": goal[:, 1], "in_phi": word.sum(axis=1) & (1 << a) - 1, "in_j1": word[:, 0],
             "in_j2": word[:, 1], "in_warm": np.zeros(len(off), np.int64)}
    inside = np.all(np.abs(goal) < 1 << core.params["W"] - 1, axis=-1)
    every = {port.name: every[port.name][inside] for port in core.inputs}
    error = core.model(core.params, **every, **cfg)["out_error"]
    picked = set(np.flatnonzero((error >= 1 << 22) & (error & (1 << 22) - 1 < tol)).tolist())
    for bit in (1 << bit for bit in range(22)):  # the last below with a 0 there, the first from it on with a 1
        for wanted, gap in (((error < tol) & (error & bit == 0), tol - error),
                            ((error >= tol) & (error & bit != 0), error - tol)):
            if wanted.any():
                picked.add(int(np.argmin(np.where(wanted, gap, 1 << 40))))
    return {name: words[sorted(picked)] for name, words in every.items()}


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """A third each: targets of random joints, at the borders of reach, extreme words; starts near, far, stretched."""
    rng, count = np.random.default_rng(1), 150
    w, a = core.params["W"], core.params["A"]
    high, lengths = 1 << w - 1, np.array([cfg["cfg_l1"], cfg["cfg_l2"], cfg.get("cfg_l3", 0)])
    theta = rng.uniform(-np.pi, np.pi, (count, 3))
    theta[50:100, 1] = np.pi * rng.integers(0, 2, 50) + rng.choice([0, 1e-3, 1 / 16, -1 / 16], 50)
    turn = np.cumsum(theta, axis=1)
    goal = np.rint(np.stack([np.cos(turn) @ lengths, np.sin(turn) @ lengths], axis=-1))
    goal[100:] = rng.choice([0, 1, -1, high - 1, -high], (50, 2))
    start = theta + rng.normal(size=(count, 3)) * rng.choice([0, 1e-5, 1e-2, 1], count)[:, None]
    start[:, 2] = turn[:, 2]
    word = np.rint(start / truth.TURN * (1 << a)).astype(np.int64) & (1 << a) - 1
    word[::7] = rng.choice([0, 1, (1 << a) - 1, 1 << a - 1, 1 << a - 2], (word[::7].shape[0], 3))
    order = rng.permutation(count)
    goal = np.clip(goal.astype(np.int64), -high, high - 1)[order]
    warm = rng.integers(0, 2, count)
    warm[0] = 1  # the first sample behind a reset starts from 0
    every = {"in_x": goal[:, 0], "in_y": goal[:, 1], "in_phi": word[order, 2], "in_j1": word[order, 0],
             "in_j2": word[order, 1], "in_warm": warm}
    every = {port.name: every[port.name] for port in core.inputs}
    return every if cfg["cfg_limit"] else joined(every, _border(core, cfg, rng))
