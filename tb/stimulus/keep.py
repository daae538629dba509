"""Corners of rtl/keep: those of the cores with all branches, with machines of all kinds."""

from __future__ import annotations

from types import ModuleType

import numpy as np
from quadrance import keep
from quadrance.cores import Core, at, find

from tb.lib.stimulus import Vectors
from tb.stimulus import six, ur


def all_branches(core: Core) -> tuple[ModuleType, Core]:
    """The corners and the core of the inverse that answers all branches."""
    stimuli, name = (six, "vector_ik6_all") if core.function == "six_keep" else (ur, "vector_ur_ik_all")
    return stimuli, at(find(name), {key: core.params[key] for key in ("W", "F", "U", "PIPE")})


def machine(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """Words of a machine's joints, limited to a quarter of a turn or up to 3.5 turns."""
    words = {port.name: int(rng.integers(port.low, port.high, endpoint=True)) for port in core.cfg
             if port.name in keep.MACHINE}
    for i in range(1, 7):
        size = float(rng.choice([0.25, 0.5, 1.0, 3.5])) * 2**keep.LIMIT
        words |= {f"cfg_low{i}": -int(size * rng.uniform(0.1, 1)), f"cfg_high{i}": int(size * rng.uniform(0.1, 1))}
    return words


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Arms with a machine that is free, one that is limited, in turn; then the extremes of every word of a machine."""
    stimuli, inverse = all_branches(core)
    ports = {port.name: port for port in core.cfg if port.name in keep.MACHINE}
    free = dict.fromkeys(ports, 0) | {f"cfg_{name}{i}": word for i in range(1, 7) for name, word in (
        ("low", -7 << keep.LIMIT - 1), ("high", 7 << keep.LIMIT - 1), ("w", keep.WEIGHT))}
    found = [cfg | (free, machine(core, rng))[i % 2] for i, cfg in enumerate(stimuli.configs(inverse, rng))]
    return found + [found[0] | {name: getattr(port, end) for name, port in ports.items()} for end in ("low", "high")]


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """An arm of any lengths with a machine of any kind."""
    stimuli, inverse = all_branches(core)
    return stimuli.draw(inverse, rng) | machine(core, rng)


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Those of the core with all branches."""
    stimuli, inverse = all_branches(core)
    return stimuli.corners(inverse, {port.name: cfg[port.name] for port in inverse.cfg})
