"""Latency, interval and errors of one core: its Verilog simulated on an arm's trajectory, workspace and borders."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import astuple

import numpy as np
from quadrance import accuracy, arms
from quadrance.accuracy import of_core
from quadrance.cores import Core

from ci import cache
from tb.lib import bulk, program, stimulus, tools

FIGURES = ("latency_cycles", "ii", *of_core.KEYS)  # of a row, from simulation
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
    return {"outputs": of_core.modelled(core, inputs, cfg or {}), "latency": [core.latency], "ii": core.ii}


def _listed(core: Core, timed: dict) -> dict[str, int]:
    """Latency and interval in cycles, measured, and equal to the list; the longest latency where it varies."""
    cycles, ii = (timed["latency"][-1], timed["ii"]) if core.clocked else (0, 0)
    for what, measured, listed in (("latency", cycles, core.latency), ("ii", ii, core.ii)):
        if core.latency is not None and listed is not None and measured is not None and measured != listed:
            raise ValueError(f"{core.id}: {what} is {measured} in simulation and {listed} in rtl/cores.toml")
    return {"latency_cycles": cycles, "ii": ii}


def simulate(core: Core, arm_name: str, answers: Callable[..., dict] = stream) -> dict:
    """The figures of a row that come from simulation, by the names of `FIGURES`; errors as `accuracy.of_core` has them.

    `answers` is `stream`, the Verilog, or `modelled`.
    """
    timed: list[dict] = []

    def words(core: Core, inputs: dict, cfg: dict[str, int]) -> dict:
        timed.append(answers(core, inputs, cfg))
        return {port: np.array(column, dtype=np.int64) for port, column in timed[-1]["outputs"].items()}

    row = of_core.figures(core, arms.load(arm_name), words)
    if not timed:  # a function without a truth here: its timing on its own corners
        cfg = stimulus.configs(core, np.random.default_rng(1))[0]
        timed.append(answers(core, stimulus.corners(core, cfg), cfg))
    return row | _listed(core, timed[0])


def tip_map(core: Core, arm_name: str, answers: Callable[..., dict] = stream) -> dict[str, list]:
    """Arithmetic error and rounding of the words over the workspace, LSB: (MAP, MAP) each, NaN out of reach."""
    arm = arms.load(arm_name)
    case, inside = accuracy.map_case(core, arm, MAP)
    words = {port: np.array(column) for port, column in answers(core, case.inputs, case.cfg)["outputs"].items()}
    errors = accuracy.errors(core, arm, case, words, every=True)
    maps = {}
    for what, error in (("arithmetic", errors.arithmetic), ("words", errors.quantisation)):
        grid = np.full(inside.shape, np.nan)
        grid[inside] = error
        maps[what] = grid.tolist()
    return maps
