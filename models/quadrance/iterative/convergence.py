"""How long an engine takes to its answer: iterations and clocks over a grid of starts, by its bit-true model.

A new engine enters `ENTRIES`; the report's table of engines takes it from there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from quadrance import truth
from quadrance.cores import Core
from quadrance.fixed import Ints
from quadrance.iterative import engines

STEP = 4  # degrees between the starts of joints 1 and 2, as of the 8100 starts of the Newton paper's arm
LIMIT = 1000  # iterations
ANSWER = 256  # square of the tolerance in 1/256 LSB^2: one LSB

Run = tuple[Ints, Ints, NDArray[np.bool_]]  # iterations, clocks, converged of every start


@dataclass(frozen=True)
class Entry:
    """An engine in the report.

    task : what it solves, to which tolerance. run : all starts of the grid. clocks : of an iteration.
    closed : cores that answer the same in one pass.
    """

    task: str
    run: Callable[[Core], Run]
    clocks: int
    closed: tuple[str, ...]


def grid(count: int) -> truth.Floats:
    """Starts of `count` joints, radians, (starts, count): joints 1 and 2 all round in steps of `STEP`, others at 0."""
    axis = np.radians(np.arange(0, 360, STEP))
    one, two = np.meshgrid(axis, axis, indexing="ij")
    return np.stack([one.ravel(), two.ravel(), *[np.zeros(one.size)] * (count - 2)], axis=-1)


def samples(core: Core) -> tuple[engines.Answer, dict[str, int]]:
    """The grid for an engine of `engines.EXAMPLES`, its paper's target; the first errors fill a word of 8 links."""
    example = engines.EXAMPLES[core.name]
    lsb, target = example.lsb(core, 3), np.asarray(example.target)
    start = truth.angle_to_binary_word(grid(target.size), core.params["A"]) & (1 << core.params["A"]) - 1
    goal = np.broadcast_to(example.goals(target, lsb), (len(start), target.size))
    return engines.inputs(core, goal, start), example.config(core, lsb) | {"cfg_tol": ANSWER, "cfg_limit": LIMIT}


def by_example(core: Core) -> Run:
    """An engine of `engines.EXAMPLES`: each pass has its clocks, the last one less."""
    example, (inputs, cfg) = engines.EXAMPLES[core.name], samples(core)
    answer, passes = example.passes(core.params, **inputs, **cfg)
    return answer["out_iters"], example.clocks * passes - 1, answer["out_status"] == 0


def found(core: Core) -> dict:
    """What the report says of an engine: the median, 95th percentile and greatest of those that converged."""
    entry = ENTRIES[core.name]
    iterations, clocks, done = entry.run(core)
    spread = {name: [int(value) for value in np.percentile(column[done], [50, 95, 100], method="higher")]
              for name, column in (("iterations", iterations), ("clocks", clocks))}
    return {"task": entry.task, "closed": list(entry.closed), "pass": entry.clocks, "starts": int(done.size),
            "converged": int(done.sum())} | spread


ENTRIES = {"engine_quaternion_gd": Entry("2 joints in the plane, to 1 LSB (12 um)", by_example,
                                         engines.EXAMPLES["engine_quaternion_gd"].clocks,
                                         ("vector_ik2", "table_ik2"))}
