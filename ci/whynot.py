"""Measure the page "Why not C?": the same kinematics in C, on this machine and on a soft CPU, beside the cores.

    python -m ci.whynot          print the tables of docs/why-not-c.md (minutes; what the tools said is kept)
"""

from __future__ import annotations

import argparse
import ctypes
import json
import os
import platform
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from quadrance import arms, cores, truth, truth_six
from quadrance.accuracy.arm import config
from quadrance.accuracy.of_core import modelled as model_of
from quadrance.cli import c, registers
from quadrance.fixed import Ints
from quadrance.truth import Floats
from rich.console import Console

from ci import cache, soc, synth
from ci.synth.__main__ import scratch_ports
from tb.lib import tools

SOURCE = tools.ROOT / "docs/why_not_c/kinematics.c"
WORK = tools.BUILD / "whynot"
SEED = 20261124
UNIT, TURN = 2.0**-16, 2 * np.pi / 2**18  # what a word's last bit is in the C program's floats
FLAGS = ("-O3", "-std=c11", "-Wall", "-Wextra", "-Werror", "-fno-math-errno", "-fno-trapping-math",
         "-fno-slp-vectorize")  # that pass of ziglang 0.17.1 (clang) miscompiles ik6 in fixed point for AVX-512
HOST = ("-fPIC", "-shared")


@dataclass(frozen=True)
class Row:
    """One function of the C program, in the order of its table, and the core that answers the same words."""

    name: str
    core: str
    ins: int
    outs: int

    @property
    def six(self) -> bool:
        """Whether it is of the arm with six axes."""
        return self.name.startswith("ik6")

    @property
    def angles(self) -> bool:
        """Whether joints are angles, not unit vectors."""
        return self.name.endswith("_angle")

    @property
    def arm(self) -> arms.Arm:
        """The arm; ik3 has the Cobra's two links on a turntable."""
        arm = arms.load("kr6_r700" if self.six else "cobra600")
        return arm if not self.name.startswith("ik3") else replace(arm, limits=(*arm.limits[:2], (-180.0, 180.0)))


ROWS = (Row("fk2", "vector_fk2", 4, 2), Row("ik2", "vector_ik2", 2, 4), Row("ik3", "vector_ik3", 3, 6),
        Row("ik6", "vector_ik6", 12, 12), Row("ik6_all", "vector_ik6_all", 12, 96),
        Row("fk2_angle", "table_fk2", 2, 2), Row("ik2_angle", "table_ik2", 2, 2), Row("ik3_angle", "table_ik3", 3, 3),
        Row("ik6_angle", "table_ik6", 12, 6))


# The program


def constants() -> list[str]:
    """Both arms as the C program wants them: lengths in units of 256 coordinate units."""
    plane, (six, mm) = arms.load("cobra600"), truth_six.load("kr6_r700")
    scale, large = 256 * plane.mm_per_unit, 256 * mm
    values = {"L1": plane.l1 / scale, "L2": plane.l2 / scale, "A1": six.a1 / large, "B": six.b / large,
              "C1": six.c1 / large, "C2": six.c2 / large, "C4": six.c4 / large, "K": six.k / large,
              "CP": np.cos(six.psi), "NP": np.sin(six.psi)}
    return [f"-D{name}={float(value)!r}" for name, value in values.items()]


def compiled(fixed: bool, *options: str, suffix: str = ".so", source: Path = SOURCE,
             text: Sequence[str] = ()) -> Path:
    """The C program as float or in fixed point, by the compiler of the ziglang package; made once.

    `text` is what `source` includes.
    """
    words = [*FLAGS, *constants(), *(["-DFIXED"] if fixed else []), *(options or HOST)]
    made = WORK / f"{cache.digest([source.read_text(), *text, words, platform.node()])}{suffix}"
    if not made.exists():
        WORK.mkdir(parents=True, exist_ok=True)
        part = made.with_name(f"{os.getpid()}-{made.name}")
        soc._zig(WORK, "cc", *words, source, "-o", part)
        part.replace(made)
    return made


def library(fixed: bool, source: Path = SOURCE) -> ctypes.CDLL:
    """The C program, loaded."""
    found = ctypes.CDLL(str(compiled(fixed, source=source)))
    found.batch.restype = ctypes.c_double
    found.start()
    return found


