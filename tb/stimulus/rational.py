"""Corners of rtl/rational: quadrant borders, table ranges, saturation, undefined directions."""

from __future__ import annotations

import numpy as np
from quadrance import codecs, rational
from quadrance.cores import Core, joints

from tb.lib import stimulus
from tb.lib.stimulus import Vectors
from tb.stimulus import edges


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Link lengths: longest, none, one LSB, the longest that never saturates, 64 units, and two at random."""
    high, f = (1 << core.params["W"]) - 1, core.params["F"]
    if any(port.name == "cfg_r" for port in core.cfg):
        half = min(32 << f, high)
        lengths = [(high, high), (half, half), (0, 0), (high, 0), (0, high), (1, high), (1, 1), (half, half // 5 * 4),
                   (half // 5, half), (3 << f, 2 << f), (16, 16), (2, 128), (256, 256), (255, 257), (4096, 4096 & high),
                   *rng.integers(0, high, (3, 2), endpoint=True).tolist(), *rng.integers(0, half, (3, 2)).tolist()]
        pairs = [{"cfg_l1": min(l1, high), "cfg_l2": min(l2, high)} for l1, l2 in lengths]
        return edges.joined(core, rng, [pair | rational.config(core.params, **pair) for pair in pairs])
    if len(core.cfg) == 2:
        half = min(32 << f, high)
        pairs = [(high, high), (0, 0), (half, half), (high, 1), (1, high), (0, half), (half, 0), (3 << f, 2 << f),
                 *rng.integers(0, high, (3, 2), endpoint=True).tolist(), *rng.integers(0, half, (3, 2)).tolist()]
        return [{"cfg_l1": min(l1, high), "cfg_l2": min(l2, high)} for l1, l2 in pairs]
    lengths = [high, 0, 1, high >> 1, (high >> 1) + 1, min(64 << f, high),
               *rng.integers(0, high, 2, endpoint=True).tolist()]
    return [{port.name: length for port in core.cfg} for length in lengths] if core.cfg else [{}]


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Any links, and their words."""
    pair = {f"cfg_l{i}": stimulus.length(rng, core.params["W"]) for i in (1, 2)}
    words = rational.config(core.params, **pair) if core.function.startswith("ik") else {}
    return pair | words | edges.drawn(core, rng, pair["cfg_l2"])


def points(w: int) -> tuple[np.ndarray, np.ndarray]:
    """Every pair of 0, powers of two of both signs and their neighbours; directions where the nearer axis changes."""
    high = 1 << w - 1
    near = {sign * (1 << i) + j for i in range(w) for j in (-1, 0, 1) for sign in (-1, 1)}
    edge = np.array(sorted(value for value in near if -high <= value < high))
    x, y = (grid.ravel() for grid in np.meshgrid(edge, edge, indexing="ij"))
    return x, y


def targets(core: Core, cfg: dict[str, int], rng: np.random.Generator) -> Vectors:
    """Both borders of reach and their neighbours all round, folded and stretched along every axis, the hole, the base
    axis and the origin, points far outside, and every extreme word; both elbows. 0 first: held words, 0 after reset.
    """
    axes = [port.name for port in core.inputs if port.name not in ("in_elbow", "in_back")]
    high = 1 << core.params["W"] - 1
    l1, l2 = cfg["cfg_l1"], cfg["cfg_l2"]
    radius = np.array([abs(l1 - l2), l1 + l2, max(l1, l2), (l1 * l1 + l2 * l2) ** 0.5, abs(l1 - l2) / 2, 3, high * 1.3])
    turn = np.pi / 4 * rng.integers(0, 8, 512) + rng.choice([0, 1e-4, 0.1], 512) * rng.normal(size=512)
    turn[::4] = rng.uniform(0, 2 * np.pi, 128)
    parts = [np.cos(turn), np.sin(turn)]
    if len(axes) == 3:
        yaw = np.pi / 4 * rng.integers(0, 8, 512) + (rng.random(512) < 0.5) * rng.normal(size=512)
        parts = [parts[0] * np.cos(yaw), parts[0] * np.sin(yaw), parts[1]]
    near = np.tile(radius, 74)[:512]
    words = [np.rint(near * part).astype(np.int64) for part in parts]
    words = [word + rng.integers(-1, 2, 512) * (rng.random(512) < 0.5) for word in words]
    edge = np.array([0, 0, 1, -1, high - 1, -high, 1 - high, l1, -l1, l2, -l2, l1 + l2, -l1 - l2, l1 - l2, 2, -7])
    words = [np.concatenate([rng.choice(edge, 512), word]) for word in words]
    order = rng.permutation(1024)
    words = [np.clip(np.append([0, 0, 0], word[order]), -high, high - 1) for word in words]
    base = rng.random(1027) < 0.05
    for word in words[:2]:
        word[base] = 0
    return dict(zip(axes, words)) | {"in_elbow": rng.integers(0, 2, 1027)}


def _last(core: Core, cfg: dict[str, int]) -> Vectors:
    """Of many words of coarse spreads those whose tip is the nearest to an end: a step of one moves it by thousands."""
    rng = np.random.default_rng(2)
    words = {port.name: rng.integers(port.low, port.high, 1 << 20, endpoint=True) for port in core.inputs}
    answer = core.model(core.params, **words, **cfg)
    fits = np.flatnonzero(answer["out_status"] == 0)
    best = [fits[np.argmin(np.abs(answer[port.name][fits] - end))] for port in stimulus.coordinates(core)
            for end in stimulus.ends(core, port)] if fits.size else []
    return {name: word[best] for name, word in words.items()}


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core; a singular sample follows and precedes a regular one."""
    rng = np.random.default_rng(1)
    if core.function.startswith("fk"):
        borders = {name: rng.permutation(words) for joint in joints(core.inputs)
                   for name, words in codecs.border_words(joint).items()}
        words = stimulus.joined(borders, stimulus.saturation(core, cfg))
        return stimulus.joined(words, _last(core, cfg)) if core.params["S"] < 16 < core.params["W"] else words
    if core.function in ("ik2", "ik3"):
        words = targets(core, cfg, rng)
        return stimulus.joined(words, edges.targets(core, cfg, rng)) if core.params["MARGINS"] else words
    x, y = points(core.params["W"])
    order = np.append(rng.permutation(np.arange(x.size)), rng.integers(0, x.size, x.size // 8))
    x, y = x[order], y[order]
    zero = rng.random(x.size) < 0.05
    zero[:2] = True  # held word: 0 after reset
    return {"in_x": np.where(zero, 0, x), "in_y": np.where(zero, 0, y)}
