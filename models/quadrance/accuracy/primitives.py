"""Errors of primitives against the real-valued function, in LSB of their own output.

`PRIMITIVES` has, a function: the stimulus, of (core, rng, count); and the truth, of (core, inputs), which gives the
real-valued outputs in LSB of each port that has one, NaN where undefined.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from quadrance import codecs, conversion, truth
from quadrance.cores import Core, Port
from quadrance.fixed import Ints, ints
from quadrance.truth import Floats, floats


def stimulus(core: Core, rng: np.random.Generator, count: int) -> dict[str, Ints]:
    """Seeded words (count,) of every input port of a primitive, its extremes among them."""
    return {name: ints(values) for name, values in PRIMITIVES[core.function][0](core, rng, count).items()}


def error(core: Core, inputs: dict[str, Ints], outputs: dict[str, Ints]) -> Floats:
    """Greatest error (LSB) over the outputs of each sample, joint words the short way round; undefined left out."""
    worst = np.zeros(len(next(iter(inputs.values()))))
    for name, exact in PRIMITIVES[core.function][1](core, inputs).items():
        off = np.abs(outputs[name] - exact)
        if (port := _out(core, name)).type:
            turn = 2.0**port.width
            off = np.minimum(np.mod(off, turn), turn - np.mod(off, turn))
        worst = np.maximum(worst, off)  # NaN stays NaN
    return worst[np.isfinite(worst)]


def _out(core: Core, name: str) -> Port:
    return next(port for port in core.outputs if port.name == name)


# Stimuli


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


def _long_vectors(core: Core, rng: np.random.Generator, count: int) -> dict[str, Ints]:
    """Every direction at a quarter of the full scale and more, the axes and diagonals among them."""
    full = core.inputs[0].high
    theta = np.append(rng.uniform(0, truth.TURN, count - 8), np.arange(8) * (truth.TURN / 8))
    length = full * rng.uniform(0.25, 1, count)
    return {port.name: np.rint(length * part).astype(np.int64) for port, part in zip(core.inputs, truth.unit(theta))}


def _at_most_one(core: Core, rng: np.random.Generator, count: int) -> dict[str, Ints]:
    """Dividends up to their divisor."""
    words = _any_words(core, rng, count)
    return {"in_rem": np.minimum(words["in_rem"], words["in_d"]), "in_d": np.maximum(words["in_d"], 1)}


def _unit_vectors(core: Core, rng: np.random.Generator, count: int) -> dict[str, Ints]:
    """Every direction, rounded, the axes and diagonals among them."""
    theta = np.append(rng.uniform(0, truth.TURN, count - 8), np.arange(8) * (truth.TURN / 8))
    return codecs.encode(core.inputs, theta)


def _nearly_unit_vectors(core: Core, rng: np.random.Generator, count: int) -> dict[str, Ints]:
    """Every direction, of length 1 within 1/64."""
    theta, length = rng.uniform(0, truth.TURN, count), 2.0 ** core.params["U"] * (1 + rng.uniform(-1, 1, count) / 64)
    return {port.name: np.rint(length * part).astype(np.int64) for port, part in zip(core.inputs, truth.unit(theta))}


# Truths


def _isqrt(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {"out_root": np.sqrt(floats(inputs["in_d"])) * 2.0 ** core.params["F"]}


def _root(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {"out_root": np.sqrt(floats(inputs["in_d"]))}


def _divide(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    divisor = np.where(inputs["in_d"] == 0, np.nan, floats(inputs["in_d"]))
    return {"out_q": floats(inputs["in_n"]) / divisor * 2.0 ** core.params["F"]}


def _quotient(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {"out_digits": inputs["in_rem"] / inputs["in_d"] * 2.0 ** core.params["R"]}


def _round_saturate(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    limit = 2.0 ** (core.params["WO"] - 1)
    return {"out_x": np.clip(floats(inputs["in_x"]) * 2.0 ** -core.params["SHIFT"], -limit, limit - 1)}


def _in_range(core: Core, name: str, value: Floats) -> Floats:
    """`value`, NaN where it does not fit the port: saturation is flagged, not an arithmetic error."""
    port = _out(core, name)
    return np.where((value >= port.low) & (value <= port.high), value, np.nan)


def _rotate(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    theta = codecs.decode(core.inputs[:1], inputs)
    turned = (floats(inputs["in_x"]) + 1j * inputs["in_y"]) * np.exp(1j * theta)
    return {"out_x": _in_range(core, "out_x", turned.real), "out_y": _in_range(core, "out_y", turned.imag)}


def _vector(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    x, y = inputs["in_x"], inputs["in_y"]
    return {"out_magnitude": np.hypot(x, y), "out_angle": codecs.place((_out(core, "out_angle"),), truth.angle(x, y))}


def _vector_to_spread(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {"out_j": codecs.place((_out(core, "out_j"),), truth.angle(inputs["in_c"], inputs["in_n"]))}


def _to_vector(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {port.name: 2.0 ** core.params["U"] * part
            for port, part in zip(core.outputs, truth.unit(codecs.decode(core.inputs, inputs)))}


def _from_vector(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    """Of a unit vector: the direction whose minor coordinate, the one that the core takes, is that of the words."""
    c, n = (inputs[port.name] for port in core.inputs)
    _, axis, minor, _ = conversion.nearest_axis(core.params["U"], 1, c, n)
    sine = minor * np.where(np.where(axis % 2, n >= 0, c < 0), -1, 1) * 2.0 ** -core.params["U"]
    theta = axis * (np.pi / 2) + np.arcsin(np.clip(sine, -1, 1))
    return {"out_j": codecs.place((_out(core, "out_j"),), theta)}


def _angle_to_spread(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    return {"out_j": codecs.place((_out(core, "out_j"),), codecs.decode(core.inputs, inputs))}


def _normalise(core: Core, inputs: dict[str, Ints]) -> dict[str, Floats]:
    c, n = (floats(inputs[port.name]) for port in core.inputs)
    factor = (3 - (c * c + n * n) * 4.0 ** -core.params["U"]) / 2
    return {"out_c": c * factor, "out_n": n * factor}


PRIMITIVES: dict[str, tuple[Callable, Callable]] = {
    "isqrt": (_any_words, _isqrt),
    "root": (_any_words, _root),
    "divide": (_any_words, _divide),
    "quotient": (_at_most_one, _quotient),
    "round_saturate": (_any_words, _round_saturate),
    "rotate": (_any_words, _rotate),
    "vector": (_long_vectors, _vector),
    "vector_to_spread": (_any_words, _vector_to_spread),
    "angle_to_vector": (_any_words, _to_vector),
    "spread_to_vector": (_any_words, _to_vector),
    "half_tangent_to_vector": (_any_words, _to_vector),
    "vector_to_angle": (_unit_vectors, _from_vector),
    "unit_to_spread": (_unit_vectors, _from_vector),
    "vector_to_half_tangent": (_unit_vectors, _from_vector),
    "angle_to_spread": (_any_words, _angle_to_spread),
    "normalise": (_nearly_unit_vectors, _normalise),
}
