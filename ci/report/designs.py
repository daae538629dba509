"""A kinematic core, or one with codecs at its joints, at any legal parameters, and its total error at the tip.

The error is the report's *total*: words and arithmetic, greatest over the arm's workspace, borders included, here of
the bit-true models; in LSB of Q7.8 whatever F is.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from pathlib import Path

import numpy as np
from quadrance import accuracy, cores
from quadrance.accuracy.arm import JOINTS, joint_ports
from quadrance.arms import Arm
from quadrance.cores import TYPES, Core, Port
from quadrance.fixed import Ints

from tb.lib import legal

SOURCE = Path(__file__).with_name("verdict.toml")
METRE = SOURCE.with_name("metre.toml")
RULES = tomllib.loads(SOURCE.read_text())

Values = dict[str, int]  # W, F, the core's joint word and, with a codec, the word outside: {"W": 16, "F": 8, "U": 14}
OUTSIDE = "word"  # the key of the latter


@dataclass(frozen=True)
class Design:
    """A kinematic core by name, and the codec at each of its joints; `word`: the type of the joint words outside.

    `metre`: on the SCARA of 1 m, with targets of its own.
    """

    core: str
    word: str
    codec: str | None = None
    metre: bool = False

    @property
    def id(self) -> str:
        """Readable name, unique."""
        return self.core + (f" with {self.codec}" if self.codec else "") + " on 1 m" * self.metre

    @property
    def rules(self) -> dict:
        """Fraction bits that are tried, and targets."""
        return RULES["metre"] if self.metre else RULES

    def arm(self, name: str) -> str:
        """Name or path of the arm that it is measured on where the report is that of `name`."""
        return str(METRE) if self.metre else name


def word_type(core: Core) -> str:
    """The type of the joint words of a kinematic core."""
    return joint_ports(core)[0][0].type


def _turns(core: Core) -> tuple[str, str] | None:
    """The types of the joint words that a stream core takes and gives; None where it is no codec.

    By its ports; by the name of its function where coordinates of any length come in.
    """
    if core.family != "codec" or not core.clocked:
        return None
    ends = tuple(cores.joints(ports) for ports in (core.inputs, core.outputs))
    if all(len(joint) == 1 for joint in ends):
        return tuple(joint[0][0].type for joint in ends)
    match = re.fullmatch(r"(\w+)_to_(\w+)", core.function)
    return (match[1], match[2]) if match else None


def codecs() -> dict[tuple[str, str], str]:
    """(type in, type out) -> the codec with the fewest cycles, for all types that are compared."""
    found: dict[tuple[str, str], Core] = {}
    for core in cores.all_cores():
        pair = _turns(core) if core.first_set else None
        if pair and pair[0] != pair[1] and set(pair) <= set(RULES["longest"]):
            found[pair] = min(found.get(pair, core), core, key=lambda one: one.latency)
    return {pair: core.name for pair, core in found.items()}


def plain() -> list[Design]:
    """Every kinematic core of the list with its own words; of one with modes the first, which is the smallest."""
    names = dict.fromkeys(core.name for core in cores.all_cores() if core.function in JOINTS)
    return [Design(name, word_type(cores.find(name))) for name in names]


def metre() -> list[Design]:
    """The kinematic cores with coordinates long enough for the SCARA of 1 m."""
    return [replace(design, metre=True) for design in plain()
            if legal.ranges(cores.find(design.core))["W"][1] >= RULES["metre"]["least"]]


def coded(families: tuple[str, ...] = ("vector", "table", "rational", "classic")) -> list[Design]:
    """The cores of those families with the codecs there are at their joints."""
    known, found = codecs(), []
    for design in plain():
        core = cores.find(design.core)
        if core.family in families:
            forward = core.function.startswith("fk")
            for word in RULES["longest"]:
                pair = (word, design.word) if forward else (design.word, word)
                if word != design.word and pair in known:
                    found.append(Design(design.core, word, known[pair]))
    return found


# Parameters


@cache
def rule(name: str) -> str:
    """What the core's own g_illegal compares; empty where it leaves its rule to a part."""
    match = re.search(r"if \((.*?)\)\s+begin : g_illegal", cores.find(name).sources[0].read_text(), re.S)
    return match[1] if match else ""


@cache
def _at(name: str, params: tuple[tuple[str, int], ...]) -> Core | None:
    core, wanted = cores.find(name), dict(params)
    try:
        broken = any(all(cores.formula(one.strip(" ()"), wanted, name) for one in clause.split("&&"))
                     for clause in rule(name).split("||"))
    except ValueError:  # no rule of its own, or none that is a formula
        broken = bool(legal.rule_of(core).broken(wanted))
    if broken:
        return None
    return cores.at(core, wanted)


