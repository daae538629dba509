"""What a driver computes around a core so that an arm is served: formulas in millimetres and degrees.

In them x, y, z are what the core has in front of it or behind it, j1, j2 ... its joints, w1 ... their rates (radians),
rho and r the distance from the yaw axis; the machine's joints have the names of the arm file, and rate(...) is that of
one of them. Only what the core leaves out is said.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

from quadrance import keep, six, ur
from quadrance.arms import WRIST, WRIST_OF_SEVEN, Arm, ArmError, Joint
from quadrance.cores import Core, at, find
from quadrance.program import parser

PLANE = ("fk1", "fk2", "ik1", "ik2", "ik3r", "keep2", "velocity2", "rates2")  # in a plane: of a yawing arm its own
INSIDE = ("arm_fk3", "arm_ik3", "keep3")  # cores that have the constants inside
KEEPS = {"six_keep": "vector_ik6_all", "ur_keep": "vector_ur_ik_all"}  # cores that choose, and whose branches they do
WRISTED = ("six", "ur", "srs")  # families that serve an arm with its wrist
SPACE = ("fk3", "ik3", "velocity3", "rates3")


@dataclass(frozen=True)
class Around:
    """Assignments in front of the core and behind it, in their order, and sentences about them."""

    before: tuple[str, ...]
    after: tuple[str, ...]
    remarks: tuple[str, ...] = ()


def forward(core: Core) -> bool:
    """Whether the core takes joints and gives a place (or a velocity)."""
    return re.match(r"(arm_|ur_)?fk|velocity", core.function) is not None


def number(value: float, digits: int = 9) -> str:
    """A constant as it stands in a formula."""
    return f"{value:.{digits}g}"


def plus(value: float, digits: int = 9) -> str:
    """A constant term of a sum, its sign in front; nothing where it is 0."""
    return f" {'-' if value < 0 else '+'} {number(abs(value), digits)}" if value else ""


def _times(value: float, factor: str) -> str:
    """A term of a sum, its sign in front; nothing where the value is 0."""
    return f" {'-' if value < 0 else '+'} {number(abs(value))}*{factor}" if value else ""


def inverse(core: Core) -> Core:
    """The core whose branches a core of `KEEPS` has; any other core itself."""
    if core.function not in KEEPS:
        return core
    return at(find(KEEPS[core.function]), {key: core.params[key] for key in ("W", "F", "U", "PIPE")})


def joints(core: Core, arm: Arm) -> list[tuple[Joint, str]]:
    """The machine's joint of every joint of the core, its zero that of the core; and what else is to be subtracted.

    The latter is "" or another joint of the core: an elbow that is measured from the horizontal has joint 1 in it.
    """
    core = inverse(core)
    yaw, shoulder, elbow = (arm.joint(key) for key in ("yaw", "shoulder", "elbow"))
    if core.family == "six":  # from the vertical, downwards
        second = replace(shoulder, sign=-shoulder.sign, zero=90 - shoulder.zero)
        third = replace(elbow, sign=-elbow.sign, zero=(90 if arm.absolute_elbow else 0) - elbow.zero)
        wrist = [(arm.joint(key), "") for key in WRIST]
        return [(yaw, ""), (second, ""), (third, "j2" if arm.absolute_elbow else ""), *wrist]
    if core.family == "ur":  # those of the maker's table: the arm looks back at 0, and its links turn downwards
        turned = [replace(one, sign=-one.sign, zero=-one.zero) for one in (shoulder, elbow)]
        joints = replace(yaw, zero=yaw.zero - 180), *turned, *(arm.joint(key) for key in WRIST)
        return [(replace(one, zero=(one.zero + 180) % 360 - 180), "") for one in joints]
    if core.family == "srs":
        second = replace(shoulder, sign=-shoulder.sign, zero=90 - shoulder.zero)
        return [(one, "") for one in (yaw, second, arm.joint("upper"), elbow, *map(arm.joint, WRIST_OF_SEVEN))]
    if core.function in ("fk1", "ik1"):
        return [(shoulder, "")]
    found = [(shoulder, "")]
    if core.function in INSIDE:
        found.append((elbow, ""))
    else:
        found.append((replace(elbow, zero=elbow.zero + arm.elbow_angle), "j1" if arm.absolute_elbow else ""))
    if core.function == "ik3r":
        return [*found, (arm.joint("tool"), "")]
    return found if core.function in PLANE else [*found, (yaw, "")]


def _taken(i: int, joint: Joint, less: str) -> str:
    """Joint i of the core from the machine's."""
    zero = joint.zero
    name = joint.name if joint.sign > 0 else f"-{joint.name}"
    return f"j{i} = {name}{plus(zero)}" + (f" - {less}" if less else "")


