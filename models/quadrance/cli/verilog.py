"""Verilog for a user's own top module: an instance with every parameter and configuration word, and file lists."""

from __future__ import annotations

import os
import re
from pathlib import Path

from quadrance import accuracy
from quadrance.arms import Arm
from quadrance.cli.catalogue import Refused, compile_order, fraction_of, timing
from quadrance.cores import Core, Port

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


def config(core: Core, arm: Arm) -> dict[str, int]:
    """Configuration words of a core for an arm; Refused where the arm does not fit the core's words."""
    try:
        words = accuracy.config(core, arm)
    except (ValueError, KeyError) as error:
        raise Refused(f"{core.id}: no configuration words of arm {arm.id}: {error}") from None
    for port in core.cfg:
        if not port.low <= words[port.name] <= port.high:
            raise Refused(f"{core.id} on arm {arm.id}: {port.name} would be {words[port.name]}, its {port.width} bits "
                          f"end at {port.high}; raise mm_per_unit in the arm file, or take a smaller F or a larger W")
    return words


def _note(core: Core, port: Port, arm: Arm, value: int) -> str:
    fraction = fraction_of(core, port)
    if fraction is None:
        return "from the link lengths"
    link = {"cfg_l1": arm.l1, "cfg_l2": arm.l2}.get(port.name)
    held = value * 2.0**-fraction * arm.mm_per_unit
    return f"{link:.6g} mm" + ("" if abs(held - link) < 1e-6 else f", held as {held:.6g} mm")


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
    lines = [f"// {line}" for line in notes(core, arm)] + (wires if declare else [])
    lines.append(f"{core.name} {f'#({params}) ' if params else ''}{name} (")
    width = max(len(f".{port}({value}),") for port, value, _ in ports)
    for i, (port, value, note) in enumerate(ports):
        text = f".{port}({value}){',' if i + 1 < len(ports) else ''}"
        lines.append(f"    {text:{width}}  // {note}" if note else f"    {text}")
    return "\n".join([*lines, ");"])


def notes(core: Core, arm: Arm | None) -> list[str]:
    """What a reader of the instance has to know: the timing, the scale, what a driver adds around the core."""
    lines = [f"{core.id}: {timing(core)}"]
    if arm is None or "F" not in core.params:
        return lines
    lines[0] += f"; {arm.name}: one LSB of a coordinate is {accuracy.mm_per_lsb(core, arm):.6g} mm"
    for value, text in ((arm.base, "subtract {:g} mm from z first"), (arm.shoulder, "subtract {:g} mm from the radius"),
                        (arm.lateral, "the arm's plane is {:g} mm off the yaw axis: see the arm file"),
                        (arm.elbow_angle, "joint 2 is turned by {:.6g} degrees (elbow offset)")):
        if value:
            lines.append("around the core: " + text.format(value))
    if arm.absolute_elbow:
        lines.append("around the core: the machine's joint 2 is measured from the base, the core's from link 1")
    return lines


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
