"""This module makes an arm file of a chain of joints. It judges the chain by its axes, never by names.

`KINDS` is the table of what a chain can be.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from quadrance import arms, truth, truth_arm, truth_six, truth_srs, truth_ur
from quadrance.arms import Arm
from quadrance.cli import check, frames, urdf
from quadrance.cli.catalogue import Refused
from quadrance.cli.urdf import Chain
from quadrance.truth import Floats

ANGLE, GAP = 1e-3, 1.0  # rad, mm: a chain that is no farther from a kind is called by the kind's name
MM, RAD, SAMPLES = 0.005, 5e-7, 500  # half of the promised 0.01 mm and 1e-6 rad, checked at this many joint vectors


class Axis(NamedTuple):
    """A joint's axis at zero, seen from the base."""

    slides: bool
    point: Floats
    way: Floats


class Part(NamedTuple):
    """What a joint of the chain is to the cores: sign * (its own angle) + zero, radians; `slide` in mm."""

    key: str
    joint: int
    sign: int
    zero: float


class Built(NamedTuple):
    """An arm file's tables, the joints, and the cores' frame seen from the base."""

    tables: dict[str, dict[str, float]]
    parts: list[Part]
    base: Floats


class Kind(NamedTuple):
    """A row of `KINDS`.

    letters : the chains, a letter for each joint: R turns, P slides.
    rules : what must hold between the axes.
    build : makes the tables of the arm file.
    pose : where the cores put the tip.
    """

    name: str
    letters: tuple[str, ...]
    rules: tuple[tuple, ...]
    build: Callable[[list[Axis], Floats], Built]
    pose: Callable[[Arm, dict[str, Floats]], Floats]


def _broken(rule: tuple, axes: list[Axis]) -> tuple[float, str]:
    """By how much a rule is broken, as a multiple of `ANGLE` or `GAP`, and in words."""
    what, *numbers = rule
    some = [axes[i - 1] for i in numbers]
    named = f"axes {', '.join(map(str, numbers[:-1]))} and {numbers[-1]}"
    if what == "meet" and len(some) == 2:
        gap = _gap(*some)
        return gap / GAP, f"{named} miss each other by {gap:.4g} mm"
    if what == "meet":
        feet = [_meeting(some[i:i + 2]) for i in (0, 1)]  # half-way where two axes do not meet
        gap = max(*(2 * float(np.linalg.norm(np.cross(axis.way, foot - axis.point))) for axis, foot in zip(some, feet)),
                  float(np.linalg.norm(feet[1] - feet[0])))
        return gap / GAP, f"{named} miss a common point by {gap:.4g} mm"
    (_, _, u), (_, _, v) = some
    angle = math.atan2(np.linalg.norm(np.cross(u, v)), abs(u @ v))
    angle = angle if what == "parallel" else math.pi / 2 - angle
    return angle / ANGLE, f"{named} are {math.degrees(angle):.4g} degrees from {what}"


def _gap(one: Axis, two: Axis) -> float:
    """The distance of two lines that are not parallel."""
    across, between = np.cross(one.way, two.way), two.point - one.point
    return float(abs(between @ across) / max(np.linalg.norm(across), 1e-12))


def _meeting(axes: list[Axis]) -> Floats:
    """The point nearest to some axes."""
    across = [np.eye(3) - np.outer(axis.way, axis.way) for axis in axes]
    return np.linalg.lstsq(sum(across), sum(part @ axis.point for part, axis in zip(across, axes)), rcond=1e-9)[0]


def _up(way: Floats) -> Floats:
    """An axis in the sense that looks up, its own where it is level."""
    return -way if way[2] < -1e-9 else way


def _sign(number: float) -> int:
    return -1 if number < 0 else 1


def _frame(o: Floats, x: Floats, y: Floats, z: Floats) -> tuple[Floats, float]:
    """The cores' frame, and the yaw that is left to joint 1: all of it where z is the base's own."""
    upright, found = np.hypot(z[0], z[1]) < 1e-9 and z[2] > 0, np.eye(4)
    found[:3, 3] = o
    if not upright:
        found[:3, :3] = np.stack([x, y, z], axis=1)
    return found, math.atan2(x[1], x[0]) if upright else 0.0


