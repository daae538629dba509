"""Real arms: link lengths, constants, joints and limits, one TOML file each.

    name = "..."            what it is called
    source = "..."          where the figures come from
    mm_per_unit = 10.0      millimetres in one coordinate unit of the cores
    [links]                 mm, between the joint axes
    l1 = 325.0
    l2 = 275.0
    l3 = 50.0               optional: from the third parallel axis of a planar arm to its tip (the 3R cores)
    [constants]             all optional, mm; rtl/arm has cores with these inside, around others a driver adds them
    base = 0.0              height of the shoulder axis
    shoulder = 0.0          radial offset of the shoulder axis from the yaw axis
    lateral = 0.0           offset of the arm's plane from the yaw axis, positive to the left of the arm
    elbow = 0.0             offset e across link 2, positive to its left: L2 = hypot(l2, e), turned by atan2(e, l2)
    absolute_elbow = false  the machine measures joint 2 from the horizontal (parallelogram), not from link 1
    [wrist]                 optional: what the forearm carries, of these kinds one:
    spherical = true        three axes that meet in one point, the first along the forearm
    parallel = true         the first axis parallel to the elbow's, the others at right angles to the one before
    offset = 99.7           mm, of a parallel wrist: from its first axis to its third, d5 of the maker's table
    flange = 80.0           mm, to the flange: from that point, or of a parallel wrist from its second axis, d6
    [limits]                degrees, in the sense of the cores: joint 1 from the horizontal (or the x axis of a
    shoulder = [-105, 105]  SCARA), joint 2 from link 1 to the line of L2, counter-clockwise
    elbow = [-150, 150]
    yaw = [-180, 180]       left out for a SCARA, whose two links move in the horizontal plane
    forearm = [-100, 0]     optional, of an absolute elbow alone: the forearm from the horizontal
    upper = [-170, 170]     optional: the arm has seven axes, of which the third turns the upper arm about itself
    [singular]              optional: where the velocity cores limit the rates; axis is the margin of rtl/ur
    elbow = 5.0             degrees from the stretched and the folded arm
    axis = 20.0             mm from the yaw axis; a SCARA has none
    [joints]                optional: the machine's own joints
    shoulder = { name = "A2", sign = -1, zero = 0, limits = [-190, 45], speed = 300 }

A joint of the machine is sign * (its own angle) + zero, in degrees, as seen by the cores: `yaw` from the x axis,
counter-clockwise from above; `shoulder` from the horizontal upwards; `elbow` from link 1 to the forearm itself, without
the turn of the elbow's offset (of an absolute elbow: from the horizontal); `tool` of the link l3, from link 2; `j4`,
`j5`, `j6` of a wrist as rtl/six or, where it is parallel, rtl/ur has them; of seven axes `upper`, and `j5`, `j6`, `j7`
of the wrist, as rtl/srs has them. Without the table the machine's joints are the cores' own.

`limits` of a joint, as the machine counts it, up to 3.5 turns either way, and `speed`, degrees a second, are optional.
six_keep and ur_keep have them; without them a joint has that of the table [limits], or of the wrist half a turn either
way, and all weigh the same.

    [frames]                optional: where the robot has the arm; no core computes it
    base = { link = "world", xyz = [0, 0, 410], rpy = [0, 0, 90] }  the cores' frame seen from that link
    tip = { link = "tool0", xyz = [0, 0, 5], rpy = [0, 90, 0] }     that link seen from the cores' frame at the tip
    beside = [{ name = "quill", moves = "along", sign = -1, zero = 0, limits = [0, 150] }]

`xyz` is in mm, `rpy` turns about the other frame's x, y and z, one after the other, in degrees. A joint `beside` the
arm moves the tip along z (mm) or turns it about z (degrees), behind the other joints in their order. A tool that is
changed is a tip frame that is changed.
"""

from __future__ import annotations

import math
import stat
import tomllib
from dataclasses import dataclass
from pathlib import Path

from quadrance.arms.error import ArmError

