"""Corners of engine_quaternion_gd_plane: chains loaded, too long, without a length; links that are not there."""

from __future__ import annotations

import numpy as np
from quadrance import truth
from quadrance.cores import Core
from quadrance.iterative import plane

from tb.lib.stimulus import Vectors, uniform


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """A short run first; a long one; tolerance 0, limit 0; steps too long; every shift."""
    half = core.params["W"] + 1
    return [{"cfg_alpha": 1 << half - 2, "cfg_shift": 2, "cfg_tol": 6400, "cfg_limit": 6},
            {"cfg_alpha": (1 << half) - 1, "cfg_shift": 3, "cfg_tol": 256, "cfg_limit": 40},
            {"cfg_alpha": 1 << half - 1, "cfg_shift": 1, "cfg_tol": 0, "cfg_limit": 4},
            {"cfg_alpha": 1 << half - 1, "cfg_shift": 1, "cfg_tol": 1600, "cfg_limit": 0},
            {"cfg_alpha": (1 << half) - 1, "cfg_shift": 0, "cfg_tol": (1 << 22) - 1, "cfg_limit": 5},
            *[{"cfg_alpha": 1 << half - 2, "cfg_shift": 2, "cfg_tol": 1600, "cfg_limit": 0x3D5}] * core.first_set]


def _chain(core: Core, rng: np.random.Generator, n: int, kind: int) -> list[dict[str, int]]:
    """A chain of n links, and targets: of joints, of joints near the start, next to its full reach, of any words."""
    w, a = core.params["W"], core.params["A"]
    high = 1 << w - 1
    lengths = rng.dirichlet(np.full(n, 4.0)) * rng.choice([high, 2 * high, 2.0 ** (w - 4)])
    lengths = [lengths.astype(int), np.full(n, 2 * high - 1), np.where(rng.random(n) < 0.5, 0, lengths).astype(int),
               rng.integers(0, 2 * high, n)][kind]
    start = rng.integers(0, 1 << a, n)
    rows = plane.loads(core.params, lengths, start)
    if kind == 1:  # stretched away from the target: the greatest error there is
        start[:] = 0
        rows = plane.loads(core.params, lengths, start) + plane.solve(n, -high, 0)
    for spread in (1e-4, 0.03, 1.0):
        theta = start * truth.TURN / 2**a + rng.normal(size=n) * spread
        theta[1:] *= rng.random() > 0.2  # next to full stretch
        turn = np.cumsum(theta)
        goal = [int(np.clip(round(float(lengths @ part(turn))), -high, high - 1)) for part in (np.cos, np.sin)]
        rows += plane.solve(n, *goal)
    rows += plane.solve(n, *rng.choice([0, 1, -1, high - 1, -high], 2))
    return rows + plane.sets(rng.integers(0, 1 << a, n))[::2]


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Nothing loaded; a chain of each kind, of one link, of some, of all; what is not there, between them."""
    rng, most = np.random.default_rng(1), core.params["N"]
    most = most if cfg["cfg_limit"] < 5 else min(most, 8 if cfg["cfg_limit"] < 256 else 2)
    rows = plane.solve(1, 0, 0) + plane.loads(core.params, [1], [0], 2) + plane.loads(core.params, [5], [7])
    for n, kind in ((1, 0), (2, 0), (min(3, most), 3), (most, 0), (most, 1), (min(2, most), 2), (most, 2), (most, 0)):
        rows += _chain(core, rng, n, kind)
        rows += plane.solve(int(rng.choice([0, most + 1, 128, 255, core.params["N"] + 1])), 5, 5)[:1]
        rows += plane.loads(core.params, [9], [9], int(rng.choice([0, 129, core.params["N"] + 1])))
    every = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    wild = uniform(core, rng, 400)  # mostly of the first links, so that a few of them still are a chain
    wild["in_n"] = np.where(rng.random(400) < 0.7, rng.integers(1, 3, 400), wild["in_n"] % (min(most, 6) + 2))
    return {name: np.concatenate([words, wild[name]]) for name, words in every.items()}
