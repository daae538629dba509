"""The one place from which a simulator is called: build a core, run its cocotb bench."""

from __future__ import annotations

import logging
import os
import pickle
import shutil
from pathlib import Path

from cocotb_test.simulator import run
from quadrance.cores import Core

from ci import tools

SIMULATORS = ("icarus", "verilator")
RUNTIME = tools.BUILD / "verilator-runtime"
RUNTIME_OBJECTS = ("verilated.o", "verilated_dpi.o", "verilated_vpi.o", "verilated_threads.o")
OPTIMISE = "-O1"  # the build costs more than the runs it speeds up


def available(simulator: str) -> bool:
    """Icarus comes from the system and may be absent; Verilator is in the lock file."""
    return simulator != "icarus" or shutil.which("iverilog", path=tools.environment()["PATH"]) is not None


def build_folder(core: Core, simulator: str, label: str = "") -> Path:
    """A folder no other core, parameter set or simulator uses."""
    return tools.BUILD / "sim" / simulator / (core.id + label)


def _seed_runtime(folder: Path) -> None:
    """Put Verilator's own compiled run-time into `folder`: it is three quarters of a build."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in RUNTIME_OBJECTS:
        if (RUNTIME / name).exists() and not (folder / name).exists():
            shutil.copy(RUNTIME / name, folder / name)


def _keep_runtime(folder: Path) -> None:
    """Keep the run-time that the first build compiled for the builds after it."""
    RUNTIME.mkdir(parents=True, exist_ok=True)
    for name in RUNTIME_OBJECTS:
        if not (RUNTIME / name).exists():
            partial = RUNTIME / f"{name}.{os.getpid()}"
            shutil.copy(folder / name, partial)
            partial.rename(RUNTIME / name)


def simulate(core: Core, simulator: str, *, module: str = "tb.lib.bench", tests: str | None = None,
             seed: int | None = None, waves: bool = False, label: str = "", compile_only: bool = False,
             parameters: bool = True) -> Path:
    """Build `core` and run the cocotb tests of `module` on it; raises SystemExit when one fails.

    Parameters
    ----------
    core : the core, with its parameter set; sources may be any Verilog with the same ports.
    simulator : "icarus" or "verilator".
    tests : regular expression of the cocotb tests to run; all by default.
    seed : of every random choice; printed by the bench.
    parameters : False for a netlist, whose parameters are folded in.

    Returns
    -------
    The build folder.
    """
    if not available(simulator):
        tools.require("iverilog")
    folder = build_folder(core, simulator, label)
    if simulator == "verilator":
        _seed_runtime(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "core.pickle").write_bytes(pickle.dumps(core))
    previous = dict(os.environ)
    os.environ.update(tools.environment())
    os.environ.pop("COCOTB_RESULTS_FILE", None)
    logging.getLogger("cocotb").propagate = True
    extra = {"make_args": [f"OPT_FAST={OPTIMISE}", f"OPT_GLOBAL={OPTIMISE}"]} if simulator == "verilator" else {}
    try:
        run(simulator=simulator, toplevel=core.name, module=module, python_search=[str(tools.ROOT)],
            verilog_sources=[str(source) for source in core.sources],
            parameters=core.params if parameters else {}, sim_build=str(folder), timescale="1ns/1ps",
            testcase=tests, seed=seed, waves=waves, compile_only=compile_only,
            extra_env={"QUADRANCE_CORE": str(folder / "core.pickle")},
            compile_args=[] if simulator == "icarus" else ["-Wno-fatal", "-Wno-lint", "-Wno-style"], **extra)
    finally:
        os.environ.clear()
        os.environ.update(previous)
    if simulator == "verilator":
        _keep_runtime(folder)
    for stale in folder.glob("*_results.xml"):
        stale.unlink()
    return folder