HERE = Path(__file__).resolve().parent
REACH = 128 - 2**-8  # units: the largest coordinate of Q7.8
MOST = 1e9  # mm: no length is beyond it
MOST_TURN = 1260  # degrees: no limit of a machine's joint is beyond it
TOP = ("name", "source", "mm_per_unit", "links", "constants", "wrist", "limits", "singular", "joints", "frames")
WRIST = ("j4", "j5", "j6")
WRIST_OF_SEVEN = ("j5", "j6", "j7")


SEVEN = "limits.upper: is given, and this core has no joint that turns the upper arm"


@dataclass(frozen=True)
class Joint:
    """A joint of the machine: sign * (its own angle) + zero is what the cores have, degrees.

    limits, speed : as the machine counts them, degrees and degrees a second; None where the file does not say it.
    """

    key: str
    name: str
    sign: int = 1
    zero: float = 0.0
    limits: tuple[float, float] | None = None
    speed: float | None = None


@dataclass(frozen=True)
class Frame:
    """A frame seen from another: place in mm; turns in degrees about the other's x, y and z, one after the other.

    link : of the robot, the one of the two that is not the cores'.
    """

    link: str
    xyz: tuple[float, ...] = (0.0, 0.0, 0.0)
    rpy: tuple[float, ...] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Beside:
    """A joint behind the arm that no core computes: it moves the tip along z, mm, or turns it about z, degrees."""

    name: str
    slides: bool
    sign: int
    zero: float
    limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class Arm:
    """One arm. Lengths in millimetres, limits in degrees; `l1`, `l2` are what the cores see.

    limits : of shoulder, elbow and, but of a SCARA, yaw. forearm_limit : of an absolute elbow, from the horizontal.
    upper_limit : of the turn of the upper arm about itself, of an arm with seven axes.
    l3, flange, spherical, singular : None where the file does not say it; `flange` is that of a spherical wrist.
    d5, d6 : offset and flange of a parallel wrist; None for any other.
    base_frame, tip_frame : None where the robot's frame is the cores'.
    """

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
    forearm_limit: tuple[float, float] | None = None
    upper_limit: tuple[float, float] | None = None
    l3: float | None = None
    spherical: bool | None = None
    flange: float | None = None
    d5: float | None = None
    d6: float | None = None
    singular: tuple[float | None, float | None] = (None, None)
    joints: tuple[Joint, ...] = ()
    base_frame: Frame | None = None
    tip_frame: Frame | None = None
    beside: tuple[Beside, ...] = ()

    @property
    def links(self) -> tuple[float, float]:
        """(L1, L2) in coordinate units."""
        return self.l1 / self.mm_per_unit, self.l2 / self.mm_per_unit

    @property
    def forearm(self) -> float:
        """Link 2 as the file has it, along the forearm."""
        return math.sqrt(self.l2 * self.l2 - self.elbow * self.elbow)

    @property
    def yaws(self) -> bool:
        """Whether the arm's plane is upright and yaws; False for a SCARA."""
        return len(self.limits) > 2

    @property
    def axes(self) -> int:
        """Joints that the cores serve: two of a SCARA, three, six with a wrist, or seven."""
        return 7 if self.upper_limit else 6 if self.flange is not None or self.d6 is not None else len(self.limits)

    @property
    def six(self) -> dict[str, float]:
        """The seven parameters of rtl/six, mm.

        Raises
        ------
        ArmError
            For an arm that has no spherical wrist.
        """
        if self.upper_limit:
            raise ArmError(f"{self.id}: {SEVEN}")
        if self.flange is None:
            raise ArmError(f"{self.id}: " + (
                "wrist: is missing, and six axes want a spherical one" if self.spherical is None else
                "wrist.parallel: is true, and this core wants a spherical wrist" if self.d6 is not None else
                "wrist.spherical: is false, and six axes want a spherical wrist; cores of three joints place it alone"))
        return {"a1": self.shoulder, "a2": -self.elbow, "b": self.lateral, "c1": self.base, "c2": self.l1,
                "c3": self.forearm, "c4": self.flange}

    @property
    def ur(self) -> dict[str, float]:
        """The six lengths of rtl/ur, mm.

        Raises
        ------
        ArmError
            For an arm whose first wrist axis is not parallel to the elbow's.
        """
        if self.d5 is None or self.d6 is None:
            said = "is missing" if self.spherical is None else f"spherical is {str(self.spherical).lower()}"
            raise ArmError(f"{self.id}: wrist: {said}, and this core wants parallel = true")
        return {"d1": self.base, "d4": self.lateral, "d5": self.d5, "d6": self.d6, "l2": self.l1, "l3": self.l2}

    @property
    def srs(self) -> dict[str, float]:
        """The four lengths of rtl/srs, mm.

        Raises
        ------
        ArmError
            For an arm that has not seven axes.
        """
        if not self.upper_limit:
            raise ArmError(f"{self.id}: limits.upper: is missing, and this core wants seven axes")
        return {"d": self.base, "l1": self.l1, "l2": self.l2, "l4": self.flange}

    def joint(self, key: str) -> Joint:
        """A joint of the machine; where the file has none, the core's own by the name of its key."""
        return next((one for one in self.joints if one.key == key), Joint(key, key.replace("j", "axis")))


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
    return parse(path, read(path))