def _given(joint: Joint, less: str, core: str) -> str:
    """The machine's joint from the core's (`core`: what it is in the formula)."""
    core = f"{core} + {less}" if less else core
    if joint.sign > 0:
        return f"{joint.name} = {core}{plus(-joint.zero)}"
    core = f"({core})" if " " in core else core
    return f"{joint.name} = {number(joint.zero)} - {core}" if joint.zero else f"{joint.name} = -{core}"


def around(core: Core, arm: Arm) -> Around:
    """The formulas of a core that takes `arm`."""
    machine = joints(core, arm)
    if core.function.startswith(("velocity", "rates")):
        return _velocity(core, arm, machine)
    if forward(core):
        return Around(tuple(_taken(i, *one) for i, one in enumerate(machine, 1)), _place(core, arm))
    if core.function in KEEPS:
        return Around((), tuple(f"{joint.name} = j{i}" for i, (joint, _) in enumerate(machine, 1)),
                      (f"j1 ... are the machine's own: out_j1 ... times 360/2^{core.params['A']}",
                       "limits and speed of a joint in the arm file set its turns and its weight"))
    before, yaw, remarks = _target(core, arm)
    names = [f"j{i}" for i in range(1, len(machine) + 1)]
    if core.function == "ik3" and yaw:
        names[2] = f"j3 - {yaw}"
    if core.family == "srs":
        remarks = ("in_cs and in_ns are cosine and sine of the swivel, which turns the elbow: rtl/srs/README.md",)
    if core.function in ("ik6_all", "ur_ik_all"):
        remarks = (*remarks, "j1 to j6 are those of each of the eight branches")
    return Around(before, tuple(_given(*one, name) for one, name in zip(machine, names)), remarks)


def _place(core: Core, arm: Arm) -> tuple[str, ...]:
    """Behind a forward core: what the arm's constants add to its tip."""
    a, b, base = arm.shoulder, arm.lateral, arm.base
    if core.function == "fk3":
        found = [f"x = x{_times(a, 'cos(j3)')}{_times(-b, 'sin(j3)')}",
                 f"y = y{_times(a, 'sin(j3)')}{_times(b, 'cos(j3)')}", f"z = z{plus(base)}"]
        return tuple(one for one in found if " = " + one[0] != one[1:])
    return (f"rho = x{plus(a)}", f"z = y{plus(base)}") if core.function in PLANE and arm.yaws else ()


def _target(core: Core, arm: Arm) -> tuple[tuple[str, ...], str, tuple[str, ...]]:
    """In front of an inverse core: the target without the arm's constants; what they turn the yaw by; remarks."""
    a, b, base = arm.shoulder, arm.lateral, arm.base
    if core.function in PLANE and arm.yaws:
        return (f"x = rho{plus(-a)}", f"y = z{plus(-base)}"), "", ()
    if core.function != "ik3":
        return (), "", ()
    height = (f"z = z{plus(-base)}",) if base else ()
    if not (a or b):
        return height, "", ()
    flat = f"sqrt(r*r{plus(-b * b)})" if b else "r"
    scaled = f"({flat}{plus(-a)})/r" if a else f"{flat}/r"
    yaw = f"atan2({number(b)}, {flat})" if b else ""
    return (("r = hypot(x, y)", f"k = {scaled}", "x = k*x", "y = k*y", *height), yaw,
            ("the formulas hold where k is positive; " * bool(a) + "arm_ik3 has the offsets inside",))


def _velocity(core: Core, arm: Arm, machine: list[tuple[Joint, str]]) -> Around:
    """Rates of the machine's joints, and what the offsets add to the velocity of a plane that yaws."""
    a, b = arm.shoulder, arm.lateral
    angles = tuple(_taken(i, *one) for i, one in enumerate(machine[:5], 1))  # that of joint 6 does not matter
    plain = [(replace(joint, zero=0.0), less.replace("j", "w")) for joint, less in machine]
    named = [(replace(joint, name=f"rate({joint.name})"), less) for joint, less in plain]
    remarks = ("the core has no offsets; base height needs none",)
    if core.family == "six":
        remarks = ("velocity and turn are those of the flange in the frame of the base",)
    if core.function in PLANE and arm.yaws:
        remarks = ("x and y of the core are the rates of rho and z in the arm's plane; offsets change neither",)
    yawing = core.function in SPACE and bool(a or b)
    if core.function.startswith("velocity"):
        taken = tuple(_taken(i, *one).replace("j", "w", 1) for i, one in enumerate(named, 1))
        more = ()
        if yawing:
            more = (f"x = x{_times(-a, 'w3*sin(j3)')}{_times(-b, 'w3*cos(j3)')}",
                    f"y = y{_times(a, 'w3*cos(j3)')}{_times(-b, 'w3*sin(j3)')}")
        return Around((*angles, *taken), more, remarks)
    before, names = [*angles], [f"w{i}" for i in range(1, len(machine) + 1)]
    if yawing:
        before += [f"rho = {number(arm.l1)}*cos(j1) + {number(arm.l2)}*cos(j1 + j2)",
                   f"w = (y*cos(j3) - x*sin(j3))/{f'(rho{plus(a)})' if a else 'rho'}"]
        before += [f"x = x + w*{number(b)}*cos(j3)", f"y = y + w*{number(b)}*sin(j3)"] if b else []
        names[2] = "w"
        remarks = ("the core has no offsets: w is the rate of joint 3, its own w3 is not used",)
    return Around(tuple(before), tuple(_given(*one, name) for one, name in zip(named, names)), remarks)


