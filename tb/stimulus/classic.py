"""Corners of rtl/classic: quadrant borders, the axes, the origin, saturation; link lengths as their derived words."""

from __future__ import annotations

import numpy as np
from quadrance import classic
from quadrance.cores import Core

from tb.lib import stimulus
from tb.lib.stimulus import Vectors
from tb.stimulus.cordic import alone


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Link lengths from the greatest to none: saturating, the longest that never saturates, common, short; a pair
    whose sum squared begins with the digit 2, to the base of 4."""
    if not core.cfg:
        return [{}]
    half = 1 << core.params["W"] - 1
    if core.function not in ("fk1", "ik1"):
        pairs = [(2 * half - 1, 2 * half - 1), (half // 2, half // 2), (0, 2 * half - 1), (half // 3, half // 4),
                 (2 * half - 1, 0), (1, half // 5), (half // 5, 1), (0, 0),
                 (2 * half - 1, 5 * half // 4), tuple(map(int, rng.integers(1, half, 2)))]
        derived = [classic.config(core.params, cfg_l1=l1, cfg_l2=l2) for l1, l2 in pairs]
        return [{port.name: words[port.name] for port in core.cfg} for words in derived]
    lengths = (2 * half - 1, 5 * half // 4, half - 1, int(rng.integers(half // 16, half)),
               int(rng.integers(half, 2 * half)), 1, 0)
    return [{"cfg_c1": classic.config(core.params, cfg_l1=length)["cfg_c1"]} for length in lengths]


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Words of any two links."""
    lengths = {f"cfg_l{i}": stimulus.length(rng, core.params["W"]) for i in (1, 2)}
    return classic.config(core.params, **lengths)


def _angles(core: Core) -> np.ndarray:
    """Every eighth of a turn with its neighbours."""
    full = 1 << core.params["A"]
    return np.unique((np.arange(8)[:, None] * (full // 8) + np.arange(-2, 3)) % full)


def _coordinates(core: Core) -> np.ndarray:
    """Extremes and powers of two of a coordinate word, both signs."""
    half = 1 << core.params["W"] - 1
    small = [0, 1, 2, 3, half // 3, half // 2, half - 2, half - 1, *(1 << i for i in range(4, core.params["W"] - 2, 3))]
    return np.unique([*small, *(-value for value in small), -half])


def _targets(core: Core, cfg: dict[str, int]) -> Vectors:
    """Every border of the reach from both sides, the axes and the origin between, both elbows."""
    rng = np.random.default_rng(1)
    half = 1 << core.params["W"] - 1
    far, near = cfg["cfg_far"] ** 0.5, cfg["cfg_near"] ** 0.5
    radius = np.repeat([far, near, (far + near) / 2, rng.uniform(near, far), 2.0, half], 48)
    radius = np.minimum(radius, half * 1.4) + rng.integers(-2, 3, radius.size)
    theta = np.pi / 4 * rng.integers(0, 8, radius.size) + rng.random(radius.size) * rng.integers(0, 2, radius.size)
    tilt = np.pi / 4 * rng.integers(-2, 3, radius.size) * (core.function == "ik3")
    words = {"in_x": radius * np.cos(tilt) * np.cos(theta), "in_y": radius * np.cos(tilt) * np.sin(theta),
             "in_z": radius * np.sin(tilt)}
    vectors = {name: np.clip(np.rint(value), -half, half - 1).astype(np.int64) for name, value in words.items()}
    edges = _coordinates(core)
    vectors = {name: np.concatenate([value, rng.choice(edges, 120)]) for name, value in vectors.items()}
    count = vectors["in_x"].size
    blank = np.arange(count) % 11 == 3
    for name in ("in_x", "in_y"):
        vectors[name][blank] = 0
    vectors["in_z"][np.arange(count) % 22 == 3] = 0
    bits = alone(core.params["W"], 3)
    vectors = {name: np.concatenate([value, bits[:, i]]) for i, (name, value) in enumerate(vectors.items())}
    count += len(bits)
    vectors["in_elbow"] = rng.integers(0, 2, count)
    return {port.name: vectors[port.name] for port in core.inputs}


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core; inverse cores see the origin between other targets, so that a hold shows."""
    if core.function == "fk1":
        return stimulus.joined({"in_j1": _angles(core)}, stimulus.saturation(core, cfg))
    if core.function in ("fk2", "fk3"):
        order = np.random.default_rng(1)
        joints = np.stack(np.meshgrid(_angles(core), _angles(core)), axis=-1).reshape(-1, 2)
        joints = np.column_stack([joints, order.permutation(np.resize(_angles(core), len(joints)))])
        eighths = {port.name: joints[:, i] for i, port in enumerate(core.inputs)}
        return stimulus.joined(eighths, stimulus.saturation(core, cfg))
    if core.function in ("ik2", "ik3"):
        return _targets(core, cfg)
    x, y = (grid.ravel() for grid in np.meshgrid(_coordinates(core), _coordinates(core)))
    order = np.random.default_rng(1).permutation(x.size)
    blank = np.arange(x.size) % 17 == 3
    bits = alone(core.params["W"], 2)
    return {"in_x": np.concatenate([np.where(blank, 0, x[order]), bits[:, 0]]),
            "in_y": np.concatenate([np.where(blank, 0, y[order]), bits[:, 1]])}
