"""Corners of rtl/codec: quadrant borders, borders of chords, the diagonals, vectors of any length, no direction."""

from __future__ import annotations

import numpy as np
from quadrance import codecs
from quadrance.cores import Core, joints

from tb.lib.stimulus import Vectors, extremes


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one codec; a vector without a direction stands between others, so that a hold shows."""
    rng = np.random.default_rng(1)
    if core.function == "vector_to_spread":
        return _plain(core)
    joint = joints(core.inputs)[0]
    if len(joint) == 2:
        return _vectors(core, rng)
    port, bits = joint[0], joint[0].width - 11  # of a word below the address of its table
    ends = (rng.integers(0, 1 << 11, 512) << bits) + rng.integers(-1, 2, 512) & port.high
    return {port.name: rng.permutation(np.concatenate([codecs.border_words(joint)[port.name], ends]))}


def _vectors(core: Core, rng: np.random.Generator) -> Vectors:
    """Unit vectors beside borders and anywhere; nearer another axis, or none; any length; extremes; one bit."""
    joint, one = joints(core.inputs)[0], 1 << core.params["U"]
    border = codecs.border_words(joint)
    anywhere = codecs.encode(joint, rng.uniform(0, 2 * np.pi, 400))
    edges = [edge + step for size in (one // 2, one * 11 // 16, round(one * 0.75**0.5), one * 3 // 2)
             for edge in (-size, size) for step in (-1, 0, 1)]
    words = {}
    for along, port in enumerate(joint):
        bits = 1 << np.arange(port.width - 1)
        bit = np.roll(np.concatenate([bits, -bits, 0 * bits, 0 * bits]), 2 * along * bits.size)  # on either axis
        edge = np.append(rng.choice(edges, 300), rng.choice(extremes(port), 300))
        words[port.name] = np.concatenate([border[port.name], anywhere[port.name], edge, bit,
                                           rng.integers(port.low, port.high, 200, endpoint=True)])
    size = words[joint[0].name].size
    order, blank = rng.permutation(size), np.arange(size) % 11 == 3
    blank[:2] = True  # held word: 0 after a reset
    zeros = sum((word == 0).astype(int) for word in words.values())
    lone = ((zeros == 1) & np.all([word & word - 1 == 0 for word in words.values()], axis=0))[order]  # of one bit
    return {name: np.where(blank & ~lone, 0, word[order]) for name, word in words.items()}


def _plain(core: Core) -> Vectors:
    """Extremes, the diagonals and the axes of vectors of any length."""
    top = 1 << core.params["W"] - 1
    sizes = sorted({0, 1, 2, top // 3, top // 2, top - 2, top - 1})
    words = np.array([*sizes, *(-v for v in sizes if v), -top])
    c, n = (grid.ravel() for grid in np.meshgrid(words, words))
    order = np.random.default_rng(1).permutation(c.size)
    blank = np.arange(c.size) % 11 == 3
    return {"in_c": np.where(blank, 0, c[order]), "in_n": np.where(blank, 0, n[order])}