# Planar arms and SCARAs: the axes' feet in the plane are complex numbers


def _planar(axes: list[Axis], tip: Floats) -> Built:
    turning = [i for i, axis in enumerate(axes) if not axis.slides]
    first = axes[turning[0]]
    z = _up(first.way)
    x = np.eye(3)[0 if abs(z[0]) < 0.9 else 1]
    x = (x - (x @ z) * z) / np.linalg.norm(x - (x @ z) * z)
    y, o = np.cross(z, x), first.point + ((tip[:3, 3] - first.point) @ z) * z
    base, yaw = _frame(o, x, y, z)
    feet = [complex(x @ (point - o), y @ (point - o)) for point in (*(axes[i].point for i in turning), tip[:3, 3])]
    links = [end - start for start, end in zip(feet, feet[1:])]
    lengths = {f"l{i}": abs(link) for i, link in enumerate(links, 1)}
    if lengths.get("l3", 1.0) < 1e-3:  # the tip is on axis 3, which turns it alone
        del lengths["l3"]
        links[2] = complex(x @ tip[:3, 0], y @ tip[:3, 0]) if abs(z @ tip[:3, 2]) > 0.5 else links[1]
    ways = [math.atan2(link.imag, link.real) for link in links]
    zeros = [end - start for start, end in zip([-yaw, *ways], ways)]
    parts = [Part(key, i, _sign(z @ axes[i].way), zero) for key, i, zero in
             zip(("shoulder", "elbow", "tool"), turning, zeros)]
    parts += [Part("slide", i, _sign(z @ axis.way), 0.0) for i, axis in enumerate(axes) if axis.slides]
    return Built({"links": lengths}, parts, base)


def _planar_pose(arm: Arm, q: dict[str, Floats]) -> Floats:
    turn = q["shoulder"] + q["elbow"] + q.get("tool", 0)
    x, y = truth.fk2(q["shoulder"], q["elbow"], arm.l1, arm.l2)
    more_x, more_y = truth.fk1(turn, arm.l3 or 0.0)
    return _poses(_about("z", turn), x + more_x, y + more_y, q.get("slide", 0 * x))


def _poses(rotation: Floats, x: Floats, y: Floats, z: Floats) -> Floats:
    found = np.tile(np.eye(4), (len(x), 1, 1))
    found[:, :3, :3], found[:, :3, 3] = rotation, np.stack([x, y, z], axis=-1)
    return found


def _about(axis: str, angle: Floats) -> Floats:
    found, (i, j) = np.tile(np.eye(3), (len(angle), 1, 1)), (0, 1) if axis == "z" else (2, 0)
    found[:, i, i] = found[:, j, j] = np.cos(angle)
    found[:, j, i] = np.sin(angle)
    found[:, i, j] = -np.sin(angle)
    return found


# A yaw and two links upright, with a wrist or without


def _upright(axes: list[Axis], target: Floats, way: Floats | None = None) -> tuple[Built, Floats]:
    """Tables and joints of the first three axes, and axis 2 in the sense of y.

    way : of the forearm, which ends at the target's foot on it; None is the way to the target.
    """
    z = _up(axes[0].way)
    o = axes[0].point - (axes[0].point @ z) * z
    y = axes[1].way - (axes[1].way @ z) * z
    y = y / np.linalg.norm(y)
    ahead = np.cross(y, z) @ (axes[1].point - o)
    ahead = ahead if abs(ahead) > 1e-3 else 0.0
    if (ahead or np.cross(y, z) @ (target - o)) < -1e-6:  # the shoulder is in front
        y = -y
    x = np.cross(y, z)
    two, three, end = (np.stack([x, y, z]) @ (point - o) for point in (axes[1].point, axes[2].point, target))
    upper, fore = (complex(*(b - a)[[0, 2]]) for a, b in ((two, three), (three, end)))
    along = fore if way is None else complex(x @ way, z @ way)
    base, yaw = _frame(o, x, y, z)
    one, both = (math.atan2(link.imag, link.real) for link in (upper, along))
    fore *= complex(math.cos(both), -math.sin(both))
    parts = [Part(key, i, _sign(positive @ axes[i].way), zero) for i, (key, positive, zero) in
             enumerate((("yaw", z, yaw), ("shoulder", -y, one), ("elbow", -y, both - one)))]
    return Built({"links": {"l1": abs(upper), "l2": fore.real}, "constants": {
        "base": two[2], "shoulder": abs(ahead), "lateral": end[1], "elbow": fore.imag}}, parts, base), y


