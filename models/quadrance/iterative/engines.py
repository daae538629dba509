"""This module gives all iterative engines one interface: metres and radians to words, and the words of an answer back.

An engine of rtl/engine that answers a target with joints enters `EXAMPLES` with the example of its paper.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from quadrance.cores import Core
from quadrance.fixed import Ints, ints
from quadrance.iterative import fixed, gradient
from quadrance.truth import Floats, floats

Answer = dict[str, Ints]


@dataclass(frozen=True)
class Example:
    """An arm for an engine whose ports are in_x.., in_j1.., in_warm, cfg_l1, cfg_l2, alpha, shift, tol and limit.

    arm : float64 kinematics, metres. lengths : its links, metres. gain : the paper's alpha times the longer squared.
    passes, early : clocks of a pass, and those of the last one after its answer, by PIPE. target : the paper's, metres.
    origin : of the engine's coordinates, metres.
    """

    arm: gradient.Kinematics
    lengths: tuple[float, float]
    gain: float
    passes: tuple[int, int]
    early: tuple[int, int]
    target: tuple[float, ...]
    origin: tuple[float, ...]

    @property
    def alpha(self) -> float:
        """The paper's step, 1 / m^2."""
        return self.gain / max(self.lengths) ** 2

    def clocks(self, core: Core) -> tuple[int, int]:
        """Clocks of a pass of this core, and those of the last one after its answer."""
        return self.passes[core.params["PIPE"]], self.early[core.params["PIPE"]]

    def lsb(self, core: Core, bits: int) -> float:
        """Metres of an LSB where the longer link is 2^(W - bits) LSB."""
        return max(self.lengths) / 2.0 ** (core.params["W"] - bits)

    def config(self, core: Core, lsb: float) -> dict[str, int]:
        """The words of the links and of the step."""
        l1, l2 = (round(length / lsb) for length in self.lengths)
        return {"cfg_l1": l1, "cfg_l2": l2} | fixed.config(core.params, cfg_l1=l1, cfg_l2=l2, gain=self.gain)

    def goals(self, goal: ArrayLike, lsb: float) -> Ints:
        """Targets in metres, (..., d), as coordinate words."""
        return ints(np.rint((floats(goal) - self.origin) / lsb))

    def places(self, words: Ints, lsb: float) -> Floats:
        """The places in metres that coordinate words represent."""
        return words * lsb + self.origin


def inputs(core: Core, goal: Ints, start: Ints, warm: ArrayLike = 0) -> Answer:
    """Input ports of targets (..., d) and starts (..., n), words; a warm sample leaves its start aside."""
    axes = {f"in_{axis}": goal[..., i] for i, axis in enumerate("xyz"[:goal.shape[-1]])}
    joints = {f"in_j{i + 1}": start[..., i] for i in range(start.shape[-1])}
    return axes | joints | {"in_warm": np.broadcast_to(ints(warm), goal.shape[:-1])}


def joints(answer: Answer) -> Ints:
    """The joint words of an answer, (..., n)."""
    return np.stack([answer[port] for port in sorted(answer) if port[:5] == "out_j"], axis=-1)


EXAMPLES = {
    "engine_quaternion_gd": Example(gradient.planar(0.1, 0.1), (0.1, 0.1), 0.33, (12, 16), (1, 2), (0.0292, 0.1267),
                                    (0.0, 0.0)),
    "engine_quaternion_gd_touch": Example(gradient.touch(0.135, 0.135, origin=(0.0, 0.025, -0.17)), (0.135, 0.135),
                                          19 * 0.135**2, (14, 17), (0, 0), (0.0, 0.0, 0.0), (0.0, 0.025, -0.17))}
