"""This module proves that no word of a program leaves its range, for inputs within their formats and norms.

A word is s2.25 and wraps at 2. Each sum has two bounds: the intervals of its terms added, and by Cauchy and Schwarz the
norm of its first factors times that of its second ones. The norm of some words follows from norms that are known (of
inputs by the text, of unit vectors, of sine and cosine by a root) and from what their statements do: a rotation keeps
the norm of a pair, a common factor leaves a pair, a sum of vectors is no longer than their norms together.
"""

from __future__ import annotations

import itertools
import math

from quadrance.program.language import ONE, Program, Statement, Sum, Term

Interval = tuple[float, float]
# Words and `of`, with norm(words) <= factor * norm(of)
Part = tuple[frozenset[str], tuple[str, ...], float]
FORMATS: dict[str, Interval] = {"vector": (-2, 2), "coordinate": (-0.5, 0.5), "velocity": (-0.5, 0.5),
                                "length": (-0.5, 0.5), "word": (-2, 2),
                                "fraction": (0, 1), "power": (0, 1)}
UNIT = 1 + 2.0**-14  # length of what a reciprocal root has normalised
CHECKED = 8.0  # the engine's sum wraps there, and a check is of the sum
ROUNDED = 2.0**-22  # more than the rounding and truncations of one sum
WORK = 300_000  # norms that a proof may ask for
FLIPS = 5  # products of a sum whose factors are exchanged in search of the best norms


