"""Stimuli of two cores in series (tb/lib/chain.py): inputs of the first one, configurations of both."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from quadrance.cores import Core

from tb.lib import stimulus
from tb.lib.chain import Chain
from tb.lib.stimulus import Config, Vectors


def configs(core: Chain, rng: np.random.Generator) -> list[Config]:
    """Those of the inverse core."""
    return stimulus.configs(_inverse(core), rng)


def draw(core: Chain, rng: np.random.Generator) -> Config:
    """As `configs`."""
    return stimulus.drawn(_inverse(core), rng)


def _inverse(core: Chain) -> Core:
    """The one with more words, as if it had those of both."""
    return replace(max(core.first, core.second, key=lambda one: len(one.cfg)), cfg=core.cfg)


def corners(core: Chain, cfg: Config) -> Vectors:
    """Those of the first core."""
    return stimulus.corners(core.first, {port.name: cfg[port.name] for port in core.first.cfg})
