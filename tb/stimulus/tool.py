"""Corners of rtl/tool: tables at eighths of a turn and next to them, points anywhere and at the ends of their words."""

from __future__ import annotations

import numpy as np
from quadrance import codecs
from quadrance.cores import Core, joints

from tb.lib import stimulus
from tb.lib.stimulus import Vectors


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """No offset; offsets of some sizes; the extremes of all words."""
    found = [dict.fromkeys((port.name for port in core.cfg), 0)]
    found += [{port.name: int(rng.integers(port.low, port.high)) >> less for port in core.cfg} for less in (5, 3, 2, 1)]
    return found + [{port.name: port.low for port in core.cfg}, {port.name: port.high for port in core.cfg}]


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Regular samples, wild ones, extremes, and both sides of saturation."""
    rng, found, count = np.random.default_rng(1), {}, 300
    for joint in joints(core.inputs):
        angle = np.pi / 4 * rng.integers(0, 8, count)
        angle += rng.integers(0, 2, count) * rng.choice([-1, 1], count) * 2.0 ** -rng.uniform(0, 20, count)
        found |= codecs.encode(joint, angle)
    for port in core.inputs:
        if port.type is None:
            found[port.name] = rng.integers(port.low, port.high, count) >> rng.integers(0, port.width, count)
    wild = stimulus.uniform(core, rng, 200)
    extreme = {port.name: rng.choice(stimulus.extremes(port), 100) for port in core.inputs}
    edges = stimulus.saturation(core, cfg, found)
    return stimulus.joined(stimulus.joined(stimulus.joined(found, wild), extreme), edges)
