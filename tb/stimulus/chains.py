"""Corners of the streamed chains of vector, table and paper: of every number of links, at the borders of words.

Samples are links in the order of the stream; the last link of every chain is marked.
"""

from __future__ import annotations

import numpy as np
from quadrance import codecs
from quadrance.cores import Core, joints

from tb.lib.stimulus import Vectors, extremes


def _chain(rng: np.random.Generator, core: Core, count: int) -> Vectors:
    """One chain: its joints anywhere or at borders of a quadrant, its lengths together within, at or beyond a word."""
    words = {}
    for joint in joints(core.inputs):
        border = codecs.border_words(joint)
        pick = rng.integers(0, border[joint[0].name].size, count)
        anywhere = codecs.encode(joint, rng.uniform(0, 2 * np.pi, count))
        mixed = rng.random(count) < rng.choice([0.0, 0.5, 1.0])
        words |= {name: np.where(mixed, border[name][pick], anywhere[name]) for name in border}
    full = 1 << core.params["W"]
    kind = rng.integers(0, 4)
    longest = full if kind == 0 else full // 2 // count + 1
    return words | {"in_l": np.full(count, full - 1) if kind == 1 else rng.integers(0, longest, count)}


def _straight(core: Core) -> list[Vectors]:
    """Along each axis to the last coordinate inside, the first outside and on.

    The first joint alone is turned, but in the fixed frame every link is: theta, then phi.
    """
    words, half = joints(core.inputs), 1 << core.params["W"] - 1
    found = []
    for turns in np.ndindex((4,) * len(words)):
        chain = {"in_l": np.array([half - 3, 1, 1, 1, 1, half])}
        for joint, turn in zip(words, turns):
            chain |= codecs.encode(joint, np.pi / 2 * turn * (np.arange(6) < (1 if len(words) == 1 else 6)))
        if not core.params.get("SPACE"):
            found.append(chain)
            continue
        for yaw in range(4):  # by an axis first; its length is not looked at
            first = {"in_l": half} | codecs.encode(words[0], np.pi / 2 * yaw)
            found.append({name: np.append(first[name], word) for name, word in chain.items()})
    return found


def corners(core: Core) -> Vectors:
    """Chains of 1 to N + 3 links, some twice; straight ones at the edge of saturation; vectors of any length."""
    rng, most = np.random.default_rng(1), core.params["N"]
    counts = [1, 2, 3, most - 1, most, most + 1, most + 3, *rng.integers(1, most + 4, 12), 1, 1]
    chains = [_chain(rng, core, max(int(count), 1)) for count in counts for _ in range(2)] + _straight(core)
    for port in core.inputs:
        if port.type == "vector":
            for count in (2, 3, 5):
                words = _chain(rng, core, count)
                words[port.name] = rng.choice(extremes(port), count)
                chains.append(words)
    order = rng.permutation(len(chains))
    size = [chains[i]["in_l"].size for i in order]
    last = np.zeros(sum(size), dtype=np.int64)
    last[np.cumsum(size) - 1] = 1
    return {name: np.concatenate([chains[i][name] for i in order]) for name in chains[0]} | {"in_last": last}