def _at(array: np.ndarray) -> ctypes.c_void_p:
    return array.ctypes.data_as(ctypes.c_void_p)


# Poses: words of the cores, so that all see the same


def poses(row: Row, count: int) -> tuple[Ints, Ints]:
    """Words (count, ins) and the elbow or branch (count) of each pose.

    fk2: both joints anywhere. ik2, ik3: tips anywhere in reach. Six axes: all joints anywhere, and any branch, so that
    some poses are out of reach on theirs.
    """
    rng, arm = np.random.default_rng(SEED), row.arm
    way = rng.integers(0, 8 if row.six else 2, count)
    if row.six:
        six, mm = truth_six.load(arm.id)
        rotation, tip = truth_six.fk6(rng.uniform(-np.pi, np.pi, (count, 6)), six)
        return np.rint(np.concatenate([rotation.reshape(count, 9) / UNIT, tip / mm * 256], 1)).astype(np.int64), way
    if row.name == "fk2_angle":
        return rng.integers(0, 2**18, (count, 2)), way
    if row.name == "fk2":
        theta = rng.uniform(-np.pi, np.pi, (count, 2))
        return np.rint(np.stack(truth.unit(theta), -1).reshape(count, 4) / UNIT).astype(np.int64), way
    axes, near, far = (2, 3)[row.name.startswith("ik3")], abs(arm.l1 - arm.l2), arm.l1 + arm.l2
    place = rng.normal(size=(count, axes))
    radius = rng.uniform(near**axes, far**axes, count) ** (1 / axes)
    place *= (radius / np.linalg.norm(place, axis=1))[:, None]
    return np.rint(place / arm.mm_per_unit * 256).astype(np.int64), way


def real(row: Row, words: Ints, outputs: bool) -> Floats:
    """Words as the C program's floats: coordinates in 256 units, unit vectors, angles in radians."""
    return words * (TURN if row.angles and outputs is not row.name.startswith("fk") else UNIT)


def answered(row: Row, fixed: bool, words: Ints, way: Ints, program: ctypes.CDLL | None = None,
             took: np.ndarray | None = None) -> tuple[Floats, Ints]:
    """Answers (count, outs) of the C program on this machine as reals, and its flags; fills `took` with ns."""
    program, count = program or library(fixed), len(words)
    given = given_to(row, fixed, words)
    got, flags = np.zeros((count, row.outs), given.dtype), np.zeros(count, np.int32)
    took = np.zeros(count, np.uint32) if took is None else took
    program.each(1 + ROWS.index(row), count, _at(given), _at(np.ascontiguousarray(way, np.int32)), _at(got), _at(flags),
                 _at(took))
    return (real(row, got, True) if fixed else got.astype(np.float64)), flags


def modelled(row: Row, words: Ints, way: Ints) -> Floats:
    """Answers (count, outs) of the core's bit-true model as reals."""
    core = cores.find(row.core)
    names = [port.name for port in core.inputs]
    inputs = dict(zip(names, [*words.T, way], strict=False))
    outputs = model_of(core, inputs, config(core, row.arm))
    return real(row, np.stack([outputs[port.name] for port in core.outputs][:row.outs], -1), True)


def tip_error(row: Row, words: Ints, way: Ints, got: Floats) -> Floats:
    """Distance (mm) of each answer's tip from the pose's; NaN where float64 has no answer either.

    Eight branches: an answer a branch. An answer out of reach is not judged.
    """
    arm, scale = row.arm, 256 * row.arm.mm_per_unit
    given = real(row, words, False)
    if row.name.startswith("fk"):
        theta = given if row.angles else directions(given)
        return np.linalg.norm(np.stack(truth.fk2(*theta.T, arm.l1, arm.l2), -1) - got * scale, axis=-1)
    if row.six:
        six, _ = truth_six.load(arm.id)
        rotation, tip = given[:, :9].reshape(-1, 3, 3), given[:, 9:] * scale
        if row.name == "ik6_all":
            rotation, tip, way = rotation[:, None], tip[:, None], np.arange(8)
            got = got.reshape(-1, 8, 12)
        _, out = truth_six.ik6(rotation, tip, six, way)
        _, reached = truth_six.fk6(got if row.angles else directions(got), six)
        return np.where(out, np.nan, np.linalg.norm(reached - tip, axis=-1))
    theta, target = got if row.angles else directions(got), given * scale
    reached = truth.tip(theta, arm.l1, arm.l2)[..., :target.shape[1]]
    inside = truth.reach(np.linalg.norm(target, axis=1), 0, arm.l1, arm.l2) == 0
    return np.where(inside, np.linalg.norm(reached - target, axis=1), np.nan)


