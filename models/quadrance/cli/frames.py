"""This module reads where an imported arm stands, and says what to do about it around a core.

No core computes it, so that an arm file has it in comments, as `quadrance import` writes them:

    # base frame: the cores' frame seen from 'world': xyz = [0.0, 0.0, 410.0] mm, rpy = [0.0, 0.0, 90.0] degrees
    # tip frame: 'tool0' seen from the cores' frame at the tip: xyz = [0.0, 0.0, 5.0] mm, rpy = [0.0, 90.0, 0.0] degrees
    # joint 'quill' (0 to 150 mm) moves the tip along z, sign = -1, zero = 0.0; no core computes it

A tool that is changed is a tip frame that is changed. A comment that begins so and goes on otherwise is refused.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, fields
from pathlib import Path

from quadrance.arms import MOST, Arm
from quadrance.cli.around import WRISTED, forward
from quadrance.cli.catalogue import Refused
from quadrance.cores import Core

SEEN = {"base": ("the cores' frame seen from '", "'"), "tip": ("'", "' seen from the cores' frame at the tip")}
JOINT = re.compile(r"joint '(.+)' \(.+\) (moves|turns) the tip (along|about) z, sign = (-?1), zero = (\S+); "
                   r"no core computes it")


@dataclass(frozen=True)
class Frame:
    """A frame seen from another: place in mm; turns in degrees about the other's x, y and z, one after the other.

    link : of the robot, the one of the two that is not the cores'.
    """

    link: str
    xyz: tuple[float, ...] = (0.0, 0.0, 0.0)
    rpy: tuple[float, ...] = (0.0, 0.0, 0.0)

    def __str__(self) -> str:
        return f"xyz = {list(self.xyz)} mm, rpy = {list(self.rpy)} degrees"


@dataclass(frozen=True)
class Placed(Arm):
    """An arm, and where its robot has it: `base` and `tip` are None where the frames are one and the same.

    beside : joints that no core computes, as the file's comments have them, in the order of the chain.
    """

    base_frame: Frame | None = None
    tip_frame: Frame | None = None
    beside: tuple[str, ...] = ()


def comment(name: str, frame: Frame) -> str:
    """The comment of a frame, `name` being base or tip."""
    return f"{name} frame: {frame.link.join(SEEN[name])}: {frame}"


def _numbers(text: str) -> tuple[float, ...] | None:
    try:
        found = tuple(float(one) for one in text.split(","))
    except ValueError:
        return None
    return found if len(found) == 3 and all(math.isfinite(one) and abs(one) <= MOST for one in found) else None


def placed(arm: Arm, path: Path, text: bytes) -> Arm:
    """The arm of a file with what its comments say; the arm itself where they say nothing."""
    found: dict[str, Frame] = {}
    beside = []
    for line in text.decode().split("\n"):
        said = line.rstrip("\r").removeprefix("# ")
        name, frame, _ = said.partition(" frame: ")
        if said == line.rstrip("\r"):
            continue
        if frame and name in SEEN:
            before, after = map(re.escape, SEEN[name])
            one = re.fullmatch(rf"{name} frame: {before}(.+){after}: xyz = \[(.*)\] mm, rpy = \[(.*)\] degrees", said)
            xyz, rpy = (one and _numbers(one[i]) for i in (2, 3))
            if not (xyz and rpy) or name in found or not one[1].isprintable():
                raise Refused(f"{path}: the comment of the {name} frame must be one, and as import writes it: "
                              f"# {comment(name, Frame('LINK'))}")
            found[name] = Frame(one[1], xyz, rpy)
        elif JOINT.fullmatch(said) and said.isprintable():
            beside.append(said)
    if not found and not beside:
        return arm
    return Placed(**{field.name: getattr(arm, field.name) for field in fields(Arm)}, base_frame=found.get("base"),
                  tip_frame=found.get("tip"), beside=tuple(beside))


def lines(arm: Arm) -> list[str]:
    """What is known of an arm's frames and of joints that no core computes."""
    if not isinstance(arm, Placed):
        return []
    known = (("base", arm.base_frame), ("tip", arm.tip_frame))
    return [comment(name, frame).replace(" frame: ", ": ", 1) for name, frame in known if frame] + list(arm.beside)


def around(core: Core, arm: Arm) -> list[str]:
    """The frames of an arm, and how a driver takes a target to the core or a result from it."""
    found = lines(arm)
    if not found:
        return []
    base, tip = ["base"] * bool(arm.base_frame), ["tip"] * bool(arm.tip_frame)
    behind = ["(the joints above)"] * bool(arm.beside) + tip
    if core.function.startswith(("velocity", "rates")):
        return [*found, "velocities are those of the cores' tip" + ", and base turns them" * bool(base)]
    own, robot = "(the core's)", "(the robot's)"
    if arm.axes > 3 and core.family not in WRISTED:
        found.append("this core ends at the wrist" + ", and tip is behind it" * bool(tip))
        behind = []
    if forward(core):
        return [*found, f"the robot's pose = {' * '.join([*base, own, *behind])}"]
    back = [f"{one}^-1" for one in behind[::-1]]
    return [*found, f"the core's target = {' * '.join([*(f'{one}^-1' for one in base), robot, *back])}"]