def at(name: str, params: dict[str, int]) -> Core | None:
    """The core at another parameter set; None for an illegal one."""
    return _at(name, tuple(params.items()))


def _ends(codec: Core) -> tuple[tuple[Port, ...], tuple[Port, ...]]:
    """The ports of the word that goes in and of the one that comes out."""
    return codec.inputs, tuple(port for port in codec.outputs if port.name != "out_status")


def fitted(name: str, widths: tuple[int, int]) -> Core | None:
    """The codec with ports of those widths, in and out; None where its parameters do not allow them."""
    params = dict(cores.find(name).params)
    for end, width in enumerate(widths):
        for key in params:
            here, more = (at(name, params | {key: params[key] + step}) or at(name, params | {key: params[key] - step})
                          for step in (0, 1))
            if here and more and _ends(here)[end][0].width != _ends(more)[end][0].width:
                params[key] += width - _ends(here)[end][0].width
                break
        if at(name, params) is None:
            return None
    core = at(name, params)
    return core if tuple(ports[0].width for ports in _ends(core)) == widths else None


def parts(design: Design, values: Values) -> tuple[Core, ...] | None:
    """The core, and its codec where it has one, at these values; None for an illegal set."""
    listed = cores.find(design.core)
    fixed = {key: value for key, value in RULES["fixed"].items() if key in listed.params}
    core = at(design.core, listed.params | fixed | {key: value for key, value in values.items() if key != OUTSIDE})
    if core is None or design.codec is None:
        return core and (core,)
    inside, outside = joint_ports(core)[0][0].width, values[OUTSIDE] + TYPES[design.word][1]
    codec = fitted(design.codec, (outside, inside) if core.function.startswith("fk") else (inside, outside))
    return codec and (core, codec)


# Errors


def seen(design: Design, core: Core, codec: Core | None) -> Core:
    """The core with the joint ports that one sees from outside its codecs."""
    if codec is None:
        return core
    forward = core.function.startswith("fk")
    letters, _, signed = TYPES[design.word]
    width = _ends(codec)[0 if forward else 1][0].width
    ports = tuple(Port(f"{'in' if forward else 'out'}_{letter}{joint + 1}", width, signed, design.word)
                  for joint in range(JOINTS[core.function]) for letter in letters)
    if forward:
        return replace(core, inputs=ports)
    return replace(core, outputs=(*ports, *(port for port in core.outputs if not port.type)))


def _recoded(codec: Core, words: dict[str, Ints], old: list[tuple[Port, ...]], new: list[tuple[Port, ...]]) -> dict:
    """Joint words after the codec, by the names of their new ports."""
    taken, given = _ends(codec)
    found = {}
    for before, after in zip(old, new):
        answer = codec.model(codec.params, **{port.name: words[one.name] for port, one in zip(taken, before)})
        found |= {one.name: answer[port.name] for port, one in zip(given, after)}
    return found


@lru_cache(8)
def _workspace(shape: Core, arm: Arm, samples: int) -> accuracy.Case:
    return accuracy.workspace_case(shape, arm, samples, np.random.default_rng(1))


def workspace(core: Core, arm: Arm, samples: int) -> accuracy.Case:
    """The workspace in the core's words: the same for all that have as wide joint words and as many fraction bits."""
    shape = replace(core, name="", family="", architecture="", set_id="", params={"F": core.params["F"]}, latency=0,
                    ii=0, sources=(), cfg=(), model_name="", first_set=True, illegal=(), status=None,
                    inputs=tuple(replace(port, width=port.width if port.type else 0) for port in core.inputs))
    return replace(_workspace(shape, arm, samples), cfg=accuracy.config(core, arm))


def total(design: Design, values: Values, arm: Arm, samples: int) -> float:
    """Greatest total error over the workspace, LSB of Q7.8; infinite for an illegal set."""
    made = parts(design, values)
    if made is None:
        return float("inf")
    core, codec = (*made, None)[:2]
    outer = seen(design, core, codec)
    case = workspace(outer, arm, samples)
    words, inner, outside = case.inputs, joint_ports(core), joint_ports(outer)
    forward = core.function.startswith("fk")
    if codec and forward:
        words = _recoded(codec, words, outside, inner)
    answers = core.model(core.params, **words, **case.cfg)
    if codec and not forward:
        answers = answers | _recoded(codec, answers, inner, outside)
    errors = accuracy.errors(outer, arm, case, answers)
    return float(np.max(errors.total)) * 2.0 ** (8 - core.params["F"])