def directions(vectors: Floats) -> Floats:
    """Angles (..., joints) of unit vectors (..., 2 * joints)."""
    pairs = vectors.reshape(*vectors.shape[:-1], -1, 2)
    return np.arctan2(pairs[..., 1], pairs[..., 0])


# The soft CPU: PicoRV32 as one sets it up that computes, on a memory without wait states

CPU = {"ENABLE_FAST_MUL": 1, "ENABLE_DIV": 1, "BARREL_SHIFTER": 1, "ENABLE_COUNTERS64": 0}
FIRMWARE = (*soc.TARGET, "-ffreestanding", "-g0")
JOBS, DATA, BASE = 0x20000, 0x21000, 0x40000000  # jobs, poses and what follows; registers of a core
LINK = """ENTRY(_start)
SECTIONS { .text 0 : { *(.start) *(.text*) *(.rodata*) *(.srodata*) *(.data*) *(.sdata*) }
           .bss : { *(.sbss*) *(.bss*) *(COMMON) } /DISCARD/ : { *(.comment) *(.eh_frame*) *(.riscv.attributes) } }
"""
TOP = """module soc (input wire clk, input wire resetn, output wire trap, output wire la_read, output wire la_write,
    output wire [31:0] la_addr, output wire [31:0] la_wdata, output wire [3:0] la_wstrb, input wire [31:0] rdata);
  wire valid; wire [31:0] addr, wdata; wire [3:0] wstrb;
  wire chosen = addr[31:30] == 2'd1, ack; wire [31:0] found;
  picorv32 #({cpu}) cpu (.clk(clk), .resetn(resetn), .trap(trap), .mem_valid(valid), .mem_addr(addr),
    .mem_wdata(wdata), .mem_wstrb(wstrb), .mem_ready(chosen ? ack : 1'b1), .mem_rdata(chosen ? found : rdata),
    .mem_la_read(la_read), .mem_la_write(la_write), .mem_la_addr(la_addr), .mem_la_wdata(la_wdata),
    .mem_la_wstrb(la_wstrb), .mem_instr(), .pcpi_valid(), .pcpi_insn(), .pcpi_rs1(), .pcpi_rs2(), .pcpi_wr(1'b0),
    .pcpi_rd(32'd0), .pcpi_wait(1'b0), .pcpi_ready(1'b0), .irq(32'd0), .eoi(), .trace_valid(), .trace_data());
  {core}
endmodule
"""
ALONE = "assign ack = 1'b1, found = 32'd0;"
BUS = """{top} core (.clk_i(clk), .rst_i(!resetn), .cyc_i(valid && chosen), .stb_i(valid && chosen && !ack),
    .we_i(wstrb != 4'd0), .adr_i(addr[11:2]), .dat_i(wdata), .sel_i(wstrb != 4'd0 ? wstrb : 4'd15), .ack_o(ack),
    .dat_o(found), .stall_o(), .irq());"""
HARNESS = """#include "Vsoc.h"
#include <cstdint>
#include <cstdio>
#include <vector>
int main(int, char **argv) {  // image in, image out: runs until the program's ebreak
    std::vector<uint32_t> memory(4 << 20);
    FILE *f = std::fopen(argv[1], "rb");
    if (!f || !std::fread(memory.data(), 1, 16 << 20, f)) return 1;
    std::fclose(f);
    Vsoc t; t.resetn = 0;
    uint32_t word = 0;
    for (uint64_t clock = 0; clock < 4000000000; clock++) {
        t.clk = 0; t.resetn = clock >= 8; t.rdata = word; t.eval();
        if (t.resetn && t.trap) {
            f = std::fopen(argv[2], "wb");
            return std::fwrite(memory.data(), 1, 16 << 20, f) != 16 << 20 || std::fclose(f);
        }
        uint32_t at = t.la_addr >> 2;
        if (t.resetn && at < memory.size()) {
            if (t.la_read) word = memory[at];
            if (t.la_write)
                for (int i = 0; i < 4; i++)
                    if (t.la_wstrb >> i & 1)
                        memory[at] = (memory[at] & ~(255u << 8 * i)) | (t.la_wdata & 255u << 8 * i);
        }
        t.clk = 1; t.eval();
    }
    return 2;
}
"""


