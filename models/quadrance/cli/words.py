"""This module converts degrees, encoder counts and millimetres into words of ports and back.

A word is named by its type and bits (``angle:18``, ``spread:24``, ``coordinate:16.8``) or by a port (``table_ik2.x``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from quadrance import codecs
from quadrance.cli.catalogue import Refused, choose, find, scale_of
from quadrance.cores import TYPES, Joint, Port, joints

PLAIN = {"coordinate": True, "length": False}  # whether it is two's complement
DEFAULT = {"angle": 18, "spread": 24, "vector": 16, "half_tangent": 16}  # bits, as the cores' first sets have them
HELP = "TYPE[:BITS] (angle, spread, vector, half_tangent), coordinate[:W.F], length[:W.F], or CORE.PORT"
MOST = {"angle": 40, "spread": 40, "vector": 40, "half_tangent": 40}  # float64 has 53 bits


@dataclass(frozen=True)
class Word:
    """A word: the ports of a joint, or one port with its fraction bits and its unit (`catalogue.scale_of`)."""

    ports: Joint
    fraction: int | None = None
    unit: str = "units"

    @property
    def joint(self) -> bool:
        """Whether it is a joint's."""
        return self.fraction is None


def word(text: str, params: dict[str, int] | None = None) -> Word:
    """The word that `text` names; `params` change the parameters of the core it names."""
    kind, colon, bits = text.partition(":")
    if "." in kind and not colon:
        return _of_port(*text.rpartition(".")[::2], params)
    if params:
        raise Refused(f"{text}: -p belongs to a port of a core (CORE.PORT)")
    choose("word", kind, [*TYPES, *PLAIN])
    if kind in PLAIN:
        sizes = re.fullmatch(r"(\d+)\.(\d+)", bits) if colon else ("16.8", "16", "8")
        if not sizes or not 2 <= int(sizes[1]) <= 40 or int(sizes[2]) > int(sizes[1]):
            raise Refused(f"{text}: {kind}:W.F wants the width (2 to 40) and the fraction bits, such as {kind}:16.8")
        return Word((Port(kind, int(sizes[1]), PLAIN[kind]),), int(sizes[2]))
    if colon and not (bits.isdecimal() and 2 <= int(bits) <= MOST[kind]):
        raise Refused(f"{text}: the bits of {kind} are a number from 2 to {MOST[kind]}")
    return Word(codecs.joint_of(kind, int(bits) if colon else DEFAULT[kind]))


def _of_port(name: str, port: str, params: dict[str, int] | None) -> Word:
    core = find(name, params)
    known = {key: one for one in (*core.cfg, *core.inputs, *core.outputs)
             for key in (one.name.partition("_")[2], one.name)}
    ports = {joint[0].name[-1]: joint for joint in joints(core.inputs) + joints(core.outputs)}
    if re.fullmatch(r"j\d", port) and port[1] in ports:  # a joint of any word, a vector's two ports too
        return Word(ports[port[1]])
    found = known[choose(f"port of {core.name}", port, [key for key in known if "_" in key] if "_" in port else
                         [key for key in known if "_" not in key])]
    for other in (*core.cfg, *core.inputs, *core.outputs):
        if other.name.endswith(f"_{port}") and (other.type, other.width) != (found.type, found.width):
            raise Refused(f"{core.name}.{port} is {other.name} and {found.name}: give the port's whole name")
    if found.type:
        return Word(next(joint for joint in joints(core.inputs) + joints(core.outputs) if found in joint))
    if (scale := scale_of(core, found)) is None:
        raise Refused(f"{core.name}.{found.name} is neither a joint word nor a coordinate: nothing to convert")
    return Word((found,), *scale)


def _entry(port: Port, value: int) -> dict:
    unsigned = value & (1 << port.width) - 1
    return {"port": port.name, "value": value, "bits": port.width, "signed": port.signed,
            "hex": f"{port.width}'h{unsigned:0{-(-port.width // 4)}x}"}


