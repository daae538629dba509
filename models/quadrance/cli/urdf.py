"""This module reads a robot that others described (URDF, xacro, a table of Denavit and Hartenberg) as one chain.

Such a file is not trusted. The reader refuses a document type, and with it every entity; a file of more than 16 MiB;
elements more than 64 deep; more than 1000 joints; and a length beyond 1 km. It opens no file that the robot names.
Xacro opens files and evaluates expressions, so `expand` runs it in a process of its own.
"""

from __future__ import annotations

import importlib.util
import math
import re
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple
from xml.parsers import expat

import numpy as np

from quadrance import arms
from quadrance.cli.catalogue import Refused, choose
from quadrance.truth import Floats

MOST_BYTES, MOST_DEPTH, MOST_JOINTS, MOST = 16 << 20, 64, 1000, 1000.0  # m, rad
SECONDS, EXPAND = 20, Path(__file__).with_name("expand.py")  # xacro's time, and the program that runs it
NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)(e[-+]?\d{1,3})?", re.ASCII | re.IGNORECASE)
Element = dict[str, dict[str, str]]  # a joint: "" -> its attributes, child -> the child's


class Moving(NamedTuple):
    """A joint that turns about its axis (rad) or slides along it (mm); `before` is the fixed frame that leads to it."""

    name: str
    slides: bool
    before: Floats  # (4, 4), mm
    axis: Floats  # (3,)
    room: tuple[float, float] | None  # None: no limits


@dataclass(frozen=True)
class Chain:
    """The joints between two links. `written` is the same chain with the angles `rounded` as the file has them."""

    name: str
    base: str
    tip: str
    joints: tuple[Moving, ...]
    after: Floats
    rounded: tuple[str, ...] = ()
    written: Chain | None = None


def pose(chain: Chain, q: Floats) -> Floats:
    """The tip's frames (n, 4, 4) seen from the base, mm, at joints (n, joints)."""
    found = np.tile(np.eye(4), (len(q), 1, 1))
    for joint, value in zip(chain.joints, np.moveaxis(q, -1, 0)):
        x, y, z = joint.axis
        cross, step = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), np.tile(np.eye(4), (len(q), 1, 1))
        if joint.slides:
            step[:, :3, 3] = value[:, None] * joint.axis
        else:
            sine, versine = np.sin(value)[:, None, None], 2 * np.sin(value / 2)[:, None, None] ** 2
            step[:, :3, :3] += sine * cross + versine * (cross @ cross)
        found = found @ joint.before @ step
    return found @ chain.after