def picorv32() -> Path:
    """Its Verilog, in the repository: YoWASP sees nothing outside."""
    WORK.mkdir(parents=True, exist_ok=True)
    local, text = WORK / "picorv32.v", soc.picorv32().read_text()
    if not local.exists() or local.read_text() != text:
        local.write_text(text)
    return local


def simulator(core: str = ALONE, sources: Sequence[Path] = ()) -> Path:
    """The soft CPU, alone or with a core behind Wishbone, as a program; made once."""
    top = TOP.format(cpu=", ".join(f".{name}({value})" for name, value in CPU.items()), core=core)
    cpu = picorv32()
    key = [top, HARNESS, cpu.read_text(), *(path.read_text() for path in sources), tools.versions()["verilator"]]
    folder = WORK / cache.digest(key)
    if not (folder / "soc").exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "soc.v").write_text(top)
        (folder / "main.cpp").write_text(HARNESS)
        tools.run("verilator", "--cc", "--exe", "--build", "-O3", "-CFLAGS", "-O2", "-Wno-fatal", "-Wno-lint",
                  "-Wno-style", "--Mdir", folder, "--prefix", "Vsoc", "--top-module", "soc", folder / "soc.v", cpu,
                  *sources, folder / "main.cpp", "-o", folder / "soc")
    return folder / "soc"


def firmware(fixed: bool, source: Path = SOURCE, *options: str, text: Sequence[str] = ()) -> bytes:
    """The program for the soft CPU, from address 0."""
    WORK.mkdir(parents=True, exist_ok=True)
    link = WORK / "link.ld"
    link.write_text(LINK)
    elf = compiled(fixed, *FIRMWARE, *options, f"-Wl,-T,{link}", suffix=".elf", source=source, text=text)
    return soc.loaded(elf.read_bytes())


def on_cpu(run: Path, image: bytes, jobs: Sequence[tuple[int, np.ndarray, Ints, int]]) -> list[tuple[np.ndarray, Ints]]:
    """Answers and clocks of jobs (function, inputs (count, ins), ways, words of an answer) on the soft CPU."""
    memory = bytearray(16 << 20)
    memory[:len(image)] = image
    at, places = DATA, []
    for number, (which, given, way, outs) in enumerate(jobs):
        count, starts = len(given), []
        for data in (given.tobytes(), way.astype("<i4").tobytes(), bytes(4 * outs * count), bytes(4 * count),
                     bytes(4 * count)):
            memory[at:at + len(data)] = data
            starts.append(at)
            at += len(data)
        memory[JOBS + 28 * number:JOBS + 28 * (number + 1)] = np.array([which, count, *starts], "<i4").tobytes()
        places.append((starts, count, outs, given.dtype))
    if at > len(memory) or len(image) > JOBS // 2:
        raise ValueError("the jobs do not fit into the memory of the soft CPU")
    source, target = (WORK / f"{os.getpid()}.{name}" for name in ("in", "out"))
    source.write_bytes(memory)
    tools.run(str(run), source, target)
    after = target.read_bytes()
    source.unlink(), target.unlink()
    found = []
    for starts, count, outs, kind in places:
        got = np.frombuffer(after, kind, count * outs, starts[2]).reshape(count, outs)
        found.append((got, np.frombuffer(after, "<u4", count, starts[4]).astype(np.int64)))
    return found


# A core behind registers, called by the soft CPU