def limits(core: Core, arm: Arm) -> list[tuple[str, float, float]]:
    """Key and ends, degrees, of the limits of the joints of a core of `KEEPS`, as the machine measures them."""
    shoulder, elbow, yaw = arm.limits
    seen = {"yaw": yaw, "shoulder": shoulder, "elbow": tuple(end - arm.elbow_angle for end in elbow)}
    keys = {key: key for key in seen}
    if arm.absolute_elbow:
        if arm.forearm_limit is None:
            raise ArmError(f"{arm.id}: limits.forearm: is missing")
        seen["elbow"], keys["elbow"] = arm.forearm_limit, "forearm"
    found = []
    for key in ("yaw", "shoulder", "elbow"):
        joint = arm.joint(key)
        ends = sorted(joint.sign * (end - joint.zero) for end in seen[key])
        ends = [-180.0, 180.0] if ends[1] - ends[0] == 360 else ends  # all of a turn, about the machine's zero
        found.append((f"limits.{keys[key]}", *ends))
    found += [("none in the file", -180.0, 180.0) for _ in WRIST]
    order = [arm.joint(key) for key in ("yaw", "shoulder", "elbow", *WRIST)]
    return [(f"joints.{joint.key}.limits", *joint.limits) if joint.limits else own for joint, own in zip(order, found)]


def speeds(arm: Arm) -> list[float]:
    """Speeds of the six joints, degrees a second; all 1 where one of them is missing in the file."""
    given = [arm.joint(key).speed for key in ("yaw", "shoulder", "elbow", *WRIST)]
    return [1.0] * 6 if None in given else given


def folded(core: Core, arm: Arm) -> tuple[Arm, dict[str, float]]:
    """The arm that a core of `KEEPS` has with those frames that lie along axis 1 or 6 in its lengths, and the degrees
    that they add to joints; of any other core the arm itself. A frame is left where its length would be beyond the
    word, or beyond what the program's text lets it be.
    """
    if core.function not in KEEPS:
        return arm, {}
    unit = arm.mm_per_unit * 2.0 ** (core.params["W"] - core.params["F"])  # mm
    solver, base, tip, flange = (six, "l1", "l4", "flange") if core.function == "six_keep" else (ur, "d1", "d6", "d6")
    most = {names[0]: limit for names, limit in parser.load(solver.ALL).norms if len(names) == 1}
    found, turns = arm, {}
    for side, length, joint, name in (("base", "base", "yaw", base), ("tip", flange, "j6", tip)):
        frame = getattr(arm, f"{side}_frame")
        if frame is None or any((*frame.xyz[:2], *frame.rpy[:2])) or side == "tip" and arm.beside:
            continue
        whole = getattr(arm, length) + frame.xyz[2]
        if abs(whole) < most.get(name, 0.5) * unit:
            found = replace(found, **{length: whole, f"{side}_frame": None})
            turns[joint] = frame.rpy[2]
    return found, turns


def machine(core: Core, arm: Arm) -> dict[str, int]:
    """Words of the machine's joints of a core of `KEEPS`."""
    known, (_, turns) = joints(core, arm), folded(core, arm)
    zeros = [-joint.sign * (joint.zero + turns.get(joint.key, 0.0)) for joint, _ in known]
    return keep.machine(core.params, turned=[joint.sign < 0 for joint, _ in known],
                       coupled=[bool(less) for _, less in known], zeros=[math.radians(zero) for zero in zeros],
                       limits=[(math.radians(low), math.radians(high)) for _, low, high in limits(core, arm)],
                       weights=[1 / speed for speed in speeds(arm)])
