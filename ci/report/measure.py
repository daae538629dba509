"""Latency, interval and errors of one core: its Verilog simulated on an arm's trajectory, workspace and borders."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import astuple

import numpy as np
from quadrance import accuracy, arms
from quadrance.accuracy import Case, Errors, summary
from quadrance.arms import Arm
from quadrance.cores import Core

from ci import cache
from tb.lib import bulk, program, stimulus, tools

SAMPLES = 1000  # of the trajectory
SWEEP = 4096  # random and border samples of all a core can be asked
WORKSPACE = 65536  # samples of the arm's workspace, borders of the words included
FIGURES = ("latency_cycles", "ii", "error_lsb", "error_mm", "sweep_error_lsb", "words_lsb", "words_mm", "total_lsb",
           "total_mm")  # of a row, from simulation
MAP = 121  # points a side of the map of the workspace


def stream(core: Core, inputs: dict, cfg: dict[str, int]) -> dict:
    """Outputs, latency and interval of the Verilog for these words, cached by everything they depend on."""
    words = {port: [int(word) for word in column] for port, column in inputs.items()}
    texts = cache.meanings((*core.sources, *program.SOURCES))
    ports = [astuple(port) for port in (*core.cfg, *core.inputs, *core.outputs)]

    def compute() -> dict:
        result = bulk.stream(core, inputs, cfg)
        return {"outputs": {port: [int(word) for word in column] for port, column in result.outputs.items()},
                "latency": sorted({int(cycles) for cycles in result.latency}), "ii": result.ii}

    return cache.cached(["stream", core.name, core.params, ports, texts, tools.versions()["verilator"], words, cfg],
                        compute)


def modelled(core: Core, inputs: dict, cfg: dict[str, int]) -> dict:
    """As `stream`, by the bit-true model, which the benches hold to the Verilog: nothing is built, in a moment.

    A latency that varies is known to the Verilog alone.
    """
    if core.clocked and core.latency is None:
        return stream(core, inputs, cfg)
    count = next(iter(inputs.values())).size
    answer = core.model(core.params, **inputs, **(cfg or {}))
    return {"outputs": {port.name: np.broadcast_to(answer[port.name], (count,)) for port in core.outputs},
            "latency": [core.latency], "ii": core.ii}


def _answered(core: Core, arm: Arm, case: Case, every: bool = False,
              answers: Callable[..., dict] = stream) -> tuple[dict, Errors | None]:
    """The simulation of a case and the errors of its answers."""
    result = answers(core, case.inputs, case.cfg)
    outputs = {port: np.array(words, dtype=np.int64) for port, words in result["outputs"].items()}
    return result, accuracy.errors(core, arm, case, outputs, every)


def _listed(core: Core, timed: dict) -> dict[str, int]:
    """Latency and interval in cycles, measured, and equal to the list; the longest latency where it varies."""
    cycles, ii = (timed["latency"][-1], timed["ii"]) if core.clocked else (0, 0)
    for what, measured, listed in (("latency", cycles, core.latency), ("ii", ii, core.ii)):
        if core.latency is not None and listed is not None and measured is not None and measured != listed:
            raise ValueError(f"{core.id}: {what} is {measured} in simulation and {listed} in rtl/cores.toml")
    return {"latency_cycles": cycles, "ii": ii}


def simulate(core: Core, arm_name: str, answers: Callable[..., dict] = stream) -> dict:
    """The figures of a row that come from simulation, by the names of `FIGURES`.

    Arithmetic errors on the trajectory (`error_*`) and in the sweep; over the workspace the greatest error of the
    words (`words_*`: an exact core of the same words) and of words and arithmetic together (`total_*`).
    `answers` is `stream`, the Verilog, or `modelled`.
    """
    arm = arms.load(arm_name)
    row: dict = dict.fromkeys(FIGURES)
    timed = None
    cases = {"trajectory": accuracy.trajectory_case(core, arm, SAMPLES), "sweep": accuracy.sweep_case(core, arm, SWEEP),
             "workspace": accuracy.workspace_case(core, arm, WORKSPACE, np.random.default_rng(1))}
    for what, case in cases.items():
        if case is None:
            continue
        result, errors = _answered(core, arm, case, answers=answers)
        timed = timed or result
        if errors is None:
            continue
        if what == "sweep":
            row["sweep_error_lsb"] = summary(errors.arithmetic)
        elif what == "trajectory":
            row["error_lsb"] = summary(errors.arithmetic)
            row["error_mm"] = summary(errors.arithmetic, accuracy.mm_per_lsb(core, arm))
        else:
            for key, error in (("words", errors.quantisation), ("total", errors.total)):
                if error is not None and error.size:
                    row[f"{key}_lsb"] = float(np.max(error))
                    row[f"{key}_mm"] = row[f"{key}_lsb"] * accuracy.mm_per_lsb(core, arm)
    if core.function not in accuracy.JOINTS:
        row["error_lsb"] = row["sweep_error_lsb"]
    if timed is None:  # a function without a truth here: its timing on its own corners
        cfg = stimulus.configs(core, np.random.default_rng(1))[0]
        timed = answers(core, stimulus.corners(core, cfg), cfg)
    return row | _listed(core, timed)


def tip_map(core: Core, arm_name: str, answers: Callable[..., dict] = stream) -> dict[str, list]:
    """Arithmetic error and rounding of the words over the workspace, LSB: (MAP, MAP) each, NaN out of reach."""
    arm = arms.load(arm_name)
    case, inside = accuracy.map_case(core, arm, MAP)
    _, errors = _answered(core, arm, case, every=True, answers=answers)
    maps = {}
    for what, error in (("arithmetic", errors.arithmetic), ("words", errors.quantisation)):
        grid = np.full(inside.shape, np.nan)
        grid[inside] = error
        maps[what] = grid.tolist()
    return maps
