"""How far a core is from the truth: arithmetic error, and the error of its words' resolution apart.

Kinematic cores are measured at the tip of the arm, in LSB of a coordinate (2^-F units) and in millimetres:

* forward: distance from the answered tip to the float64 tip of the *quantised* joints and links;
* inverse: distance from the float64 tip of the true solution (of the *quantised* target) to the tip of the solution
  that the answered words stand for. A word stands for every direction that rounds to it, so a correctly rounded
  answer has arithmetic error 0 and the half LSB of the word belongs to the quantisation;
* input error: what an exact core of the same words would still lose: rounding of joints, targets, links and, for
  inverse cores, of the answered joints.

Primitives are measured against the real-valued function in LSB of their own output.
Everything here is vectorised over the samples; nothing knows which family computed an answer, only its words.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from quadrance import truth
from quadrance.arms import Arm
from quadrance.cores import Core, Port
from quadrance.fixed import Ints, ints, to_fixed, to_float, wrap
from quadrance.trajectory import trajectory
from quadrance.truth import Floats, floats

JOINTS = {"fk1": 1, "fk2": 2, "fk3": 3, "ik1": 1, "ik2": 2, "ik3": 3}
AXES = {"fk1": "xy", "fk2": "xy", "fk3": "xyz", "ik1": "xy", "ik2": "xy", "ik3": "xyz"}


@dataclass(frozen=True)
class Case:
    """What to feed a core, and the float64 motion it stands for.

    inputs : words a port (N,); cfg : words; angles (N, joints) rad and tip (N, 3) units before quantisation,
    None for primitives.
    """

    inputs: dict[str, Ints]
    cfg: dict[str, int]
    angles: Floats | None = None
    tip: Floats | None = None


@dataclass(frozen=True)
class Errors:
    """Errors of every sample in LSB; `quantisation` is None for primitives. Undefined samples are left out."""

    arithmetic: Floats
    quantisation: Floats | None


def summary(error: Floats | None, scale: float = 1.0) -> dict[str, float] | None:
    """Greatest and root-mean-square error, times `scale`; None where there is nothing to summarise."""
    if error is None or not error.size:
        return None
    return {"max": float(np.max(error)) * scale, "rms": float(np.sqrt(np.mean(error * error))) * scale}


def mm_per_lsb(core: Core, arm: Arm) -> float:
    """Millimetres in one coordinate LSB."""
    return arm.mm_per_unit * 2.0 ** -core.params["F"]


# Words


def encode(port: Port, core: Core, theta: Floats) -> Ints:
    """Joint words of angles: turn-spread, or binary angle in the classic family."""
    if core.family == "classic":
        return wrap(truth.angle_to_binary_word(theta, port.width), port.width, port.signed)
    return truth.angle_to_spread_word(theta, port.width - 2)


def decode(port: Port, core: Core, word: Ints | Floats) -> Floats:
    """Angles of joint words (or of real numbers of their LSB)."""
    if core.family == "classic":
        return truth.binary_word_to_angle(word, port.width)
    return truth.spread_word_to_angle(word, port.width - 2)


def within_cell(port: Port, core: Core, word: Ints, theta: Floats) -> Floats:
    """The direction nearest to `theta` (in words) among those that round to `word`."""
    if core.family == "classic":
        exact = theta * (2.0**port.width / truth.TURN)
    else:
        exact = truth.angle_to_spread(theta, port.width - 2)
    turn = 2.0**port.width
    off = np.mod(exact - word + turn / 2, turn) - turn / 2
    return decode(port, core, word + np.clip(off, -0.5, 0.5))


def config(core: Core, arm: Arm) -> dict[str, int]:
    """Configuration words of `core` for `arm`: link lengths, and what the family's model derives from them.

    A family whose cores need more than ``cfg_l1`` and ``cfg_l2`` has ``config(p, *, cfg_l1, cfg_l2) -> dict`` beside
    its models.
    """
    words = {f"cfg_l{i}": int(to_fixed(link, core.params["F"])) for i, link in enumerate(arm.links, 1)} \
        if "F" in core.params else {}
    names = [port.name for port in core.cfg]
    if set(names) - set(words):
        module = core.model.__module__
        derive = getattr(sys.modules[module], "config", None)
        if derive is None:
            raise ValueError(f"{core.id}: {module} has no config() for {sorted(set(names) - set(words))}")
        words |= {name: int(word) for name, word in derive(core.params, **words).items()}
    return {name: words[name] for name in names}


def _links(core: Core, arm: Arm) -> tuple[float, float]:
    """Link lengths as the core knows them, in units."""
    return tuple(float(to_float(to_fixed(link, core.params["F"]), core.params["F"])) for link in arm.links)


def _ports(ports: tuple[Port, ...]) -> dict[str, Port]:
    return {port.name: port for port in ports}


def _joints(core: Core, ports: tuple[Port, ...]) -> list[Port]:
    return [_ports(ports)[f"{ports[0].name.split('_')[0]}_j{i + 1}"] for i in range(JOINTS[core.function])]


# Cases


def _case(core: Core, arm: Arm, angles: Floats, tip: Floats, words: Ints | None = None) -> Case:
    """Quantise a motion to the core's words; `words` (N, joints) overrides the joint words."""
    if core.function.startswith("fk"):
        ports = _joints(core, core.inputs)
        inputs = {port.name: encode(port, core, angles[:, i]) if words is None else words[:, i]
                  for i, port in enumerate(ports)}
    else:
        f = core.params["F"]
        inputs = {f"in_{axis}": to_fixed(tip[:, i], f) for i, axis in enumerate(AXES[core.function])}
        for port in core.inputs:
            if port.name == "in_elbow":
                inputs[port.name] = ints(truth.difference(angles[:, 1], 0) < 0)
            elif port.name not in inputs:
                inputs[port.name] = np.zeros(len(angles), dtype=np.int64)
    return Case(inputs, config(core, arm), angles, tip)