def _three(axes: list[Axis], tip: Floats) -> Built:
    return _upright(axes, tip[:3, 3])[0]


def _three_pose(arm: Arm, q: dict[str, Floats]) -> Floats:
    held = truth_arm.Frame(arm.base, arm.shoulder, arm.lateral)
    place = truth_arm.fk3(q["shoulder"], q["elbow"], q["yaw"], arm.l1, arm.l2, held)
    return _poses(_about("z", q["yaw"]) @ _about("y", -q["shoulder"] - q["elbow"]), *place)


def _six(axes: list[Axis], tip: Floats) -> Built:
    """As in Brandstoetter, Angerer, Hofbaur: d4 is the way of the forearm, y4 of axis 5, d6 to the tip."""
    centre = _meeting(axes[3:])
    d4 = axes[3].way * _sign((centre - axes[2].point) @ axes[3].way)
    built, y = _upright(axes, centre, d4)
    reach = (tip[:3, 3] - centre) @ axes[5].way
    d6 = axes[5].way * _sign(reach if abs(reach) > 1e-3 else tip[:3, 2] @ axes[5].way)
    x3, y4 = np.cross(y, d4), axes[4].way
    y4 = y4 * _sign(y4 @ y if abs(y4 @ y) > 1e-6 else -y4 @ x3)
    x5 = np.cross(y4, d6)
    zeros = (math.atan2(-(y4 @ x3), y4 @ y), math.atan2(np.cross(d4, d6) @ y4, d4 @ d6),
             math.atan2(tip[:3, 0] @ y4, tip[:3, 0] @ x5) if tip[:3, 2] @ d6 > 0.5 else 0.0)
    built.parts.extend(Part(key, i, _sign(way @ axes[i].way), zero) for key, i, way, zero in
                       zip(arms.WRIST, (3, 4, 5), (d4, y4, d6), zeros))
    return built._replace(tables=built.tables | {"wrist": {"flange": (tip[:3, 3] - centre) @ d6}})


def _ur(axes: list[Axis], tip: Floats) -> Built:
    """As in the makers' tables: axis 4 looks to the left like axes 2 and 3, z4 is the way of axis 5, z5 of axis 6."""
    above, centre = _meeting(axes[3:5]), _meeting(axes[4:])  # the ends of d5, on axes 4 and 6
    built, y = _upright(axes, above)
    z4 = axes[4].way * _sign((centre - above) @ axes[4].way)
    reach = (tip[:3, 3] - centre) @ axes[5].way
    z5 = axes[5].way * _sign(reach if abs(reach) > 1e-3 else tip[:3, 2] @ axes[5].way)
    z = _up(axes[0].way)
    x5, links = np.cross(z5, z4), sum(part.zero for part in built.parts[1:])
    zeros = (math.atan2(-(z4 @ np.cross(y, z)), -(z4 @ z)) + links, math.atan2(np.cross(y, z5) @ z4, y @ z5),
             math.atan2(-(tip[:3, 0] @ z4), tip[:3, 0] @ x5) if tip[:3, 2] @ z5 > 0.5 else 0.0)
    built.parts.extend(Part(key, i, _sign(way @ axes[i].way), zero) for key, i, way, zero in
                       zip(arms.WRIST, (3, 4, 5), (y, z4, z5), zeros))
    constants = {key: built.tables["constants"][key] for key in ("base", "lateral")}
    return built._replace(tables=built.tables | {"constants": constants, "wrist": {
        "parallel": True, "offset": (centre - above) @ z4, "flange": (tip[:3, 3] - centre) @ z5}})


def _ur_pose(arm: Arm, q: dict[str, Floats]) -> Floats:
    joints = [q["yaw"] - np.pi, -q["shoulder"], -q["elbow"], *(q[key] for key in arms.WRIST)]
    rotation, place = truth_ur.fk(np.stack(joints, axis=-1), truth_ur.Ur(**arm.ur))
    return _poses(rotation, *place.T)


