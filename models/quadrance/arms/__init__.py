"""Real arms: link lengths, constants and joint limits, one TOML file each.

    name = "..."            what it is called
    source = "..."          where the figures come from
    mm_per_unit = 10.0      millimetres in one coordinate unit of the cores
    [links]                 mm, between the joint axes
    l1 = 325.0
    l2 = 275.0
    [constants]             all optional: what a driver adds around the cores, mm
    base = 0.0              height of the shoulder axis: subtract from z
    shoulder = 0.0          radial offset of the shoulder: subtract from the radius
    lateral = 0.0           offset b of the arm's plane: r' = sqrt(r^2 - b^2), yaw -= atan2(b, r')
    elbow = 0.0             offset across link 2: L2 = hypot(l2, elbow), joint 2 turned by atan2(elbow, l2)
    absolute_elbow = false  the machine measures joint 2 from the base (parallelogram): subtract joint 1
    [limits]                degrees, in the sense of the cores: joint 1 from the horizontal (or the x axis of a
    shoulder = [-105, 105]  SCARA), joint 2 from link 1 to the line of L2, counter-clockwise
    elbow = [-150, 150]
    yaw = [-180, 180]       left out for a SCARA, whose two links move in the horizontal plane
"""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
REACH = 128 - 2**-8  # units: the largest coordinate of Q7.8
TOP = {"name": str, "source": str, "mm_per_unit": float, "links": dict, "constants": dict, "limits": dict}


class ArmError(ValueError):
    """An arm file that cannot be used: names the file, the key and the reason."""


@dataclass(frozen=True)
class Arm:
    """One arm. Lengths in millimetres, limits in degrees; `l1`, `l2` are what the cores see."""

    id: str
    name: str
    source: str
    mm_per_unit: float
    l1: float
    l2: float
    base: float
    shoulder: float
    lateral: float
    elbow: float
    elbow_angle: float
    absolute_elbow: bool
    limits: tuple[tuple[float, float], ...]

    @property
    def links(self) -> tuple[float, float]:
        """(L1, L2) in coordinate units."""
        return self.l1 / self.mm_per_unit, self.l2 / self.mm_per_unit


def known() -> list[str]:
    """Names of the arms that come with the library."""
    return sorted(path.stem for path in HERE.glob("*.toml"))


def path_of(name_or_path: str | Path) -> Path:
    """The file of a known arm, or the path itself when it looks like one."""
    path = Path(name_or_path)
    if path.suffix != ".toml" and len(path.parts) == 1:
        if path.name not in known():
            raise ArmError(f"no arm '{name_or_path}': known arms are {', '.join(known())}; "
                           "or give the path of a .toml file")
        return HERE / f"{path.name}.toml"
    return path


def load(name_or_path: str | Path) -> Arm:
    """The arm of that name (a file of this folder) or of that TOML file.

    Raises
    ------
    ArmError
        Naming the file, the key and the reason.
    """
    path = path_of(name_or_path)
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ArmError(f"{path}: cannot be read: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ArmError(f"{path}: not TOML: {error}") from None
    return _arm(path, data)


def _arm(path: Path, data: dict) -> Arm:
    def fail(key: str, reason: str):
        raise ArmError(f"{path}: {key}: {reason}")

    def take(table: dict, prefix: str, key: str, kind: type, default: object = None):
        if key not in table:
            if default is None:
                fail(prefix + key, "is missing")
            return default
        value = table[key]
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if not isinstance(value, kind):
            wanted = {float: "a number", str: "a string", bool: "true or false", dict: "a table", list: "a list"}
            fail(prefix + key, f"must be {wanted[kind]}, not {value!r}")
        if kind is float and not math.isfinite(value):
            fail(prefix + key, f"must be finite, not {value}")
        return value

    def only(table: dict, prefix: str, keys: set[str]):
        for key in sorted(set(table) - keys):
            fail(prefix + key, f"is not a key of an arm file; known here: {', '.join(sorted(keys))}")

    def length(table: dict, prefix: str, key: str) -> float:
        value = take(table, prefix, key, float)
        if value <= 0:
            fail(prefix + key, f"must be positive, not {value:g}")
        return value

    def limit(key: str) -> tuple[float, float]:
        pair = take(limits, "limits.", key, list)
        if len(pair) != 2 or not all(type(one) in (int, float) and math.isfinite(one) for one in pair):
            fail(f"limits.{key}", f"must be two numbers [low, high] in degrees, not {pair!r}")
        low, high = map(float, pair)
        if low >= high:
            fail(f"limits.{key}", f"the lower limit {low:g} must be below the upper limit {high:g}")
        if low < -360 or high > 360:
            fail(f"limits.{key}", f"must lie within -360 and 360 degrees, not {pair!r}")
        return low, high

    only(data, "", set(TOP))
    name, source = take(data, "", "name", str), take(data, "", "source", str)
    unit = length(data, "", "mm_per_unit")
    links, limits = take(data, "", "links", dict), take(data, "", "limits", dict)
    constants = take(data, "", "constants", dict, {})
    only(links, "links.", {"l1", "l2"})
    only(constants, "constants.", {"base", "shoulder", "lateral", "elbow", "absolute_elbow"})
    only(limits, "limits.", {"shoulder", "elbow", "yaw"})
    l1, forearm = length(links, "links.", "l1"), length(links, "links.", "l2")
    offset = {key: take(constants, "constants.", key, float, 0.0) for key in ("base", "shoulder", "lateral", "elbow")}
    l2 = math.hypot(forearm, offset["elbow"])
    if (l1 + l2) / unit > REACH:
        fail("links", f"the reach of {l1 + l2:g} mm is {(l1 + l2) / unit:g} units and Q7.8 ends at {REACH:g}; "
             f"raise mm_per_unit above {(l1 + l2) / REACH:.4g}")
    if min(l1, l2) / unit < 2**-8:
        fail("links", f"a link of {min(l1, l2):g} mm is less than one LSB of Q7.8; lower mm_per_unit")
    return Arm(id=path.stem, name=name, source=source, mm_per_unit=unit, l1=l1, l2=l2, **offset,
               elbow_angle=math.degrees(math.atan2(offset["elbow"], forearm)),
               absolute_elbow=take(constants, "constants.", "absolute_elbow", bool, False),
               limits=tuple(limit(key) for key in ("shoulder", "elbow", *(["yaw"] if "yaw" in limits else []))))
