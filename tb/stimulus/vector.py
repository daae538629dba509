"""Corners of rtl/vector: vectors about every border, of any length, saturation, undefined directions."""

from __future__ import annotations

import numpy as np
from quadrance import codecs, vector
from quadrance.cores import Core, at, joints

from tb.lib import stimulus
from tb.lib.stimulus import Vectors, extremes, length
from tb.stimulus import chains, edges, rational, targets


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Link lengths: longest, none, one LSB, where the word just does not saturate and just does, some at random."""
    if core.function in ("ik2", "ik3"):
        return _wide(core, rng) if core.params["W"] > 16 else targets.configs(core, rng)
    high = (1 << core.params["W"]) - 1
    half = high >> 1
    pairs = [(high, high), (0, 0), (half, half + 1), (half + 1, half), (half, 1), (1, half), (0, half), (half + 1, 0),
             (half // 2, half // 2), *rng.integers(0, high, (2, 2), endpoint=True).tolist(),
             *rng.integers(0, half // 2, (3, 2)).tolist()]
    lengths = [dict(zip(("cfg_l1", "cfg_l2"), pair)) for pair in pairs]
    return [{port.name: words[port.name] for port in core.cfg} for words in lengths] if core.cfg else [{}]


def _wide(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """The links of words of 16 bits, longer by the bits that W has more, each with some LSB on top."""
    more, narrow = core.params["W"] - 16, at(core, core.params | {"W": 16, "F": 8, "U": 16})
    found = []
    for cfg in targets.configs(narrow, rng):
        extra = [0, 0] if rng.integers(0, 2) else rng.integers(0, 1 << more, 2).tolist()
        pair = {name: (cfg[name] << more) + one for name, one in zip(("cfg_l1", "cfg_l2"), extra)}
        found.append(pair | vector.config(core.params, **pair))
    return edges.joined(core, rng, found)


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Any links, and their words."""
    pair = {f"cfg_l{i}": length(rng, core.params["W"]) for i in (1, 2)}
    words = vector.config(core.params, **pair) if core.function.startswith("ik") else {}
    return pair | words | edges.drawn(core, rng, pair["cfg_l2"])


def directions(core: Core, rng: np.random.Generator) -> Vectors:
    """A third border words, a third directions anywhere, the rest vectors of any length, the extremes among them."""
    words: Vectors = {}
    for joint in joints(core.inputs):
        border = codecs.border_words(joint)
        pick = rng.integers(0, border[joint[0].name].size, 400)
        anywhere = codecs.encode(joint, rng.uniform(0, 2 * np.pi, 400))
        order = rng.permutation(1200)
        for port in joint:
            some = np.append(rng.choice(extremes(port), 200), rng.integers(port.low, port.high, 200, endpoint=True))
            words[port.name] = np.concatenate([border[port.name][pick], anywhere[port.name], some])[order]
    return words


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core; a singular sample follows and precedes a regular one."""
    if core.function == "chain":
        return chains.corners(core)
    rng = np.random.default_rng(1)
    if core.function.startswith("fk"):
        return stimulus.joined(directions(core, rng), stimulus.saturation(core, cfg))
    if core.function in ("ik2", "ik3"):
        return targets.corners(core, cfg, rng)
    x, y = rational.points(core.params["W"])
    order = np.append(rng.permutation(np.arange(x.size)), rng.integers(0, x.size, x.size // 8))
    x, y = x[order], y[order]
    zero = rng.random(x.size) < 0.05
    zero[:2] = True  # held word: that of the angle 0 after reset
    return {"in_x": np.where(zero, 0, x), "in_y": np.where(zero, 0, y)}
