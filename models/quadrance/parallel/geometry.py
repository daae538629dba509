"""Robot files, one TOML file each, and the geometry that follows from them.

    name = "..."                what it is called
    source = "..."              where the figures come from
    kind = "reconfigurable"     or "legs", "delta": which tables follow
    up = [0, 1, 0]              the axis that all cranks share with alpha = 90 degrees

    [reconfigurable]            Table 1 of the paper, mm and degrees; legs 1-3 have the reconfiguration link
    rf = 50.0                   radius of the axes of the reconfiguration links
    rr = 150.0                  length of these links
    r2 = 450.0                  radius of the crank axes of legs 4-6
    h0 = 200.0                  how far these lie below
    la = 200.0                  crank
    lb = 400.0                  rod
    h = 34.0                    height of the platform's prism
    r = 50.0                    radius of its ball joints
    theta = [35, 155, 275, 25, 145, 265]

    [delta]                     mm and degrees
    base = 33.9                 radius of the crank axes
    platform = 0.0              radius of the ball joints
    height = 412.9              of the crank axes, along z
    la = 170.0
    lb = 320.0
    azimuth = [30, 150, 270]    of the legs, about z from x

    [[leg]]                     of kind "legs", three or six of them
    foot = [x, y, z]            centre of the crank axis, mm
    azimuth = 30                of the crank at alpha = 0, degrees about up
    joint = [x, y, z]           ball joint in the platform's frame, mm
    la = 25.0
    lb = 140.0
    branch = "+"                which of the two crank angles: "+" or "-"; "+" where nothing is said
"""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
HERE = Path(__file__).resolve().parent / "robots"
KINDS = ("reconfigurable", "legs", "delta")
PRISM = (30.0, 150.0, 270.0)  # azimuths of the paper's ball joints in the platform, degrees (inferred: MATHS)


class RobotError(ValueError):
    """A robot file that cannot be used: names the file, the key and the reason."""


class PoseError(ValueError):
    """A pose, an angle or a start that cannot be used: says which and why."""


@dataclass(frozen=True, eq=False)
class Robot:
    """Legs of a parallel robot. Arrays have one row a leg; lengths in millimetres.

    foot : (n, 3), where the crank axis is at link angle and length 0: F of the paper, A of a leg without link.
    radial : (n, 3), unit vector of the crank at alpha = 0; `up` is that at 90 degrees.
    link : (n,), length of the reconfiguration link, 0 for a leg without one.
    joint : (n, 3), ball joint in the platform's frame.
    branch : (n,), +1 or -1: sign of the root of the leg.
    """

    id: str
    name: str
    source: str
    kind: str
    up: Floats
    foot: Floats
    radial: Floats
    link: Floats
    la: Floats
    lb: Floats
    joint: Floats
    branch: Floats

    @property
    def legs(self) -> int:
        """How many."""
        return self.foot.shape[0]

    @property
    def axis(self) -> Floats:
        """(n, 3) unit vectors u of the crank axes: a growing alpha turns right-handed about them."""
        return np.cross(self.radial, self.up)

    def shoulders(self, beta: ArrayLike = 0.0) -> Floats:
        """(..., n, 3) crank axes A at link angles `beta` (...), radians.

        Paper: (1), (2), with z = -R sin theta (inferred: only this sense of theta reproduces the published figures).
        """
        beta = np.asarray(beta, dtype=np.float64)[..., None, None]
        return self.foot + self.link[:, None] * (np.cos(beta) * self.radial + np.sin(beta) * self.up)

    def elbows(self, alpha: ArrayLike, beta: ArrayLike = 0.0) -> Floats:
        """(..., n, 3) ends B of the cranks at `alpha` (..., n), an absolute angle as in (3)."""
        alpha = np.asarray(alpha, dtype=np.float64)[..., None]
        return self.shoulders(beta) + self.la[:, None] * (np.cos(alpha) * self.radial + np.sin(alpha) * self.up)

    def joints(self, rotation: ArrayLike, position: ArrayLike) -> Floats:
        """(..., n, 3) ball joints C of the platform at a pose, (14)."""
        return np.einsum("...ij,nj->...ni", rotation, self.joint) + np.asarray(position)[..., None, :]


def known() -> list[str]:
    """Names of the robots that come with the library."""
    return sorted(path.stem for path in HERE.glob("*.toml"))


