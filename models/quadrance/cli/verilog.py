"""Verilog for a user's own top module: an instance with every parameter and configuration word, and file lists."""

from __future__ import annotations

import os
import re
import textwrap
from pathlib import Path

from quadrance import accuracy, keep, six
from quadrance import arm as arm_model
from quadrance.arms import SEVEN, Arm, ArmError
from quadrance.cli import frames
from quadrance.cli.around import (
    INSIDE,
    KEEPS,
    PLANE,
    SPACE,
    WRISTED,
    around,
    folded,
    inverse,
    joints,
    limits,
    machine,
    plus,
)
from quadrance.cli.catalogue import Refused, at, compile_order, timing
from quadrance.cores import Core, Port, all_cores

STREAM = (("in_valid", "in"), ("in_ready", "out"), ("out_valid", "out"), ("out_ready", "in"))


def literal(port: Port, value: int) -> str:
    """A sized Verilog literal of a word, signed where its port is."""
    if not port.low <= value <= port.high:
        raise Refused(f"{port.name}: {value} does not fit its {port.width} bits ({port.low} to {port.high})")
    if not port.signed:
        return f"{port.width}'d{value}"
    if value == port.low:  # its magnitude is no positive word
        return f"{port.width}'sh{value & (1 << port.width) - 1:x}"
    return f"{'-' * (value < 0)}{port.width}'sd{abs(value)}"


STREAMED = "its link lengths come with the samples (in_l), not as configuration words"
NO_ARM = {"chain": STREAMED, "mff": STREAMED,
          "fk5": "no key of an arm file says where its joints four and five are (cfg_d4, cfg_d5)"}


def takes_an_arm(core: Core) -> bool:
    """Whether an arm file can say the core's configuration words."""
    return core.function in (*PLANE, *SPACE, *INSIDE) or inverse(core).family in WRISTED


def _refuse(core: Core, arm: Arm) -> None:
    if not takes_an_arm(core):
        other = "its configuration is a solver's or a parallel robot's, which no arm file says" \
            if core.family == "engine" and core.cfg else "it is no kinematics of an arm"
        raise Refused(f"{core.name} takes no arm: {NO_ARM.get(core.function, other)}")
    if arm.upper_limit and core.family != "srs":
        raise Refused(f"{core.name} on arm {arm.id}: {SEVEN}")
    if core.function not in PLANE and not arm.yaws:
        raise Refused(f"{core.name} on arm {arm.id}: limits.yaw: is missing, and a joint of the core yaws; fk2, ik2 "
                      "and other cores of a plane take this arm")


def fitted(core: Core, arm: Arm, given: dict[str, int]) -> Core:
    """The core at the parameters that the user gave and with the switches that the arm wants, all at once: its rule
    may allow a word with these switches alone.

    A switch that the user gave as 1 stays where the arm has nothing for it: its word is 0. Refused for any other that
    contradicts the arm, for the core would then be another arm's.
    """
    _refuse(core, arm)
    wanted = {key: value for key, value in arm_model.switches(arm).items() if key in core.params}
    for key, value in given.items():
        if key not in wanted or value == wanted[key]:
            continue
        if key == "ABSOLUTE" or not value:
            name = "absolute_elbow" if key == "ABSOLUTE" else key.lower()
            said = str(getattr(arm, name)).lower()
            raise Refused(f"{core.name}: -p {key}={value} contradicts constants.{name} = {said} of {arm.id}: leave it "
                          "out, or change the arm file")
        wanted[key] = value
    params = given | wanted
    return at(core, params) if any(core.params.get(key) != value for key, value in params.items()) else core


def config(core: Core, arm: Arm) -> dict[str, int]:
    """Configuration words of a core for an arm; Refused where the arm does not fit the core's words."""
    _refuse(core, arm)
    try:
        words = accuracy.config(inverse(core), folded(core, arm)[0])
        words |= machine(core, arm) if core.function in KEEPS else {}
    except ArmError as error:
        raise Refused(f"{core.name} on arm {error}") from None
    for port in core.cfg:
        if not port.low <= words[port.name] <= port.high:
            raise Refused(f"{core.id} on arm {arm.id}: {port.name} would be {words[port.name]}, its {port.width} bits "
                          f"end at {port.high}; raise mm_per_unit in the arm file, or take a smaller F or a larger W")
    return words