def trajectory_case(core: Core, arm: Arm, samples: int = 1000) -> Case | None:
    """The arm's trajectory in the core's words; None for a primitive."""
    if core.function not in JOINTS:
        return None
    return _case(core, arm, *trajectory(arm, JOINTS[core.function], samples))


def sweep_case(core: Core, arm: Arm, count: int = 4096, seed: int = 1) -> Case | None:
    """Seeded random and border samples over all a core can be asked on `arm`; None for an unknown function.

    Forward: joint words, half uniform, half uniform in angle, and every quadrant border with its neighbours.
    Inverse: every direction and both elbows from folded to stretched. Primitives: see `PRIMITIVES`.
    """
    rng = np.random.default_rng(seed)
    if core.function in PRIMITIVES:
        return Case({name: ints(values) for name, values in PRIMITIVES[core.function][0](core, rng, count).items()}, {})
    if core.function not in JOINTS:
        return None
    joints = JOINTS[core.function]
    angles = rng.uniform(-np.pi, np.pi, (count, joints))
    borders = np.pi / 2 * rng.integers(-2, 3, (count // 8, joints))
    angles[:len(borders)] = borders + rng.choice([-1, 0, 1], borders.shape) * 2.0 ** -rng.integers(4, 20, borders.shape)
    words = None
    if core.function.startswith("fk"):
        ports = _joints(core, core.inputs)
        words = np.stack([encode(port, core, angles[:, i]) for i, port in enumerate(ports)], axis=-1)
        for i, port in enumerate(ports):
            words[count // 2:, i] = rng.integers(port.low, port.high, count - count // 2, endpoint=True)
            words[-64:, i] = wrap((rng.integers(0, 4, 64) << port.width - 2) + rng.integers(-2, 3, 64),
                                  port.width, port.signed)
            angles[:, i] = decode(port, core, words[:, i])
    tip = _forward(core, np.moveaxis(angles, -1, 0), arm.links)
    return _case(core, arm, angles, tip, words)


def map_case(core: Core, arm: Arm, side: int) -> tuple[Case, np.ndarray]:
    """A point in every cell of a `side` x `side` grid over the square of the arm's reach, elbow 0, in the core's words.

    Two-joint functions only. The points are seeded random within their cells: on whole units nothing would be rounded.
    Returns the case and the (side, side) mask of the cells whose point is in reach, row 0 lowest.
    """
    within = np.random.default_rng(1).random((2, side, side))
    x, y = sum(arm.links) * ((np.stack(np.meshgrid(np.arange(side), np.arange(side))) + within) * (2 / side) - 1)
    inside = truth.reach(x, y, *arm.links) == 0
    angles = np.stack(truth.ik2(x[inside], y[inside], *arm.links, 0), axis=-1)
    inside[inside] = defined = np.all(np.isfinite(angles), axis=-1)
    tip = np.stack([x[inside], y[inside], np.zeros(int(inside.sum()))], axis=-1)
    return _case(core, arm, angles[defined], tip), inside


# Errors


def _forward(core: Core, angles: Floats, links: tuple[float, float]) -> Floats:
    """Tip (N, 3) in units of joint angles (joints, N); one joint moves the first link."""
    joints = JOINTS[core.function]
    tip = truth.fk1(*angles, links[0]) if joints == 1 else (truth.fk2 if joints == 2 else truth.fk3)(*angles, *links)
    return np.stack([*tip, *([np.zeros_like(tip[0])] * (3 - len(tip)))], axis=-1)


def _inverse(core: Core, inputs: dict[str, Ints], links: tuple[float, float]) -> tuple[Floats, ...]:
    """True joints of the quantised target."""
    f = core.params["F"]
    target = [to_float(inputs[f"in_{axis}"], f) for axis in AXES[core.function]]
    if core.function == "ik1":
        return (truth.ik1(*target),)
    elbow = inputs.get("in_elbow", 0)
    return truth.ik2(*target, *links, elbow) if core.function == "ik2" else \
        truth.ik3(*target, *links, elbow, inputs.get("in_back", 0))


def _distance(a: Floats, b: Floats) -> Floats:
    return np.linalg.norm(a - b, axis=-1)


def errors(core: Core, arm: Arm, case: Case, outputs: dict[str, Ints], every: bool = False) -> Errors | None:
    """Errors of the answers of `core` to `case`; None for a function that has no truth here.

    With `every`, samples without a truth stay, as NaN.
    """
    if core.function in PRIMITIVES:
        return Errors(_primitive(core, case, outputs), None)
    if core.function not in JOINTS:
        return None
    f, links = core.params["F"], _links(core, arm)
    if core.function.startswith("fk"):
        ports = _joints(core, core.inputs)
        exact = _forward(core, [decode(port, core, case.inputs[port.name]) for port in ports], links)
        answer = np.zeros_like(exact)
        for i, axis in enumerate(AXES[core.function]):
            answer[:, i] = to_float(outputs[f"out_{axis}"], f)
        limit = 2.0 ** (core.params["W"] - 1 - f)
        valid = np.all(np.abs(exact) < limit - 2.0**-f, axis=-1)  # saturation is flagged, not an arithmetic error
        arithmetic, quantisation = _distance(answer, exact), _distance(exact, case.tip)
    else:
        ports = _joints(core, core.outputs)
        exact = _inverse(core, case.inputs, links)
        valid = np.all(np.isfinite(exact), axis=0)
        for axis in AXES[core.function]:  # a target that the word cannot hold is not the core's error
            port = _ports(core.inputs)[f"in_{axis}"]
            valid &= (case.inputs[port.name] >= port.low) & (case.inputs[port.name] <= port.high)
        exact = np.where(valid, exact, 0)
        answer = [within_cell(port, core, outputs[port.name], theta) for port, theta in zip(ports, exact)]
        rounded = [decode(port, core, encode(port, core, theta)) for port, theta in zip(ports, exact)]
        arithmetic = _distance(_forward(core, answer, links), _forward(core, exact, links))
        quantisation = _distance(_forward(core, rounded, arm.links), case.tip)
    if every:
        return Errors(np.where(valid, arithmetic, np.nan) * 2.0**f, np.where(valid, quantisation, np.nan) * 2.0**f)
    return Errors(arithmetic[valid] * 2.0**f, quantisation[valid] * 2.0**f)


# Primitives: function -> (stimulus, truth). The stimulus is a function of (core, rng, count); the truth of
# (core, inputs) gives the real-valued outputs in LSB of each port that has one, NaN where undefined.


def _any_words(core: Core, rng: np.random.Generator, count: int) -> dict[str, Ints]:
    """Uniform words, one in four short, the extremes first."""
    words = {}
    for port in core.inputs:
        word = rng.integers(port.low, port.high, count, endpoint=True)
        word = np.where(rng.random(count) < 0.25, word >> rng.integers(0, port.width, count), word)
        edges = [port.low, port.low + 1, 0, 1, port.high - 1, port.high]
        word[:36] = np.repeat(edges, 6) if not words else np.tile(edges, 6)
        words[port.name] = word
    return words


def _isqrt(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {"out_root": np.sqrt(floats(inputs["in_d"])) * 2.0 ** core.params["F"]}


def _divide(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    divisor = np.where(inputs["in_d"] == 0, np.nan, floats(inputs["in_d"]))
    return {"out_q": floats(inputs["in_n"]) / divisor * 2.0 ** core.params["F"]}


def _round_saturate(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    limit = 2.0 ** (core.params["WO"] - 1)
    return {"out_x": np.clip(floats(inputs["in_x"]) * 2.0 ** -core.params["SHIFT"], -limit, limit - 1)}


def _within(core: Core, name: str, value: Floats) -> Floats:
    """`value`, NaN where it does not fit the port: saturation is flagged, not an arithmetic error."""
    port = _ports(core.outputs)[name]
    return np.where((value >= port.low) & (value <= port.high), value, np.nan)


def _rotate(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    theta = truth.binary_word_to_angle(inputs["in_angle"], _ports(core.inputs)["in_angle"].width)
    turned = (floats(inputs["in_x"]) + 1j * inputs["in_y"]) * np.exp(1j * theta)
    return {"out_x": _within(core, "out_x", turned.real), "out_y": _within(core, "out_y", turned.imag)}


def _long_vectors(core: Core, rng: np.random.Generator, count: int) -> dict[str, Ints]:
    """Every direction at a quarter of the full scale and more, the axes and diagonals among them."""
    full = core.inputs[0].high
    theta = np.append(rng.uniform(0, truth.TURN, count - 8), np.arange(8) * (truth.TURN / 8))
    length = full * rng.uniform(0.25, 1, count)
    return {port.name: np.rint(length * part).astype(np.int64) for port, part in zip(core.inputs, truth.unit(theta))}


def _vector(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    x, y = inputs["in_x"], inputs["in_y"]
    turn = 2.0 ** _ports(core.outputs)["out_angle"].width
    return {"out_magnitude": np.hypot(x, y), "out_angle": truth.angle(x, y) / truth.TURN * turn}


def _spread_to_vector(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    c, n = truth.unit(truth.spread_word_to_angle(inputs["in_j"], core.params["S"]))
    return {"out_c": c * 2.0 ** core.params["U"], "out_n": n * 2.0 ** core.params["U"]}


def _vector_to_spread(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {"out_j": truth.angle_to_spread(truth.angle(inputs["in_c"], inputs["in_n"]), core.params["S"])}


def _at_most_one(core: Core, rng: np.random.Generator, count: int) -> dict[str, Ints]:
    """Dividends up to their divisor."""
    words = _any_words(core, rng, count)
    return {"in_rem": np.minimum(words["in_rem"], words["in_d"]), "in_d": np.maximum(words["in_d"], 1)}


def _quotient(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {"out_digits": inputs["in_rem"] / inputs["in_d"] * 2.0 ** core.params["R"]}


PRIMITIVES: dict[str, tuple[Callable, Callable]] = {
    "isqrt": (_any_words, _isqrt),
    "root": (_any_words, lambda core, inputs: {"out_root": np.sqrt(floats(inputs["in_d"]))}),
    "divide": (_any_words, _divide),
    "quotient": (_at_most_one, _quotient),
    "round_saturate": (_any_words, _round_saturate),
    "rotate": (_any_words, _rotate),
    "vector": (_long_vectors, _vector),
    "spread_to_vector": (_any_words, _spread_to_vector),
    "vector_to_spread": (_any_words, _vector_to_spread),
}
CIRCULAR = ("out_angle", "out_j")  # outputs that wrap at the full turn


def _primitive(core: Core, case: Case, outputs: dict[str, Ints]) -> Floats:
    """Greatest error over the output ports of each sample, angles the short way round; NaN truths are left out."""
    worst = np.zeros(len(next(iter(case.inputs.values()))))
    for name, exact in PRIMITIVES[core.function][1](core, case.inputs).items():
        error = np.abs(outputs[name] - exact)
        if name in CIRCULAR:
            turn = 2.0 ** _ports(core.outputs)[name].width
            error = np.minimum(np.mod(error, turn), turn - np.mod(error, turn))
        worst = np.maximum(worst, error)  # NaN stays NaN
    return worst[np.isfinite(worst)]
