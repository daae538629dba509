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


def free() -> dict[str, int]:
    """Words of a machine with 3.5 turns of every joint either way."""
    return dict.fromkeys(keep.MACHINE, 0) | {f"cfg_{name}{i}": word for i in range(1, 7) for name, word in (
        ("low", -7 << keep.LIMIT - 1), ("high", 7 << keep.LIMIT - 1), ("w", keep.WEIGHT))}


def edges(core: Core, cfg: dict[str, int]) -> list[dict[str, int]]:
    """Machines whose limits the first corner's branch 0 meets exactly, in its own turn or in the next one.

    All weights are 0, so that this branch is chosen where it is within the limits. In the others one joint of it misses
    its limit by 2^-12 turn. The three lowest bits of a lower limit that is met are 0, of an upper one 1: it is another
    limit if the core leaves out one of them.
    """
    unit, turn = 1 << core.params["A"] - keep.LIMIT, 1 << keep.LIMIT
    first = {name: words[:1] for name, words in corners(core, cfg).items()}
    cfg = cfg | free() | {f"cfg_w{i}": 0 for i in range(1, 7)}
    answer = core.model(core.params, **first, **cfg)
    places = [-104, 200, -304, 400, -504, 600]  # the joints' words, by their zeros, in 2^-12 turn, without these bits

    def limits(i: int, at: int, turned: bool, short: bool) -> dict[str, int]:
        """Zero is within the limits: a joint below it meets the lower one or, a turn on, the upper one."""
        side, other = ("low", "high") if at < 0 else ("high", "low")
        inwards = 1 if at < 0 else -1
        near, far = at + inwards * (turned or short), at + inwards * turn - inwards * short
        return {f"cfg_{side}{i}": near} | ({f"cfg_{other}{i}": far} if turned or short else {})

    def machine_of(turned: bool, short: int = 0) -> dict[str, int]:
        found = dict(cfg)
        for i, place in enumerate(places, 1):
            at = place + 7 * ((place > 0) != turned)
            found |= limits(i, at, turned, i == short)
            found[f"cfg_z{i}"] = (at * unit - int(answer[f"out_j{i}"][0])) % (turn * unit)
        return found

    return [machine_of(False), machine_of(True), *(machine_of(bool(i % 2), i) for i in range(1, 7))]


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Arms with a machine that is free, one that is limited, in turn; then the extremes of every word of a machine, and
    limits that are met exactly.
    """
    stimuli, inverse = all_branches(core)
    ports = {port.name: port for port in core.cfg if port.name in keep.MACHINE}
    found = [cfg | (free(), machine(core, rng))[i % 2] for i, cfg in enumerate(stimuli.configs(inverse, rng))]
    ends = [found[0] | {name: getattr(port, end) for name, port in ports.items()} for end in ("low", "high")]
    return found + ends + edges(core, found[0])


def draw(core: Core, rng: np.random.Generator) -> dict[str, int]:
    """An arm of any lengths with a machine of any kind."""
    stimuli, inverse = all_branches(core)
    return stimuli.draw(inverse, rng) | machine(core, rng)


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Those of the core with all branches."""
    stimuli, inverse = all_branches(core)
    return stimuli.corners(inverse, {port.name: cfg[port.name] for port in inverse.cfg})
