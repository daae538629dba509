"""Corners of rtl/paper: quadrant borders and their neighbours, the axes, the origin, saturation."""

from __future__ import annotations

import numpy as np
from quadrance import codecs
from quadrance.cores import Core

from tb.lib import stimulus
from tb.lib.stimulus import Vectors
from tb.stimulus import chains


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Link lengths from the greatest to none: saturating, the longest that never saturates, common, short."""
    if not core.cfg:
        return [{}]
    half = 1 << core.params["W"] - 1
    if len(core.cfg) >= 2:
        near = int(rng.integers(half // 64, half // 32))  # the paper's range, (L1 + L2)^2 < 128; ours is half a word
        unit = 1 << core.params["F"]  # quadrances of a few units: their last bits decide quotients
        pairs = [(half // 2 - 1, half // 2), (3 * near, 2 * near), (near, near), (half - 1, half - 1),
                 (2 * half - 1, near), (near, 2 * half - 1), (half, near), (near, half), (half - 1, near),
                 (near, half - 1), (near, 0), (0, near), (2 * unit, 3 * unit // 2)]
        names = [port.name for port in core.cfg]  # of three the last one is another pair's second
        return [dict(zip(names, (*pair, other))) for pair, (_, other) in zip(pairs, pairs[1:] + pairs[:1])]
    some, long = int(rng.integers(half // 16, half)), int(rng.integers(half, 2 * half))
    return [{"cfg_l1": length} for length in (2 * half - 1, 5 * half // 4, half, half - 1, some, long, 1, 0)]


def coordinates(core: Core) -> list[int]:
    """Extremes and powers of two of a coordinate word, both signs."""
    half = 1 << core.params["W"] - 1
    small = [0, 1, 2, 3, half // 3, half // 2, half - 2, half - 1, *(1 << i for i in range(4, core.params["W"] - 2, 3))]
    return [*small, *(-value for value in small if value), -half]


def cells(core: Core) -> list[np.ndarray]:
    """Joint words for every cell of quadrants, off the borders, then borders paired at random."""
    s, joints = core.params["S"], len(core.inputs)
    middles = [(k << s) + f for k in range(4) for f in (1 << s - 2, 3 << s - 2)]
    inside = np.stack(np.meshgrid(*[middles[::joints - 1]] * joints), axis=-1).reshape(-1, joints)
    rng = np.random.default_rng(1)
    edge = rng.choice(codecs.border_words(core.inputs[:1])["in_j1"], (400, joints))
    return list(np.concatenate([inside, edge]).T)


def targets(core: Core, cfg: dict[str, int]) -> Vectors:
    """The axes, the origin between other targets, the yaw axis, both edges of the annulus, and all of the extremes."""
    rng = np.random.default_rng(1)
    axes = [port.name for port in core.inputs if port.name != "in_elbow"]
    half = 1 << core.params["W"] - 1
    far, near = cfg["cfg_l1"] + cfg["cfg_l2"], abs(cfg["cfg_l1"] - cfg["cfg_l2"])
    radius = (np.array([far, near, far / 2, (far + near) / 2])[:, None] + np.arange(-2, 3)).ravel()
    angle = np.pi / 4 * np.arange(8)[:, None]
    edge = [(radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel(), np.zeros(radius.size * 8)]
    word = rng.choice(coordinates(core), (300, len(axes)))
    word[rng.random(word.shape) < 0.2] = 0
    word[3::17] = 0
    rows = np.concatenate([np.rint(np.stack(edge[:len(axes)], axis=-1)), word])
    rows = np.clip(rows, -half, half - 1).astype(np.int64)
    columns = dict(zip(axes, rows.T))
    return columns | {"in_elbow": np.arange(len(rows)) // 3 % 2}


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core; inverse cores see the origin between other targets, so that a hold shows."""
    if core.function == "mff":
        return chains.corners(core)
    if core.function == "fk1":
        return stimulus.joined(codecs.border_words(core.inputs), stimulus.saturation(core, cfg))
    if core.function in ("fk2", "fk3", "fk5"):
        inside = dict(zip((port.name for port in core.inputs), cells(core)))
        return stimulus.joined(inside, stimulus.saturation(core, cfg))
    if core.function in ("ik2", "ik3"):
        return targets(core, cfg)
    if core.function in ("root", "quotient", "sign"):
        return _parts(core)
    x, y = (grid.ravel() for grid in np.meshgrid(coordinates(core), coordinates(core)))
    order = np.random.default_rng(1).permutation(x.size)
    blank = np.arange(x.size) % 17 == 3
    return {"in_x": np.where(blank, 0, x[order]), "in_y": np.where(blank, 0, y[order])}


def _parts(core: Core) -> Vectors:
    """Squares and their neighbours; remainders at the divisor; the extremes of every port."""
    if core.function == "root":
        n = core.params["N"]
        roots = np.arange(0, 1 << n, 1 if n < 10 else max(97, (1 << n) // 700))
        near = (roots * roots)[:, None] + np.array([-1, 0, 1])
        return {"in_d": np.unique(np.clip(near, 0, (1 << 2 * core.params["N"]) - 1))}
    rng = np.random.default_rng(1)
    columns = {port.name: rng.choice(stimulus.extremes(port), 200) for port in core.inputs}
    if core.function == "quotient":
        d = rng.integers(0, 1 << core.params["Q"], 400)
        rem = d - rng.integers(0, 2, 400) * rng.integers(0, d + 1)
        columns = {"in_rem": np.append(columns["in_rem"], rem), "in_d": np.append(columns["in_d"], d)}
    return columns
