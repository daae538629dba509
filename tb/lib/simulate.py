"""The one place from which a simulator is called: build a core, run its cocotb bench."""

from __future__ import annotations

import contextlib
import logging
import os
import pickle
import shutil
import signal
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from cocotb_test.simulator import Icarus, Simulator, Verilator
from quadrance.cores import Core

from tb.lib import program, stimulus, tools

SIMULATORS = ("icarus", "verilator")
LONGEST = 800  # characters of what a failed test said
UNKNOWN = r"\.(one_clock_of_reset|reset_in_flight)$"  # tests that show more where a register starts unknown
LONG = 16  # clocks of a sample, from which on `make cover` keeps the whole bench of a core


@dataclass(frozen=True)
class Failure:
    """A failed test of a bench: its name, when it ended in the simulation, what it said."""

    test: str
    time_ns: float
    message: str


class BenchFailed(SystemExit):
    """Tests of a bench failed: which, when, and what each of them said."""

    def __init__(self, where: str, failures: list[Failure]) -> None:
        super().__init__("\n".join([f"FAILED {len(failures)} tests of {where}", *(
            f"  {one.test} at {one.time_ns:g} ns: {one.message}" for one in failures)]))
        self.failures = failures


def failures(results: Path) -> list[Failure]:
    """The failed tests in cocotb's file of results; a time counts from the start of the simulation."""
    found = []
    for case in ElementTree.parse(results).iter("testcase"):
        reason = next(case.iter("failure"), next(case.iter("error"), None))
        if reason is not None:
            about = {one.get("name"): one.get("value") for one in case.iter("property")}
            text = " ".join((reason.get("message") or reason.text or "").split())
            found.append(Failure(case.get("name"), float(about["sim_time_stop"]), text[:LONGEST]))
    return found


class Built(Verilator):
    """A program that stands already: nothing to build."""

    def build_command(self) -> list[list[str]]:
        return [[str(Path(self.sim_dir).parent / "core"), *self.plus_args]]


class Traced(Verilator):
    """Verilator with a waveform: a VCD, which needs no header or library of the system; cocotb-test's FST needs lz4."""

    def build_command(self) -> list[list[str]]:
        verilate, make, *run = super().build_command()
        trace = ["--trace", "--trace-file", f"{self.toplevel_module}.vcd"]
        return [["--trace-vcd" if word == "--trace-fst" else word for word in verilate],
                [*make, "-j2", "OPT_GLOBAL=-O0", f"CXX={tools.require('g++')}"], *([*words, *trace] for words in run)]


def available(simulator: str) -> bool:
    """Icarus comes from the system: it may be absent, and SIM=verilator leaves it out; Verilator is in the lock."""
    if simulator == "icarus" and os.environ.get("SIM") == "verilator":
        return False
    return simulator != "icarus" or shutil.which("iverilog", path=tools.environment()["PATH"]) is not None


def kept(core: Core) -> bool:
    """Whether `make cover` keeps the whole bench of a first set, of which `make test` then runs `UNKNOWN` alone.

    A clock of such a core costs as much here as a thousand in the bulk run, which has the other tests' samples too. A
    core without a clock has no register that could be unknown.
    """
    return bool(core.params) and (not core.latency or max(core.latency, core.ii) > LONG)


def incomplete(core: Core) -> str:
    """What the list promises of a core and no file has: one line with the file and the key, else empty."""
    module, _, function = core.model_name.rpartition(".")
    family = f"tb/stimulus/{core.family}.py"
    try:
        _ = core.model
    except (ImportError, AttributeError):
        return f"{core.name}: models/quadrance/{module.replace('.', '/')}.py has no {function}(), " \
               f"the model that rtl/cores.toml names"
    try:
        found, port = stimulus.configs(core, np.random.default_rng(1)), ""
        port = next((port.name for words in found for port in core.cfg if port.name not in words), "")
    except (KeyError, AttributeError, TypeError) as error:
        port = f"{type(error).__name__}: {error}"
    if port:
        return f"{core.name}: configs() in {family} gives no word for {port}; add it there"
    try:
        stimulus.corners(core, found[0])
    except KeyError as error:
        return f"{core.name}: corners() in {family} has no entry for {error.args[0]}; add it there"
    return ""


