"""This module measures how long an engine iterates, on the grid of starts that the report uses.

A new engine enters `ENTRIES`; the report's table of engines reads it there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from quadrance import truth
from quadrance.cores import Core
from quadrance.fixed import Ints
from quadrance.iterative import engines, fixed, newton_fixed, plane

STEP = 4  # degrees between the starts of joints 1 and 2, as of the 8100 starts of the Newton paper's arm
LIMIT = 1000  # iterations
DAMPING = 2.0**-8  # of damped least squares, in squares of the link lengths
ANSWER = 256  # square of the tolerance in 1/256 LSB^2: one LSB


@dataclass(frozen=True)
class Entry:
    """An engine in the report.

    task : what it solves, to which tolerance. samples : input words of the whole grid and configuration words, for the
    bit-true model and the Verilog. clocks : of an iteration. closed : cores that answer the same in one pass.
    solves : which of the samples solve, where others load or read; all by default.
    """

    task: str
    samples: Callable[[Core], tuple[dict[str, Ints], dict[str, int]]]
    clocks: int
    closed: tuple[str, ...]
    solves: Callable[[dict[str, Ints]], Ints] = lambda inputs: np.arange(next(iter(inputs.values())).size)


def grid(count: int, step: int = STEP) -> truth.Floats:
    """Starts of `count` joints, radians, (starts, count): joints 1 and 2 all round in steps of degrees, others at 0."""
    axis = np.radians(np.arange(0, 360, step))
    one, two = np.meshgrid(axis, axis, indexing="ij")
    return np.stack([one.ravel(), two.ravel(), *[np.zeros(one.size)] * (count - 2)], axis=-1)


def by_example(core: Core) -> tuple[dict[str, Ints], dict[str, int]]:
    """An engine of `engines.EXAMPLES` with its paper's target; a link is an eighth of its word, as the errors need."""
    example = engines.EXAMPLES[core.name]
    lsb = example.lsb(core, 3)
    return _all_starts(core, example, lsb), example.config(core, lsb) | {"cfg_tol": ANSWER, "cfg_limit": LIMIT}


def _all_starts(core: Core, example: engines.Example, lsb: float) -> dict[str, Ints]:
    target, a = np.asarray(example.target), core.params["A"]
    start = truth.angle_to_binary_word(grid(target.size), a) & (1 << a) - 1
    return engines.inputs(core, np.broadcast_to(example.goals(target, lsb), start.shape[:1] + target.shape), start)


def by_damping(core: Core) -> tuple[dict[str, Ints], dict[str, int]]:
    """engine_quaternion_dls with the example of engine_quaternion_gd."""
    example = engines.EXAMPLES["engine_quaternion_gd"]
    lsb = example.lsb(core, 3)
    l1, l2 = (round(length / lsb) for length in example.lengths)
    return _all_starts(core, example, lsb), {"cfg_l1": l1, "cfg_l2": l2, "cfg_tol": ANSWER, "cfg_limit": LIMIT} \
        | newton_fixed.config(core.params, cfg_l1=l1, cfg_l2=l2, damping=DAMPING)


def by_vector(core: Core) -> tuple[dict[str, Ints], dict[str, int]]:
    """engine_quaternion_gd_vector with the example of engine_quaternion_gd, its starts as directions of the links."""
    example = engines.EXAMPLES["engine_quaternion_gd"]
    lsb, links = example.lsb(core, 3), np.cumsum(grid(2), axis=-1)
    l1, l2 = (round(length / lsb) for length in example.lengths)
    words = [np.rint(2.0 ** core.params["W"] * each).astype(np.int64) for link in links.T for each in truth.unit(link)]
    goal = [np.full(len(links), word) for word in example.goals(example.target, lsb)]
    return {port.name: word for port, word in zip(core.inputs, [*goal, *words, np.zeros(len(links), np.int64)])}, \
        {"cfg_l1": l1, "cfg_l2": l2, "cfg_tol": ANSWER, "cfg_limit": LIMIT} \
        | fixed.config_vector(core.params, cfg_l1=l1, cfg_l2=l2, gain=example.gain)


def by_plane(core: Core) -> tuple[dict[str, Ints], dict[str, int]]:
    """engine_quaternion_gd_plane with two links and the example of engine_quaternion_gd; a fourth of the starts."""
    example, a = engines.EXAMPLES["engine_quaternion_gd"], core.params["A"]
    lsb = example.lsb(core, 3)
    loads = plane.loads(core.params, [round(length / lsb) for length in example.lengths], [0, 0])
    goal = plane.solve(2, *example.goals(example.target, lsb))[0]
    starts = truth.angle_to_binary_word(grid(2, 2 * STEP), a) & (1 << a) - 1
    rows = loads + [row for start in starts for row in (*plane.sets(start), goal)]
    return {port.name: np.array([row[port.name] for row in rows]) for port in core.inputs}, \
        plane.config(core.params, example.alpha * lsb**2) | {"cfg_tol": ANSWER, "cfg_limit": LIMIT}


def by_newton(core: Core) -> tuple[dict[str, Ints], dict[str, int]]:
    """engine_newton_3r, undamped, with the paper's unit links, an eighth of a word each, and its target (1.5, 0)."""
    link, a = 1 << core.params["W"] - 3, core.params["A"]
    start = truth.angle_to_binary_word(grid(2), a) & (1 << a) - 1
    words = {"in_x": 3 * link // 2, "in_j1": start[:, 0], "in_j2": start[:, 1]}
    lengths = {"cfg_l1": link, "cfg_l2": link}
    return {port.name: np.broadcast_to(words.get(port.name, 0), len(start)) for port in core.inputs}, \
        lengths | {"cfg_l3": link, "cfg_tol": ANSWER, "cfg_limit": LIMIT} | newton_fixed.config(core.params, **lengths)


TWO = ("vector_ik2", "table_ik2")
ENTRIES = {
    "engine_quaternion_gd": Entry("2 joints in the plane, to 1 LSB (12 um)", by_example,
                                  engines.EXAMPLES["engine_quaternion_gd"].passes[0], TWO),
    "engine_quaternion_dls": Entry("2 joints in the plane, damped, to 1 LSB (12 um)", by_damping, 16, TWO),
    "engine_quaternion_gd_vector": Entry("2 joints in the plane, to 1 LSB (12 um)", by_vector, 13, TWO),
    "engine_quaternion_gd_touch": Entry("Geomagic Touch, to 1 LSB (16 um)", by_example,
                                        engines.EXAMPLES["engine_quaternion_gd_touch"].passes[0],
                                        ("vector_ik3", "table_ik3")),
    "engine_newton_3r": Entry("3 joints in the plane and an orientation, to 1 LSB (links 8192)", by_newton, 16,
                              ("table_ik3r",)),
    "engine_quaternion_gd_plane": Entry("n joints in the plane, 2 of them, to 1 LSB (12 um)", by_plane, 12, TWO,
                                        lambda inputs: np.flatnonzero(inputs["in_op"] == plane.SOLVE))}