def load(name_or_path: str | Path) -> Robot:
    """The robot of that name (a file of robots/) or of that TOML file.

    Raises
    ------
    RobotError
        Naming the file, the key and the reason.
    """
    path = Path(name_or_path)
    if path.suffix != ".toml" and len(path.parts) == 1:
        if path.name not in known():
            raise RobotError(f"no robot '{name_or_path}': known robots are {', '.join(known())}; "
                             "or give the path of a .toml file")
        path = HERE / f"{path.name}.toml"
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise RobotError(f"{path}: cannot be read: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise RobotError(f"{path}: not TOML: {error}") from None
    return _robot(path, data)


def _azimuth(degrees: float, up: Floats) -> Floats:
    """Unit vector at that azimuth, right-handed about `up`, from x (from z where up is x)."""
    x = np.roll(np.eye(3)[0], 2) if up[0] else np.eye(3)[0]
    angle = math.radians(degrees)
    return math.cos(angle) * x + math.sin(angle) * np.cross(up, x)


class _Reader:
    """Values of one file, each checked; an error names file, key and reason."""

    def __init__(self, path: Path):
        self.path = path

    def fail(self, key: str, reason: str):
        raise RobotError(f"{self.path}: {key}: {reason}")

    def only(self, table: dict, prefix: str, keys: set[str]) -> None:
        for key in sorted(set(table) - keys):
            self.fail(prefix + key, f"is not a key of this table; known here: {', '.join(sorted(keys))}")

    def take(self, table: dict, prefix: str, key: str, kind: type, wanted: str):
        if key not in table:
            self.fail(prefix + key, "is missing")
        if not isinstance(table[key], kind) or isinstance(table[key], bool):
            self.fail(prefix + key, f"must be {wanted}, not {table[key]!r}")
        return table[key]

    def number(self, table: dict, prefix: str, key: str, low: float = -math.inf, strict: bool = False) -> float:
        value = float(self.take(table, prefix, key, int | float, "a number"))
        if not math.isfinite(value):
            self.fail(prefix + key, f"must be finite, not {value}")
        if value < low or (strict and value == low):
            self.fail(prefix + key, f"must be {'positive' if strict else 'at least 0'}, not {value:g}")
        return value

    def length(self, table: dict, prefix: str, key: str) -> float:
        return self.number(table, prefix, key, 0.0, strict=True)

    def numbers(self, table: dict, prefix: str, key: str, count: int) -> Floats:
        value = self.take(table, prefix, key, list, f"a list of {count} numbers")
        if len(value) != count or not all(type(one) in (int, float) and math.isfinite(one) for one in value):
            self.fail(prefix + key, f"must be a list of {count} finite numbers, not {value!r}")
        return np.array(value, dtype=np.float64)


def _robot(path: Path, data: dict) -> Robot:
    read = _Reader(path)
    name, source, kind = (read.take(data, "", key, str, "a string") for key in ("name", "source", "kind"))
    if kind not in KINDS:
        read.fail("kind", f"must be one of {', '.join(KINDS)}, not {kind!r}")
    table = "leg" if kind == "legs" else kind
    read.only(data, "", {"name", "source", "kind", "up", table})
    up = read.numbers(data, "", "up", 3)
    if sorted(np.abs(up)) != [0, 0, 1]:
        read.fail("up", f"must be an axis such as [0, 1, 0], not {data['up']!r}")
    legs = {"reconfigurable": _reconfigurable, "delta": _delta, "legs": _legs}[kind](
        read, read.take(data, "", table, list if kind == "legs" else dict,
                        "a list of tables" if kind == "legs" else "a table"), up)
    foot, radial, link, la, lb, joint, branch = (np.array(column, dtype=np.float64) for column in legs)
    return Robot(path.stem, name, source, kind, up, foot, radial, link, la, lb, joint, branch)


def _reconfigurable(read: _Reader, table: dict, up: Floats) -> tuple:
    keys = ("rf", "rr", "r2", "h0", "la", "lb", "h", "r")
    read.only(table, "reconfigurable.", {*keys, "theta"})
    rf, rr, r2, h0, la, lb, h, r = (read.length(table, "reconfigurable.", key) for key in keys)
    radial = [_azimuth(angle, up) for angle in read.numbers(table, "reconfigurable.", "theta", 6)]
    prism = [r * _azimuth(angle, up) for angle in PRISM]
    return ([rf * one for one in radial[:3]] + [r2 * one - h0 * up for one in radial[3:]], radial, [rr] * 3 + [0] * 3,
            [la] * 6, [lb] * 6, [one + h * up for one in prism] + prism, [1] * 6)


def _delta(read: _Reader, table: dict, up: Floats) -> tuple:
    read.only(table, "delta.", {"base", "platform", "height", "la", "lb", "azimuth"})
    base, platform = (read.number(table, "delta.", key, 0.0) for key in ("base", "platform"))
    la, lb = (read.length(table, "delta.", key) for key in ("la", "lb"))
    height, z = read.number(table, "delta.", "height"), np.eye(3)[2]
    radial = [_azimuth(angle, z) for angle in read.numbers(table, "delta.", "azimuth", 3)]
    if abs(up[2]) != 1:
        read.fail("up", f"must be [0, 0, 1] or [0, 0, -1] for a delta, not {up.astype(int).tolist()}")
    return ([base * one + height * z for one in radial], radial, [0] * 3, [la] * 3, [lb] * 3,
            [platform * one for one in radial], [up[2]] * 3)  # the knees are outside


def _legs(read: _Reader, table: list, up: Floats) -> tuple:
    if len(table) not in (3, 6):
        read.fail("leg", f"there must be three or six, not {len(table)}")
    columns: tuple[list, ...] = ([], [], [], [], [], [], [])
    for i, leg in enumerate(table, 1):
        where = f"leg {i}."
        if not isinstance(leg, dict):
            read.fail(where[:-1], f"must be a table, not {leg!r}")
        read.only(leg, where, {"foot", "azimuth", "joint", "la", "lb", "branch"})
        if leg.get("branch", "+") not in ("+", "-"):
            read.fail(f"{where}branch", f'must be "+" or "-", not {leg["branch"]!r}')
        row = (read.numbers(leg, where, "foot", 3), _azimuth(read.number(leg, where, "azimuth"), up), 0.0,
               read.length(leg, where, "la"), read.length(leg, where, "lb"), read.numbers(leg, where, "joint", 3),
               -1 if leg.get("branch") == "-" else 1)
        for column, value in zip(columns, row):
            column.append(value)
    return columns


def rotation(*turns: tuple[str, float]) -> Floats:
    """Product of turns about axes, each (axis, degrees): ``rotation(("z", 5), ("y", -15), ("x", 10))``."""
    answer = np.eye(3)
    for axis, degrees in turns:
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        turn = np.eye(3)
        turn[i, i] = turn[j, j] = c
        turn[i, j], turn[j, i] = -s, s
        answer = answer @ turn
    return answer


def of_quaternion(quaternion: ArrayLike) -> Floats:
    """(..., 3, 3) rotation of a unit quaternion (..., 4), scalar first.

    Raises
    ------
    PoseError
        Where its length is not 1 within 1e-6.
    """
    q = np.asarray(quaternion, dtype=np.float64)
    if q.shape[-1:] != (4,) or not np.all(np.abs(np.sum(q * q, axis=-1) - 1) < 2e-6):
        raise PoseError("quaternion: must be four numbers (scalar first) of length 1")
    w, x, y, z = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def check_pose(matrix: ArrayLike, position: ArrayLike, tolerance: float = 1e-3) -> tuple[Floats, Floats]:
    """(rotation, position) as arrays (..., 3, 3), (..., 3).

    The matrices of the paper have four digits: `tolerance` is that of R R^T - 1.

    Raises
    ------
    PoseError
        For a matrix that is no rotation, or a number that is not finite.
    """
    matrix, position = np.asarray(matrix, dtype=np.float64), np.asarray(position, dtype=np.float64)
    if matrix.shape[-2:] != (3, 3) or position.shape[-1:] != (3,):
        raise PoseError(f"pose: shapes {matrix.shape} and {position.shape}, not (..., 3, 3) and (..., 3)")
    if not (np.all(np.isfinite(matrix)) and np.all(np.isfinite(position))):
        raise PoseError("pose: a number is not finite")
    off = np.abs(matrix @ np.swapaxes(matrix, -1, -2) - np.eye(3)).max(axis=(-2, -1))
    if np.any(off > tolerance):
        raise PoseError(f"pose: the matrix is no rotation: R R^T is off by {off.max():.3g}")
    if np.any(np.linalg.det(matrix) < 0):
        raise PoseError("pose: the matrix is a reflection, its determinant is -1")
    return matrix, position
