"""Corners of rtl/table: quadrant borders, ends of table segments, saturation, axes, undefined directions."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType

import numpy as np
from quadrance import codecs, truth
from quadrance.cores import Core, joints
from quadrance.fixed import wrap

from tb.lib import stimulus
from tb.lib.stimulus import Vectors
from tb.stimulus import chains, targets, vector


def _inverse(core: Core) -> ModuleType:
    """Where the configurations of an inverse core are; only some cores take long words."""
    return vector if core.params["W"] > 16 else targets


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Link lengths: longest, near the edge of saturation, none, one link alone, one LSB, and some at random."""
    if not core.cfg:
        return [{}]
    if core.function.startswith("ik"):
        high = (1 << core.params["W"]) - 1
        last = (high >> 3, 1, 0, high, *rng.integers(0, high >> 1, 4).tolist())
        more = [{"cfg_l3": length} if core.function == "ik3r" else {} for length in last]
        two = replace(core, function="ik2") if core.function == "ik3r" else core  # of its first two links
        return [cfg | more[i % len(more)] for i, cfg in enumerate(_inverse(core).configs(two, rng))]
    high = (1 << core.params["W"]) - 1
    half = high >> 2
    part = 5 * (high >> 3)  # alone it saturates an axis, not every direction
    pairs = [(high, high), (part, 1), (0, 0), (half, half), (high, 1), (1, high), (0, high >> 1), (high >> 1, 0),
             (768, 512), *rng.integers(0, high, (2, 2), endpoint=True).tolist(),
             *rng.integers(0, half, (2, 2)).tolist()]
    names = [port.name for port in core.cfg]
    return [dict(zip(names, pair)) for pair in pairs]


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Any links, and their words."""
    found = _inverse(core).draw(core, rng)
    return {"cfg_l3": stimulus.length(rng, core.params["W"])} | found


def _words(core: Core, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Joint words at quadrant borders, at borders of table segments of every size, and joints that add up to such."""
    near = [words for joint in joints(core.inputs) for words in codecs.border_words(joint).values()]
    a = core.params["A"]
    ends = (rng.integers(0, 1 << 13, 512) << a - 13 if a >= 13 else rng.integers(0, 1 << a, 512)) \
        + rng.integers(-1, 2, 512)
    words = [np.append(rng.permutation(border), rng.permutation(ends) & (1 << a) - 1) for border in near]
    if len(words) > 1:  # the sum of the first two at a border
        pick = rng.random(words[0].size) < 0.3
        words[1] = np.where(pick, wrap(rng.permutation(words[0]) - words[0], a, signed=False), words[1])
    return {port.name: word for port, word in zip(core.inputs, words)}


def _points(core: Core, rng: np.random.Generator) -> Vectors:
    """Every pair of 0, powers of two of both signs and their neighbours; the origin first and between others."""
    high = 1 << core.params["W"] - 1
    near = {sign * (1 << i) + j for i in range(core.params["W"]) for j in (-1, 0, 1) for sign in (-1, 1)}
    edge = np.array(sorted(value for value in near if -high <= value < high))
    x, y = (grid.ravel() for grid in np.meshgrid(edge, edge))
    order = rng.permutation(x.size)
    zero = rng.random(x.size) < 0.05
    zero[:2] = True
    return {"in_x": np.where(zero, 0, x[order]), "in_y": np.where(zero, 0, y[order])}


def _tips(core: Core, cfg: dict[str, int], rng: np.random.Generator) -> Vectors:
    """Wrists as `targets.corners` has them, and the last link from there in any direction; then extreme words."""
    wrists = targets.corners(replace(core, inputs=tuple(p for p in core.inputs if p.name != "in_phi")), cfg, rng)
    count, high = wrists["in_x"].size, 1 << core.params["W"] - 1
    phi = rng.integers(0, 1 << core.params["A"], count)
    phi[::5] = rng.integers(0, 4, phi[::5].size) << core.params["A"] - 2
    turn = phi * truth.TURN / (1 << core.params["A"])
    link = [np.rint(cfg["cfg_l3"] * part).astype(np.int64) for part in (np.cos(turn), np.sin(turn))]
    far = rng.random(count) < 0.1  # the wrist is beyond its word
    tips = {name: np.where(far, rng.choice([-high, high - 1], count), np.clip(wrists[name] + part, -high, high - 1))
            for name, part in zip(("in_x", "in_y"), link)}
    edges = np.resize([high - 1, high, -high, -high - 1], 32)  # of the wrist behind a link along an axis
    phi[:64] = np.resize(np.arange(4), 64) << core.params["A"] - 2
    for name, part in zip(("in_x", "in_y"), (np.cos, np.sin)):
        axis = np.rint(part(phi[:64] * truth.TURN / (1 << core.params["A"]))).astype(np.int64)
        tips[name][:64] = np.clip(np.append(edges, edges) + cfg["cfg_l3"] * axis, -high, high - 1)
    return wrists | tips | {"in_phi": phi}


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core; a singular sample follows and precedes a regular one."""
    if core.function == "chain":
        return chains.corners(core)
    rng = np.random.default_rng(1)
    if core.function.startswith("fk"):
        return stimulus.joined(_words(core, rng), stimulus.saturation(core, cfg))
    if core.function == "ik3r":
        return _tips(core, cfg, rng)
    return targets.corners(core, cfg, rng) if core.cfg else _points(core, rng)
