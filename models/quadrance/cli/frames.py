"""This module says where an arm stands in its robot, and what to do about it around a core: no core computes it."""

from __future__ import annotations

from quadrance.arms import Arm, Beside
from quadrance.cli.around import WRISTED, folded, forward, inverse
from quadrance.cores import Core


def span(limits: tuple[float, float] | None, unit: str) -> str:
    """The limits of a joint, for a reader."""
    return f"{limits[0]:g} to {limits[1]:g} {unit}" if limits else "no limits given"


def _joint(one: Beside) -> str:
    unit, moves = ("mm", "moves the tip along z") if one.slides else ("degrees", "turns the tip about z")
    return (f"joint '{one.name}' ({span(one.limits, unit)}) {moves}, sign = {one.sign}, zero = {one.zero!r}; "
            "no core computes it")


def lines(arm: Arm) -> list[str]:
    """What is known of an arm's frames and of joints that no core computes."""
    seen = (("base: the cores' frame seen from '{}'", arm.base_frame),
            ("tip: '{}' seen from the cores' frame at the tip", arm.tip_frame))
    return [f"{text.format(frame.link)}: xyz = {list(frame.xyz)} mm, rpy = {list(frame.rpy)} degrees"
            for text, frame in seen if frame] + [_joint(one) for one in arm.beside]


def around(core: Core, arm: Arm) -> list[str]:
    """The frames of an arm, and how a driver takes a target to the core or a result from it."""
    found = lines(arm)
    if not found:
        return []
    arm, turns = folded(core, arm)
    found += [f"{side} is in {words}" for side, joint, words in (
        ("base", "yaw", "cfg_c1 and cfg_z1" if inverse(core).family == "six" else "cfg_d1 and cfg_z1"),
        ("tip", "j6", "cfg_c4 and cfg_z6" if inverse(core).family == "six" else "cfg_d6 and cfg_z6")) if joint in turns]
    if turns and not (arm.base_frame or arm.tip_frame or arm.beside):
        return found
    base, tip = ["base"] * bool(arm.base_frame), ["tip"] * bool(arm.tip_frame)
    behind = ["(the joints above)"] * bool(arm.beside) + tip
    if core.function.startswith(("velocity", "rates")):
        return [*found, "velocities are those of the cores' tip" + ", and base turns them" * bool(base)]
    own, robot = "(the core's)", "(the robot's)"
    if arm.axes > 3 and inverse(core).family not in WRISTED:
        found.append("this core ends at the wrist" + ", and tip is behind it" * bool(tip))
        behind = []
    if forward(core):
        return [*found, f"the robot's pose = {' * '.join([*base, own, *behind])}"]
    back = [f"{one}^-1" for one in behind[::-1]]
    return [*found, f"the core's target = {' * '.join([*(f'{one}^-1' for one in base), robot, *back])}"]
