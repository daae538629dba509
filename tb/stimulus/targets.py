"""Corners of the inverse cores of rtl/vector: lengths with their configuration words, and targets."""

from __future__ import annotations

import numpy as np
from quadrance import kernel_vector_wide
from quadrance.cores import Core

from tb.lib import stimulus
from tb.lib.stimulus import Vectors, length
from tb.stimulus import edges, rational


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Lengths for many shifts of the gap: none, one LSB, equal and very different links, the longest, some anyhow."""
    high, f = (1 << core.params["W"]) - 1, core.params["F"]
    half = min(32 << f, high)
    lengths = [(high, high), (half, half), (0, 0), (high, 0), (0, high), (1, high), (high, 1), (1, 1), (3, 2),
               (half, half // 5 * 4), (half // 5, half), (3 << f, 2 << f), (16, 16), (2, 128), (256, 256), (255, 257),
               (64, 50), (700, 900), (2900, 3000), *rng.integers(0, high, (3, 2), endpoint=True).tolist(),
               *rng.integers(0, half, (3, 2)).tolist()]
    pairs = [{"cfg_l1": min(l1, high), "cfg_l2": min(l2, high)} for l1, l2 in lengths]
    return edges.joined(core, rng, [pair | kernel_vector_wide.config(core.params, **pair) for pair in pairs])


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Any links, and their words."""
    pair = {f"cfg_l{i}": length(rng, core.params["W"]) for i in (1, 2)}
    derived = kernel_vector_wide.config(core.params, **pair) if core.function.startswith("ik") else {}
    return pair | {"cfg_l3": length(rng, core.params["W"])} | derived | edges.drawn(core, rng, pair["cfg_l2"])


def corners(core: Core, cfg: dict[str, int], rng: np.random.Generator) -> Vectors:
    """Borders of reach all round, axes, the shoulder and its neighbours, extreme words; both elbows.

    The first samples have no direction of joint 1 (or 3), nor have some between defined ones: held words.
    """
    targets = rational.targets(core, cfg, rng)
    axes = [axis for axis in targets if axis != "in_elbow"]
    near = [rng.integers(-6, 7, 256) << rng.integers(0, 8, 256) for _ in axes]  # where equal links fold up
    near = [np.clip(word, -1 << core.params["W"] - 1, (1 << core.params["W"] - 1) - 1) for word in near]
    more = stimulus.joined(targets, dict(zip(axes, near)) | {"in_elbow": rng.integers(0, 2, 256)})
    return stimulus.joined(more, edges.targets(core, cfg, rng)) if core.params.get("MARGINS") else more
