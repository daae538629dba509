"""Corners of engine_rus_ik: real robots on their paths, at their borders; legs of any geometry, words of any size."""

from __future__ import annotations

import numpy as np
from quadrance import engine_rus
from quadrance.cores import Core
from quadrance.parallel import geometry, reconfiguration

from tb.lib import stimulus
from tb.lib.stimulus import Vectors

SCALE = {"rus_2x3": 1 / 128, "rotary_stewart": 1 / 640, "klipper_delta": 1 / 128, "linuxcnc_delta": 1 / 128}


def words_of(core: Core, name: str) -> dict[str, int]:
    """Configuration of a robot; a leg is near a singular one with a root of less than half a crank."""
    robot = geometry.load(name)
    return engine_rus.config(core.params, robot, SCALE[name], near=robot.la[0] / 2)


def configs(core: Core, rng: np.random.Generator) -> list[dict[str, int]]:
    """Each robot with its own words; one whose cranks are as long as its rods, and of the shortest ones; then extremes
    and some at random.
    """
    robots = [words_of(core, name) for name in SCALE]
    edges = [{port.name: edge(port) for port in core.cfg} for edge in (lambda p: p.high, lambda p: p.low)]
    return [*robots, robots[0] | {"cfg_k": 0}, robots[0] | {"cfg_k": 0, "cfg_c": core.cfg[1].high}, *edges,
            {port.name: int(rng.integers(port.low, port.high + 1)) for port in core.cfg}]


def spiral() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The paper's 101 poses and the best angles of the links there, in a few steps of the search."""
    s = np.linspace(0, 1, 101)
    place = np.stack([25 * np.cos(2 * np.pi * s), -250 - 100 * s, 25 * np.sin(2 * np.pi * s)], axis=-1)
    turn = geometry.rotation(("z", 5), ("y", 10), ("x", 10))
    knots = reconfiguration.best(geometry.load("rus_2x3"), turn, place[::20], tolerance=1e-4).beta
    return np.broadcast_to(turn, (101, 3, 3)), place, np.interp(s, s[::20], knots)


def workspace(name: str, count: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Poses of a robot, some of them beyond its reach."""
    low, high, degrees = {"rus_2x3": ((-150, -520, -150), (150, -100, 150), 20),
                          "rotary_stewart": ((-30, -30, 100), (30, 30, 165), 15),
                          "klipper_delta": ((-250, -250, -60), (250, 250, 200), 0),
                          "linuxcnc_delta": ((-250, -250, -550), (250, 250, -150), 0)}[name]
    turn = np.array([geometry.rotation(*zip("zyx", rng.uniform(-degrees, degrees, 3))) for _ in range(count)])
    return turn, rng.uniform(low, high, (count, 3)), rng.uniform(-1.2, 1.5, count)


def _mixed(loads: list[dict[str, int]], samples: Vectors, rng: np.random.Generator) -> Vectors:
    """A pose with nothing loaded, the legs with poses between them, the rest, and a leg loaded again among them."""
    rows = [{name: int(words[i]) for name, words in samples.items()} for i in range(samples["in_load"].size)]
    first = [rows.pop(0)]
    for one in loads:
        first += [one, rows.pop(0)]
    middle = len(rows) // 2
    rows[middle:middle] = [{**loads[0], "in_leg": 7}, loads[int(rng.integers(len(loads)))]]
    every = first + rows
    return {name: np.array([row[name] for row in every]) for name in every[0]}


def _stretched(core: Core, cfg: dict[str, int], feet: list[dict[str, int]], rng: np.random.Generator) -> np.ndarray:
    """(3, N) words from a foot to a joint in the plane of its crank, as far away as crank and rod, alike, reach."""
    reach = 2 * 2.0**(42 - engine_rus.FINE) / cfg["cfg_c"] / 2 ** (18 - core.params["W"])
    angle = rng.uniform(-np.pi, np.pi, len(feet))
    axes = np.array([[one["in_r21"], one["in_r22"]] for one in feet]).T / engine_rus.ONE
    x, z = reach * np.cos(angle) * axes
    return np.rint([x, reach * np.sin(angle), z]).astype(int)


def corners(core: Core, cfg: dict[str, int]) -> Vectors:
    """Poses of a robot behind its geometry; then joints on their axes, and geometry and poses at the ends of words."""
    rng = np.random.default_rng(1)
    name = next((one for one in SCALE
                 if words_of(core, one) == cfg), "rus_2x3")
    robot, scale = geometry.load(name), SCALE[name]
    turn, place, beta = workspace(name, 160, rng)
    if name == "rus_2x3":
        turn, place, beta = (np.concatenate(pair) for pair in zip(spiral(), (turn, place, beta)))
    loads = engine_rus.geometry(core.params, robot, scale)
    every = _mixed(loads, engine_rus.poses(core.params, robot, scale, turn, place, beta), rng)
    # a joint on its crank's axis: joint and link 0, position the foot; and next to it: squares and roots of any size
    feet = [one for one in loads for _ in range(60 // len(loads))] * (24 if cfg["cfg_k"] == 0 else 1)
    far = np.where(rng.random(len(feet)) < 0.2, 2.0 ** rng.uniform(0, 9, len(feet)), 120 * rng.random(len(feet)) ** 0.5)
    ray = rng.normal(size=(3, len(feet)))
    beside = np.rint(ray / np.linalg.norm(ray, axis=0) * far).astype(int)
    beside[:, ::15] = 0
    if cfg["cfg_k"] == 0 and cfg["cfg_c"] == core.cfg[1].high:  # where a leg is stretched: its least roots
        stretched = _stretched(core, cfg, loads * 400, rng)
        feet, beside = feet + loads * 400, np.concatenate([beside, stretched], axis=1)
    axis = {port.name: np.array([0 if port.name[3] in "rcnl" else -one[port.name] + int(off["xyz".find(port.name[4])])
                                 if port.name[3] == "p" else one[port.name] for one, off in zip(feet, beside.T)])
            for port in core.inputs}
    edge = {port.name: rng.choice(stimulus.extremes(port), 200) for port in core.inputs}
    wild = stimulus.uniform(core, rng, 100)
    return stimulus.joined(stimulus.joined(every, axis), stimulus.joined(edge, wild))
