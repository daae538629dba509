"""One verilated program a core: the cocotb bench and the bulk runs share it, for most of a build is compilation."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import cocotb
from quadrance.cores import Core, Port

from tb.lib import tools

OPTIMISE = "-O1"  # the build costs more than the runs it speeds up
BENCH = True  # False: programs of a few short bulk runs, built without the cocotb bench and not optimised
SOURCES = [Path(__file__).with_name(name) for name in ("program.cpp", "bulk.cpp")]
COCOTB = Path(cocotb.__file__).parent
RUNTIME = ("verilated", "verilated_dpi", "verilated_vpi", "verilated_threads")
HEADERS = ("verilated.h", "verilated_vpi.h", "verilated_dpi.h", "cstdint", "cstdio", "cstdlib", "memory", "string",
           "vector")


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


def _coverage() -> bool:
    """Whether programs count the lines and bits that they reach: QUADRANCE_COVERAGE names the folder for the counts."""
    return "QUADRANCE_COVERAGE" in os.environ


def _flags() -> list[str]:
    """How C++ that Verilator wrote is compiled."""
    include = Path(tools.environment()["VERILATOR_ROOT"]) / "include"
    return ["-std=gnu++17", OPTIMISE if BENCH else "-O0", f"-I{include}", f"-I{include}/vltstd", "-DVERILATOR=1",
            "-Wno-sign-compare", f"-DVM_COVERAGE={int(_coverage())}",
            *(f"-DVM_{name}=0" for name in ("SC", "TIMING", "TRACE", "TRACE_FST", "TRACE_VCD"))]


def _runtime() -> tuple[Path, list[Path]]:
    """Verilator's own run-time, compiled once: its headers, precompiled, and the objects to link into every core."""
    include = Path(tools.environment()["VERILATOR_ROOT"]) / "include"
    flags = _flags()
    with locked(tools.BUILD / "verilator-runtime" / digest(flags, HEADERS)) as folder:
        header = folder / "headers.h"
        header.write_text("".join(f"#include <{name}>\n" for name in HEADERS))
        jobs = {folder / "headers.h.gch": ["-x", "c++-header", header]}
        jobs |= {folder / f"{name}.o": ["-c", include / f"{name}.cpp"]
                 for name in (*RUNTIME, *["verilated_cov"] * _coverage())}

        def compile(target: Path) -> None:
            if not target.exists():
                partial = target.with_suffix(".partial")
                tools.run("g++", *flags, *jobs[target], "-o", partial)
                partial.rename(target)  # an interrupted compilation leaves nothing that could be linked

        with ThreadPoolExecutor() as pool:
            list(pool.map(compile, jobs))
    return header, [target for target in jobs if target.suffix == ".o"]


def _accessors(core: Core) -> str:
    def macro(name: str, ports: Sequence[Port], form: str) -> str:
        body = " ".join(form.format(port=port.name, i=i) for i, port in enumerate(ports))
        return f"#define {name}(top, word) do {{ (void)(word); {body} }} while (0)\n"

    return (f"#define CLOCKED {int(core.clocked)}\n#define N_CFG {len(core.cfg)}u\n"
            f"#define N_IN {len(core.inputs)}\n#define N_OUT {len(core.outputs)}\n"
            + macro("SET_CFG", core.cfg, "(top).{port} = (word)[{i}];")
            + macro("SET_IN", core.inputs, "(top).{port} = (word)[{i}];")
            + macro("GET_OUT", core.outputs, "(word)[{i}] = (top).{port};"))


def build(core: Core, label: str = "") -> Path:
    """Verilate and compile the core with both harnesses, unless that was done for the same sources; the executable."""
    wide = [port.name for port in (*core.cfg, *core.inputs, *core.outputs) if port.width > 64]
    if wide:
        raise ValueError(f"{core.id}: bulk runs carry words of at most 64 bits, {wide[0]} is wider")
    accessors = _accessors(core)
    texts = [source.read_text() for source in SOURCES]
    with locked(build_folder(core, "verilator", label, texts, accessors, _coverage(), BENCH)) as folder:
        program = folder / "core"
        if not program.exists():
            _compile(core, folder, accessors, program)
    return program


def _compile(core: Core, folder: Path, accessors: str, program: Path) -> None:
    """cocotb sees the ports of the top module alone: nothing below it is kept from being optimised."""
    counters = ["--coverage-line", "--coverage-toggle"] if _coverage() else []
    ports = folder / "ports.vlt"
    ports.write_text(f'`verilator_config\npublic_flat_rw -module "{core.name}" -var "*"\n')
    tools.run("verilator", "-cc", "-Mdir", folder, "--prefix", "Vtop", "--top-module", core.name, *["--vpi"] * BENCH,
              "--timescale", "1ns/1ps", *counters, "-Wno-fatal", "-Wno-lint", "-Wno-style",
              *(f"-G{name}={value}" for name, value in core.params.items()), *[ports] * BENCH, *core.sources)
    parts = [*sorted(folder.glob("Vtop*.cpp")), SOURCES[not BENCH]]  # one compilation: most of it is what they share
    (folder / "ports.inc").write_text(accessors)
    main = "" if BENCH else "int main(int argc, char** argv) { return bulk_main(argc, argv); }\n"
    (folder / "all.cpp").write_text("".join(f'#include "{part}"\n' for part in parts) + main)
    header, objects = _runtime()
    partial = program.with_suffix(".partial")
    bench = [f"-L{COCOTB}/libs", f"-Wl,-rpath,{COCOTB}/libs", "-lcocotbvpi_verilator"] * BENCH
    tools.run("g++", *_flags(), "-include", header, "-I.", f"-I{COCOTB}/share/lib/verilator", "all.cpp", *objects,
              *bench, "-lpthread", "-o", partial, cwd=folder)
    partial.rename(program)