def _lengths(core: Core, arm: Arm) -> dict[str, tuple[float, str]]:
    """Millimetres of the words that are a length, and the key of the arm file that says them."""
    line = (arm.l2, "sqrt(links.l2^2 + constants.elbow^2)" if arm.elbow else "links.l2")
    found = {f"cfg_{name}": (getattr(arm, name), f"constants.{name}")
             for name in ("base", "shoulder", "lateral", "elbow")}
    fore = (arm.forearm, "links.l2") if core.function == "arm_fk3" else line
    found |= {"cfg_l1": (arm.l1, "links.l1"), "cfg_l2": fore, "cfg_l3": (arm.l3, "links.l3"),
              "cfg_radius": (arm.singular[1], "singular.axis")}
    if core.family == "six":
        found = {f"cfg_{name}": (length, key) for (name, length), key in zip(arm.six.items(), (
            "constants.shoulder", "minus constants.elbow", "constants.lateral", "constants.base", "links.l1",
            "links.l2", "wrist.flange"))} | {"cfg_k": line, "cfg_radius": found["cfg_radius"]}
    if core.family == "ur":
        keys = ("constants.base", "constants.lateral", "wrist.offset", "wrist.flange", "links.l1", "links.l2")
        found = {f"cfg_{name}": (length, key) for (name, length), key in zip(arm.ur.items(), keys)}
    if core.family == "srs":
        keys = ("constants.base", "links.l1", "links.l2", "wrist.flange")
        found = {f"cfg_{name}": (length, key) for (name, length), key in zip(arm.srs.items(), keys)}
    return found


def _note(core: Core, port: Port, arm: Arm, value: int) -> str:
    """Where a configuration word comes from."""
    if core.function in KEEPS:
        if port.name in keep.MACHINE:
            return _joint_note(core, port, arm, value)
        whole, _ = folded(core, arm)
        if port.name in ("cfg_c1", "cfg_d1") and whole.base_frame is not arm.base_frame:
            return f"{whole.base:.6g} mm, constants.base and frames.base"
        if port.name in ("cfg_c4", "cfg_d6") and whole.tip_frame is not arm.tip_frame:
            return f"{whole.flange if whole.d6 is None else whole.d6:.6g} mm, wrist.flange and frames.tip"
        core = inverse(core)
    switch = {"cfg_bb": "LATERAL", "cfg_ce": "ELBOW", "cfg_ne": "ELBOW", "cfg_slack": "MARGINS",
              "cfg_margin": "MARGINS"}.get(port.name, port.name[4:].upper())
    if switch in (*arm_model.SWITCHES, "MARGINS") and core.params.get(switch) == 0:
        return f"not built: {switch} is 0"
    if known := _lengths(core, arm).get(port.name):
        length, key = known
        more = six.MORE if core.family in WRISTED and port.name != "cfg_radius" else 0
        held = value * 2.0 ** -(core.params["F"] + more) * arm.mm_per_unit
        said, kept = f"{length:.6g}", f"{held:.6g}"
        return f"{said} mm, {key}" + ("" if said == kept else f", held as {kept} mm")
    angle = -arm.elbow_angle if core.family == "six" else arm.elbow_angle
    turn = f"{angle:.6g} degrees, atan2(constants.elbow, links.l2)"
    if limited := re.fullmatch(r"cfg_(mc|mn|h)(\d)", port.name):
        key, low, high = accuracy.limits(core, arm)[int(limited[2]) - 1]
        less = plus(-arm.elbow_angle, 6) if key == "elbow" and core.function == "keep3" else ""
        what = {"mc": "cosine of the middle", "mn": "sine of the middle",
                "h": "cosine of half the room" if high - low < 360 else "no limit"}[limited[1]]
        return f"limits.{key}{less}, {low:.6g} to {high:.6g} degrees: {what}"
    return {"cfg_ce": f"cosine of {turn}", "cfg_ne": f"minus sine of {turn}", "cfg_cp": f"cosine of {turn}",
            "cfg_np": f"sine of {turn}", "cfg_bb": "minus the square of cfg_lateral",
            "cfg_elbow": f"from cfg_c3 and {arm.singular[0] or 0:g} degrees, singular.elbow",
            "cfg_sine": f"sine of {arm.singular[0] or 0:g} degrees, singular.elbow",
            "cfg_c1": "from links.l1", "cfg_s1": "from links.l1",
            "cfg_margin": f"{arm.singular[1] or 0:g} mm, singular.axis" if value else "no margin",
            "cfg_slack": "no slack"}.get(port.name) or (
        "from cfg_c2 and cfg_k" if core.family == "six" else "from both links")