def frame(xyz: Floats, rpy: Floats) -> Floats:
    """The frame (4, 4) of a place and of roll, pitch and yaw (rad) as a URDF has them."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, xyz[0]],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, xyz[1]],
                     [-sp, cp * sr, cp * cr, xyz[2]], [0, 0, 0, 1]])


def _numbers(where: str, text: str, count: int = 3, most: float = MOST) -> list[str]:
    found = text.split()
    if len(found) != count or not all(NUMBER.fullmatch(one) and abs(float(one)) <= most for one in found):
        raise Refused(f"{where} must be {count} finite number{'s' * (count > 1)} of a robot's size, "
                      f"not {ascii(text[:60])}")
    return found


def _meant(text: str) -> float:
    """The angle of a text; a multiple of pi/4 where the text is one, truncated or rounded to four decimals or more."""
    value, (mantissa, _, exponent) = float(text), text.lower().partition("e")
    near = round(value / (math.pi / 4)) * (math.pi / 4)
    decimals = len(mantissa.partition(".")[2]) - int(exponent or 0)
    return near if decimals >= 4 and abs(value - near) < 10.0**-decimals else value


def _chain(where: str, ends: tuple[str, str, str], joints: list[Element]) -> Chain:
    """The chain of these joints, in their order, `ends` being the names of robot, base and tip."""
    def made(exact: bool) -> Chain:
        moving, at, rounded = [], np.eye(4), []
        for joint in joints:
            name, kind = joint[""].get("name", ""), joint[""].get("type")
            here, origin = f"{where}: joint '{name}'", joint.get("origin", {})
            if unknown := set(origin) - {"xyz", "rpy"}:
                raise Refused(f"{here}: its origin has {ascii(min(unknown))}, and xyz and rpy alone are read")
            xyz = [1000 * float(one) for one in _numbers(f"{here}: xyz", origin.get("xyz", "0 0 0"))]
            rpy = _numbers(f"{here}: rpy", origin.get("rpy", "0 0 0"))
            angles = [float(one) if exact else _meant(one) for one in rpy]
            rounded += [one for one, angle in zip(rpy, angles) if abs(angle - float(one)) > 1e-9]
            at = at @ frame(xyz, angles)
            if kind == "fixed":
                continue
            if kind not in ("revolute", "continuous", "prismatic"):
                raise Refused(f"{here} is {ascii(kind)}: a chain has revolute, continuous and prismatic joints")
            if "mimic" in joint:
                raise Refused(f"{here} follows {ascii(joint['mimic'].get('joint'))} (mimic): it is no joint of its own")
            if "xyz" not in joint.get("axis", {"xyz": ""}):
                raise Refused(f"{here}: its axis has no xyz")
            axis = np.array(_numbers(f"{here}: axis", joint.get("axis", {}).get("xyz", "1 0 0")), dtype=float)
            if np.linalg.norm(axis) < 1e-3:
                raise Refused(f"{here}: its axis has no direction")
            limit, room = joint.get("limit", {}), None
            if kind != "continuous" and ("lower" in limit or "upper" in limit):
                low, high = (float(_numbers(f"{here}: limit", limit.get(end, "0"), 1, 1e9)[0]) for end in
                             ("lower", "upper"))
                if not low < high:
                    raise Refused(f"{here}: its lower limit {low:g} is not below its upper limit {high:g}")
                room = (1000 * low, 1000 * high) if kind == "prismatic" else (low, high)
            moving.append(Moving(name, kind == "prismatic", at, axis / np.linalg.norm(axis), room))
            at = np.eye(4)
        return Chain(*ends, tuple(moving), at, tuple(dict.fromkeys(rounded)))

    for joint in joints:
        _plain(where, "joint", joint[""].get("name", ""))
    chain = made(False)
    if len({joint.name for joint in chain.joints}) < len(chain.joints):
        raise Refused(f"{where}: two joints have one name")
    return replace(chain, written=made(True)) if chain.rounded else chain


def _plain(where: str, what: str, name: str) -> str:
    if not name.strip() or not name.isprintable() or len(name) > 200:
        raise Refused(f"{where}: {ascii(name[:60])} cannot be the name of a {what}")
    return name


# URDF


def _elements(path: Path, text: bytes) -> tuple[str, set[str], list[Element], bool]:
    """Name of the robot, its links, its joints, and whether xacro is wanted."""
    stack, joints, links, names, macros = [], [], set(), [], []

    def start(tag: str, given: dict[str, str]) -> None:
        stack.append(tag)
        if stack[0] != "robot":
            raise Refused(f"{path} is no URDF: its root is {ascii(tag)}, not 'robot'")
        if len(stack) > MOST_DEPTH or len(joints) > MOST_JOINTS:
            raise Refused(f"{path}: it has elements more than {MOST_DEPTH} deep, or more than {MOST_JOINTS} joints")
        if stack[1:] == ["joint"]:
            joints.append({"": given})
        elif stack[1:-1] == ["joint"]:
            joints[-1].setdefault(tag, given)
        elif stack[1:] == ["link"]:
            links.add(given.get("name", ""))
        elif len(stack) == 1:
            names.append(given.get("name", ""))
        if tag.startswith("xacro:") or any("${" in value for value in given.values()):
            macros.append(tag)

    def doctype(*_: object) -> None:
        raise Refused(f"{path}: it has a document type (<!DOCTYPE>), which no robot needs")

    parser = expat.ParserCreate()
    parser.StartElementHandler, parser.EndElementHandler = start, lambda tag: stack.pop()
    parser.StartDoctypeDeclHandler = doctype
    try:
        parser.Parse(text, True)
    except Refused:
        raise
    except (expat.ExpatError, ValueError, LookupError) as error:
        raise Refused(f"{path}: not XML: {error}") from None
    return names[0], links, joints, bool(macros)


def read_urdf(path: Path, base: str | None = None, tip: str | None = None, packages: str | None = None) -> Chain:
    """The chain from `base` (the root) to `tip` (the only end that moves) of a URDF or xacro; Refused with the reason.

    packages : the folder in which xacro finds packages, $(find NAME) being its folder NAME.
    """
    name, links, joints, macros = _elements(path, arms.read(path, MOST_BYTES))
    if macros:
        name, links, joints, _ = _elements(path, _expanded(path, packages))
    above: dict[str, Element] = {}
    for joint in joints:
        parent, child = (joint.get(end, {}).get("link", "") for end in ("parent", "child"))
        links |= {parent, child}
        if child in above:
            raise Refused(f"{path}: {ascii(child)} is the child of two joints")
        above[child] = joint
    for link in links:
        _plain(str(path), "link", link)
    parents = {joint["parent"]["link"] for joint in joints}

    def up(link: str) -> list[Element]:
        """The joints from the base to a link; none where no chain leads there."""
        found = []
        while link != base and link in above and len(found) <= len(joints):
            found.append(above[link])
            link = above[link]["parent"]["link"]
        return found[::-1] if link == base else []

    def one(what: str, given: str | None, found: list[str]) -> str:
        if given is None and len(found) != 1:
            some = ", ".join(found[:12]) + " ..." * (len(found) > 12)
            raise Refused(f"{path}: give --{what}; there are {some or 'no joints'}")
        return choose("link", given, sorted(links)) if given is not None else found[0]

    base = one("base", base, sorted(parents - set(above)))
    tip = one("tip", tip, [link for link in above if link not in parents
                           and any(joint[""].get("type") != "fixed" for joint in up(link))])
    if not up(tip):
        raise Refused(f"{path}: no chain of joints leads from '{base}' to '{tip}'")
    return _chain(str(path), (name if name.strip() and name.isprintable() else path.stem, base, tip), up(tip))


# Denavit and Hartenberg


def read_dh(path: Path) -> Chain:
    """The chain of a table of Denavit and Hartenberg, a TOML file; Refused with the reason.

    ``convention`` is "standard" or "modified". Every ``[[joint]]`` has a ``name``, ``a`` and ``d`` in mm, ``alpha`` and
    ``theta`` in degrees (0 where left out), ``slides = true`` where d moves, and ``limits`` in degrees or mm.
    """
    data = arms.toml(path, arms.read(path))
    rows, modified = data.get("joint"), data.get("convention") == "modified"
    if set(data) - {"name", "convention", "joint"} or not (modified or data.get("convention") == "standard") \
            or not isinstance(rows, list) or not 0 < len(rows) <= MOST_JOINTS:
        raise Refused(f'{path}: it has convention = "standard" or "modified", a [[joint]] a joint, perhaps a name')
    joints: list[Element] = []
    for i, row in enumerate(rows, 1):
        if not isinstance(row, dict) or set(row) - set("name a d alpha theta slides limits".split()):
            raise Refused(f"{path}: joint {i}: its keys are name, a, d, alpha, theta, slides and limits")
        name, slides, limits = str(row.get("name", "")), row.get("slides") is True, row.get("limits", [])
        numbers = [row.get(key, 0) for key in ("a", "d", "alpha", "theta")]
        if not isinstance(limits, list) or len(limits) not in (0, 2) or row.get("slides", False) is not slides \
                or not all(type(one) in (int, float) for one in numbers + limits):
            raise Refused(f"{path}: joint {i}: slides is true or false, limits are two numbers, the others one each")
        a, d, alpha, theta = numbers
        twist = {"xyz": f"{a / 1000!r} 0 0", "rpy": f"{math.radians(alpha)!r} 0 0"}
        screw = {"xyz": f"0 0 {d / 1000!r}", "rpy": f"0 0 {math.radians(theta)!r}"}
        ends = zip(("lower", "upper"), (repr(one / 1000 if slides else math.radians(one)) for one in limits))
        moving = {"": {"name": name, "type": "prismatic" if slides else "revolute"}, "axis": {"xyz": "0 0 1"},
                  "limit": dict(ends), "origin": twist if modified else {}}
        joints += [moving, *({"": {"name": name, "type": "fixed"}, "origin": one}
                             for one in ([screw] if modified else [screw, twist]))]
    return _chain(str(path), (_plain(str(path), "robot", str(data.get("name", path.stem))), "base", "tip"), joints)


# Xacro


def _expanded(path: Path, packages: str | None) -> bytes:
    """What xacro makes of a file."""
    if importlib.util.find_spec("xacro") is None:
        raise Refused(f"{path} needs xacro, which is not installed: pip install xacro")
    try:
        done = subprocess.run([sys.executable, "-P", EXPAND, str(SECONDS), path, packages or "", *sys.path],
                              capture_output=True, timeout=SECONDS, stdin=subprocess.DEVNULL, env={})
    except subprocess.TimeoutExpired:
        raise Refused(f"{path}: xacro did not end within {SECONDS} s") from None
    if done.returncode or len(done.stdout) > MOST_BYTES:
        said = done.stderr.decode(errors="replace").split("\n")[-1] or f"it was ended after {SECONDS} s"
        raise Refused(f"{path}: xacro: {said if done.returncode else 'it made too much'}")
    return done.stdout