DRIVER = """#include <stdint.h>
#include "{core}.h"
static __attribute__((noinline)) int call_core(const int32_t *in, int way, int32_t *out) {{
    {core}_out o;
    (void)way;
    {core}_run((volatile uint32_t *){base:#x}u, {given}, &o);
{taken}
    return (int)o.status;
}}
#define MORE {{call_core, {ins}, {outs}}},
#define SETUP {core}_configure((volatile uint32_t *){base:#x}u, &{core}_arm);
#include "{source}"
"""


def by_bus(row: Row, words: Ints, way: Ints) -> tuple[np.ndarray, np.ndarray]:
    """Answers (words) and clocks of the row's core that the soft CPU calls over Wishbone, by polling."""
    core = cores.find(row.core)
    folder = WORK / row.core
    folder.mkdir(parents=True, exist_ok=True)
    made = registers.files(core, "wishbone", config(core, row.arm))
    driver = DRIVER.format(core=core.name, base=BASE, ins=row.ins, outs=row.outs, source=SOURCE, given=", ".join(
        [f"in[{i}]" for i in range(row.ins)] + ["(uint32_t)way"] * (len(core.inputs) - row.ins)),
        taken="\n".join(f"    out[{i}] = o.{port.name[4:]};" for i, port in enumerate(core.outputs[:row.outs])))
    made |= {f"{core.name}.h": c.header(core, row.arm), "quadrance.h": c.SHARED.read_text(), "driver.c": driver}
    for name, text in made.items():
        (folder / name).write_text(text)
    headers = Path(find_spec("ziglang").origin).parent / "lib/libc/include"
    image = firmware(True, folder / "driver.c", "-isystem", str(headers / "riscv32-linux-musl"), "-isystem",
                     str(headers / "generic-musl"), text=[SOURCE.read_text(), *made.values()])
    run = simulator(BUS.format(top=registers.top(core, "wishbone")), [folder / n for n in made if n.endswith(".v")])
    nothing = np.zeros((len(words), 1), np.int32)
    jobs = [(0, nothing, way, 1), (1 + len(ROWS), words.astype(np.int32), way, row.outs)]
    (_, empty), (got, took) = on_cpu(run, image, jobs)
    return got, took - empty.min()


# What the page shows

MANY, CHUNK = 1_000_000, 20_000  # poses here, and between two rests
SIMULATED = {False: 1_000, True: 10_000}  # poses on the soft CPU, as float and in fixed point
BATCH, STRIDE = 512, 528  # as in the C program
Stamp = tuple[float, float, float]  # mean, 99.9 %, worst


def stamp(took: np.ndarray) -> Stamp:
    """Mean, 99.9 % and worst of what calls took."""
    return float(took.mean()), float(np.quantile(took, 0.999)), float(took.max())


def _alone() -> str:
    """Keep this process on one processor core and in memory; what the system allowed, `_first` included."""
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    said = ["pinned to one of them", "real-time priority" if _first(True) else "no real-time priority",
            "memory locked" if ctypes.CDLL(None).mlockall(3) == 0 else "memory not locked"]
    _first(False)
    return ", ".join(said)


def _first(real_time: bool) -> bool:
    """Go before all other processes, or back; whether the system allows it."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO if real_time else os.SCHED_OTHER, os.sched_param(50 * real_time))
    except OSError:
        return False
    return True


def timed(program: ctypes.CDLL, which: int, given: np.ndarray, way: Ints, outs: int) -> np.ndarray:
    """What each call took here, in ns of the system's clock; rests between chunks, warm before each."""
    took, got = np.zeros(len(given), np.uint32), np.zeros((CHUNK, outs), given.dtype)
    way, flags = np.ascontiguousarray(way, np.int32), np.zeros(CHUNK, np.int32)
    for at in range(0, len(given), CHUNK):
        time.sleep(0.005)
        part = slice(at, min(at + CHUNK, len(given)))
        _first(True)
        for count in (min(500, part.stop - at), part.stop - at):
            program.each(which, count, _at(given[part]), _at(way[part]), _at(got), _at(flags), _at(took[part]))
        _first(False)
    return took