def simulate(core: Core, simulator: str, *, module: str = "tb.lib.bench", tests: str | None = None,
             seed: int | None = None, waves: bool = False, label: str = "", compile_only: bool = False,
             parameters: bool = True, failures: int | None = None, plusargs: Sequence[str] = ()) -> Path:
    """Build `core` and run the cocotb tests of `module` on it.

    Raises BenchFailed when a test fails, RuntimeError when the core cannot be built or the simulator ends early.

    Parameters
    ----------
    core : the core, with its parameter set; sources may be any Verilog with the same ports.
    simulator : "icarus" or "verilator".
    tests : regular expression of the cocotb tests to run; all by default.
    seed : of every random choice; printed by the bench.
    parameters : False for a netlist, whose parameters are folded in.
    failures : after so many failed tests the others are left out; None runs them all.
    plusargs : for the Verilog ("+name=value").

    Returns
    -------
    The build folder.
    """
    if not available(simulator):
        tools.require("iverilog")
    if missing := incomplete(core):
        raise RuntimeError(missing)
    if simulator == "verilator" and not waves:
        runner = Built
        folder = _built(core if parameters else replace(core, params={}), label) / "bench"
    else:
        runner = Icarus if simulator == "icarus" else Traced
        folder = program.build_folder(core, simulator, label, waves, parameters)
    with program.locked(folder):
        extra = {"QUADRANCE_CORE": str(folder / "core.pickle"),
                 "COCOTB_REWRITE_ASSERTION_FILES": ""}  # it would rewrite numpy too, at every start
        if failures is not None:
            extra["COCOTB_MAX_FAILURES"] = str(failures)
        _run(core, runner, folder, module, tests, seed, waves, compile_only, parameters, extra, plusargs)
    return folder


def _built(core: Core, label: str) -> Path:
    """Where the verilated program of `core` stands, made if need be."""
    try:
        return program.build(core, label).parent
    except tools.ToolError as error:
        raise RuntimeError(f"{core.id} in verilator: {error}") from None


@contextlib.contextmanager
def _handlers_kept() -> Iterator[None]:
    """Ctrl-C and TERM as before: cocotb-test makes a failed assertion of them, and a worker would take its next job."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield
    for number, handler in before.items():
        if signal.getsignal(number) is not handler:
            signal.signal(number, handler)


def _run(core: Core, runner: type[Simulator], folder: Path, module: str, tests: str | None, seed: int | None,
         waves: bool, compile_only: bool, parameters: bool, extra: dict[str, str],
         plusargs: Sequence[str]) -> None:
    (folder / "core.pickle").write_bytes(pickle.dumps(core))
    previous = dict(os.environ)
    os.environ.update(tools.environment())
    os.environ.pop("COCOTB_RESULTS_FILE", None)
    logging.getLogger("cocotb").propagate = True
    _cleared(folder)
    try:
        with _handlers_kept():
            simulation = runner(
                toplevel=core.name, module=module, python_search=[str(tools.ROOT)],
                verilog_sources=[str(source) for source in core.sources],
                parameters=core.params if parameters else {}, sim_build=str(folder), timescale="1ns/1ps",
                testcase=tests, seed=seed, waves=waves, compile_only=compile_only,
                extra_env=extra, plus_args=list(plusargs),
                compile_args=[] if runner is Icarus else ["-Wno-fatal", "-Wno-lint", "-Wno-style"])
        simulation.run()
    except (SystemExit, ElementTree.ParseError) as error:  # cocotb-test exits for every reason, and says which
        if str(error).startswith("FAILED"):
            found = failures(next(folder.glob("*_results.xml")))
            raise BenchFailed(f"{core.id} in {_simulator(runner)}, SEED={seed}", found) from None
        raise RuntimeError(f"{core.id} in {_simulator(runner)}: {error}") from None
    finally:
        os.environ.clear()
        os.environ.update(previous)
        _cleared(folder)


def _simulator(runner: type[Simulator]) -> str:
    return "icarus" if runner is Icarus else "verilator"


def _cleared(folder: Path) -> None:
    """Results of a run, or of one that was cut, go."""
    for results in folder.glob("*_results.xml"):
        results.unlink()
