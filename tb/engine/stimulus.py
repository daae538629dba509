"""Corners of rtl/engine, by kind of engine."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core

from tb.engine import gradient
from tb.lib.stimulus import Vectors


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Configuration words of one core."""
    return gradient.configs(core, rng)


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed inputs of one core."""
    return gradient.corners(core, cfg)