def _six_pose(arm: Arm, q: dict[str, Floats]) -> Floats:
    joints = [q["yaw"], np.pi / 2 - q["shoulder"], -q["elbow"], *(q[key] for key in arms.WRIST)]
    rotation, place = truth_six.fk6(np.stack(joints, axis=-1), truth_six.Six(**arm.six))
    return _poses(rotation, *place.T)


def _srs(axes: list[Axis], tip: Floats) -> Built:
    """As in truth_srs: z2, z4 and z6 lead along upper arm, forearm and flange, z3 and z5 are the ways of 4 and 6."""
    elbow, centre = _meeting(axes[2:5]), _meeting(axes[4:])
    built, y = _upright([*axes[:2], axes[2]._replace(point=elbow)], centre)
    z2 = axes[2].way * _sign((elbow - _meeting(axes[:3])) @ axes[2].way)
    z4 = axes[4].way * _sign((centre - elbow) @ axes[4].way)
    reach = (tip[:3, 3] - centre) @ axes[6].way
    z6 = axes[6].way * _sign(reach if abs(reach) > 1e-3 else tip[:3, 2] @ axes[6].way)
    z3, z5 = axes[3].way, axes[5].way
    z3 = z3 * _sign(-y @ z3 if abs(y @ z3) > 1e-6 else np.cross(-y, z3) @ z2)
    z5 = z5 * _sign(-z3 @ z5 if abs(z3 @ z5) > 1e-6 else np.cross(-z3, z5) @ z4)

    def turned(one: Floats, other: Floats, about: Floats) -> float:
        return math.atan2(np.cross(one, other) @ about, one @ other)

    zeros = (turned(-y, z3, z2), turned(z2, z4, z3), turned(-z3, z5, z4), turned(z4, z6, z5),
             turned(np.cross(z5, z6), tip[:3, 0], z6) if tip[:3, 2] @ z6 > 0.5 else 0.0)
    parts = built.parts[:2] + [Part(key, i, _sign(way @ axes[i].way), zero) for key, i, way, zero in zip(
        ("upper", "elbow", *arms.WRIST_OF_SEVEN), range(2, 7), (z2, z3, z4, z5, z6), zeros)]
    return Built({"links": {"l1": built.tables["links"]["l1"], "l2": (centre - elbow) @ z4},
                  "constants": {"base": built.tables["constants"]["base"]},
                  "wrist": {"spherical": True, "flange": (tip[:3, 3] - centre) @ z6}}, parts, built.base)


def _srs_pose(arm: Arm, q: dict[str, Floats]) -> Floats:
    joints = [q["yaw"], np.pi / 2 - q["shoulder"], *(q[key] for key in ("upper", "elbow", *arms.WRIST_OF_SEVEN))]
    rotation, place = truth_srs.fk(np.stack(joints, axis=-1), truth_srs.Srs(**arm.srs))
    return _poses(rotation, *place.T)


# Another kind of arm puts its `build` and `pose` here, and nothing else has to change
ALONG = tuple(("parallel", 1, i) for i in (2, 3, 4))
BASE = (("right angles", 1, 2), ("parallel", 2, 3))
KINDS = (
    Kind("a planar arm", ("RR", "RRR"), ALONG, _planar, _planar_pose),
    Kind("a SCARA", ("PRR", "RPR", "RRP", "PRRR", "RPRR", "RRPR", "RRRP"), ALONG, _planar, _planar_pose),
    Kind("a yaw with two links", ("RRR",), BASE, _three, _three_pose),
    Kind("an ortho-parallel arm with a spherical wrist", ("RRRRRR",),
         (*BASE, ("right angles", 3, 4), ("right angles", 4, 5), ("right angles", 5, 6), ("meet", 4, 5, 6)),
         _six, _six_pose),
    Kind("an arm with three parallel axes", ("RRRRRR",),
         (*BASE, ("parallel", 3, 4), ("right angles", 4, 5), ("right angles", 5, 6), ("meet", 1, 2), ("meet", 4, 5),
          ("meet", 5, 6)), _ur, _ur_pose),
    Kind("an S-R-S arm", ("RRRRRRR",),
         (*(("right angles", i, i + 1) for i in range(1, 7)), ("meet", 1, 2, 3), ("meet", 3, 4, 5), ("meet", 5, 6, 7)),
         _srs, _srs_pose))


