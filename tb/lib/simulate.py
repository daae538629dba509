"""The one place from which a simulator is called: build a core, run its cocotb bench."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import logging
import os
import pickle
import shutil
import signal
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from cocotb_test.simulator import Icarus, Verilator
from quadrance.cores import Core

from tb.lib import tools

SIMULATORS = {"icarus": Icarus, "verilator": Verilator}
OPTIMISE = "-O1"  # the build costs more than the runs it speeds up


def available(simulator: str) -> bool:
    """Icarus comes from the system and may be absent; Verilator is in the lock file."""
    return simulator != "icarus" or shutil.which("iverilog", path=tools.environment()["PATH"]) is not None


def digest(*parts: object) -> str:
    """Name of a build by all that it depends on."""
    return hashlib.sha256(repr((tools.versions(), *parts)).encode()).hexdigest()[:16]


def build_folder(core: Core, simulator: str, label: str = "", *parts: object) -> Path:
    """A folder that no other sources, parameters, tools or `parts` share: nothing in it can be stale."""
    texts = [source.read_text() for source in core.sources]
    return tools.BUILD / "sim" / simulator / f"{core.id}{label}-{digest(texts, core.params, core.name, *parts)}"


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[Path]:
    """`folder`, made if need be, for this process alone: a second run in the same checkout waits."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield folder


def cxx_flags() -> list[str]:
    """How C++ that Verilator wrote is compiled."""
    include = Path(tools.environment()["VERILATOR_ROOT"]) / "include"
    return ["-std=gnu++17", OPTIMISE, f"-I{include}", f"-I{include}/vltstd", "-DVERILATOR=1", "-Wno-sign-compare",
            *(f"-DVM_{name}=0" for name in ("COVERAGE", "SC", "TIMING", "TRACE", "TRACE_FST", "TRACE_VCD"))]


def verilate(core: Core, folder: Path) -> list[Path]:
    """C++ of the core as class `Vtop`, without the access from outside that cocotb needs: the files to compile."""
    folder.mkdir(parents=True, exist_ok=True)
    tools.run("verilator", "-cc", "-Mdir", folder, "--prefix", "Vtop", "--top-module", core.name, "-Wno-fatal",
              "-Wno-lint", "-Wno-style", *(f"-G{name}={value}" for name, value in core.params.items()), *core.sources)
    return sorted(folder.glob("Vtop*.cpp"))


def runtime() -> list[Path]:
    """Verilator's own run-time, compiled once and linked into every core: it is most of a build."""
    include = Path(tools.environment()["VERILATOR_ROOT"]) / "include"
    flags = cxx_flags()
    objects = []
    with locked(tools.BUILD / "verilator-runtime" / digest(flags)) as folder:
        for name in ("verilated", "verilated_dpi", "verilated_vpi", "verilated_threads"):
            objects.append(target := folder / f"{name}.o")
            if not target.exists():
                partial = target.with_suffix(".partial")
                tools.run("g++", *flags, "-c", "-o", partial, include / f"{name}.cpp")
                partial.rename(target)  # an interrupted compilation leaves nothing that could be linked
    return objects


def simulate(core: Core, simulator: str, *, module: str = "tb.lib.bench", tests: str | None = None,
             seed: int | None = None, waves: bool = False, label: str = "", compile_only: bool = False,
             parameters: bool = True) -> Path:
    """Build `core` and run the cocotb tests of `module` on it.

    Raises SystemExit when a test fails, RuntimeError when the core cannot be built or the simulator ends early.

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
    with locked(build_folder(core, simulator, label, waves, parameters)) as folder:
        _run(core, simulator, folder, module, tests, seed, waves, compile_only, parameters)
    return folder


@contextlib.contextmanager
def _handlers_kept() -> Iterator[None]:
    """Ctrl-C and TERM as before: cocotb-test makes a failed assertion of them, and a worker would take its next job."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield
    for number, handler in before.items():
        if signal.getsignal(number) is not handler:
            signal.signal(number, handler)


def _run(core: Core, simulator: str, folder: Path, module: str, tests: str | None, seed: int | None, waves: bool,
         compile_only: bool, parameters: bool) -> None:
    (folder / "core.pickle").write_bytes(pickle.dumps(core))
    previous = dict(os.environ)
    os.environ.update(tools.environment())
    os.environ.pop("COCOTB_RESULTS_FILE", None)
    logging.getLogger("cocotb").propagate = True
    extra = {}
    if simulator == "verilator":
        extra["make_args"] = [f"OPT_FAST={OPTIMISE}", f"OPT_GLOBAL={OPTIMISE}"]
        if not waves:
            extra["make_args"] += ["VK_GLOBAL_OBJS=", f"LOADLIBES={' '.join(map(str, runtime()))}"]
    try:
        with _handlers_kept():
            simulation = SIMULATORS[simulator](
                toplevel=core.name, module=module, python_search=[str(tools.ROOT)],
                verilog_sources=[str(source) for source in core.sources],
                parameters=core.params if parameters else {}, sim_build=str(folder), timescale="1ns/1ps",
                testcase=tests, seed=seed, waves=waves, compile_only=compile_only,
                extra_env={"QUADRANCE_CORE": str(folder / "core.pickle")},
                compile_args=[] if simulator == "icarus" else ["-Wno-fatal", "-Wno-lint", "-Wno-style"], **extra)
        simulation.run()
    except (SystemExit, ElementTree.ParseError) as error:  # cocotb-test exits for every reason, and says which
        if str(error).startswith("FAILED"):
            raise
        raise RuntimeError(f"{core.id} in {simulator}: {error}") from None
    finally:
        os.environ.clear()
        os.environ.update(previous)
    for stale in folder.glob("*_results.xml"):
        stale.unlink()