class _Proof:
    """Intervals of the words so far, and norms of groups of them."""

    def __init__(self, program: Program) -> None:
        self.program, self.work = program, 0
        self.range: dict[str, Interval] = {name: FORMATS[port.format] for name, port in program.inputs.items()}
        self.range[ONE] = (1.0, 1.0)
        self.norms: dict[frozenset[str], float] = {}
        self.found: dict[tuple[str, ...], float] = {}  # norms that were asked for since one was added
        self.sums: list[tuple[str, Sum]] = []
        self.parts: dict[str, list[Part]] = {}
        self.number = {name: i for i, one in enumerate(program.statements) for name in one.names}
        for names, limit in program.norms:
            self.add_norm(names, limit)

    def top(self, name: str) -> float:
        low, high = self.range[name]
        return max(-low, high)

    def add_norm(self, names: tuple[str, ...], limit: float) -> None:
        """The norm of some words, which bounds each of them."""
        key = frozenset(names)
        self.norms[key] = min(limit, self.norms.get(key, limit))
        self.found.clear()
        for name in names:
            low, high = self.range[name]
            self.range[name] = max(low, -limit), min(high, limit)

    def norm(self, names: tuple[str, ...]) -> float:
        """Of some words: known norms cover disjoint groups of them; the newest word is traced to its own."""
        if (key := tuple(sorted(names))) not in self.found:
            self.found[key] = self.search(names)
        return self.found[key]

    def search(self, names: tuple[str, ...]) -> float:
        self.work += 1
        best = math.sqrt(sum(self.top(name) ** 2 for name in names))
        if self.work >= WORK or len(set(names)) < len(names):
            return best
        for group, limit in self.norms.items():
            if len(group & set(names)) > 1 and limit < best:
                rest = tuple(name for name in names if name not in group)
                best = min(best, math.hypot(limit, self.norm(rest) if rest else 0))
        newest = max(names, key=lambda name: self.number.get(name, -1))
        for words, of, factor in self.parts.get(newest, ()):
            rest = tuple(name for name in names if name not in words)
            best = min(best, max(1.0, factor) * self.norm((*rest, *of)) + ROUNDED)
        return best

    def term(self, term: Term) -> Interval:
        """The interval of a term with its sign."""
        low, high = self.range[term.a]
        if term.b == term.a:
            low, high = 0.0 if low <= 0 <= high else min(low * low, high * high), self.top(term.a) ** 2
        elif term.b is not None:
            corners = [x * y for x in (low, high) for y in self.range[term.b]]
            low, high = min(corners), max(corners)
        return (-high, -low) if term.minus else (low, high)

    def sum(self, terms: Sum) -> Interval:
        """The interval of a sum."""
        parts = [self.term(term) for term in terms]
        high = min(sum(part[1] for part in parts), self.bound([t for t, part in zip(terms, parts) if part[1] > 0]))
        low = max(sum(part[0] for part in parts), -self.bound([t for t, part in zip(terms, parts) if part[0] < 0]))
        return low - ROUNDED, high + ROUNDED

    def bound(self, terms: list[Term]) -> float:
        """The magnitude of a sum: single words, and first factors times second ones by their norms."""
        single = sum(self.top(term.a) for term in terms if term.b is None)
        products = [term.names for term in terms if term.b is not None]
        if not products:
            return single
        best = math.inf
        for flips in itertools.product((False, True), repeat=min(len(products), FLIPS) - 1):
            turned = [pair[::-1] if flip else pair for flip, pair in zip((False, *flips), products)]
            left, right = zip(*turned, *products[len(turned):])
            best = min(best, single + self.norm(left) * self.norm(right))
        return best

    def part(self, words: tuple[str, ...], of: tuple[str, ...], factor: float) -> None:
        """norm(words) is at most factor * norm(of)."""
        for word in words:
            self.parts.setdefault(word, []).append((frozenset(words), of, factor))
            self.found.clear()
            low, high = self.range[word]
            top = factor * self.norm(of) + ROUNDED
            self.range[word] = max(low, -top), min(high, top)

    def trace(self, name: str, terms: Sum) -> None:
        """What a sum says of the norm of its word, alone and with each earlier sum."""
        if len(terms) == 1 and terms[0].b is not None:
            for a, b in itertools.permutations(terms[0].names):
                self.part((name,), (a,), self.top(b))
        if len(terms) == 2 and all(term.b is not None for term in terms):
            for left, right in itertools.permutations(zip(*(term.names for term in terms))):
                if (limit := self.norm(right)) <= UNIT:
                    self.part((name,), left, limit)
        for other, before in self.sums:
            if len(terms) == len(before) == 2 and all(term.b is not None for term in (*terms, *before)):
                self.rotation((name, other), terms, before)
            self.vector((name, other), terms, before)
        self.sums.append((name, terms))

    def vector(self, words: tuple[str, str], terms: Sum, before: Sum) -> None:
        """Two sums as a vector: terms with a common factor are one vector, which it makes longer or shorter."""
        left, pairs = list(before), []
        for one in terms:
            two = next((two for two in left if self.shared(one, two)), None)
            pairs.append((one, two))
            if two:
                left.remove(two)
        found = [self.shared(one, two) for one, two in pairs if two]
        if len(terms) == len(before) == len(found) == 1:
            self.part(words, (found[0][0],), self.norm(found[0][1]))
        elif found:
            alone = [*left, *(one for one, two in pairs if not two)]
            limit = sum(self.top(factor) * self.norm(of) for factor, of in found) + ROUNDED
            limit += sum(max(map(abs, self.term(one))) for one in alone)
            if limit < math.hypot(*map(self.top, words)):
                self.add_norm(words, limit)

    def shared(self, one: Term, two: Term) -> tuple[str, tuple[str, str]] | None:
        """The common factor of two terms, and their other ones."""
        names, others = (term.names if term.b else (ONE, term.a) for term in (one, two))
        common = set(names) & set(others)
        if len(common) != 1 or len({*names, *others}) != 3:
            return None
        factor = common.pop()
        return factor, tuple(next(name for name in pair if name != factor) for pair in (names, others))

    def rotation(self, words: tuple[str, str], terms: Sum, before: Sum) -> None:
        """(a c + b d, a d - b c) is as long as (a, b) times (c, d)."""
        minus = sum(term.minus for term in (*terms, *before)) % 2
        if not minus or len({*terms[0].names, *terms[1].names}) != 4:
            return
        crossed = {frozenset(term.names) for term in before}
        a, c = terms[0].names
        for b, d in itertools.permutations(terms[1].names):
            if crossed == {frozenset((a, d)), frozenset((b, c))}:
                for of, by in (((a, b), (c, d)), ((c, d), (a, b))):
                    self.part(words, of, self.norm(by))

    def wrong(self, one: Statement, name: str, interval: Interval, reason: str) -> None:
        raise self.program.wrong(one.line, f"the range of {name} is not proved: {interval[0]:.3f} to "
                                           f"{interval[1]:.3f}, {reason}")

    def word(self, one: Statement, name: str, terms: Sum) -> Interval:
        """The interval of a sum that becomes a word."""
        interval = self.sum(terms)
        if name in self.program.argued:
            limit = self.program.argued[name]
            interval = max(interval[0], -limit), min(interval[1], limit)
        self.range[name] = interval
        if min(interval[0], -interval[1]) <= -2 + ROUNDED:
            self.wrong(one, name, interval, "and a word is below 2")
        return interval

    def statement(self, one: Statement) -> None:
        """The words of a statement."""
        name = one.names[0] if one.names else one.kind
        if one.kind in ("sum", "reach"):
            interval = self.word(one, name, one.sums[0])
            self.range[name] = (0.0, interval[1]) if one.kind == "reach" else interval
            self.trace(name, one.sums[0])
        elif one.kind in ("check", "near", "far"):
            if max(map(abs, interval := self.sum(one.sums[0]))) >= CHECKED:
                self.wrong(one, name, interval, f"and a sum is below {CHECKED:g}")
        elif one.kind == "unit":
            for which, terms in enumerate(one.sums):
                self.word(one, f"coordinate {which + 1} of unit", terms)
            self.range |= dict.fromkeys(one.names, (-UNIT, UNIT))
            self.add_norm(one.names, UNIT)
        elif one.kind == "quotient":
            for which, terms in enumerate(one.sums):
                self.word(one, f"dividend {which + 1}", terms)
            self.range |= dict.fromkeys(one.names, (-1.0, 1.0))
        elif one.kind == "clamp":
            low, high = self.sum(one.sums[0])
            if low <= -2 or high >= 8:
                self.wrong(one, name, (low, high), "and a clamped sum lies between -2 and 8")
            self.range[name] = (-1.0, 1.0)
        elif one.kind == "root":
            self.root(one)

    def root(self, one: Statement) -> None:
        low, high = self.range[one.source[0]]
        if low < -2 * ROUNDED or high > 1 + 2 * ROUNDED:
            self.wrong(one, one.source[0], (low, high), "and an argument of a root lies between 0 and 1")
        for name in one.names:
            self.range[name] = (-math.sqrt(high) * UNIT, math.sqrt(high) * UNIT)
            for before in self.program.statements:
                match before.sums:
                    case ((Term(False, "one", None), Term(True, a, b)),) if a == b and before.names == one.source:
                        self.add_norm((a, name), UNIT)  # y = sqrt(1 - x^2) beside x


def proved(program: Program) -> dict[str, Interval]:
    """The interval of every input and word.

    Raises
    ------
    Wrong
        Where a word may leave its range: file, line, name.
    """
    proof = _Proof(program)
    for one in program.statements:
        proof.statement(one)
        if proof.work >= WORK:
            raise program.wrong(one.line, "the proof of ranges takes too long: fewer norms, shorter sums")
    proof.range.pop(ONE)
    return proof.range