def classify(chain: Chain) -> tuple[Kind, str, list[Axis]]:
    """The kind of a chain, the rule that it fulfils worst, its axes; Refused where no core has that kind."""
    letters, axes = "".join("P" if joint.slides else "R" for joint in chain.joints), []
    for i, joint in enumerate(chain.joints):
        at = urdf.pose(replace(chain, joints=chain.joints[:i], after=joint.before), np.zeros((1, i)))[0]
        axes.append(Axis(joint.slides, at[:3, 3], at[:3, :3] @ joint.axis))
    near = []
    for kind in (kind for kind in KINDS if letters in kind.letters):
        found = sorted((_broken(rule, axes) for rule in kind.rules if max(rule[1:]) <= len(axes)), reverse=True)
        near.append((sum(size > 1 for size, _ in found), kind, found[0][1]))
    if not near:
        known = ", ".join(dict.fromkeys(one for kind in KINDS for one in kind.letters))
        raise Refused(f"{len(letters)} joints move ({letters[:40]}; R turns, P slides), and cores are for {known}; "
                      "another --base or --tip leaves joints out")
    broken, kind, worst = min(near, key=lambda one: one[0])
    if broken:
        raise Refused(f"it is not {kind.name}: {worst}")
    return kind, worst, axes


def off(one: Floats, other: Floats) -> tuple[float, float]:
    """The largest distance, mm, and angle, rad, between frames (n, 4, 4)."""
    return (float(np.linalg.norm(one[:, :3, 3] - other[:, :3, 3], axis=-1).max()),
            float(truth_six.turned(one[:, :3, :3], other[:, :3, :3]).max()))


def _round(value: float, digits: int) -> float:
    return round(float(value), digits) + 0.0


def _printed(found: Floats) -> tuple[list[float], list[float]]:
    """xyz (mm) and rpy (degrees) of a frame, as they are printed."""
    flat = math.hypot(found[0, 0], found[1, 0])
    roll, yaw = (math.atan2(found[2, 1], found[2, 2]), math.atan2(found[1, 0], found[0, 0])) if flat > 1e-9 else \
        (0.0, math.atan2(-found[0, 1], found[1, 1]))
    rpy = np.degrees([roll, math.atan2(-found[2, 0], flat), yaw])
    return [_round(one, 6) for one in found[:3, 3]], [_round(one, 9) for one in rpy]


def _room(joint: urdf.Moving, part: Part, more: float) -> tuple[list[float], float]:
    """Limits as the cores have them, `more` beside the zero, and the zero, degrees; their middle in half a turn."""
    zero = math.remainder(math.degrees(part.zero), 360)
    if joint.slides or joint.room is None or joint.room[1] - joint.room[0] > 2 * math.pi - 1e-9:
        return [-180.0, 180.0], _round(zero, 9)
    ends = sorted(part.sign * math.degrees(end) + zero + more for end in joint.room)
    turns = 360 * math.ceil((sum(ends) / 2 - 180) / 360)
    return [_round(end - turns, 6) for end in ends], _round(zero - turns if abs(zero - turns) <= 360 else zero, 9)


