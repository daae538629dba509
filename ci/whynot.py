"""Measure the page "Why not C?": the same kinematics in C, on this machine and on a soft CPU, beside the cores.

    python -m ci.whynot          print the tables of docs/why-not-c.md (minutes; what the tools said is kept)
"""

from __future__ import annotations

import ctypes
import os
import platform
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from quadrance import arms, cores, truth, truth_six
from quadrance.accuracy.arm import config
from quadrance.accuracy.of_core import modelled as model_of
from quadrance.cores import Core
from quadrance.fixed import Ints
from quadrance.truth import Floats

from ci import cache
from tb.lib import tools

SOURCE = tools.ROOT / "docs/why_not_c/kinematics.c"
WORK = tools.BUILD / "whynot"
SEED = 20261124
UNIT, TURN = 2.0**-16, 2 * np.pi / 2**18  # what a word's last bit is in the C program's floats
FLAGS = ("-O3", "-std=c11", "-Wall", "-Wextra", "-Werror", "-fno-math-errno", "-fno-trapping-math")
HOST = ("-fPIC", "-shared")


@dataclass(frozen=True)
class Row:
    """One function of the C program, in the order of its table, and the core that answers the same words."""

    name: str
    core: str
    ins: int
    outs: int
    label: str

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
        """The arm."""
        return arms.load("kr6_r700" if self.six else "cobra600")


ROWS = (Row("fk2", "vector_fk2", 4, 2, "fk2"), Row("ik2", "vector_ik2", 2, 4, "ik2"),
        Row("ik3", "vector_ik3", 3, 6, "ik3"), Row("ik6", "vector_ik6", 12, 12, "six axes, one branch"),
        Row("ik6_all", "vector_ik6_all", 12, 96, "six axes, all eight"),
        Row("fk2_angle", "table_fk2", 2, 2, "fk2"), Row("ik2_angle", "table_ik2", 2, 2, "ik2"),
        Row("ik3_angle", "table_ik3", 3, 3, "ik3"), Row("ik6_angle", "table_ik6", 12, 6, "six axes, one branch"))


# The program


def constants() -> list[str]:
    """Both arms as the C program wants them: lengths in units of 256 coordinate units."""
    plane, (six, mm) = arms.load("cobra600"), truth_six.load("kr6_r700")
    scale, large = 256 * plane.mm_per_unit, 256 * mm
    values = {"L1": plane.l1 / scale, "L2": plane.l2 / scale, "A1": six.a1 / large, "B": six.b / large,
              "C1": six.c1 / large, "C2": six.c2 / large, "C4": six.c4 / large, "K": six.k / large,
              "CP": np.cos(six.psi), "NP": np.sin(six.psi)}
    return [f"-D{name}={float(value)!r}" for name, value in values.items()]


def compiled(fixed: bool, *options: str, suffix: str = ".so", source: Path = SOURCE) -> Path:
    """The C program as float or in fixed point, by the compiler of the ziglang package; made once."""
    words = [*FLAGS, *constants(), *(["-DFIXED"] if fixed else []), *(options or HOST)]
    made = WORK / f"{cache.digest([source.read_text(), words, platform.node()])}{suffix}"
    if not made.exists():
        WORK.mkdir(parents=True, exist_ok=True)
        part = made.with_name(f"{os.getpid()}-{made.name}")
        tools.run(sys.executable, "-m", "ziglang", "cc", *words, str(source), "-o", str(part))
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
    given = np.ascontiguousarray(words if fixed else real(row, words, False), np.int32 if fixed else np.float32)
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
