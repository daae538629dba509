"""Corners of rtl/engine: each model's stand in a file of their own."""

from __future__ import annotations

import numpy as np
from quadrance.cores import Core

from tb.engine import delta, gradient, newton, plane, rotation, rus_fk, rus_ik, space
from tb.lib.stimulus import Vectors

MODELS = dict.fromkeys(gradient.MODELS, gradient) | {
    "engine_rus.ik": rus_ik, "engine_rus.ik_angle": rus_ik, "engine_rus_fk.fk": rus_fk,
    "engine_rus.rotation_check": rotation, "engine_rus.quaternion_to_matrix": rotation,
    "engine_delta.fk": delta, "engine_delta.fk_angle": delta, "iterative.plane.gd": plane, "iterative.space.gd": space,
    "iterative.newton_fixed.solve": newton, "iterative.damped.solve": newton}


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Configuration words for a core."""
    return MODELS[core.model_name].configs(core, rng)


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Any words, but few iterations."""
    words = {port.name: int(rng.integers(port.low, port.high, endpoint=True)) for port in core.cfg}
    return {name: word & 15 if name == "cfg_limit" else word for name, word in words.items()}


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Directed samples for a core in a configuration."""
    return MODELS[core.model_name].corners(core, cfg)
