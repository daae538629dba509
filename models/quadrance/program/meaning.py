"""This module says what a program computes: bit by bit as product_engine does, and in float64 as its equations say.

One walk over the statements serves both; `Fixed` and `Real` are the two arithmetics.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from quadrance.fixed import Ints, hold_last, ints, round_shift, saturate, wrap
from quadrance.product_engine import ONE, G, H, N, dot, fold, inverse, root, rounded, sum_of, term, unit
from quadrance.program import language
from quadrance.program.language import Program, Statement

Params = dict[str, int]
Value = NDArray  # int64 words, or float64
Bools = NDArray[np.bool_]
MORE = 4  # fraction bits of a configured length below the LSB of a coordinate


def shift(format: str, p: Params) -> int:
    """Bits by which a word of a format is shifted to 25 fraction bits; a power of two is not."""
    return {"vector": H - p.get("U", H), "coordinate": H - p.get("W", H), "length": H - p.get("W", H) - MORE,
            "velocity": H - 2 * p.get("W", H) + p.get("V", H)}.get(format, 0)


def floor(p: Params) -> int:
    """WRIST of the engine: the bit below which a vector of `wrist` is taken for nothing, eight units of 2^-U."""
    return H - p["U"] + 3


def slack(p: Params) -> int:
    """SLACK of the engine: the bit from which the word of a check is an error, 16 units of 2^-U."""
    return H - p["U"] + 4


@dataclass
class Outcome:
    """Words by name, and what the flags say: out of reach (by the word of `reach` or `clamp`), a direction that is held
    (by name), or near its singularity (by name, in the order of the text), a failed check."""

    words: dict[str, Value]
    beyond: dict[str, Bools] = field(default_factory=dict)
    none: dict[str, Bools] = field(default_factory=dict)
    wrong: Bools = field(default_factory=lambda: np.zeros(1, bool))
    near: dict[str, list[Bools]] = field(default_factory=dict)

    @property
    def far(self) -> Bools:
        """Any word is beyond reach."""
        return np.any(np.broadcast_arrays(np.zeros(1, bool), *self.beyond.values()), axis=0)

    @property
    def singular(self) -> Bools:
        """Any direction is held or near."""
        return np.any(np.broadcast_arrays(np.zeros(1, bool), *self.none.values(), *sum(self.near.values(), [])), axis=0)

    @property
    def status(self) -> Ints:
        """Bits of out_status: 0 unreachable, 1 singular, 3 a failed check."""
        return ints(self.far) + 2 * ints(self.singular) + 8 * ints(self.wrong)


class Fixed:
    """The arithmetic of product_engine on int64 arrays of s2.25 words."""

    one, zero = np.int64(ONE), np.int64(0)

    def __init__(self, wrist: int, slack: int) -> None:
        self.wrist, self.slack = wrist, slack

    def total(self, terms: list[tuple[bool, Value, Value | None]]) -> Value:
        """The sum before it is rounded to a word."""
        return sum_of(*(term(a, -ONE if minus else ONE) if b is None else ~term(a, b) if minus else term(a, b)
                        for minus, a, b in terms))

    def word(self, total: Value) -> Value:
        return rounded(total)

    def root(self, y: Value, minus: Value) -> Value:
        return root(y, minus)

    def unit(self, a: Value, b: Value, wrist: bool, minus: Value) -> tuple[Value, Value, Bools]:
        """Cosine and sine of a direction, and where there is none."""
        a, b, g, none = unit(a, b, self.wrist if wrist else 0, minus)
        return dot((a, g)), dot((b, g)), none

    def quotients(self, totals: list[Value], divisor: Value) -> tuple[list[Value], Bools]:
        """Words from -1 to 1, and where one was limited, from 1/2 to 1 on; 0 where the divisor is 0."""
        up, power = inverse(divisor)
        found, limited = [], np.False_
        for total in totals:
            word, outside = self.limited(total, rounded(total) * power)
            found.append(dot((up, word)))
            limited = limited | outside
        return found, limited

    def clamp(self, total: Value, fraction: Value, power: Value) -> tuple[Value, Bools]:
        """A word from -1 to 1, and where the product lies beyond."""
        return self.limited(total, dot((rounded(total), fraction)) * power)

    def limited(self, total: Value, product: Value) -> tuple[Value, Bools]:
        """A product of a sum, from -1 to 1, and where it, or the sum above, lies beyond."""
        long = total >> G >= 1 << N - 1
        outside = long | (product < -ONE) | (product >= ONE)
        return np.where(outside, np.where((product < 0) & ~long, -ONE, ONE), wrap(product, N)), outside

    def off(self, total: Value) -> Bools:
        """A sum that is not 0, within the slack: before it wraps to a word."""
        return fold(total >> G) >> self.slack != 0


class Real:
    """Float64: the same equations without rounding."""

    one, zero = 1.0, 0.0

    def __init__(self, none: float = 2.0**-H, slack: float = 2.0**-12) -> None:
        self.none, self.slack = none, slack

    def total(self, terms: list[tuple[bool, Value, Value | None]]) -> Value:
        return sum((-1 if minus else 1) * (a if b is None else a * b) for minus, a, b in terms)

    def word(self, total: Value) -> Value:
        return total

    def root(self, y: Value, minus: Value) -> Value:
        return np.where(minus, -1, 1) * np.sqrt(np.maximum(y, 0))

    def unit(self, a: Value, b: Value, wrist: bool, minus: Value) -> tuple[Value, Value, Bools]:
        length = np.hypot(a, b)
        none = length < self.none
        g = np.where(minus, -1, 1) / np.where(none, 1, length)
        return a * g, b * g, none

    def quotients(self, totals: list[Value], divisor: Value) -> tuple[list[Value], Bools]:
        inverse = np.where(divisor == 0, 0, 1 / np.where(divisor == 0, 1, divisor))
        found = [total * inverse for total in totals]
        return [np.clip(one, -1, 1) for one in found], np.any(np.abs(np.broadcast_arrays(*found)) > 1, axis=0)

    def clamp(self, total: Value, fraction: Value, power: Value) -> tuple[Value, Bools]:
        product = total * fraction * power
        return np.clip(product, -1, 1), np.abs(product) > 1

    def off(self, total: Value) -> Bools:
        return np.abs(total) >= self.slack


class _Walk:
    """The words of a program, each computed where it is first asked for."""

    def __init__(self, program: Program, on: Fixed | Real, inputs: dict[str, Value], signs: dict[str, Value]) -> None:
        self.program, self.on, self.signs = program, on, {"+": np.False_, "-": np.True_} | signs
        self.outcome = Outcome({language.ONE: on.one} | inputs)
        self.writer = {name: one for one in program.statements for name in one.names}
        self.held: dict[str, list[Statement]] = {}
        for one in program.statements:
            if one.hold:
                self.held.setdefault(one.hold, []).append(one)
        self.past = {one.of for one in program.statements if one.kind == "far"}
        self.busy: set[int] = set()

    def word(self, name: str) -> Value:
        if name not in self.outcome.words:
            one = self.writer[name]
            if id(one) in self.busy:
                raise self.program.wrong(one.line, f"what is held for {name} depends on {name} itself")
            self.busy.add(id(one))
            self.run(one)
        return self.outcome.words[name]

    def total(self, one: Statement, which: int = 0) -> Value:
        return self.on.total([(term.minus, self.word(term.a), term.b and self.word(term.b))
                              for term in one.sums[which]])

    def run(self, one: Statement) -> None:
        """Compute the words of a statement."""
        words, outcome = self.outcome.words, self.outcome
        match one.kind:
            case "sum":
                words[one.names[0]] = self.on.word(self.total(one))
            case "reach":
                total = self.total(one)
                outcome.beyond[one.names[0]] = total < 0
                words[one.names[0]] = np.where(total < 0, self.on.zero, self.on.word(total))
            case "check":
                outcome.wrong = outcome.wrong | self.on.off(self.total(one))
            case "root":
                for name, sign in zip(one.names, one.signs):
                    words[name] = self.on.root(self.word(one.source[0]), self.signs[sign])
            case "clamp":
                words[one.names[0]], far = self.on.clamp(self.total(one), *map(self.word, one.source))
                outcome.beyond[one.names[0]] = far & ((words[one.names[0]] < 0) | (one.names[0] not in self.past))
            case "near":
                outcome.near.setdefault(one.of, []).append(self.total(one) < 0)
            case "far":
                outcome.beyond[one.of] = outcome.beyond[one.of] | (self.total(one) < 0)
            case "quotient":
                totals = [self.total(one, which) for which in range(len(one.sums))]
                found, limited = self.on.quotients(totals, self.word(one.source[0]))
                outcome.beyond[one.names[0]] = limited
                words |= zip(one.names, found)
            case "unit" if one.hold:
                self.hold(self.held[one.hold])
            case "unit":
                words[one.names[0]], words[one.names[1]], _ = self.direction(one)

    def direction(self, one: Statement) -> tuple[Value, Value, Bools]:
        a, b = (self.on.word(self.total(one, which)) for which in (0, 1))
        return self.on.unit(a, b, one.wrist, self.signs[one.signs[0]])

    def hold(self, every: list[Statement]) -> None:
        """Directions that hold the last of one another, in the order of the text within a sample."""
        found = [self.direction(one) for one in every]
        c, n, none = (np.stack(np.broadcast_arrays(*part), axis=-1) for part in zip(*found))
        at = hold_last(np.arange(none.size), ~none.ravel(), -1)  # of the newest direction, -1 for none
        for which, part, first in ((0, c, self.on.one), (1, n, self.on.zero)):
            kept = np.where(at < 0, first, part.ravel()[np.maximum(at, 0)]).reshape(none.shape)
            self.outcome.words |= {one.names[which]: kept[..., i] for i, one in enumerate(every)}
        self.outcome.none |= {one.names[0]: none[..., i] for i, one in enumerate(every)}


def walked(program: Program, on: Fixed | Real, inputs: dict[str, Value], signs: dict[str, Value]) -> Outcome:
    """All words of inputs, by their names in the text, in one arithmetic."""
    walk = _Walk(program, on, inputs, signs)
    for one in program.statements:
        for name in one.names:
            walk.word(name)
        if one.kind in ("check", "near", "far"):
            walk.run(one)
    return walk.outcome


def fixed(program: Program, p: Params, **ports: Ints) -> Outcome:
    """All words, s2.25, and the flags.

    Parameters
    ----------
    p : parameters W and U of the core.
    ports : words of the core's ports, by their names; the signs are the bits of `in_branch`. Arrays of samples in the
        order in which directions are held.
    """
    ports = dict(zip(ports, (ints(word) for word in np.broadcast_arrays(*ports.values()))))
    inputs = {name: ports[port.port] << shift(port.format, p) for name, port in program.inputs.items()}
    signs = {name: ports["in_branch"] >> i & 1 for i, name in enumerate(program.signs)}
    return walked(program, Fixed(floor(p), slack(p)), inputs, signs)


def near_vector(p: Params, word: Ints) -> Ints:
    """A word rounded to the format `vector`."""
    return wrap(round_shift(word, shift("vector", p)), p["U"] + 2)


def results(program: Program, p: Params, words: dict[str, Ints]) -> tuple[dict[str, Ints], Ints]:
    """Words of the result ports, each rounded to its format, ties upward, and where a coordinate was saturated."""
    found, overflow = {}, ints(0)
    for port in program.results:
        if port.format in ("coordinate", "velocity"):
            found[port.port], over = saturate(round_shift(words[port.name], shift(port.format, p)), p["W"])
            overflow = overflow | over
        else:
            found[port.port] = near_vector(p, words[port.name])
    return found, overflow


def answer(program: Program, p: Params, **ports: Ints) -> dict[str, Ints]:
    """The words of all result ports and out_status, as the core gives them."""
    outcome = fixed(program, p, **ports)
    found, overflow = results(program, p, outcome.words)
    return found | {"out_status": outcome.status + 4 * ints(overflow)}


def floats(program: Program, p: Params, **ports: Ints) -> dict[str, Value]:
    """The values that the words of the input ports carry, by their names in the text."""
    return {name: ints(ports[port.port]) * 2.0 ** (shift(port.format, p) - (H if port.format != "power" else 0))
            for name, port in program.inputs.items()}


def real(program: Program, inputs: dict[str, Value], branch: Value = 0) -> Outcome:
    """All words in float64, of input values by their names in the text; `branch` has the signs in its bits."""
    signs = {name: ints(branch) >> i & 1 > 0 for i, name in enumerate(program.signs)}
    return walked(program, Real(), inputs, signs)
