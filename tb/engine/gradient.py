"""Corners of the gradient engines: starts and targets in reach, beyond, at its borders; warm samples among others."""

from __future__ import annotations

import numpy as np
from quadrance import truth
from quadrance.cores import Core
from quadrance.iterative import fixed, gradient

from tb.lib.stimulus import Vectors

MODELS = ("iterative.fixed.gd", "iterative.fixed.gd_vector", "iterative.fixed.gd_touch")


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """A short run first; then links that are none, longest, shortest; steps too long; tolerance 0, limit 0; a limit of
    long bits, which the few samples that do not converge reach.
    """
    p, high = core.params, (1 << core.params["W"]) - 1
    half = high >> 2
    step = fixed.config_vector if core.model_name.endswith("vector") else fixed.config

    def words(l1: int, l2: int, tol: int, limit: int, gain: float = 0.35) -> dict[str, int]:
        return {"cfg_l1": l1, "cfg_l2": l2, "cfg_tol": tol, "cfg_limit": limit} \
            | step(p, cfg_l1=l1, cfg_l2=l2, gain=gain)

    wild = {"cfg_alpha": 2 * high + 1, "cfg_shift": 0}
    return [words(half, half * 4 // 5, 6400, 9), words(half, half, 9, 60), words(half // 2, half // 3, 256, 40),
            words(high, high, 64, 12), words(half, half, 0, 5), words(half, half, 1600, 0),
            {"cfg_l1": 0, "cfg_l2": 0, "cfg_tol": 9, "cfg_limit": 3} | wild, words(half, 0, 50, 30),
            words(0, half, 50, 30), words(half, half, (1 << 22) - 1, 1) | wild, words(high, half, 1000, 15) | wild,
            words(half, high, 1000, 15),
            words(half, half // 2, 8, 60, 0.5),
            *[words(high // 2, high // 2, 1600, 0x3C5)] * core.first_set]  # a thousand iterations of the model


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """A third each: targets of random joints, targets at the borders of reach, extreme words; starts near and far."""
    rng, count = np.random.default_rng(1), 150
    w, space = core.params["W"], core.model_name.endswith("touch")
    high, joints = 1 << w - 1, 3 if space else 2
    theta = rng.uniform(-np.pi, np.pi, (count, joints))
    theta[50:100, -1] = np.pi / 2 * rng.integers(0, 4, 50) + rng.choice([0, 1e-3], 50)
    arm = (gradient.touch if space else gradient.planar)(cfg["cfg_l1"], cfg["cfg_l2"])
    goal = np.rint(arm(theta)[0])
    goal[100:] = rng.choice([0, 1, -1, high - 1, -high], (50, goal.shape[1]))
    start = theta + rng.normal(size=(count, joints)) * rng.choice([0, 1e-5, 1e-2, 1], count)[:, None]
    order = rng.permutation(count)
    goal = np.clip(goal.astype(np.int64), -high, high - 1)[order]
    warm = rng.integers(0, 2, count)
    warm[0] = 1  # the first sample behind a reset starts from the reset's
    if core.model_name.endswith("vector"):
        one = 1 << w
        length = rng.choice([1, 1, 1, 1.1, 0.7, 0.1], count)[:, None]
        c, n = (np.rint(one * length * each) for each in truth.unit(np.cumsum(start, axis=-1)))
        word = np.stack([c[:, 0], n[:, 0], c[:, 1], n[:, 1]], axis=-1).astype(np.int64)
        word[::7] = rng.choice([0, 1, one, -one, one + 1, -2 * one, 2 * one - 1, 5 * one // 8], (word[::7].shape[0], 4))
    else:
        a = core.params["A"]
        word = np.rint(start / (2 * np.pi) * (1 << a)).astype(np.int64) & (1 << a) - 1
        word[::7] = rng.choice([0, 1, (1 << a) - 1, 1 << a - 1, 1 << a - 2], (word[::7].shape[0], joints))
    names = [port.name for port in core.inputs]
    columns = [*goal.T, *word[order].T, warm]
    return dict(zip(names, columns))
