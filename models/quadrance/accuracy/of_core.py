"""This module has the error figures of one core on an arm: what a row of the report says, and what `quadrance accuracy`
prints."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from quadrance.accuracy.arm import JOINTS, mm_per_lsb
from quadrance.accuracy.cases import sweep_case, trajectory_case, workspace_case
from quadrance.accuracy.tip import errors, summary
from quadrance.arms import Arm
from quadrance.cores import Core
from quadrance.fixed import Ints

SAMPLES = 1000  # of the trajectory
SWEEP = 4096  # random and border samples of all a core can be asked
WORKSPACE = 65536  # samples of the arm's workspace, borders of the words included
KEYS = ("error_lsb", "error_mm", "sweep_error_lsb", "words_lsb", "words_mm", "total_lsb", "total_mm")


def modelled(core: Core, inputs: dict[str, Ints], cfg: dict[str, int]) -> dict[str, Ints]:
    """Words of every output port by the bit-true model, which the benches hold to the Verilog."""
    answer = core.model(core.params, **inputs, **cfg)
    count = next(iter(inputs.values())).size
    return {port.name: np.broadcast_to(answer[port.name], (count,)) for port in core.outputs}


def figures(core: Core, arm: Arm, answers: Callable[..., dict] = modelled) -> dict:
    """The figures of `KEYS`, None where there is none.

    Arithmetic errors on the trajectory (`error_*`) and in the sweep; over the workspace the greatest error of the
    words (`words_*`: an exact core of the same words) and of words and arithmetic together (`total_*`).
    `answers` takes a core, its inputs and its configuration, and gives words as `modelled` does.
    """
    row: dict = dict.fromkeys(KEYS)
    cases = {"trajectory": trajectory_case(core, arm, SAMPLES), "sweep": sweep_case(core, arm, SWEEP),
             "workspace": workspace_case(core, arm, WORKSPACE, np.random.default_rng(1))}
    for what, case in cases.items():
        if case is None:
            continue
        found = errors(core, arm, case, answers(core, case.inputs, case.cfg))
        if found is None:
            continue
        if what == "sweep":
            row["sweep_error_lsb"] = summary(found.arithmetic)
        elif what == "trajectory":
            row["error_lsb"] = summary(found.arithmetic)
            row["error_mm"] = summary(found.arithmetic, mm_per_lsb(core, arm))
        else:
            for key, error in (("words", found.quantisation), ("total", found.total)):
                if error is not None and error.size:
                    row[f"{key}_lsb"] = float(np.max(error))
                    row[f"{key}_mm"] = row[f"{key}_lsb"] * mm_per_lsb(core, arm)
    if core.function not in JOINTS:
        row["error_lsb"] = row["sweep_error_lsb"]
    return row