def read(path: Path, most: int = 1 << 20) -> bytes:
    """A file that others may have written: ArmError for what is no file or has more than `most` bytes."""
    try:
        if not (stat.S_ISREG(mode := path.stat().st_mode) or stat.S_ISDIR(mode)):
            raise ArmError(f"{path}: cannot be read: Not a file")
        with path.open("rb") as file:
            text = file.read(most + 1)
    except OSError as error:
        raise ArmError(f"{path}: cannot be read: {error.strerror}") from None
    if len(text) > most:
        raise ArmError(f"{path}: it has more than {most >> 20} MiB")
    return text


def toml(path: Path, text: bytes) -> dict:
    """What a TOML file says; ArmError where it is none, or one that nests or counts without bounds."""
    def bounded(value: object) -> bool:
        if isinstance(value, (dict, list)):
            return all(map(bounded, value.values() if isinstance(value, dict) else value))
        return not isinstance(value, int) or -1 << 63 <= value < 1 << 63

    try:
        data = tomllib.loads(text.decode())
        if bounded(data):
            return data
        reason: object = "an integer has more than 64 bits"
    except ValueError as error:
        reason = error
    except RecursionError:
        reason = "it is nested too deeply"
    raise ArmError(f"{path}: not TOML: {reason}")


def parse(path: Path, text: bytes) -> Arm:
    """The arm of the text of a file."""
    data = toml(path, text)

    def fail(key: str, reason: str):
        raise ArmError(f"{path}: {key if key.isprintable() else ascii(key)}: {reason}")

    def take(table: dict, prefix: str, key: str, kind: type, default: object = None):
        if key not in table:
            if default is None:
                fail(prefix + key, "is missing")
            return default
        value = table[key]
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if not isinstance(value, kind):
            wanted = {float: "a number", str: "a string", bool: "true or false", dict: "a table", list: "a list",
                      int: "1 or -1"}
            fail(prefix + key, f"must be {wanted[kind]}, not {value!r}")
        if kind is float and not abs(value) <= MOST:
            fail(prefix + key, f"must be finite, not {value}" if not math.isfinite(value) else
                 f"must lie within -{MOST:g} and {MOST:g}, not {value:g}")
        if kind is str and not value.isprintable():
            fail(prefix + key, f"must be one line of text, not {value!a}")
        return value

    def only(table: dict, prefix: str, keys: set[str]):
        for key in sorted(set(table) - keys):
            fail(prefix + key, f"is not a key of an arm file; known here: {', '.join(sorted(keys))}")

    def length(table: dict, prefix: str, key: str) -> float:
        value = take(table, prefix, key, float)
        if value <= 0:
            fail(prefix + key, f"must be positive, not {value:g}")
        return value

    def room(table: dict, prefix: str, key: str, most: float, unit: str = "degrees") -> tuple[float, float]:
        pair = take(table, prefix, key, list)
        if len(pair) != 2 or not all(type(one) in (int, float) and math.isfinite(one) for one in pair):
            fail(prefix + key, f"must be two numbers [low, high] in {unit}, not {pair!r}")
        low, high = map(float, pair)
        if low >= high:
            fail(prefix + key, f"the lower limit {low:g} must be below the upper limit {high:g}")
        if low < -most or high > most:
            fail(prefix + key, f"must lie within -{most:g} and {most:g} {unit}, not {pair!r}")
        return low, high

    def limit(key: str) -> tuple[float, float]:
        return room(limits, "limits.", key, 360)

    def counted(table: dict, prefix: str, most: float = 360) -> tuple[str, int, float]:
        """Name, sign and zero of a joint."""
        given, sign, zero = take(table, prefix, "name", str), take(table, prefix, "sign", int), take(
            table, prefix, "zero", float)
        if not given.strip():
            fail(prefix + "name", "must not be empty")
        if type(sign) is not int or abs(sign) != 1:
            fail(prefix + "sign", f"must be 1 or -1, not {sign!r}")
        if abs(zero) > most:
            fail(prefix + "zero", f"must lie within -{most:g} and {most:g} degrees, not {zero:g}")
        return given, sign, zero

    def joint(key: str) -> Joint:
        table = take(joints, "joints.", key, dict)
        only(table, f"joints.{key}.", {"name", "sign", "zero", "limits", "speed"})
        given, sign, zero = counted(table, f"joints.{key}.")
        ends = room(table, f"joints.{key}.", "limits", MOST_TURN) if "limits" in table else None
        speed = length(table, f"joints.{key}.", "speed") if "speed" in table else None
        return Joint(key, given, sign, zero, ends, speed)

    def frame(key: str) -> Frame:
        table, prefix = take(frames, "frames.", key, dict), f"frames.{key}."
        only(table, prefix, {"link", "xyz", "rpy"})
        link = take(table, prefix, "link", str)
        if not link.strip():
            fail(prefix + "link", "must not be empty")
        found = {part: take(table, prefix, part, list, [0.0, 0.0, 0.0]) for part in ("xyz", "rpy")}
        for part, three in found.items():
            if len(three) != 3 or not all(type(one) in (int, float) and abs(one) <= MOST for one in three):
                fail(prefix + part, f"must be three numbers of at most {MOST:g}, not {three!r}")
        return Frame(link, *(tuple(map(float, three)) for three in found.values()))

    def beside(i: int, table: object) -> Beside:
        prefix = f"frames.beside[{i}]."
        if not isinstance(table, dict):
            fail(prefix[:-1], f"must be a table, not {table!r}")
        only(table, prefix, {"name", "moves", "sign", "zero", "limits"})
        if (moves := take(table, prefix, "moves", str)) not in ("along", "about"):
            fail(prefix + "moves", f"must be \"along\" or \"about\", of z, not {moves!r}")
        unit = "mm" if moves == "along" else "degrees"
        ends = room(table, prefix, "limits", MOST, unit) if "limits" in table else None
        given, sign, zero = counted(table, prefix, MOST)
        return Beside(given, moves == "along", sign, zero, ends)

    only(data, "", set(TOP))
    name, source = take(data, "", "name", str), take(data, "", "source", str)
    unit = length(data, "", "mm_per_unit")
    links, limits = take(data, "", "links", dict), take(data, "", "limits", dict)
    constants, wrist, singular, joints, frames = (take(data, "", key, dict, {}) for key in (
        "constants", "wrist", "singular", "joints", "frames"))
    only(links, "links.", {"l1", "l2", "l3"})
    only(constants, "constants.", {"base", "shoulder", "lateral", "elbow", "absolute_elbow"})
    only(wrist, "wrist.", {"spherical", "parallel", "offset", "flange"})
    only(limits, "limits.", {"shoulder", "elbow", "yaw", "forearm", "upper"})
    only(singular, "singular.", {"elbow", "axis"})
    only(frames, "frames.", {"base", "tip", "beside"})
    l1, forearm = length(links, "links.", "l1"), length(links, "links.", "l2")
    l3 = length(links, "links.", "l3") if "l3" in links else None
    offset = {key: take(constants, "constants.", key, float, 0.0) for key in ("base", "shoulder", "lateral", "elbow")}
    absolute = take(constants, "constants.", "absolute_elbow", bool, False)
    l2 = math.hypot(forearm, offset["elbow"])
    if (l1 + l2) / unit > REACH:
        fail("links", f"the reach of {l1 + l2:g} mm is {(l1 + l2) / unit:g} units and Q7.8 ends at {REACH:g}; "
             f"raise mm_per_unit above {(l1 + l2) / REACH:.4g}")
    if min(l1, l2) / unit < 2**-8:
        fail("links", f"a link of {min(l1, l2):g} mm is less than one LSB of Q7.8; lower mm_per_unit")
    parallel = take(wrist, "wrist.", "parallel", bool, False)
    if parallel and wrist.get("spherical"):
        fail("wrist.parallel", "is true, and so is spherical: a wrist is one of them")
    if "offset" in wrist and not parallel:
        fail("wrist.offset", "is of a parallel wrist, and parallel is not true")
    if parallel:
        for key in ("constants.shoulder", "constants.elbow", "constants.absolute_elbow"):
            if constants.get(key.partition(".")[2]):
                fail(key, "is not 0, and an arm with a parallel wrist has none")
    d5, d6 = (take(wrist, "wrist.", key, float) if parallel else None for key in ("offset", "flange"))
    spherical = take(wrist, "wrist.", "spherical", bool, not parallel) if wrist else None
    if spherical is False and not parallel and "flange" in wrist:
        fail("wrist.flange", "is of a spherical wrist, and spherical is false")
    flange = take(wrist, "wrist.", "flange", float) if spherical else None
    if flange is not None and flange < 0:
        fail("wrist.flange", f"must not be negative, not {flange:g}")
    if "upper" in limits:
        if flange is None:
            fail("limits.upper", "is of an arm with seven axes, and these have wrist.spherical = true")
        for key in ("shoulder", "lateral", "elbow", "absolute_elbow"):
            if constants.get(key):
                fail(f"constants.{key}", "is not 0, and an arm with seven axes has none")
    if "forearm" in limits and not absolute:
        fail("limits.forearm", "is of an absolute elbow, and constants.absolute_elbow is not true")
    if (spherical or parallel) and "yaw" not in limits:
        fail("limits.yaw", "is missing: an arm with a wrist yaws")
    rooms = tuple(limit(key) for key in ("shoulder", "elbow", *(["yaw"] if "yaw" in limits else [])))
    if "elbow" in singular and not 0 < take(singular, "singular.", "elbow", float) < 90:
        fail("singular.elbow", f"must lie between 0 and 90 degrees, not {singular['elbow']:g}")
    near = (float(singular["elbow"]) if "elbow" in singular else None,
            length(singular, "singular.", "axis") if "axis" in singular else None)
    wanted = [*["yaw"] * ("yaw" in limits), "shoulder", *["upper"] * ("upper" in limits), "elbow",
              *["tool"] * (l3 is not None)]
    if flange is not None or parallel:
        wanted += WRIST_OF_SEVEN if "upper" in limits else WRIST
    only(joints, "joints.", set(wanted))
    machine = tuple(joint(key) for key in wanted) if joints else ()
    for i, one in enumerate(machine):
        if one.name in [other.name for other in machine[:i]]:
            fail(f"joints.{one.key}.name", f"'{one.name}' is the name of another joint")
    return Arm(id=path.stem, name=name, source=source, mm_per_unit=unit, l1=l1, l2=l2, **offset,
               elbow_angle=math.degrees(math.atan2(offset["elbow"], forearm)), absolute_elbow=absolute, limits=rooms,
               forearm_limit=limit("forearm") if "forearm" in limits else None,
               upper_limit=limit("upper") if "upper" in limits else None, l3=l3, spherical=spherical,
               flange=flange, d5=d5, d6=d6, singular=near, joints=machine,
               base_frame=frame("base") if "base" in frames else None,
               tip_frame=frame("tip") if "tip" in frames else None,
               beside=tuple(beside(i, one) for i, one in enumerate(take(frames, "frames.", "beside", list, []))))