def arm_file(chain: Chain, source: str) -> dict:
    """The arm file of a chain, and what it says; Refused where no core has such an arm, with reason and distance."""
    try:
        kind, worst, axes = classify(chain)
    except Refused as error:
        raise Refused(f"{source}: {error}") from None
    count, joints = len(axes), chain.joints
    start = urdf.pose(chain, np.zeros((1, count)))[0]
    built = kind.build(axes, start)
    tables = {key: {name: value if value is True else _round(value, 6) for name, value in table.items()
                    if key != "constants" or abs(value) > 1e-6} for key, table in built.tables.items()}
    links = tables["links"]
    turn = math.degrees(math.atan2(tables.get("constants", {}).get("elbow", 0.0), links["l2"]))
    zeros = {}
    tables["limits"] = {}
    for part in built.parts:
        room, zeros[part.key] = _room(joints[part.joint], part, turn if part.key == "elbow" else 0.0)
        if part.key in ("yaw", "shoulder", "elbow", "upper"):
            tables["limits"][part.key] = room
    rest = [part for part in built.parts if part.key == "slide" or part.key == "tool" and "l3" not in links]

    def text(unit: float) -> str:
        lines = [f"name = {_text(chain.name)}", f"source = {_text(source)}", f"mm_per_unit = {unit!r}"]
        for key, table in tables.items():
            lines += ["", f"[{key}]"] * bool(table) + [f"{one} = {str(value).lower()}" for one, value in table.items()]
        return "\n".join([*lines, "", "[joints]", *(
            f"{part.key} = {{ name = {_text(joints[part.joint].name)}, sign = {part.sign}, "
            f"zero = {zeros[part.key]!r}{_own(joints[part.joint])} }}  # {_span(joints[part.joint])}"
            for part in built.parts if part not in rest), ""])

    def arm(unit: float) -> Arm:
        return arms.parse(Path(source), text(unit).encode())

    unit = check.scale(arm(max(sum(map(abs, [*links.values(), *tables.get("constants", {}).values()])), 1e-3) / 100))
    served, base = arm(unit), _printed(built.base)
    held = urdf.frame(base[0], np.radians(base[1]))

    def cores(q: Floats) -> Floats:
        return held @ kind.pose(served, {part.key: part.sign * q[:, part.joint] + math.radians(zeros[part.key])
                                         for part in built.parts})

    tool = _printed(np.linalg.inv(cores(np.zeros((1, count)))[0]) @ start)
    q = np.random.default_rng(0).uniform(-1, 1, (SAMPLES, count)) * [500 if axis.slides else np.pi for axis in axes]
    want = urdf.pose(chain, q)
    mm, rad = off(cores(q) @ urdf.frame(tool[0], np.radians(tool[1])), want)
    if not (mm <= MM and rad <= RAD):
        raise Refused(f"{source}: it is nearly {kind.name}, but not within {2 * MM:g} mm and {2 * RAD:g} rad: the tip "
                      f"would be off by {mm:.3g} mm and {rad:.3g} rad; {worst}")
    notes = [f"{kind.name}: within {mm:.1g} mm and {rad:.1g} rad of its source at {SAMPLES} joint vectors"]
    if chain.written:
        there = off(urdf.pose(chain.written, q), want)
        notes.append(f"rounded: {', '.join(chain.rounded[:8])} stand for multiples of pi/4; as they are written the "
                     "tip is up to {:.2g} mm and {:.2g} rad elsewhere".format(*there))
    placed = [f"{name} = {{ link = {_text(link)}, xyz = {where[0]}, rpy = {where[1]} }}" for name, link, where in (
        ("base", chain.base, base), ("tip", chain.tip, tool)) if any((*where[0], *where[1]))]
    more = [f"    {{ name = {_text(joints[part.joint].name)}, moves = "
            f"\"{'along' if part.key == 'slide' else 'about'}\", sign = {part.sign}, zero = {zeros[part.key]!r}"
            f"{_own(joints[part.joint])} }}," for part in rest]
    placed += ["beside = [", *more, "]"] * bool(more)
    placed = ["", "[frames]", *placed] * bool(placed)
    written = "\n".join([*(f"# {note}" for note in notes), text(unit).rstrip("\n"), *placed, ""])
    arms.parse(Path(source), written.encode())
    return {"kind": kind.name, "base": base, "tip": tool, "off_mm": mm, "off_rad": rad,
            "rest": [(joints[part.joint].name, part.key, part.sign, zeros[part.key]) for part in rest],
            "text": written}


def _text(value: str) -> str:
    return json.dumps(value, ensure_ascii=False)


def _own(joint: urdf.Moving) -> str:
    """The key of a joint's limits as its source has them; nothing where it has none that an arm file can say."""
    most, unit = (arms.MOST, 1.0) if joint.slides else (arms.MOST_TURN, math.degrees(1))
    low, high = (_round(end * unit, 6) for end in joint.room or (0.0, 0.0))
    return f", limits = [{low!r}, {high!r}]" if -most <= low < high <= most else ""


def _span(joint: urdf.Moving) -> str:
    """The joint's own limits."""
    return frames.span(joint.room and tuple(joint.room if joint.slides else np.degrees(joint.room)),
                       "mm" if joint.slides else "degrees")