def _joint_note(core: Core, port: Port, arm: Arm, value: int) -> str:
    """What a word of the machine's joints says."""
    known = [joint for joint, _ in joints(core, arm)]
    if port.name in ("cfg_turned", "cfg_coupled"):
        first = 0 if port.name == "cfg_turned" else 1
        named = [joint.name for i, joint in enumerate(known[first:]) if value >> i & 1]
        how = "the other way" if first == 0 else "together with the joint before"
        return f"{', '.join(named) or 'no joint'} count{'s' * (len(named) < 2)} {how}"
    kind, i = re.fullmatch(r"cfg_([a-z]+)(\d)", port.name).groups()
    name, (key, low, high) = known[int(i) - 1].name, limits(core, arm)[int(i) - 1]
    degrees = value * 360 / 2 ** core.params["A"]
    return {"z": f"zero of {name}: {degrees:.6g} degrees", "low": f"{name} from {low:.6g} degrees, {key}",
            "high": f"to {high:.6g} degrees", "w": f"weight of a step of {name}"}[kind]


def instance(core: Core, arm: Arm | None = None, name: str | None = None, declare: bool = False) -> str:
    """The instantiation of a core.

    Parameters
    ----------
    arm : whose configuration words are computed; None leaves ``cfg_*`` to signals of the same names.
    name : of the instance, and what stands before the names of its signals; "u_" and the core's name by default.
    declare : put the declarations of the signals before it.
    """
    name = name or f"u_{core.name}"
    if not re.fullmatch(r"[A-Za-z_]\w*", name):
        raise Refused(f"'{name}' is no name of a Verilog instance: letters, digits and _ alone, no digit first")
    prefix = re.sub(r"^u_", "", name)
    words = config(core, arm) if arm is not None else {}
    ports = [("clk", "clk", ""), ("rst", "rst", "")] if core.clocked else []
    wires = []

    def signal(port: str, width: int, signed: bool) -> None:
        ports.append((port, f"{prefix}_{port}", ""))
        kind = "signed " * signed + (f"[{width - 1}:0] " if width > 1 else "")
        wires.append(f"wire {kind}{prefix}_{port};")

    for port in core.cfg:
        if port.name in words:
            ports.append((port.name, literal(port, words[port.name]), _note(core, port, arm, words[port.name])))
        else:
            signal(port.name, port.width, port.signed)
    for side, group in ((STREAM[:2], core.inputs), (STREAM[2:], core.outputs)):
        for one, _ in side if core.clocked else ():
            signal(one, 1, False)
        for port in group:
            signal(port.name, port.width, port.signed)
    params = ", ".join(f".{key}({value})" for key, value in core.params.items())
    lines = [f"// {line}".rstrip() for line in notes(core, arm)] + (wires if declare else [])
    lines += textwrap.wrap(f"{core.name} {f'#({params}) ' if params else ''}{name} (", 120, subsequent_indent="    ")
    width = max(len(f".{port}({value}),") for port, value, _ in ports)
    for i, (port, value, note) in enumerate(ports):
        text = f".{port}({value}){',' if i + 1 < len(ports) else ''}"
        lines.append(f"    {text:{width}}  // {note}" if note else f"    {text}")
    return "\n".join([*lines, ");"])


def notes(core: Core, arm: Arm | None) -> list[str]:
    """What a reader of the instance has to know: the timing, the scale, what a driver computes around the core."""
    listed = core.id in {one.id for one in all_cores()}
    lines = [f"{core.id if listed else core.name}: {timing(core)}"]
    if arm is None:
        return lines
    lines.append(f"{arm.name}: one LSB of a coordinate is {accuracy.mm_per_lsb(core, arm):.6g} mm")
    found = around(core, arm)
    what = ["in mm and degrees", "j1 ... are its joints"]
    what += ["w1 ... their rates in radians"] * core.function.startswith(("velocity", "rates"))
    what += ["rho the distance from the yaw axis"] * (core.function in PLANE and arm.yaws)
    lines.append(f"Around the core, {', '.join(what)}:")
    for where, steps in (("before", found.before), ("after", found.after)):
        for i in range(0, len(steps), 4):
            lines.append(f"  {where:6} {';  '.join(steps[i:i + 4])}")
    lines += [f"  note   {one}" for one in found.remarks]
    return lines + [f"  frame  {one}" for one in frames.around(core, arm)]


def file_list(core: Core, relative_to: Path | None = None) -> list[str]:
    """Paths of the files of a core in compile order, absolute or seen from a folder."""
    order = compile_order(core)
    if relative_to is None:
        return [str(path) for path in order]
    return [os.path.relpath(path, relative_to.resolve()) for path in order]


def dot_f(core: Core, paths: list[str]) -> str:
    """A command file (``-f``) for Verilator, Icarus (``-c``), Questa, VCS and Xcelium."""
    values = ", ".join(f"{key}={value}" for key, value in core.params.items())
    return "\n".join([f"// top module {core.name}" + (f"; listed parameters {values}" if values else ""), *paths])