def encode(one: Word, value: float, counts: int | None = None, mm_per_unit: float | None = None) -> dict:
    """The word nearest to a value, and the value of that word.

    Parameters
    ----------
    value : degrees, or an encoder's count where `counts` says how many make a turn; of a coordinate units, or
        millimetres where `mm_per_unit` is given.
    """
    if not np.isfinite(value):
        raise Refused(f"{value} is no finite number")
    if not one.joint:
        _no_counts(one, counts)
        port, mm_per_unit = one.ports[0], mm_per_unit if one.unit == "units" else None
        found = int(np.floor(value / (mm_per_unit or 1.0) * 2.0**one.fraction + 0.5))
        if not port.low <= found <= port.high:
            low, high = (edge * 2.0**-one.fraction * (mm_per_unit or 1.0) for edge in (port.low, port.high))
            unit = " mm" if mm_per_unit else {"1": ""}.get(one.unit, f" {one.unit}")
            raise Refused(f"{value:g}: {port.name} of {port.width} bits holds {low:g} to {high:g}{unit}")
        return {"given": value, "words": [_entry(port, found)]} | decode(one, (found,), None, mm_per_unit)["means"]
    if counts is not None:
        if value != int(value):
            raise Refused(f"{value:g}: an encoder's count is a whole number")
        count = int(value) % counts
        words = _joint_words(one, np.radians(count * (360 / counts)))
        if one.ports[0].type == "angle":
            words = (int(codecs.from_counts("angle", one.ports[0].width, count, counts)),)
    else:
        words = _joint_words(one, np.radians(value % 360))
    return {"given": value, "words": [_entry(port, found) for port, found in zip(one.ports, words)]} \
        | decode(one, words, counts)["means"]


def _joint_words(one: Word, theta: float) -> tuple[int, ...]:
    return tuple(int(word) for word in codecs.encode(one.ports, theta).values())


def _no_counts(one: Word, counts: int | None) -> None:
    if counts is not None:
        raise Refused(f"--counts is for joint words, {one.ports[0].name} is a length")


def decode(one: Word, words: tuple[int, ...], counts: int | None = None, mm_per_unit: float | None = None,
           half: bool = False) -> dict:
    """The values of words: degrees (and counts), or units (and millimetres).

    half : degrees and counts are those of half a turn to either side, not of a whole turn from 0.
    """
    if half and not one.joint:
        raise Refused(f"--signed is for joint words, {one.ports[0].name} has its own sign")
    if len(words) != len(one.ports):
        raise Refused(f"a {one.ports[0].type} is {len(one.ports)} words ({', '.join(p.name for p in one.ports)}), "
                      f"not {len(words)}: join them with a comma")
    signed = []
    for port, value in zip(one.ports, words):
        if not -(1 << port.width - 1) <= value < 1 << port.width:
            raise Refused(f"{value} does not fit the {port.width} bits of {port.name}")
        value &= (1 << port.width) - 1
        signed.append(value - (1 << port.width) if port.signed and value >> port.width - 1 else value)
    means: dict[str, float] = {}
    if one.joint:
        if one.ports[0].type == "vector" and not any(signed):
            raise Refused("(0, 0) is no direction")
        theta = float(codecs.decode(one.ports, {port.name: value for port, value in zip(one.ports, signed)}))
        means["degrees"] = float(np.degrees(theta))
        if counts is not None:
            means["count"] = int(np.floor(theta * (counts / (2 * np.pi)) + 0.5)) % counts
        if half:
            turns = {"degrees": 360.0, "count": counts}
            means = {key: value - turns[key] if 2 * value >= turns[key] else value for key, value in means.items()}
    else:
        _no_counts(one, counts)
        means["number" if one.unit == "1" else one.unit] = signed[0] * 2.0**-one.fraction
        if mm_per_unit and one.unit == "units":
            means["mm"] = means["units"] * mm_per_unit
    return {"words": [_entry(port, value) for port, value in zip(one.ports, signed)], "means": means}


def number(text: str) -> int:
    """An integer: decimal, 0x.., 0b.. or a Verilog literal such as 18'h1f3 or -16'sd5."""
    bare = text.replace("_", "").strip().lower()
    try:
        if found := re.fullmatch(r"(-?)\d*'s?([hdb])([0-9a-f]+)", bare):
            value = int(found[3], {"h": 16, "d": 10, "b": 2}[found[2]])
            return -value if found[1] else value
        return int(bare, 0) if not re.fullmatch(r"-?0\d+", bare) else int(bare)
    except ValueError:
        raise Refused(f"'{text}' is no integer: write 1234, 0x4d2 or 18'h4d2") from None