def batched(program: ctypes.CDLL, row: Row, given: np.ndarray, way: Ints) -> tuple[np.ndarray, float]:
    """Answers (BATCH, outs) of the first poses as one batch, and ns a pose: the least of 20 measurements."""
    side = np.zeros((row.ins, STRIDE), given.dtype)
    side[:, :BATCH] = given[:BATCH].T
    got, way = np.zeros((row.outs, STRIDE), given.dtype), np.ascontiguousarray(way, np.int32)
    which = 1 + ROWS.index(row)
    least = min(program.batch(which, 100, _at(side), _at(way), _at(got)) for _ in range(20))
    return got[:, :BATCH].T, least / 100 / BATCH


def given_to(row: Row, fixed: bool, words: Ints) -> np.ndarray:
    """Words as the C program takes them."""
    return np.ascontiguousarray(words if fixed else real(row, words, False), np.int32 if fixed else np.float32)


def here(fixed: bool) -> tuple[list[Stamp], list[float]]:
    """For an empty call and each row: ns of a call on this machine; for each row: ns a pose of a batch.

    Subtracted is the mean of the empty calls, without the slowest thousandth.
    """
    program, batches = library(fixed), []
    empty = timed(program, 0, np.zeros((MANY, 1), np.int32), np.zeros(MANY), 1)
    base = np.sort(empty)[:-MANY // 1000].mean()
    stamps = [stamp(empty - base)]
    for row in ROWS:
        words, way = poses(row, MANY)
        given = given_to(row, fixed, words)
        stamps.append(stamp(timed(program, 1 + ROWS.index(row), given, way, row.outs) - base))
        batches.append(batched(program, row, given, way)[1])
    return stamps, batches


def there(fixed: bool) -> list[Stamp]:
    """For each row: clocks of a call on the soft CPU, an empty call's subtracted.

    Its answers in fixed point must be this machine's.
    """
    count, jobs = SIMULATED[fixed], [(0, np.zeros((10, 1), np.int32), np.zeros(10), 1)]
    drawn = [poses(row, count) for row in ROWS]
    jobs += [(which, given_to(row, fixed, words), way, row.outs)
             for which, (row, (words, way)) in enumerate(zip(ROWS, drawn), 1)]
    (_, empty), *done = on_cpu(simulator(), firmware(fixed), jobs)
    for row, (words, way), (got, _) in zip(ROWS, drawn, done):
        if fixed and not np.array_equal(real(row, got, True), answered(row, True, words, way)[0]):
            raise SystemExit(f"{row.name}: the soft CPU answers other words than this machine")
    return [stamp(took - empty.min()) for _, took in done]


def called() -> list[Stamp]:
    """For each row: clocks of a call of the core by the soft CPU. The core's answers must be its model's."""
    stamps = []
    for row in ROWS:
        words, way = poses(row, 1000)
        got, took = by_bus(row, words, way)
        if not np.array_equal(real(row, got, True), modelled(row, words, way)):
            raise SystemExit(f"{row.core} on the bus answers other words than its model")
        stamps.append(stamp(took))
    return stamps


def wrong(row: Row) -> list[tuple[float, float]]:
    """The 99.9 % and the worst tip error (mm) over all poses: C as float, in fixed point, the core."""
    words, way = poses(row, MANY)
    parts = [slice(at, at + CHUNK) for at in range(0, MANY, CHUNK)]
    found = []
    for answers in (lambda w, e: answered(row, False, w, e)[0], lambda w, e: answered(row, True, w, e)[0],
                    lambda w, e: modelled(row, w, e)):
        errors = np.concatenate([tip_error(row, words[p], way[p], answers(words[p], way[p])).ravel() for p in parts])
        found.append((float(np.nanquantile(errors, 0.999)), float(np.nanmax(errors))))
    return found


def cpu_on_ecp5() -> dict[str, float]:
    """Area and clock of the soft CPU alone, in the flow of the cores."""
    sources = [picorv32()]
    return {**synth.area("ecp5", "picorv32", CPU, sources),
            "mhz": synth.fmax("picorv32", CPU, sources, *scratch_ports("picorv32", CPU, sources))}


def core_on_ecp5(row: Row) -> dict[str, float]:
    """Area, clock, clocks and ns of a row's core at its first set, from the report."""
    report = json.loads((tools.ROOT / "reports/report.json").read_text())
    core = cores.find(row.core)
    found = next(one for one in report["cores"] if one["core"] == core.name and one["set"] == core.set_id)
    return {**found["area"]["ecp5"], "mhz": found["fmax_mhz"]["ecp5"], "clocks": found["latency_cycles"],
            "ns": found["latency_ns"], "ii": found["ii"]}


def brief(value: float, digits: int = 3) -> str:
    """A number of so many digits, without an exponent."""
    whole = abs(value) >= 10 ** (digits - 1) or value == int(value)
    return f"{round(value, digits - len(str(int(abs(value))))):.0f}" if whole else f"{value:.{digits}g}"


def table(heads: Sequence[str], rows: Sequence[Sequence[str | float]]) -> str:
    """A table in Markdown."""
    lines = [heads, [":-", *["-:"] * (len(heads) - 1)]]
    lines += [[one if isinstance(one, str) else str(one) if isinstance(one, int) else brief(one) for one in row]
              for row in rows]
    return "\n".join(f"|{'|'.join(line)}|" for line in lines)


def machine() -> str:
    """The name of this machine's processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    said = dict(line.split(":", 1) for line in lines if ":" in line)
    keys = {key.strip(): value.strip() for key, value in said.items()}
    guest = ", a guest of a hypervisor" if "hypervisor" in keys.get("flags", "") else ""
    return f"{keys.get('model name', platform.processor())} (family {keys.get('cpu family')}, model " \
           f"{keys.get('model')}; {os.cpu_count()} processor cores{guest})"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m ci.whynot", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.parse_args()
    if lacks := soc.missing():
        raise SystemExit(lacks)
    console = Console(stderr=True)
    with console.status("area and clock of the soft CPU") as status:
        cpu, of_core = cpu_on_ecp5(), [core_on_ecp5(row) for row in ROWS]
        status.update("the C program on the soft CPU")
        soft, whole = there(False), there(True)
        status.update("cores on the bus of the soft CPU")
        bus = called()
        status.update("errors")
        errors = [wrong(row) for row in ROWS]
    load, alone = os.getloadavg()[0], _alone()
    (float_ns, float_batch), (fixed_ns, fixed_batch) = here(False), here(True)
    labels = [f"`{row.core}`" for row in ROWS]

    def some(*values: float) -> str:
        return "/".join(brief(value, 2) for value in values)

    print(f"Measured on {datetime.now(UTC):%Y-%m-%d} on {machine()}: {alone}, load {load:.1f} before.\n")
    print(table(["PC, ns", "C, float: mean/99.9 %/worst", "C, fixed: mean/99.9 %/worst",
                 "C, batch: float/fixed", "core: latency/interval"],
                [["empty", some(*float_ns[0]), some(*fixed_ns[0]), "", ""]] +
                [[label, some(*f), some(*x), some(fb, xb), some(c["ns"], 1e3 * c["ii"] / c["mhz"])]
                 for label, f, x, fb, xb, c in
                 zip(labels, float_ns[1:], fixed_ns[1:], float_batch, fixed_batch, of_core)]), end="\n\n")
    print(table(["PicoRV32, clocks", "C, float: mean/worst", "C, fixed: mean/worst", "core called: worst",
                 "core alone", "µs: C, fixed", "µs: core called", "µs: core alone"],
                [[label, f"{f[0]:.0f}/{f[2]:.0f}", f"{x[0]:.0f}/{x[2]:.0f}", int(b[2]), c["clocks"],
                  x[2] / cpu["mhz"], b[2] / min(cpu["mhz"], c["mhz"]), c["ns"] / 1e3]
                 for label, f, x, b, c in zip(labels, soft, whole, bus, of_core)]), end="\n\n")
    columns = ("lut", "ff", "dsp", "mem", "mhz")
    areas = [["PicoRV32", *(cpu[column] for column in columns)]]
    areas += [[label, *(c[column] for column in columns)] for label, c in zip(labels, of_core)]
    print(table(["ECP5", "LUT", "FF", "MULT18X18", "EBR", "MHz"], areas), end="\n\n")
    print(table(["tip error, mm: 99.9 %/worst", "C, float", "C, fixed", "core"],
                [[label, *(f"{a:.4f}/{b:.4f}" for a, b in error)] for label, error in zip(labels, errors)]))


if __name__ == "__main__":
    main()
