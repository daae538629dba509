"""Corners of engine_delta_fk: cranks of real deltas, elbows in one point and in a line, spheres that do not meet."""

from __future__ import annotations

import numpy as np
from quadrance import codecs, engine_delta
from quadrance.cores import Core, joints
from quadrance.parallel import geometry, position

from tb.lib import stimulus
from tb.lib.stimulus import Vectors

MM = {"klipper_delta": 1 / 56, "linuxcnc_delta": 1 / 48}  # an LSB at W = 16: the robot fills the word
MIDDLE = {"klipper_delta": (0, 0, 80), "linuxcnc_delta": (0, 0, -330)}


def scale(core: Core, name: str) -> float:
    """Millimetres of an LSB."""
    return MM[name] * 2.0 ** (16 - core.params["W"])


def workspace(name: str, count: int, rng: np.random.Generator) -> np.ndarray:
    """(N, 3) crank angles of places about the middle that the robot reaches."""
    place = np.array(MIDDLE[name]) + rng.uniform(-120, 120, (count, 3))
    found = position.inverse(geometry.load(name), np.eye(3), place)
    return found.alpha[found.reachable.all(axis=-1)]


def words(core: Core, alpha: np.ndarray) -> Vectors:
    """Joint words of (N, 3) crank angles."""
    found: Vectors = {}
    for i, joint in enumerate(joints(core.inputs)):
        found |= codecs.encode(joint, alpha[:, i])
    return found


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Each robot, both points where the spheres meet; one larger than the word, and turned; one whose elbows meet in a
    point; one with short rods; extremes."""
    robots = [engine_delta.config(core.params, geometry.load(name), scale(core, name), below)
              for name in MM for below in (True, False)]
    edges = [{port.name: edge(port) for port in core.cfg} for edge in (lambda p: p.high, lambda p: p.low)]
    long = edges[0]["cfg_la"] // 16 * 15
    large = robots[0] | {"cfg_base": 0, "cfg_la": long, "cfg_lb": long}  # along x and z it leaves the word both ways
    across = large | {f"cfg_c{i}": -large[f"cfg_n{i}"] for i in (1, 2, 3)} | {
        f"cfg_n{i}": large[f"cfg_c{i}"] for i in (1, 2, 3)}
    return [*robots, large, across, robots[0] | {"cfg_base": 0}, robots[0] | {"cfg_lb": robots[0]["cfg_lb"] >> 2},
            *edges, {port.name: int(rng.integers(port.low, port.high + 1)) for port in core.cfg}]


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """First of all elbows in one point and beside it, then cranks in the workspace, anywhere, alike, on the axes and
    beside them.
    """
    rng = np.random.default_rng(1)
    own = [name for name in MM if engine_delta.config(core.params, geometry.load(name), scale(core, name))["cfg_la"]
           == cfg["cfg_la"]]
    meet = np.arccos(np.clip(-cfg["cfg_base"] / (cfg["cfg_la"] or 1), -1, 1))
    alpha = [np.full((2, 3), meet), meet + rng.uniform(-1, 1, (40, 3)) * 2.0 ** -rng.uniform(0, 16, (40, 1))]
    alpha += [workspace(own[0] if own else "klipper_delta", 40, rng), rng.uniform(-np.pi, np.pi, (50, 3)),
              np.repeat(rng.uniform(-np.pi, np.pi, (15, 1)), 3, axis=1)]
    axis = np.pi / 2 * rng.integers(0, 4, (25, 3))
    alpha += [axis[:10], np.repeat(axis[:8, :1], 3, axis=1),
              axis + rng.choice([-1, 1], axis.shape) * 2.0 ** -rng.uniform(0, 20, axis.shape)]
    extreme = {port.name: rng.choice(stimulus.extremes(port), 20) for port in core.inputs}
    wild = stimulus.uniform(core, rng, 20)
    cranks = words(core, np.concatenate(alpha))
    edges = stimulus.saturation(core, cfg, cranks)
    return stimulus.joined(stimulus.joined(stimulus.joined(cranks, extreme), wild), edges)
